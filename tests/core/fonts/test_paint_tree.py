"""Gradients and transforms of glyphs in colour are those of OpenType's formulas."""

import numpy as np
import pytest
from made import (
    BLUE,
    GREEN,
    PALETTE,
    RED,
    fill_shape,
    line,
    linear,
    radial,
    sweep,
    transform_paint,
)
from painted_glyphs import close, colour_at, layers_of, premultiplied


def ramp(first, last, part):
    a, b = (np.array(PALETTE[color]) for color in (first, last))
    color = a + (b - a) * part
    return np.array([*color[:3], 1.0]) * color[3]


@pytest.mark.parametrize(("extend", "part"), [("pad", 1.0), ("repeat", 0.275), ("reflect", 0.725)])
def test_linear_gradient_is_straightened_and_goes_on_beyond_its_stops(extend, part):
    """The stops are at 0.25 and 0.75, and p2 slants the gradient."""
    colors = line((0.25, RED, 1), (0.75, BLUE, 1), extend=extend)
    found = layers_of(fill_shape("square", linear(colors, 100, 0, 500, 400, 100, 500)))  # by x only, from 100 to 500
    middle, beyond = colour_at(found, (305, 305), (455, 105))
    close(middle, ramp(RED, BLUE, 0.525))
    close(beyond, ramp(RED, BLUE, part))


@pytest.mark.parametrize("extend", ["repeat", "reflect"])
def test_a_ramp_without_length_that_repeats_is_its_last_colour(extend):
    colors = line((0.5, RED, 1), (0.5, BLUE, 1), extend=extend)
    for gradient in (linear(colors, 100, 0, 500, 0, 100, 500), radial(colors, 300, 300, 50, 300, 300, 200)):
        (path,) = layers_of(fill_shape("square", gradient)).paths
        assert path.paint.gradient is None
        close(path.paint.color, PALETTE[BLUE][:3])


def test_radial_gradient_between_two_circles():
    colors = line((0, GREEN, 1), (1, BLUE, 1))
    found = layers_of(fill_shape("square", radial(colors, 405, 305, 100, 405, 305, 300)))
    centre, ring = colour_at(found, (405, 305), (605, 305))
    close(centre, premultiplied(GREEN))
    close(ring, ramp(GREEN, BLUE, 0.5))


def test_radial_gradient_from_below_radius_zero_and_to_zero():
    below = line((-1, GREEN, 1), (1, BLUE, 1))  # radius 0 is a quarter of the way between the stops
    found = layers_of(fill_shape("square", radial(below, 405, 305, 100, 405, 305, 300)))
    close(colour_at(found, (705, 305))[0], premultiplied(BLUE))
    close(colour_at(found, (605, 305))[0], ramp(GREEN, BLUE, 0.75))
    inwards = layers_of(fill_shape("square", radial(line((0, GREEN, 1), (1, BLUE, 1)), 405, 305, 300, 405, 305, 0)))
    close(
        colour_at(inwards, (405, 305))[0], ramp(GREEN, BLUE, 1.0 - 3.8 / 300)
    )  # the mean distance in its pixel is 3.8
    close(colour_at(inwards, (555, 305))[0], ramp(GREEN, BLUE, 0.5))


@pytest.mark.parametrize("points", [(100, 0, 500, 0, 700, 0), (100, 0, 500, 0, 100, 0)])
def test_a_gradient_without_direction_shows_nothing(points):
    assert layers_of(fill_shape("square", linear(line((0, RED, 1), (1, BLUE, 1)), *points))).paths == ()


def middle(place):
    """The middle of the hundredth of the em that contains a place."""
    return 10 * np.floor(place / 10) + 5


CENTER = (555, 455)
TURNS = np.radians(np.arange(10, 355, 13))
AROUND = [(middle(CENTER[0] + 250 * np.cos(turn)), middle(CENTER[1] + 250 * np.sin(turn))) for turn in TURNS]
"""Points around the centre, in the middles of pixels."""


@pytest.mark.parametrize("extend", ["pad", "repeat", "reflect"])
@pytest.mark.parametrize(("start", "end"), [(0, 360), (30, 150), (200, 80), (90, 90)])
def test_sweep_gradient_by_the_angle_of_a_point(extend, start, end):
    colors = line((0.25, RED, 1), (0.75, BLUE, 1), extend=extend)
    found = layers_of(fill_shape("disc", sweep(colors, *CENTER, start, end)))
    if start == end and extend != "pad":
        assert found.paths == ()
        return
    for point, color in zip(AROUND, colour_at(found, *AROUND), strict=True):
        angle = np.degrees(np.arctan2(point[1] - CENTER[1], point[0] - CENTER[0])) % 360
        part = (angle - start) / (end - start) if end != start else float(angle > start)
        part = (part - 0.25) / 0.5
        if extend == "pad":
            part = min(max(part, 0.0), 1.0)
        elif extend == "repeat":
            part %= 1.0
        else:
            part = 1.0 - abs(part % 2.0 - 1.0)
        if min(part, 1.0 - part) > 0.08 or extend == "pad":
            assert color == pytest.approx(ramp(RED, BLUE, part), abs=4 / 255)
    (note,) = found.notes
    assert str(note).startswith("sweep gradient drawn in ")


def test_sweep_gradient_in_a_transform_masks_and_is_cut_by_its_outline():
    colors = line((0, RED, 1), (1, BLUE, 0.5))
    plain = fill_shape("disc", sweep(colors, *CENTER, 0, 360))
    found = layers_of(transform_paint(plain, 0, 0.5, -0.5, 0, 700, 100))  # turned by 90 degrees
    places = [(middle(700 - 0.5 * y), middle(100 + 0.5 * x)) for x, y in AROUND]
    for (x, y), color in zip(places, colour_at(found, *places), strict=True):
        angle = np.degrees(np.arctan2(700 - x - 0.5 * CENTER[1], y - 100 - 0.5 * CENTER[0])) % 360
        assert color == pytest.approx(premultiplied_ramp(angle / 360), abs=4 / 255)
    assert colour_at(found, (475, 150))[0] == pytest.approx([0, 0, 0, 0])  # outside the disc


def premultiplied_ramp(part):
    """From red to blue of half the opacity, which are mixed premultiplied."""
    one, other = (np.array([*PALETTE[color][:3], 1.0]) * PALETTE[color][3] for color in (RED, BLUE))
    return (1.0 - part) * one + part * 0.5 * other


def test_sweep_gradient_that_repeats_very_often_is_its_mean():
    colors = line((0, RED, 1), (0.001, BLUE, 1), extend="repeat")
    found = layers_of(fill_shape("disc", sweep(colors, *CENTER, 0, 180)))
    assert [str(note) for note in found.notes] == ["sweep gradient that repeats very often, shown as its mean colour"]


def test_a_transform_moves_outline_and_gradient():
    inner = fill_shape("left", linear(line((0, RED, 1), (1, BLUE, 1)), 100, 0, 500, 0, 100, 500))
    found = layers_of(transform_paint(inner, 0.5, 0, 0, 0.5, 300, 200))
    assert found.paths[0].box.tolist() == [[350.0, 200.0], [550.0, 550.0]]
    close(colour_at(found, (455, 305))[0], ramp(RED, BLUE, 0.525))
