"""Build the `CellTree` of a drawing, level by level."""

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import LimitError, ParameterError, SourceError
from vexture.base.kernels import kernel
from vexture.base.layout import MOST_DEPTH
from vexture.base.tolerance import CLOSED
from vexture.bezier.monotone import Pieces, monotone_pieces
from vexture.bezier.split import copy_curve
from vexture.drawing.drawing import Drawing
from vexture.thesis.accuracy import Accuracy, accuracy_of, cell_tolerance
from vexture.thesis.boundary_chain import Chain, cell_chain, plain_chain
from vexture.thesis.leaf import (
    CORNER,
    CURVE,
    EMPTY,
    FULL,
    NO_LEAF,
    QUAD,
    ThesisLeaf,
    chain_leaf,
    limit_leaf,
    nearest_constant,
    no_leaf,
    own_leaf,
)
from vexture.thesis.sample_and_fit import build_sampled
from vexture.thesis.subdivide import LevelCell, ThesisLevel, cell_of, children
from vexture.thesis.tree import CellTree
from vexture.tree.boundary import MOST_RESOLVED, crowded_area
from vexture.tree.bounds import check_whole
from vexture.tree.cubics import gather
from vexture.tree.tree import MOST_QUADS

DEFAULT_DEPTH = 10
"""Default depth limit: its cells have a thousandth of the drawing's width."""

CROWDED = 8
"""Number of pieces above which a cell is resolved only if its boundary meets the cell's edge exactly twice."""


@kernel
def _ends_on_edge(cell: LevelCell) -> int:
    """Number of ends of chains on the cell's edge: ends of pieces that no neighbouring piece continues."""
    points, count = cell.pieces.points, 0
    for i in range(len(points)):
        for end in (0, 3):
            neighbour = i - 1 if end == 0 else i + 1
            x, y = points[i, end, 0], points[i, end, 1]
            if x != cell.x0 and x != cell.x0 + cell.size and y != cell.y0 and y != cell.y0 + cell.size:
                continue
            if 0 <= neighbour < len(points) and (
                points[neighbour, 3 - end, 0] == x and points[neighbour, 3 - end, 1] == y
            ):
                continue
            count += 1
    return count


@kernel
def _leaf_or_limit(
    chain: Chain, cubics: NDArray[np.float64], cell: LevelCell, tolerance: float, at_limit: bool
) -> ThesisLeaf:
    """Leaf of a chain; never `NO_LEAF` at the depth limit."""
    leaf = chain_leaf(chain, cubics, cell, tolerance / cell.size)
    if leaf.kind == NO_LEAF and at_limit:
        return limit_leaf(chain)
    return leaf


@kernel
def _leaf_of(
    cell: LevelCell, cubics: NDArray[np.float64], rules: NDArray[np.int64], tolerance: float, at_limit: bool
) -> ThesisLeaf:
    """Leaf of a cell, or `NO_LEAF` if the cell must be divided."""
    pieces, count = cell.pieces, len(cell.pieces.path)
    if len(cell.present) == 1:
        leaf = own_leaf(cell, cubics, rules)
        if leaf.kind != NO_LEAF:
            return leaf
        if count <= MOST_RESOLVED:
            chain = plain_chain(cell, rules)
            if chain.chains < 2:
                return _leaf_or_limit(chain, cubics, cell, tolerance, at_limit)
    if count > MOST_RESOLVED:
        if at_limit:
            area = crowded_area(pieces.points, pieces.path, cell.present, rules, cell.x0, cell.y0, cell.size)
            return nearest_constant(area)
        return no_leaf()
    if not at_limit and count > CROWDED and _ends_on_edge(cell) != 2:
        return no_leaf()
    return _leaf_or_limit(cell_chain(cell, rules), cubics, cell, tolerance, at_limit)


