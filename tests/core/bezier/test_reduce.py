"""A contour of many pieces becomes one of few, which is closed, monotone and near to it."""

import numpy as np
import pytest

from vexture.bezier.convert import ellipse_cubics, line_cubics
from vexture.bezier.reduce import reduce_contour

TOLERANCE = 1e-5
FLAT = 1e-7
"""Distance of the polygons of these tests from their curves."""
T = np.linspace(0.0, 1.0, 200)


def points_of(cubics):
    s = 1.0 - T
    weights = np.stack([s**3, 3 * s * s * T, 3 * s * T * T, T**3], axis=1)
    return (weights @ cubics).reshape(-1, 2)


def farthest(cubics, others):
    """Largest distance of points of some cubics from a polygon through points of others."""
    points, ends = points_of(cubics)[::7], points_of(others)
    starts, sides = ends[:-1], np.diff(ends, axis=0)
    squares = np.maximum((sides * sides).sum(axis=1), 1e-30)
    worst = 0.0
    for point in points:
        t = np.clip(((point - starts) * sides).sum(axis=1) / squares, 0.0, 1.0)
        worst = max(worst, np.hypot(*(starts + t[:, None] * sides - point).T).min())
    return worst


def is_closed(cubics):
    return (cubics[:, 3] == np.roll(cubics[:, 0], -1, axis=0)).all()


def is_monotone(cubics):
    steps = np.diff(points_of(cubics).reshape(len(cubics), -1, 2), axis=1)
    return ((steps >= -1e-12).all(axis=1) | (steps <= 1e-12).all(axis=1)).all()


def circle(accuracy):
    return ellipse_cubics((0.5, 0.5), (0.05, 0.05), accuracy)


@pytest.mark.parametrize("accuracy", [1e-7, 1e-9])
def test_the_parts_of_a_circle_become_quarters(accuracy):
    many = circle(accuracy)
    few = reduce_contour(many, TOLERANCE)
    assert len(few) == 4 < len(many)
    assert is_closed(few)
    assert is_monotone(few)
    assert max(farthest(few, many), farthest(many, few)) < TOLERANCE + FLAT


@pytest.mark.parametrize("tolerance", [1e-4, 1e-5, 1e-6])
def test_an_arc_is_as_near_as_the_tolerance(tolerance):
    many = circle(1e-12)
    few = reduce_contour(many, tolerance)
    assert 4 <= len(few) < len(many) / 2
    assert is_closed(few)
    assert is_monotone(few)
    assert max(farthest(few, many), farthest(many, few)) < tolerance + FLAT


def test_corners_stay():
    corners = np.array([[0.1, 0.1], [0.9, 0.2], [0.7, 0.9], [0.6, 0.5]])
    sides = line_cubics(corners, np.roll(corners, -1, axis=0))
    halves = np.concatenate(
        [
            line_cubics(sides[:, 0], sides[:, 0] / 2 + sides[:, 3] / 2),
            line_cubics(sides[:, 0] / 2 + sides[:, 3] / 2, sides[:, 3]),
        ],
        axis=1,
    ).reshape(-1, 4, 2)
    few = reduce_contour(halves, TOLERANCE)
    assert sorted(map(tuple, few[:, 0])) == sorted(map(tuple, corners))
    assert is_closed(few)


def test_steps_back_that_nobody_sees_end_no_run():
    many = circle(1e-9)
    at = many[5, 0]
    back = at - 0.05 * TOLERANCE
    jogged = np.concatenate([many[:5], line_cubics(at[None], back[None]), line_cubics(back[None], at[None]), many[5:]])
    assert len(reduce_contour(jogged, TOLERANCE)) == 4
