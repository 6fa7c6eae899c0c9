"""A synthetic picture of the ground, such as a satellite might take: for the terrain of this folder."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageFilter

from .terrain import BOUNDS, CELL, CRS, FINE, SEED, Array, Terrain, noise, step

NOTE = "Synthetic picture, computed from the coastline of GSHHG; not a photograph and not a map."
PIXEL = CELL / FINE  # metres
QUALITY = 82  # of the JPEG
LIGHT = (-0.5, 0.5, 0.7)  # where the sun is: east, north, up
TOWN = (  # longitude, latitude, metres
    (-122.022, 36.972, 1700.0), (-121.985, 36.968, 1900.0), (-122.045, 36.959, 1300.0),
    (-122.000, 36.972, 1200.0), (-121.963, 36.978, 900.0),
)  # fmt: skip
DEEP, SHALLOW, BREAKING = (14, 42, 62), (52, 112, 118), (120, 150, 140)
WET_SAND, SAND, RIVER = (150, 131, 102), (214, 196, 158), (52, 78, 76)
GRASS, SCRUB, WOOD, MEADOW = (149, 138, 96), (98, 104, 66), (44, 62, 40), (104, 116, 62)
CROPS = ((120, 126, 70), (150, 128, 92), (96, 112, 58), (172, 152, 112), (84, 100, 54), (134, 112, 80))
ROOFS = ((138, 130, 122), (152, 144, 134), (122, 108, 100), (176, 170, 162), (140, 104, 86), (112, 108, 108))
STREET = (122, 120, 116)

Color = tuple[int, int, int] | NDArray[np.float64]


def paint(picture: Array, color: Color, share: Array) -> None:
    """Lay a colour over a picture; where the share is 1 nothing else is left."""
    picture += share[..., None] * (np.asarray(color, np.float64) - picture)


def hillshade(height: Array) -> Array:
    """Light on the ground: 1 where it is level."""
    down, right = np.gradient(height, PIXEL)
    east, north, up = LIGHT
    light = (up - 1.5 * (east * right - north * down)) / np.sqrt(1 + 2.25 * (right**2 + down**2))
    return np.clip(light / up, 0.35, 1.5)


def turned(shape: tuple[int, int], degrees: float) -> tuple[Array, Array]:
    """Metres along two axes that are turned against the picture's."""
    y, x = np.mgrid[: shape[0], : shape[1]] * PIXEL
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return c * x + s * y, c * y - s * x


def chosen(rng: np.random.Generator, i: Array, j: Array, colors: tuple[Color, ...]) -> Array:
    """One of some colours for each cell of a grid, and a little of its own."""
    i, j = (np.int64(np.floor(k - k.min())) for k in (i, j))
    size = (i.max() + 1, j.max() + 1)
    table = np.array(colors, np.float64)[rng.integers(len(colors), size=size)]
    return (table * rng.uniform(0.85, 1.12, (*size, 1)))[i, j]


def crops(rng: np.random.Generator, picture: Array, land: Terrain, share: Array) -> None:
    """Fields with furrows and hedges."""
    u, v = turned(share.shape, 24)
    u, v = u + 60 * np.floor(v / 170 % 7), v + 0.03 * u
    color = chosen(rng, u / 260, v / 170, CROPS)
    color *= (1 + 0.05 * np.sin(2 * np.pi * np.where(np.floor(u / 260) % 2, u, v) / 24))[..., None]
    hedge = np.minimum(u % 260, v % 170) < 9
    paint(picture, color, share)
    paint(picture, SCRUB, 0.8 * share * hedge)


