"""Points of many cubics at once."""

import numpy as np

from vexture.bezier.points import points_along

LINE = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]])


def test_points_along_a_line() -> None:
    points = points_along(LINE[None], np.array([0.0, 0.5, 1.0]))
    np.testing.assert_allclose(points[0, :, 0], (0.0, 1.5, 3.0))
