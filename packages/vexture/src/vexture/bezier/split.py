"""Cut cubics by de Casteljau's algorithm."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel


@kernel(allocates=False)
def copy_curve(source: NDArray[Any], target: NDArray[Any]) -> None:
    """Copy a cubic (4, 2) number by number, because Numba takes a second to compile an assignment of slices."""
    for k in range(4):
        target[k, 0] = source[k, 0]
        target[k, 1] = source[k, 1]


@kernel(allocates=False)
def split(curve: NDArray[np.float64], t: float, left: NDArray[np.float64], right: NDArray[np.float64]) -> None:
    """Write the parts of a cubic before and after t, (4, 2) each; their common point is equal bit for bit.

    `left` or `right` may be `curve` itself.
    """
    for axis in range(2):
        p0, p1, p2, p3 = curve[0, axis], curve[1, axis], curve[2, axis], curve[3, axis]
        a = p0 + (p1 - p0) * t
        b = p1 + (p2 - p1) * t
        c = p2 + (p3 - p2) * t
        d = a + (b - a) * t
        e = b + (c - b) * t
        f = d + (e - d) * t
        left[0, axis], left[1, axis], left[2, axis], left[3, axis] = p0, a, d, f
        right[0, axis], right[1, axis], right[2, axis], right[3, axis] = f, e, c, p3


@kernel(allocates=False)
def subcubic(curve: NDArray[np.float64], t0: float, t1: float, out: NDArray[np.float64]) -> None:
    """Write the part (4, 2) of a cubic from t0 to t1, reversed if t0 > t1 (blossoming)."""
    s0, s1 = 1.0 - t0, 1.0 - t1
    for axis in range(2):
        p0, p1, p2, p3 = curve[0, axis], curve[1, axis], curve[2, axis], curve[3, axis]
        # polar form: the first de Casteljau level at t0 or t1, further levels mixed
        a0, b0, c0 = s0 * p0 + t0 * p1, s0 * p1 + t0 * p2, s0 * p2 + t0 * p3
        a1, b1, c1 = s1 * p0 + t1 * p1, s1 * p1 + t1 * p2, s1 * p2 + t1 * p3
        d00, e00 = s0 * a0 + t0 * b0, s0 * b0 + t0 * c0
        d11, e11 = s1 * a1 + t1 * b1, s1 * b1 + t1 * c1
        out[0, axis] = s0 * d00 + t0 * e00
        out[1, axis] = s1 * d00 + t1 * e00
        out[2, axis] = s0 * d11 + t0 * e11
        out[3, axis] = s1 * d11 + t1 * e11
