"""Crossings of two cubics of a side of a stroke, and turns to the wrong side between them."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.bends import tangent_at
from vexture.bezier.roots import cubic_at, velocity_at

STEPS: Final = 12
"""Newton steps that find where two cubics cross."""


@kernel(allocates=False)
def _touch(a: NDArray[np.float64], b: NDArray[np.float64], slack: float) -> bool:
    """Whether the boxes of the control points of two cubics are within a distance in x and y."""
    for axis in range(2):
        if (
            min(min(a[0, axis], a[1, axis]), min(a[2, axis], a[3, axis]))
            > max(max(b[0, axis], b[1, axis]), max(b[2, axis], b[3, axis])) + slack
        ):
            return False
        if (
            min(min(b[0, axis], b[1, axis]), min(b[2, axis], b[3, axis]))
            > max(max(a[0, axis], a[1, axis]), max(a[2, axis], a[3, axis])) + slack
        ):
            return False
    return True


@kernel(allocates=False)
def _cross_at(
    a: NDArray[np.float64], b: NDArray[np.float64], t: float, u: float, side: float, slack: float
) -> tuple[float, float]:
    """Parameters at which two cubics cross, by Newton's method from t and u; -1 if it finds no turn to the side."""
    for _ in range(STEPS):
        ox = cubic_at(b[0, 0], b[1, 0], b[2, 0], b[3, 0], u) - cubic_at(a[0, 0], a[1, 0], a[2, 0], a[3, 0], t)
        oy = cubic_at(b[0, 1], b[1, 1], b[2, 1], b[3, 1], u) - cubic_at(a[0, 1], a[1, 1], a[2, 1], a[3, 1], t)
        ax, ay = velocity_at(a[0, 0], a[1, 0], a[2, 0], a[3, 0], t), velocity_at(a[0, 1], a[1, 1], a[2, 1], a[3, 1], t)
        bx, by = velocity_at(b[0, 0], b[1, 0], b[2, 0], b[3, 0], u), velocity_at(b[0, 1], b[1, 1], b[2, 1], b[3, 1], u)
        cross = ax * by - ay * bx
        if max(abs(ox), abs(oy)) <= 1e-6 * slack:
            beyond = max(max(t - 1.0, 0.0) * max(abs(ax), abs(ay)), max(-u, 0.0) * max(abs(bx), abs(by)))
            good = t > 0.0 and u < 1.0 and beyond <= slack and side * cross < 0.0
            return (t, u) if good else (-1.0, 0.0)
        if cross == 0.0:
            break
        t, u = t + (ox * by - oy * bx) / cross, u + (ox * ay - oy * ax) / cross
        if not (-0.5 < t < 1.5 and -0.5 < u < 1.5):
            break
    return -1.0, 0.0


@kernel(allocates=False)
def find_crossing(a: NDArray[np.float64], b: NDArray[np.float64], side: float, slack: float) -> tuple[float, float]:
    """Parameters at which two cubics cross, near the end of the first or in the middle; -1 if there are none.

    They turn to a side there, and miss each other by less than `slack` at most.
    """
    if not _touch(a, b, slack):
        return -1.0, 0.0
    t, u = _cross_at(a, b, 1.0, 0.0, side, slack)
    return (t, u) if t > 0.0 else _cross_at(a, b, 0.5, 0.5, side, slack)


@kernel(allocates=False)
def wrong_turns_of(cubics: NDArray[np.float64], first: int, last: int, t0: float, t1: float, side: float) -> float:
    """Sum of the sines of turns to the other side along cubics, from t0 of the first to t1 of the last."""
    px, py = tangent_at(cubics[first], t0)
    wrong = 0.0
    for i in range(first, last + 1):
        low, high = (t0 if i == first else 0.0), (t1 if i == last else 1.0)
        for k in range(3):
            x, y = tangent_at(cubics[i], high if k == 2 else low + (high - low) * (0.5 * k))
            wrong += max(side * (px * y - py * x), 0.0)
            px, py = x, y
    return wrong
