"""Round things within their tolerance, lines and quadratics exactly."""

from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from vexture.bezier.convert import arc_cubics, conic_cubics, ellipse_cubics, line_cubics, straight, turn_steps

T = np.linspace(0, 1, 33)[:, None]


def points_on(cubics: np.ndarray) -> np.ndarray:
    s = 1 - T
    p0, p1, p2, p3 = np.moveaxis(cubics[:, None], 2, 0)
    return (s**3 * p0 + 3 * s * s * T * p1 + 3 * s * T * T * p2 + T**3 * p3).reshape(-1, 2)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4, 1e-6])
@pytest.mark.parametrize("radius", [0.01, 1.0, 40.0])
def test_circles_are_within_tolerance_and_not_finer_than_needed(radius: float, tolerance: float) -> None:
    circle = ellipse_cubics((3.0, -2.0), (radius, radius), tolerance)
    error = np.abs(np.hypot(*(points_on(circle) - (3, -2)).T) - radius).max()
    assert error <= tolerance * 1.001
    assert len(circle) == 4 or error > tolerance / 2**6  # a circle has a multiple of four cubics
    assert (circle[:, 3] == np.roll(circle[:, 0], -1, axis=0)).all()


def test_an_ellipse_ends_exactly_where_it_turns() -> None:
    ends = ellipse_cubics((0.5, 0.25), (0.5, 0.25), 1e-3)[:, 0]
    for extremum in ([1, 0.25], [0.5, 0.5], [0, 0.25], [0.5, 0]):
        assert extremum in ends.tolist()


@settings(max_examples=300, deadline=None)
@given(
    end=st.tuples(st.floats(-3, 3), st.floats(-3, 3)),
    radii=st.tuples(st.floats(0.1, 5), st.floats(0.1, 5)),
    rotation=st.floats(-400, 400),
    large=st.booleans(),
    sweep=st.booleans(),
)
def test_arcs_lie_on_one_ellipse(
    end: tuple[float, float], radii: tuple[float, float], rotation: float, large: bool, sweep: bool
) -> None:
    """The points, drawn back to where the ellipse is a circle, keep one distance from one centre."""
    steps = arc_cubics((1.0, 2.0), radii, rotation, large, sweep, end, 1e-6)
    if np.hypot(end[0] - 1, end[1] - 2) < 1e-3:
        return
    ends = np.array([(1.0, 2.0), *(step[4:] for step in steps)])
    assert ends[-1].tolist() == list(end)
    cubics = np.concatenate([ends[:-1, None], np.array(steps).reshape(-1, 3, 2)], axis=1)
    turn = np.radians(rotation)
    back = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]]) / np.array(radii)[:, None]
    flat = points_on(cubics) @ back.T
    # circle through the points by least squares: x^2 + y^2 = 2 c.x + k
    solution = np.linalg.lstsq(np.column_stack([2 * flat, np.ones(len(flat))]), (flat**2).sum(axis=1), rcond=None)[0]
    distance = np.hypot(*(flat - solution[:2]).T)
    radius = distance.mean()
    assert np.ptp(distance) < 1e-4 * max(radius, 1)
    assert radius > 1 - 1e-4
    direction = flat - solution[:2]
    angles = np.unwrap(np.arctan2(direction[:, 1], direction[:, 0]))
    assert (angles[-1] > angles[0]) == sweep
    if radius < 1.001 and not np.isclose(abs(angles[-1] - angles[0]), np.pi, atol=0.1):
        assert (abs(angles[-1] - angles[0]) > np.pi) == large


@pytest.mark.parametrize("gap", [1e-3, 1e-9, 1e-18])
@pytest.mark.parametrize("sweep", [False, True])
def test_an_arc_that_nearly_closes_is_a_circle(gap: float, sweep: bool) -> None:
    """The usual way to write a circle as a path; rounding must not lose it."""
    steps = np.array(arc_cubics((0.0, 0.0), (1.0, 1.0), 0.0, True, sweep, (0.0, gap), 1e-3))
    assert np.ptp(steps[:, 4:], axis=0).max() == pytest.approx(2.0, abs=1e-2)


@pytest.mark.parametrize("radii", [(1e-300, 1.0), (1e100, 1e-100), (1e100, 1e100), (0.0, 5.0), (1e-9, 1e9)])
@pytest.mark.parametrize("large", [False, True])
def test_hostile_radii_cost_little(radii: tuple[float, float], large: bool) -> None:
    assert len(arc_cubics((0, 0), radii, 30, large, True, (1, 1), 1e-9)) <= 5000


@pytest.mark.parametrize("degrees", [1e-3, 20.0, 90.0, 170.0])
def test_conics_are_circular_arcs(degrees: float) -> None:
    half = np.radians(degrees) / 2
    p0, p2 = np.exp(-1j * half), np.exp(1j * half)
    found = np.array([p0, *conic_cubics(p0, 1 / np.cos(half), p2, np.cos(half), 1e-6)])
    cubics = np.stack([found[:-1:3], found[1::3], found[2::3], found[3::3]], axis=1)
    points = points_on(np.stack([cubics.real, cubics.imag], axis=-1))
    assert np.abs(np.hypot(*points.T) - 1).max() < 1e-6
    assert cubics[-1, 3] == p2


def test_straight_knows_lines_from_curves() -> None:
    lines = line_cubics(np.array([[0.1, 0.7], [5.0, 5.0]]), np.array([[0.3, -9.0], [5.0, 5.0]]))
    bent = lines.copy()
    bent[:, 1] += 1e-9
    assert straight(lines).all()
    assert not straight(bent).any()


def test_a_line_as_a_cubic_is_divided_in_three() -> None:
    line = line_cubics(np.array([0.0, 0.0]), np.array([3.0, 6.0]))
    np.testing.assert_allclose(line[1:3], [(1.0, 2.0), (2.0, 4.0)])


def test_a_finer_tolerance_takes_more_cubics() -> None:
    assert turn_steps(2 * pi, 1.0, 1e-3) == 4
    assert turn_steps(2 * pi, 0.5, 1e-5) == 7


def test_a_quarter_of_a_circle_is_one_cubic() -> None:
    step = arc_cubics((1, 0), (1, 1), 0, False, True, (0, 1), 1e-3)[0]
    assert step == pytest.approx((1.0, 0.5523, 0.5523, 1.0, 0.0, 1.0), abs=5e-5)
    assert step[4:] == (0, 1)


def test_an_ellipse_turns_where_its_cubics_end() -> None:
    np.testing.assert_allclose(ellipse_cubics((0, 0), (1, 2), 1e-2)[1, 0], (0.0, 2.0))


def test_a_quarter_of_a_circle_as_a_conic_is_one_cubic() -> None:
    points = conic_cubics(1, 1 + 1j, 1j, 0.5**0.5, 1e-3)
    assert list(points) == pytest.approx([1 + 0.5523j, 0.5523 + 1j, 1j], abs=5e-5)
