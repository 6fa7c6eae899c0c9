"""Places where a cubic must be cut before it is offset: where it slows down, and where it bends too tightly."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.chain import unit
from vexture.bezier.roots import turning_points, velocity_at

CUSP: Final = 1e-6
"""Speed, as a share of that at the ends, below which the least speed of a cubic is a cusp."""

GRID: Final = 8
"""Places between two cuts where the curvature is compared with the width."""

SLOW: Final = 0.125
"""Speed, as a share of the highest, below which these places are denser."""

FINER: Final = 12
"""Powers of a quarter up to which they are."""

HALVINGS: Final = 45
"""Bisections of a place on a cubic."""

NUDGE: Final = 1e-7
"""Parameter. Curvature at an end without an arm is that at this distance."""

MOST_CUTS: Final = 64
"""Room for the cuts of a cubic: tightness begins or ends at up to 12 places, and is extreme at up to 7."""


@kernel(allocates=False)
def tangent_at(curve: NDArray[np.float64], t: float) -> tuple[float, float]:
    """Unit direction of a cubic; at an end without an arm, towards the next other control point."""
    if t == 0.0:
        for k in range(1, 4):
            x, y = unit(curve[k, 0] - curve[0, 0], curve[k, 1] - curve[0, 1])
            if x != 0.0 or y != 0.0:
                return x, y
    elif t == 1.0:
        for k in range(2, -1, -1):
            x, y = unit(curve[3, 0] - curve[k, 0], curve[3, 1] - curve[k, 1])
            if x != 0.0 or y != 0.0:
                return x, y
    return unit(
        velocity_at(curve[0, 0], curve[1, 0], curve[2, 0], curve[3, 0], t),
        velocity_at(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], t),
    )


@kernel(allocates=False)
def bend_at(curve: NDArray[np.float64], t: float) -> tuple[float, float]:
    """Cross product of velocity and acceleration, and speed; their quotient with its cube is the curvature."""
    s = 1.0 - t
    dx = velocity_at(curve[0, 0], curve[1, 0], curve[2, 0], curve[3, 0], t)
    dy = velocity_at(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], t)
    ddx = s * (curve[2, 0] - 2.0 * curve[1, 0] + curve[0, 0]) + t * (curve[3, 0] - 2.0 * curve[2, 0] + curve[1, 0])
    ddy = s * (curve[2, 1] - 2.0 * curve[1, 1] + curve[0, 1]) + t * (curve[3, 1] - 2.0 * curve[2, 1] + curve[1, 1])
    return 6.0 * (dx * ddy - dy * ddx), np.sqrt(dx * dx + dy * dy)


@kernel(allocates=False)
def tightness_at(curve: NDArray[np.float64], half: float, t: float) -> float:
    """Curvature times half the width: beyond 1 the inner parallel curve goes backwards. Positive towards +90 degrees.

    It is kept within 1e30, which stands for a cusp.
    """
    cross, speed = bend_at(curve, t)
    if speed == 0.0:  # an end without an arm
        cross, speed = bend_at(curve, NUDGE if t < 0.5 else 1.0 - NUDGE)
    cube = speed * speed * speed
    if not abs(cross) * half < 1e30 * cube:
        return 0.0 if cross == 0.0 else (1e30 if cross > 0.0 else -1e30)
    return cross * half / cube


@kernel(allocates=False)
def _slowing_at(curve: NDArray[np.float64], t: float) -> float:
    """Half the derivative of the square of the speed."""
    total, s = 0.0, 1.0 - t
    for axis in range(2):
        p0, p1, p2, p3 = curve[0, axis], curve[1, axis], curve[2, axis], curve[3, axis]
        total += velocity_at(p0, p1, p2, p3, t) * 6.0 * (s * (p2 - 2.0 * p1 + p0) + t * (p3 - 2.0 * p2 + p1))
    return total


@kernel(allocates=False)
def insert_sorted(values: NDArray[np.float64], count: int, value: float) -> int:
    """Insert a number into `count` sorted ones, if there is room; return how many there are."""
    if count == len(values):
        return count
    k = count
    while k > 0 and values[k - 1] > value:
        values[k] = values[k - 1]
        k -= 1
    values[k] = value
    return count + 1


@kernel
def find_slowest(curve: NDArray[np.float64], out: NDArray[np.float64]) -> int:
    """Write the parameters in (0, 1) at which the speed is least; return how many (0 to 2).

    The derivative of the squared speed is a cubic, as a Bezier curve of the products of the first and second
    differences; between its own turning points it is monotone.
    """
    b = np.zeros(4)
    for axis in range(2):
        a0, a1, a2 = curve[1, axis] - curve[0, axis], curve[2, axis] - curve[1, axis], curve[3, axis] - curve[2, axis]
        c0, c1 = a1 - a0, a2 - a1
        b[0] += a0 * c0
        b[1] += (2.0 * a1 * c0 + a0 * c1) / 3.0
        b[2] += (a2 * c0 + 2.0 * a1 * c1) / 3.0
        b[3] += a2 * c1
    places = np.empty(4)
    places[0] = 0.0
    count = 1 + turning_points(b[0], b[1], b[2], b[3], places[1:])
    places[count] = 1.0
    found = 0
    for i in range(count):
        low, high = places[i], places[i + 1]
        if not (_slowing_at(curve, low) < 0.0 < _slowing_at(curve, high)):
            continue
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            if _slowing_at(curve, middle) < 0.0:
                low = middle
            else:
                high = middle
        out[found] = high
        found += 1
    return found


@kernel(allocates=False)
def find_inflections(curve: NDArray[np.float64], out: NDArray[np.float64]) -> int:
    """Write the parameters in (0, 1) at which the curvature changes its sign; return how many (0 to 2)."""
    ax, ay = curve[1, 0] - curve[0, 0], curve[1, 1] - curve[0, 1]
    bx, by = curve[2, 0] - curve[1, 0] - ax, curve[2, 1] - curve[1, 1] - ay
    cx, cy = curve[3, 0] - curve[2, 0], curve[3, 1] - curve[2, 1]
    cx, cy = cx - (curve[2, 0] - curve[1, 0]) - bx, cy - (curve[2, 1] - curve[1, 1]) - by
    c, b, a = ax * by - ay * bx, ax * cy - ay * cx, bx * cy - by * cx
    # c + b t + a t^2 = 0 is where its integral c t + b t^2 / 2 + a t^3 / 3 turns
    return turning_points(0.0, c / 3.0, (2.0 * c + b / 2.0) / 3.0, c + b / 2.0 + a / 3.0, out)


@kernel(allocates=False)
def _tight_place(curve: NDArray[np.float64], half: float, low: float, high: float) -> float:
    """Parameter between two places, of which one is tight and the other is not, at which tightness begins."""
    tight = abs(tightness_at(curve, half, low)) > 1.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if (abs(tightness_at(curve, half, middle)) > 1.0) == tight:
            low = middle
        else:
            high = middle
    return high


@kernel(allocates=False)
def _extreme_place(curve: NDArray[np.float64], half: float, low: float, high: float, sign: float) -> float:
    """Parameter at which `sign` times the absolute tightness is greatest, by ternary search."""
    for _ in range(HALVINGS):
        a, b = low + (high - low) / 3.0, high - (high - low) / 3.0
        if sign * abs(tightness_at(curve, half, a)) < sign * abs(tightness_at(curve, half, b)):
            low = a
        else:
            high = b
    return 0.5 * (low + high)


@kernel(allocates=False)
def _write_samples(
    curve: NDArray[np.float64], places: NDArray[np.float64], count: int, out: NDArray[np.float64]
) -> int:
    """Write parameters that are dense enough to see where a cubic bends tightly; return their number.

    `places` are where it begins, ends, slows down and has no curvature. Where it is slow, its curvature changes fast:
    next to slow places, samples are ever denser.
    """
    fast, n = 0.0, 0
    for k in range(count):
        fast = max(fast, bend_at(curve, places[k])[1])
    fast = max(fast, bend_at(curve, 0.5)[1])
    for k in range(count - 1):
        low, high = places[k], places[k + 1]
        out[n] = low
        n += 1
        if bend_at(curve, low)[1] < SLOW * fast:
            for m in range(FINER, 1, -1):
                out[n] = low + (high - low) * 0.25**m
                n += 1
        for m in range(1, GRID):
            out[n] = low + (high - low) * (m / GRID)
            n += 1
        if bend_at(curve, high)[1] < SLOW * fast:
            for m in range(2, FINER + 1):
                out[n] = high - (high - low) * 0.25**m
                n += 1
    out[n] = places[count - 1]
    return n + 1


@kernel
def find_cuts(curve: NDArray[np.float64], half: float, out: NDArray[np.float64]) -> int:
    """Write where to cut a cubic before it is offset, in rising order; return how many.

    It is cut where its speed is least, if it is tight there, where tightness begins and ends, and, within, where the
    evolute turns back, which is where the curvature is extreme.
    """
    places, count, few = np.empty(8), 0, np.empty(2)
    for value in (0.0, 1.0):
        count = insert_sorted(places, count, value)
    for k in range(find_inflections(curve, few)):
        count = insert_sorted(places, count, few[k])
    found = 0
    for k in range(find_slowest(curve, few)):
        count = insert_sorted(places, count, few[k])
        slow = bend_at(curve, few[k])[1] <= CUSP * max(bend_at(curve, 0.0)[1], bend_at(curve, 1.0)[1])
        if slow or abs(tightness_at(curve, half, few[k])) > 1.0:
            found = insert_sorted(out, found, few[k])
    at = np.empty((len(places) - 1) * (GRID + 2 * FINER) + 1)
    size = _write_samples(curve, places, count, at)
    tight = np.empty(size)
    for i in range(size):
        tight[i] = abs(tightness_at(curve, half, at[i]))
    for i in range(size - 1):
        if (tight[i] > 1.0) != (tight[i + 1] > 1.0):
            found = insert_sorted(out, found, _tight_place(curve, half, at[i], at[i + 1]))
        if i > 0 and tight[i] > 1.0:
            if tight[i - 1] < tight[i] >= tight[i + 1]:
                found = insert_sorted(out, found, _extreme_place(curve, half, at[i - 1], at[i + 1], 1.0))
            elif tight[i - 1] > tight[i] <= tight[i + 1]:
                found = insert_sorted(out, found, _extreme_place(curve, half, at[i - 1], at[i + 1], -1.0))
    return found
