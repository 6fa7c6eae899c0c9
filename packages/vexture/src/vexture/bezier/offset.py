"""Curves parallel to a cubic, fitted by cubics, and the places where a cubic must be cut first.

A parallel curve is smooth as long as its distance is below the radius of curvature (Tiller and Hanson, "Offsets of
two-dimensional profiles", IEEE CG&A 4, 1984). Beyond, on the inner side of a tight bend, we follow the evolute, the
curve of the centres of curvature: the nearest point of a curve is never farther than its centre of curvature, so that
the band between both sides covers all of the stroke, and covers no place backwards (Nehab, "Converting stroked
primitives to filled primitives", ACM TOG 39, 2020).
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.roots import cubic_at, turning_points, velocity_at
from vexture.bezier.split import copy_curve, subcubic

SAMPLES: Final = 9
"""Points between the ends of a parallel curve that its cubic is fitted to."""

LONGEST_STEP: Final = 0.35
"""Share of a parallel curve between two samples, beyond which they say too little about its middle."""

ROUNDS: Final = 5
"""Most rounds of projection and least squares of a fit."""

FINEST_PART: Final = 2.0**-26
"""Parameter. A parallel curve is not cut into shorter parts."""

CUSP: Final = 1e-6
"""Speed, as a share of that at the ends, below which the least speed of a cubic is a cusp."""

GRID: Final = 8
"""Places between two cuts where the curvature is compared with the width."""

HALVINGS: Final = 45
"""Bisections of a place on a cubic."""

MOST_CUTS: Final = 64
"""Room for the cuts of a cubic; further ones are left out."""


class CubicChain(NamedTuple):
    """Cubics that follow each other, in an array with room for more."""

    cubics: NDArray[np.float64]  # (room, 4, 2)
    length: NDArray[np.int64]  # (1,): number of cubics


@kernel
def empty_chain(room: int) -> CubicChain:
    """CubicChain without cubics."""
    return CubicChain(np.empty((room, 4, 2)), np.zeros(1, np.int64))


@kernel
def append_cubic(chain: CubicChain, curve: NDArray[np.float64]) -> CubicChain:
    """Add a cubic (4, 2)."""
    count = chain.length[0]
    if count == len(chain.cubics):
        more = np.empty((2 * count + 4, 4, 2))
        more[:count] = chain.cubics
        chain = CubicChain(more, chain.length)
    copy_curve(curve, chain.cubics[count])
    chain.length[0] = count + 1
    return chain


@kernel
def append_line(chain: CubicChain, x0: float, y0: float, x1: float, y1: float) -> CubicChain:
    """Add the straight line between two points, unless they are the same."""
    if x0 == x1 and y0 == y1:
        return chain
    curve = np.empty((4, 2))
    curve[0, 0], curve[0, 1], curve[3, 0], curve[3, 1] = x0, y0, x1, y1
    for axis in range(2):
        chord = curve[3, axis] - curve[0, axis]
        curve[1, axis] = curve[0, axis] + chord / 3.0
        curve[2, axis] = curve[0, axis] + chord * (2.0 / 3.0)
    return append_cubic(chain, curve)


@kernel(allocates=False)
def unit(x: float, y: float) -> tuple[float, float]:
    """Vector of length 1 in a direction; zero if it has none."""
    scale = max(abs(x), abs(y))
    if not scale > 0.0:
        return 0.0, 0.0
    x, y = x / scale, y / scale
    length = np.sqrt(x * x + y * y)
    return x / length, y / length


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
    size = (count - 1) * GRID
    at, tight = np.empty(size + 1), np.empty(size + 1)
    for i in range(size + 1):
        k = min(i // GRID, count - 2)
        at[i] = places[k] + (places[k + 1] - places[k]) * ((i - k * GRID) / GRID)
        tight[i] = abs(tightness_at(curve, half, at[i]))
    for i in range(size):
        if (tight[i] > 1.0) != (tight[i + 1] > 1.0):
            found = insert_sorted(out, found, _tight_place(curve, half, at[i], at[i + 1]))
        if i > 0 and tight[i] > 1.0:
            if tight[i - 1] < tight[i] >= tight[i + 1]:
                found = insert_sorted(out, found, _extreme_place(curve, half, at[i - 1], at[i + 1], 1.0))
            elif tight[i - 1] > tight[i] <= tight[i + 1]:
                found = insert_sorted(out, found, _extreme_place(curve, half, at[i - 1], at[i + 1], -1.0))
    return found


@kernel(allocates=False)
def write_side(curve: NDArray[np.float64], distance: float, t: float, out: NDArray[np.float64]) -> None:
    """Write the point at a distance to the right of a cubic, (x, y), and the unit direction, (4,)."""
    tx, ty = tangent_at(curve, t)
    out[0] = cubic_at(curve[0, 0], curve[1, 0], curve[2, 0], curve[3, 0], t) + distance * ty
    out[1] = cubic_at(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], t) - distance * tx
    out[2], out[3] = tx, ty


@kernel(allocates=False)
def _place_handles(
    out: NDArray[np.float64], a: NDArray[np.float64], b: NDArray[np.float64], p: float, q: float
) -> None:
    """Write the cubic between two points with directions (4,) whose handles have the lengths p and q."""
    for axis in range(2):
        out[0, axis], out[3, axis] = a[axis], b[axis]
        out[1, axis], out[2, axis] = a[axis] + p * a[2 + axis], b[axis] - q * b[2 + axis]


@kernel
def _fit_part(
    curve: NDArray[np.float64], distance: float, t0: float, t1: float, tolerance: float, out: NDArray[np.float64]
) -> bool:
    """Write one cubic for the parallel curve from t0 to t1, with its directions at the ends; False if it is too far.

    The lengths p, q of the handles minimise the squared distances of samples across the cubic: its change with p is
    3 t (1 - t)^2 along the first direction, and with q likewise. They start as those of an arc of a circle.
    """
    a, b, side = np.empty(4), np.empty(4), np.empty((SAMPLES, 4))
    write_side(curve, distance, t0, a)
    write_side(curve, distance, t1, b)
    cx, cy = b[0] - a[0], b[1] - a[1]
    chord = np.sqrt(cx * cx + cy * cy)
    if chord == 0.0 or a[2] * b[2] + a[3] * b[3] < 0.0:
        return False
    at, length, px, py, longest = np.empty(SAMPLES), 0.0, a[0], a[1], 0.0
    for i in range(SAMPLES):
        write_side(curve, distance, t0 + (t1 - t0) * (i + 1) / (SAMPLES + 1), side[i])
        dx, dy = side[i, 0] - px, side[i, 1] - py
        step = np.sqrt(dx * dx + dy * dy)
        longest = max(longest, step)
        length += step
        at[i], px, py = length, side[i, 0], side[i, 1]
    step = np.sqrt((b[0] - px) * (b[0] - px) + (b[1] - py) * (b[1] - py))
    length += step
    if max(longest, step) > LONGEST_STEP * length:
        return False
    cosine = max((cx * (a[2] + b[2]) + cy * (a[3] + b[3])) / (2.0 * chord), 0.0)
    p = q = 2.0 * chord / (3.0 * (1.0 + cosine))
    for i in range(SAMPLES):
        at[i] /= length
    for done in range(ROUNDS):
        _place_handles(out, a, b, p, q)
        pp, pq, qq, pr, qr, worst = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for i in range(SAMPLES):
            t = at[i]
            for _ in range(2):
                ox = side[i, 0] - cubic_at(out[0, 0], out[1, 0], out[2, 0], out[3, 0], t)
                oy = side[i, 1] - cubic_at(out[0, 1], out[1, 1], out[2, 1], out[3, 1], t)
                vx = velocity_at(out[0, 0], out[1, 0], out[2, 0], out[3, 0], t)
                vy = velocity_at(out[0, 1], out[1, 1], out[2, 1], out[3, 1], t)
                square = vx * vx + vy * vy
                t = min(max(t + (ox * vx + oy * vy) / square, 0.0), 1.0) if square > 0.0 else t
            worst = max(worst, ox * ox + oy * oy)
            at[i] = t
            tx, ty = unit(vx, vy)
            u, v = 3.0 * t * (1.0 - t) * (1.0 - t), -3.0 * t * t * (1.0 - t)
            u, v = u * (tx * a[3] - ty * a[2]), v * (tx * b[3] - ty * b[2])
            r = tx * oy - ty * ox
            pp, pq, qq, pr, qr = pp + u * u, pq + u * v, qq + v * v, pr + u * r, qr + v * r
        worst = np.sqrt(worst)
        if worst <= tolerance:
            return True
        determinant = pp * qq - pq * pq
        if (worst > 100.0 * tolerance and done > 1) or not determinant > 1e-14 * pp * qq:
            return False
        p, q = p + (pr * qq - qr * pq) / determinant, q + (qr * pp - pr * pq) / determinant
        if not (0.0 < p < 2.0 * chord and 0.0 < q < 2.0 * chord):
            return False
    return False


@kernel
def append_offset(chain: CubicChain, curve: NDArray[np.float64], distance: float, tolerance: float) -> CubicChain:
    """Add the curve at a distance to the right of a cubic, within a tolerance, as parts of halves of halves."""
    out, a, b = np.empty((4, 2)), np.empty(4), np.empty(4)
    t0, step = 0.0, 1.0
    while t0 < 1.0:
        if step < FINEST_PART:
            write_side(curve, distance, t0, a)
            write_side(curve, distance, t0 + step, b)
            chain = append_line(chain, a[0], a[1], b[0], b[1])
        elif _fit_part(curve, distance, t0, t0 + step, tolerance, out):
            chain = append_cubic(chain, out)
        else:
            step *= 0.5
            continue
        t0 += step
        while t0 / (2.0 * step) == np.floor(t0 / (2.0 * step)) and step < 1.0 and t0 < 1.0:
            step *= 2.0
    return chain


@kernel
def append_evolute(chain: CubicChain, curve: NDArray[np.float64], distance: float) -> CubicChain:
    """Add the chord of the evolute of a cubic that is tight on the right side, or on the left one if distance < 0.

    The evolute is inside the stroke, so that its shape does not matter; the chord covers slightly more than the arc.
    """
    ends = np.empty((2, 4))
    for k in range(2):
        tight = abs(tightness_at(curve, distance, float(k)))
        write_side(curve, distance / max(tight, 1.0), float(k), ends[k])
    return append_line(chain, ends[0, 0], ends[0, 1], ends[1, 0], ends[1, 1])


@kernel(allocates=False)
def write_part(curve: NDArray[np.float64], t0: float, t1: float, shortest: float, out: NDArray[np.float64]) -> None:
    """Write the part of a cubic from t0 to t1, (4, 2), with arms that are too short to have a direction set to zero."""
    subcubic(curve, t0, t1, out)
    for k, end in ((1, 0), (2, 3)):
        if max(abs(out[k, 0] - out[end, 0]), abs(out[k, 1] - out[end, 1])) < shortest:
            out[k, 0], out[k, 1] = out[end, 0], out[end, 1]
