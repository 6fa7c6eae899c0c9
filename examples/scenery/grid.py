"""A grid over a rectangle of the world, and what is computed on it: noise, distances, smooth steps."""

from dataclasses import dataclass

import numpy as np
import pyproj
import shapely
from numpy.typing import NDArray
from PIL import Image

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Grid:
    """Square cells of a flood, `fine` pixels of the ground's picture along each; the northernmost row first."""

    crs: str
    bounds: tuple[float, float, float, float]  # west, south, east, north, in metres
    cell: float  # metres
    fine: int

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of cells."""
        west, south, east, north = self.bounds
        return round((north - south) / self.cell), round((east - west) / self.cell)

    @property
    def pixel(self) -> float:
        """Metres along a side of a pixel."""
        return self.cell / self.fine

    def middles(self) -> tuple[Array, Array]:
        """East and north of the cells' middles, in metres."""
        rows, columns = self.shape
        x, y = np.meshgrid(self.cell * (np.arange(columns) + 0.5), self.cell * (np.arange(rows) + 0.5))
        return self.bounds[0] + x, self.bounds[3] - y

    def finer(self, values: Array) -> Array:
        """An array of cells as one of pixels."""
        rows, columns = self.shape
        image = Image.fromarray(values.astype(np.float32))
        size = (self.fine * columns, self.fine * rows)
        return np.asarray(image.resize(size, Image.Resampling.BICUBIC), np.float64)

    def coarser(self, values: Array) -> Array:
        """Means over cells of an array of pixels."""
        rows, columns = self.shape
        return np.asarray(values.reshape(rows, self.fine, columns, self.fine).mean(axis=(1, 3)))

    def metres(self, degrees: Array) -> Array:
        """Places of the grid's system from longitudes and latitudes: rows of two."""
        to_metres = pyproj.Transformer.from_crs(4326, self.crs, always_xy=True)
        return np.stack(to_metres.transform(*np.transpose(degrees)), axis=1)

    def pixels_from(self, longitude: float, latitude: float) -> Array:
        """Metres from each pixel's north-western corner to a place."""
        rows, columns = (self.fine * count for count in self.shape)
        ((east, north),) = self.metres(np.array([[longitude, latitude]]))
        y, x = np.mgrid[:rows, :columns] * self.pixel
        return np.asarray(np.hypot(x - (east - self.bounds[0]), y - (self.bounds[3] - north)))


def noise(rng: np.random.Generator, shape: tuple[int, ...], size: float, octaves: int) -> Array:
    """Smooth noise of about -1..1; its largest features are `size` pixels, each octave is half as large and strong."""
    total, strength = np.zeros(shape), 1.0
    for _ in range(octaves):
        coarse = [int(n / size) + 4 for n in shape]
        grid = Image.fromarray(rng.uniform(-1, 1, coarse).astype(np.float32))
        box = (1.0, 1.0, 1.0 + shape[1] / size, 1.0 + shape[0] / size)
        total += strength * np.asarray(grid.resize((shape[1], shape[0]), Image.Resampling.BICUBIC, box))
        size, strength = max(size / 2, 1.0), strength / 2
    return total


def step(low: float, high: float, values: Array) -> Array:
    """0 below one value, 1 above the other, smooth between."""
    t = np.clip((values - low) / (high - low), 0, 1)
    return np.asarray(t * t * (3 - 2 * t))


def line_distance(line: shapely.Geometry, x: Array, y: Array) -> Array:
    """Metres from a line, or several: by the nearest of its pieces, of which there may be many."""
    points, part = shapely.get_coordinates(shapely.get_parts(line), return_index=True)
    pieces = np.stack([points[:-1], points[1:]], axis=1)[part[:-1] == part[1:]]
    tree = shapely.STRtree(shapely.linestrings(pieces))
    _, away = tree.query_nearest(shapely.points(x, y).ravel(), return_distance=True, all_matches=False)
    return np.asarray(away.reshape(x.shape))


def shore_distance(sea: shapely.Geometry, x: Array, y: Array) -> Array:
    """Metres from the shore of a sea, negative in it."""
    shapely.prepare(sea)
    return line_distance(sea.boundary, x, y) * np.where(shapely.contains_xy(sea, x, y), -1, 1)


def bends(points: Array) -> Array:
    """A line without corners (Chaikin)."""
    for _ in range(3):
        cut = np.stack([0.75 * points[:-1] + 0.25 * points[1:], 0.25 * points[:-1] + 0.75 * points[1:]], axis=1)
        points = np.vstack([points[:1], cut.reshape(-1, 2), points[-1:]])
    return points
