"""Convert other curves to cubics: lines exactly, circular arcs within a tolerance.

A cubic with handles of length ``4/3 tan(angle/4) r`` touches its circle at both ends and in the middle. Elsewhere it
lies outside the circle, for a quarter turn by at most `QUARTER_ERROR` r. The error is proportional to the sixth power
of the angle (Goldapp, "Approximation of circular arcs by cubic polynomials", CAGD 8, 1991).
"""

from math import acos, atan2, ceil, cos, hypot, pi, radians, sin, sqrt, tan

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.trigonometry import FINEST, QUARTER_ERROR

FLAT = 1e-7
"""Ratio of half the chord to the radius. A short arc below it becomes a line, with an error of 1e-7 of its length."""

STRAIGHT = 1e-12
"""Relative. A cubic is a rounded line if its inner control points are this close to the thirds of its chord."""

Step = tuple[float, float, float, float, float, float]
"""P1, P2 and P3 of a cubic that starts at the end of the previous cubic."""


def line_cubics(start: NDArray[np.float64], end: NDArray[np.float64]) -> NDArray[np.float64]:
    """Straight lines as cubics (..., 4, 2), from ends (..., 2); inner control points are at one and two thirds."""
    cubics = np.empty((*np.broadcast_shapes(start.shape, end.shape)[:-1], 4, 2))
    write_lines(start, end, cubics)
    return cubics


def write_lines(start: NDArray[np.float64], end: NDArray[np.float64], cubics: NDArray[np.float64]) -> None:
    """Write the cubics of `line_cubics`, one coordinate at a time because NumPy is slow with rows of two."""
    for axis in range(2):
        first, last = start[..., axis], end[..., axis]
        chord = last - first
        cubics[..., 0, axis], cubics[..., 3, axis] = first, last
        np.add(first, chord / 3.0, out=cubics[..., 1, axis])
        np.add(first, chord * (2.0 / 3.0), out=cubics[..., 2, axis])


