"""From a drawing to a `CellTree`, level by level."""

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.monotone import Pieces, monotone_pieces
from vexture.drawing import Drawing
from vexture.errors import LimitError, SourceError
from vexture.kernels import kernel
from vexture.quadtree.boundary import crowded_area
from vexture.quadtree.leaf import NO_LEAF, Leaf, limit_leaf, own_leaf, resolved_leaf
from vexture.quadtree.level import Level, children
from vexture.quadtree.tree import CellKind, CellTree
from vexture.tolerance import CELL_SHARE, CLOSED, COARSEST, DETAIL_SHARE, FINEST

__all__ = ["DEPTH_RANGE", "auto_tolerance", "build", "gather"]

DEPTH_RANGE = (1, 20)
"""Depth limits that a caller may ask for; float32 shaders resolve no more."""

CROWDED = 8
"""Pieces in a cell above which it is resolved only if its boundary meets the cell's edge exactly twice."""

HOPELESS = 160
"""Pieces in a cell above which it is not resolved at all: resolving looks at every pair."""

CURVE, QUAD, CORNER, FULL, EMPTY = (int(kind) for kind in CellKind)


@kernel
def _ends_on_edge(pieces: Pieces, first: int, last: int, x0: float, y0: float, size: float) -> int:
    """Number of ends of chains on the cell's edge: of ends there that the next piece does not go on from."""
    count = 0
    for i in range(first, last):
        for end in (0, 3):
            neighbour = i - 1 if end == 0 else i + 1
            x, y = pieces.points[i, end, 0], pieces.points[i, end, 1]
            if x != x0 and x != x0 + size and y != y0 and y != y0 + size:
                continue
            if first <= neighbour < last and (
                pieces.points[neighbour, 3 - end, 0] == x and pieces.points[neighbour, 3 - end, 1] == y
            ):
                continue
            count += 1
    return count


@kernel
def _leaf_of(
    level: Level,
    c: int,
    cubics: NDArray[np.float64],
    rules: NDArray[np.int64],
    size: float,
    tolerance: float,
    at_limit: bool,
) -> Leaf:
    """Leaf of cell c, or `NO_LEAF` to divide it."""
    first, last = level.piece_at[c], level.piece_at[c + 1]
    present = level.present[level.path_at[c] : level.path_at[c + 1]]
    x0, y0 = level.origin[c, 0], level.origin[c, 1]
    leaf = Leaf(NO_LEAF, np.zeros((4, 2)), 0.0, 0.0)
    if len(present) == 1:
        leaf = own_leaf(level.pieces, first, last, cubics, present[0, 1], rules[present[0, 0]], x0, y0, size)
    count = last - first
    simple = count <= CROWDED or _ends_on_edge(level.pieces, first, last, x0, y0, size) == 2
    if leaf.kind == NO_LEAF and count <= HOPELESS and (simple or at_limit):
        leaf = resolved_leaf(level.pieces, first, last, present, cubics, rules, x0, y0, size, tolerance / size)
    if leaf.kind == NO_LEAF and at_limit:
        if count <= HOPELESS:
            leaf = limit_leaf(level.pieces, first, last, present, rules, x0, y0, size)
        else:
            area = crowded_area(level.pieces, first, last, present, rules, x0, y0, size)
            leaf = Leaf(FULL if area > 0.5 else EMPTY, np.zeros((4, 2)), area, np.sqrt(2.0))
        return Leaf(-2 - leaf.kind, leaf.curve, leaf.coverage, leaf.distance)  # marked as unresolved
    return leaf


