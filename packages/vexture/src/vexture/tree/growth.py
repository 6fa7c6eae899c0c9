"""The tree while it grows: arrays with spare rows, which kernels fill one after another."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import MOST_CURVES
from vexture.bezier.split import copy_curve
from vexture.tree.divide import PARTS, RUN, PiecePool
from vexture.tree.tree import Tree

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
    curves: NDArray[np.int32]  # (room, 4, 2), in lattice units
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


@kernel
def longer(rows: NDArray[Any], needed: int) -> NDArray[Any]:
    """Return the array itself, or a longer copy if it has fewer rows than `needed`."""
    if needed <= len(rows):
        return rows
    out = np.empty((len(rows) + needed, *rows.shape[1:]), rows.dtype)
    for i in range(rows.size):  # a slice brings the text of an error, and with it much of Numba's run time
        out.flat[i] = rows.flat[i]
    return out


@kernel
def with_room(tree: Growth) -> Growth:
    """Return the tree with larger arrays where the next cell has no room, as `has_room` wrote."""
    pool, needed = tree.pool, tree.needed
    return Growth(
        PiecePool(
            longer(pool.points, needed[0]),
            longer(pool.path, needed[0]),
            longer(pool.numbers, needed[1]),
            longer(pool.child, needed[1]),
            longer(pool.part, needed[1]),
            pool.boxes,
            pool.runs,
            pool.cubics,
        ),
        longer(tree.present, needed[2]),
        tree.stack,
        tree.corner,
        longer(tree.cells, needed[3]),
        longer(tree.first, needed[3]),
        longer(tree.curves, needed[4]),
        tree.counts,
        tree.deviation,
        needed,
    )


def growth_from(values: Any) -> Growth:
    """Make a `Growth` from the plain tuples that code compiled ahead of time returns."""
    return Growth(PiecePool(*values[0]), *values[1:])


@kernel
def number_quads(cells: NDArray[np.float64], first: NDArray[np.int64], quads: int) -> NDArray[np.int64]:
    """Quads level by level, in the order of their parents and of the parents' cells, (quads,)."""
    order, end = np.zeros(quads, np.int64), 1
    for i in range(quads):
        below = first[order[i], 0]
        for k in range(4):
            if cells[order[i], k, IS_QUAD] == 1.0:
                order[end] = below
                below, end = below + 1, end + 1
    return order


TreeArrays = tuple[
    NDArray[np.bool_],
    NDArray[np.uint8],
    NDArray[np.int8],
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.float64],
    NDArray[np.int32],
]
"""The first fields of a `Tree`."""


@kernel(ahead=True)
def arrange_tree(
    cells: NDArray[np.float64], first: NDArray[np.int64], curves: NDArray[np.int32], counts: NDArray[np.int64]
) -> TreeArrays:
    """Arrays of a tree whose cells are all done, with its quads numbered level by level."""
    quads = counts[QUADS]
    order = number_quads(cells, first, quads)
    is_quad, count = np.empty((quads, 4), np.bool_), np.empty((quads, 4), np.uint8)
    winding, coverage = np.empty((quads, 4), np.int8), np.empty((quads, 4))
    first_quad, first_curve = np.zeros(quads, np.int32), np.zeros(quads, np.int32)
    out = np.empty((counts[CURVES], 4, 2), np.int32)
    quad, curve = 1, 0
    for i in range(quads):
        below, pieces = 0, 0
        for k in range(4):
            cell = cells[order[i], k]
            is_quad[i, k], count[i, k], winding[i, k] = cell[IS_QUAD] == 1.0, int(cell[COUNT]), int(cell[WINDING])
            coverage[i, k] = cell[COVERAGE]
            below, pieces = below + int(cell[IS_QUAD]), pieces + int(cell[COUNT])
        # 0 compresses better where there is none
        first_quad[i], first_curve[i] = quad if below > 0 else 0, curve if pieces > 0 else 0
        for c in range(pieces):
            copy_curve(curves[first[order[i], 1] + c], out[curve + c])
        quad, curve = quad + below, curve + pieces
    return is_quad, count, winding, first_quad, first_curve, coverage, out


def tree_of(tree: Growth) -> Tree:
    """Make the final tree when all cells are done."""
    arrays = arrange_tree(tree.cells, tree.first, tree.curves, tree.counts)
    return Tree(*arrays, deviation=float(tree.deviation[0]), unresolved=int(tree.counts[UNRESOLVED]))
