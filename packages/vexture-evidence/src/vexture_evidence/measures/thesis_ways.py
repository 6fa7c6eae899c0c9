"""The method of the thesis's own shader, with each of its steps available separately (3.6, 4.4.3).

The renderers of `vexture.thesis` differ (``shaders/coverage.glsl``): they look up a sample outside the cell of the
pixel's centre again, and rotate the grid of samples. Here a pixel uses only the cell that contains its centre.
"""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vexture.renderers.view import size_of, view_matrix
from vexture.thesis.cpu import cell_value, find_cell, view_point, view_step
from vexture.thesis.method import CONSTANT, SAMPLES
from vexture.thesis.texture import ThesisTexture

CUT_OFF: Final = 1.0
"""Pixels; a quad whose side is smaller is drawn by its MIP value (thesis 4.4.3, *timesBigger*)."""


@dataclass(frozen=True, slots=True, eq=False)
class AsThesis:
    """A picture, and which of its pixels have MIP values.

    Parameters
    ----------
    image : (height, width) float32 array
        Coverage, 0..1, top row first.
    from_mip : (height, width) bool array
        True where the value is the stored coverage of a quad, false where it comes from the leaf of the pixel's centre.
    """

    image: NDArray[np.float32]
    from_mip: NDArray[np.bool_]


def draw_as_thesis(
    texture: ThesisTexture,
    size: tuple[int, int],
    to_unit: ArrayLike | None = None,
    *,
    samples: int = SAMPLES,
    cut_off: float = CUT_OFF,
) -> AsThesis:
    """Draw a texture as the thesis describes, in float64.

    Parameters
    ----------
    texture : ThesisTexture
    size : tuple of int
        Width and height of the image in pixels.
    to_unit : (2, 3) or (3, 3) array, optional
        From pixel coordinates to the unit square; None fits the square.
    samples : int
        A pixel whose centre is in a leaf with a curve is the mean of samples x samples points, on a grid parallel to
        the pixels. That leaf's curve is used for all of them, even beyond the leaf. 1 takes only the pixel's centre.
    cut_off : float
        Pixels. Quads whose side is smaller are drawn by their MIP value; 0 draws none of them so.

    Raises
    ------
    ParameterError
        If the size or the view is out of range.

    Examples
    --------
    >>> full = ThesisTexture(np.full((1, 4, 3), (0, 0, 128), np.uint8), np.zeros((2, 2, 3), np.uint8))
    >>> draw_as_thesis(full, (1, 1)).image, draw_as_thesis(full, (1, 1), cut_off=2.0).from_mip
    (array([[1.]], dtype=float32), array([[ True]]))
    """
    width, height = size_of(size)
    matrix = view_matrix(to_unit, size)
    largest = np.iinfo(texture.quads.dtype).max
    lists = texture.quads / largest, texture.curves / largest
    drawn = AsThesis(np.zeros((height, width), np.float32), np.zeros((height, width), np.bool_))
    horizon = abs(matrix[2, 0]) + abs(matrix[2, 1])  # as in the renderers
    offsets = [(n + 0.5) / samples - 0.5 for n in range(samples)]
    for row in range(height):
        for column in range(width):
            pixel = (column + 0.5, row + 0.5)
            x, y, w = view_point(matrix, pixel)
            if w <= horizon:
                continue
            center = (x / w, y / w)
            dx, dy = view_step(matrix, center, pixel, (1.0, 0.0)), view_step(matrix, center, pixel, (0.0, 1.0))
            footprint = cut_off * max(math.hypot(*dx), math.hypot(*dy))
            cell = find_cell(*lists, center, footprint)
            if cell.shape == CONSTANT:
                drawn.image[row, column] = cell.value
                drawn.from_mip[row, column] = cell.size > find_cell(*lists, center, 0.0).size
                continue
            points = [(center[0] + s * dx[0] + t * dy[0], center[1] + s * dx[1] + t * dy[1])
                      for s in offsets for t in offsets]  # fmt: skip
            drawn.image[row, column] = sum(cell_value(cell, point) for point in points) / len(points)
    return drawn
