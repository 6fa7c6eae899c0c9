"""Cells whose pieces touch only at their ends: what lies beside each."""

import numpy as np
import pytest

from vexture.base.layout import LATTICE
from vexture.tree.separate import CellPieces, all_separate, clean_pieces


def line(x0: float, y0: float, x3: float, y3: float) -> np.ndarray:
    return np.linspace((x0, y0), (x3, y3), 4)


@pytest.mark.parametrize(
    ("a", "b", "separate"),
    [
        (line(0, 0, 99, 99), line(0, 99, 99, 0), False),
        (line(0, 0, 99, 99), line(99, 99, 180, 30), True),
        (line(0, 0, 100, 100), line(50, 50, 90, 10), False),
        (line(0, 0, 99, 99), line(9, 0, 99, 90), True),
        (line(0, 0, 99, 99), line(0, 0, 99, 99), False),
        (line(0, 50, 99, 50), line(9, 50, 60, 50), True),
    ],
)
def test_pieces_may_share_ends_and_nothing_else(a: np.ndarray, b: np.ndarray, separate: bool) -> None:
    for first, second in ((a, b), (b, a), (a[::-1], b)):
        assert all_separate(np.stack([first, second])) == separate


def cleaned(curves: list[np.ndarray], owner: list[int], corner: list[int], rules: list[int]) -> np.ndarray:
    n, paths = len(curves), len(corner)
    cell = CellPieces(
        np.stack(curves),
        np.array(owner),
        np.ones(n, np.int64),
        np.array(corner),
        np.array(rules),
        np.zeros(paths, np.int64),
    )
    out = np.zeros((n, 4, 2))
    return out[: clean_pieces(cell, out)]


def test_a_piece_has_the_filled_side_on_its_left() -> None:
    up = line(100, 0, 100, LATTICE)
    for corner, ends in ((0, (LATTICE, 0)), (1, (0, LATTICE))):  # filled on the right; on the left
        (kept,) = cleaned([up], [0], [corner], [0])
        assert tuple(kept[[0, 3], 1]) == ends


def test_a_piece_with_one_filling_on_both_sides_is_dropped() -> None:
    up = line(100, 0, 100, LATTICE)
    assert len(cleaned([up], [0], [0, 1], [0, 0])) == 0, "another path covers the cell"
    assert len(cleaned([up], [0], [2], [0])) == 0, "windings 2 and 1, both inside"
    assert len(cleaned([up], [0], [2], [1])) == 1, "of these, only 1 is odd"
