"""Contours of the regions that separate the bands of a gradient, in a box of the unit square."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.tolerance import CLOSED
from vexture.bezier.clip import clip_to_box, hold_ends
from vexture.bezier.trigonometry import HALF_PI, angle_of_cosine, count_of_turn, direction_at
from vexture.tree.planar.ramps import CONE, scale_of_ramp
from vexture.tree.planar.shades import FOCUS, RADIUS

ROUND: Final = 1e-8
"""Largest distance of a cubic from its arc, in unit-square units."""


@kernel
def region_of(
    row: NDArray[np.float64], shape: int, place: float, box: NDArray[np.float64], reach: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Contour of the part of a box that is beyond a place on a linear ramp, or before a place on a radial one.

    `reach` (1,) becomes the largest coordinate that was clipped, if that is larger.
    """
    focus, radius = row[FOCUS], row[RADIUS]
    if focus < 0.0:
        return _beyond(row[0], row[1], place - row[2], box)
    middle, size = focus * (1.0 - place), radius + (1.0 - radius) * place
    if size <= 0.0:
        return np.zeros((0, 4, 2))
    tolerance = ROUND * scale_of_ramp(row)[1]
    if shape != CONE:
        return _from_ramp(row, _circle(middle, size, tolerance), box, reach)
    return _from_ramp(row, _tip(focus, radius, middle, size, tolerance), box, reach)


@kernel
def _circle(middle: float, size: float, tolerance: float) -> NDArray[np.float64]:
    """Circle within a tolerance, from its rightmost point towards +y."""
    quarter = (count_of_turn(4.0 * HALF_PI, size, tolerance) + 3) // 4  # cubics end exactly where the circle turns
    step = HALF_PI / quarter
    cosine, sine = direction_at(step / 4.0)
    handle = 4.0 / 3.0 * (sine / cosine)
    out = np.empty((4 * quarter, 4, 2))
    for k in range(quarter):
        c0, s0 = direction_at(k * step)
        c1, s1 = direction_at((k + 1) * step)
        arc = out[k]
        arc[0, 0], arc[0, 1] = c0, s0
        arc[1, 0], arc[1, 1] = c0 - handle * s0, s0 + handle * c0
        arc[2, 0], arc[2, 1] = c1 + handle * s1, s1 - handle * c1
        arc[3, 0], arc[3, 1] = (0.0, 1.0) if k == quarter - 1 else (c1, s1)
    for k in range(quarter, 4 * quarter):
        for p in range(4):
            out[k, p, 0], out[k, p, 1] = -out[k - quarter, p, 1], out[k - quarter, p, 0]
    _place(out, middle, size)
    return out


@kernel(allocates=False)
def _place(contour: NDArray[np.float64], middle: float, size: float) -> None:
    """Move parts of the unit circle to a circle around (middle, 0)."""
    for k in range(len(contour)):
        for p in range(4):
            contour[k, p, 0], contour[k, p, 1] = contour[k, p, 0] * size + middle, contour[k, p, 1] * size


@kernel
def _tip(focus: float, radius: float, middle: float, size: float, tolerance: float) -> NDArray[np.float64]:
    """Places before one in a cone: the part between its tip and the arc of the circle that faces it."""
    turn = angle_of_cosine((1.0 - radius) / focus)
    steps = count_of_turn(2.0 * turn, size, tolerance)
    cosine, sine = direction_at(turn / (2.0 * steps))
    handle = 4.0 / 3.0 * (sine / cosine)
    width = 2.0 * turn / steps
    out = np.empty((steps + 2, 4, 2))
    c0, s0 = direction_at(-turn)
    for k in range(steps):
        c1, s1 = direction_at(turn if k == steps - 1 else (k + 1) * width - turn)
        arc = out[k]
        arc[0, 0], arc[0, 1] = c0, s0
        arc[1, 0], arc[1, 1] = c0 - handle * s0, s0 + handle * c0
        arc[2, 0], arc[2, 1] = c1 + handle * s1, s1 - handle * c1
        arc[3, 0], arc[3, 1] = c1, s1
        c0, s0 = c1, s1
    _place(out[:steps], middle, size)
    tip = focus / (1.0 - radius)
    _line(out[steps], out[steps - 1, 3, 0], out[steps - 1, 3, 1], tip, 0.0)
    _line(out[steps + 1], tip, 0.0, out[0, 0, 0], out[0, 0, 1])
    return out


@kernel(allocates=False)
def _line(curve: NDArray[np.float64], x: float, y: float, to_x: float, to_y: float) -> None:
    """Write a straight line as `vexture.bezier.convert.line_cubics` does."""
    curve[0, 0], curve[0, 1], curve[3, 0], curve[3, 1] = x, y, to_x, to_y
    for axis in range(2):
        chord = curve[3, axis] - curve[0, axis]
        curve[1, axis], curve[2, axis] = curve[0, axis] + chord / 3.0, curve[0, axis] + chord * (2.0 / 3.0)


