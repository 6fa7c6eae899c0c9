"""Contours in the unit square: clipped, tidied, and refused where they are too far away."""

import numpy as np
import pytest
import shapely

from vexture.base.errors import SourceError
from vexture.bezier.convert import line_cubics
from vexture.drawing.unit_square import FARTHEST, clip_contours, tidy_contours

LOW, HIGH = np.array([0.0, 0.25]), np.array([1.0, 0.75])


def ring(*corners: tuple[float, float]) -> np.ndarray:
    points = np.array(corners, dtype=np.float64)
    return line_cubics(points, np.roll(points, -1, axis=0))


def joined(*contours: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return np.concatenate(contours), np.cumsum([len(contour) for contour in contours])


@pytest.mark.parametrize("seed", range(8))
def test_clipped_triangles_have_the_area_of_shapelys(seed: int) -> None:
    corners = np.random.default_rng(seed).uniform(-0.5, 1.5, (2, 3, 2))
    cubics, ends = clip_contours(*joined(*(ring(*triangle) for triangle in corners)), LOW, HIGH)
    for corner, contour in zip(corners, np.split(cubics, ends[:-1]), strict=True):
        expected = shapely.Polygon(corner).intersection(shapely.box(*LOW, *HIGH)).area
        found = shapely.Polygon(contour[:, 0]).area if len(contour) > 2 else 0.0
        assert found == pytest.approx(expected, abs=1e-9)


def test_contours_inside_stay_bit_for_bit_and_keep_their_places() -> None:
    inside, across = ring((0.1, 0.3), (0.2, 0.3), (0.2, 0.4)), ring((0.5, 0.5), (0.6, 0.9), (0.7, 0.5))
    cubics, ends = clip_contours(*joined(inside, across), LOW, HIGH)
    np.testing.assert_array_equal(cubics[: ends[0]], inside)
    assert cubics[ends[0] :, :, 1].max() == HIGH[1]


def test_coordinates_too_far_away_are_refused() -> None:
    with pytest.raises(SourceError, match=r"is 2e\+09 times the size of the drawing away; the limit is 1e\+09;"):
        clip_contours(*joined(ring((0, 0), (2 * FARTHEST, 0), (0, 1))), LOW, HIGH)
    with pytest.raises(SourceError, match="a coordinate is nan"):
        clip_contours(*joined(ring((0, 0), (np.nan, 0), (0, 1))), LOW, HIGH)


def test_what_encloses_nothing_is_dropped_and_the_rest_is_closed() -> None:
    triangle = ring((0.1, 0.3), (0.2, 0.3), (0.2, 0.4))
    triangle[1, 3] += 1e-17
    doubled = ring((0.5, 0.5), (0.9, 0.5))
    point = ring((0.3, 0.3), (0.3, 0.3))
    found = tidy_contours(*joined(point, triangle, doubled))
    assert found.keys() == {1}
    np.testing.assert_array_equal(found[1][:, 0], np.roll(found[1][:, 3], 1, axis=0))
    np.testing.assert_allclose(found[1][:, 0], [(0.1, 0.3), (0.2, 0.3), (0.2, 0.4)])


def test_two_sides_enclose_an_area_if_one_is_bent() -> None:
    bow = ring((0.2, 0.5), (0.8, 0.5))
    bow[0, 1:3, 1] = 0.3
    assert tidy_contours(*joined(bow)).keys() == {0}
