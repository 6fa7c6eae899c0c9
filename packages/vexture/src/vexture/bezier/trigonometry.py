"""Functions of angles as kernels, of +, -, *, / and square roots alone.

The C libraries of platforms, and the engines of browsers, differ in the last bit of sines and powers. These functions
have the same bits wherever they run. Polynomials and their coefficients are those of fdlibm (Sun Microsystems, 1993),
whose errors are below one unit in the last place.
"""

from typing import Final

import numpy as np

from vexture.base.kernels import kernel

HALF_PI: Final = 1.5707963267948966
HALF_PI_REST: Final = 6.123233995736766e-17
"""Half of pi as the sum of two numbers."""

COARSE_HALF_PI: Final = 1.57079632673412561417
COARSE_REST: Final = 6.07710050650619224932e-11
"""The same, with so few bits in the first number that its small multiples are exact."""

SPLITTER: Final = 134217729.0
"""2^27 + 1, which splits a number into halves of 26 bits (Dekker, 1971)."""

QUARTER_ERROR: Final = 2.7253e-4
"""Largest distance between a cubic and a quarter of the unit circle."""

FINEST: Final = 1e-3
"""Shortest cubic, as a part of a quarter turn; it limits huge circles to 4,000 cubics per turn."""


@kernel(allocates=False)
def _sine_near_zero(x: float, rest: float) -> float:
    """Sine of x + rest, for x within an eighth of a turn of 0."""
    z = x * x
    r = 8.33333333332248946124e-03 + z * (
        -1.98412698298579493134e-04
        + z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10))
    )
    v = z * x
    return x - ((z * (0.5 * rest - v * r) - rest) - v * -1.66666666666666324348e-01)


@kernel(allocates=False)
def _cosine_near_zero(x: float, rest: float) -> float:
    """Cosine of x + rest, for x within an eighth of a turn of 0."""
    z = x * x
    w = z * z
    r = z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * 2.48015872894767294178e-05))
    r += w * w * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11))
    half = 0.5 * z
    w = 1.0 - half
    return w + (((1.0 - w) - half) + (z * r - x * rest))


@kernel(allocates=False)
def direction_at(angle: float) -> tuple[float, float]:
    """Cosine and sine of an angle in radians, within a turn of 0.

    Examples
    --------
    >>> direction_at(0.0), round(direction_at(1.0)[1], 15)
    ((1.0, 0.0), 0.841470984807897)
    """
    n = np.rint(angle / HALF_PI)
    r = angle - n * COARSE_HALF_PI
    w = n * COARSE_REST
    x = r - w
    rest = (r - x) - w
    cosine, sine = _cosine_near_zero(x, rest), _sine_near_zero(x, rest)
    quarter = int(n) & 3
    if quarter == 0:
        return cosine, sine
    if quarter == 1:
        return -sine, cosine
    if quarter == 2:
        return -cosine, -sine
    return sine, -cosine


@kernel(allocates=False)
def angle_of_cosine(x: float) -> float:
    """Angle from 0 to pi, in radians, with a cosine.

    Examples
    --------
    >>> round(angle_of_cosine(0.5), 15), round(angle_of_cosine(-1.0), 15)
    (1.047197551196598, 3.141592653589793)
    """
    z = x * x if abs(x) < 0.5 else 0.5 * (1.0 - abs(x))
    p = 2.01212532134862925881e-01 + z * (
        -4.00555345006794114027e-02 + z * (7.91534994289814532176e-04 + z * 3.47933107596021167570e-05)
    )
    p = z * (1.66666666666666657415e-01 + z * (-3.25565818622400915405e-01 + z * p))
    q = 2.02094576023350569471e00 + z * (-6.88283971605453293030e-01 + z * 7.70381505559019352791e-02)
    r = p / (1.0 + z * (-2.40339491173441421878e00 + z * q))
    if abs(x) < 0.5:
        return HALF_PI - (x - (HALF_PI_REST - x * r))
    s = np.sqrt(z)
    if x < 0.0:
        return 2.0 * (HALF_PI - (s + (r * s - HALF_PI_REST)))
    if s == 0.0:
        return 0.0
    wide = SPLITTER * s
    high = wide - (wide - s)
    return 2.0 * (high + (r * s + (z - high * high) / (s + high)))


@kernel(allocates=False)
def count_of_turn(angle: float, radius: float, tolerance: float) -> int:
    """Number of equal cubics that follow an arc of `angle` radians within the tolerance.

    Examples
    --------
    >>> count_of_turn(6.283185307179586, 1.0, 1e-3), count_of_turn(6.283185307179586, 1.0, 1e-8)
    (4, 22)
    """
    share = min(1.0, tolerance / (QUARTER_ERROR * radius)) if radius != 0.0 else 1.0
    square_root, root = np.sqrt(share), 1.0
    for _ in range(64):  # Newton's method for the cube root, from above
        root = (2.0 * root + square_root / (root * root)) / 3.0 if root > FINEST else root
    return max(1, int(np.ceil(abs(angle) / (HALF_PI * max(root, FINEST)) - 1e-9)))
