"""A packed leaf's left edge: its corner winding and the ends on the edge must agree with what is inside there."""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import LATTICE
from vexture.tree.separate import CellPieces, any_inside, left_edge_windings

TOUCH = 2.0
"""Lattice units. A resolved end closer than this to the left edge may be moved onto it."""


@kernel(allocates=False)
def _events(out: NDArray[np.float64], count: int, y: float) -> int:
    """Starts minus ends on the left edge at a height."""
    total = 0
    for k in range(count):
        for end, event in ((0, 1), (3, -1)):
            if out[k, end, 0] == 0.0 and out[k, end, 1] == y:
                total += event
    return total


@kernel(allocates=False)
def _match_left_edge(out: NDArray[np.float64], count: int, y: float, target: int) -> int:
    """Make starts minus ends on the left edge at a height equal to `target`; return the new count of pieces.

    Where they differ an end is moved off the edge, or one beside it onto it, or, where the boundary leaves the edge
    horizontally, a horizontal piece is added.
    """
    for _ in range(2 * len(out)):
        missing = target - _events(out, count, y)
        if missing == 0:
            break
        best, best_end, best_x = -1, 0, TOUCH
        for k in range(count):
            for end, event in ((0, 1), (3, -1)):
                x = out[k, end, 0]
                if out[k, end, 1] != y:
                    continue
                if x == 0.0 and event * missing < 0:
                    best, best_end, best_x = k, end, -1.0
                elif 0.0 < x <= best_x and event * missing > 0:
                    best, best_end, best_x = k, end, x
        if best < 0:
            count = _add_horizontal(out, count, y, missing > 0)
            continue
        moved = 1.0 if best_x < 0.0 else -best_x
        out[best, best_end, 0] += moved
        out[best, 1 if best_end == 0 else 2, 0] += moved
    return count


@kernel(allocates=False)
def _add_horizontal(out: NDArray[np.float64], count: int, y: float, starts: bool) -> int:
    """Append a horizontal piece from (or to) the left edge, as far as the next end; return the count."""
    x = LATTICE
    for k in range(count):
        for end in (0, 3):
            if out[k, end, 1] == y and 0.0 < out[k, end, 0] < x:
                x = out[k, end, 0]
    for k in range(4):
        part = k if starts else 3 - k
        out[count, k, 0], out[count, k, 1] = x * part / 3.0, y
    return count + 1


@kernel(allocates=False)
def corner_winding(cell: CellPieces, out: NDArray[np.float64], count: int) -> tuple[int, int]:
    """Make the ends on the left edge agree with the windings there; return the new count and the corner winding."""
    curves, windings, rules = cell.curves, cell.windings, cell.rules
    for i in range(len(curves)):
        for end in (0, 3):
            y = curves[i, end, 1]
            if curves[i, end, 0] == 0.0 and 0.0 < y < LATTICE:
                left_edge_windings(cell, y, True)
                below = 1 if any_inside(windings, rules) else 0
                left_edge_windings(cell, y, False)
                above = 1 if any_inside(windings, rules) else 0
                count = _match_left_edge(out, count, y, above - below)
    left_edge_windings(cell, 0.0, False)
    return count, (1 if any_inside(windings, rules) else 0) - _events(out, count, 0.0)
