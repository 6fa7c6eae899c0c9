"""The sweep of the exact renderer: slabs of chords in one order, and areas beside edges."""

import numpy as np
import pytest

from vexture.renderers.exact import Sweep, add_edge, cross, next_slab
from vexture.renderers.flatten import Chords


def test_a_slab_ends_where_chords_cross() -> None:
    lines = np.array([[0.0, 2.0, 0.0, 1.0], [0.0, 2.0, 2.0, -1.0], [3.0, 4.0, 0.5, 0.0]])
    sweep = Sweep.over(Chords(lines, np.ones(3, np.int32), np.array([3])))
    found = []
    high = 0.0
    while high < 5.0:
        low = next_slab(sweep, high, 5.0)
        found.append((low, sweep.active[: sweep.counts[0]].tolist()))
        high = low
    assert [bottom for bottom, _ in found] == pytest.approx([1.0, 2.0, 3.0, 4.0, 5.0])
    assert [order for _, order in found] == [[0, 1], [1, 0], [], [2], []]


@pytest.mark.parametrize(
    ("x0", "x1", "covered"),
    [
        (0.5, 0.5, [0.5, 1.0, 1.0]),
        (0.0, 2.0, [0.25, 0.75, 1.0]),
        (2.0, 0.0, [0.25, 0.75, 1.0]),
        (-1.0, -5.0, [1.0, 1.0, 1.0]),
        (7.0, 9.0, [0.0, 0.0, 0.0]),
    ],
)
def test_area_to_the_right_of_an_edge(x0: float, x1: float, covered: list[float]) -> None:
    change = np.zeros((5, 1))
    add_edge(x0, x1, 1.0, (1.0,), change)
    assert np.cumsum(change[:3, 0]) == pytest.approx(covered)


def test_a_path_begins_and_ends_by_its_rule() -> None:
    winding, evenodd = np.zeros(2, np.int64), np.array([False, True])
    assert [cross(owner, winding, evenodd) for owner in (1, 1, -1, -1)] == [1, 0, 0, -1]
    assert [cross(owner, winding, evenodd) for owner in (2, 2, 2, -2)] == [1, -1, 1, -1]
    assert winding.tolist() == [0, 2]
