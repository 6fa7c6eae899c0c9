"""From a drawing to a `PackedTree`, level by level."""

import math

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.monotone import monotone_pieces
from vexture.drawing import Drawing
from vexture.errors import LimitError
from vexture.kernels import kernel
from vexture.quadtree.build import MOST_QUADS, gather, root_level, with_room
from vexture.quadtree.level import Level, children
from vexture.quadtree.packed_leaf import DIVIDE, packed_leaf
from vexture.quadtree.tree import LATTICE, MOST_CURVES, MOST_DEPTH, PackedTree

__all__ = ["DEFAULT_CAPACITY", "DEFAULT_DEPTH", "build_packed"]

DEFAULT_CAPACITY = 4
"""Pieces in a leaf."""

DEFAULT_DEPTH = 16
"""Cells of a leaf's lattice at most: 1.5e-5 of the drawing."""

IS_QUAD, COUNT, WINDING, COVERAGE = range(4)
"""Columns of the cells while the tree grows."""


@kernel
def grow_packed(
    level: Level, rules: NDArray[np.int64], capacity: int, least_depth: int, max_depth: int, most_quads: int
) -> tuple[NDArray[np.float64], NDArray[np.float64], int]:
    """Divide the unit square level by level until every cell is a leaf.

    Returned are the cells, (quads, 4, 4): whether a quad, count, corner winding, coverage; the curves; unresolved. If
    that takes more than `most_quads`, nothing but the number needed so far, negative, as the last.
    """
    cells, quads = np.zeros((16, 4, 4)), 0
    curves, curve_count = np.empty((16, 4, 2)), 0
    unresolved, size = 0, 1.0
    for depth in range(max_depth + 1):
        count = len(level.slot)
        split_cells, split_count = np.zeros(count, np.bool_), 0
        for c in range(count):
            if depth < least_depth:
                split_cells[c] = True
                split_count += 1
                continue
            curves = with_room(curves, curve_count, MOST_CURVES)
            leaf = packed_leaf(
                level.pieces,
                level.piece_at[c],
                level.piece_at[c + 1],
                level.present[level.path_at[c] : level.path_at[c + 1]],
                rules,
                level.origin[c, 0],
                level.origin[c, 1],
                size,
                capacity,
                depth == max_depth,
                curves[curve_count:],
            )
            if leaf.count == DIVIDE:
                split_cells[c] = True
                split_count += 1
                continue
            cell = cells[level.slot[c] // 4, level.slot[c] % 4]
            cell[COUNT], cell[WINDING], cell[COVERAGE] = leaf.count, leaf.winding, leaf.coverage
            curve_count += leaf.count
            unresolved += 0 if leaf.resolved else 1
        if split_count == 0:
            break
        if quads + split_count > most_quads:
            return cells[:0], curves[:0], -(quads + split_count)
        cells = with_room(cells, quads, split_count)
        first_quad = quads
        for c in range(count):
            if split_cells[c]:
                if level.slot[c] >= 0:
                    cells[level.slot[c] // 4, level.slot[c] % 4, IS_QUAD] = 1.0
                for k in range(4):
                    for column in range(4):
                        cells[quads, k, column] = 0.0
                quads += 1
        grain = 0.5 ** max(depth + 1, least_depth) / LATTICE
        level, full = children(level, split_cells, split_count, rules, size, grain, first_quad)
        for slot in full:
            cells[slot // 4, slot % 4, COVERAGE] = 1.0
        size *= 0.5
    last = quads
    for quad in range(quads - 1, -1, -1):
        for k in range(3, -1, -1):
            if cells[quad, k, IS_QUAD] == 1.0:
                last -= 1
                below = cells[last]
                total = below[0, COVERAGE] + below[1, COVERAGE] + below[2, COVERAGE] + below[3, COVERAGE]
                cells[quad, k, COVERAGE] = 0.25 * total
    return cells[:quads], curves[:curve_count], unresolved


def build_packed(
    drawing: Drawing,
    *,
    tolerance: float = 0.0,
    max_depth: int = DEFAULT_DEPTH,
    capacity: int = DEFAULT_CAPACITY,
    precision: float | None = None,
    most_quads: int = MOST_QUADS,
) -> PackedTree:
    """Quad-tree of a drawing's silhouette, with packed leaves.

    Parameters
    ----------
    drawing : Drawing
        In normal form.
    tolerance : float
        Largest distance between the drawing's outline and a leaf's before quantisation, in unit-square units; within
        it chains of pieces become one cubic. 0 keeps every piece.
    max_depth : int
        Cells of this depth are not divided further; the unit square has depth 0.
    capacity : int
        Pieces in a leaf, 1 to 15; more only at the depth limit, or where all of them meet at one point.
    precision : float or None
        Largest displacement by quantisation, in unit-square units: leaves with curves are made as small as that takes.
        None forces no depth.
    most_quads : int
        A tree that needs more is given up.

    Returns
    -------
    PackedTree

    Raises
    ------
    LimitError
        If a parameter is out of range, or the tree too large.
    SourceError
        If the drawing leaves the unit square.

    Examples
    --------
    >>> tree = build_packed(Drawing.polygon([(0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.2, 0.8)]))
    >>> len(tree.count), len(tree.curves), round(float(tree.coverage[0].mean()), 4)
    (1, 4, 0.36)
    """
    if not 1 <= max_depth <= MOST_DEPTH:
        raise LimitError(f"depth limit {max_depth} is outside 1..{MOST_DEPTH}; the default is {DEFAULT_DEPTH}")
    if not 1 <= capacity <= MOST_CURVES:
        raise LimitError(f"capacity {capacity} is outside 1..{MOST_CURVES}; the default is {DEFAULT_CAPACITY}")
    finest = 0.5**max_depth / LATTICE
    if precision is not None and not finest <= precision <= 1.0:
        raise LimitError(
            f"precision {precision:g} is outside {finest:.1e}..1; allow a larger --max-depth for a finer one"
        )
    least_depth = 1 if precision is None else max(math.ceil(-math.log2(precision * LATTICE)), 1)
    cubics, owner, rules = gather(drawing)
    pieces = monotone_pieces(cubics, owner)
    cells, curves, unresolved = np.zeros((1, 4, 4)), np.empty((0, 4, 2)), 0
    if len(pieces.path):
        level = root_level(drawing, pieces)
        cells, curves, unresolved = grow_packed(level, rules, capacity, least_depth, max_depth, most_quads)
    if unresolved < 0:
        raise LimitError(
            f"{drawing.name}: {-unresolved} quads at least; the limit is {most_quads}; "
            "use a smaller --max-depth, a larger --tolerance or a larger --precision"
        )
    quads_in, curves_in = cells[:, :, IS_QUAD].sum(axis=1), cells[:, :, COUNT].sum(axis=1)
    return PackedTree(
        cells[:, :, IS_QUAD] == 1.0,
        cells[:, :, COUNT].astype(np.uint8),
        cells[:, :, WINDING].astype(np.int8),
        (1 + np.cumsum(quads_in) - quads_in).astype(np.int32),
        (np.cumsum(curves_in) - curves_in).astype(np.int32),
        cells[:, :, COVERAGE].copy(),
        curves.astype(np.int32),
        0.0,
        unresolved,
    )
