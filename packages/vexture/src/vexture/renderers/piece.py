"""The mirror of ``pixel.glsl``, ``piece.glsl`` and ``view.glsl`` in ``shaders/`` (see `vexture.renderers.cpu`)."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import CONTROL_OFFSET, COORDINATE_BITS, COVERAGE_ONE, LATTICE_BITS
from vexture.renderers.cells import Texel, Vec2, VexturePlace, Whole2, clamp
from vexture.renderers.method import (
    CLOSE,
    NO_SIZE,
    POSITION_BITS,
    SHORT_WAY,
    SMALLEST_BOX,
    SMALLEST_PIXEL,
    STEPS,
    THINNEST_PIXEL,
)


class VextureFrame(NamedTuple):
    """Coordinates in which a pixel's footprint is the square from -1/2 to 1/2."""

    right: Vec2
    up: Vec2
    extent: Vec2
    size: float
    longer: float


class VextureBox(NamedTuple):
    """Part of a cell in the bounding box of a pixel's footprint."""

    unit: float
    way: Vec2
    part: Vec2
    low: Vec2
    size: Vec2


class ViewPixel(NamedTuple):
    """Position of a picture's pixel in the drawing; `seen` is False beyond the horizon."""

    seen: bool
    offset: Vec2
    dx: Vec2
    dy: Vec2


class VexturePiece(NamedTuple):
    """A piece, monotone in x and y; falling coordinates are mirrored in the box."""

    a: Vec2
    b: Vec2
    c: Vec2
    d: Vec2
    way: Vec2
    falls: tuple[bool, bool]


class VextureEnds(NamedTuple):
    """Points where a piece enters and leaves the box."""

    start: float
    end: float
    enter: Vec2
    leave: Vec2


# --- pixel.glsl ------------------------------------------------------------------------------------------------


@kernel(allocates=False)
def frame(dx: Vec2, dy: Vec2) -> VextureFrame:
    """Frame of the footprint that two steps span."""
    one = float(1 << POSITION_BITS)
    dx = (dx[0] * one, dx[1] * one)
    dy = (dy[0] * one, dy[1] * one)
    smallest = SMALLEST_PIXEL * one
    longer = max(dx[0] * dx[0] + dx[1] * dx[1], dy[0] * dy[0] + dy[1] * dy[1])
    area = dx[0] * dy[1] - dx[1] * dy[0]
    exists = longer > smallest * smallest
    if not exists or abs(area) < THINNEST_PIXEL * longer:
        width = THINNEST_PIXEL if exists else 1.0
        dx = dx if dx[0] * dx[0] + dx[1] * dx[1] == longer else dy
        dx = dx if exists else (smallest, 0.0)
        dy = (-dx[1] * width, dx[0] * width)
        longer = dx[0] * dx[0] + dx[1] * dx[1]
        area = width * longer
    right = (dy[1] / area, -dy[0] / area)
    up = (-dx[1] / abs(area), dx[0] / abs(area))
    extent = (0.5 * (abs(dx[0]) + abs(dy[0])), 0.5 * (abs(dx[1]) + abs(dy[1])))
    return VextureFrame(right, up, extent, abs(area), longer)


@kernel(allocates=False)
def into_frame(frame: VextureFrame, point: Vec2) -> Vec2:
    """Transform a point or vector of the plane to the frame."""
    right, up = frame.right, frame.up
    return right[0] * point[0] + right[1] * point[1], up[0] * point[0] + up[1] * point[1]


@kernel(allocates=False)
def slopes(dx: float, dy: float) -> Vec2:
    """Slopes dx / dy and dy / dx of a direction; 0 in place of infinity."""
    return dx / dy if dy != 0.0 else 0.0, dy / dx if dx != 0.0 else 0.0


@kernel(allocates=False)
def ramp(u: float) -> float:
    held = clamp(u, 0.0, 1.0)
    return held * (u - 0.5 * held)


@kernel(allocates=False)
def beside_sloped(p: Vec2, end: float, slopes: Vec2) -> float:
    """Area of the pixel to the right of a straight line from a point to a height, with given slopes."""
    y0 = clamp(p[1], -0.5, 0.5)
    y1 = clamp(end, -0.5, 0.5)
    u0 = 0.5 - p[0] - (y0 - p[1]) * slopes[0]
    u1 = 0.5 - p[0] - (y1 - p[1]) * slopes[0]
    if abs(u1 - u0) < SHORT_WAY:
        return (y0 - y1) * clamp(0.5 * (u0 + u1), 0.0, 1.0)
    return (ramp(u1) - ramp(u0)) * slopes[1]


@kernel(allocates=False)
def beside(p: Vec2, q: Vec2) -> float:
    """Area of the pixel to the right of a straight line in the frame; negative if the line goes up."""
    return beside_sloped(p, q[1], slopes(q[0] - p[0], q[1] - p[1]))


