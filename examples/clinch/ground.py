"""A synthetic picture of the ground, such as a satellite might take: for the terrain of this folder."""

import numpy as np
from PIL import Image
from scenery.grid import noise, step
from scenery.paint import GRASS, MEADOW, RIVER, SCRUB, WOOD, built_up, crops, finished, hillshade, paint, town

from .terrain import Terrain

NOTE = "Synthetic picture, computed from heights of SRTM; not a photograph and not a map."
SEED = 1936
TOWNS = ((-84.1547, 36.2173, 900.0), (-84.140, 36.196, 450.0), (-84.118, 36.193, 380.0))  # longitude, latitude, metres
STEEP = (0.10, 0.22)  # slopes at which fields begin to end, and have ended


def ground(land: Terrain) -> Image.Image:
    """The picture, over the terrain's bounds."""
    rng = np.random.default_rng(SEED)
    grid = land.grid
    height, bank = grid.finer(land.height), grid.finer(land.bank)
    shape = height.shape
    rough, patches, speckle = noise(rng, shape, 120, 5), noise(rng, shape, 200, 4), rng.normal(size=shape)
    slope = np.hypot(*np.gradient(height, grid.pixel))
    level = step(STEEP[1], STEEP[0], slope + 0.03 * rough) * step(380, 320, height)
    picture = np.empty((*shape, 3))
    picture[:] = WOOD
    paint(picture, (62, 80, 46), step(-0.4, 0.7, rough))
    paint(picture, MEADOW, level)
    paint(picture, GRASS, 0.6 * level * step(0.0, 0.6, patches))
    houses = built_up(grid, TOWNS, patches) * level * step(25, 60, bank)
    crops(rng, picture, grid.pixel, level * step(0.1, 0.2, patches - houses) * step(40, 60, bank))
    town(rng, picture, grid.pixel, houses)
    trees = step(0.55, 1.0, noise(rng, shape, 7, 3) + 0.35 * rough)
    paint(picture, WOOD, 0.8 * trees * (1 - 0.7 * level))
    paint(picture, SCRUB, 0.7 * step(55, 25, bank + 15 * rough) * level)
    picture *= hillshade(height + 1.5 * noise(rng, shape, 24, 3) * (1 - level), grid.pixel)[..., None]
    picture *= (1 + 0.05 * speckle)[..., None]
    paint(picture, RIVER, step(4, -4, bank))
    return finished(picture)
