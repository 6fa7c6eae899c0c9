"""Ramps of the exact renderer's gradients, by hand and by very many points."""

import numpy as np
import pytest
from test_exact_gradients import KINDS, box, colour_of, full, max_difference, shaded

from vexture.drawing.drawing import Drawing
from vexture.drawing.group import Group
from vexture.drawing.paint import Spread, Stop
from vexture.renderers.exact import render_exact_colours

LEVEL = 1 / 255
PROMISE = 0.1 * LEVEL
BLACK, WHITE, RED = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (1.0, 0.0, 0.0)
ACROSS = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
HARD = Stop(0.5, WHITE), Stop(0.5, BLACK)


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        (full(ACROSS), 0.5),
        (full(((2.0, 0.0, 0.0), ACROSS[1])), 0.75),
        (full(((4.0, 0.0, 0.0), ACROSS[1]), spread=Spread.REPEAT), 0.5),
        (full(((3.0, 0.0, 0.0), ACROSS[1]), spread=Spread.REFLECT), 0.5),
        (full(((1.5, 0.0, 0.0), ACROSS[1]), spread=Spread.REFLECT), (0.5 + 0.375) / 1.5),
        (full(((1.0, 1.0, -0.5), ACROSS[1]), HARD), 0.5),
        (full(((0.0, 1.0, -0.21), ACROSS[1]), HARD), 0.71),
        (full(((1.0, 0.0, -0.5), (0.0, 1.0, -0.5)), HARD, focus=(0.0, 0.0)), np.pi / 16 * 4),
        (full(((0.5, 0.0, 0.0), (0.0, 0.5, 0.0)), HARD, focus=(0.0, 0.0)), np.pi / 4),
        (full(((9.0, 0.0, -4.0), (0.0, 9.0, -3.0)), HARD, focus=(0.0, 0.0)), np.pi / 324),
        (box(0.25, 0.0, 0.75, 1.0, shaded(ACROSS)), 0.25),
    ],
)
def test_red_of_one_pixel(path, expected):
    assert colour_of(path)[0] == pytest.approx(expected, abs=PROMISE / 10)


def test_a_cone_has_nothing_beside_it():
    """From the point (1, 1/2), of a sixth of a turn, in a disc of radius sin 30 degrees about the origin."""
    to_ramp = ((2.0, 0.0, -1.0 + 1.0), (0.0, 2.0, -1.0))
    cone = full(to_ramp, (Stop(0.0, RED),) * 2, focus=(2.0, 0.0))
    beside = 2 * 0.5 * 0.5 * (0.5 * np.sqrt(3.0))  # triangles above and below: the sides reach y = 0 and 1 at some x
    assert colour_of(cone)[3] == pytest.approx(1.0 - beside, abs=PROMISE / 10)


def test_a_ramp_is_straight_colour_times_opacity():
    """The mean of (1 - t) t, and of t."""
    fading = full(ACROSS, (Stop(0.0, RED, 0.0), Stop(1.0, BLACK, 1.0)))
    assert colour_of(fading) == pytest.approx([1 / 6, 0.0, 0.0, 0.5], abs=PROMISE / 10)


def ramp_place(gradient, x, y):
    """Place t on a ramp, with t as the unknown: |p - c0 - t (c1 - c0)| = r0 + t (r1 - r0); NaN if there is none."""
    (a, b, c), (d, e, f) = gradient.to_ramp
    px, py = a * x + b * y + c, d * x + e * y + f
    if gradient.focus is None:
        return px
    x0, r0 = gradient.focus
    two, one, zero = x0**2 - (1 - r0) ** 2, (px - x0) * x0 - r0 * (1 - r0), (px - x0) ** 2 + py**2 - r0**2
    with np.errstate(invalid="ignore"):
        found = [(-one + sign * np.sqrt(one**2 - two * zero)) / two for sign in (-1, 1)]
    return np.fmax(*(np.where(r0 + t * (1 - r0) >= 0, t, np.nan) for t in found))


def ramp_colour(gradient, x, y):
    """Premultiplied colours at points, (..., 4)."""
    t = ramp_place(gradient, x, y)
    if gradient.spread != Spread.PAD:
        t = t % 1.0 if gradient.spread == Spread.REPEAT else 1.0 - abs(t % 2.0 - 1.0)
    offsets = [stop.offset for stop in gradient.stops]
    parts = [np.interp(t, offsets, [(*stop.color, stop.opacity)[k] for stop in gradient.stops]) for k in range(4)]
    colour = np.stack([*(part * parts[3] for part in parts[:3]), parts[3]], axis=-1)
    return np.where(np.isnan(t)[..., None], 0.0, colour)


BOXES = (0.05, 0.11, 0.83, 0.92), (0.2, 0.03, 0.97, 0.7)


@pytest.mark.parametrize("kind", KINDS)
def test_boxes_agree_with_64_times_64_points_a_pixel(kind):
    """Points by the middle of squares of 1/64: an edge through a pixel is off by half of that, a jump likewise."""
    size, points = 6, 64
    below = KINDS["radial"]
    drawing = Drawing((box(*BOXES[0], below), box(*BOXES[1], KINDS[kind], 0)), groups=(Group(opacity=0.7),))
    places = (np.arange(size * points) + 0.5) / (size * points)
    x, y = np.meshgrid(places, 1.0 - places)
    colour = np.zeros((*x.shape, 4))
    for (x0, y0, x1, y1), paint, opacity in zip(BOXES, (below, KINDS[kind]), (1.0, 0.7), strict=True):
        inside = (x > x0) & (x < x1) & (y > y0) & (y < y1)
        over = opacity * np.where(inside[..., None], ramp_colour(paint.gradient, x, y), 0.0)
        colour = over + (1.0 - over[..., 3:]) * colour
    mean = colour.reshape(size, points, size, points, 4).mean(axis=(1, 3))
    image = render_exact_colours(drawing, size)
    assert max_difference(image, mean) < 0.7 / points
    inner = slice(2, 4)  # pixels without edges
    assert np.abs(image - mean)[inner, inner].mean() < 0.05 * LEVEL
