"""Lattices of samples: positions and places are inverse; and values that cannot be depths."""

import numpy as np
import pytest

from vexture_geo.depth.series import FARTHEST, Lattice, Reading, plausible

COSINE, SINE = np.cos(0.4), np.sin(0.4)
TURNED = np.array([[COSINE, -SINE, 1000.0], [SINE, COSINE, 2000.0]])


@pytest.mark.parametrize("y", [[0.0, 1.0, 4.0, 5.0], [5.0, 4.0, 1.0, 0.0]], ids=["rising", "falling"])
def test_places_have_the_positions_that_they_come_from(y):
    lattice = Lattice(np.array([0.0, 2.0, 3.0]), np.array(y), TURNED)
    positions = np.random.default_rng(1).uniform(-3.0, 6.0, (200, 2))
    np.testing.assert_allclose(lattice.find(lattice.place(positions)), positions, atol=1e-9)
    np.testing.assert_allclose(lattice.place(np.array([[2.0, 1.0]])), [TURNED[:, :2] @ (3.0, y[1]) + TURNED[:, 2]])
    assert lattice.shape == (4, 3)


def test_samples_stand_for_the_half_steps_around_them():
    lattice = Lattice(np.array([1.0, 3.0, 4.0]), np.array([20.0, 10.0]), np.eye(2, 3))
    assert lattice.box == (0.0, 5.0, 4.5, 25.0)
    assert Lattice(np.array([7.0]), np.array([3.0]), np.eye(2, 3)).box == (6.5, 2.5, 7.5, 3.5)


def test_what_cannot_be_is_unknown_in_all_values_of_a_reading():
    odd = np.array([1.0, FARTHEST, 1.01 * FARTHEST, -999.0, -9999.0, np.inf, np.nan])
    wanted = [1.0, FARTHEST, *[np.nan] * 5]
    np.testing.assert_array_equal(plausible(odd), wanted)
    reading = Reading(odd, bed=-odd).plausible
    np.testing.assert_array_equal(reading.depth, wanted)
    np.testing.assert_array_equal(reading.bed, [-1.0, -FARTHEST, np.nan, 999.0, 9999.0, np.nan, np.nan])
    assert reading.speed is None
    np.testing.assert_array_equal(Reading(odd, speed=2.0 * odd).at(slice(0, 2)).speed, [2.0, 2.0 * FARTHEST])
