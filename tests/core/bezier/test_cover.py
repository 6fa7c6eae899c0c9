"""Convex outlines below others: what is hidden, and what is left of the rest."""

import numpy as np
import pytest

from vexture.bezier.area import integral_x_dy
from vexture.bezier.convert import ellipse_cubics
from vexture.bezier.cover import DIRECTIONS, cover_cells, cut_outlines, find_reach


def reach_of(circles: list[tuple[float, float, float]], side: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Top of each cell, reach of each circle, and which circles hide something."""
    top, given = np.full((side, side), -1, np.int32), np.array(circles)
    reach, hides = np.zeros((len(circles), DIRECTIONS)), np.zeros(len(circles), np.bool_)
    cover_cells(given, top)
    find_reach(given, top, reach, hides)
    return top, reach, hides


def test_a_circle_covers_the_cells_that_lie_wholly_in_it():
    for x, y, radius in ((2.0, 2.0, 1.5), (3.3, 2.9, 2.4), (4.0, 4.0, 0.9), (4.0, 4.0, 0.0)):
        top, _, _ = reach_of([(x, y, radius)], 8)
        row, column = np.mgrid[:8, :8]
        farthest = np.hypot(
            np.maximum(abs(column - x), abs(column + 1 - x)), np.maximum(abs(row - y), abs(row + 1 - y))
        )
        assert ((top == 0) == (farthest <= radius)).all()


def test_what_is_seen_is_never_cut():
    _, reach, hides = reach_of([(4.1, 3.7, 2.5)], 8)
    assert (reach >= 2.5).all()
    assert not hides.any()


def test_what_lies_below_a_later_circle_is_hidden_and_what_lies_above_is_not():
    _, reach, hides = reach_of([(4.0, 4.0, 0.5), (4.0, 4.0, 2.9)], 8)
    assert np.isneginf(reach[0]).all()
    assert hides.tolist() == [False, True]
    _, reach, hides = reach_of([(4.0, 4.0, 2.9), (4.0, 4.0, 0.5)], 8)
    assert (reach[0] >= 2.9).all()
    assert not hides.any()


@pytest.mark.parametrize("direction", range(DIRECTIONS))
def test_half_of_a_disc_is_left_of_it(direction):
    disc, reach = ellipse_cubics((4.0, 4.0), (2.0, 2.0), 1e-6), np.full((2, DIRECTIONS), 9.0)
    reach[0, direction], reach[1] = 0.0, -np.inf
    ends = np.zeros(2, np.int64)
    left = cut_outlines(np.stack([disc, disc]), np.array([[4.0, 4.0, 2.0]] * 2), reach, ends)
    assert ends.tolist() == [len(left), len(left)], "nothing is left of the second"
    np.testing.assert_allclose(left[:, 3], np.roll(left[:, 0], -1, axis=0), atol=1e-12)
    assert abs(sum(integral_x_dy(cubic) for cubic in left)) == pytest.approx(2.0 * np.pi, abs=1e-4)
    turn = direction * np.pi / 4
    assert ((left[:, 0] - 4.0) @ (np.cos(turn), np.sin(turn))).max() < 1e-9
