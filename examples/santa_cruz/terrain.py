"""An invented terrain on the real coastline at Santa Cruz: heights that rise from the shore, low river valleys."""

from pathlib import Path
from typing import NamedTuple

import numpy as np
import shapely
from scenery.files import sea_of
from scenery.grid import Array, Grid, bends, noise, shore_distance, step

GRID = Grid("EPSG:32610", (581400.0, 4087140.0, 593040.0, 4094820.0), 30.0, 4)
SEED = 1609
COASTLINE = Path(__file__).parents[1] / "coastlines" / "santa_cruz.geojson"
CREEKS = (  # longitude and latitude, drawn by hand near the real ones; half the valley's width in metres
    (230.0, ((-122.0115, 36.9615), (-122.0125, 36.9655), (-122.0185, 36.9690), (-122.0240, 36.9735),
             (-122.0265, 36.9800), (-122.0245, 36.9880), (-122.0280, 37.0000))),
    (90.0, ((-122.0225, 36.9612), (-122.0275, 36.9630), (-122.0310, 36.9640), (-122.0335, 36.9665))),
    (70.0, ((-122.0026, 36.9590), (-122.0032, 36.9655), (-121.9995, 36.9725))),
    (80.0, ((-121.9935, 36.9570), (-121.9928, 36.9640), (-121.9900, 36.9710))),
    (60.0, ((-121.9765, 36.9530), (-121.9780, 36.9585), (-121.9765, 36.9640))),
    (50.0, ((-122.0560, 36.9470), (-122.0555, 36.9515), (-122.0570, 36.9550))),
)  # fmt: skip


class Terrain(NamedTuple):
    """Arrays of pixels over `GRID`, the northernmost row first."""

    shore: Array  # metres from the coastline, negative at sea
    creek: Array  # metres from the nearest creek
    height: Array  # metres above the mean level of the sea


def terrain() -> Terrain:
    """Heights from the distance to the real shore; everything else about them is invented."""
    rng = np.random.default_rng(SEED)
    cells = GRID.shape
    x, y = GRID.middles()
    shore = shore_distance(sea_of(COASTLINE, GRID), x, y)
    inland = step(100, 700, shore)
    warped = shapely.points(*(axis + 110 * inland * noise(rng, cells, 22, 3) for axis in (x, y)))
    creek, valley = np.full(cells, np.inf), np.full(cells, np.inf)
    for half, course in CREEKS:
        line = shapely.LineString(bends(GRID.metres(np.array(course))))
        away, along = shapely.distance(line, warped), shapely.line_locate_point(line, warped)
        floor, upstream = 0.7 + 0.55e-3 * along + 0.3 * noise(rng, cells, 13, 3), along / line.length
        bottom = -1.5 + (1.5 + floor) * upstream**2
        beyond = np.maximum(away - half * (1 + 0.6 * noise(rng, cells, 20, 2)), 0)
        banks = floor + (bottom - floor) * np.exp(-((away / 38) ** 2))
        valley = np.minimum(valley, banks + 5 * (beyond / 170) ** 1.5)
        creek = np.minimum(creek, away + 30 * upstream**8)
    shore, creek, valley = GRID.finer(shore), GRID.finer(creek), GRID.finer(np.minimum(valley, 200))
    land = 3.4 * (1 - np.exp(-np.maximum(shore, 0) / 85))
    land += 9.0 * step(70, 420, shore + 25 * noise(rng, shore.shape, 60, 3)) + 0.4 * noise(rng, shore.shape, 40, 3)
    ridges = 1 - np.abs(noise(rng, shore.shape, 220, 5))
    land += 110 * np.clip((shore - 900) / 3600, 0, 1) ** 1.3 * (0.35 + 0.65 * ridges)
    below = -14 * (1 - np.exp(np.minimum(shore, 0) / 900)) - 2.2 * (1 - np.exp(np.minimum(shore, 0) / 70))
    below += 0.1 * noise(rng, shore.shape, 80, 2) * step(0, 200, -shore)
    return Terrain(shore, creek, np.minimum(np.where(shore > 0, land, below), valley))
