"""The mirror of ``shaders/picture.glsl``: the mean of a picture's pixels (see `vexture.renderers.cpu`)."""

import math
from typing import NamedTuple

from vexture.base.kernels import kernel
from vexture.base.layout import BLOCK_SIDE, ENTRY_BITS, FIRST_BLOCK
from vexture.renderers.cells import Texel, Texels, Vec2, Whole2, clamp, texel
from vexture.renderers.method import (
    GAUSS,
    LEAST_OUTLINE,
    LEAST_SMOOTH,
    LEVEL_BIAS,
    NOTHING,
    PICTURE_AREA,
    PICTURE_FAR,
    PICTURE_LENGTH,
    PICTURE_LINES,
    SHORT_SMOOTH,
    SMOOTH_AREA,
    THINNEST_OUTLINE,
)
from vexture.renderers.vectors import Vec4, plus, times


class VextureLevel(NamedTuple):
    """A level of a picture: columns and rows, and the texel of its first pixels.

    In a picture of opacities, `first` is the number of its first entry in the index instead, and `blocks` the texel of
    the first block, which is 0 in other pictures.
    """

    size: Whole2
    first: int
    blocks: int


class VextureOutline(NamedTuple):
    """A parallelogram in a level, in pixels from `origin`: where its sides begin, the sides, and its bounds."""

    x: Vec4
    y: Vec4
    run: Vec4
    rise: Vec4
    low: Vec2
    high: Vec2
    origin: Whole2


class VextureStrip(NamedTuple):
    """Parts of an outline's sides between two heights."""

    low: Vec4
    high: Vec4
    rise: Vec4


class VexturePoints(NamedTuple):
    """Two points on each of these parts, and their weights for the rows of pixels below and above."""

    first: Vec4
    second: Vec4
    first_below: Vec4
    second_below: Vec4
    first_above: Vec4
    second_above: Vec4


@kernel(allocates=False)
def floor_of(value: float) -> int:
    """Return ``int(floor(value))`` of GLSL; 0 if the value is not finite."""
    return math.floor(value) if abs(value) <= 4.0 * PICTURE_FAR else 0


@kernel(allocates=False)
def clamp_index(value: int, most: int) -> int:
    """Return the nearest of the numbers from 0 to `most`."""
    return min(max(value, 0), most)


