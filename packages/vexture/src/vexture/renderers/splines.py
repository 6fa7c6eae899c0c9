"""The mirror of ``shaders/spline.glsl``: the mean of a spline of pixels (see `vexture.renderers.cpu`)."""

import math

from vexture.base.kernels import kernel
from vexture.base.layout import BLOCK_SIDE, COVERAGE_ONE
from vexture.drawing.picture import Sampling
from vexture.renderers.cells import Texels, Vec2, clamp
from vexture.renderers.method import (
    LEAST_SPLINE_BOX,
    LEVEL_BIAS,
    MOST_SPLINE_BOXES,
    NOTHING,
    SLANTED_PART,
    THINNEST_PIXEL,
    WIDEST_SPLINE_BOX,
)
from vexture.renderers.pixels import (
    VextureLevel,
    block,
    clamp_index,
    dot_four,
    floor_of,
    picture_mean,
    pixel,
)
from vexture.renderers.vectors import Vec4, times

PIXELS, SPLINE = int(Sampling.PIXELS), int(Sampling.SPLINE)
OPACITY, INVERSE = int(Sampling.OPACITY), int(Sampling.INVERSE)


@kernel(allocates=False)
def spline_beyond(place: float) -> float:
    """Return one of the four numbers of GLSL's vector."""
    wide, narrow = max(1.5 - abs(place), 0.0), max(0.5 - abs(place), 0.0)
    wide, narrow = wide * wide, narrow * narrow
    return max(place, 0.0) + (wide * wide - 3.0 * narrow * narrow) / 24.0


@kernel(allocates=False)
def share_beyond(number: int, count: int, origin: int, between: Vec2) -> float:
    """Return one of the four numbers of `shares_beyond`, which GLSL computes with vectors."""
    if number <= 0:
        return 1.0
    if number >= count:
        return 0.0
    line = float(number - origin)
    share = spline_beyond(between[1] - line) - spline_beyond(between[0] - line)
    return max(share / (between[1] - between[0]), 0.0)


@kernel(allocates=False)
def shares_beyond(first: int, count: int, origin: int, between: Vec2) -> Vec4:
    return (
        share_beyond(first, count, origin, between),
        share_beyond(first + 1, count, origin, between),
        share_beyond(first + 2, count, origin, between),
        share_beyond(first + 3, count, origin, between),
    )


@kernel(allocates=False)
def drop(shares: Vec4, after: float) -> Vec4:
    """Return ``shares - vec4(shares.yzw, after)`` of GLSL."""
    return shares[0] - shares[1], shares[1] - shares[2], shares[2] - shares[3], shares[3] - after


@kernel(allocates=False)
def span(middle: float, side: float, count: int) -> tuple[int, Vec2, int, int]:
    """Return the origin, the bounds from there, and the first and last block of a box, for one of two directions."""
    middle = clamp(middle, -WIDEST_SPLINE_BOX, count + WIDEST_SPLINE_BOX)
    origin = floor_of(middle)
    low = middle - origin - 0.5 * side
    high = low + side
    first = clamp_index(origin + floor_of(low - 1.5), count - 1) // BLOCK_SIDE
    last = clamp_index(origin + floor_of(high + 1.5), count - 1) // BLOCK_SIDE
    return origin, (low, high), first, min(last, first + 4)


@kernel(allocates=False)
def box_mean(texels: Texels, level: VextureLevel, middle: Vec2, sides: Vec2) -> float:
    left, across, first, last = span(middle[0], sides[0], level.size[0])
    top, down, begin, end = span(middle[1], sides[1], level.size[1])
    sum, above = 0.0, shares_beyond(BLOCK_SIDE * begin, level.size[1], top, down)
    for j in range(begin, end + 1):
        row = above
        above = shares_beyond(BLOCK_SIDE * (j + 1), level.size[1], top, down)
        row = drop(row, above[0])
        right = shares_beyond(BLOCK_SIDE * first, level.size[0], left, across)
        for i in range(first, last + 1):
            column = right
            right = shares_beyond(BLOCK_SIDE * (i + 1), level.size[0], left, across)
            column, found = drop(column, right[0]), block(texels, level, i, j)
            for k in range(BLOCK_SIDE):
                sum += row[k] * dot_four(column, pixel(found[k]))
    return sum


