import numpy as np
import pytest
from hypothesis import given, settings
from numpy.typing import NDArray

from strategies import edge_corners, edge_cubics, on_cubic
from vexture.bezier.area import edge_index, integral_x_dy, leaf_area, loop_area
from vexture.thesis.decode import edge_point

CORNERS = np.array([[1.0, 1.0], [1.0, 0.0], [0.0, 0.0], [0.0, 1.0]])  # clockwise, at edge indices 1/4, 1/2, 3/4, 1
T = np.linspace(0.0, 1.0, 600)[:, None]


def closed_clockwise(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """The polyline and the square's corners that the walk from its end clockwise to its start passes."""
    start, end = edge_index(*points[0]), edge_index(*points[-1])
    far = start if start > end else start + 1.0
    passed = [CORNERS[k % 4] for k in range(8) if end < (k + 1) / 4 < far]
    return np.array([*points, *passed, points[0]])


def even_odd_area(polygon: NDArray[np.float64], lines: int = 1000) -> float:
    """Area by horizontal scan lines: nothing in common with integrals along the curve."""
    (x0, y0), (x1, y1) = polygon[:-1].T, polygon[1:].T
    area = 0.0
    for y in (np.arange(lines) + 0.5) / lines:
        hit = (y0 <= y) != (y1 <= y)
        x = np.sort(x0[hit] + (y - y0[hit]) * (x1[hit] - x0[hit]) / (y1[hit] - y0[hit]))
        area += float((x[1::2] - x[::2]).sum()) / lines
    return area


@given(edge_cubics())
def test_integral_is_that_of_quadrature(curve: NDArray[np.float64]) -> None:
    nodes, weights = np.polynomial.legendre.leggauss(3)  # exact up to degree 5
    t = 0.5 * (nodes + 1.0)[:, None]
    derivative = 3.0 * (
        (1 - t) ** 2 * (curve[1] - curve[0]) + 2 * t * (1 - t) * (curve[2] - curve[1]) + t * t * (curve[3] - curve[2])
    )
    expected = 0.5 * weights @ (on_cubic(curve, t)[:, 0] * derivative[:, 1])
    assert integral_x_dy(curve) == pytest.approx(expected, abs=1e-12)


@settings(max_examples=60)
@given(edge_cubics())
def test_area_of_a_curve_is_what_scan_lines_count(curve: NDArray[np.float64]) -> None:
    assert leaf_area(curve, False) == pytest.approx(even_odd_area(closed_clockwise(on_cubic(curve, T))), abs=4e-3)


@settings(max_examples=40)
@given(edge_corners())
def test_area_of_a_corner_is_what_scan_lines_count(curve: NDArray[np.float64]) -> None:
    assert leaf_area(curve, True) == pytest.approx(even_odd_area(closed_clockwise(curve[[0, 1, 3]])), abs=4e-3)


@given(edge_cubics())
def test_the_reversed_curve_fills_the_rest(curve: NDArray[np.float64]) -> None:
    assert leaf_area(curve, False) + leaf_area(curve[::-1].copy(), False) == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("turned", [False, True])
def test_a_loop_changes_sides(turned: bool) -> None:
    """A large loop, both ways round: the even-odd rule fills it where its surroundings are empty, and the reverse."""
    curve = np.array([[0.3, 0.0], [1.7, 1.2], [-0.7, 1.2], [0.7, 0.0]])
    curve = curve[::-1].copy() if turned else curve
    assert abs(loop_area(curve)) > 0.1
    expected = even_odd_area(closed_clockwise(on_cubic(curve, T)))
    assert leaf_area(curve, False) == pytest.approx(expected, abs=2e-3)


@pytest.mark.parametrize("gap", [4e-3, 4e-6, 4e-9])
def test_ends_that_all_but_meet(gap: float) -> None:
    """The drop closes before its ends cross, or after: the bulge is filled, or all but the bulge."""
    drop = np.array([[0.21875, 0.0], [0.0, 1.0], [0.5, 0.0], [0.21875 + gap, 0.0]])
    crossed = np.array([*drop[:3], [0.21875 - gap, 0.0]])
    assert leaf_area(drop, False) == pytest.approx(0.0421875, abs=gap)
    assert leaf_area(crossed, False) == pytest.approx(1.0 - 0.0421875, abs=gap)


@pytest.mark.parametrize("start", [0.1, 0.4, 0.6, 0.9])
@pytest.mark.parametrize("step", [0.05, -0.05])
def test_both_ends_on_one_side(start: float, step: float) -> None:
    ends = edge_point(np.array([start, start + step]))
    inward = (0.5 - ends) * 0.8
    curve = np.stack([ends[0], ends[0] + inward[0], ends[1] + inward[1], ends[1]])
    area = leaf_area(curve, False)
    assert area == pytest.approx(even_odd_area(closed_clockwise(on_cubic(curve, T))), abs=3e-3)
    assert (area < 0.5) == (step < 0.0)  # P3 first, then P0, clockwise: the bulge itself is filled


def test_integral_of_an_upright_line() -> None:
    upright = np.array([[1.0, 0.0], [1.0, 1.0], [1.0, 2.0], [1.0, 3.0]])
    assert integral_x_dy(upright) == pytest.approx(3.0, abs=1e-12)


def test_edge_indices_of_the_middles_of_the_sides() -> None:
    middles = [edge_index(*point) for point in ((0.5, 1.0), (1.0, 0.5), (0.5, 0.0), (0.0, 0.5))]
    assert middles == pytest.approx([0.125, 0.375, 0.625, 0.875], abs=1e-12)


def test_area_beside_a_bend_and_a_corner() -> None:
    bend = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    assert leaf_area(bend, False) == pytest.approx(0.05, abs=1e-12)
    assert leaf_area(bend, True) == pytest.approx(0.0, abs=1e-12)
