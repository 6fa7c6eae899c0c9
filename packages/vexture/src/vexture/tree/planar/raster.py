"""The mean colours of equal squares of a drawing, from its planar map: the input of blurs."""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.tree.growth import IS_QUAD
from vexture.tree.planar.compose import colour_at
from vexture.tree.planar.faces import FaceTable, operations_of, stack_of
from vexture.tree.planar.growth import BASE, PlanarGrowth
from vexture.tree.planar.layers import PlanarLayers


@kernel(ahead=True)
def raster_of(
    growth: PlanarGrowth, layers: PlanarLayers, faces: FaceTable, depth: int, components: int
) -> NDArray[np.float64]:
    """Mean colours, premultiplied, of the cells at a depth, (2^depth, 2^depth, components), the lowest row first.

    With one component it is the opacity. No leaf with outlines is larger than these cells.
    """
    side = 1 << depth
    out = np.zeros((side, side, components))
    waiting, colour = np.zeros((3 * depth + 4, 4), np.int64), np.empty(4)  # quad, column and row of its cell, depth
    count = 1
    while count > 0:
        count -= 1
        quad, column, row, level = waiting[count, 0], waiting[count, 1], waiting[count, 2], waiting[count, 3]
        below, size = growth.tree.first[quad, 0], side >> level + 1
        for k in range(4):
            i, j = column + size * (k & 1), row + size * (k >> 1)
            cell = growth.tree.cells[quad, k]
            is_quad = cell[IS_QUAD] == 1.0
            if is_quad and size > 1:
                waiting[count, 0], waiting[count, 1], waiting[count, 2], waiting[count, 3] = below, i, j, level + 1
                count += 1
            elif size > 1 and faces.program[int(cell[BASE])] != 0:
                _fill_with_program(layers, faces, int(cell[BASE]), (i, j, size), out)
            else:
                for c in range(4):
                    colour[c] = growth.mean[quad, k, c]
                _fill(colour, (i, j, size), out)
            below += 1 if is_quad else 0
    return out


@kernel(allocates=False)
def _fill(colour: NDArray[np.float64], square: tuple[int, int, int], out: NDArray[np.float64]) -> None:
    """Fill a square, of a first column and row and a size, with a colour."""
    components = out.shape[2]
    for j in range(square[1], square[1] + square[2]):
        for i in range(square[0], square[0] + square[2]):
            for c in range(components):
                out[j, i, c] = colour[c + 4 - components]


@kernel
def _fill_with_program(
    layers: PlanarLayers, faces: FaceTable, face: int, square: tuple[int, int, int], out: NDArray[np.float64]
) -> None:
    """Fill a square that lies in one face with the face's colours."""
    operations, ops, _ = operations_of(layers, stack_of(faces, face))
    work, colour, step = np.empty((operations + 1, 4)), np.empty(4), 1.0 / len(out)
    for j in range(square[1], square[1] + square[2]):
        for i in range(square[0], square[0] + square[2]):
            colour_at(layers, ops, operations, (step * (i + 0.5), step * (j + 0.5)), (step, step), work, colour)
            _fill(colour, (i, j, 1), out)
