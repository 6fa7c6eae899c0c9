"""Clipping keeps every winding number inside the box."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from vexture.bezier.bounds import bounds
from vexture.bezier.clip import clip_contour
from vexture.bezier.convert import ellipse_cubics, line_cubics
from vexture.drawing.drawing import Drawing

LOW, HIGH = (0.0, 0.25), (1.0, 0.75)
STEPS = 400


def polyline(contour: np.ndarray) -> np.ndarray:
    """Many points along a contour."""
    t = np.linspace(0, 1, STEPS, endpoint=False)[:, None]
    s = 1 - t
    p0, p1, p2, p3 = np.moveaxis(contour[:, None], 2, 0)
    return (s**3 * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t**3 * p3).reshape(-1, 2)


def winding(contour: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Winding numbers from the angles under which the points see the contour; far from it."""
    if not len(contour):
        return np.zeros(len(points), int)
    seen = polyline(contour)[None] - points[:, None]
    direction = seen[..., 0] + 1j * seen[..., 1]
    turns = np.angle(np.roll(direction, -1, axis=1) / direction).sum(axis=1) / (2 * np.pi)
    return np.rint(turns).astype(int)


def far_from(contour: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Points that are not so near to a contour that `winding` would be unsure."""
    return points[np.abs(polyline(contour)[None] - points[:, None]).max(axis=2).min(axis=1) > 0.02]


def closed(points: np.ndarray) -> np.ndarray:
    """Contour of random cubics, (n, 3, 2) -> (n, 4, 2)."""
    return np.concatenate([points[:, :1], points[:, 1:], np.roll(points[:, :1], -1, axis=0)], axis=1)


def assert_clipped(contour: np.ndarray, clipped: np.ndarray) -> None:
    assert (clipped[:, 3] == np.roll(clipped[:, 0], -1, axis=0)).all()
    assert ((clipped[:, ::3] >= LOW) & (clipped[:, ::3] <= HIGH)).all()
    if len(clipped):
        left, low, right, high = bounds(clipped)
        assert min(left - LOW[0], low - LOW[1], HIGH[0] - right, HIGH[1] - high) > -1e-12
    inside = np.random.default_rng(3).uniform(LOW, HIGH, (60, 2))
    inside = far_from(contour, inside)
    margin = np.minimum(inside - LOW, np.array(HIGH) - inside).min(axis=1)
    inside = inside[margin > 0.02]
    np.testing.assert_array_equal(winding(clipped, inside), winding(contour, inside))


@settings(max_examples=150, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), cubics=st.integers(1, 5), on_grid=st.booleans())
def test_windings_inside_stay(seed: int, cubics: int, on_grid: bool) -> None:
    points = np.random.default_rng(seed).uniform(-1, 2, (cubics, 3, 2))
    if on_grid:  # ends and control points exactly on the sides and corners of the box
        points = np.round(points * 4) / 4
    contour = closed(points)
    assert_clipped(contour, clip_contour(contour, LOW, HIGH))


def test_a_touch_is_no_crossing() -> None:
    """At its middle the cubic touches the side from outside, exactly."""
    points = np.array([[[0.2, 1.75], [0.3, 0.25], [0.6, 0.75]], [[0.9, 1.25], [0.9, 1.5], [0.2, 1.5]]])
    assert len(clip_contour(closed(points), LOW, HIGH)) == 0


def test_a_contour_inside_is_not_touched() -> None:
    circle = ellipse_cubics((0.5, 0.5), (0.25, 0.25), 1e-3)
    assert clip_contour(circle, LOW, HIGH) is circle


@pytest.mark.parametrize("center", [(-1.0, 0.5), (2.0, 0.5), (0.5, -1.0), (0.5, 2.0), (-1.0, -1.0)])
def test_a_contour_outside_vanishes(center: tuple[float, float]) -> None:
    assert len(clip_contour(ellipse_cubics(center, (0.4, 0.4), 1e-3), LOW, HIGH)) == 0


def test_a_contour_around_becomes_the_box() -> None:
    clipped = clip_contour(ellipse_cubics((0.5, 0.5), (9.0, 9.0), 1e-3), LOW, HIGH)
    corners = {tuple(point) for point in clipped[:, 0].tolist()}
    assert {(0.0, 0.25), (1.0, 0.25), (1.0, 0.75), (0.0, 0.75)} <= corners
    assert len(clipped) <= 8
    assert winding(clipped, np.array([[0.5, 0.5]])).tolist() == [1]


def test_shadows_that_follow_one_another_become_one() -> None:
    """A thousand cubics beyond a side leave one line on it."""
    x = np.linspace(-1, 0.5, 1000)
    beyond = np.stack([x, 2 + np.sin(x * 50)], axis=1)
    corners = np.concatenate([[[-1, 0.5]], beyond, [[0.5, 0.5]]])
    contour = line_cubics(corners, np.roll(corners, -1, axis=0))
    assert len(clip_contour(contour, LOW, HIGH)) <= 6


def test_cut_points_lie_exactly_on_the_box() -> None:
    clipped = clip_contour(ellipse_cubics((1.0, 0.6), (0.3, 0.3), 1e-3), LOW, HIGH)
    on_side = (clipped[:, 0, 0] == 1.0) | (clipped[:, 0, 1] == 0.75)
    assert on_side.sum() >= 3
    assert not ((np.abs(clipped[:, 0, 0] - 1.0) < 1e-9) & (clipped[:, 0, 0] != 1.0)).any()


def test_a_square_is_clipped() -> None:
    square = Drawing.polygon([(0.5, 0.5), (1, 0.5), (1, 1), (0.5, 1)]).paths[0].contours[0]
    clipped = clip_contour(square, (0, 0), (0.75, 1))
    np.testing.assert_allclose(clipped[:, 0], [(0.5, 0.5), (0.75, 0.5), (0.75, 1.0), (0.5, 1.0)])
