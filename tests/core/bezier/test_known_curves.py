"""Curves whose numbers are known."""

from math import pi

import numpy as np
import pytest

from vexture.bezier.area import edge_index, integral_x_dy, leaf_area
from vexture.bezier.bounds import bounds
from vexture.bezier.clip import clip_contour
from vexture.bezier.convert import arc_cubics, conic_cubics, ellipse_cubics, line_cubics, turn_steps
from vexture.bezier.fit import chord_parameters, fit_cubic, project
from vexture.bezier.fit_closed import fit_closed, fit_samples
from vexture.bezier.monotone import monotone_pieces
from vexture.bezier.points import points_along
from vexture.bezier.roots import solve_monotone, turning_points
from vexture.bezier.smooth import smooth_chain
from vexture.bezier.split import split, subcubic
from vexture.drawing.drawing import Drawing

LINE = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]])


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


def test_bounds_are_those_of_the_curve_not_of_its_control_points() -> None:
    arch = np.array([[[0.0, 0.0], [0.0, 4.0], [1.0, 4.0], [1.0, 0.0]]])
    assert bounds(arch) == pytest.approx((0.0, 0.0, 1.0, 3.0), abs=1e-12)


def test_a_square_is_clipped() -> None:
    square = Drawing.polygon([(0.5, 0.5), (1, 0.5), (1, 1), (0.5, 1)]).paths[0].contours[0]
    clipped = clip_contour(square, (0, 0), (0.75, 1))
    np.testing.assert_allclose(clipped[:, 0], [(0.5, 0.5), (0.75, 0.5), (0.75, 1.0), (0.5, 1.0)])


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


def test_samples_of_a_circle_give_four_cubics() -> None:
    angle = np.linspace(0.0, 2.0 * np.pi, 100, endpoint=False)
    circle = np.column_stack((np.cos(angle), np.sin(angle)))
    assert len(fit_samples(circle, np.zeros(100, np.bool_), 1e-3)) == 4


def test_a_disc_of_stairs_becomes_round() -> None:
    angle = np.linspace(0.0, 2.0 * np.pi, 200, endpoint=False)
    disc = np.round(20.0 * np.column_stack((np.cos(angle), np.sin(angle))))
    cubics = fit_closed(disc, 0.5)
    assert len(cubics) < 9
    assert np.abs(np.hypot(*cubics[:, 0].T) - 20.0).max() < 0.4


def test_an_arch_is_split_at_its_top() -> None:
    arch = np.array([[[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]])
    span = monotone_pieces(arch, np.zeros(1, np.int64)).span
    np.testing.assert_allclose(span, [(0.0, 0.5), (0.5, 1.0)])


def test_points_along_a_line() -> None:
    points = points_along(LINE[None], np.array([0.0, 0.5, 1.0]))
    np.testing.assert_allclose(points[0, :, 0], (0.0, 1.5, 3.0))


def test_root_of_a_linear_polynomial() -> None:
    assert solve_monotone(0.0, 1 / 3, 2 / 3, 1.0, 0.25) == pytest.approx(0.25, abs=1e-12)


def test_an_arch_turns_once() -> None:
    out = np.empty(2)
    assert turning_points(0.0, 1.0, 1.0, 0.0, out) == 1
    assert out[0] == pytest.approx(0.5, abs=1e-12)


def test_smoothing_moves_no_sample_farther_than_allowed() -> None:
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    even = smooth_chain(square, np.zeros(4, np.bool_), np.full(4, 10.0), np.full(4, 0.1))
    assert (np.hypot(*(even - square).T) <= 0.1 + 1e-12).all()


def test_both_parts_have_the_point_of_the_split() -> None:
    left, right = np.empty((4, 2)), np.empty((4, 2))
    split(LINE, 0.5, left, right)
    np.testing.assert_allclose(left[3], (1.5, 0.0))
    np.testing.assert_allclose(right[0], (1.5, 0.0))


def test_a_part_from_the_end_to_the_start_is_reversed() -> None:
    out = np.empty((4, 2))
    subcubic(LINE, 1.0, 0.0, out)
    np.testing.assert_allclose(out[:, 0], (3.0, 2.0, 1.0, 0.0))
