"""No sparkle: pictures of folded shapes against brute force, from far to very near, flat and tilted.

The footprint goes through the fold's exact Jacobian, so what is left is the fold's bend within a pixel.
"""

from functools import cache
from pathlib import Path

import numba
import numpy as np
import pytest

import vexture
from fold_reference import Numbers, errors, positions
from vexture.fold.blend import fold as folded
from vexture.fold.fold import Fold
from vexture.fold.shore import shore_fold
from vexture.renderers.cpu import coverage
from vexture.texture.texture import Texture

SHAPES = Path(__file__).parents[3] / "examples" / "shapes"
SIZE, SIDE, SECONDS = 64, 40, 10.0


@cache
def shape() -> tuple[Texture, Fold, Numbers]:
    """A texture, its fold about as steep as one may be, and a point of the shore."""
    drawing = vexture.read_svg(SHAPES / "ocean.svg")
    fold = shore_fold(drawing, amplitude=0.019, period=5.0, size=SIZE)
    cubics = np.concatenate([contour for path in drawing.paths for contour in path.contours])
    return vexture.convert(drawing), fold, cubics[len(cubics) * 37 // 100, 0]


@numba.njit
def shade(texels, uv, dx, dy, out):  # type: ignore[no-untyped-def]
    for k in range(len(uv)):
        right, up = (dx[k, 0], dx[k, 1]), (dy[k, 0], dy[k, 1])
        out[k] = coverage(texels, 0, (0, 0), (uv[k, 0], uv[k, 1]), right, up)


def drawn(texture: Texture, fold: Fold, to_unit: Numbers, seconds: float) -> Numbers:
    """Picture by the mirrors of both shaders."""
    y, x = np.mgrid[0:SIDE, 0:SIDE] + 0.5
    pixels = np.stack([x.ravel(), y.ravel()], axis=1)
    place = positions(to_unit, pixels)
    depth = (pixels @ to_unit[2, :2] + to_unit[2, 2])[:, None]
    steps = [(to_unit[:2, axis] - place * to_unit[2, axis]) / depth for axis in range(2)]
    now = fold.displacement * fold.progress(seconds)[..., None]
    found = folded(now, "none", np.zeros(place.shape, np.uint32), place, *steps)
    picture = np.empty(len(place))
    shade(texture.texels, *found, picture)
    return picture.reshape(SIDE, SIDE)


def view(pixel: float, seconds: float, *, tilted: bool) -> Numbers:
    """To the unit square from a picture around where the point of the shore is shown at a time."""
    _, fold, shore = shape()
    point = shore.copy() if pixel < 1 / SIZE else np.array([0.5, 0.5])
    for _ in range(60 if pixel < 1 / SIZE else 0):
        point -= fold.at([point], seconds)[0][0] - shore
    turned = np.array([[1.0, 0.3, 0.0], [-0.3, 1.0, 0.0], [0.0, 0.0, 1.0]])
    scale = np.diag([pixel, 8.0 * pixel if tilted else pixel, 1.0])
    bend = np.array([[1.0, 0, 0], [0, 1.0, 0], [0, 0.012 if tilted else 0.0, 1.0]])
    middle = np.array([[1.0, 0, -SIDE / 2], [0, 1.0, -SIDE / 2], [0, 0, 1.0]])
    there = np.array([[1.0, 0, point[0]], [0, 1.0, point[1]], [0, 0, 1.0]])
    return there @ scale @ bend @ turned @ middle


@pytest.mark.parametrize("tilted", [False, True])
@pytest.mark.parametrize("texels", [4.0, 0.25, 1 / 16, 1 / 1024])
def test_nothing_sparkles(texels: float, tilted: bool) -> None:
    texture, fold, _ = shape()
    found = []
    for seconds in np.linspace(0.3, SECONDS, 5):
        to_unit = view(texels / SIZE / (8.0 if tilted else 1.0), seconds, tilted=tilted)
        picture = drawn(texture, fold, to_unit, seconds)
        found.append(errors(picture, texture, fold, to_unit, seconds))
    assert sum(map(len, found)) > 100
    assert np.percentile(np.concatenate(found), 99) <= 8.0
