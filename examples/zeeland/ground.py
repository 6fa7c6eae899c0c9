"""A synthetic picture of the ground, such as a satellite might take: for the terrain of this folder."""

import numpy as np
from PIL import Image
from scenery.grid import noise, step
from scenery.paint import (
    GRASS,
    MEADOW,
    SAND,
    SCRUB,
    WET_SAND,
    WOOD,
    built_up,
    crops,
    finished,
    hillshade,
    paint,
    sea,
    town,
)  # fmt: skip

from .terrain import SEED, Terrain

NOTE = "Synthetic picture, computed from the coastline of GSHHG; not a photograph and not a map."
TOWNS = (  # longitude, latitude, metres
    (3.917, 51.650, 1100.0), (3.832, 51.700, 500.0), (3.744, 51.700, 650.0), (3.860, 51.730, 450.0),
    (3.950, 51.690, 400.0), (3.790, 51.590, 500.0), (3.982, 51.645, 350.0),
)  # fmt: skip
GREEN = (112, 128, 74)


def ground(land: Terrain) -> Image.Image:
    """The picture, over the terrain's bounds."""
    rng = np.random.default_rng(SEED + 1)
    grid, shore, diked, bank, _, height = land
    shape = shore.shape
    rough, patches, speckle = noise(rng, shape, 90, 5), noise(rng, shape, 180, 4), rng.normal(size=shape)
    picture = np.empty((*shape, 3))
    picture[:] = MEADOW
    paint(picture, SCRUB, step(-0.2, 0.6, rough) * (1 - diked))
    inland = step(230, 260, shore)
    crops(rng, picture, grid.pixel, step(-0.35, -0.25, patches) * diked * inland * step(3.2, 2.4, height))
    town(rng, picture, grid.pixel, built_up(grid, TOWNS, patches) * diked * inland)
    paint(picture, GREEN, 0.8 * diked * np.maximum(step(80, 50, np.abs(shore - 110)), step(55, 30, bank) * inland))
    dunes = step(5.9, 6.6, height)
    paint(picture, GRASS, dunes)
    paint(picture, SAND, dunes * step(0.1, 0.5, rough))
    paint(picture, WOOD, dunes * step(500, 700, shore) * step(0.0, 0.4, patches))
    picture *= hillshade(1.5 * height, grid.pixel)[..., None]
    picture *= (1 + 0.05 * speckle * (shore > 0))[..., None]
    edge = shore + 10 * rough
    paint(picture, np.array(SAND) + 5 * speckle[..., None], step(62, 48, edge))
    sea(picture, shore, rough)
    paint(picture, WET_SAND, 0.75 * step(-2.2, -1.0, height) * step(30, 5, shore))  # the flats
    return finished(picture)
