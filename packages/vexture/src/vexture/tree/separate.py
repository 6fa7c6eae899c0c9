"""Cells whose pieces touch only at their ends: counting windings gives the sides of each piece.

Most cells of most drawings are of this kind. All others are resolved in `boundary.py`.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.tree.crossings import x_at
from vexture.tree.winding import inside

UNSURE = -2
"""Role of a piece whose order among its neighbours is not clear."""


class CellPieces(NamedTuple):
    """Pieces of a cell on its lattice."""

    curves: NDArray[np.float64]  # (n, 4, 2): ends and control points are integers
    owner: NDArray[np.int64]  # (n,): path of each piece, an index into the arrays below
    multiplicity: NDArray[np.int64]  # (n,): copies of each piece; negative if they run in the other direction
    corner: NDArray[np.int64]  # (paths,): corner windings
    rules: NDArray[np.int64]  # (paths,): `FillRule`s
    windings: NDArray[np.int64]  # (paths,): scratch


@kernel(allocates=False)
def _shares(curves: NDArray[np.float64], i: int, end: int, j: int) -> bool:
    """Whether an end of piece i is an end of piece j."""
    x, y = curves[i, end, 0], curves[i, end, 1]
    return (curves[j, 0, 0] == x and curves[j, 0, 1] == y) or (curves[j, 3, 0] == x and curves[j, 3, 1] == y)


@kernel(allocates=False)
def _beside(curves: NDArray[np.float64], line: int, other: int) -> bool:
    """Whether the hulls of two pieces lie on different sides of a line along the first one's chord.

    One end of the other piece may lie on the line, if it is also an end of the first piece.
    """
    x0, y0 = curves[line, 0, 0], curves[line, 0, 1]
    dx, dy = curves[line, 3, 0] - x0, curves[line, 3, 1] - y0
    low, high, other_low, other_high = 0.0, 0.0, np.inf, -np.inf
    for k in range(4):
        across = dx * (curves[line, k, 1] - y0) - dy * (curves[line, k, 0] - x0)
        low, high = min(low, across), max(high, across)
        across = dx * (curves[other, k, 1] - y0) - dy * (curves[other, k, 0] - x0)
        other_low, other_high = min(other_low, across), max(other_high, across)
    if other_low < high and low < other_high:
        return False
    border = high if other_low >= high else low
    touching = 0
    for end in (0, 3):
        if dx * (curves[other, end, 1] - y0) - dy * (curves[other, end, 0] - x0) == border:
            touching += 1
            if not _shares(curves, other, end, line):
                return False
    return touching < 2


@kernel(allocates=False)
def _separate(curves: NDArray[np.float64], i: int, j: int) -> bool:
    """Whether boxes or hulls prove that two monotone pieces have no common point but a common end."""
    for axis in range(2):
        a, b = curves[i, 0, axis], curves[i, 3, axis]
        c, d = curves[j, 0, axis], curves[j, 3, axis]
        i_low, i_high, j_low, j_high = min(a, b), max(a, b), min(c, d), max(c, d)
        if i_high < j_low or j_high < i_low:
            return True
        if (i_high == j_low or j_high == i_low) and i_low < i_high and j_low < j_high:
            return True
    return _beside(curves, i, j) or _beside(curves, j, i)


@kernel(allocates=False)
def all_separate(curves: NDArray[np.float64]) -> bool:
    """Whether no two pieces have a common point but a common end; pairs of horizontal pieces are ignored."""
    for i in range(len(curves)):
        for j in range(i):
            both_level = curves[i, 0, 1] == curves[i, 3, 1] and curves[j, 0, 1] == curves[j, 3, 1]
            if not both_level and not _separate(curves, i, j):
                return False
    return True


@kernel(allocates=False)
def any_inside(windings: NDArray[np.int64], rules: NDArray[np.int64]) -> bool:
    """Whether a point is inside any path."""
    for k in range(len(rules)):
        if inside(windings[k], rules[k]):
            return True
    return False


@kernel(allocates=False)
def left_edge_windings(cell: CellPieces, y: float, below: bool) -> None:
    """Write each path's winding number at the left edge just above height y, or just below it."""
    curves, owner, corner, windings = cell.curves, cell.owner, cell.corner, cell.windings
    for k in range(len(corner)):
        windings[k] = corner[k]
    for i in range(len(curves)):
        for end, event in ((0, 1), (3, -1)):
            if curves[i, end, 0] == 0.0 and (curves[i, end, 1] < y or (curves[i, end, 1] == y and not below)):
                windings[owner[i]] += event * cell.multiplicity[i]


@kernel(allocates=False)
def _role(cell: CellPieces, i: int) -> int:
    """Role of a piece: 1 if only its right side is inside, -1 if only its left side is, else 0; or `UNSURE`."""
    curves, owner, windings, rules = cell.curves, cell.owner, cell.windings, cell.rules
    y = 0.5 * (curves[i, 0, 1] + curves[i, 3, 1])
    left_edge_windings(cell, y, False)
    low, high = min(curves[i, 0, 0], curves[i, 3, 0]), max(curves[i, 0, 0], curves[i, 3, 0])
    for j in range(len(curves)):
        a, d = curves[j, 0, 1], curves[j, 3, 1]
        if j == i or not (min(a, d) <= y < max(a, d)):
            continue
        left = max(curves[j, 0, 0], curves[j, 3, 0]) <= low
        if not left and min(curves[j, 0, 0], curves[j, 3, 0]) < high:
            gap = x_at(curves[i], y) - x_at(curves[j], y)
            if gap == 0.0:
                return UNSURE
            left = gap > 0.0
        if left:
            windings[owner[j]] += -cell.multiplicity[j] if d > a else cell.multiplicity[j]
    before = any_inside(windings, rules)
    windings[owner[i]] += -cell.multiplicity[i] if curves[i, 3, 1] > curves[i, 0, 1] else cell.multiplicity[i]
    after = any_inside(windings, rules)
    return 0 if before == after else (1 if after else -1)


@kernel(allocates=False)
def clean_pieces(cell: CellPieces, out: NDArray[np.float64]) -> int:
    """Write the pieces between inside and outside of a cell whose pieces are separate; return how many, or `UNSURE`."""
    curves = cell.curves
    count = 0
    for i in range(len(curves)):
        if curves[i, 0, 1] == curves[i, 3, 1]:
            continue
        role = _role(cell, i)
        if role == UNSURE:
            return UNSURE
        if role != 0:
            turned = (role == 1) != (curves[i, 3, 1] < curves[i, 0, 1])
            for k in range(4):
                source = 3 - k if turned else k
                out[count, k, 0], out[count, k, 1] = curves[i, source, 0], curves[i, source, 1]
            count += 1
    return count
