"""The mirror of ``glsl/pixel.glsl`` and ``glsl/piece.glsl`` (see `vexture.renderers.cpu`).

The argument `quality` selects between the variants that the shader compiles conditionally.
"""

import math
from typing import NamedTuple

from vexture.kernels import kernel
from vexture.layout import CONTROL_OFFSET, COORDINATE_BITS
from vexture.renderers.method import (
    BEND,
    CLOSE,
    CROSSING,
    EXACT,
    MOST_PARTS,
    NEAR,
    NO_SIZE,
    SHORT_WAY,
    SMALLEST_PIXEL,
    STEPS,
    THINNEST_PIXEL,
)

__all__ = [
    "Frame",
    "Piece",
    "Texel",
    "Vec2",
    "Whole2",
    "box_area",
    "clear_side",
    "frame",
    "piece",
    "piece_area",
]

Vec2 = tuple[float, float]
Vec4 = tuple[float, float, float, float]
Whole2 = tuple[int, int]
Texel = tuple[int, int, int, int]


class Frame(NamedTuple):
    """Coordinates in which the pixel's footprint is the square from -1/2 to 1/2."""

    right: Vec2
    up: Vec2
    level: Vec2
    upright: Vec2
    reach: Vec2
    turned: float
    size: float


class Piece(NamedTuple):
    """Monotone in x and y, in lattice units of the leaf."""

    p0: Vec2
    p3: Vec2
    d1: Vec2
    d2: Vec2
    d3: Vec2
    starts_left: bool
    ends_left: bool


@kernel(allocates=False)
def clamp(value: float, low: float, high: float) -> float:
    return min(max(value, low), high)


# --- pixel.glsl ------------------------------------------------------------------------------------------------


@kernel(allocates=False)
def slopes(dx: float, dy: float) -> Vec2:
    return dx / dy if dy != 0.0 else 0.0, dy / dx if dx != 0.0 else 0.0


@kernel(allocates=False)
def frame(dx: Vec2, dy: Vec2) -> Frame:
    """The frame of the footprint that two steps span."""
    larger = max(dx[0] * dx[0] + dx[1] * dx[1], dy[0] * dy[0] + dy[1] * dy[1])
    if not larger > SMALLEST_PIXEL * SMALLEST_PIXEL:
        dx = (SMALLEST_PIXEL, 0.0)
        dy = (0.0, SMALLEST_PIXEL)
        larger = SMALLEST_PIXEL * SMALLEST_PIXEL
    area = dx[0] * dy[1] - dx[1] * dy[0]
    if abs(area) < THINNEST_PIXEL * larger:
        dx = dx if dx[0] * dx[0] + dx[1] * dx[1] == larger else dy
        dy = (-dx[1] * THINNEST_PIXEL, dx[0] * THINNEST_PIXEL)
        area = THINNEST_PIXEL * larger
    shrink = 1.0 / area
    right = (dy[1] * shrink, -dy[0] * shrink)
    up = (-dx[1] * shrink, dx[0] * shrink)
    level = slopes(right[0], up[0])
    upright = slopes(right[1], up[1])
    reach = (0.5 * (abs(dx[0]) + abs(dy[0])), 0.5 * (abs(dx[1]) + abs(dy[1])))
    return Frame(right, up, level, upright, reach, 1.0 if area > 0.0 else -1.0, abs(area))


@kernel(allocates=False)
def into_frame(frame: Frame, point: Vec2) -> Vec2:
    right, up = frame.right, frame.up
    return right[0] * point[0] + right[1] * point[1], up[0] * point[0] + up[1] * point[1]


@kernel(allocates=False)
def ramp(u: float) -> float:
    held = clamp(u, 0.0, 1.0)
    return held * (u - 0.5 * held)


