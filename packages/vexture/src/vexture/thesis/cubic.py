"""The mirror of ``shaders/cubic.glsl``: roots of a cubic by the thesis's solution paths (see `vexture.thesis.cpu`)."""

import math
from typing import NamedTuple

from vexture.base.kernels import kernel
from vexture.thesis.method import (
    CUBE_ROOT,
    DOUBLE,
    HYPERBOLIC_COSINE,
    HYPERBOLIC_SINE,
    NEARLY_EQUAL,
    NEARLY_ZERO,
    QUADRATIC,
    STRAIGHT,
    THREE,
    TRIPLE,
)


class Roots(NamedTuple):
    """Real roots: the first `found` values of `t`."""

    found: int
    t: tuple[float, float, float]


@kernel
def evaluate_cubic(a: float, b: float, c: float, d: float, t: float) -> float:
    return ((a * t + b) * t + c) * t + d


@kernel
def polish(a: float, b: float, c: float, d: float, t: float) -> float:
    for _ in range(2):
        error = evaluate_cubic(a, b, c, d, t)
        slope = (3.0 * a * t + 2.0 * b) * t + c
        closer = t - error / slope if slope != 0.0 else t
        t = closer if abs(evaluate_cubic(a, b, c, d, closer)) < abs(error) else t
    return t


@kernel
def inflection(a: float, b: float) -> float:
    return min(max(-b / (3.0 * a), -1.0), 2.0)


@kernel
def shift_cubic(a: float, b: float, c: float, d: float, shift: float) -> tuple[float, float, float]:
    return 3.0 * a * shift + b, (3.0 * a * shift + 2.0 * b) * shift + c, evaluate_cubic(a, b, c, d, shift)


@kernel
def delta_0(a: float, b: float, c: float) -> float:
    return b * b - 3.0 * a * c


@kernel
def delta_1(a: float, b: float, c: float, d: float) -> float:
    return b * (2.0 * b * b - 9.0 * a * c) + 27.0 * a * a * d


@kernel
def discriminant(a: float, b: float, c: float, d: float) -> tuple[float, float]:
    bbcc = b * b * c * c
    accc = 4.0 * a * c * c * c
    bbbd = 4.0 * b * b * b * d
    aadd = 27.0 * a * a * d * d
    abcd = 18.0 * a * b * c * d
    return bbcc - accc - bbbd - aadd + abcd, bbcc + abs(accc) + abs(bbbd) + aadd + abs(abcd)


@kernel
def solution_path(a: float, b: float, c: float, d: float) -> int:
    """Solution path (thesis, Figure 3.5) for a t^3 + b t^2 + c t + d; the numbers are in `vexture.thesis.method`."""
    size = max(abs(a), abs(b), abs(c))
    if max(abs(a), abs(b)) <= NEARLY_ZERO * size:
        return STRAIGHT
    if abs(a) <= NEARLY_ZERO * abs(b):
        return QUADRATIC
    b, c, d = shift_cubic(a, b, c, d, inflection(a, b))
    delta = delta_0(a, b, c)
    if abs(delta) <= NEARLY_EQUAL * abs(a) * size:
        return TRIPLE if abs(delta_1(a, b, c, d)) <= 27.0 * NEARLY_EQUAL * a * a * size else CUBE_ROOT
    value, terms = discriminant(a, b, c, d)
    if abs(value) <= NEARLY_EQUAL * terms:
        return DOUBLE
    if value > 0.0:
        return THREE
    return HYPERBOLIC_SINE if delta < 0.0 else HYPERBOLIC_COSINE


@kernel
def solve_quadratic(a: float, b: float, c: float) -> Roots:
    square = b * b - 4.0 * a * c
    if square < 0.0:
        return Roots(0, (0.0, 0.0, 0.0))
    q = -0.5 * (b + (-math.sqrt(square) if b < 0.0 else math.sqrt(square)))
    return Roots(2, (q / a if a != 0.0 else 0.0, c / q if q != 0.0 else 0.0, 0.0))


@kernel
def solve_single(path: int, a: float, b: float, c: float, d: float) -> float:
    center = -b / (3.0 * a)
    p = -delta_0(a, b, c) / (3.0 * a * a)
    q = delta_1(a, b, c, d) / (27.0 * a * a * a)
    if path == TRIPLE:
        return center
    if path == DOUBLE:
        return (4.0 * a * b * c - 9.0 * a * a * d - b * b * b) / (a * delta_0(a, b, c))
    if path == CUBE_ROOT:
        return center - math.copysign(abs(q) ** (1.0 / 3.0), q)
    if path == HYPERBOLIC_SINE:
        return center - 2.0 * math.sqrt(p / 3.0) * math.sinh(math.asinh(1.5 * q / p * math.sqrt(3.0 / p)) / 3.0)
    ratio = max(-1.5 * abs(q) / p * math.sqrt(-3.0 / p), 1.0)
    return center - 2.0 * math.copysign(math.sqrt(-p / 3.0), q) * math.cosh(math.acosh(ratio) / 3.0)


@kernel
def solve_three(a: float, b: float, c: float, d: float) -> Roots:
    p = -delta_0(a, b, c) / (3.0 * a * a)
    q = delta_1(a, b, c, d) / (27.0 * a * a * a)
    side = -1.0 if a * b > 0.0 else 1.0
    angle = math.atan2(math.sqrt(discriminant(a, b, c, d)[0] / 27.0) / (a * a), -side * q)
    far = polish(a, b, c, d, -b / (3.0 * a) + side * 2.0 * math.sqrt(-p / 3.0) * math.cos(angle / 3.0))
    c2 = -d / far
    b2 = (c2 - c) / far
    rest = solve_quadratic(b - b2, c - c2, d)
    return Roots(1 + rest.found, (far, rest.t[0], rest.t[1]))


@kernel
def solve_cubic(a: float, b: float, c: float, d: float) -> Roots:
    """Find the real roots of a t^3 + b t^2 + c t + d that may lie in 0..1, except double roots.

    The coefficients belong to x(t) - C.x in the basis of a curve's chord, where a + b + c is 1.

    Examples
    --------
    >>> found, t = solve_cubic(0.0, 0.0, 1.0, -0.25)
    >>> found, t[0]
    (1, 0.25)
    """
    path = solution_path(a, b, c, d)
    shift = 0.0
    if path > QUADRATIC:
        shift = inflection(a, b)
        b, c, d = shift_cubic(a, b, c, d, shift)
    if path == STRAIGHT:
        roots = Roots(1, (-d / c, 0.0, 0.0))
    elif path == QUADRATIC:
        roots = solve_quadratic(b + 1.5 * a, c - 0.5 * a, d)
    elif path == THREE:
        roots = solve_three(a, b, c, d)
    else:
        roots = Roots(1, (solve_single(path, a, b, c, d), 0.0, 0.0))
    return Roots(
        roots.found,
        (
            shift + polish(a, b, c, d, roots.t[0]),
            shift + polish(a, b, c, d, roots.t[1]),
            shift + polish(a, b, c, d, roots.t[2]),
        ),
    )
