"""Heights at which two monotone pieces change their order."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.roots import cubic_at, solve_monotone, velocity_at

MAX_STEPS = 200
"""Intervals examined for one pair: nearly coincident curves could need many, to gain less than a lattice unit."""

PAIR_ROOM = 32
"""Places kept free for the crossings of one pair: two cubics meet at most nine times."""

STACK = 64
"""Open intervals: bisection at integers of a 16-bit range goes 17 deep and keeps one sibling at each depth."""


@kernel(allocates=False)
def x_at(curve: NDArray[np.float64], y: float) -> float:
    """Coordinate x at height y of a monotone piece that is not horizontal."""
    if y == curve[0, 1]:
        return curve[0, 0]
    if y == curve[3, 1]:
        return curve[3, 0]
    t = solve_monotone(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], y)
    x = cubic_at(curve[0, 0], curve[1, 0], curve[2, 0], curve[3, 0], t)
    return min(max(x, min(curve[0, 0], curve[3, 0])), max(curve[0, 0], curve[3, 0]))


class Stretch(NamedTuple):
    """Bounds of x(y) of a piece over an interval of y: its ends, its distance from their chord, its slope."""

    x_low: float
    x_high: float
    below_chord: float
    above_chord: float
    least_slope: float
    greatest_slope: float


@kernel(allocates=False)
def _stretch(curve: NDArray[np.float64], low: float, high: float) -> Stretch:
    """Bound a piece over low <= y <= high, by the control polygon of that part.

    A cubic's distance from its chord, measured along x, is at most 3/4 of its control points' distance (each of the two
    inner Bernstein polynomials is at most 4/9, their sum at most 3/4).
    """
    t0 = solve_monotone(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], low)
    t1 = solve_monotone(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], high)
    x0 = cubic_at(curve[0, 0], curve[1, 0], curve[2, 0], curve[3, 0], t0)
    x3 = cubic_at(curve[0, 0], curve[1, 0], curve[2, 0], curve[3, 0], t1)
    third = (t1 - t0) / 3.0
    ax = third * velocity_at(curve[0, 0], curve[1, 0], curve[2, 0], curve[3, 0], t0)  # P1 - P0
    ay = third * velocity_at(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], t0)
    cx = third * velocity_at(curve[0, 0], curve[1, 0], curve[2, 0], curve[3, 0], t1)  # P3 - P2
    cy = third * velocity_at(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], t1)
    bx, by = x3 - x0 - ax - cx, high - low - ay - cy  # P2 - P1
    slope = (x3 - x0) / (high - low)
    off1, off2 = ax - slope * ay, slope * cy - cx
    below, above = 0.75 * min(0.0, off1, off2), 0.75 * max(0.0, off1, off2)
    if ay > 0.0 and by > 0.0 and cy > 0.0:
        s_a, s_b, s_c = ax / ay, bx / by, cx / cy
        return Stretch(x0, x3, below, above, min(s_a, s_b, s_c), max(s_a, s_b, s_c))
    return Stretch(x0, x3, below, above, -np.inf, np.inf)


@kernel(allocates=False)
def _single_crossing(a: NDArray[np.float64], b: NDArray[np.float64], low: float, high: float, is_only: bool) -> float:
    """Integer y nearest to a crossing of two pieces whose order differs at `low` and `high`.

    If it is the only one, two steps of three interpolate: they find what bisection finds, after fewer steps.
    """
    gap_low, gap_high, steps = x_at(a, low) - x_at(b, low), x_at(a, high) - x_at(b, high), 0
    falling = gap_low > 0.0
    while high - low > 1.0:
        middle, steps = np.floor(0.5 * (low + high)), steps + 1
        if is_only and steps % 3 != 0:
            middle = np.floor(low + (high - low) * (gap_low / (gap_low - gap_high)))
            middle = min(max(middle, low + 1.0), high - 1.0)
        gap = x_at(a, middle) - x_at(b, middle)
        if (gap > 0.0) == falling:
            low, gap_low = middle, gap
        else:
            high, gap_high = middle, gap
    return low if abs(gap_low) < abs(gap_high) else high


@kernel
def _pair_crossings(
    a: NDArray[np.float64],
    b: NDArray[np.float64],
    low: float,
    high: float,
    near: float,
    out: NDArray[np.float64],
    count: int,
) -> int:
    """Append to out[count:] the heights at which two pieces change their order in low..high; return the new count.

    An interval is done when the curves stay on their sides within `near`; or when their ranges of slopes are disjoint,
    so that they cross at most once; or when it is one unit high. Otherwise it is bisected.
    """
    lows, highs = np.empty(STACK), np.empty(STACK)
    lows[0], highs[0] = low, high
    open_count, steps = 1, 0
    while open_count > 0 and count + 2 <= len(out):
        open_count -= 1
        steps += 1
        low, high = lows[open_count], highs[open_count]
        p, q = _stretch(a, low, high), _stretch(b, low, high)
        gap_low, gap_high = p.x_low - q.x_low, p.x_high - q.x_high
        least, greatest = p.below_chord - q.above_chord, p.above_chord - q.below_chord
        if min(gap_low, gap_high) + least >= -near or max(gap_low, gap_high) + greatest <= near:
            continue
        apart = (gap_low > near and gap_high < -near) or (gap_low < -near and gap_high > near)
        monotone = p.least_slope > q.greatest_slope or q.least_slope > p.greatest_slope
        if monotone or high - low <= 1.0 or steps > MAX_STEPS:
            if apart:
                out[count] = _single_crossing(a, b, low, high, monotone)
                count += 1
            continue
        middle = np.floor(0.5 * (low + high))
        gap = x_at(a, middle) - x_at(b, middle)
        if abs(gap) <= near:  # the order may change exactly between the two halves, as of an S and its chord
            out[count] = middle
            count += 1
        lows[open_count], highs[open_count] = middle, high
        lows[open_count + 1], highs[open_count + 1] = low, middle
        open_count += 2
    return count


@kernel(allocates=False)
def _same_curve(a: NDArray[np.float64], b: NDArray[np.float64], near: float) -> bool:
    """Whether two pieces coincide, in the same or in the opposite direction."""
    same, opposite = True, True
    for k in range(4):
        for axis in range(2):
            same = same and abs(a[k, axis] - b[k, axis]) <= 0.5 * near
            opposite = opposite and abs(a[k, axis] - b[3 - k, axis]) <= 0.5 * near
    return same or opposite


@kernel
def crossing_heights(curves: NDArray[np.float64], near: float, room: int) -> tuple[NDArray[np.float64], int]:
    """Integer heights, not sorted, at which monotone pieces on a lattice change their order, and their number.

    Orders within `near` lattice units have no meaning. `room` places stay free behind the heights, for the caller.

    Examples
    --------
    >>> line = lambda x0, y0, x3, y3: np.linspace((x0, y0), (x3, y3), 4)
    >>> heights, count = crossing_heights(np.array([line(0.0, 0.0, 99.0, 99.0), line(0.0, 99.0, 99.0, 0.0)]), 1.0, 0)
    >>> heights[:count]
    array([49.])
    """
    out = np.empty(PAIR_ROOM + room)
    count = 0
    for i in range(len(curves)):
        a = curves[i]
        for j in range(i):
            b = curves[j]
            low = max(min(a[0, 1], a[3, 1]), min(b[0, 1], b[3, 1]))
            high = min(max(a[0, 1], a[3, 1]), max(b[0, 1], b[3, 1]))
            beside = max(a[0, 0], a[3, 0]) <= min(b[0, 0], b[3, 0]) or max(b[0, 0], b[3, 0]) <= min(a[0, 0], a[3, 0])
            if low >= high or beside or _same_curve(a, b, near):
                continue
            if count + PAIR_ROOM + room > len(out):
                more = np.empty(2 * len(out) + PAIR_ROOM)
                for k in range(count):
                    more[k] = out[k]
                out = more
            count = _pair_crossings(a, b, low, high, near, out[: len(out) - room], count)
    return out, count
