"""Mean colours of leaves: exact areas of faces times their exact colours, or for gradients means over sample points.

Means of pictures are in `picture_means`.
"""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import LATTICE
from vexture.bezier.area import integral_x_dy
from vexture.tree.boundary import sort_order
from vexture.tree.crossings import x_at
from vexture.tree.divide import Cell, PiecePool
from vexture.tree.planar.borders import key_of
from vexture.tree.planar.compose import colour_at
from vexture.tree.planar.faces import CellFaces, FaceTable, face_of, operations_of, stack_of
from vexture.tree.planar.layers import PlanarLayers
from vexture.tree.planar.picture_means import add_picture_mean, face_at, holds_picture
from vexture.tree.planar.slabs import PlanarPieces
from vexture.tree.winding import inside

SCANLINES = 64
"""Horizontal lines along which a cell with too many pieces to resolve is measured."""

GOLDEN = 0.6180339887498949
"""Golden ratio minus 1. Points (k / n, frac(k GOLDEN)) are spread evenly, and no line of a hard stop meets many of
them (Niederreiter, "Random Number Generation and Quasi-Monte Carlo Methods", 3)."""

MOST_POINTS, LEAST_POINTS = 1024, 32
"""Sample points in a leaf of gradients. Their number is proportional to the leaf's width, within these limits."""


@kernel(allocates=False)
def _area(curve: NDArray[np.float64]) -> float:
    """Share of its leaf's area that a piece adds to its left face and takes from its right one."""
    area = (curve[0, 1] - curve[3, 1]) / LATTICE + integral_x_dy(curve) / LATTICE**2
    area += 1.0 - curve[0, 1] / LATTICE if curve[0, 0] == 0.0 else 0.0
    area -= 1.0 - curve[3, 1] / LATTICE if curve[3, 0] == 0.0 else 0.0
    return area


@kernel
def _add_colour(
    layers: PlanarLayers,
    faces: FaceTable,
    face: int,
    middle: tuple[float, float],
    size: tuple[float, float],
    share: float,
    mean: NDArray[np.float64],
) -> None:
    """Add a share of a face's colour over a box to a mean."""
    if faces.program[face] == 0:
        for c in range(4):
            mean[c] += share * faces.rgba[face, c]
        return
    count, ops, _ = operations_of(layers, stack_of(faces, face))
    colour = np.empty(4)
    colour_at(layers, ops, count, middle, size, np.empty((count + 1, 4)), colour)
    for c in range(4):
        mean[c] += share * colour[c]


@kernel(allocates=False)
def set_flat_mean(pieces: PlanarPieces, count: int, base: int, faces: FaceTable, mean: NDArray[np.float64]) -> bool:
    """Write the mean colour of a leaf without its programs; return whether it has programs."""
    holds_program = faces.program[base] != 0
    for c in range(4):
        mean[c] = faces.rgba[base, c]
    for k in range(count):
        area, left, right = _area(pieces.curves[k]), pieces.sides[k, 0], pieces.sides[k, 1]
        holds_program = holds_program or faces.program[left] != 0 or faces.program[right] != 0
        for c in range(4):
            mean[c] += area * (faces.rgba[left, c] - faces.rgba[right, c])
    if not holds_program:
        _hold(mean)
    return holds_program


@kernel(allocates=False)
def _hold(mean: NDArray[np.float64]) -> None:
    """Limit a colour to 0..1."""
    for c in range(4):
        mean[c] = min(max(mean[c], 0.0), 1.0)


