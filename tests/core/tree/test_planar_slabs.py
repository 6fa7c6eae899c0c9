"""Which of two borders lies on the left, and which lie along the side of their cell."""

import numpy as np
import pytest

from vexture.base.layout import LATTICE
from vexture.tree.planar.slabs import along_edge, beside


def line(x0: float, y0: float, x3: float, y3: float) -> np.ndarray:
    return np.linspace((x0, y0), (x3, y3), 4)


BOW = np.array([[0.0, 0.0], [60.0, 0.0], [100.0, 40.0], [100.0, 100.0]])
"""Below the diagonal from the lower left to the upper right."""


@pytest.mark.parametrize(
    ("curve", "other", "side"),
    [
        (line(100, 0, 100, 99), line(50, 0, 50, 99), 1),
        (line(100, 0, 100, 99), line(150, 0, 150, 99), -1),
        (line(0, 0, 100, 100), line(0, 20, 80, 100), 1),
        (line(0, 0, 100, 100), line(20, 0, 100, 80), -1),
        (BOW, line(0, 0, 100, 100), 1),
        (line(0, 0, 100, 100), BOW, -1),
        (BOW, BOW + np.array([0.0, 1.0]), 1),
        (BOW, BOW, 0),
    ],
)
def test_the_other_border_is_on_the_left_on_the_right_or_unclear(
    curve: np.ndarray, other: np.ndarray, side: int
) -> None:
    assert beside(curve, other, 50.0) == side
    assert beside(curve[::-1].copy(), other, 50.0) == side, "whichever way it runs"
    assert beside(curve, other[::-1].copy(), 50.0) == side


def test_a_border_along_the_left_or_right_side_separates_nothing() -> None:
    assert along_edge(line(0, 0, 0, 99))
    assert along_edge(line(LATTICE, 99, LATTICE, 0))
    for inside in (line(1, 0, 1, 99), line(0, 0, 99, 0), line(0, 0, LATTICE, LATTICE)):
        assert not along_edge(inside)