@kernel
def _add_quads(cells: NDArray[np.float64], level: ThesisLevel, split_cells: NDArray[np.bool_], quad: int) -> int:
    """Append a quad with empty cells for each divided cell of a level; return the new number of quads."""
    for c in range(len(split_cells)):
        if split_cells[c]:
            if level.slot[c] >= 0:
                slot = cells[level.slot[c] // 4, level.slot[c] % 4]
                slot[0], slot[1] = QUAD, quad
            for k in range(4):
                cells[quad, k, 0], cells[quad, k, 1], cells[quad, k, 2] = EMPTY, -1.0, 0.0
            quad += 1
    return quad


@kernel
def _with_room(rows: NDArray[np.float64], count: int, room: int) -> NDArray[np.float64]:
    """Return the rows, or a copy twice as large if there is no room for `room` more after the first `count`."""
    if count + room <= len(rows):
        return rows
    out = np.empty((2 * count + room, rows.shape[1], rows.shape[2]))
    for i in range(count):
        for j in range(rows.shape[1]):
            for k in range(rows.shape[2]):
                out[i, j, k] = rows[i, j, k]
    return out


@kernel
def grow(
    level: ThesisLevel,
    cubics: NDArray[np.float64],
    rules: NDArray[np.int64],
    accuracy: Accuracy,
    max_depth: int,
    most_quads: int,
) -> tuple[NDArray[np.float64], NDArray[np.float64], float, int]:
    """Divide the unit square level by level until every cell is a leaf.

    Returns the cells (quads, 4, 3), which are kind, reference and coverage, the curves, the deviation, and the number
    of unresolved cells. If the tree needs more than `most_quads`, the arrays are empty, and the last value is minus the
    number of quads so far.
    """
    cells, quads = np.empty((16, 4, 3)), 0
    curves, curve_count = np.empty((16, 4, 2)), 0
    unresolved, deviation, size = 0, 0.0, 1.0
    for depth in range(max_depth + 1):
        count = len(level.slot)
        split_cells, split_count = np.zeros(count, np.bool_), 0
        curves = _with_room(curves, curve_count, count)
        for c in range(count):
            tolerance = cell_tolerance(accuracy, size)
            leaf = no_leaf()
            if depth > 0:  # the root is always a quad
                leaf = _leaf_of(cell_of(level, c, size), cubics, rules, tolerance, depth == max_depth)
            if leaf.kind == NO_LEAF:
                split_cells[c] = True
                split_count += 1
                continue
            slot = cells[level.slot[c] // 4, level.slot[c] % 4]
            slot[0], slot[2] = leaf.kind, leaf.coverage
            deviation = max(deviation, leaf.distance * size)
            unresolved += 0 if leaf.resolved else 1
            if leaf.kind in (CURVE, CORNER):
                slot[1] = curve_count
                copy_curve(leaf.curve, curves[curve_count])
                curve_count += 1
        if split_count == 0:
            break
        if quads + split_count > most_quads:
            return cells[:0], curves[:0], 0.0, -(quads + split_count)
        cells = _with_room(cells, quads, split_count)
        first_quad = quads
        quads = _add_quads(cells, level, split_cells, first_quad)
        level, full = children(level, split_cells, rules, size, first_quad)
        for slot_index in full:
            cell = cells[slot_index // 4, slot_index % 4]
            cell[0], cell[2] = FULL, 1.0
        size *= 0.5
    for quad in range(quads - 1, -1, -1):
        for k in range(4):
            if cells[quad, k, 0] == QUAD:
                below = cells[int(cells[quad, k, 1])]
                cells[quad, k, 2] = 0.25 * (below[0, 2] + below[1, 2] + below[2, 2] + below[3, 2])
    return cells[:quads], curves[:curve_count], deviation, unresolved


def root_level(drawing: Drawing, pieces: Pieces) -> ThesisLevel:
    """Level with the unit square as its only cell, in which the corner winding of every path is 0."""
    ends = pieces.points[:, [0, 3]]
    worst = np.abs(ends - np.clip(ends, 0.0, 1.0)).max()
    if not worst <= CLOSED:  # NaN counts as outside
        raise SourceError(f"{drawing.name}: a curve leaves the unit square by {worst:.3g}; clip or scale it first")
    pieces.points[:, [0, 3]] = np.clip(ends, 0.0, 1.0)
    paths = np.unique(pieces.path)
    return ThesisLevel(
        np.zeros((1, 2)),
        np.full(1, -1),
        np.array([0, len(pieces.path)]),
        np.array([0, len(paths)]),
        pieces,
        np.column_stack((paths, np.zeros_like(paths))),
    )


def build(
    drawing: Drawing,
    tolerance: float | Literal["auto"] = "auto",
    max_depth: int = DEFAULT_DEPTH,
    strategy: Literal["direct", "sampled"] = "direct",
    step: float = 0.0,
    most_quads: int = MOST_QUADS,
) -> CellTree:
    """Build the quad-tree of a drawing in normal form; other parameters and errors as in `vexture.thesis.convert`.

    `step` is the share of a cell by which an encoding's quantisation moves an outline; the tolerance "auto" is no
    finer. A tree with more than `most_quads` quads raises a `LimitError`.

    Raises
    ------
    SourceError
        If the drawing leaves the unit square.

    Examples
    --------
    >>> tree = build(Drawing.polygon([(0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.2, 0.8)]))
    >>> len(tree.kind), len(tree.curves), round(float(tree.quad_coverage[0]), 4)
    (1, 4, 0.36)
    """
    if strategy not in ("direct", "sampled"):
        raise ParameterError(f"`strategy` is {strategy!r}; it must be 'direct' or 'sampled'")
    check_whole("max_depth", max_depth, MOST_DEPTH, DEFAULT_DEPTH)
    cubics, owner, rules = gather(drawing)
    accuracy = accuracy_of(tolerance, cubics, step)
    pieces = monotone_pieces(cubics, owner)
    if not len(pieces.path):
        nothing = np.full((1, 4), EMPTY, np.uint8)
        return CellTree(nothing, np.full((1, 4), -1, np.int32), np.zeros((1, 4)), np.empty((0, 4, 2)), 0.0, 0)
    if strategy == "sampled":
        return build_sampled(drawing, cubics, owner, rules, accuracy, max_depth)
    cells, curves, deviation, unresolved = grow(
        root_level(drawing, pieces), cubics, rules, accuracy, max_depth, most_quads
    )
    if unresolved < 0:
        raise LimitError(
            f"{drawing.name}: {-unresolved} quads at least; the limit is {most_quads}; "
            "use `bits` 16, a smaller `max_depth` or a larger `tolerance`"
        )
    kind, ref, coverage = cells[:, :, 0].astype(np.uint8), cells[:, :, 1].astype(np.int32), cells[:, :, 2].copy()
    return CellTree(kind, ref, coverage, curves.copy(), deviation, unresolved)