def straight(cubics: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which cubics (n, 4, 2) are lines as `line_cubics` makes them; (n,)."""
    ideal = line_cubics(cubics[..., 0, :], cubics[..., 3, :])
    scale = np.abs(cubics).max(axis=(-2, -1))
    near: NDArray[np.bool_] = np.abs(cubics - ideal).max(axis=(-2, -1)) <= STRAIGHT * scale
    return near


def turn_steps(angle: float, radius: float, tolerance: float) -> int:
    """Number of equal cubics that follow an arc of `angle` radians within the tolerance."""
    quarter = 1.0 if radius == 0.0 else min(1.0, (tolerance / (QUARTER_ERROR * radius)) ** (1 / 6))
    return max(1, ceil(abs(angle) / (pi / 2 * max(quarter, FINEST)) - 1e-9))


def turn_cubics(
    center: tuple[float, float], u: tuple[float, float], v: tuple[float, float], start: float, angle: float, steps: int
) -> list[Step]:
    """Equal cubics along ``center + u cos a + v sin a`` for a from `start` to `start + angle`, in radians."""
    step = angle / steps
    handle = 4 / 3 * tan(step / 4)
    found = []
    c0, s0 = cos(start), sin(start)
    for k in range(1, steps + 1):
        c1, s1 = cos(start + k * step), sin(start + k * step)
        a1, b1, a2, b2 = c0 - handle * s0, s0 + handle * c0, c1 + handle * s1, s1 - handle * c1
        found.append(
            (
                center[0] + u[0] * a1 + v[0] * b1,
                center[1] + u[1] * a1 + v[1] * b1,
                center[0] + u[0] * a2 + v[0] * b2,
                center[1] + u[1] * a2 + v[1] * b2,
                center[0] + u[0] * c1 + v[0] * s1,
                center[1] + u[1] * c1 + v[1] * s1,
            )
        )
        c0, s0 = c1, s1
    return found


def arc_cubics(
    start: tuple[float, float],
    radii: tuple[float, float],
    rotation: float,
    large: bool,
    sweep: bool,
    end: tuple[float, float],
    tolerance: float,
) -> list[Step]:
    """Cubics of an elliptical arc between two points (SVG 2, B.2.4 and B.2.5); none from a point to itself.

    `rotation` is the angle of the first axis in degrees; `large` and `sweep` choose one of the four arcs. As the
    standard demands, radii that are too small to join the points are enlarged, and a radius of zero gives a straight
    line. `tolerance` is the largest distance from the true arc.
    """
    rx, ry = abs(radii[0]), abs(radii[1])
    (x0, y0), (x3, y3) = start, end
    if start == end:
        return []
    line = [(x0 + (x3 - x0) / 3, y0 + (y3 - y0) / 3, x3 + (x0 - x3) / 3, y3 + (y0 - y3) / 3, x3, y3)]
    if rx == 0.0 or ry == 0.0:
        return line
    turn = radians(rotation)
    c, s = cos(turn), sin(turn)
    # p is half the chord, q the centre relative to its middle, in the frame where the ellipse is the unit circle
    hx, hy = (x0 - x3) / 2.0, (y0 - y3) / 2.0
    px, py = (c * hx + s * hy) / rx, (c * hy - s * hx) / ry
    length = hypot(px, py)
    if length == 0.0 or (length < FLAT and not large):
        return line
    if length > 1.0:
        rx, ry, px, py = rx * length, ry * length, px / length, py / length
        length = 1.0
    height = sqrt((1.0 - length) * (1.0 + length)) / length * (1.0 if large != sweep else -1.0)
    qx, qy = height * py, -height * px
    u, v = (c * rx, s * rx), (-s * ry, c * ry)
    center = ((x0 + x3) / 2.0 + u[0] * qx + v[0] * qy, (y0 + y3) / 2.0 + u[1] * qx + v[1] * qy)
    first = atan2(py - qy, px - qx)
    angle = atan2(-py - qy, -px - qx) - first
    if sweep != (angle > 0.0) or angle == 0.0:  # zero: almost a whole turn that rounding closed
        angle += 2.0 * pi if sweep else -2.0 * pi
    found = turn_cubics(center, u, v, first, angle, turn_steps(angle, max(rx, ry), tolerance))
    found[-1] = (*found[-1][:4], x3, y3)
    return found


def ellipse_cubics(center: tuple[float, float], radii: tuple[float, float], tolerance: float) -> NDArray[np.float64]:
    """Ellipse within a tolerance as a closed contour (n, 4, 2), from its rightmost point towards +y."""
    steps = turn_steps(2.0 * pi, max(radii), tolerance)
    steps += -steps % 4  # cubics end exactly where the ellipse turns
    quarter = turn_cubics((0.0, 0.0), (1.0, 0.0), (0.0, 1.0), 0.0, pi / 2, steps // 4)
    quarter[-1] = (*quarter[-1][:2], quarter[-1][2], 1.0, 0.0, 1.0)
    ends = np.array([(1.0, 0.0)] + [step[4:] for step in quarter])
    inner = np.array([step[:4] for step in quarter]).reshape(-1, 2, 2)
    first = np.concatenate([ends[:-1, None], inner, ends[1:, None]], axis=1)
    second = np.stack([-first[..., 1], first[..., 0]], axis=-1)
    unit = np.concatenate([first, second, -first, -second])
    return unit * np.array(radii, dtype=np.float64) + np.array(center, dtype=np.float64)


def conic_cubics(p0: complex, p1: complex, p2: complex, weight: float, tolerance: float) -> list[complex]:
    """Cubics of a circular arc that is a rational quadratic with the weight cos(half its angle).

    The result lists P1, P2 and P3 of each cubic. Points are complex numbers. The arc is halved as in Farin, "Curves and
    Surfaces for CAGD", 13.
    """
    half = acos(min(max(weight, -1.0), 1.0))
    radius = abs(p1 - p0) / tan(half) if half > 0.0 else 0.0
    if turn_steps(2.0 * half, radius, tolerance) == 1:
        handle = 4.0 * weight / (3.0 * (1.0 + weight))
        return [p0 + (p1 - p0) * handle, p2 + (p1 - p2) * handle, p2]
    a = (p0 + weight * p1) / (1.0 + weight)
    b = (weight * p1 + p2) / (1.0 + weight)
    middle = (a + b) / 2.0
    weight = sqrt((1.0 + weight) / 2.0)
    return conic_cubics(p0, a, middle, weight, tolerance) + conic_cubics(middle, b, p2, weight, tolerance)