@kernel(allocates=False)
def beside_sloped(p: Vec2, end: float, slopes: Vec2) -> float:
    y0 = clamp(p[1], -0.5, 0.5)
    y1 = clamp(end, -0.5, 0.5)
    u0 = 0.5 - p[0] - (y0 - p[1]) * slopes[0]
    u1 = 0.5 - p[0] - (y1 - p[1]) * slopes[0]
    if abs(u1 - u0) < SHORT_WAY:
        return (y0 - y1) * clamp(0.5 * (u0 + u1), 0.0, 1.0)
    return (ramp(u1) - ramp(u0)) * slopes[1]


@kernel(allocates=False)
def beside(p: Vec2, q: Vec2) -> float:
    """Area of the pixel on the right of a straight line in the frame; negative if the line goes up."""
    return beside_sloped(p, q[1], slopes(q[0] - p[0], q[1] - p[1]))


@kernel(allocates=False)
def part_inside(p: Vec2, q: Vec2) -> float:
    held_x = clamp(q[0], -0.5, 0.5) - clamp(p[0], -0.5, 0.5)
    held_y = clamp(q[1], -0.5, 0.5) - clamp(p[1], -0.5, 0.5)
    way_x, way_y = q[0] - p[0], q[1] - p[1]
    x = held_x / way_x if way_x != 0.0 else 1.0 if abs(p[0]) < 0.5 else 0.0
    y = held_y / way_y if way_y != 0.0 else 1.0 if abs(p[1]) < 0.5 else 0.0
    return x * y


@kernel(allocates=False)
def box_area(frame: Frame, low: Vec2, high: Vec2) -> float:
    """Area of the pixel in a box, positive where the frame keeps orientation."""
    p = into_frame(frame, low)
    q = into_frame(frame, (high[0], low[1]))
    r = into_frame(frame, high)
    s = into_frame(frame, (low[0], high[1]))
    level = beside_sloped(p, q[1], frame.level) + beside_sloped(r, s[1], frame.level)
    return level + beside_sloped(q, r[1], frame.upright) + beside_sloped(s, p[1], frame.upright)


# --- piece.glsl ------------------------------------------------------------------------------------------------


@kernel(allocates=False)
def lattice_point(word: int) -> Whole2:
    return word & ((1 << COORDINATE_BITS) - 1), word >> COORDINATE_BITS


@kernel(allocates=False)
def piece(texel: Texel, whole: Whole2, part: Vec2) -> Piece:
    """The piece in a texel, relative to a point of the lattice."""
    x0, y0 = lattice_point(texel[0])
    x1, y1 = lattice_point(texel[1])
    x2, y2 = lattice_point(texel[2])
    x3, y3 = lattice_point(texel[3])
    x1, y1, x2, y2 = x1 - CONTROL_OFFSET, y1 - CONTROL_OFFSET, x2 - CONTROL_OFFSET, y2 - CONTROL_OFFSET
    return Piece(
        (x0 - whole[0] - part[0], y0 - whole[1] - part[1]),
        (x3 - whole[0] - part[0], y3 - whole[1] - part[1]),
        (float(x1 - x0), float(y1 - y0)),
        (float(x2 - x1), float(y2 - y1)),
        (float(x3 - x2), float(y3 - y2)),
        x0 == 0,
        x3 == 0,
    )


@kernel(allocates=False)
def polynomial(p0: float, d1: float, d2: float, d3: float) -> Vec4:
    return (d3 - d2) - (d2 - d1), 3.0 * (d2 - d1), 3.0 * d1, p0


@kernel(allocates=False)
def evaluate(k: Vec4, t: float) -> float:
    return ((k[0] * t + k[1]) * t + k[2]) * t + k[3]


@kernel(allocates=False)
def clear_side(piece: Piece, low: Vec2, high: Vec2) -> int:
    """Winding that a piece outside of the box adds to all of it: -1, 0 or 1; `CROSSING` if it may cross the box."""
    p0, p3 = piece.p0, piece.p3
    bottom, top = min(p0[1], p3[1]), max(p0[1], p3[1])
    left, right = min(p0[0], p3[0]), max(p0[0], p3[0])
    if top <= low[1] or bottom >= high[1] or left >= high[0]:
        return 0
    if not (bottom <= low[1] and top >= high[1] and right <= low[0]):
        return CROSSING
    return -1 if p3[1] > p0[1] else 1


