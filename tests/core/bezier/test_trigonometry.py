"""Functions of angles: those of the C library within a unit in the last place, and the same on every machine."""

import math

import numpy as np
import pytest

from vexture.bezier.convert import turn_steps
from vexture.bezier.trigonometry import angle_of_cosine, count_of_turn, direction_at

QUARTERS = [math.pi / 4 * k for k in range(-8, 9)]


def test_directions_are_cosines_and_sines() -> None:
    for angle in [*QUARTERS, *np.random.default_rng(1).uniform(-2 * math.pi, 2 * math.pi, 500).tolist(), 1e-9, 0.0]:
        assert direction_at(angle) == pytest.approx((math.cos(angle), math.sin(angle)), rel=0.0, abs=2.3e-16)


def test_angles_are_arc_cosines() -> None:
    for cosine in [-1.0, -0.5, 0.0, 0.5, 1.0, 0.5 - 1e-16, *np.random.default_rng(2).uniform(-1, 1, 500).tolist()]:
        assert angle_of_cosine(cosine) == pytest.approx(math.acos(cosine), rel=0.0, abs=4.5e-16)


def test_bits_are_those_of_every_machine() -> None:
    assert direction_at(1.0) == (0.5403023058681398, 0.8414709848078965)
    assert angle_of_cosine(0.3) == 1.2661036727794992
    assert direction_at(0.7853981633974483) == (0.7071067811865476, 0.7071067811865475)


def test_cubics_of_a_turn_are_counted_as_by_powers() -> None:
    rng = np.random.default_rng(3)
    for _ in range(300):
        turn = float(rng.uniform(0.01, 6.3)), float(10 ** rng.uniform(-4, 7)), float(10 ** rng.uniform(-10, -1))
        assert count_of_turn(*turn) == turn_steps(*turn)
    assert count_of_turn(1.0, 0.0, 1e-3) == 1
