"""Slabs of chords: the sweep from top to bottom that the exact renderer's coverage and colours share.

A *slab* lies between two consecutive heights at which a chord begins, ends or crosses another. In it, all chords run
from top to bottom in one order. No slab is thinner than `SCANLINE` pixels; a wrong order in such a thin slab causes an
error of at most its area.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.tolerance import SCANLINE
from vexture.renderers.flatten import Chords, snap


class Sweep(NamedTuple):
    """State of a sweep over chords."""

    lines: NDArray[np.float64]  # (n, 4): lines of `Chords`
    order: NDArray[np.int64]  # (n,): the chords, sorted by their tops
    active: NDArray[np.int64]  # (n,): first the chords in the slab, from left to right
    highs: NDArray[np.float64]  # (n,): x of each active chord at the slab's top
    lows: NDArray[np.float64]  # (n,): the same at its bottom
    counts: NDArray[np.int64]  # (2,): number of chords in the slab; number of chords of `order` reached so far

    @classmethod
    def over(cls, chords: Chords) -> "Sweep":
        """Start a sweep at the image's upper edge."""
        count = len(chords.lines)
        order = np.argsort(chords.lines[:, 0], kind="stable")
        return cls(
            chords.lines, order, np.empty(count, np.int64), np.empty(count), np.empty(count), np.zeros(2, np.int64)
        )


@kernel(allocates=False)
def next_slab(sweep: Sweep, high: float, limit: float) -> float:
    """Find and order the chords of the slab below a height; return its bottom, which is at or above `limit`."""
    lines, order, active = sweep.lines, sweep.order, sweep.active
    count, following, low = 0, sweep.counts[1], limit
    for k in range(sweep.counts[0]):
        end = lines[active[k], 1]
        if end > high:
            active[count] = active[k]
            count += 1
            low = min(low, end)
    while following < len(order) and lines[order[following], 0] <= high:
        active[count] = order[following]
        low = min(low, lines[order[following], 1])
        count += 1
        following += 1
    if following < len(order):
        low = min(low, lines[order[following], 0])
    sweep.counts[0], sweep.counts[1] = count, following
    return order_slab(lines, active[:count], high, low, sweep.highs, sweep.lows)


@kernel(allocates=False)
def order_slab(
    lines: NDArray[np.float64],
    active: NDArray[np.int64],
    high: float,
    low: float,
    highs: NDArray[np.float64],
    lows: NDArray[np.float64],
) -> float:
    """Sort the active chords from left to right; write x of each at the slab's top and bottom; return its bottom.

    If neighbours cross, the slab ends at their first crossing. Crossings by less than `SCANLINE`, as of coincident
    chords, are ignored.
    """
    while True:
        for k in range(len(active)):
            chord = active[k]
            slope = lines[chord, 3]
            x = lines[chord, 2] + (high - lines[chord, 0]) * slope
            end = x + (low - high) * slope
            place = k
            while place > 0 and highs[place - 1] + lows[place - 1] > x + end:
                active[place], highs[place], lows[place] = active[place - 1], highs[place - 1], lows[place - 1]
                place -= 1
            active[place], highs[place], lows[place] = chord, x, end
        cut = low
        for k in range(len(active) - 1):
            above, below = highs[k] - highs[k + 1], lows[k] - lows[k + 1]
            if max(above, below) > SCANLINE:
                cut = min(cut, high + (low - high) * above / (above - below))
        cut = max(snap(cut), high + SCANLINE)
        if cut >= low:
            return low
        low = cut


@kernel(allocates=False)
def cross(owner: int, winding: NDArray[np.int64], evenodd: NDArray[np.bool_]) -> int:
    """Update the winding number of a chord's path; return 1 if the path begins at the chord, -1 if it ends, else 0."""
    path = abs(owner) - 1
    before = winding[path]
    after = before + (1 if owner > 0 else -1)
    winding[path] = after
    return int((after & 1) - (before & 1) if evenodd[path] else int(after != 0) - int(before != 0))


@kernel(allocates=False)
def add_edge(x0: float, x1: float, height: float, jump: tuple[float, ...], change: NDArray[np.float64]) -> None:
    """Add a jump of n components times the area to the right of a straight edge; `change` is (width + 2, n).

    For the part of the edge in one column, of height h and mean distance m from the column's left side, h (1 - m) lies
    in that column and h in each column further right.
    """
    right_side = len(change) - 2.0
    left = min(max(min(x0, x1), 0.0), right_side)
    right = min(max(max(x0, x1), 0.0), right_side)
    first, last = int(left), int(right)
    density = height / (right - left) if last > first else 0.0
    for column in range(first, last + 1):
        start, end = max(left, float(column)), min(right, column + 1.0)
        part = density * (end - start) if last > first else height
        beyond = part * (0.5 * (start + end) - column)
        for k in range(len(jump)):
            change[column, k] += jump[k] * (part - beyond)
            change[column + 1, k] += jump[k] * beyond
