"""Points of many cubics at once, by vectorised NumPy code."""

import numpy as np
from numpy.typing import NDArray


def points_along(cubics: NDArray[np.float64], t: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points (n, m, 2) of each cubic (n, 4, 2) at the same parameters (m,)."""
    points: NDArray[np.float64] = np.einsum("kt,mkc->mtc", _bernstein(t), cubics)
    return points


def points_at(cubics: NDArray[np.float64], t: NDArray[np.float64]) -> NDArray[np.float64]:
    """Point (n, 2) of each cubic (n, 4, 2) at its own parameter (n,)."""
    points: NDArray[np.float64] = np.einsum("kn,nkc->nc", _bernstein(t), cubics)
    return points


def _bernstein(t: NDArray[np.float64]) -> NDArray[np.float64]:
    """Bernstein weights of the four control points, (4, n)."""
    s = 1.0 - t
    return np.stack([s**3, 3.0 * s * s * t, 3.0 * s * t * t, t**3])