@kernel
def _polygon(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Closed contour with straight sides through points (n, 2)."""
    out = np.empty((len(points), 4, 2))
    for k in range(len(points)):
        following = k + 1 if k + 1 < len(points) else 0
        _line(out[k], points[k, 0], points[k, 1], points[following, 0], points[following, 1])
    return out


@kernel
def swept_region(row: NDArray[np.float64], box: NDArray[np.float64], reach: NDArray[np.float64]) -> NDArray[np.float64]:
    """Part of a box that the circles sweep: a half-plane if they touch, a strip if they are equal, else a cone."""
    focus, radius = row[FOCUS], row[RADIUS]
    grows = 1.0 - radius
    sine = min(abs(grows) / focus, 1.0)
    tip, far = focus / grows if grows != 0.0 else 0.0, 0.0
    for corner in range(4):
        x, y = box[corner >> 1, 0], box[corner & 1, 1]
        u, v = row[0] * x + row[1] * y + row[2], row[3] * x + row[4] * y + row[5]
        far = max(far, abs(u - tip), abs(v))
    far *= 4.0
    if grows == 0.0:
        strip = np.empty((4, 2))
        for k in range(4):
            strip[k, 0], strip[k, 1] = far if k == 1 or k == 2 else -far, 1.0 if k < 2 else -1.0
        return _from_ramp(row, _polygon(strip), box, reach)
    away = -far if grows > 0.0 else far  # the circles are larger there
    along, up = np.sqrt(1.0 - sine * sine) * away, sine * far
    points = np.empty((5, 2))
    points[0, 0], points[0, 1] = tip, 0.0
    points[1, 0], points[1, 1] = tip + along, up
    points[2, 0], points[2, 1] = tip + (along + away), up
    points[3, 0], points[3, 1] = tip + (along + away), -up
    points[4, 0], points[4, 1] = tip + along, -up
    return _from_ramp(row, _polygon(points), box, reach)


@kernel(allocates=False)
def _solve_map(row: NDArray[np.float64], out: NDArray[np.float64]) -> None:
    """Write the inverse (2, 2) of the linear part of a map to the ramp, by elimination with the larger pivot."""
    is_turned = abs(row[0]) < abs(row[3])
    p, q, r, s = (row[3], row[4], row[0], row[1]) if is_turned else (row[0], row[1], row[3], row[4])
    share = r * (1.0 / p)
    rest = 1.0 / (s - share * q)
    for c in range(2):
        first = 1.0 if (c == 0) != is_turned else 0.0
        out[1, c] = ((1.0 - first) - share * first) * rest
        out[0, c] = (first - q * out[1, c]) * (1.0 / p)


@kernel
def _from_ramp(
    row: NDArray[np.float64], contour: NDArray[np.float64], box: NDArray[np.float64], reach: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Map a contour from the ramp's plane to the unit square and clip it to a box; empty if it lies outside."""
    inverse, low, high = np.empty((2, 2)), np.full(2, np.inf), np.full(2, -np.inf)
    _solve_map(row, inverse)
    for k in range(len(contour)):
        for p in range(4):
            u, v = contour[k, p, 0] - row[2], contour[k, p, 1] - row[5]
            for axis in range(2):
                contour[k, p, axis] = u * inverse[axis, 0] + v * inverse[axis, 1]
                low[axis], high[axis] = min(low[axis], contour[k, p, axis]), max(high[axis], contour[k, p, axis])
    if low[0] >= box[1, 0] or low[1] >= box[1, 1] or high[0] <= box[0, 0] or high[1] <= box[0, 1]:
        return contour[:0]
    beyond = 0.0
    for axis in range(2):
        beyond = max(beyond, box[0, axis] - low[axis], high[axis] - box[1, axis])
        for most in (abs(low[axis]), abs(high[axis])):
            reach[0] = reach[0] if most <= reach[0] else most  # NaN counts as larger
    if beyond > CLOSED:
        contour = clip_to_box(contour, box[0], box[1])
    else:
        hold_ends(contour, box[0], box[1])
    for k in range(len(contour)):
        following = k + 1 if k + 1 < len(contour) else 0
        contour[k, 3, 0], contour[k, 3, 1] = contour[following, 0, 0], contour[following, 0, 1]
    return contour


@kernel
def _beyond(a: float, b: float, level: float, box: NDArray[np.float64]) -> NDArray[np.float64]:
    """Contour of the part of a box in which a x + b y is at least `level` (Sutherland and Hodgman, 1974)."""
    points, count = np.empty((8, 2)), 0
    for k in range(4):
        following = (k + 1) & 3
        x, y = box[1 if k == 1 or k == 2 else 0, 0], box[k >> 1, 1]
        to_x, to_y = box[1 if following == 1 or following == 2 else 0, 0], box[following >> 1, 1]
        p, q = a * x + b * y - level, a * to_x + b * to_y - level
        if p >= 0.0:
            points[count, 0], points[count, 1] = x, y
            count += 1
        if (p >= 0.0) != (q >= 0.0):
            share = p / (p - q)
            points[count, 0] = min(max(x + (to_x - x) * share, box[0, 0]), box[1, 0])
            points[count, 1] = min(max(y + (to_y - y) * share, box[0, 1]), box[1, 1])
            count += 1
    return _polygon(points[:count])