@kernel(allocates=False)
def part_inside(p: Vec2, q: Vec2) -> float:
    """Approximate fraction of a straight line that lies in the pixel."""
    held_x = clamp(q[0], -0.5, 0.5) - clamp(p[0], -0.5, 0.5)
    held_y = clamp(q[1], -0.5, 0.5) - clamp(p[1], -0.5, 0.5)
    way_x, way_y = q[0] - p[0], q[1] - p[1]
    x = held_x / way_x if way_x != 0.0 else 1.0 if abs(p[0]) < 0.5 else 0.0
    y = held_y / way_y if way_y != 0.0 else 1.0 if abs(p[1]) < 0.5 else 0.0
    return x * y


@kernel(allocates=False)
def box_area(frame: VextureFrame, low: Vec2, size: Vec2) -> float:
    """Area of the pixel in a box."""
    right, up = frame.right, frame.up
    level = slopes(right[0], up[0])
    upright = slopes(right[1], up[1])
    p = into_frame(frame, low)
    q = (p[0] + right[0] * size[0], p[1] + up[0] * size[0])
    r = (q[0] + right[1] * size[1], q[1] + up[1] * size[1])
    s = (p[0] + right[1] * size[1], p[1] + up[1] * size[1])
    first = beside_sloped(p, q[1], level) + beside_sloped(q, r[1], upright)
    return first + beside_sloped(r, s[1], level) + beside_sloped(s, p[1], upright)


# --- piece.glsl ------------------------------------------------------------------------------------------------


@kernel(allocates=False)
def box(origin: Whole2, bit: int, place: VexturePlace, extent: Vec2) -> VextureBox:
    """Part of a cell in the bounding box of a footprint."""
    way = (float(place.point[0] - origin[0]), float(place.point[1] - origin[1]))
    rest, side = place.rest, float(1 << bit)
    low = (max(-way[0] - rest[0], -extent[0]), max(-way[1] - rest[1], -extent[1]))
    high = (min(side - way[0] - rest[0], extent[0]), min(side - way[1] - rest[1], extent[1]))
    size = (max(high[0] - low[0], SMALLEST_BOX), max(high[1] - low[1], SMALLEST_BOX))
    part = ((rest[0] + low[0]) / size[0], (rest[1] + low[1]) / size[1])
    return VextureBox(2.0 ** (bit - LATTICE_BITS), way, part, low, size)


@kernel(allocates=False)
def word(word: int) -> Vec2:
    """Unpack the two coordinates of a word."""
    return float(word & 0xFFFF), float(word >> COORDINATE_BITS)


@kernel(allocates=False)
def in_box(point: Vec2, box: VextureBox) -> Vec2:
    """Transform a point of the cell's lattice to coordinates of the box, 0..1."""
    unit, way, part, size = box.unit, box.way, box.part, box.size
    return (point[0] * unit - way[0]) / size[0] - part[0], (point[1] * unit - way[1]) / size[1] - part[1]


@kernel(allocates=False)
def piece(texel: Texel, box: VextureBox) -> VexturePiece:
    """Polynomials of a piece in coordinates of the box."""
    p0, p1, p2, p3 = word(texel[0]), word(texel[1]), word(texel[2]), word(texel[3])
    way = (p3[0] - p0[0], p3[1] - p0[1])
    falls = (way[0] < 0.0, way[1] < 0.0)
    sides = (box.unit / box.size[0], box.unit / box.size[1])
    rising = (3.0 * (-sides[0] if falls[0] else sides[0]), 3.0 * (-sides[1] if falls[1] else sides[1]))
    d = in_box(p0, box)
    d = (1.0 - d[0] if falls[0] else d[0], 1.0 - d[1] if falls[1] else d[1])
    c = ((p1[0] - p0[0] - CONTROL_OFFSET) * rising[0], (p1[1] - p0[1] - CONTROL_OFFSET) * rising[1])
    b = ((p2[0] - p1[0]) * rising[0] - c[0], (p2[1] - p1[1]) * rising[1] - c[1])
    way = (abs(way[0]) * sides[0], abs(way[1]) * sides[1])
    return VexturePiece((way[0] - c[0] - b[0], way[1] - c[1] - b[1]), b, c, d, way, falls)


@kernel(allocates=False)
def at(piece: VexturePiece, t: float) -> Vec2:
    """Point at t, clamped to the box."""
    a, b, c, d = piece.a, piece.b, piece.c, piece.d
    x = ((a[0] * t + b[0]) * t + c[0]) * t + d[0]
    y = ((a[1] * t + b[1]) * t + c[1]) * t + d[1]
    return clamp(x, 0.0, 1.0), clamp(y, 0.0, 1.0)


@kernel(allocates=False)
def slope(piece: VexturePiece, t: float) -> Vec2:
    """Derivative at t."""
    a, b, c = piece.a, piece.b, piece.c
    return (3.0 * a[0] * t + 2.0 * b[0]) * t + c[0], (3.0 * a[1] * t + 2.0 * b[1]) * t + c[1]