@kernel(allocates=False)
def widen(right: Vec2, up: Vec2) -> Vec4:
    right_size, up_size = right[0] * right[0] + right[1] * right[1], up[0] * up[0] + up[1] * up[1]
    longer = max(right_size, up_size)
    area = max(abs(right[0] * up[1] - right[1] * up[0]), max(THINNEST_PIXEL * longer, NOTHING))
    inverse = 2.0 / (area * area)
    along, beside = 1.0 + inverse * up_size, 1.0 + inverse * right_size
    both = -inverse * (right[0] * up[0] + right[1] * up[1])
    root = math.sqrt(max(along * beside - both * both, 0.0))
    size = math.sqrt(along + beside + 2.0 * root)
    along, beside, both = (along + root) / size, (beside + root) / size, both / size
    return (
        along * right[0] + both * up[0],
        along * right[1] + both * up[1],
        both * right[0] + beside * up[0],
        both * right[1] + beside * up[1],
    )


@kernel(allocates=False)
def slanted_parts(side: Vec2) -> int:
    """Return one of the two numbers of parts of `sampled_mean`, which GLSL computes as a vector; at most too many."""
    slant = (1.0 - LEVEL_BIAS) * math.sqrt(abs(side[0] * side[1])) / SLANTED_PART
    return max(math.ceil(slant), 1) if slant <= MOST_SPLINE_BOXES else MOST_SPLINE_BOXES + 1


@kernel(allocates=False)
def sampled_mean(
    texels: Texels, level: VextureLevel, sampling: int, middle: Vec2, right: Vec2, up: Vec2, share: float
) -> Vec4:
    """Mean of a picture of any sampling, 0..255; other parameters as of `picture_mean`."""
    parts = (slanted_parts(right), slanted_parts(up))
    a, b = (right[0] / parts[0], right[1] / parts[0]), (up[0] / parts[1], up[1] / parts[1])
    sides = (math.sqrt(a[0] * a[0] + b[0] * b[0]), math.sqrt(a[1] * a[1] + b[1] * b[1]))
    number = parts[0] * parts[1]
    is_small = number <= MOST_SPLINE_BOXES and (1.0 - LEVEL_BIAS) * max(sides[0], sides[1]) <= WIDEST_SPLINE_BOX
    if is_small and sampling >= OPACITY:
        sides, sum = (max(sides[0], LEAST_SPLINE_BOX), max(sides[1], LEAST_SPLINE_BOX)), 0.0
        for k in range(number):
            x, y = k % parts[0] + 0.5 - 0.5 * parts[0], k // parts[0] + 0.5 - 0.5 * parts[1]
            place = (middle[0] + x * a[0] + y * b[0], middle[1] + x * a[1] + y * b[1])
            sum += box_mean(texels, level, place, sides)
        return sum / number, 0.0, 0.0, 0.0
    if sampling >= SPLINE:
        wide = widen(right, up)
        right, up = (wide[0], wide[1]), (wide[2], wide[3])
    return picture_mean(texels, level, sampling != PIXELS, middle, right, up, share)


@kernel(allocates=False)
def flat_color(word: int, value: float, sampling: int) -> Vec4:
    """Premultiplied colour, 0..255, of a picture of opacities, from the word with its colour: part of `picture`."""
    red, green, blue, _ = pixel(word)
    opacity = COVERAGE_ONE - value if sampling == INVERSE else value
    return times((red / COVERAGE_ONE, green / COVERAGE_ONE, blue / COVERAGE_ONE, 1.0), opacity)
