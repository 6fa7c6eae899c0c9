"""Frames: a rectangle of the world in the middle of the unit square."""

import numpy as np
import pytest

from vexture_geo.base.extent import MARGIN, Frame, bounds_of_square

WIDE = Frame((100.0, 200.0, 1100.0, 700.0), "EPSG:28992", (1000.0, 500.0))
TALL = Frame((4.0, 52.0, 5.0, 53.0), "EPSG:4326", (68_000.0, 111_000.0))


@pytest.mark.parametrize("frame", [WIDE, TALL])
def test_the_corners_of_the_box_are_those_of_the_bounds(frame):
    x0, y0, x1, y1 = frame.box
    west, south, east, north = frame.bounds
    np.testing.assert_allclose(frame.to_source @ (x0, y0, 1.0), (west, south))
    np.testing.assert_allclose(frame.to_source @ (x1, y1, 1.0), (east, north))
    assert ((x0 + x1) / 2, (y0 + y1) / 2) == pytest.approx((0.5, 0.5))


@pytest.mark.parametrize("frame", [WIDE, TALL])
def test_a_box_has_the_shape_of_the_ground_and_a_margin_at_its_longer_side(frame):
    x0, y0, x1, y1 = frame.box
    assert (x1 - x0) / (y1 - y0) == pytest.approx(frame.metres[0] / frame.metres[1])
    assert max(x1 - x0, y1 - y0) == pytest.approx(1.0 - 2.0 * MARGIN)


def test_the_square_reaches_beyond_the_frame_on_all_sides():
    side = 1000.0 / (1.0 - 2.0 * MARGIN)
    middle = np.array([600.0, 450.0])
    np.testing.assert_allclose(bounds_of_square(WIDE), [*(middle - side / 2), *(middle + side / 2)])
    np.testing.assert_allclose(bounds_of_square(WIDE, 0.25), [*(middle - 0.75 * side), *(middle + 0.75 * side)])
