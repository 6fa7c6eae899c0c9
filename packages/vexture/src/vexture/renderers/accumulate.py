"""Draw polygons of one colour each in one pass over their sides, without a tree; exact if none overlap.

Each side adds to the pixels of each row that it passes the part of the pixel to its right, times its polygon's colour.
Sums along the rows are then the colours. So the contributions of a side that two polygons share cancel except for
rounding, and no background shines through. The idea is the accumulation buffer of font-rs (Raph Levien, 2016) and
stb_truetype (Sean Barrett, 2015), here with colours in place of coverage.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.renderers.view import Size, ViewLike, size_of, view_matrix

PARTS = 4
"""Components of a colour: red, green and blue, each times opacity, and opacity."""


@dataclass(frozen=True, eq=False)
class Sides:
    """Sides of polygons in the unit square: outer rings counter-clockwise, holes clockwise.

    Parameters
    ----------
    start, end : (n, 2) arrays
        Coordinates x, y of both ends of each side.
    owner : (n,) array
        Index of each side's colour.
    """

    start: NDArray[np.float64]
    end: NDArray[np.float64]
    owner: NDArray[np.int64]


def render_sides(sides: Sides, rgba: NDArray[np.float64], size: Size, view: ViewLike = None) -> NDArray[np.float32]:
    """Mean colour of each pixel's square, premultiplied sRGB and opacity, (height, width, 4), top row first.

    `size` and `view`, which must be affine, are as in `vexture.render`; `rgba`, (c, 4), is not premultiplied. Where
    polygons overlap, the result is the mean of their colours, weighted by area.

    Examples
    --------
    >>> corners = np.array([[0.0, 0.0], [0.5, 0.0], [0.5, 1.0], [0.0, 1.0]])
    >>> half = Sides(corners, np.roll(corners, -1, axis=0), np.zeros(4, np.int64))
    >>> render_sides(half, np.array([[1.0, 0.5, 0.0, 1.0]]), (3, 1), [[1 / 3, 0, 0], [0, -1, 1]])[0, :, 0].tolist()
    [1.0, 0.5, 0.0]
    """
    width, height = size_of(size)
    to_pixels = np.linalg.inv(view_matrix(view, (width, height))).astype(np.float64)
    colours = np.concatenate([rgba[:, :3] * rgba[:, 3:], rgba[:, 3:]], axis=1)
    picture = np.zeros((height, width + 2, PARTS))
    add_sides(sides.start, sides.end, sides.owner, np.ascontiguousarray(colours), to_pixels, picture)
    sum_rows(picture)
    return picture[:, :width].astype(np.float32)


@kernel(allocates=False)
def add_sides(
    start: NDArray[np.float64],
    end: NDArray[np.float64],
    owner: NDArray[np.int64],
    colours: NDArray[np.float64],
    to_pixels: NDArray[np.float64],
    picture: NDArray[np.float64],
) -> None:
    """Add the changes of colour at each side to the rows that it passes."""
    height, width = picture.shape[0], picture.shape[1] - 2
    a, b, c = to_pixels[0, 0], to_pixels[0, 1], to_pixels[0, 2]
    d, e, f = to_pixels[1, 0], to_pixels[1, 1], to_pixels[1, 2]
    for k in range(len(start)):
        x0, y0 = a * start[k, 0] + b * start[k, 1] + c, d * start[k, 0] + e * start[k, 1] + f
        x1, y1 = a * end[k, 0] + b * end[k, 1] + c, d * end[k, 0] + e * end[k, 1] + f
        if y0 == y1 or max(y0, y1) <= 0.0 or min(y0, y1) >= height or min(x0, x1) >= width:
            continue
        sign = 1.0  # y points down, so a polygon is on the right of a side that goes down
        if y0 > y1:
            x0, y0, x1, y1, sign = x1, y1, x0, y0, -1.0
        slope = (x1 - x0) / (y1 - y0)
        first, last = int(max(y0, 0.0)), min(height, int(np.ceil(y1)))
        for row in range(first, last):
            top, bottom = max(y0, float(row)), min(y1, float(row + 1))
            if top >= bottom:
                continue
            left, right = x0 + slope * (top - y0), x0 + slope * (bottom - y0)
            if left > right:
                left, right = right, left
            _add_run(picture, row, left, right, sign * (bottom - top), colours, owner[k])


@kernel(allocates=False)
def _add_run(
    picture: NDArray[np.float64],
    row: int,
    left: float,
    right: float,
    area: float,
    colours: NDArray[np.float64],
    colour: int,
) -> None:
    """Add the part of a side in a row, from `left` to `right`, with the signed height `area`."""
    width = picture.shape[1] - 2
    if left >= width:
        return
    if right <= 0.0:
        _add(picture, row, 0, area, colours, colour)
        return
    density = area / (right - left) if right > left else 0.0
    if left < 0.0:
        _add(picture, row, 0, -left * density, colours, colour)
        area, left = area + left * density, 0.0
    if right > width:
        area, right = area - (right - width) * density, float(width)
    first, last = int(left), int(right)
    if first == last:
        inside = area * (1.0 - 0.5 * (left - first + right - last))
        _add(picture, row, first, inside, colours, colour)
        _add(picture, row, first + 1, area - inside, colours, colour)
        return
    before = 0.0  # area in the columns so far
    total = 0.0  # area added so far
    for column in range(first, last + 1):
        near, far = max(left, float(column)), min(right, float(column + 1))
        part = density * (far - near)
        inside = before + part * (column + 1 - 0.5 * (near + far))
        _add(picture, row, column, inside - total, colours, colour)
        total = inside
        before += part
    _add(picture, row, last + 1, area - total, colours, colour)


@kernel(allocates=False)
def _add(
    picture: NDArray[np.float64], row: int, column: int, area: float, colours: NDArray[np.float64], colour: int
) -> None:
    """Add an area times a colour to a pixel."""
    for part in range(PARTS):
        picture[row, column, part] += area * colours[colour, part]


@kernel(allocates=False)
def sum_rows(picture: NDArray[np.float64]) -> None:
    """Sum along the rows; where opacity exceeds 1 because polygons overlap, divide by it."""
    height, width, _ = picture.shape
    for row in range(height):
        for part in range(PARTS):
            total = 0.0
            for column in range(width):
                total += picture[row, column, part]
                picture[row, column, part] = total
        for column in range(width):
            most = max(picture[row, column, PARTS - 1], 1.0)
            for part in range(PARTS):
                picture[row, column, part] = max(picture[row, column, part] / most, 0.0)
