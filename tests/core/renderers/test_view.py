import numpy as np
import pytest

from vexture.base.errors import ParameterError
from vexture.renderers.view import CONDITION_LIMIT, SIZE_LIMIT, fit, size_of, view_base, view_matrix, window


def unit(view, x, y):
    u, v, w = view @ (x, y, 1.0)
    return np.array([u / w, v / w])


@pytest.mark.parametrize("size", [(1, 1), (61, 61), (1000, 250), (250, 1000)])
def test_the_square_fits_centred(size):
    width, height = size
    view, side = fit(size), min(size)
    left, top = (width - side) / 2, (height - side) / 2
    np.testing.assert_allclose(unit(view, left, top), (0, 1), atol=1e-14)
    np.testing.assert_allclose(unit(view, left + side, top + side), (1, 0), atol=1e-14)
    np.testing.assert_allclose(view_matrix(None, size), view)


def test_a_window_is_shown_whole_and_upright():
    view = window(0.2, 0.3, 0.4, 0.1).matrix((200, 100))
    np.testing.assert_allclose(unit(view, 100, 50), (0.4, 0.35), atol=1e-15)
    np.testing.assert_allclose(unit(view, 0, 50), (0.2, 0.35), atol=1e-15)
    np.testing.assert_allclose(unit(view, 100, 50 - 25), (0.4, 0.4), atol=1e-15)


def test_rotating_turns_the_picture_counter_clockwise_about_the_centre():
    straight, turned = (
        window(0.1, 0.2, 0.4, 0.3).matrix((80, 60)),
        window(0.1, 0.2, 0.4, 0.3, rotate=90).matrix((80, 60)),
    )
    np.testing.assert_allclose(unit(turned, 40, 30), unit(straight, 40, 30), atol=1e-15)
    # what was 10 pixels to the right of the centre is now 10 pixels above it
    np.testing.assert_allclose(unit(turned, 40, 20), unit(straight, 50, 30), atol=1e-15)


def test_affine_and_projective_matrices_are_kept():
    affine = np.array([[0.1, 0.02, 0.0], [0.03, -0.1, 1.0]])
    np.testing.assert_array_equal(view_matrix(affine, (9, 9)), [*affine, (0, 0, 1)])
    projective = np.array([[0.1, 0.0, 0.0], [0.0, -0.1, 1.0], [0.0, 0.05, 1.0]])
    np.testing.assert_array_equal(view_matrix(projective.tolist(), (9, 9)), projective)


@pytest.mark.parametrize(
    "size",
    [
        (0, 5),
        (5, 0),
        (-3, 4),
        (SIZE_LIMIT + 1, 1),
        (2.5, 3),
        (float("nan"), 3),
        (float("inf"), 1),
        (3,),
        0,
        2.5,
        None,
        ("a", "b"),
        True,
        (4, True),
    ],
)
def test_bad_sizes_are_one_line(size):
    with pytest.raises(ParameterError, match=str(SIZE_LIMIT)) as caught:
        size_of(size)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("size", [(1, 1), (SIZE_LIMIT, SIZE_LIMIT), (np.int64(3), 4.0)])
def test_good_sizes(size):
    assert size_of(size) == tuple(int(side) for side in size)


@pytest.mark.parametrize("side", [1, 7, np.int64(SIZE_LIMIT)])
def test_one_number_is_a_square(side):
    assert size_of(side) == (side, side)


@pytest.mark.parametrize(("matrix", "word"), [
    (np.eye(2), "shape"),
    (np.zeros((2, 2, 3)), "shape"),
    ([[1, 2], [3]], "matrix"),
    ("north", "matrix"),
    ([[np.nan, 0, 0], [0, 1, 0]], "finite"),
    ([[1, 0, np.inf], [0, 1, 0]], "finite"),
    (np.zeros((2, 3)), "singular"),
    ([[1, 2, 0], [2, 4, 0]], "singular"),
    ([[1, 0, 0], [0, 1, 0], [0, 0, 0]], "singular"),
    ([[1e-12, 0, 0.5], [0, 1e-12, 0.5]], "singular"),
    ([[1e300, 0, 0.5], [0, 1e300, 0.5]], "singular"),
    (-np.eye(3), "sign"),
])  # fmt: skip
def test_bad_matrices_are_one_line(matrix, word):
    with pytest.raises(ParameterError, match=word) as caught:
        view_matrix(matrix, (16, 16))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "numbers",
    [
        (0, 0, 0, 1),
        (0, 0, 1, -1),
        (np.nan, 0, 1, 1),
        (0, np.inf, 1, 1),
        (0, 0, 1e-12, 1e-12),
        (0, 0, 1, 1, np.inf),
        (0, 0, 1e300, 1),
        (0, 0, 1e308, 1e308),
        (1e308, 0, 1.7e308, 1),
    ],
)
def test_bad_windows_are_refused_when_they_are_made_in_one_line(numbers):
    with pytest.raises(ParameterError) as caught:
        window(*numbers)
    assert "\n" not in str(caught.value)
    assert "not a matrix" not in str(caught.value)


def test_the_magnification_limit_leaves_room():
    matrix = window(0.5, 0.5, 10 / CONDITION_LIMIT, 10 / CONDITION_LIMIT).matrix((1000, 1000))
    assert matrix[0, 0] == -matrix[1, 1] == pytest.approx(0.01 / CONDITION_LIMIT)


def test_a_size_is_two_numbers_or_one() -> None:
    assert size_of((640, 480)) == (640, 480)
    assert size_of(64) == (64, 64)


def test_the_unit_square_in_a_square_image() -> None:
    view = fit((4, 4))
    np.testing.assert_allclose(view, [(0.25, 0.0, 0.0), (0.0, -0.25, 1.0), (0.0, 0.0, 1.0)])
    assert not np.signbit(view[view == 0.0]).any()


def test_an_affine_view_gets_a_third_row() -> None:
    np.testing.assert_allclose(view_matrix([[0.5, 0, 0], [0, -0.5, 1]], (2, 2))[2], (0.0, 0.0, 1.0))


def test_base_of_a_view_is_at_the_centre() -> None:
    assert view_base(np.diag([0.125, 0.125, 1.0]), (4, 4)) == (1 << 30, 1 << 30)
