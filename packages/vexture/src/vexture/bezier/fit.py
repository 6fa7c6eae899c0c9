"""One cubic through many points, by least squares."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.roots import cubic_at, velocity_at
from vexture.bezier.split import copy_curve

ROUNDS = 10
"""Most rounds of projection and least squares; more gain little on chains of one cell."""

SLOW, SLOW_ROUNDS = 0.9, 4
"""A fit is given up after 4 rounds that left more than this share of its distance."""

FAR, FAR_ROUND = 30.0, 3
"""A fit is given up if it is still this many tolerances away after 3 rounds: the chain needs more than one cubic."""

MOST_SAMPLES, LEAST_PER_PIECE, MOST_PER_PIECE = 96, 2, 8
"""Points of a run that a fit uses: in all, if there are few pieces, and on each piece."""

LANES = 8
"""Numbers in the longest vectors of processors: what is left of a loop over points takes as long as two vectors."""

TERMS = 13
"""Entries of the equations of least squares, of which each point adds a term to each."""

MEASURED = 4
"""Rounds of projection that measure a cubic whose control points were moved into the box of its ends."""

ALONG = 0.001
"""First weight of squared distances along the curve; tenfold after each step that made the fit worse."""


class NormalEquations(NamedTuple):
    """Scratch arrays of `_least_squares`."""

    terms: NDArray[np.float64]  # (`TERMS`, n): what each point adds to the entries
    a: NDArray[np.float64]  # (4, 4)
    b: NDArray[np.float64]  # (4,)


@kernel(allocates=False)
def chord_parameters(points: NDArray[np.float64], t: NDArray[np.float64]) -> float:
    """Write each point's share of the polyline's length, (n, 2) -> (n,); return the length."""
    t[0] = 0.0
    for i in range(1, len(points)):
        dx, dy = points[i, 0] - points[i - 1, 0], points[i, 1] - points[i - 1, 1]
        t[i] = t[i - 1] + np.sqrt(dx * dx + dy * dy)  # hypot differs between C libraries
    total = t[-1]
    for i in range(len(points)):
        t[i] = t[i] / total if total > 0.0 else 0.0
    return total


@kernel(allocates=False)
def _solve_symmetric(a: NDArray[np.float64], b: NDArray[np.float64]) -> bool:
    """Overwrite b, (n,), by the solution of a x = b; False if a, (n, n), is not positive definite."""
    n = len(b)
    for k in range(n):
        if a[k, k] <= 0.0:
            return False
        for i in range(k + 1, n):
            factor = a[i, k] / a[k, k]
            for j in range(k, n):
                a[i, j] -= factor * a[k, j]
            b[i] -= factor * b[k]
    for k in range(n - 1, -1, -1):
        for j in range(k + 1, n):
            b[k] -= a[k, j] * b[j]
        b[k] /= a[k, k]
    return True


@kernel(allocates=False)
def _terms(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    t: NDArray[np.float64],
    along_weight: float,
    curve: NDArray[np.float64],
    terms: NDArray[np.float64],
) -> None:
    """Write each point's terms of the entries of the equations of `_least_squares`, (13, n).

    A point's metric is n n^T + along_weight d d^T, with the unit tangent d and the unit normal n. The loop has no sums,
    so that the compiler handles several points at once.
    """
    x0, x1, x2, x3 = curve[0, 0], curve[1, 0], curve[2, 0], curve[3, 0]
    y0, y1, y2, y3 = curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1]
    for i in range(1, len(t)):
        s, u = 1.0 - t[i], t[i]
        w0, w1, w2, w3 = s * s * s, 3.0 * s * s * u, 3.0 * s * u * u, u * u * u
        off_x = x[i] - w0 * x0 - w1 * x1 - w2 * x2 - w3 * x3
        off_y = y[i] - w0 * y0 - w1 * y1 - w2 * y2 - w3 * y3
        dx, dy = velocity_at(x0, x1, x2, x3, u), velocity_at(y0, y1, y2, y3, u)
        square = dx * dx + dy * dy
        still = not square > 0.0
        divisor = 1.0 if still else square
        xx = 1.0 if still else (dy * dy + along_weight * dx * dx) / divisor
        yy = 1.0 if still else (dx * dx + along_weight * dy * dy) / divisor
        xy = 0.0 if still else (along_weight - 1.0) * dx * dy / divisor
        to_x, to_y = xx * off_x + xy * off_y, xy * off_x + yy * off_y
        w11, w12, w22 = w1 * w1, w1 * w2, w2 * w2
        terms[0, i], terms[1, i], terms[2, i] = w11 * xx, w11 * xy, w11 * yy
        terms[3, i], terms[4, i], terms[5, i] = w12 * xx, w12 * xy, w12 * yy
        terms[6, i], terms[7, i], terms[8, i] = w22 * xx, w22 * xy, w22 * yy
        terms[9, i], terms[10, i] = w1 * to_x, w1 * to_y
        terms[11, i], terms[12, i] = w2 * to_x, w2 * to_y


@kernel(allocates=False)
def _least_squares(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    t: NDArray[np.float64],
    along_weight: float,
    curve: NDArray[np.float64],
    equations: NormalEquations,
    n: int,
) -> bool:
    """Move P1 and P2 so that the squared distances across the curve are least; False if undetermined.

    Distances along the curve count `along_weight` only, because projection moves the point along the curve anyway. This
    is the tangent distance minimisation of Wang, Pottmann and Liu, "Fitting B-spline curves to point clouds by
    curvature-based squared distance minimization" (ACM TOG 25, 2006). It converges many times faster than distances to
    fixed parameters. There are n points; the arrays may be longer. `equations` are overwritten.
    """
    terms, a, b = equations
    _terms(x, y, t, along_weight, curve, terms)
    xx11, xy11, yy11, xx12, xy12, yy12, xx22, xy22, yy22 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    bx1, by1, bx2, by2 = 0.0, 0.0, 0.0, 0.0
    for i in range(1, n - 1):
        xx11 += terms[0, i]
        xy11 += terms[1, i]
        yy11 += terms[2, i]
        xx12 += terms[3, i]
        xy12 += terms[4, i]
        yy12 += terms[5, i]
        xx22 += terms[6, i]
        xy22 += terms[7, i]
        yy22 += terms[8, i]
        bx1 += terms[9, i]
        by1 += terms[10, i]
        bx2 += terms[11, i]
        by2 += terms[12, i]
    a[0, 0], a[0, 1], a[0, 2], a[0, 3] = xx11, xy11, xx12, xy12
    a[1, 0], a[1, 1], a[1, 2], a[1, 3] = xy11, yy11, xy12, yy12
    a[2, 0], a[2, 1], a[2, 2], a[2, 3] = xx12, xy12, xx22, xy22
    a[3, 0], a[3, 1], a[3, 2], a[3, 3] = xy12, yy12, xy22, yy22
    b[0], b[1], b[2], b[3] = bx1, by1, bx2, by2
    if not _solve_symmetric(a, b):
        return False
    for k in range(4):
        curve[1 + k // 2, k % 2] += b[k]
    return True


@kernel(allocates=False)
def project(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    t: NDArray[np.float64],
    curve: NDArray[np.float64],
    squares: NDArray[np.float64],
) -> float:
    """Move each parameter t, (n,), to the nearest place on the curve by a Newton step; return the largest distance.

    `x` and `y` (n,) are the points, of which the first and the last are the curve's ends and stay. `squares` (n,) is
    overwritten.
    """
    last = t[-1]
    distance = _project_all(x, y, t, curve, squares, len(t))
    t[-1] = last
    return distance


@kernel(allocates=False)
def _project_all(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    t: NDArray[np.float64],
    curve: NDArray[np.float64],
    squares: NDArray[np.float64],
    n: int,
) -> float:
    """`project` n points, and those behind them, if the arrays are longer; the last point moves, too.

    The first loop has no sums, and arrays of unit stride: the compiler handles several points at once.
    """
    x0, x1, x2, x3 = curve[0, 0], curve[1, 0], curve[2, 0], curve[3, 0]
    y0, y1, y2, y3 = curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1]
    for i in range(1, len(t)):
        u = t[i]
        off_x, off_y = cubic_at(x0, x1, x2, x3, u) - x[i], cubic_at(y0, y1, y2, y3, u) - y[i]
        dx, dy = velocity_at(x0, x1, x2, x3, u), velocity_at(y0, y1, y2, y3, u)
        ddx = 6.0 * ((1.0 - u) * (x2 - 2.0 * x1 + x0) + u * (x3 - 2.0 * x2 + x1))
        ddy = 6.0 * ((1.0 - u) * (y2 - 2.0 * y1 + y0) + u * (y3 - 2.0 * y2 + y1))
        slope = dx * dx + off_x * ddx + (dy * dy + off_y * ddy)
        step = (off_x * dx + off_y * dy) / (slope if slope > 0.0 else 1.0)
        u = min(max(u - step, 0.0), 1.0) if slope > 0.0 else u
        off_x, off_y = cubic_at(x0, x1, x2, x3, u) - x[i], cubic_at(y0, y1, y2, y3, u) - y[i]
        t[i], squares[i] = u, off_x * off_x + off_y * off_y
    worst, even, odd = 0.0, 0.0, 0.0
    for i in range(1, n - 2, 2):  # two chains of comparisons: each waits for the one before it
        odd, even = max(odd, squares[i]), max(even, squares[i + 1])
    if n > 2:
        worst = max(max(odd, even), squares[n - 2])
    return np.sqrt(worst)


@kernel(allocates=False)
def _copy_fit(
    curve: NDArray[np.float64], t: NDArray[np.float64], best: NDArray[np.float64], best_t: NDArray[np.float64]
) -> None:
    """Copy a curve and its parameters."""
    copy_curve(curve, best)
    for i in range(len(t)):
        best_t[i] = t[i]


@kernel
def fit_cubic(points: NDArray[np.float64], tolerance: float, curve: NDArray[np.float64]) -> float:
    """Write the cubic from the first to the last of n >= 2 points, (n, 2), nearest to all; return the largest distance.

    P. J. Schneider, "An algorithm for automatically fitting digitized curves" (Graphics Gems, 1990), with both inner
    control points free: the tangents at the ends are not prescribed. The fit stops when every point is within
    `tolerance`.
    """
    n = len(points)
    for k in range(4):
        for axis in range(2):
            curve[k, axis] = (1.0 - k / 3.0) * points[0, axis] + (k / 3.0) * points[n - 1, axis]
    width = 1 + (n + LANES - 2) // LANES * LANES  # the points after the first one, in full vectors
    scratch = np.empty((4 + TERMS, width))
    x, y, t, best_t, terms = scratch[0], scratch[1], scratch[2], scratch[3], scratch[4:]
    equations = NormalEquations(terms, np.empty((4, 4)), np.empty(4))
    for i in range(width):
        k = min(i, n - 1)
        x[i], y[i], t[i] = points[k, 0], points[k, 1], 1.0
    chord_parameters(points, t[:n])
    best, best_curve = np.inf, np.empty((4, 2))
    along = ALONG
    slow = 0
    for done in range(1, ROUNDS + 1):
        worst = _project_all(x, y, t, curve, terms[0], n)
        slow += 1 if worst > SLOW * best else 0
        if worst < best:
            best = worst
            _copy_fit(curve, t, best_curve, best_t)
        else:
            _copy_fit(best_curve, best_t, curve, t)
            along *= 10.0
        if best <= tolerance or slow == SLOW_ROUNDS or (done == FAR_ROUND and best > FAR * tolerance):
            break
        if not _least_squares(x, y, t, along, curve, equations, n):
            break
    copy_curve(best_curve, curve)
    return best


@kernel
def fit_run(
    curves: NDArray[np.float64], first: int, last: int, tolerance: float, monotone: bool, curve: NDArray[np.float64]
) -> float:
    """Write one cubic for the consecutive pieces first..last-1; return its distance from them, infinite if they close.

    A cubic is `monotone` if its control points lie in the box of its ends.
    """
    per_piece = min(max(MOST_SAMPLES // (last - first), LEAST_PER_PIECE), MOST_PER_PIECE)
    points = np.empty(((last - first) * per_piece + 1, 2))
    count = 0
    for i in range(first, last):
        for m in range(per_piece):
            for axis in range(2):
                p0, p1, p2, p3 = curves[i, 0, axis], curves[i, 1, axis], curves[i, 2, axis], curves[i, 3, axis]
                points[count, axis] = cubic_at(p0, p1, p2, p3, m / per_piece)
            count += 1
    points[count, 0], points[count, 1] = curves[last - 1, 3, 0], curves[last - 1, 3, 1]
    if points[0, 0] == points[count, 0] and points[0, 1] == points[count, 1]:
        return np.inf
    distance = fit_cubic(points, tolerance / 2.0 if monotone else tolerance, curve)
    if monotone and distance <= tolerance:
        for axis in range(2):
            low, high = min(curve[0, axis], curve[3, axis]), max(curve[0, axis], curve[3, axis])
            for k in (1, 2):
                curve[k, axis] = min(max(curve[k, axis], low), high)
        x, y = points[:, 0].copy(), points[:, 1].copy()
        t, squares = np.empty(count + 1), np.empty(count + 1)
        chord_parameters(points, t)
        for _ in range(MEASURED):
            distance = project(x, y, t, curve, squares)
    return distance
