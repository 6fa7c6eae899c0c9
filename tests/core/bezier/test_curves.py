"""Roots, splitting, monotone pieces and fits, against sampling and against near-degenerate cubics."""

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st

from degenerate import polyline
from vexture.bezier.fit import fit_cubic
from vexture.bezier.monotone import monotone_pieces
from vexture.bezier.roots import cubic_at, solve_monotone, turning_points
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
