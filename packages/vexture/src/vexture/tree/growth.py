"""The tree while it grows: arrays with spare rows, which kernels fill one after another."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import MOST_CURVES
from vexture.tree.divide import PARTS, RUN, PiecePool
from vexture.tree.tree import Tree, levels, runs

IS_QUAD, COUNT, WINDING, COVERAGE = range(4)
"""Columns of the cells."""

QUADS, CURVES, UNRESOLVED, WAITING, WHOLE = range(5)
"""Counts: quads, curves, unresolved leaves, cells on the stack, pieces of the unit square."""

QUAD, DEPTH, FIRST, LAST, FIRST_PATH, LAST_PATH, PIECES = range(7)
"""Columns of the stack of cells to divide: quad, depth, range of the list of pieces, range of the list of paths, and
number of pieces in the pool."""


class Growth(NamedTuple):
    """The tree while it grows, and the cells to divide. Rows beyond the counts are free."""

    pool: PiecePool
    present: NDArray[np.int64]  # (room, 2): lists of paths with corner windings
    stack: NDArray[np.int64]  # (room, 7): cells to divide
    corner: NDArray[np.float64]  # (room, 2): their bottom-left corners
    # (room, 4, 4): of each cell of each quad: whether it is a quad, count, corner winding, coverage
    cells: NDArray[np.float64]
    first: NDArray[np.int64]  # (room, 2): first quad below each quad, first curve of its leaves
    curves: NDArray[Any]  # (room, 4, 2), in lattice units: float64, or int32 after growing in parts
    counts: NDArray[np.int64]  # (5,)
    deviation: NDArray[np.float64]  # (1,): largest distance of a leaf's outline from the drawing's
    # (5,): rows that the arrays of pieces, of lists of them, of lists of paths, of quads and of curves need for the
    # next cell
    needed: NDArray[np.int64]


@kernel(allocates=False)
def has_room(tree: Growth) -> bool:
    """Write the rows that the arrays need for the next cell; return whether they have them."""
    top, needed = tree.counts[WAITING] - 1, tree.needed
    last, last_path = tree.stack[top, LAST], tree.stack[top, LAST_PATH]
    listed = last - tree.stack[top, FIRST]
    if len(tree.pool.boxes) > 0:
        listed = min(RUN * listed, len(tree.pool.cubics) + tree.stack[top, PIECES])
    parts = PARTS * listed
    needed[0], needed[1] = tree.stack[top, PIECES] + listed + parts, last + parts
    needed[2] = last_path + 4 * (last_path - tree.stack[top, FIRST_PATH])
    needed[3], needed[4] = tree.counts[QUADS] + 4, tree.counts[CURVES] + 4 * MOST_CURVES
    return (
        needed[0] <= len(tree.pool.path)
        and needed[1] <= len(tree.pool.numbers)
        and needed[2] <= len(tree.present)
        and needed[3] <= len(tree.first)
        and needed[4] <= len(tree.curves)
    )


def tree_of(tree: Growth) -> Tree:
    """Make the final tree, with its quads numbered level by level, when all cells are done."""
    quads, _, unresolved, *_ = tree.counts.tolist()
    order = np.concatenate([*levels(tree.cells[:quads, :, IS_QUAD] == 1.0, tree.first[:, 0])])
    cells = tree.cells[order]
    is_quad = cells[:, :, IS_QUAD] == 1.0
    below, pieces = is_quad.sum(axis=1), cells[:, :, COUNT].sum(axis=1).astype(np.int64)
    return Tree(
        is_quad,
        cells[:, :, COUNT].astype(np.uint8),
        cells[:, :, WINDING].astype(np.int8),
        first_of(below, 1),
        first_of(pieces, 0),
        cells[:, :, COVERAGE].copy(),
        tree.curves[runs(tree.first[order, 1], pieces)].astype(np.int32),
        deviation=float(tree.deviation[0]),
        unresolved=unresolved,
    )


def first_of(lengths: NDArray[np.int64], start: int) -> NDArray[np.int32]:
    """First number of each run, if runs of these lengths follow one another; 0 for empty runs compresses better."""
    firsts = start + np.cumsum(lengths) - lengths
    return np.where(lengths > 0, firsts, 0).astype(np.int32)


def with_needed_room(tree: Growth) -> Growth:
    """Return the tree with larger arrays where the next cell has no room."""
    pieces, numbers, paths, quads, curves = tree.needed.tolist()
    points, path, listed, child, part, boxes, spans, cubics = tree.pool
    listed, child, part = (roomy(rows, numbers) for rows in (listed, child, part))
    return Growth(
        PiecePool(roomy(points, pieces), roomy(path, pieces), listed, child, part, boxes, spans, cubics),
        roomy(tree.present, paths),
        tree.stack,
        tree.corner,
        roomy(tree.cells, quads),
        roomy(tree.first, quads),
        roomy(tree.curves, curves),
        tree.counts,
        tree.deviation,
        tree.needed,
    )


def roomy(rows: NDArray[Any], needed: int) -> NDArray[Any]:
    """Return the array itself, or a longer copy if it has fewer rows than `needed`."""
    if needed <= len(rows):
        return rows
    out = np.empty((len(rows) + needed, *rows.shape[1:]), rows.dtype)
    out[: len(rows)] = rows
    return out
