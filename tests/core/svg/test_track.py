"""Paths that texts follow: places and directions along lines, circles and jumps."""

from math import cos, pi, sin, tau

import numpy as np
import pytest

from vexture.bezier.convert import ellipse_cubics
from vexture.svg.outline import ShapeOutline
from vexture.svg.path_data import path_outlines
from vexture.svg.text.track import Track, track_of


def track(data: str) -> Track:
    found = track_of(path_outlines(data, 1e-6)[0])
    assert found is not None
    return found


def test_places_along_a_bent_line() -> None:
    bent = track("M1 1H4V5")
    assert bent.length == pytest.approx(7.0)
    assert bent.end == (4.0, 5.0)
    assert bent.at(2.0) == pytest.approx((3.0, 1.0, 0.0))
    assert bent.at(4.0) == pytest.approx((4.0, 2.0, pi / 2.0))
    assert bent.at(-0.1) is None
    assert bent.at(7.1) is None


@pytest.mark.parametrize("part", [0.05, 0.3, 0.5, 0.77, 0.98])
def test_places_and_directions_on_a_circle(part: float) -> None:
    outline = ShapeOutline(ellipse_cubics((0.0, 0.0), (10.0, 10.0), 1e-9), closed=True)
    circle = track_of([outline])
    assert circle is not None
    assert circle.length == pytest.approx(tau * 10.0, rel=1e-4)
    found = circle.at(part * circle.length)
    assert found is not None
    start = np.arctan2(*outline.cubics[0, 0, ::-1])
    sense = np.sign(np.linalg.det(outline.cubics[0, [0, 3]]))
    angle = start + sense * part * tau
    assert (found.x, found.y) == pytest.approx((10.0 * cos(angle), 10.0 * sin(angle)), abs=5e-3)
    assert cos(found.turn - angle - sense * pi / 2.0) == pytest.approx(1.0, abs=1e-5)


def test_the_way_back_has_the_same_places_in_opposite_directions() -> None:
    there = track("M0 0H4C4 3 1 3 1 6")
    back = there.reversed()
    assert back.length == pytest.approx(there.length)
    for distance in (0.5, 3.9, 6.0, 8.0):
        first, second = there.at(distance), back.at(there.length - distance)
        assert first is not None
        assert second is not None
        assert second[:2] == pytest.approx(first[:2])
        assert cos(second.turn - first.turn) == pytest.approx(-1.0)


def test_a_jump_to_the_next_part_has_no_length() -> None:
    parts = track("M0 0H3M10 10V14")
    assert parts.length == pytest.approx(7.0)
    assert parts.at(4.0) == pytest.approx((10.0, 11.0, pi / 2.0))


def test_a_path_without_length_is_none() -> None:
    assert track_of(path_outlines("M3 3h0", 1e-6)[0] or [ShapeOutline.polygon(np.full((2, 2), 3.0), False)]) is None