@kernel
def add_programs(
    pieces: PlanarPieces,
    count: int,
    base: int,
    cell: Cell,
    layers: PlanarLayers,
    faces: FaceTable,
    mean: NDArray[np.float64],
) -> None:
    """Add the colours of a leaf's programs to its mean: each program's mean over its sample points, times its area."""
    found, areas, n = np.full(2 * count + 1, -1), np.zeros(2 * count + 1), 0
    for k in range(2 * count + 1):
        side = k - 1
        face = base if k == 0 else pieces.sides[side >> 1, side & 1]
        if faces.program[face] != 0:
            area = 1.0 if k == 0 else _area(pieces.curves[side >> 1]) * (1.0 if side & 1 == 0 else -1.0)
            at = 0
            while at < n and found[at] != face:
                at += 1
            n = max(n, at + 1)
            found[at] = face
            areas[at] += area
    points = max(int(MOST_POINTS * cell.size), LEAST_POINTS)
    inside_of = _faces_at(pieces, count, base, points)
    colour, total = np.empty(4), np.empty(4)
    for at in range(n):
        operations, ops, _ = operations_of(layers, stack_of(faces, found[at]))
        if holds_picture(layers, ops, operations):
            add_picture_mean(pieces, count, base, cell, layers, (found[at], operations, ops), areas[at], mean)
            continue
        work, met = np.empty((operations + 1, 4)), 0
        for c in range(4):  # a slice would bring much of Numba's run time
            total[c] = 0.0
        for k in range(points):
            is_last_chance = k == points - 1 and met == 0  # a face that holds no sample point
            if inside_of[k] == found[at] or is_last_chance:
                x, y = cell.x + cell.size * (k + 0.5) / points, cell.y + cell.size * (k * GOLDEN % 1.0)
                colour_at(layers, ops, operations, (x, y), (0.0, 0.0), work, colour)
                met += 1
                for c in range(4):
                    total[c] += colour[c]
        for c in range(4):
            mean[c] += areas[at] * total[c] / met
    _hold(mean)


@kernel
def _faces_at(pieces: PlanarPieces, count: int, base: int, points: int) -> NDArray[np.int64]:
    """Face at each sample point of a leaf."""
    found = np.empty(points, np.int64)
    for k in range(points):
        found[k] = face_at(pieces, count, base, (k + 0.5) / points * LATTICE, k * GOLDEN % 1.0 * LATTICE)
    return found


@kernel
def set_crowded_mean(pool: PiecePool, cell: Cell, cell_faces: CellFaces, mean: NDArray[np.float64]) -> None:
    """Write the mean colour of a cell with too many pieces to resolve: the mean over `SCANLINES` lines."""
    faces, layers, ground, present, windings = cell_faces
    n = cell.last - cell.first
    crossing_x, crossing, owner = np.empty(n), np.empty(n, np.int64), np.empty(n, np.int64)
    k = 0
    for i in range(n):
        while present[k, 0] != pool.path[pool.numbers[cell.first + i]]:
            k += 1
        owner[i] = k
    for c in range(4):
        mean[c] = 0.0
    for line in range(SCANLINES):
        y, count = cell.y + cell.size * (line + 0.5) / SCANLINES, 0
        for k in range(len(present)):
            windings[k] = present[k, 1]
        for i in range(n):
            curve = pool.points[pool.numbers[cell.first + i]]
            for end, event in ((0, 1), (3, -1)):
                if curve[end, 0] == cell.x and curve[end, 1] <= y:
                    windings[owner[i]] += event
            if min(curve[0, 1], curve[3, 1]) <= y < max(curve[0, 1], curve[3, 1]):
                crossing_x[count], crossing[count] = x_at(curve, y), i
                count += 1
        key, x, at = key_of(layers, present, windings), cell.x, 0
        order = sort_order(crossing_x, count)
        while at <= count:
            end_x = cell.x + cell.size if at == count else crossing_x[order[at]]
            if end_x > x:
                face = face_of(faces, layers, ground, present, windings, key)
                box, share = (end_x - x, cell.size / SCANLINES), (end_x - x) / (cell.size * SCANLINES)
                _add_colour(layers, faces, face, (0.5 * (x + end_x), y), box, share, mean)
                x = end_x
            if at < count:
                i = crossing[order[at]]
                curve, path = pool.points[pool.numbers[cell.first + i]], present[owner[i], 0]
                before = inside(windings[owner[i]], layers.rules[path])
                windings[owner[i]] += -1 if curve[3, 1] > curve[0, 1] else 1
                key ^= 0 if before == inside(windings[owner[i]], layers.rules[path]) else layers.keys[path]
            at += 1
