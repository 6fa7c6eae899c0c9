"""Parts of cubics, against points of the whole."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from vexture.bezier.roots import cubic_at
from vexture.bezier.split import split, subcubic

GRID = st.integers(0, 16).map(lambda k: k / 16)
COORDINATE = st.one_of(st.floats(0, 1, width=32), GRID, GRID.map(lambda v: min(v + 1e-9, 1.0)))
CURVE = st.lists(COORDINATE, min_size=8, max_size=8).map(lambda v: np.array(v).reshape(4, 2))


@given(CURVE, st.floats(0, 1))
def test_split_parts_are_the_curve(curve, t):
    left, right = np.empty((4, 2)), np.empty((4, 2))
    split(curve, t, left, right)
    assert (left[3] == right[0]).all()
    whole = np.concatenate([curve, curve])  # de Casteljau of the parts must give points of the whole
    assert np.isfinite(whole).all()
    u = np.linspace(0, 1, 9)
    for part, t0, t1 in ((left, 0.0, t), (right, t, 1.0)):
        for axis in range(2):
            expected = [cubic_at(*curve[:, axis], t0 + (t1 - t0) * v) for v in u]
            assert np.allclose([cubic_at(*part[:, axis], v) for v in u], expected, atol=1e-13)


@given(CURVE, st.floats(0, 1), st.floats(0, 1))
def test_subcubic_is_that_part(curve, t0, t1):
    part = np.empty((4, 2))
    subcubic(curve, t0, t1, part)
    for axis in range(2):
        expected = [cubic_at(*curve[:, axis], t0 + (t1 - t0) * v) for v in np.linspace(0, 1, 9)]
        assert np.allclose([cubic_at(*part[:, axis], v) for v in np.linspace(0, 1, 9)], expected, atol=1e-13)


LINE = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]])


def test_both_parts_have_the_point_of_the_split() -> None:
    left, right = np.empty((4, 2)), np.empty((4, 2))
    split(LINE, 0.5, left, right)
    np.testing.assert_allclose(left[3], (1.5, 0.0))
    np.testing.assert_allclose(right[0], (1.5, 0.0))


def test_a_part_from_the_end_to_the_start_is_reversed() -> None:
    out = np.empty((4, 2))
    subcubic(LINE, 1.0, 0.0, out)
    np.testing.assert_allclose(out[:, 0], (3.0, 2.0, 1.0, 0.0))
