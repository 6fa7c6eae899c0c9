"""The exact renderer's gradients: by hand, by very many points, and by larger images."""

from dataclasses import replace

import numpy as np
import pytest
from exact_shapes import circle

from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Blend, Group
from vexture.drawing.paint import Gradient, Paint, Spread, Stop
from vexture.renderers.exact import render_exact_colours
from vexture.renderers.view import view_matrix, window

LEVEL = 1 / 255
PROMISE = 0.1 * LEVEL
PIXEL = (1, 1)
BLACK, WHITE, RED = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (1.0, 0.0, 0.0)
ACROSS = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
RAMP = Stop(0.0, BLACK), Stop(1.0, WHITE)


def box(x0, y0, x1, y1, paint, group=-1):
    corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    return replace(Drawing.polygon(corners).paths[0], paint=paint, group=group)


def shaded(to_ramp, stops=RAMP, spread=Spread.PAD, focus=None):
    return Paint.from_gradient(Gradient(to_ramp, stops, spread, focus))


def colour_of(*paths, groups=(), view=None):
    """Of a drawing that fills one pixel."""
    return render_exact_colours(Drawing(paths, groups=groups), PIXEL, view)[0, 0].tolist()


def full(*gradient, group=-1, **options):
    return box(0.0, 0.0, 1.0, 1.0, shaded(*gradient, **options), group)


def max_difference(a, b):
    return float(np.abs(np.asarray(a, np.float64) - b).max())


# ---- by hand


def test_compositing_is_per_point():
    """The mean of a product is none of means: t t, where two ramps multiply; t + t (1 - t), where one covers one."""
    groups = (Group(blend=Blend.MULTIPLY),)
    assert colour_of(full(ACROSS), full(ACROSS, group=0), groups=groups)[0] == pytest.approx(1 / 3, abs=PROMISE / 10)
    veil = Stop(0.0, WHITE, 0.0), Stop(1.0, WHITE, 1.0)
    assert colour_of(full(ACROSS), full(ACROSS, veil))[0] == pytest.approx(2 / 3, abs=PROMISE / 10)
    half = colour_of(full(ACROSS), full(ACROSS, veil, group=0), groups=(Group(opacity=0.5),))
    assert half[0] == pytest.approx(0.5 + 0.5 / 6, abs=PROMISE / 10)


# ---- by points


STOPS = Stop(0.1, (0.9, 0.1, 0.1), 0.8), Stop(0.4, (0.2, 0.9, 0.3)), Stop(0.8, (0.1, 0.2, 0.9), 0.6)
KINDS = {
    "linear": shaded(((1.5, 0.7, -0.4), (0.0, 1.0, 0.0)), STOPS),
    "reflected": shaded(((3.5, 1.7, -0.4), (0.0, 1.0, 0.0)), STOPS, Spread.REFLECT),
    "repeated": shaded(((3.5, 1.7, -0.4), (0.0, 1.0, 0.0)), STOPS, Spread.REPEAT),
    "radial": shaded(((2.1, 0.3, -1.0), (-0.2, 2.5, -1.2)), STOPS, focus=(0.0, 0.0)),
    "focal": shaded(((2.1, 0.3, -1.0), (-0.2, 2.5, -1.2)), STOPS, Spread.REFLECT, (0.4, 0.2)),
    "focal repeated": shaded(((4.1, 0.3, -2.0), (-0.2, 3.5, -1.2)), STOPS, Spread.REPEAT, (0.5, 0.0)),
    "cone": shaded(((4.1, 0.3, -1.0), (-0.2, 3.5, -1.2)), STOPS, focus=(1.7, 0.2)),
    "touching": shaded(((4.1, 0.3, -1.0), (-0.2, 3.5, -1.2)), STOPS, focus=(0.7499999, 0.25)),
    "strip": shaded(((4.1, 0.3, -1.0), (-0.2, 3.5, -1.2)), STOPS, focus=(0.7, 1.0)),
    "larger focal circle": shaded(((4.1, 0.3, -1.0), (-0.2, 3.5, -1.2)), STOPS, focus=(0.2, 2.0)),
}


# ---- by larger images


def crowd():
    """Discs in all kinds of gradients, nested groups and some blend modes."""
    rng = np.random.default_rng(3)
    blends = Blend.NORMAL, Blend.MULTIPLY, Blend.NORMAL, Blend.SCREEN, Blend.HARD_LIGHT
    groups = tuple(Group(k - 1 if k % 2 else -1, 0.8, blend) for k, blend in enumerate(blends))
    paths = []
    for k, paint in enumerate(KINDS.values()):
        middle, radius = rng.uniform(0.3, 0.7, 2), rng.uniform(0.1, 0.3)
        paths.append(Path((middle + radius / 0.5 * (circle(0.5) - 0.5),), paint=paint, group=k // 2))
    return Drawing(tuple(paths), groups=groups)


PROJECTIVE = np.array([[0.11, 0.01, 0.05], [0.005, -0.1, 0.95], [0.003, 0.05, 0.8]])


@pytest.mark.parametrize(
    "view", [None, window(0.1, 0.2, 0.7, 0.6, rotate=33.0), PROJECTIVE], ids=["fit", "turned", "far"]
)
def test_a_larger_image_averages_to_the_smaller_one(view):
    size, times = (8, 6), 3
    matrix = view_matrix(view, size)
    large = render_exact_colours(crowd(), (24, 18), matrix @ np.diag([1 / times, 1 / times, 1.0])).astype(np.float64)
    mean = large.reshape(6, times, 8, times, 4).mean(axis=(1, 3))
    image = render_exact_colours(crowd(), size, matrix)
    assert image[..., 3].max() > 0.5
    assert max_difference(image, mean) < PROMISE
