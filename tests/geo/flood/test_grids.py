"""Grids over the frame of a flood: distances to the shore."""

import numpy as np
import pytest

from vexture_geo.flood.grids import shore_distance


def test_distance_to_the_shore_is_exact():
    wet = np.random.default_rng(2).random((13, 17)) < 0.3
    found = shore_distance(wet, (2.0, 3.0))
    rows, columns = np.mgrid[:13, :17]
    for row, column in np.ndindex(13, 17):
        other = wet != wet[row, column]
        apart = np.hypot(3.0 * (rows[other] - row), 2.0 * (columns[other] - column)).min()
        assert abs(found[row, column]) == pytest.approx(apart)
        assert (found[row, column] < 0.0) == wet[row, column]
