"""Monotone pieces of cubics, against sampling."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from degenerate import polyline
from vexture.bezier.monotone import monotone_pieces

GRID = st.integers(0, 16).map(lambda k: k / 16)
COORDINATE = st.one_of(st.floats(0, 1, width=32), GRID, GRID.map(lambda v: min(v + 1e-9, 1.0)))
CURVE = st.lists(COORDINATE, min_size=8, max_size=8).map(lambda v: np.array(v).reshape(4, 2))


@given(CURVE)
def test_pieces_are_monotone_and_complete(curve):
    pieces = monotone_pieces(curve[None], np.zeros(1, np.int64))
    extent = np.ptp(curve, axis=0).max()
    for points in pieces.points:
        steps = np.diff(polyline(points, 64), axis=0)
        for axis in range(2):
            direction = np.sign(points[3, axis] - points[0, axis])
            assert (steps[:, axis] * direction >= -1e-8 * extent).all()
    spans = pieces.span[np.argsort(pieces.span[:, 0])]
    assert (spans[1:, 0] >= spans[:-1, 1] - 1e-12).all()
    if len(spans) and extent > 1e-3:  # what is missing between them is shorter than rounding
        assert spans[0, 0] < 1e-3
        assert spans[-1, 1] > 1 - 1e-3
    for before, after in zip(pieces.points[:-1], pieces.points[1:], strict=True):
        assert np.abs(before[3] - after[0]).max() <= 1e-12


def test_an_arch_is_split_at_its_top() -> None:
    arch = np.array([[[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]])
    span = monotone_pieces(arch, np.zeros(1, np.int64)).span
    np.testing.assert_allclose(span, [(0.0, 0.5), (0.5, 1.0)])
