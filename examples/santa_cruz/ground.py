"""A synthetic picture of the ground, such as a satellite might take: for the terrain of this folder."""

import numpy as np
from PIL import Image
from scenery.grid import noise, step
from scenery.paint import (
    GRASS,
    MEADOW,
    RIVER,
    SCRUB,
    WOOD,
    built_up,
    coast,
    crops,
    finished,
    hillshade,
    paint,
    town,
)  # fmt: skip

from .terrain import GRID, SEED, Terrain

NOTE = "Synthetic picture, computed from the coastline of GSHHG; not a photograph and not a map."
TOWN = (  # longitude, latitude, metres
    (-122.022, 36.972, 1700.0), (-121.985, 36.968, 1900.0), (-122.045, 36.959, 1300.0),
    (-122.000, 36.972, 1200.0), (-121.963, 36.978, 900.0),
)  # fmt: skip


def ground(land: Terrain) -> Image.Image:
    """The picture, over the terrain's bounds."""
    rng = np.random.default_rng(SEED + 1)
    shore, creek, height = land
    shape = shore.shape
    rough, patches, speckle = noise(rng, shape, 120, 5), noise(rng, shape, 260, 4), rng.normal(size=shape)
    picture = np.empty((*shape, 3))
    picture[:] = GRASS
    paint(picture, SCRUB, step(-0.3, 0.5, rough))
    paint(picture, MEADOW, 0.7 * step(0.1, 0.8, patches))
    far = step(1600, 3600, shore + 900 * patches)
    paint(picture, WOOD, step(-0.5, 0.3, rough + 1.6 * far - 0.9 + 0.4 * patches) * step(300, 900, shore))
    houses = built_up(GRID, TOWN, patches) * (shore > 0)
    density = houses * step(4, 6, height) * step(110, 150, shore + 20 * rough)
    density = np.maximum(density, 0.9 * houses * step(60, 110, creek) * (shore > 110))
    farmed = step(0.3, 0.42, patches - 0.9 * density + 0.1) * step(150, 180, shore) * (1 - step(55, 80, height))
    crops(rng, picture, GRID.pixel, farmed * step(90, 120, creek))
    town(rng, picture, GRID.pixel, density)
    trees = step(0.65, 1.1, noise(rng, shape, 7, 3) + 0.35 * rough)
    paint(picture, WOOD, 0.85 * trees * step(130, 200, shore) * (1 - farmed))
    paint(picture, (60, 82, 48), 0.7 * step(60, 25, creek) * step(60, 200, shore))
    paint(picture, RIVER, step(30, 20, creek) * step(6, 3, height))
    picture *= hillshade(height + 1.2 * noise(rng, shape, 24, 3) * step(200, 900, shore), GRID.pixel)[..., None]
    picture *= (1 + 0.05 * speckle * (shore > 0))[..., None]
    coast(picture, shore, rough, speckle)
    return finished(picture)