@kernel(allocates=False)
def dot_four(a: Vec4, b: Vec4) -> float:
    """Mirror GLSL's ``dot`` of four numbers."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]


@kernel(allocates=False)
def multiply(a: Vec4, b: Vec4) -> Vec4:
    """Return ``a * b`` of GLSL."""
    return a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]


@kernel(allocates=False)
def on_sides(start: Vec4, side: Vec4, place: Vec4) -> Vec4:
    """Return ``start + place * side`` of GLSL."""
    return plus(start, multiply(place, side), 1.0)


@kernel(allocates=False)
def pixel(word: int) -> Vec4:
    return float(word & 255), float((word >> 8) & 255), float((word >> 16) & 255), float(word >> 24)


@kernel(allocates=False)
def sum_pixels(pixels: Texel, weights: Vec4) -> Vec4:
    below = plus(times(pixel(pixels[0]), weights[0]), pixel(pixels[1]), weights[1])
    return plus(plus(below, pixel(pixels[2]), weights[2]), pixel(pixels[3]), weights[3])


@kernel(allocates=False)
def block(texels: Texels, level: VextureLevel, i: int, j: int) -> Texel:
    place = level.first + j * ((level.size[0] - 1) // BLOCK_SIDE + 1) + i
    entries = texel(texels, place >> ENTRY_BITS)
    entry = 0 + (entries[(place >> 1) & 3] >> (16 * (place & 1))) & 0xFFFF  # of 64 bits
    if entry < FIRST_BLOCK:
        word = entry * 0x01010101
        return word, word, word, word
    found = texel(texels, level.blocks + entry - FIRST_BLOCK)
    return 0 + found[0], 0 + found[1], 0 + found[2], 0 + found[3]


@kernel(allocates=False)
def pixels_at(texels: Texels, level: VextureLevel, i: int, j: int) -> Texel:
    if level.blocks != 0:
        found, shift = block(texels, level, i >> 1, j >> 1), 16 * (i & 1)
        one, other = (found[0], found[1]) if j & 1 == 0 else (found[2], found[3])
        one, other = one >> shift, other >> shift
        return one & 255, (one >> 8) & 255, other & 255, (other >> 8) & 255
    found = texel(texels, level.first + j * ((level.size[0] + 1) >> 1) + i)
    return 0 + found[0], 0 + found[1], 0 + found[2], 0 + found[3]  # of 64 bits


@kernel(allocates=False)
def next_level(level: VextureLevel) -> VextureLevel:
    side = 2 if level.blocks == 0 else BLOCK_SIDE
    parts = ((level.size[0] - 1) // side + 1) * ((level.size[1] - 1) // side + 1)
    return VextureLevel(((level.size[0] + 1) >> 1, (level.size[1] + 1) >> 1), level.first + parts, level.blocks)


@kernel(allocates=False)
def first_level(size: Whole2, first: int, has_blocks: bool) -> VextureLevel:
    if not has_blocks:
        return VextureLevel(size, first, 0)
    last = VextureLevel(size, first << ENTRY_BITS, 1)
    while last.size[0] + last.size[1] > 2:
        last = next_level(last)
    return VextureLevel(size, first << ENTRY_BITS, (last.first >> ENTRY_BITS) + 1)


@kernel(allocates=False)
def outline(middle: Vec2, right: Vec2, up: Vec2) -> VextureOutline:
    is_high = up[0] * up[0] + up[1] * up[1] > right[0] * right[0] + right[1] * right[1]
    a, b = (up, right) if is_high else (right, up)
    size = math.sqrt(a[0] * a[0] + a[1] * a[1])
    a, size = (LEAST_OUTLINE, 0.0) if size < LEAST_OUTLINE else a, max(size, LEAST_OUTLINE)
    wide = (a[0] * b[1] - a[1] * b[0]) / size
    more = max(THINNEST_OUTLINE * size - abs(wide), 0.0) / size
    more = -more if wide < 0.0 else more
    b = (b[0] - more * a[1], b[1] + more * a[0])
    origin = (floor_of(middle[0]), floor_of(middle[1]))
    x, y = middle[0] - origin[0], middle[1] - origin[1]
    reach = (0.5 * (abs(a[0]) + abs(b[0])), 0.5 * (abs(a[1]) + abs(b[1])))
    left, bottom = x - 0.5 * (a[0] + b[0]), y - 0.5 * (a[1] + b[1])
    rise_a = a[1] if abs(a[1]) > NOTHING else NOTHING
    rise_b = b[1] if abs(b[1]) > NOTHING else NOTHING
    return VextureOutline(
        (left, left + a[0], left + a[0] + b[0], left + b[0]),
        (bottom, bottom + a[1], bottom + a[1] + b[1], bottom + b[1]),
        (a[0], b[0], -a[0], -b[0]),
        (rise_a, rise_b, -rise_a, -rise_b),
        (x - reach[0], y - reach[1]),
        (x + reach[0], y + reach[1]),
        origin,
    )


@kernel(allocates=False)
def cut(outline: VextureOutline, y: float, k: int) -> float:
    """Return one of the four numbers of `cuts`, which GLSL computes with vectors."""
    return clamp((y - outline.y[k]) / outline.rise[k], 0.0, 1.0)


@kernel(allocates=False)
def cuts(outline: VextureOutline, y: float) -> Vec4:
    return cut(outline, y, 0), cut(outline, y, 1), cut(outline, y, 2), cut(outline, y, 3)


@kernel(allocates=False)
def line(k: int, count: int, place: float, bounds: Vec2) -> float:
    return bounds[0] if k <= 0 else bounds[1] if k >= count else clamp(place, bounds[0], bounds[1])


@kernel(allocates=False)
def columns(level: VextureLevel, outline: VextureOutline, start: Vec4, to: Vec4, reach: float) -> Whole2:
    low, high = PICTURE_FAR, -PICTURE_FAR
    for k in range(4):
        if start[k] != to[k]:
            one = outline.x[k] + start[k] * outline.run[k]
            other = outline.x[k] + to[k] * outline.run[k]
            low, high = min(low, min(one, other)), max(high, max(one, other))
    most = level.size[0] - 1
    first = clamp_index(floor_of(low - reach) + outline.origin[0], most) >> 1
    last = clamp_index(floor_of(high + reach) + outline.origin[0], most) >> 1
    return first, min(last, first + PICTURE_LINES)


@kernel(allocates=False)
def strip(outline: VextureOutline, start: Vec4, to: Vec4) -> VextureStrip:
    a, b = on_sides(outline.x, outline.run, start), on_sides(outline.x, outline.run, to)
    low = (min(a[0], b[0]), min(a[1], b[1]), min(a[2], b[2]), min(a[3], b[3]))
    high = (max(a[0], b[0]), max(a[1], b[1]), max(a[2], b[2]), max(a[3], b[3]))
    c = plus(to, start, -1.0)
    return VextureStrip(low, high, multiply((abs(c[0]), abs(c[1]), abs(c[2]), abs(c[3])), outline.rise))


@kernel(allocates=False)
def area_beyond(strip: VextureStrip, x: float) -> float:
    total = 0.0
    for k in range(4):
        low, high = strip.low[k], strip.high[k]
        share = clamp((high - x) / max(high - low, NOTHING), 0.0, 1.0)
        total += strip.rise[k] * share * (max(low - x, 0.0) + max(high - x, 0.0))
    return 0.5 * total


@kernel(allocates=False)
def differences(left: Vec2, middle: Vec2, right: Vec2) -> Vec4:
    """Return the weights of two columns in two rows, from the weights beyond three lines."""
    return left[0] - middle[0], middle[0] - right[0], left[1] - middle[1], middle[1] - right[1]


@kernel(allocates=False)
def area_mean(texels: Texels, level: VextureLevel, outline: VextureOutline) -> Vec4:
    sum, total = (0.0, 0.0, 0.0, 0.0), 0.0
    sides, ends = (outline.low[0], outline.high[0]), (outline.low[1], outline.high[1])
    (across, count), origin = level.size, outline.origin
    first = clamp_index(floor_of(ends[0]) + origin[1], count - 1) >> 1
    last = clamp_index(floor_of(ends[1]) + origin[1], count - 1) >> 1
    above = cuts(outline, ends[0])
    for j in range(first, min(last, first + PICTURE_LINES) + 1):
        below, place = above, float(2 * j - origin[1])
        between = cuts(outline, line(2 * j + 1, count, place + 1.0, ends))
        above = cuts(outline, line(2 * j + 2, count, place + 2.0, ends))
        low, high = strip(outline, below, between), strip(outline, between, above)
        begin, end = columns(level, outline, below, above, 0.0)
        x = float(2 * begin - origin[0])
        here = line(2 * begin, across, x, sides)
        left = (area_beyond(low, here), area_beyond(high, here))
        for i in range(begin, end + 1):
            here = line(2 * i + 1, across, x + 1.0, sides)
            middle = (area_beyond(low, here), area_beyond(high, here))
            x += 2.0
            here = line(2 * i + 2, across, x, sides)
            right = (area_beyond(low, here), area_beyond(high, here))
            weights = differences(left, middle, right)
            sum = plus(sum, sum_pixels(pixels_at(texels, level, i, j), weights), 1.0)
            total += weights[0] + weights[1] + weights[2] + weights[3]
            left = right
    return times(sum, 1.0 / (total if total != 0.0 else 1.0))


@kernel(allocates=False)
def points(outline: VextureOutline, start: Vec4, to: Vec4, y: float) -> VexturePoints:
    middle, way = times(plus(start, to, 1.0), 0.5), times(plus(to, start, -1.0), GAUSS)
    first, second, ones = plus(middle, way, -1.0), plus(middle, way, 1.0), (1.0, 1.0, 1.0, 1.0)
    first_above = on_sides(plus(outline.y, ones, -y), outline.rise, first)
    second_above = on_sides(plus(outline.y, ones, -y), outline.rise, second)
    rise = times(strip(outline, start, to).rise, 0.5)
    return VexturePoints(
        on_sides(outline.x, outline.run, first),
        on_sides(outline.x, outline.run, second),
        multiply(rise, plus(ones, first_above, -1.0)),
        multiply(rise, plus(ones, second_above, -1.0)),
        multiply(rise, first_above),
        multiply(rise, second_above),
    )


@kernel(allocates=False)
def ramp_from(place: float) -> float:
    """Return one of the four numbers of `ramp_beyond`, which GLSL computes with vectors."""
    after = max(place + 1.0, 0.0)
    within = min(after, 1.0)
    return after - within + 0.5 * within * within


@kernel(allocates=False)
def ramp_beyond(place: Vec4) -> Vec4:
    return ramp_from(place[0]), ramp_from(place[1]), ramp_from(place[2]), ramp_from(place[3])


@kernel(allocates=False)
def weight_beyond(points: VexturePoints, x: float) -> Vec2:
    ones = (1.0, 1.0, 1.0, 1.0)
    first, second = ramp_beyond(plus(points.first, ones, -x)), ramp_beyond(plus(points.second, ones, -x))
    below = dot_four(points.first_below, first) + dot_four(points.second_below, second)
    return below, dot_four(points.first_above, first) + dot_four(points.second_above, second)


@kernel(allocates=False)
def pixels_in(texels: Texels, level: VextureLevel, i: int, rows: Whole2) -> Texel:
    below = pixels_at(texels, level, i, rows[0] >> 1)
    above = below
    if rows[0] >> 1 != rows[1] >> 1:
        above = pixels_at(texels, level, i, rows[1] >> 1)
    a, b = (below[0], below[1]) if rows[0] & 1 == 0 else (below[2], below[3])
    c, d = (above[0], above[1]) if rows[1] & 1 == 0 else (above[2], above[3])
    return a, b, c, d


@kernel(allocates=False)
def smooth_mean(texels: Texels, level: VextureLevel, outline: VextureOutline) -> Vec4:
    sum, total = (0.0, 0.0, 0.0, 0.0), 0.0
    sides, (across, count), origin = (outline.low[0] - 1.0, outline.high[0] + 1.0), level.size, outline.origin
    first = floor_of(outline.low[1] - 0.5) + origin[1]
    last = floor_of(outline.high[1] - 0.5) + origin[1]
    above = cuts(outline, outline.low[1])
    for j in range(first, min(last, first + PICTURE_LINES) + 1):
        below, y = above, float(j - origin[1]) + 0.5
        above = cuts(outline, y + 1.0)
        found = points(outline, below, above, y)
        begin, end = columns(level, outline, below, above, 0.5)
        rows = (clamp_index(j, count - 1), clamp_index(j + 1, count - 1))
        x = float(2 * begin - origin[0]) + 0.5
        left = weight_beyond(found, line(2 * begin, across, x, sides))
        for i in range(begin, end + 1):
            middle = weight_beyond(found, line(2 * i + 1, across, x + 1.0, sides))
            x += 2.0
            right = weight_beyond(found, line(2 * i + 2, across, x, sides))
            weights = differences(left, middle, right)
            sum = plus(sum, sum_pixels(pixels_in(texels, level, i, rows), weights), 1.0)
            total += weights[0] + weights[1] + weights[2] + weights[3]
            left = right
    return times(sum, 1.0 / (total if total != 0.0 else 1.0))


@kernel(allocates=False)
def picture_mean(
    texels: Texels, level: VextureLevel, is_smooth: bool, middle: Vec2, right: Vec2, up: Vec2, share: float
) -> Vec4:
    """Mean of a picture, 0..255, over a parallelogram in its pixels that has this share of a footprint."""
    longer = max(right[0] * right[0] + right[1] * right[1], up[0] * up[0] + up[1] * up[1])
    area = (1.0 - LEVEL_BIAS) * max(abs(right[0] * up[1] - right[1] * up[0]) / share, PICTURE_LENGTH * longer)
    far, scale = max(abs(middle[0]), abs(middle[1])), 1.0
    is_smooth = is_smooth and area <= SMOOTH_AREA and far <= PICTURE_FAR
    while not (area <= PICTURE_AREA and far <= PICTURE_FAR) and level.size[0] + level.size[1] > 2:
        level, scale, area = next_level(level), 0.5 * scale, 0.25 * area
    if level.size[0] + level.size[1] == 2:
        return pixel(pixels_at(texels, level, 0, 0)[0])
    if is_smooth:
        if longer < SHORT_SMOOTH * SHORT_SMOOTH:
            right, up = (
                (max(math.sqrt(right[0] * right[0] + up[0] * up[0]), LEAST_SMOOTH), 0.0),
                (0.0, max(math.sqrt(right[1] * right[1] + up[1] * up[1]), LEAST_SMOOTH)),
            )
        return smooth_mean(texels, level, outline(middle, right, up))
    middle = (scale * middle[0], scale * middle[1])
    right, up = (scale * right[0], scale * right[1]), (scale * up[0], scale * up[1])
    return area_mean(texels, level, outline(middle, right, up))
