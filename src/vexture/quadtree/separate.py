"""Pieces of a cell that touch at most at their ends: what lies on their sides follows by counting.

So it is in the cells of most drawings. All others go through `vexture.quadtree.boundary`.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.kernels import kernel
from vexture.quadtree.crossings import x_at
from vexture.quadtree.winding import inside

__all__ = ["UNSURE", "CellPieces", "all_separate", "any_inside", "clean_pieces", "left_edge_windings"]

UNSURE = -2
"""Role of a piece whose place among its neighbours is not clear."""


class CellPieces(NamedTuple):
    """Pieces of a cell on its lattice.

    Attributes
    ----------
    curves : (n, 4, 2) float64 array
        Ends and control points are integers.
    owner : (n,) int64 array
        The path of each, as an index into the following.
    corner, rules, windings : (paths,) int64 arrays
        Corner windings; `FillRule`s; scratch.
    """

    curves: NDArray[np.float64]
    owner: NDArray[np.int64]
    corner: NDArray[np.int64]
    rules: NDArray[np.int64]
    windings: NDArray[np.int64]


@kernel(allocates=False)
def _beside(curves: NDArray[np.float64], i: int, j: int, line: int) -> bool:
    """Whether pieces i and j lie on different sides of the direction of `line`, which is one of them."""
    x0, y0 = curves[line, 0, 0], curves[line, 0, 1]
    dx, dy = curves[line, 3, 0] - x0, curves[line, 3, 1] - y0
    i_low, i_high, j_low, j_high = np.inf, -np.inf, np.inf, -np.inf
    for k in range(4):
        across = dx * (curves[i, k, 1] - y0) - dy * (curves[i, k, 0] - x0)
        i_low, i_high = min(i_low, across), max(i_high, across)
        across = dx * (curves[j, k, 1] - y0) - dy * (curves[j, k, 0] - x0)
        j_low, j_high = min(j_low, across), max(j_high, across)
    return (i_high <= j_low and i_low < j_high) or (j_high <= i_low and j_low < i_high)


@kernel(allocates=False)
def _separate(curves: NDArray[np.float64], i: int, j: int) -> bool:
    """Whether two monotone pieces surely touch at most at their ends: their boxes, or their hulls, do."""
    for axis in range(2):
        a, b = curves[i, 0, axis], curves[i, 3, axis]
        c, d = curves[j, 0, axis], curves[j, 3, axis]
        i_low, i_high, j_low, j_high = min(a, b), max(a, b), min(c, d), max(c, d)
        if (i_high <= j_low and i_low < j_high) or (j_high <= i_low and j_low < i_high):
            return True
    return _beside(curves, i, j, i) or _beside(curves, i, j, j)


@kernel(allocates=False)
def all_separate(curves: NDArray[np.float64]) -> bool:
    """Whether no two pieces, horizontal ones aside, touch but at their ends."""
    for i in range(len(curves)):
        if curves[i, 0, 1] == curves[i, 3, 1]:
            continue
        for j in range(i):
            if curves[j, 0, 1] != curves[j, 3, 1] and not _separate(curves, i, j):
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
                windings[owner[i]] += event


@kernel(allocates=False)
def _role(cell: CellPieces, i: int) -> int:
    """1 if only the right side of a piece is inside, -1 if only the left side is, else 0; or `UNSURE`."""
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
            windings[owner[j]] += -1 if d > a else 1
    before = any_inside(windings, rules)
    windings[owner[i]] += -1 if curves[i, 3, 1] > curves[i, 0, 1] else 1
    after = any_inside(windings, rules)
    return 0 if before == after else (1 if after else -1)


@kernel(allocates=False)
def clean_pieces(cell: CellPieces, out: NDArray[np.float64]) -> int:
    """Write the pieces that bound inside, of a cell in which all are separate; return how many, or `UNSURE`."""
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
