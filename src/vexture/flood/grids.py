"""Grids over the frame: how much of each cell is wet, how far it is to the shore, values between cells."""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import Drawing
from vexture.geo.extent import Frame

__all__ = ["coverage_over", "filled", "noise", "pixels_to", "sampled", "shore_distance", "size_for"]

SEED: Final = 4626
"""Of all that is random here: two runs make the same page."""


def size_for(frame: Frame, longest: int) -> tuple[int, int]:
    """Columns and rows of a grid of square cells over a frame, at least 2 each.

    Examples
    --------
    >>> size_for(Frame((0.0, 0.0, 2000.0, 1000.0), "EPSG:28992", (2000.0, 1000.0)), 128)
    (128, 64)
    """
    columns, rows = (max(2, round(longest * side / max(frame.metres))) for side in frame.metres)
    return columns, rows


def pixels_to(bounds: tuple[float, float, float, float], size: tuple[int, int]) -> Any:
    """Affine map of rasterio from columns and rows to a box.

    Parameters
    ----------
    bounds : tuple of float
        West, south, east, north.
    size : tuple of int
        Columns and rows.
    """
    from rasterio import Affine

    west, south, east, north = bounds
    return Affine((east - west) / size[0], 0.0, west, 0.0, (south - north) / size[1], north)


def coverage_over(
    drawing: Drawing, box: tuple[float, float, float, float], size: tuple[int, int]
) -> NDArray[np.float32]:
    """Share of each cell of a grid that a drawing covers, the northernmost row first.

    Parameters
    ----------
    drawing : Drawing
    box : tuple of float
        What the grid covers, in unit-square units: x0, y0, x1, y1.
    size : tuple of int
        Columns and rows.

    Examples
    --------
    >>> west = Drawing.polygon([(0, 0), (0.5, 0), (0.5, 1), (0, 1)])
    >>> coverage_over(west, (0.25, 0.25, 0.75, 0.75), (2, 2))
    array([[1., 0.],
           [1., 0.]], dtype=float32)
    """
    from vexture.renderers.exact import render_exact

    x0, y0, x1, y1 = box
    columns, rows = size
    return render_exact(drawing, size, [[(x1 - x0) / columns, 0.0, x0], [0.0, (y0 - y1) / rows, y1]])


def shore_distance(wet: NDArray[np.bool_], cell: tuple[float, float]) -> NDArray[np.float64]:
    """Distance of each cell's middle to the nearest cell of the other kind: above 0 on land, below 0 in the water.

    Parameters
    ----------
    wet : (rows, columns) bool array
    cell : tuple of float
        Width and height of a cell. Where all cells are of one kind, all are as far away as the grid is long.

    Examples
    --------
    >>> shore_distance(np.array([[True, False, False]]), (10.0, 10.0))
    array([[-10.,  10.,  20.]])
    """
    rows, columns = wet.shape
    farthest = float(np.hypot(columns * cell[0], rows * cell[1]))
    to_water, to_land = (np.minimum(np.sqrt(_squared(kind, cell)), farthest) for kind in (wet, ~wet))
    return np.where(wet, -to_land, to_water)


def _squared(marked: NDArray[np.bool_], cell: tuple[float, float]) -> NDArray[np.float64]:
    """Squared distance to the nearest marked cell: along the columns first, then along the rows of what that gave."""
    squares = np.where(marked, 0.0, np.inf)
    for step in cell[::-1]:
        places = step * np.arange(squares.shape[0])
        apart = (places[:, None] - places) ** 2
        squares = np.stack([(line + apart).min(axis=1) for line in squares.T])
    return squares


def sampled(grid: NDArray[np.floating], size: tuple[int, int]) -> NDArray[np.float64]:
    """Values at the corners of a grid's frame and evenly between them, from values at the middles of its cells.

    Parameters
    ----------
    grid : (rows, columns) array
        NaN where nothing is known; a sample between known and unknown cells is that of the known ones.
    size : tuple of int
        Columns and rows of samples.

    Examples
    --------
    >>> sampled(np.array([[0.0, 2.0]]), (3, 2))
    array([[0., 1., 2.],
           [0., 1., 2.]])
    """
    columns, rows = size
    known = np.isfinite(grid)
    total, weight = np.where(known, grid, 0.0).astype(np.float64), known.astype(np.float64)
    for axis, count in ((0, rows), (1, columns)):
        cells = grid.shape[axis]
        places = np.clip(np.linspace(0.0, cells, count) - 0.5, 0.0, cells - 1.0)
        below = np.minimum(places.astype(int), max(cells - 2, 0))
        above = np.minimum(below + 1, cells - 1)
        share = np.expand_dims(places - below, 1 - axis)
        total, weight = (
            np.take(values, below, axis) * (1.0 - share) + np.take(values, above, axis) * share
            for values in (total, weight)
        )
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(weight > 0.0, total / weight, np.nan)


def filled(grid: NDArray[np.float64]) -> NDArray[np.float64]:
    """Grid whose unknown values (NaN) are those of the nearest known ones, smoothed a little."""
    from rasterio.fill import fillnodata

    known = np.isfinite(grid)
    if known.all() or not known.any():
        return grid
    reach = float(sum(grid.shape))
    values = np.where(known, grid, 0.0).astype(np.float32)
    return np.asarray(fillnodata(values, known.astype(np.uint8), reach, smoothing_iterations=2), np.float64)


def noise(size: tuple[int, int], octaves: int = 6) -> NDArray[np.float64]:
    """Random ups and downs of all lengths, -1 to 1, the same at each call.

    Examples
    --------
    >>> bool(abs(noise((40, 30))).max() <= 1.0), noise((40, 30)).shape
    (True, (30, 40))
    """
    from PIL import Image

    random = np.random.default_rng(SEED)
    columns, rows = size
    total = np.zeros((rows, columns))
    for octave in range(octaves):
        count = 3 * 2**octave
        points = random.uniform(-1.0, 1.0, (count, count)).astype(np.float32)
        picture = Image.fromarray(points).resize((columns, rows), Image.Resampling.BICUBIC)
        total += np.asarray(picture, np.float64) * 0.5**octave
    return np.clip(0.7 * total, -1.0, 1.0)
