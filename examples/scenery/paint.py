"""What a synthetic picture of the ground is painted with: fields, houses, beaches, the bottom of the sea."""

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageFilter

from .grid import Array, Grid, step

LIGHT = (-0.5, 0.5, 0.7)  # where the sun is: east, north, up
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


def hillshade(height: Array, pixel: float) -> Array:
    """Light on the ground: 1 where it is level."""
    down, right = np.gradient(height, pixel)
    east, north, up = LIGHT
    light = (up - 1.5 * (east * right - north * down)) / np.sqrt(1 + 2.25 * (right**2 + down**2))
    return np.clip(light / up, 0.35, 1.5)


def turned(shape: tuple[int, ...], pixel: float, degrees: float) -> tuple[Array, Array]:
    """Metres along two axes that are turned against the picture's."""
    y, x = np.mgrid[: shape[0], : shape[1]] * pixel
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return c * x + s * y, c * y - s * x


def chosen(rng: np.random.Generator, i: Array, j: Array, colors: tuple[Color, ...]) -> Array:
    """One of some colours for each cell of a grid, and a little of its own."""
    i, j = (np.int64(np.floor(k - k.min())) for k in (i, j))
    size = (i.max() + 1, j.max() + 1)
    table = np.array(colors, np.float64)[rng.integers(len(colors), size=size)]
    return np.asarray((table * rng.uniform(0.85, 1.12, (*size, 1)))[i, j])


def crops(rng: np.random.Generator, picture: Array, pixel: float, share: Array) -> None:
    """Fields with furrows and hedges."""
    u, v = turned(share.shape, pixel, 24)
    u, v = u + 60 * np.floor(v / 170 % 7), v + 0.03 * u
    color = chosen(rng, u / 260, v / 170, CROPS)
    color *= (1 + 0.05 * np.sin(2 * np.pi * np.where(np.floor(u / 260) % 2, u, v) / 24))[..., None]
    hedge = np.minimum(u % 260, v % 170) < 9
    paint(picture, color, share)
    paint(picture, SCRUB, 0.8 * share * hedge)


def town(rng: np.random.Generator, picture: Array, pixel: float, share: Array) -> None:
    """Blocks of houses with gardens, streets between them."""
    for degrees, where in ((-28, 0), (9, 1)):
        u, v = turned(share.shape, pixel, degrees)
        side = turned(share.shape, pixel, 70)[0]
        here = share * ((side > 5200) == where)
        gardens = chosen(rng, u / 18, v / 20, ((92, 100, 66), (116, 112, 84), (66, 80, 50), (80, 92, 58)))
        roofs = chosen(rng, u / 18, v / 20, ROOFS)
        house = (np.abs(u % 18 - 9) < 6.5) & (np.abs(v % 40 - 20) < 14)
        paint(picture, gardens, 0.85 * here)
        paint(picture, roofs, 0.8 * here * house)
        wide = (u % 720 < 15) | (v % 480 < 15)
        paint(picture, STREET, here * np.where((u % 180 < 9) | (v % 80 < 8), 0.75, 0))
        paint(picture, (136, 134, 130), here * wide)


def built_up(grid: Grid, places: tuple[tuple[float, float, float], ...], patches: Array) -> Array:
    """Where houses are, 0..1: around places of so many metres' radius, ragged."""
    total = np.zeros(patches.shape)
    for longitude, latitude, radius in places:
        away = grid.pixels_from(longitude, latitude)
        total = np.maximum(total, step(radius, 0.6 * radius, away + min(420, 0.47 * radius) * patches))
    return total


def coast(picture: Array, shore: Array, rough: Array, speckle: Array) -> None:
    """Beaches, and the bottom of the sea as it shows through the water."""
    edge = shore + 14 * rough
    beach = 62 + 30 * rough
    paint(picture, np.array(SAND) + 5 * speckle[..., None], step(beach + 14, beach - 6, edge))
    paint(picture, WET_SAND, step(22, 8, edge))
    sea(picture, shore, rough)


def sea(picture: Array, shore: Array, rough: Array) -> None:
    """The bottom of the sea, darker the farther it is from the shore."""
    depth = -shore + 60 * rough * step(0, 300, -shore)
    water = np.empty_like(picture)
    water[:] = SHALLOW
    paint(water, DEEP, 1 - np.exp(-np.maximum(depth, 0) / 700))
    paint(water, BREAKING, 0.5 * np.exp(-np.maximum(depth, 0) / 60))
    paint(picture, water, step(4, -14, shore))


def finished(picture: Array) -> Image.Image:
    """The picture as one that can be written."""
    image = Image.fromarray(np.uint8(np.clip(picture, 0, 255)))
    return image.filter(ImageFilter.GaussianBlur(0.45))