@kernel(allocates=False)
def x_decides(error: Vec2, slope: Vec2, later: bool) -> bool:
    x_before = error[0] < 0.0
    x_slower = error[1] * slope[0] > error[0] * slope[1]
    return (x_before if x_before != (error[1] < 0.0) else x_slower) == later


@kernel(allocates=False)
def slope(kx: Vec4, ky: Vec4, t: float) -> Vec2:
    return (3.0 * kx[0] * t + 2.0 * kx[1]) * t + kx[2], (3.0 * ky[0] * t + 2.0 * ky[1]) * t + ky[2]


@kernel(allocates=False)
def better_t(kx: Vec4, ky: Vec4, corner: Vec2, later: bool, t: float) -> float:
    errors = (evaluate(kx, t) - corner[0], evaluate(ky, t) - corner[1])
    rises = slope(kx, ky, t)
    by_x = x_decides(errors, rises, later)
    error = errors[0] if by_x else errors[1]
    rise = rises[0] if by_x else rises[1]
    bend = 6.0 * kx[0] * t + 2.0 * kx[1] if by_x else 6.0 * ky[0] * t + 2.0 * ky[1]
    divisor = rise + math.sqrt(max(4.0 * rise * rise - 6.0 * error * bend, 0.0))
    return clamp(t - (3.0 * error / divisor if divisor > 0.0 else float(math.trunc(error))), 0.0, 1.0)


@kernel(allocates=False)
def passing_point(kx: Vec4, ky: Vec4, t: float, corner: Vec2, later: bool, is_end: bool, start: Vec2, to: Vec2) -> Vec2:
    x, y = evaluate(kx, t), evaluate(ky, t)
    if not is_end:
        by_x = x_decides((x - corner[0], y - corner[1]), slope(kx, ky, t), later)
        x_near, y_near = abs(x - corner[0]) < NEAR * (to[0] - start[0]), abs(y - corner[1]) < NEAR * (to[1] - start[1])
        x, y = (corner[0] if by_x and x_near else x), (corner[1] if not by_x and y_near else y)
    return clamp(x, start[0], to[0]), clamp(y, start[1], to[1])


@kernel(allocates=False)
def bulge(first: Vec2, last: Vec2, chord: Vec2) -> float:
    turned = first[0] * chord[1] - first[1] * chord[0] + chord[0] * last[1] - chord[1] * last[0]
    return 0.15 * (2.0 * turned - (first[0] * last[1] - first[1] * last[0]))


@kernel(allocates=False)
def point(kx: Vec4, ky: Vec4, t: float, mirror: Vec2, low: Vec2, high: Vec2) -> Vec2:
    x = clamp(evaluate(kx, t) * mirror[0], low[0], high[0])
    return x, clamp(evaluate(ky, t) * mirror[1], low[1], high[1])


@kernel(allocates=False)
def part_area(p: Vec2, q: Vec2, first: Vec2, last: Vec2, frame: Frame) -> float:
    start = into_frame(frame, p)
    to = into_frame(frame, q)
    scale = frame.turned / frame.size
    return beside(start, to) + scale * bulge(first, last, (q[0] - p[0], q[1] - p[1])) * part_inside(start, to)


@kernel(allocates=False)
def curve_area(
    quality: int,
    kx: Vec4,
    ky: Vec4,
    t0: float,
    t1: float,
    p: Vec2,
    q: Vec2,
    mirror: Vec2,
    frame: Frame,
    low: Vec2,
    high: Vec2,
) -> float:
    rise = slope(kx, ky, t0)
    first = (rise[0] * mirror[0], rise[1] * mirror[1])
    rise = slope(kx, ky, t1)
    last = (rise[0] * mirror[0], rise[1] * mirror[1])
    parts = 1
    if quality == EXACT:
        bend = abs(first[0] * last[1] - first[1] * last[0]) * (t1 - t0) * (t1 - t0) / frame.size
        parts = 1 + int(min(BEND * bend, MOST_PARTS - 1.0))
    step_t = (t1 - t0) / parts
    third = step_t / 3.0
    area = 0.0
    t = t0
    for k in range(parts):
        t += step_t
        following = point(kx, ky, t, mirror, low, high) if k < parts - 1 else q
        rise = slope(kx, ky, t)
        last = (rise[0] * mirror[0], rise[1] * mirror[1])
        area += part_area(p, following, (first[0] * third, first[1] * third), (last[0] * third, last[1] * third), frame)
        p = following
        first = last
    return area


