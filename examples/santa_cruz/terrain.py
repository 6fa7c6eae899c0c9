"""An invented terrain on the real coastline at Santa Cruz: heights that rise from the shore, low river valleys."""

import json
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pyproj
import shapely
from numpy.typing import NDArray
from PIL import Image

CRS = "EPSG:32610"
BOUNDS = (581400.0, 4087140.0, 593040.0, 4094820.0)  # metres: 388 x 256 cells
CELL = 30.0  # metres, of the flood
FINE = 4  # pixels of the ground image along a cell
SEED = 1609
ROWS, COLUMNS = round((BOUNDS[3] - BOUNDS[1]) / CELL), round((BOUNDS[2] - BOUNDS[0]) / CELL)
CREEKS = (  # longitude and latitude, drawn by hand near the real ones; half the valley's width in metres
    (230.0, ((-122.0115, 36.9615), (-122.0125, 36.9655), (-122.0185, 36.9690), (-122.0240, 36.9735),
             (-122.0265, 36.9800), (-122.0245, 36.9880), (-122.0280, 37.0000))),
    (90.0, ((-122.0225, 36.9612), (-122.0275, 36.9630), (-122.0310, 36.9640), (-122.0335, 36.9665))),
    (70.0, ((-122.0026, 36.9590), (-122.0032, 36.9655), (-121.9995, 36.9725))),
    (80.0, ((-121.9935, 36.9570), (-121.9928, 36.9640), (-121.9900, 36.9710))),
    (60.0, ((-121.9765, 36.9530), (-121.9780, 36.9585), (-121.9765, 36.9640))),
    (50.0, ((-122.0560, 36.9470), (-122.0555, 36.9515), (-122.0570, 36.9550))),
)  # fmt: skip

Array = NDArray[np.float64]


class Terrain(NamedTuple):
    """Arrays over `BOUNDS`, the northernmost row first, `FINE` pixels to a cell."""

    shore: Array  # metres from the coastline, negative at sea
    creek: Array  # metres from the nearest creek
    height: Array  # metres above the mean level of the sea


def noise(rng: np.random.Generator, shape: tuple[int, int], size: float, octaves: int) -> Array:
    """Smooth noise of about -1..1; its largest features are `size` pixels, each octave is half as large and strong."""
    total, strength = np.zeros(shape), 1.0
    for _ in range(octaves):
        coarse = [int(n / size) + 4 for n in shape]
        grid = Image.fromarray(rng.uniform(-1, 1, coarse).astype(np.float32))
        box = (1.0, 1.0, 1.0 + shape[1] / size, 1.0 + shape[0] / size)
        total += strength * np.asarray(grid.resize(shape[::-1], Image.Resampling.BICUBIC, box))
        size, strength = max(size / 2, 1.0), strength / 2
    return total


def step(low: float, high: float, values: Array) -> Array:
    """0 below one value, 1 above the other, smooth between."""
    t = np.clip((values - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def finer(values: Array) -> Array:
    """An array of cells as one of pixels."""
    image = Image.fromarray(values.astype(np.float32))
    return np.asarray(image.resize((FINE * COLUMNS, FINE * ROWS), Image.Resampling.BICUBIC), np.float64)


def sea_and_creeks() -> tuple[shapely.Geometry, list[tuple[float, shapely.Geometry]]]:
    """In metres: the sea of `coastline.geojson`; each creek with half the width of its valley."""
    to_metres = pyproj.Transformer.from_crs(4326, CRS, always_xy=True)
    features = json.loads((Path(__file__).parent / "coastline.geojson").read_text())["features"]
    degrees = shapely.from_geojson(json.dumps(features[0]["geometry"]))
    sea = shapely.transform(degrees, lambda points: np.stack(to_metres.transform(*points.T), axis=1))
    creeks = []
    for half, course in CREEKS:
        points = np.stack(to_metres.transform(*np.transpose(course)), axis=1)
        for _ in range(3):  # Chaikin: corners become bends
            cut = np.stack([0.75 * points[:-1] + 0.25 * points[1:], 0.25 * points[:-1] + 0.75 * points[1:]], axis=1)
            points = np.vstack([points[:1], cut.reshape(-1, 2), points[-1:]])
        creeks.append((half, shapely.LineString(points)))
    return sea, creeks


def terrain() -> Terrain:
    """Heights from the distance to the real shore; everything else about them is invented."""
    rng = np.random.default_rng(SEED)
    cells = (ROWS, COLUMNS)
    sea, creeks = sea_and_creeks()
    x, y = np.meshgrid(CELL * (np.arange(COLUMNS) + 0.5), CELL * (np.arange(ROWS) + 0.5))
    x, y = BOUNDS[0] + x, BOUNDS[3] - y
    shapely.prepare(sea)
    shore = shapely.distance(sea.boundary, shapely.points(x, y)) * np.where(shapely.contains_xy(sea, x, y), -1, 1)
    inland = step(100, 700, shore)
    warped = shapely.points(*(axis + 110 * inland * noise(rng, cells, 22, 3) for axis in (x, y)))
    creek, valley = np.full(cells, np.inf), np.full(cells, np.inf)
    for half, line in creeks:
        away, along = shapely.distance(line, warped), shapely.line_locate_point(line, warped)
        floor, upstream = 0.7 + 0.55e-3 * along + 0.3 * noise(rng, cells, 13, 3), along / line.length
        bottom = -1.5 + (1.5 + floor) * upstream**2
        beyond = np.maximum(away - half * (1 + 0.6 * noise(rng, cells, 20, 2)), 0)
        banks = floor + (bottom - floor) * np.exp(-((away / 38) ** 2))
        valley = np.minimum(valley, banks + 5 * (beyond / 170) ** 1.5)
        creek = np.minimum(creek, away + 30 * upstream**8)
    shore, creek, valley = finer(shore), finer(creek), finer(np.minimum(valley, 200))
    land = 3.4 * (1 - np.exp(-np.maximum(shore, 0) / 85))
    land += 9.0 * step(70, 420, shore + 25 * noise(rng, shore.shape, 60, 3)) + 0.4 * noise(rng, shore.shape, 40, 3)
    ridges = 1 - np.abs(noise(rng, shore.shape, 220, 5))
    land += 110 * np.clip((shore - 900) / 3600, 0, 1) ** 1.3 * (0.35 + 0.65 * ridges)
    below = -14 * (1 - np.exp(np.minimum(shore, 0) / 900)) - 2.2 * (1 - np.exp(np.minimum(shore, 0) / 70))
    below += 0.1 * noise(rng, shore.shape, 80, 2) * step(0, 200, -shore)
    return Terrain(shore, creek, np.minimum(np.where(shore > 0, land, below), valley))
