"""Roots of cubics in Bernstein form: parameters at which a coordinate takes a value or turns."""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.tolerance import PARAMETER

BISECTIONS = 60  # more than the 53 bits of a float64, so that the bracket always closes


@kernel(allocates=False)
def cubic_at(p0: float, p1: float, p2: float, p3: float, t: float) -> float:
    """Coordinate of a cubic at t."""
    s = 1.0 - t
    return s * s * (s * p0 + 3.0 * t * p1) + t * t * (3.0 * s * p2 + t * p3)


@kernel(allocates=False)
def velocity_at(p0: float, p1: float, p2: float, p3: float, t: float) -> float:
    """Derivative of a cubic's coordinate with respect to t."""
    s = 1.0 - t
    return 3.0 * (s * s * (p1 - p0) + 2.0 * s * t * (p2 - p1) + t * t * (p3 - p2))


@kernel(allocates=False)
def solve_monotone(p0: float, p1: float, p2: float, p3: float, value: float) -> float:
    """Parameter t in [0, 1] at which a coordinate that is monotone on [0, 1] takes a value between p0 and p3.

    Uses Newton's method inside a bracket that each step tightens; a bisection replaces a step that leaves the bracket.
    The result is exact at both ends.
    """
    if value == p0:
        return 0.0
    if value == p3:
        return 1.0
    rising = p3 > p0
    k3 = p3 - p0 + 3.0 * (p1 - p2)
    k2 = 3.0 * (p0 - 2.0 * p1 + p2)
    k1 = 3.0 * (p1 - p0)
    k0 = p0 - value
    low, high = 0.0, 1.0
    t = min(max((value - p0) / (p3 - p0), 0.0), 1.0)
    for _ in range(BISECTIONS):
        f = ((k3 * t + k2) * t + k1) * t + k0
        if (f > 0.0) == rising:
            high = t
        else:
            low = t
        slope = (3.0 * k3 * t + 2.0 * k2) * t + k1
        step = t - f / slope if slope != 0.0 else -1.0
        if not low < step < high:
            step = 0.5 * (low + high)
        if abs(step - t) <= 1e-15:
            return step
        t = step
    return t


@kernel(allocates=False)
def turning_points(p0: float, p1: float, p2: float, p3: float, out: NDArray[np.float64]) -> int:
    """Write the parameters in (0, 1) at which a coordinate turns, in ascending order; return their number (0, 1 or 2).

    The derivative's roots have the stable form ``q = -(b + sgn(b) sqrt(b^2 - 4 a c)) / 2``, ``q / a`` and ``c / q``
    (Press et al., Numerical Recipes, 5.6). At a double root the coordinate does not turn.
    """
    a = 3.0 * (p3 - p0 + 3.0 * (p1 - p2))
    b = 6.0 * (p0 - 2.0 * p1 + p2)
    c = 3.0 * (p1 - p0)
    discriminant = b * b - 4.0 * a * c
    if not discriminant > 0.0:
        return 0
    root = np.sqrt(discriminant)
    q = -0.5 * (b + (root if b >= 0.0 else -root))
    count = 0
    if a != 0.0:
        t = q / a
        if PARAMETER < t < 1.0 - PARAMETER:
            out[count] = t
            count += 1
    if q != 0.0:
        t = c / q
        if PARAMETER < t < 1.0 - PARAMETER:
            out[count] = t
            count += 1
    if count == 2 and out[0] > out[1]:
        out[0], out[1] = out[1], out[0]
    return count
