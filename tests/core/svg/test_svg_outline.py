"""Outlines of shapes: polygons, and the contours that fill them."""

import numpy as np
import pytest
import shapely

from vexture.bezier.convert import line_cubics
from vexture.svg.outline import ShapeOutline

CORNERS = np.array([(0.0, 0.0), (3.0, 0.0), (3.0, 4.0)])


@pytest.mark.parametrize(("closed", "sides"), [(True, 3), (False, 2)])
def test_a_polygon_runs_through_its_points(closed: bool, sides: int) -> None:
    outline = ShapeOutline.polygon(CORNERS, closed)
    assert len(outline.cubics) == sides
    np.testing.assert_array_equal(outline.cubics[:, 0], CORNERS[:sides])
    np.testing.assert_array_equal(outline.cubics[:, 3], np.roll(CORNERS, -1, axis=0)[:sides])


def test_a_single_point_is_a_cubic_of_no_length() -> None:
    assert ShapeOutline.polygon(CORNERS[1:2], closed=False).cubics.tolist() == [[[3.0, 0.0]] * 4]


def test_the_contour_to_fill_is_closed_by_a_line() -> None:
    loop = ShapeOutline.polygon(CORNERS, closed=False).loop
    np.testing.assert_array_equal(loop[:, 0], np.roll(loop[:, 3], 1, axis=0))
    assert shapely.Polygon(loop[:, 0]).area == pytest.approx(6.0)
    closed = ShapeOutline.rectangle(1.0, 2.0, 3.0, 4.0)
    assert closed.loop is closed.cubics
    assert shapely.Polygon(closed.loop[:, 0]).area == pytest.approx(12.0)


def test_a_gap_of_rounding_is_closed_without_a_line() -> None:
    points = np.array([*CORNERS, (2e-12, 0.0)])
    outline = ShapeOutline(line_cubics(points[:-1], points[1:]), closed=True)
    assert len(outline.loop) == 3
    assert outline.loop[-1, 3].tolist() == [0.0, 0.0]
    assert outline.cubics[-1, 3, 0] > 0.0, "the outline itself is not changed"
    points[-1, 0] = 1e-9
    assert len(ShapeOutline(line_cubics(points[:-1], points[1:]), closed=True).loop) == 4