def town(rng: np.random.Generator, picture: Array, share: Array) -> None:
    """Blocks of houses with gardens, streets between them."""
    for degrees, where in ((-28, 0), (9, 1)):
        u, v = turned(share.shape, degrees)
        side = turned(share.shape, 70)[0]
        here = share * ((side > 5200) == where)
        gardens = chosen(rng, u / 18, v / 20, ((92, 100, 66), (116, 112, 84), (66, 80, 50), (80, 92, 58)))
        roofs = chosen(rng, u / 18, v / 20, ROOFS)
        house = (np.abs(u % 18 - 9) < 6.5) & (np.abs(v % 40 - 20) < 14)
        paint(picture, gardens, 0.85 * here)
        paint(picture, roofs, 0.8 * here * house)
        wide = (u % 720 < 15) | (v % 480 < 15)
        paint(picture, STREET, here * np.where((u % 180 < 9) | (v % 80 < 8), 0.75, 0))
        paint(picture, (136, 134, 130), here * wide)


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
    density = built_up(shape, shore, patches) * step(4, 6, height) * step(110, 150, shore + 20 * rough)
    density = np.maximum(density, 0.9 * built_up(shape, shore, patches) * step(60, 110, creek) * (shore > 110))
    farmed = step(0.3, 0.42, patches - 0.9 * density + 0.1) * step(150, 180, shore) * (1 - step(55, 80, height))
    crops(rng, picture, land, farmed * step(90, 120, creek))
    town(rng, picture, density)
    trees = step(0.65, 1.1, noise(rng, shape, 7, 3) + 0.35 * rough)
    paint(picture, WOOD, 0.85 * trees * step(130, 200, shore) * (1 - farmed))
    paint(picture, (60, 82, 48), 0.7 * step(60, 25, creek) * step(60, 200, shore))
    paint(picture, RIVER, step(30, 20, creek) * step(6, 3, height))
    picture *= hillshade(height + 1.2 * noise(rng, shape, 24, 3) * step(200, 900, shore))[..., None]
    picture *= (1 + 0.05 * speckle * (shore > 0))[..., None]
    coast(picture, shore, rough, speckle)
    image = Image.fromarray(np.uint8(np.clip(picture, 0, 255)))
    return image.filter(ImageFilter.GaussianBlur(0.45))


def built_up(shape: tuple[int, int], shore: Array, patches: Array) -> Array:
    """Where houses are, 0..1."""
    import pyproj

    to_metres = pyproj.Transformer.from_crs(4326, CRS, always_xy=True)
    y, x = np.mgrid[: shape[0], : shape[1]] * PIXEL
    total = np.zeros(shape)
    for longitude, latitude, radius in TOWN:
        east, north = to_metres.transform(longitude, latitude)
        away = np.hypot(x - (east - BOUNDS[0]), y - (BOUNDS[3] - north))
        total = np.maximum(total, step(radius, 0.6 * radius, away + 420 * patches))
    return total * (shore > 0)


def coast(picture: Array, shore: Array, rough: Array, speckle: Array) -> None:
    """Beaches, and the bottom of the sea as it shows through the water."""
    edge = shore + 14 * rough
    beach = 62 + 30 * rough
    paint(picture, np.array(SAND) + 5 * speckle[..., None], step(beach + 14, beach - 6, edge))
    paint(picture, WET_SAND, step(22, 8, edge))
    depth = -shore + 60 * rough * step(0, 300, -shore)
    water = np.empty_like(picture)
    water[:] = SHALLOW
    paint(water, DEEP, 1 - np.exp(-np.maximum(depth, 0) / 700))
    paint(water, BREAKING, 0.5 * np.exp(-np.maximum(depth, 0) / 60))
    paint(picture, water, step(4, -14, shore))


def write_ground(land: Terrain, path: Path) -> None:
    """Write the picture as JPEG, and beside it as a GeoTIFF that knows where it is."""
    import rasterio

    image = ground(land)
    exif = Image.Exif()
    exif[0x010E] = NOTE  # ImageDescription
    image.save(path, quality=QUALITY, optimize=True, comment=NOTE, exif=exif)
    where = rasterio.Affine(PIXEL, 0, BOUNDS[0], 0, -PIXEL, BOUNDS[3])
    profile = {"driver": "GTiff", "width": image.width, "height": image.height, "count": 3, "dtype": "uint8"}
    profile |= {"crs": CRS, "transform": where, "compress": "JPEG", "photometric": "YCBCR", "jpeg_quality": QUALITY}
    with rasterio.open(path.with_suffix(".tif"), "w", **profile) as file:
        file.update_tags(TIFFTAG_IMAGEDESCRIPTION=NOTE)
        file.write(np.moveaxis(np.asarray(image), 2, 0))
