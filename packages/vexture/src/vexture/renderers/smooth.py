"""Smooth paints in an image, for the exact renderer: Gaussian blurs, and pictures whose pixels are spline coefficients.

All of them are uniform cubic B-splines in two directions. Their colour bends evenly, so that lines are not cut at the
knots, as at the seams of other pictures, but into parts that are short enough for quadrature.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.drawing.affine import Affine
from vexture.drawing.picture import Picture, Sampling
from vexture.renderers.ramps import Place, add_cut, ramp_point

MOST_PARTS: Final = 256.0
"""Most equal parts of a line, or of a cell from top to bottom."""

MARGIN: Final = 2
"""Coefficients beyond a border of a picture that differ in effect from further ones."""

Grid = NDArray[np.float32]


@dataclass(frozen=True, slots=True, eq=False)
class Spline:
    """A cubic spline as a paint.

    Parameters
    ----------
    to_grid : Affine
        Map from the drawing's coordinates to columns and rows of coefficients; those of (i, j) are centred at (i, j).
    grid : (rows, columns, 1 or 4) float32 array
        Coefficients of an opacity, or of a premultiplied colour, 0..1.
    window : (float, float, float, float)
        Least column and row, greatest column and row; beyond, the colours at its border continue.
    reach : (float, float)
        Columns and rows over which three points of quadrature are enough, and two over a third of it. For a picture,
        they are only where refinement begins.
    paint : (float, float, float, float)
        The premultiplied flat colour of an opacity; for colours, the last component is a factor.
    is_inverted : bool
        True if the opacity is 1 minus that of the coefficients.
    is_blur : bool
        True if the spline is as smooth as `reach` tells.
    """

    to_grid: Affine
    grid: Grid
    window: tuple[float, float, float, float]
    reach: tuple[float, float]
    paint: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)
    is_inverted: bool = False
    is_blur: bool = False

    @classmethod
    def of_picture(cls, picture: Picture) -> "Spline":
        """Make the spline whose coefficients are the pixels of a picture."""
        rows, columns = picture.pixels.shape[:2]
        margins = ((MARGIN, MARGIN + 1), (MARGIN, MARGIN + 1), (0, 0))
        grid = np.pad(picture.pixels, margins, mode="edge").astype(np.float32) / np.float32(255.0)
        (a, b, c), (d, e, f) = picture.to_pixels
        shift = MARGIN - 0.5
        window = (MARGIN - 1.0, MARGIN - 1.0, float(columns + MARGIN), float(rows + MARGIN))
        spline = cls(
            ((a, b, c + shift), (d, e, f + shift)),
            grid,
            window,
            (1.0, 1.0),
        )
        color = picture.color or (0.0, 0.0, 0.0)
        return spline.with_paint(color, picture.opacity, picture.sampling is Sampling.INVERSE)

    def with_paint(self, color: tuple[float, float, float], opacity: float, is_inverted: bool) -> "Spline":
        """Return the spline with another flat colour, which is not premultiplied, and opacity."""
        red, green, blue = (opacity * part for part in color)
        return replace(self, paint=(red, green, blue, opacity), is_inverted=is_inverted)


class Splines(NamedTuple):
    """The smooth paints of a drawing."""

    maps: NDArray[np.float64]  # (n, 3, 3): from homogeneous pixel coordinates of the image to columns and rows
    windows: NDArray[np.float64]  # (n, 4); this and the next four are members of `Spline`
    reaches: NDArray[np.float64]  # (n, 2)
    paints: NDArray[np.float64]  # (n, 4)
    inverted: NDArray[np.bool_]  # (n,)
    blurs: NDArray[np.bool_]  # (n,)
    columns: NDArray[np.int64]  # (n,)
    components: NDArray[np.int64]  # (n,): 1 or 4
    starts: NDArray[np.int64]  # (n,): place of the first coefficient
    coefficients: NDArray[np.float32]  # (m,): rows of all grids, one after another

    @classmethod
    def of_paints(cls, paints: Sequence[Spline], view: NDArray[np.float64]) -> "Splines":
        """Arrays of splines; `view` is the (3, 3) matrix from pixel coordinates to the unit square."""
        places, parts, end = dict[int, int](), [np.zeros(0, np.float32)], 0
        for paint in paints:  # copies of a paint share its grid
            if id(paint.grid) not in places:
                places[id(paint.grid)] = end
                parts.append(paint.grid.reshape(-1))
                end += paint.grid.size
        maps = np.array([np.array([*paint.to_grid, (0.0, 0.0, 1.0)]) @ view for paint in paints])
        return cls(
            maps.reshape(-1, 3, 3),
            np.array([paint.window for paint in paints], np.float64).reshape(-1, 4),
            np.array([paint.reach for paint in paints], np.float64).reshape(-1, 2),
            np.array([paint.paint for paint in paints], np.float64).reshape(-1, 4),
            np.array([paint.is_inverted for paint in paints], np.bool_),
            np.array([paint.is_blur for paint in paints], np.bool_),
            np.array([paint.grid.shape[1] for paint in paints], np.int64),
            np.array([paint.grid.shape[2] for paint in paints], np.int64),
            np.array([places[id(paint.grid)] for paint in paints], np.int64),
            np.concatenate(parts),
        )


@kernel(allocates=False)
def shade_spline(splines: Splines, k: int, x: float, y: float, colour: NDArray[np.float64]) -> None:
    """Write the premultiplied colour of a spline at a point of the image."""
    X, Y, W = ramp_point(splines.maps[k], x, y)
    W = W if W != 0.0 else 1e-300
    left, top, right, bottom = splines.windows[k]
    column, row = min(max(X / W, left), right), min(max(Y / W, top), bottom)
    i, j = int(column), int(row)
    across, down = spline_weights(column - i), spline_weights(row - j)
    count, stride = splines.components[k], splines.components[k] * splines.columns[k]
    first = splines.starts[k] + (j - 1) * stride + (i - 1) * count
    paint, grid = splines.paints[k], splines.coefficients
    for channel in range(count):
        total = 0.0
        for step in range(4):
            at = first + step * stride + channel
            total += down[step] * (
                across[0] * grid[at]
                + across[1] * grid[at + count]
                + across[2] * grid[at + 2 * count]
                + across[3] * grid[at + 3 * count]
            )
        colour[channel] = min(max(total, 0.0), 1.0)
    if count == 1:
        opacity = 1.0 - colour[0] if splines.inverted[k] else colour[0]
        for channel in range(4):
            colour[channel] = opacity * paint[channel]
    else:
        for channel in range(4):
            colour[channel] = min(colour[channel], colour[3]) * (paint[3] if channel < 3 else 1.0)
        colour[3] *= paint[3]


@kernel(allocates=False)
def spline_weights(t: float) -> tuple[float, float, float, float]:
    """Weights of four coefficients at a place between the second and the third."""
    u = 1.0 - t
    return (
        u * u * u / 6.0,
        2.0 / 3.0 - t * t * (1.0 - 0.5 * t),
        2.0 / 3.0 - u * u * (1.0 - 0.5 * u),
        t * t * t / 6.0,
    )


@kernel(allocates=False)
def extent(splines: Splines, k: int, start: Place, end: Place) -> float:
    """Return the larger part of a line in the image along columns or rows, in reaches of a spline."""
    p, q = ramp_point(splines.maps[k], start[0], start[1]), ramp_point(splines.maps[k], end[0], end[1])
    found = 0.0
    for axis in range(2):
        low, high = splines.windows[k, axis], splines.windows[k, axis + 2]
        one, other = min(max(p[axis] / p[2], low), high), min(max(q[axis] / q[2], low), high)
        found = max(found, abs(other - one) / splines.reaches[k, axis])
    return found


@kernel(allocates=False)
def cut_borders(
    splines: Splines, k: int, start: Place, end: Place, span: Place, cuts: NDArray[np.float64], count: int
) -> int:
    """Cut a line in the image, a part `span` of a longer one, at the border of a window; return the count of cuts."""
    p, q = ramp_point(splines.maps[k], start[0], start[1]), ramp_point(splines.maps[k], end[0], end[1])
    for side in range(4):
        axis, border = side % 2, splines.windows[k, side]
        slope = q[axis] - p[axis] - border * (q[2] - p[2])
        if slope != 0.0:
            part = (border * p[2] - p[axis]) / slope
            if 0.0 < part < 1.0:
                count = add_cut(span[0] + part * (span[1] - span[0]), cuts, count)
    return count


@kernel(allocates=False)
def cut_evenly(length: float, span: Place, cuts: NDArray[np.float64], count: int) -> int:
    """Cut a part `span` of a line into equal parts, for its length in reaches; return the new count of cuts."""
    parts = int(np.ceil(min(length, MOST_PARTS)))
    for part in range(1, parts):
        count = add_cut(span[0] + part / parts * (span[1] - span[0]), cuts, count)
    return count
