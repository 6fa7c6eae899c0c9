"""Lengths of paths, and dashes of strokes, against closed formulas and fine polygons."""

import numpy as np
import pytest

from vexture.bezier.arc_length import path_length
from vexture.bezier.convert import ellipse_cubics, line_cubics
from vexture.bezier.joins import BUTT, ROUND_CAP, ROUND_JOIN, SQUARE
from vexture.bezier.stroke import stroke_path

CIRCLE = ellipse_cubics((0.0, 0.0), (10.0, 10.0), 1e-9)
ROUND = 20.0 * np.pi
"""Length of the circle."""


def lines(*points):
    points = np.array(points, np.float64)
    return line_cubics(points[:-1], points[1:])


def dashes_of(cubics, pattern, offset=0.0, closed=False, cap=BUTT, width=1.0):
    style = np.array([width, cap, ROUND_JOIN, 4.0, 1e-4, offset])
    dashes = np.array(pattern, np.float64)
    contours, counts = stroke_path(cubics, np.array([len(cubics)]), np.array([closed]), style, dashes)
    return np.split(contours, np.cumsum(counts)[:-1]) if len(counts) else []


def spans(contours):
    """Where dashes begin and end in x."""
    return sorted((float(contour[..., 0].min()), float(contour[..., 0].max())) for contour in contours)


def angles(contours):
    """Where dashes of the circle begin and end, as lengths along it."""
    found = []
    for contour in contours:
        x, y = contour[:, 0].T
        middle = np.arctan2(y.mean(), x.mean())
        turn = (np.arctan2(y, x) - middle + np.pi) % (2 * np.pi) - np.pi
        found.append((10 * (middle + turn.min()) % ROUND, 10 * (middle + turn.max()) % ROUND))
    return sorted(found)


def check_pairs(found, expected, accuracy):
    assert len(found) == len(expected)
    np.testing.assert_allclose(np.reshape(found, (-1, 2)), np.reshape(expected, (-1, 2)), rtol=0, atol=accuracy)


def test_length_of_a_circle():
    assert path_length(CIRCLE) == pytest.approx(ROUND, rel=1e-9)


@pytest.mark.parametrize("near", [0.0, 1e-9, 1e-4])
def test_length_of_a_cusp(near):
    curve = np.array([[(0.0, 0.0), (10.0 + near, 10.0), (0.0, 10.0), (10.0, 0.0)]])
    t = np.linspace(0.0, 1.0, 2_000_001)[:, None]
    s = 1 - t
    p0, p1, p2, p3 = curve[0]
    points = s**3 * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t**3 * p3
    assert path_length(curve) == pytest.approx(np.hypot(*np.diff(points, axis=0).T).sum(), rel=2e-9)


@pytest.mark.parametrize(
    ("pattern", "offset", "expected"),
    [
        ((4, 2), 0, [(0, 4), (6, 10)]),
        ((4, 2), 3, [(0, 1), (3, 7), (9, 10)]),
        ((4, 2), 4, [(2, 6), (8, 10)]),
        ((4, 2), -1, [(1, 5), (7, 10)]),
        ((4, 2), -13, [(1, 5), (7, 10)]),
        ((4, 2), 603, [(0, 1), (3, 7), (9, 10)]),
        ((1, 2, 3, 4), 0, [(0, 1), (3, 6)]),
        ((100, 1), 0, [(0, 10)]),
        ((1, 100), 1, []),
    ],
)
def test_dashes_of_a_line(pattern, offset, expected):
    check_pairs(spans(dashes_of(lines((0, 0), (10, 0)), pattern, offset)), expected, 1e-9)


def test_dashes_go_around_corners():
    (first, second) = sorted(
        dashes_of(lines((0, 0), (6, 0), (6, 6)), (8, 1)), key=lambda contour: contour[..., 1].max()
    )
    assert first[..., 1].max() == pytest.approx(2.0)
    assert second[..., 1].min() == pytest.approx(3.0)


def test_dashes_along_a_circle_have_their_length():
    found = angles(dashes_of(CIRCLE, (5, 3)))
    check_pairs(found, [(8.0 * k, min(8.0 * k + 5.0, ROUND)) for k in range(8)], 2e-4)


def test_a_dash_goes_on_over_the_start_of_a_closed_path():
    found = angles(dashes_of(CIRCLE, (7, 1), closed=True))
    check_pairs(found, [*((8.0 * k, 8.0 * k + 7.0) for k in range(1, 7)), (56.0, 7.0)], 2e-4)
    assert len(dashes_of(CIRCLE, (7, 1), closed=False)) == 8


def test_a_dash_around_a_closed_path_has_no_ends():
    outer, inner = dashes_of(CIRCLE, (70, 3), closed=True)
    for contour in (outer, inner):
        assert np.ptp(np.hypot(*contour[:, 0].T)) < 1e-3


@pytest.mark.parametrize("closed", [False, True])
def test_a_closing_line_is_dashed_too(closed):
    square = lines((0, 0), (10, 0), (10, 10), (0, 10))
    assert len(dashes_of(square, (1, 4), closed=closed)) == (8 if closed else 6)


@pytest.mark.parametrize("cap", [ROUND_CAP, SQUARE])
def test_dashes_of_no_length_are_dots_along_the_path(cap):
    dots = dashes_of(lines((0, 0), (30, 40)), (0, 10), cap=cap, width=2.0)
    middles = sorted(tuple((contour[:, 0].min(axis=0) + contour[:, 0].max(axis=0)) / 2) for contour in dots)
    check_pairs(middles, [(6.0 * k, 8.0 * k) for k in range(5)], 1e-3)
    along = dots[0][:, 0] @ [0.6, 0.8]
    if cap == SQUARE:
        assert along.max() - along.min() == pytest.approx(2.0)
    assert dashes_of(lines((0, 0), (30, 40)), (0, 10), cap=BUTT, width=2.0) == []


def test_a_point_has_a_dot_where_the_pattern_begins_with_a_dash():
    point = lines((5, 5), (5, 5))
    assert len(dashes_of(point, (2, 1), cap=ROUND_CAP)) == 1
    assert dashes_of(point, (2, 1), offset=2.5, cap=ROUND_CAP) == []
