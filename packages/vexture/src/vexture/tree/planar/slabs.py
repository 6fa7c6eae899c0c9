"""The pieces of a leaf between faces of different paints.

If borders touch only at their ends, counting windings along a horizontal line through the middle of a border gives the
faces on both its sides. All other cells are cut into slabs in which nothing crosses, and each is swept from the left.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import LATTICE
from vexture.tree.boundary import coincide, order_slab, slab_heights
from vexture.tree.crossings import x_at
from vexture.tree.leaf import keep_run
from vexture.tree.planar.borders import Borders, cross, set_left_edge
from vexture.tree.planar.faces import CellFaces, paint_of


class PlanarPieces(NamedTuple):
    """Pieces of a leaf, all going up, and the paints beside them."""

    curves: NDArray[np.float64]  # (room, 4, 2), in lattice units
    sides: NDArray[np.int64]  # (room, 2): paint on the left, paint on the right


@kernel(allocates=False)
def _add(pieces: PlanarPieces, count: int, curve: NDArray[np.float64], left: int, right: int) -> int:
    """Append a whole border, going up; return the new number of pieces."""
    turned = curve[3, 1] < curve[0, 1]
    for k in range(4):
        source = 3 - k if turned else k
        pieces.curves[count, k, 0], pieces.curves[count, k, 1] = curve[source, 0], curve[source, 1]
    pieces.sides[count, 0], pieces.sides[count, 1] = left, right
    return count + 1


@kernel(allocates=False)
def along_edge(curve: NDArray[np.float64]) -> bool:
    """Whether a border lies on the left or right edge of its cell, where it separates nothing in the cell."""
    return curve[0, 0] == curve[3, 0] and (curve[0, 0] == 0.0 or curve[0, 0] == LATTICE)


@kernel(allocates=False)
def beside(curve: NDArray[np.float64], other: NDArray[np.float64], y: float) -> int:
    """Side of `curve` at a height within both borders: 1 if `other` is left of it, -1 if right, 0 if unclear.

    The two do not cross. The control points of most pairs are separated by a line along the chord of `curve`.
    """
    if max(other[0, 0], other[3, 0]) <= min(curve[0, 0], curve[3, 0]):
        return 1
    if min(other[0, 0], other[3, 0]) >= max(curve[0, 0], curve[3, 0]):
        return -1
    dx, dy = curve[3, 0] - curve[0, 0], curve[3, 1] - curve[0, 1]
    low, high, other_low, other_high = 0.0, 0.0, np.inf, -np.inf
    for k in range(4):
        across = dx * (curve[k, 1] - curve[0, 1]) - dy * (curve[k, 0] - curve[0, 0])
        low, high = min(low, across), max(high, across)
        across = dx * (other[k, 1] - curve[0, 1]) - dy * (other[k, 0] - curve[0, 0])
        other_low, other_high = min(other_low, across), max(other_high, across)
    if other_low > high or other_high < low:
        return 1 if (other_low > high) == (dy > 0.0) else -1
    gap = x_at(curve, y) - x_at(other, y)
    return 1 if gap > 0.0 else -1 if gap < 0.0 else 0


@kernel(allocates=False)
def clean_borders(borders: Borders, count: int, cell_faces: CellFaces, out: PlanarPieces) -> int:
    """Write the pieces of borders that touch only at their ends; return how many, or -1 if their order is not clear."""
    layers, present, windings = cell_faces.layers, cell_faces.present, cell_faces.windings
    pieces = 0
    for i in range(count):
        curve = borders.curves[i]
        if curve[0, 1] == curve[3, 1] or along_edge(curve):
            continue
        y = 0.5 * (curve[0, 1] + curve[3, 1])
        key = set_left_edge(borders, count, layers, present, y, windings)
        for j in range(count):
            other = borders.curves[j]
            a, d = other[0, 1], other[3, 1]
            if j == i or not (min(a, d) <= y < max(a, d)) or along_edge(other):
                continue
            side = beside(curve, other, y)
            if side == 0:
                return -1
            if side > 0:
                key = cross(borders, j, -1 if d > a else 1, layers, present, windings, key)
        before = paint_of(cell_faces, key)
        key = cross(borders, i, -1 if curve[3, 1] > curve[0, 1] else 1, layers, present, windings, key)
        after = paint_of(cell_faces, key)
        if before != after:
            pieces = _add(out, pieces, curve, before, after)
    return pieces


class Roles(NamedTuple):
    """Paints beside each border in this slab and in the slab below, -1 without any, and the height they start at."""

    now: NDArray[np.int64]  # (borders, 2)
    before: NDArray[np.int64]  # (borders, 2)
    since: NDArray[np.float64]  # (borders,)


@kernel(allocates=False)
def _roles_in_slab(
    borders: Borders,
    active: NDArray[np.int64],
    spanning: int,
    x: NDArray[np.float64],
    height: float,
    cell_faces: CellFaces,
    key: int,
    roles: Roles,
) -> None:
    """Sweep a slab from its left edge, where the cell's windings and `key` are given; set the roles of its borders.

    Neighbours that coincide form a group. If a group has one paint on both sides, all its borders are dropped.
    Otherwise one border stays: preferably one that had the same role in the slab below, else the one that reaches
    highest.
    """
    layers, present, windings = cell_faces.layers, cell_faces.present, cell_faces.windings
    before = paint_of(cell_faces, key)
    first = 0
    while first < spanning:
        last = first
        while last < spanning and (last == first or coincide(x, active[first], active[last], height)):
            curve = borders.curves[active[last]]
            if not along_edge(curve):
                up = curve[3, 1] > curve[0, 1]
                key = cross(borders, active[last], -1 if up else 1, layers, present, windings, key)
            last += 1
        after = paint_of(cell_faces, key)
        if before != after:
            best, best_reach = -1, -1.0
            for m in range(first, last):
                i = active[m]
                curve = borders.curves[i]
                if along_edge(curve):
                    continue
                same = roles.before[i, 0] == before and roles.before[i, 1] == after
                reach = max(curve[0, 1], curve[3, 1]) + (2.0 * LATTICE if same else 0.0)
                if reach > best_reach:
                    best, best_reach = i, reach
            roles.now[best, 0], roles.now[best, 1] = before, after
        before, first = after, last


@kernel
def sweep(borders: Borders, count: int, cell_faces: CellFaces, most: int, out: PlanarPieces) -> int:
    """Write the pieces of borders that cross or coincide in part, slab by slab; return how many, or -1 above `most`."""
    layers, present, windings = cell_faces.layers, cell_faces.present, cell_faces.windings
    curves = borders.curves[:count]
    heights = slab_heights(curves)
    roles = Roles(np.full((count, 2), -1), np.full((count, 2), -1), np.zeros(count))
    active, x = np.empty(count, np.int64), np.empty((count, 3))
    pieces = 0
    for slab in range(len(heights)):
        low = heights[slab]
        for i in range(count):
            roles.now[i, 0], roles.now[i, 1] = -1, -1
        if slab + 1 < len(heights):
            high = heights[slab + 1]
            spanning = order_slab(curves, low, high, active, x)
            key = set_left_edge(borders, count, layers, present, low, windings)
            _roles_in_slab(borders, active, spanning, x, high - low, cell_faces, key, roles)
        for i in range(count):
            left, right = roles.before[i, 0], roles.before[i, 1]
            if roles.now[i, 0] == left and roles.now[i, 1] == right:
                continue
            if left >= 0 and pieces == most:
                return -1
            if left >= 0:
                keep_run(curves[i], -1, roles.since[i], low, out.curves[pieces])
                out.sides[pieces, 0], out.sides[pieces, 1] = left, right
                pieces += 1
            roles.before[i, 0], roles.before[i, 1], roles.since[i] = roles.now[i, 0], roles.now[i, 1], low
    return pieces
