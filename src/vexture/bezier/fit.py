"""One cubic through many points, by least squares."""

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.roots import cubic_at
from vexture.bezier.split import copy_curve
from vexture.kernels import kernel

__all__ = ["fit_cubic"]

ROUNDS = 10
"""Projection and least squares alternate at most so often; more rounds gain little on chains of one cell."""

HOPEFUL_ROUNDS, HOPELESS = 3, 20.0
"""A fit that is still so many tolerances away after so many rounds is given up."""

ALONG = 0.001
"""First weight of squared distances along the curve, tenfold after each step that made it worse."""


@kernel
def _chord_parameters(points: NDArray[np.float64], t: NDArray[np.float64]) -> None:
    """Write each point's share of the polyline's length."""
    t[0] = 0.0
    for i in range(1, len(points)):
        t[i] = t[i - 1] + np.hypot(points[i, 0] - points[i - 1, 0], points[i, 1] - points[i - 1, 1])
    total = t[-1]
    for i in range(len(points)):
        t[i] = t[i] / total if total > 0.0 else 0.0


@kernel
def _solve_symmetric(a: NDArray[np.float64], b: NDArray[np.float64]) -> bool:
    """Overwrite b, (n,), by the solution of a x = b for a positive definite (n, n); False if it is not."""
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
    """Move P1 and P2 so that the squares of the distances across the curve are least; False if undetermined.

    Across the curve a distance counts whole, along it `along_weight`: there the point will slide anyway. This is the
    tangent distance minimisation of Wang, Pottmann and Liu, "Fitting B-spline curves to point clouds by
    curvature-based squared distance minimization" (ACM TOG 25, 2006); it converges many times faster than
    distances to fixed parameters.
    """
    a, b = np.zeros((4, 4)), np.zeros(4)
    jacobian, off, tangent = np.zeros(4), np.empty(2), np.empty(2)
    for i in range(1, len(points) - 1):
        s, u = 1.0 - t[i], t[i]
        for axis in range(2):
            p0, p1, p2, p3 = curve[0, axis], curve[1, axis], curve[2, axis], curve[3, axis]
            off[axis] = points[i, axis] - cubic_at(p0, p1, p2, p3, u)
            tangent[axis] = s * s * (p1 - p0) + 2.0 * s * u * (p2 - p1) + u * u * (p3 - p2)
        length = np.hypot(tangent[0], tangent[1])
        w1, w2 = 3.0 * s * s * u, 3.0 * s * u * u
        for along in range(2):
            weight = along_weight if along == 1 else 1.0
            if length > 0.0:
                dx = tangent[0] / length if along == 1 else -tangent[1] / length
                dy = tangent[1] / length if along == 1 else tangent[0] / length
            else:
                dx, dy, weight = float(along), float(1 - along), 1.0
            jacobian[0], jacobian[1], jacobian[2], jacobian[3] = w1 * dx, w1 * dy, w2 * dx, w2 * dy
            rest = dx * off[0] + dy * off[1]
            for k in range(4):
                b[k] += weight * jacobian[k] * rest
                for m in range(4):
                    a[k, m] += weight * jacobian[k] * jacobian[m]
    if not _solve_symmetric(a, b):
        return False
    for k in range(4):
        curve[1 + k // 2, k % 2] += b[k]
    return True


@kernel
def _project(points: NDArray[np.float64], t: NDArray[np.float64], curve: NDArray[np.float64]) -> float:
    """Move each t to the nearest place on the curve by a Newton step; return the largest distance."""
    worst = 0.0
    for i in range(len(points)):
        for _ in range(2):
            s, u = 1.0 - t[i], t[i]
            numerator, denominator, square = 0.0, 0.0, 0.0
            for axis in range(2):
                p0, p1, p2, p3 = curve[0, axis], curve[1, axis], curve[2, axis], curve[3, axis]
                off = cubic_at(p0, p1, p2, p3, u) - points[i, axis]
                first = 3.0 * (s * s * (p1 - p0) + 2.0 * s * u * (p2 - p1) + u * u * (p3 - p2))
                second = 6.0 * (s * (p2 - 2.0 * p1 + p0) + u * (p3 - 2.0 * p2 + p1))
                numerator += off * first
                denominator += first * first + off * second
                square += off * off
            if denominator > 0.0 and 0 < i < len(points) - 1:
                t[i] = min(max(u - numerator / denominator, 0.0), 1.0)
        worst = max(worst, square)
    return np.sqrt(worst)


@kernel
def _keep(
    curve: NDArray[np.float64], t: NDArray[np.float64], kept: NDArray[np.float64], kept_t: NDArray[np.float64]
) -> None:
    """Copy a curve and its parameters."""
    copy_curve(curve, kept)
    for i in range(len(t)):
        kept_t[i] = t[i]


@kernel
def fit_cubic(points: NDArray[np.float64], tolerance: float, curve: NDArray[np.float64]) -> float:
    """Cubic from the first to the last of a chain of points, nearest to all of them.

    P. J. Schneider, "An algorithm for automatically fitting digitized curves" (Graphics Gems, 1990), with both inner
    control points free: the ends' tangents are not prescribed.

    Parameters
    ----------
    points : (n, 2) float64 array
        In order, n >= 2.
    tolerance : float
        Distance at which it is good enough, in the units of the points.
    curve : (4, 2) float64 array
        Written.

    Returns
    -------
    float
        The largest distance of a point from the curve.

    Examples
    --------
    >>> curve = np.empty((4, 2))
    >>> t = np.linspace(0.0, 1.0, 9)
    >>> bool(fit_cubic(np.column_stack((t, t * t)), 1e-6, curve) < 1e-3)
    True
    """
    n = len(points)
    for k in range(4):
        for axis in range(2):
            curve[k, axis] = points[0, axis] + (points[n - 1, axis] - points[0, axis]) * (k / 3.0)
    t = np.empty(n)
    _chord_parameters(points, t)
    best = np.inf
    best_curve, best_t = np.empty((4, 2)), np.empty(n)
    along = ALONG
    for done in range(ROUNDS):
        worst = _project(points, t, curve)
        if worst < best:
            best = worst
            _keep(curve, t, best_curve, best_t)
        else:
            _keep(best_curve, best_t, curve, t)
            along *= 10.0
        if best <= tolerance or (done == HOPEFUL_ROUNDS and best > HOPELESS * tolerance):
            break
        if not _least_squares(points, t, along, curve):
            break
    copy_curve(best_curve, curve)
    return best
