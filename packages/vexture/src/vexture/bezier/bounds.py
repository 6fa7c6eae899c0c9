"""Bounding boxes of cubics."""

import numpy as np
from numpy.typing import NDArray


def bounds(cubics: NDArray[np.float64]) -> tuple[float, float, float, float]:
    """Bounding box of curves (n, 4, 2), n >= 1, not of their control points: least x and y, largest x and y."""
    p0, p1, p2, p3 = np.moveaxis(cubics, 1, 0)
    a, b, c = p3 - p0 + 3.0 * (p1 - p2), 2.0 * (p0 - 2.0 * p1 + p2), p1 - p0
    root = np.sqrt(np.maximum(b * b - 4.0 * a * c, 0.0))
    q = -0.5 * (b + np.where(b >= 0.0, root, -root))
    candidates = [p0, p3]
    for numerator, denominator in ((q, a), (c, q)):
        with np.errstate(over="ignore"):  # a root far outside [0, 1] may be infinite
            t = np.divide(numerator, denominator, out=np.zeros_like(q), where=denominator != 0.0)
        t = np.clip(t, 0.0, 1.0)
        s = 1.0 - t
        candidates.append(s * s * (s * p0 + 3.0 * t * p1) + t * t * (3.0 * s * p2 + t * p3))
    points = np.concatenate(candidates)
    (left, low), (right, high) = points.min(axis=0), points.max(axis=0)
    return float(left), float(low), float(right), float(high)