@kernel(allocates=False)
def piece_area(quality: int, piece: Piece, frame: Frame, low: Vec2, high: Vec2) -> float:
    """Minus the area on the right of a piece that goes up, plus that of one that goes down, inside a box."""
    p0, p3 = piece.p0, piece.p3
    d1, d2, d3 = piece.d1, piece.d2, piece.d3
    way = (d1[0] + d2[0] + d3[0], d1[1] + d2[1] + d3[1])
    mirror = (-1.0 if way[0] < 0.0 else 1.0, -1.0 if way[1] < 0.0 else 1.0)
    mx, my = mirror
    kx = polynomial(mx * p0[0], mx * d1[0], mx * d2[0], mx * d3[0])
    ky = polynomial(my * p0[1], my * d1[1], my * d2[1], my * d3[1])
    start = (-high[0] if mx < 0.0 else low[0], -high[1] if my < 0.0 else low[1])
    to = (-low[0] if mx < 0.0 else high[0], -low[1] if my < 0.0 else high[1])
    size_x, size_y = max(abs(way[0]), NO_SIZE), max(abs(way[1]), NO_SIZE)
    t0 = clamp(max((start[0] - kx[3]) / size_x, (start[1] - ky[3]) / size_y), 0.0, 1.0)
    t1 = clamp(min((to[0] - kx[3]) / size_x, (to[1] - ky[3]) / size_y), 0.0, 1.0)
    pixels_x = size_x * abs(frame.right[0]) + size_y * abs(frame.right[1])
    pixels_y = size_x * abs(frame.up[0]) + size_y * abs(frame.up[1])
    for _ in range(STEPS):
        better0 = better_t(kx, ky, start, True, t0)
        better1 = better_t(kx, ky, to, False, t1)
        moved = max(abs(better0 - t0), abs(better1 - t1)) * max(pixels_x, pixels_y)
        t0, t1 = better0, better1
        if not moved > CLOSE:
            break
    misses = t0 >= t1
    t1 = max(t0, t1)

    y0 = clamp(p0[1], low[1], high[1])
    y3 = clamp(p3[1], low[1], high[1])
    passed = passing_point(kx, ky, t0, start, True, t0 == 0.0, start, to)
    enter = (mx * passed[0], my * passed[1])
    passed = passing_point(kx, ky, t1, to, False, t1 == 1.0, start, to)
    leave = enter if misses else (mx * passed[0], my * passed[1])
    area = curve_area(quality, kx, ky, t0, t1, enter, leave, mirror, frame, low, high)

    left_start, left_end = (leave[1], y3) if mx < 0.0 else (y0, enter[1])
    right_start, right_end = (y3, enter[1]) if mx < 0.0 else (leave[1], y0)
    if piece.starts_left and low[1] < p0[1] < high[1] and mx > 0.0:
        left_start = right_end = high[1]
    if piece.ends_left and low[1] < p3[1] < high[1]:
        left_end = right_start = high[1]
    l0, l1 = into_frame(frame, (low[0], left_start)), into_frame(frame, (low[0], left_end))
    r0, r1 = into_frame(frame, (high[0], right_start)), into_frame(frame, (high[0], right_end))
    e0, e1 = into_frame(frame, (enter[0], right_end)), into_frame(frame, (leave[0], right_start))
    area += beside_sloped(l0, l1[1], frame.upright) + beside_sloped(r0, r1[1], frame.upright)
    return area + beside_sloped(e1, r0[1], frame.level) + beside_sloped(r1, e0[1], frame.level)
