"""Where a cubic takes a value and where it turns, against sampling and near-degenerate cubics."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vexture.bezier.monotone import monotone_pieces
from vexture.bezier.roots import cubic_at, solve_monotone, turning_points

GRID = st.integers(0, 16).map(lambda k: k / 16)
COORDINATE = st.one_of(st.floats(0, 1, width=32), GRID, GRID.map(lambda v: min(v + 1e-9, 1.0)))
CURVE = st.lists(COORDINATE, min_size=8, max_size=8).map(lambda v: np.array(v).reshape(4, 2))


@given(CURVE, st.floats(0, 1))
def test_solve_monotone_finds_the_value(curve, share):
    for points in monotone_pieces(curve[None], np.zeros(1, np.int64)).points:
        for axis in range(2):
            p = points[:, axis]
            if p[0] == p[3]:
                continue
            value = p[0] + share * (p[3] - p[0])
            t = solve_monotone(*p, value)
            assert 0.0 <= t <= 1.0
            assert abs(cubic_at(*p, t) - value) <= 1e-12
            assert solve_monotone(*p, p[0]) == 0.0
            assert solve_monotone(*p, p[3]) == 1.0


@given(CURVE)
def test_turning_points_are_where_the_sign_of_the_slope_changes(curve):
    out = np.empty(2)
    for axis in range(2):
        p = curve[:, axis]
        count = turning_points(*p, out)
        assert (np.diff(out[:count]) >= 0).all()
        t = np.linspace(0, 1, 400)
        slope = (1 - t) ** 2 * (p[1] - p[0]) + 2 * t * (1 - t) * (p[2] - p[1]) + t * t * (p[3] - p[2])
        clear = np.abs(slope) > 1e-6
        changes = np.count_nonzero(np.diff(np.sign(slope[clear])))
        assert changes <= count


def test_root_of_a_linear_polynomial() -> None:
    assert solve_monotone(0.0, 1 / 3, 2 / 3, 1.0, 0.25) == pytest.approx(0.25, abs=1e-12)


def test_an_arch_turns_once() -> None:
    out = np.empty(2)
    assert turning_points(0.0, 1.0, 1.0, 0.0, out) == 1
    assert out[0] == pytest.approx(0.5, abs=1e-12)
