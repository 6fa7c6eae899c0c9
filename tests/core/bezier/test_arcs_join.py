"""The join `arcs` (SVG 2, 13.5.6): along the circles of curvature of both sides, up to where they meet."""

import numpy as np
import pytest

from vexture.bezier.convert import line_cubics, turn_cubics
from vexture.bezier.joins import ARCS, BUTT, MITER_CLIP, ROUND_JOIN
from vexture.bezier.stroke import stroke_path

HALF = 1.0
T = np.linspace(0.0, 1.0, 100)[:, None]


def turned(x, y, angle):
    return np.array([x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle)])


def arm(direction, bend, forth):
    """Cubics along a circle of curvature `bend`, which begin (forth 1) or end (-1) at the origin in a direction.

    Returns the centre of the circle too; for no bend, cubics along a line and None.
    """
    if bend == 0.0:
        far = forth * 5.0 * direction
        ends = (np.zeros(2), far) if forth > 0 else (far, np.zeros(2))
        return line_cubics(ends[0][None], ends[1][None]), None
    center = turned(*direction, np.pi / 2) / bend
    u, v = -center, turned(*-center, np.pi / 2)
    angle = np.copysign(0.8, bend)
    start = 0.0 if forth > 0 else -angle
    point = center + u * np.cos(start) + v * np.sin(start)
    cubics = []
    for step in turn_cubics(tuple(center), tuple(u), tuple(v), start, angle, 4):
        cubics.append(np.concatenate([point[None], np.reshape(step, (3, 2))]))
        point = cubics[-1][3]
    return np.array(cubics), center


def corner(turn, bends):
    """A path through the origin that turns there; its cubics, and the circles of curvature of both arms."""
    one, two = np.array([1.0, 0.0]), turned(1.0, 0.0, turn)
    (before, first), (after, second) = arm(one, bends[0], -1.0), arm(two, bends[1], 1.0)
    path = np.concatenate([before, after])
    path[1:, 0] = path[:-1, 3]
    return path, (first, second)


def points_of(path, join, limit=50.0):
    style = np.array([2 * HALF, BUTT, join, limit, 1e-4, 0.0])
    contours, _ = stroke_path(path, np.array([len(path)]), np.array([False]), style, np.zeros(0))
    s = 1.0 - T
    p0, p1, p2, p3 = np.moveaxis(contours[:, None], 2, 0)
    return (s**3 * p0 + 3 * s * s * T * p1 + 3 * s * T * T * p2 + T**3 * p3).reshape(-1, 2)


def tips(points, turn):
    """Points beyond half the width from the corner, on the outer side, between the normals of both arms."""
    ahead = points[:, 0] > 1e-3
    behind = points @ turned(1.0, 0.0, turn) < -1e-3
    return points[ahead & behind & (np.hypot(*points.T) > HALF + 1e-3)]


@pytest.mark.parametrize("turn", [1.9, -1.9])
@pytest.mark.parametrize(
    "bends", [(0.1, 0.1), (0.1, 0.0), (0.0, 0.1), (-0.1, -0.1), (0.1, -0.05), (-0.05, 0.1), (0.12, 0.15)]
)
def test_the_sides_go_on_along_their_circles(turn, bends):
    path, circles = corner(turn, bends)
    side = -np.sign(turn)  # the outer side is on the right of a left turn
    found = tips(points_of(path, ARCS), turn)
    off = []
    for direction, center in zip((np.array([1.0, 0.0]), turned(1.0, 0.0, turn)), circles, strict=True):
        left = turned(*direction, np.pi / 2)
        if center is None:
            off.append(np.abs(found @ left - side * HALF))
        else:
            radius = np.hypot(*(center - side * HALF * left))
            off.append(np.abs(np.hypot(*(found - center).T) - radius))
    assert len(found) > 20
    assert np.min(off, axis=0).max() < 2e-4
    assert all((one < 2e-4).sum() > 1 for one in off)


def test_two_lines_have_a_clipped_miter():
    path, _ = corner(2.2, (0.0, 0.0))
    for limit in (1.0, 1.5, 10.0):
        np.testing.assert_array_equal(points_of(path, ARCS, limit), points_of(path, MITER_CLIP, limit))


@pytest.mark.parametrize("bends", [(1.2, 0.1), (0.1, -1.2)])
def test_bends_tighter_than_the_stroke_have_a_round_join(bends):
    path, _ = corner(1.9, bends)
    np.testing.assert_array_equal(points_of(path, ARCS), points_of(path, ROUND_JOIN))


@pytest.mark.parametrize("bends", [(-0.4, -0.4), (-0.3, -0.6), (0.6, 0.1)])
def test_circles_that_do_not_meet_change_their_radii_until_they_touch(bends):
    """The join then ends in a tip in whose middle both arcs have one direction."""
    path, _ = corner(2.9, bends)
    found = tips(points_of(path, ARCS), 2.9)
    far = np.hypot(*found.T).max()
    assert HALF * 1.2 < far < 60.0
    assert not np.array_equal(points_of(path, ARCS), points_of(path, MITER_CLIP))


@pytest.mark.parametrize("limit", [1.2, 2.0, 3.0])
def test_the_limit_is_a_length_along_an_arc(limit):
    """Two arms that mirror each other have a straight arc: the clip is at the limit times half the width."""
    path, _ = corner(2.4, (-0.05, -0.05))
    bisector = turned(1.0, 0.0, 1.2 - np.pi / 2)
    assert (points_of(path, ARCS, limit) @ bisector).max() == pytest.approx(min(limit * HALF, 1e9), abs=1e-3)
