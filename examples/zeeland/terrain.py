"""An invented terrain on the real coastline at Zierikzee: dunes, dikes, polders below the sea, flats and channels."""

from pathlib import Path
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray
from scenery.files import sea_of
from scenery.grid import Array, Grid, line_distance, noise, shore_distance, step

CRS = "EPSG:28992"
BOUNDS = (34200.0, 401400.0, 59400.0, 419400.0)
CELL = 50.0  # metres
FINE = 3  # pixels of the picture along a cell
SEED = 1953
COASTLINE = Path(__file__).parents[1] / "coastlines" / "zeeland.geojson"
DIKED = 12e6  # square metres of land from which dikes are around it; less is a salt marsh
CREST = 5.6  # metres, of dikes
DUNES = (42500.0, 46500.0)  # metres east: where the dunes are, and where they have ended
BREACHES = (  # longitude, latitude, metres: where the dikes are low
    (3.8889, 51.6436, 240.0), (3.9614, 51.6148, 220.0), (3.8771, 51.7396, 240.0), (3.8546, 51.6769, 200.0),
)  # fmt: skip
SILL = 1.7  # metres, of the dike there
RAMP = 150.0  # metres along the dike in which it rises from there to its crest


class Terrain(NamedTuple):
    """Arrays of pixels over a grid, the northernmost row first; metres."""

    grid: Grid
    shore: Array  # from the coastline, negative at sea
    diked: Array  # 1 on land with dikes around it, 0 on a salt marsh
    bank: Array  # from the nearest dike within the polders
    breach: Array  # from the nearest breach
    height: Array  # above the mean level of the sea


def parcels(rng: np.random.Generator, x: Array, y: Array, every: float) -> tuple[NDArray[np.int64], Array]:
    """Polders: for each place the number of its polder, and metres from the border of that."""
    columns, rows = (np.arange(axis.min() - every, axis.max() + 2 * every, every) for axis in (x, y))
    middles = np.stack(np.meshgrid(columns, rows), axis=-1).reshape(-1, 2)
    middles = shapely.multipoints(middles + rng.uniform(-0.42 * every, 0.42 * every, middles.shape))
    nearest = shapely.STRtree(shapely.get_parts(middles)).nearest(shapely.points(x, y).ravel())
    return nearest.reshape(x.shape), line_distance(shapely.voronoi_polygons(middles, only_edges=True), x, y)


def land_of(sea: shapely.Geometry, x: Array, y: Array) -> Array:
    """1 on the land that is large, 0 on that which is not."""
    west, south, east, north = sea.bounds
    large = [part for part in shapely.get_parts(shapely.box(west, south, east, north).difference(sea))
             if part.area > DIKED]  # fmt: skip
    return np.asarray(shapely.contains_xy(shapely.union_all(large).buffer(60), x, y), np.float64)


def terrain(cell: float = CELL) -> Terrain:
    """Heights from the distance to the real shore; everything else about them is invented."""
    grid = Grid(CRS, BOUNDS, cell, FINE)
    rng = np.random.default_rng(SEED)
    x, y = grid.middles()
    sea = sea_of(COASTLINE, grid)
    shore, diked = shore_distance(sea, x, y), land_of(sea, x, y)
    bend = 260 * noise(rng, x.shape, 40, 3)
    number, bank = parcels(rng, x + bend, y + bend[::-1], 2600.0)
    shore, diked, bank = (grid.finer(values) for values in (shore, diked, bank))
    number = number.repeat(grid.fine, axis=0).repeat(grid.fine, axis=1)
    breach = np.full(shore.shape, np.inf)
    for longitude, latitude, radius in BREACHES:
        breach = np.minimum(breach, grid.pixels_from(longitude, latitude) - radius)
    diked = step(0.4, 0.6, diked)
    east = grid.bounds[0] + grid.pixel * (np.arange(shore.shape[1]) + 0.5)
    dunes = step(DUNES[1], DUNES[0], east + 500 * noise(rng, shore.shape, 130, 3))
    rough = noise(rng, shore.shape, 90, 4)
    floor = rng.uniform(-1.5, 0.1, number.max() + 1)[number] + 0.25 * rough
    polder = np.maximum(floor, 2.3 - np.abs(bank - 20) / 16)
    crest = CREST - (CREST - SILL) * step(RAMP, 0, breach)
    polder = np.maximum(polder, crest - np.maximum(np.abs(shore - 110) - 60, 0) / 14)
    dune = 1.5 * step(0, 60, shore) + 7 * step(60, 200, shore) + 6 * (1 - np.abs(noise(rng, shore.shape, 34, 4)))
    dune = polder + (dune - polder) * dunes * step(1700, 1100, shore + 300 * rough)
    marsh = 1.3 * (1 - np.exp(-np.maximum(shore, 0) / 90)) + 0.25 * rough + 0.1
    land = marsh + (dune - marsh) * diked
    return Terrain(grid, shore, diked, bank, breach, np.where(shore > 0, land, bottom(rng, shore)))


def bottom(rng: np.random.Generator, shore: Array) -> Array:
    """The sea's: flats that fall dry at ebb, and channels between them."""
    flats = noise(rng, shore.shape, 330, 4)
    out = np.maximum(-shore, 0)
    channel = 1 - np.abs(noise(rng, shore.shape, 420, 3))
    flat = (0.75 + 0.35 * noise(rng, shore.shape, 60, 4)) * (1 - np.exp(-out / 130))
    deep = flat + 17 * step(900, 3200, out + 700 * flats) * np.clip(channel, 0.2, 1)
    return -deep - 7 * step(0.72, 0.95, channel) * step(120, 500, out)
