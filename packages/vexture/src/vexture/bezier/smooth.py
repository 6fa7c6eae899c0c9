"""Smoothing a closed chain of points, each of which stays within a distance of its place."""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel

ROUNDS = 14
"""Most rounds; each gives more weight to the samples that smoothing moved too far."""

OVERLAP = 64
"""Samples by which the chain is continued beyond its ends: farther than bending reaches."""


@kernel
def _smooth(
    points: NDArray[np.float64], weight: NDArray[np.float64], bending: NDArray[np.float64], out: NDArray[np.float64]
) -> None:
    """Write the closed chain that is near to the points and bends little: banded least squares by L D L^T."""
    n = len(points)
    m = n + 2 * OVERLAP
    a0, a1, a2 = np.zeros(m), np.zeros(m), np.zeros(m)
    b = np.zeros((m, 2))
    for i in range(m):
        k = (i - OVERLAP) % n
        a0[i] += weight[k]
        b[i, 0], b[i, 1] = weight[k] * points[k, 0], weight[k] * points[k, 1]
        if 0 < i < m - 1:
            bend = bending[k]
            a0[i - 1] += bend
            a0[i] += 4.0 * bend
            a0[i + 1] += bend
            a1[i] -= 2.0 * bend  # row i, column i - 1
            a1[i + 1] -= 2.0 * bend
            a2[i + 1] += bend
    for i in range(m):
        if i > 1:
            a2[i] /= a0[i - 2]
            a1[i] -= a2[i] * a0[i - 2] * a1[i - 1]
        if i > 0:
            a1[i] /= a0[i - 1]
            a0[i] -= a1[i] * a1[i] * a0[i - 1]
        if i > 1:
            a0[i] -= a2[i] * a2[i] * a0[i - 2]
        for axis in range(2):
            if i > 0:
                b[i, axis] -= a1[i] * b[i - 1, axis]
            if i > 1:
                b[i, axis] -= a2[i] * b[i - 2, axis]
    for i in range(m - 1, -1, -1):
        for axis in range(2):
            b[i, axis] /= a0[i]
            if i < m - 1:
                b[i, axis] -= a1[i + 1] * b[i + 1, axis]
            if i < m - 2:
                b[i, axis] -= a2[i + 2] * b[i + 2, axis]
    for k in range(n):
        out[k, 0], out[k, 1] = b[k + OVERLAP, 0], b[k + OVERLAP, 1]


@kernel
def smooth_chain(
    points: NDArray[np.float64],
    corner: NDArray[np.bool_],
    bending: NDArray[np.float64],
    reach: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Closed chain of samples (n, 2) that bends little; each sample stays within its `reach` (n,) of its place.

    Samples where `corner` (n,) is True do not move, and the chain may bend there. `bending` (n,) weighs bending
    elsewhere.
    """
    n = len(points)
    weight, bend = np.ones(n), bending.copy()
    for i in range(n):
        if corner[i]:
            weight[i], bend[i] = 1e9, 0.0
    out = np.empty((n, 2))
    for _ in range(ROUNDS):
        _smooth(points, weight, bend, out)
        moved = False
        for i in range(n):
            far = np.hypot(out[i, 0] - points[i, 0], out[i, 1] - points[i, 1]) / reach[i]
            if far > 1.0:
                weight[i] *= min(far * far, 16.0)
                moved = True
        if not moved:
            break
    for i in range(n):
        far = np.hypot(out[i, 0] - points[i, 0], out[i, 1] - points[i, 1])
        share = 0.0 if corner[i] else min(1.0, reach[i] / far) if far > 0.0 else 1.0
        for axis in range(2):
            out[i, axis] = points[i, axis] + share * (out[i, axis] - points[i, axis])
    return out
