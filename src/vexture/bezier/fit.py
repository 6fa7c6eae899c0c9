"""One cubic through many points, by least squares."""

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.roots import cubic_at, velocity_at
from vexture.bezier.split import copy_curve
from vexture.kernels import kernel

__all__ = ["chord_parameters", "fit_cubic", "fit_run", "project"]

ROUNDS = 10
"""Most rounds of projection and least squares; more gain little on chains of one cell."""

SLOW, SLOW_ROUNDS = 0.9, 4
"""A fit is given up after 4 rounds that left more than this share of its distance."""

FAR, FAR_ROUND = 30.0, 3
"""A fit is given up if it is still this many tolerances away after 3 rounds: the chain needs more than one cubic."""

MOST_SAMPLES, LEAST_PER_PIECE, MOST_PER_PIECE = 96, 2, 8
"""Points of a run that a fit uses: in all, if there are few pieces, and on each piece."""

MEASURED = 4
"""Rounds of projection that measure a cubic whose control points were moved into the box of its ends."""

ALONG = 0.001
"""First weight of squared distances along the curve; tenfold after each step that made the fit worse."""


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


@kernel
def _least_squares(
    points: NDArray[np.float64], t: NDArray[np.float64], along_weight: float, curve: NDArray[np.float64]
) -> bool:
    """Move P1 and P2 so that the squared distances across the curve are least; False if undetermined.

    Distances along the curve count `along_weight` only, because projection moves the point along the curve anyway. This
    is the tangent distance minimisation of Wang, Pottmann and Liu, "Fitting B-spline curves to point clouds by
    curvature-based squared distance minimization" (ACM TOG 25, 2006). It converges many times faster than distances to
    fixed parameters.
    """
    a11, a12, a22 = np.zeros(3), np.zeros(3), np.zeros(3)  # xx, xy, yy of the blocks for P1 P1, P1 P2, P2 P2
    b = np.zeros(4)
    for i in range(1, len(points) - 1):
        s, u = 1.0 - t[i], t[i]
        w0, w1, w2, w3 = s * s * s, 3.0 * s * s * u, 3.0 * s * u * u, u * u * u
        off_x = points[i, 0] - w0 * curve[0, 0] - w1 * curve[1, 0] - w2 * curve[2, 0] - w3 * curve[3, 0]
        off_y = points[i, 1] - w0 * curve[0, 1] - w1 * curve[1, 1] - w2 * curve[2, 1] - w3 * curve[3, 1]
        dx = velocity_at(curve[0, 0], curve[1, 0], curve[2, 0], curve[3, 0], u)
        dy = velocity_at(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], u)
        square = dx * dx + dy * dy
        xx, xy, yy = 1.0, 0.0, 1.0
        if square > 0.0:  # n n^T + along_weight d d^T, with the unit tangent d and the unit normal n
            xx = (dy * dy + along_weight * dx * dx) / square
            yy = (dx * dx + along_weight * dy * dy) / square
            xy = (along_weight - 1.0) * dx * dy / square
        for k, value in enumerate((xx, xy, yy)):
            a11[k] += w1 * w1 * value
            a12[k] += w1 * w2 * value
            a22[k] += w2 * w2 * value
        rest_x, rest_y = xx * off_x + xy * off_y, xy * off_x + yy * off_y
        b[0] += w1 * rest_x
        b[1] += w1 * rest_y
        b[2] += w2 * rest_x
        b[3] += w2 * rest_y
    a = np.empty((4, 4))
    for row in range(2):
        for column in range(2):
            a[row, column] = a11[row + column]
            a[row, 2 + column] = a12[row + column]
            a[2 + row, column] = a12[row + column]
            a[2 + row, 2 + column] = a22[row + column]
    if not _solve_symmetric(a, b):
        return False
    for k in range(4):
        curve[1 + k // 2, k % 2] += b[k]
    return True


@kernel(allocates=False)
def project(points: NDArray[np.float64], t: NDArray[np.float64], curve: NDArray[np.float64]) -> float:
    """Move each parameter t, (n,), to the nearest place on the curve by a Newton step; return the largest distance.

    The first and the last point, of (n, 2), are the curve's ends and stay.
    """
    worst = 0.0
    for i in range(1, len(points) - 1):
        for step in range(2):
            u = t[i]
            numerator, denominator, square = 0.0, 0.0, 0.0
            for axis in range(2):
                p0, p1, p2, p3 = curve[0, axis], curve[1, axis], curve[2, axis], curve[3, axis]
                off = cubic_at(p0, p1, p2, p3, u) - points[i, axis]
                first = velocity_at(p0, p1, p2, p3, u)
                second = 6.0 * ((1.0 - u) * (p2 - 2.0 * p1 + p0) + u * (p3 - 2.0 * p2 + p1))
                numerator += off * first
                denominator += first * first + off * second
                square += off * off
            if step == 0 and denominator > 0.0:
                t[i] = min(max(u - numerator / denominator, 0.0), 1.0)
        worst = max(worst, square)
    return np.sqrt(worst)


@kernel(allocates=False)
def _keep(
    curve: NDArray[np.float64], t: NDArray[np.float64], kept: NDArray[np.float64], kept_t: NDArray[np.float64]
) -> None:
    """Copy a curve and its parameters."""
    copy_curve(curve, kept)
    for i in range(len(t)):
        kept_t[i] = t[i]


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
    t = np.empty(n)
    chord_parameters(points, t)
    best = np.inf
    best_curve, best_t = np.empty((4, 2)), np.empty(n)
    along = ALONG
    slow = 0
    for done in range(1, ROUNDS + 1):
        worst = project(points, t, curve)
        slow += 1 if worst > SLOW * best else 0
        if worst < best:
            best = worst
            _keep(curve, t, best_curve, best_t)
        else:
            _keep(best_curve, best_t, curve, t)
            along *= 10.0
        if best <= tolerance or slow == SLOW_ROUNDS or (done == FAR_ROUND and best > FAR * tolerance):
            break
        if not _least_squares(points, t, along, curve):
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
        t = np.empty(count + 1)
        chord_parameters(points, t)
        for _ in range(MEASURED):
            distance = project(points, t, curve)
    return distance
