"""Curves parallel to a cubic, fitted by cubics.

A parallel curve is smooth as long as its distance is below the radius of curvature (Tiller and Hanson, "Offsets of
two-dimensional profiles", IEEE CG&A 4, 1984).
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.bends import tangent_at
from vexture.bezier.chain import CubicChain, append_cubic, append_line, unit
from vexture.bezier.roots import cubic_at, velocity_at

SAMPLES: Final = 9
"""Points between the ends of a parallel curve that its cubic is fitted to."""

LONGEST_STEP: Final = 0.35
"""Share of a parallel curve between two samples, beyond which they say too little about its middle."""

ROUNDS: Final = 5
"""Most rounds of projection and least squares of a fit."""

FINEST_PART: Final = 2.0**-26
"""Parameter. A parallel curve is not cut into shorter parts."""

MOST_PARTS, WIDEST_LINE = 500, 2.0**-8
"""Cubics of one parallel curve, after which parts of the second length become lines: no input takes forever."""


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


@kernel(allocates=False)
def _is_between_near(
    curve: NDArray[np.float64],
    distance: float,
    t0: float,
    t1: float,
    tolerance: float,
    out: NDArray[np.float64],
    at: NDArray[np.float64],
    side: NDArray[np.float64],
) -> bool:
    """Whether a cubic is near the parallel curve between its samples, whose places on the cubic are `at`, too."""
    for i in range(-1, SAMPLES + 2):
        # halfway between samples, and once more at both ends, where a parallel curve may bend most
        place = min(max(i + 0.5, 0.25), SAMPLES + 0.75)
        share = place / (SAMPLES + 1)
        write_side(curve, distance, t0 + (t1 - t0) * share, side)
        k = int(place)
        low, high = (at[k - 1] if k > 0 else 0.0), (at[k] if k < SAMPLES else 1.0)
        t, ox, oy = low + (high - low) * (place - k), 0.0, 0.0
        for _ in range(3):
            ox = side[0] - cubic_at(out[0, 0], out[1, 0], out[2, 0], out[3, 0], t)
            oy = side[1] - cubic_at(out[0, 1], out[1, 1], out[2, 1], out[3, 1], t)
            vx = velocity_at(out[0, 0], out[1, 0], out[2, 0], out[3, 0], t)
            vy = velocity_at(out[0, 1], out[1, 1], out[2, 1], out[3, 1], t)
            square = vx * vx + vy * vy
            t = min(max(t + (ox * vx + oy * vy) / square, 0.0), 1.0) if square > 0.0 else t
        if ox * ox + oy * oy > tolerance * tolerance:
            return False
    return True


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
            return _is_between_near(curve, distance, t0, t1, tolerance, out, at, a)
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
    t0, step, first = 0.0, 1.0, chain.length[0]
    while t0 < 1.0:
        many = chain.length[0] - first > MOST_PARTS
        if step < (WIDEST_LINE if many else FINEST_PART):
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
