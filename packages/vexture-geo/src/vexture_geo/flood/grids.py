"""Grids over a frame: coverage by water, distance to the shore, resampled values, noise."""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing
from vexture_geo.base.extent import Bounds, Frame

SEED: Final = 4626
"""Seed of the noise, fixed so that two runs make the same page."""


def size_for(frame: Frame, longest: int, least: int = 2) -> tuple[int, int]:
    """Columns and rows of a grid of square cells over a frame, `longest` on its longer side.

    Examples
    --------
    >>> size_for(Frame((0.0, 0.0, 2000.0, 1000.0), "EPSG:28992", (2000.0, 1000.0)), 128)
    (128, 64)
    """
    columns, rows = (max(least, round(longest * side / max(frame.metres))) for side in frame.metres)
    return columns, rows


def pixels_to(bounds: Bounds, size: tuple[int, int]) -> Any:
    """Affine transform of rasterio from columns and rows of a grid of `size` to bounds."""
    from rasterio import Affine

    west, south, east, north = bounds
    return Affine((east - west) / size[0], 0.0, west, 0.0, (south - north) / size[1], north)


def coverage_over(drawing: Drawing, box: Bounds, size: tuple[int, int]) -> NDArray[np.float32]:
    """Fraction of each cell that a drawing covers, for a grid of columns and rows over a box of the unit square.

    The northernmost row comes first.

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
    """Distance of each cell's middle to the nearest cell of the other kind: positive on land, negative in water.

    `cell` is the width and height of a cell. Where all cells are of one kind, the distance is the grid's diagonal.

    Examples
    --------
    >>> shore_distance(np.array([[True, False, False]]), (10.0, 10.0))
    array([[-10.,  10.,  20.]])
    """
    rows, columns = wet.shape
    farthest = float(np.hypot(columns * cell[0], rows * cell[1]))
    to_water, to_land = (np.minimum(distance_to(kind, cell), farthest) for kind in (wet, ~wet))
    return np.where(wet, -to_land, to_water)


def distance_to(marked: NDArray[np.bool_], cell: tuple[float, float]) -> NDArray[np.float64]:
    """Distance of each cell's middle to the nearest marked cell; infinite if there is none.

    Squares of distances are minimised along the columns, then along the rows.
    """
    squares = np.where(marked, 0.0, np.inf)
    for step in cell[::-1]:
        places = step * np.arange(squares.shape[0])
        apart = (places[:, None] - places) ** 2
        squares = np.stack([(line + apart).min(axis=1) for line in squares.T])
    return np.sqrt(squares)


def sample_grid(grid: NDArray[np.floating], size: tuple[int, int]) -> NDArray[np.float64]:
    """Values at `size` columns and rows of points from corner to corner, interpolated between the middles of cells.

    NaN means unknown. A point between known and unknown cells has the value of the known ones.

    Examples
    --------
    >>> sample_grid(np.array([[0.0, 2.0]]), (3, 2))
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


def coarser(grid: NDArray[np.floating[Any]], size: tuple[int, int]) -> NDArray[np.float64]:
    """Average blocks of cells, ignoring NaN, so that no water between samples is missed."""
    down, across = (max(1, cells // samples) for cells, samples in zip(grid.shape, size[::-1], strict=True))
    if down == across == 1:
        return grid.astype(np.float64)
    padded = np.pad(
        grid.astype(np.float64), [(0, -grid.shape[0] % down), (0, -grid.shape[1] % across)], constant_values=np.nan
    )
    blocks = padded.reshape(padded.shape[0] // down, down, padded.shape[1] // across, across)
    return mean_of(blocks, (1, 3))


def mean_of(values: NDArray[np.float64], axis: int | tuple[int, ...]) -> NDArray[np.float64]:
    """Average without NaN; NaN if no value is known."""
    known = np.isfinite(values)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(np.where(known, values, 0.0).sum(axis) / known.sum(axis))


def fill_unknown(grid: NDArray[np.float64]) -> NDArray[np.float64]:
    """Fill unknown values, NaN, from the nearest known ones, slightly smoothed."""
    from rasterio.fill import fillnodata

    known = np.isfinite(grid)
    if known.all() or not known.any():
        return grid
    reach = float(sum(grid.shape))
    values = np.where(known, grid, 0.0).astype(np.float32)
    return np.asarray(fillnodata(values, known.astype(np.uint8), reach, smoothing_iterations=2), np.float64)


def noise(size: tuple[int, int], octaves: int = 6) -> NDArray[np.float64]:
    """Make fractal noise from -1 to 1, the same at each call."""
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
