"""Fits of one cubic, against the points that it was fitted to."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from degenerate import polyline
from vexture.bezier.fit import chord_parameters, fit_cubic, project

GRID = st.integers(0, 16).map(lambda k: k / 16)
COORDINATE = st.one_of(st.floats(0, 1, width=32), GRID, GRID.map(lambda v: min(v + 1e-9, 1.0)))
CURVE = st.lists(COORDINATE, min_size=8, max_size=8).map(lambda v: np.array(v).reshape(4, 2))


@given(CURVE)
def test_fit_recovers_an_arch(curve):
    chord = np.linalg.norm(curve[3] - curve[0])
    assume(chord > 0.1)
    curve[1:3] = curve[0] + (curve[3] - curve[0]) * [[1 / 3], [2 / 3]] + 0.2 * chord * (curve[1:3] - 0.5)
    fitted = np.empty((4, 2))
    distance = fit_cubic(polyline(curve, 24), 1e-6, fitted)
    assert distance < 0.02 * chord
    assert np.allclose(fitted[[0, 3]], curve[[0, 3]], atol=1e-15)


def test_fit_reports_the_true_distance():
    corner = np.concatenate([np.linspace((0, 0), (1, 0), 17), np.linspace((1, 0), (1, 1), 17)[1:]])
    fitted = np.empty((4, 2))
    distance = fit_cubic(corner, 0.02, fitted)
    dense = polyline(fitted, 4000)
    true = max(np.hypot(*(dense - point).T).min() for point in corner)
    assert true <= distance + 1e-3  # the points' parameters need not be the nearest ones
    assert distance < true + 5e-3
    assert 0.01 < true < 0.05  # a cubic rounds a right angle by some per cent of its sides


LINE = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]])


def test_chord_parameters_are_shares_of_the_length() -> None:
    t = np.empty(3)
    length = chord_parameters(np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 3.0]]), t)
    assert length == pytest.approx(4.0, abs=1e-12)
    np.testing.assert_allclose(t, (0.0, 0.25, 1.0))


def test_parameters_move_to_the_nearest_place() -> None:
    t = np.array([0.0, 0.4, 1.0])
    distance = project(np.array([0.0, 1.5, 3.0]), np.array([0.0, 0.5, 0.0]), t, LINE, np.empty(3))
    assert distance == pytest.approx(0.5, abs=1e-12)
    np.testing.assert_allclose(t, (0.0, 0.5, 1.0))


def test_a_parabola_is_fitted() -> None:
    t = np.linspace(0.0, 1.0, 9)
    assert fit_cubic(np.column_stack((t, t * t)), 1e-6, np.empty((4, 2))) < 1e-2
