"""Points of many cubics at once, vectorised."""

import numpy as np
from numpy.typing import NDArray


def points_along(cubics: NDArray[np.float64], t: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points of every cubic at the same parameters: (n, 4, 2) and (m,) -> (n, m, 2)."""
    points: NDArray[np.float64] = np.einsum("kt,mkc->mtc", _bernstein(t), cubics)
    return points


def points_at(cubics: NDArray[np.float64], t: NDArray[np.float64]) -> NDArray[np.float64]:
    """Point of each cubic at its own parameter: (n, 4, 2) and (n,) -> (n, 2)."""
    points: NDArray[np.float64] = np.einsum("kn,nkc->nc", _bernstein(t), cubics)
    return points


def _bernstein(t: NDArray[np.float64]) -> NDArray[np.float64]:
    """Weights of the four control points, (4, n)."""
    s = 1.0 - t
    return np.stack([s**3, 3.0 * s * s * t, 3.0 * s * t * t, t**3])
