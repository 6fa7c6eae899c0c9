"""The mean colour of a program with pictures over its face's part of a leaf.

A leaf is divided into a grid of boxes, each about as large as a pixel of the pictures. A program has its colour over
each box, and the box counts if a point in it lies in the face. Without outlines in the leaf all boxes count, so the
mean of a picture alone is exact.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import LATTICE
from vexture.drawing.group import Blend
from vexture.tree.crossings import x_at
from vexture.tree.divide import Cell
from vexture.tree.planar.compose import MIX, SHADE, Operations, colour_at
from vexture.tree.planar.layers import PlanarLayers
from vexture.tree.planar.shades import FOCUS, PICTURE
from vexture.tree.planar.slabs import PlanarPieces

NORMAL = int(Blend.NORMAL)

FIRST_STEP, SECOND_STEP = 0.7548776662466927, 0.5698402909980532
"""Points (frac(k a), frac(k b)) are spread evenly: a and b are powers of the reciprocal plastic number (Roberts, "The
unreasonable effectiveness of quasirandom sequences")."""

LEAST_BOXES: Final = 16
"""Least side of the grid in a leaf with outlines: the boxes along an outline count or not, and their errors cancel."""

MOST_BOXES: Final = 64
"""Most side of the grid for a program that adds up means; larger boxes hold several pixels, of which they have the
exact mean."""

MOST_PRODUCTS: Final = 256
"""Most side of the grid for a program that multiplies colours, as the mean of a product is no product of means."""


@kernel(allocates=False)
def _counts(curve: NDArray[np.float64], x: float, y: float) -> int:
    """Times that a piece adds its left face and takes its right one at a point, in lattice units."""
    by = 1 if curve[0, 0] == 0.0 and curve[0, 1] <= y else 0
    by -= 1 if curve[3, 0] == 0.0 and curve[3, 1] <= y else 0
    if curve[0, 1] <= y < curve[3, 1] and min(curve[0, 0], curve[3, 0]) <= x:
        by -= 1 if max(curve[0, 0], curve[3, 0]) <= x or x_at(curve, y) <= x else 0
    return by


@kernel(allocates=False)
def face_at(pieces: PlanarPieces, count: int, base: int, x: float, y: float) -> int:
    """Face at a point of a leaf, in lattice units: the sum of face numbers, because all others cancel."""
    face = base
    for k in range(count):
        face += _counts(pieces.curves[k], x, y) * (pieces.sides[k, 0] - pieces.sides[k, 1])
    return face


@kernel(allocates=False)
def holds_picture(layers: PlanarLayers, ops: Operations, count: int) -> bool:
    """Whether any operation paints a picture."""
    for k in range(count):
        if ops.code[k] == SHADE and layers.shades.rows[ops.number[k], FOCUS] == PICTURE:
            return True
    return False


@kernel(allocates=False)
def _boxes_of(layers: PlanarLayers, ops: Operations, count: int, size: float, has_outlines: bool) -> int:
    """Side of the grid for a leaf of width `size`."""
    pixels, shades, multiplies = 0.0, 0, False
    for k in range(count):
        if ops.code[k] == SHADE:
            shades += 1
            row = layers.shades.rows[ops.number[k]]
            if row[FOCUS] == PICTURE:
                pixels = max(
                    pixels, size * np.sqrt(max(row[0] * row[0] + row[3] * row[3], row[1] * row[1] + row[4] * row[4]))
                )
        elif ops.code[k] == MIX and ops.number[k] >> 16 != NORMAL:
            multiplies = True
    multiplies = multiplies or shades > 1
    finest = 2.0 if multiplies or has_outlines else 1.0
    boxes = int(np.ceil(min(finest * pixels, MOST_PRODUCTS if multiplies else MOST_BOXES)))
    return max(boxes, LEAST_BOXES if multiplies or has_outlines else 1)


@kernel
def add_picture_mean(
    pieces: PlanarPieces,
    count: int,
    base: int,
    cell: Cell,
    layers: PlanarLayers,
    program: tuple[int, int, Operations],
    share: float,
    mean: NDArray[np.float64],
) -> None:
    """Add a share of the mean colour of a program to the mean of a leaf.

    `program` holds the face, the number of operations and the operations.
    """
    face, operations, ops = program
    side = _boxes_of(layers, ops, operations, cell.size, count > 0)
    work, colour, total, met = np.empty((operations + 1, 4)), np.empty(4), np.zeros(4), 0
    size = cell.size / side
    for k in range(side * side):
        i, j = k % side, k // side
        if count > 0:
            x, y = i + k * FIRST_STEP % 1.0, j + k * SECOND_STEP % 1.0
            if face_at(pieces, count, base, x / side * LATTICE, y / side * LATTICE) != face:
                continue
        middle = cell.x + size * (i + 0.5), cell.y + size * (j + 0.5)
        colour_at(layers, ops, operations, middle, (size, size), work, colour)
        met += 1
        for c in range(4):
            total[c] += colour[c]
    if met == 0:  # a sliver that holds none of the points
        middle = cell.x + 0.5 * cell.size, cell.y + 0.5 * cell.size
        colour_at(layers, ops, operations, middle, (cell.size, cell.size), work, total)
        met = 1
    for c in range(4):
        mean[c] += share * total[c] / met