@kernel
def _add_quads(
    kind: NDArray[np.uint8],
    ref: NDArray[np.int32],
    coverage: NDArray[np.float64],
    level: Level,
    split_cells: NDArray[np.bool_],
    constant: NDArray[np.int64],
    quad: int,
) -> None:
    """Enter the quads that cells of a level become, and those of their cells that are constant."""
    new = 0
    for c in range(len(split_cells)):
        if split_cells[c]:
            if level.slot[c] >= 0:
                kind[level.slot[c] // 4, level.slot[c] % 4] = QUAD
                ref[level.slot[c] // 4, level.slot[c] % 4] = quad + new
            for k in range(4):
                if constant[4 * new + k] >= 0:
                    is_full = constant[4 * new + k] == 1
                    kind[quad + new, k] = FULL if is_full else EMPTY
                    coverage[quad + new, k] = 1.0 if is_full else 0.0
            new += 1


@kernel
def _grow(
    level: Level,
    cubics: NDArray[np.float64],
    rules: NDArray[np.int64],
    tolerance: float,
    cell_share: float,
    max_depth: int,
) -> tuple[NDArray[np.uint8], NDArray[np.int32], NDArray[np.float64], NDArray[np.float64], tuple[float, int]]:
    """Divide the unit square level by level until every cell is a leaf."""
    kind, ref = np.full((0, 4), EMPTY, np.uint8), np.full((0, 4), -1, np.int32)
    coverage = np.zeros((0, 4))
    curves = np.empty((0, 4, 2))
    curve_count, unresolved, deviation, size = 0, 0, 0.0, 1.0
    for depth in range(max_depth + 1):
        cells = len(level.slot)
        split_cells = np.zeros(cells, np.bool_)
        if curve_count + cells > len(curves):
            curves = np.concatenate((curves, np.empty((curve_count + cells, 4, 2))))
        for c in range(cells):
            if depth == 0:  # the root is always a quad
                split_cells[c] = True
                continue
            cell_tolerance = min(tolerance, cell_share * size)
            leaf = _leaf_of(level, c, cubics, rules, size, cell_tolerance, depth == max_depth)
            leaf_kind = leaf.kind
            if leaf_kind < NO_LEAF:
                leaf_kind = -2 - leaf_kind
                unresolved += 1
            split_cells[c] = leaf_kind == NO_LEAF
            if leaf_kind != NO_LEAF:
                quad, k = level.slot[c] // 4, level.slot[c] % 4
                kind[quad, k], coverage[quad, k] = leaf_kind, leaf.coverage
                deviation = max(deviation, leaf.distance * size)
                if leaf_kind in (CURVE, CORNER):
                    ref[quad, k] = curve_count
                    curves[curve_count] = leaf.curve
                    curve_count += 1
        new = split_cells.sum()
        if new == 0:
            break
        quad = len(kind)
        constant = np.empty(4 * new, np.int64)
        below = children(level, split_cells, rules, size, quad, constant)
        kind = np.concatenate((kind, np.full((new, 4), EMPTY, np.uint8)))
        ref = np.concatenate((ref, np.full((new, 4), -1, np.int32)))
        coverage = np.concatenate((coverage, np.zeros((new, 4))))
        _add_quads(kind, ref, coverage, level, split_cells, constant, quad)
        level = below
        size *= 0.5
    for quad in range(len(kind) - 1, -1, -1):
        for k in range(4):
            if kind[quad, k] == QUAD:
                coverage[quad, k] = coverage[ref[quad, k]].mean()
    return kind, ref, coverage, curves[:curve_count].copy(), (deviation, unresolved)


def gather(drawing: Drawing) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    """Cubics of a drawing, (n, 4, 2), the path of each, (n,), and the paths' fill rules, (paths,)."""
    contours = [contour for path in drawing.paths for contour in path.contours]
    cubics = np.concatenate(contours) if contours else np.empty((0, 4, 2))
    lengths = [sum(map(len, path.contours)) for path in drawing.paths]
    owner = np.repeat(np.arange(len(lengths), dtype=np.int64), lengths)
    return cubics, owner, np.array([int(path.fill_rule) for path in drawing.paths], dtype=np.int64)


def auto_tolerance(cubics: NDArray[np.float64]) -> float:
    """Tolerance that follows the smallest detail of a drawing (thesis 5.2.1), in unit-square units.

    A share of the extent of its smallest cubic, within limits: no coarser than what shows at usual sizes, no finer
    than what a depth limit can use.

    Examples
    --------
    >>> auto_tolerance(np.empty((0, 4, 2))) == COARSEST
    True
    """
    if not len(cubics):
        return COARSEST
    extent = np.ptp(cubics, axis=1).max(axis=1)
    return float(np.clip(DETAIL_SHARE * extent.min(), FINEST, COARSEST))


def _root(drawing: Drawing, pieces: Pieces) -> Level:
    """The unit square as the only cell of its level; every path has corner winding 0 there."""
    ends = pieces.points[:, [0, 3]]
    worst = np.abs(ends - np.clip(ends, 0.0, 1.0)).max()
    if worst > CLOSED:
        raise SourceError(f"{drawing.name}: a curve leaves the unit square by {worst:.3g}; clip or scale it first")
    pieces.points[:, [0, 3]] = np.clip(ends, 0.0, 1.0)
    paths = np.unique(pieces.path)
    return Level(
        np.zeros((1, 2)),
        np.full(1, -1),
        np.array([0, len(pieces.path)]),
        np.array([0, len(paths)]),
        pieces,
        np.column_stack((paths, np.zeros_like(paths))),
    )


def build(drawing: Drawing, tolerance: float | Literal["auto"] = "auto", max_depth: int = 10) -> CellTree:
    """Quad-tree of a drawing's silhouette, with thesis leaves found directly from its cubics.

    Parameters
    ----------
    drawing : Drawing
        In normal form.
    tolerance : float or "auto"
        Largest distance between the drawing's outline and a leaf's, in unit-square units. "auto" follows the
        smallest detail of the drawing and the size of the cell.
    max_depth : int
        Cells of this depth are not divided further; the unit square has depth 0.

    Returns
    -------
    CellTree

    Raises
    ------
    LimitError
        If a parameter is out of range.
    SourceError
        If the drawing leaves the unit square.

    Examples
    --------
    >>> tree = build(Drawing.polygon([(0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.2, 0.8)]))
    >>> len(tree.kind), len(tree.curves), round(float(tree.quad_coverage[0]), 4)
    (1, 4, 0.36)
    """
    if tolerance != "auto" and not 0.0 < tolerance < 1.0:
        raise LimitError(f"tolerance {tolerance} is not between 0 and 1 (unit-square units); use auto or e.g. 0.0005")
    low, high = DEPTH_RANGE
    if not low <= max_depth <= high:
        raise LimitError(f"depth limit {max_depth} is outside {low}..{high}; the default is 10")
    cubics, owner, rules = gather(drawing)
    pieces = monotone_pieces(cubics, owner)
    if not len(pieces.path):
        nothing = np.full((1, 4), EMPTY, np.uint8)
        return CellTree(nothing, np.full((1, 4), -1, np.int32), np.zeros((1, 4)), np.empty((0, 4, 2)), 0.0, 0)
    share = CELL_SHARE if tolerance == "auto" else np.inf
    distance = auto_tolerance(cubics) if tolerance == "auto" else float(tolerance)
    kind, ref, coverage, curves, (deviation, unresolved) = _grow(
        _root(drawing, pieces), cubics, rules, distance, share, max_depth
    )
    return CellTree(kind, ref, coverage, curves, deviation, unresolved)
