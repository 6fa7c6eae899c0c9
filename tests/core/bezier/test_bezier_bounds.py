"""Bounding boxes of cubics whose extremes are known."""

import numpy as np
import pytest

from vexture.bezier.bounds import bounds


def test_bounds_are_those_of_the_curve_not_of_its_control_points() -> None:
    arch = np.array([[[0.0, 0.0], [0.0, 4.0], [1.0, 4.0], [1.0, 0.0]]])
    assert bounds(arch) == pytest.approx((0.0, 0.0, 1.0, 3.0), abs=1e-12)