@kernel(allocates=False)
def better_t(piece: VexturePiece, side: float, t: Vec2) -> Vec2:
    """Improve the parameters at which x and y reach a side of the box, by one Laguerre step each."""
    a, b, c, d = piece.a, piece.b, piece.c, piece.d
    return better_coordinate(a[0], b[0], c[0], d[0] - side, t[0]), better_coordinate(
        a[1], b[1], c[1], d[1] - side, t[1]
    )


@kernel(allocates=False)
def better_coordinate(a: float, b: float, c: float, d: float, t: float) -> float:
    """One coordinate of `better_t`, which GLSL computes with vectors."""
    q = a * t
    bend = 3.0 * q + b
    error = 3.0 * (((q + b) * t + c) * t + d)
    slope = (bend + b) * t + c
    divisor = slope + 2.0 * math.sqrt(abs(slope * slope - error * bend))
    return clamp(t - error / max(divisor, max(abs(error), NO_SIZE)), 0.0, 1.0)


@kernel(allocates=False)
def ends(piece: VexturePiece) -> VextureEnds:
    """Find where a piece enters and leaves the box."""
    d = piece.d
    inverse = (1.0 / max(piece.way[0], NO_SIZE), 1.0 / max(piece.way[1], NO_SIZE))
    t0 = (clamp(-d[0] * inverse[0], 0.0, 1.0), clamp(-d[1] * inverse[1], 0.0, 1.0))
    t1 = (clamp(inverse[0] - d[0] * inverse[0], 0.0, 1.0), clamp(inverse[1] - d[1] * inverse[1], 0.0, 1.0))
    close = CLOSE * min(inverse[0], inverse[1])
    steps = STEPS
    while steps > 0:
        better0 = better_t(piece, 0.0, t0)
        better1 = better_t(piece, 1.0, t1)
        moved_x = max(abs(better0[0] - t0[0]), abs(better1[0] - t1[0]))
        moved_y = max(abs(better0[1] - t0[1]), abs(better1[1] - t1[1]))
        t0 = better0
        t1 = better1
        steps = steps - 1 if max(moved_x, moved_y) > close else 0
    start = max(t0[0], t0[1])
    end = max(min(t1[0], t1[1]), start)
    enter = at(piece, start)
    leave = at(piece, end)
    enter = (0.0 if t0[0] > t0[1] else enter[0], 0.0 if t0[1] > t0[0] else enter[1])
    leave = (1.0 if t1[0] < t1[1] else leave[0], 1.0 if t1[1] < t1[0] else leave[1])
    return VextureEnds(start, end, enter, leave)


@kernel(allocates=False)
def cross(p: Vec2, q: Vec2) -> float:
    """Cross product: twice the area of the triangle that two vectors span."""
    return p[0] * q[1] - p[1] * q[0]


@kernel(allocates=False)
def bulge(third: float, first: Vec2, last: Vec2, chord: Vec2) -> float:
    """Area between a part of a piece and its chord; positive to the right of an upward chord."""
    turned = cross((first[0] - last[0], first[1] - last[1]), chord)
    return 0.15 * third * (2.0 * turned - third * cross(first, last))


@kernel(allocates=False)
def mean(stored: int, place: Vec2) -> float:
    """Mean coverage of a quad near a point of its own unit square."""
    x, y = 2.0 * place[0] - 0.5, 2.0 * place[1] - 0.5
    low = (stored & 255) * (1.0 - x) + ((stored >> 8) & 255) * x
    high = ((stored >> 16) & 255) * (1.0 - x) + (stored >> 24) * x
    return clamp((low * (1.0 - y) + high * y) / COVERAGE_ONE, 0.0, 1.0)


# --- view.glsl -------------------------------------------------------------------------------------------------


@kernel(allocates=False)
def view_pixel(to_unit: NDArray[np.float64], pixel: Vec2) -> ViewPixel:
    """Arguments of `vexture.renderers.cpu.coverage` for a pixel."""
    x, y = pixel
    w = to_unit[2, 0] * x + to_unit[2, 1] * y + to_unit[2, 2]
    if w <= 0.5 * (abs(to_unit[2, 0]) + abs(to_unit[2, 1])):
        return ViewPixel(False, (0.0, 0.0), (0.0, 0.0), (0.0, 0.0))
    u = (to_unit[0, 0] * x + to_unit[0, 1] * y + to_unit[0, 2]) / w
    v = (to_unit[1, 0] * x + to_unit[1, 1] * y + to_unit[1, 2]) / w
    dx = ((to_unit[0, 0] - u * to_unit[2, 0]) / w, (to_unit[1, 0] - v * to_unit[2, 0]) / w)
    dy = ((to_unit[0, 1] - u * to_unit[2, 1]) / w, (to_unit[1, 1] - v * to_unit[2, 1]) / w)
    return ViewPixel(True, (u, v), dx, dy)
