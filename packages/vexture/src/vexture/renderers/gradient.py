"""The mirror of ``shaders/gradient.glsl`` and ``shaders/blend.glsl``: paints that hold gradients or pictures.

See `vexture.renderers.cpu`.
"""

import math
from typing import NamedTuple

from vexture.base.kernels import kernel
from vexture.base.layout import (
    COORDINATE_BITS,
    COVERAGE_ONE,
    KIND_FOCAL,
    KIND_FOLLOWS,
    KIND_KEEP,
    KIND_LINEAR,
    KIND_MIX,
    KIND_PICTURE,
    KIND_SHIFT,
    KIND_SOLID,
    LUMINANCE_BLUE,
    LUMINANCE_GREEN,
    LUMINANCE_RED,
    MASKS,
    MOST_PROGRAM,
    MOST_STOPS,
    PAINT_ONE,
    STOP_BITS,
    STOP_COUNT_BITS,
)
from vexture.drawing.group import Blend, Mask
from vexture.drawing.paint import Spread
from vexture.renderers.blend import luminosity, mixture, saturation
from vexture.renderers.cells import Texel, Texels, Vec2, Whole2, clamp, texel
from vexture.renderers.method import (
    BLEND_PARTS,
    GREY,
    LEAST_COLOR,
    LEAST_RADIUS,
    LEAST_SHARE,
    LONGEST_RAMP,
    MOST_RAMP_PARTS,
    NEARLY_WHOLE,
    NO_PLACE,
    NOTHING,
    PICTURE_RAMP,
    PIXEL_PARTS,
    PRODUCT_PARTS,
    RAMP_BEND,
    RAMP_PARTS,
    SHORTEST_RAMP,
)
from vexture.renderers.pixels import first_level
from vexture.renderers.splines import OPACITY, flat_color, sampled_mean
from vexture.renderers.vectors import Vec3, Vec4, as_float, as_floats, plus, times

NORMAL, COLOR_BURN, HUE = int(Blend.NORMAL), int(Blend.COLOR_BURN), int(Blend.HUE)
PLUS_LIGHTER, LUMINANCE = int(Blend.PLUS_LIGHTER), int(Mask.LUMINANCE)
PAD, REFLECT = int(Spread.PAD), int(Spread.REFLECT)


class VextureRegion(NamedTuple):
    """Part of a footprint in a cell: its centre and its sides, in the unit square."""

    point: Vec2
    right: Vec2
    up: Vec2


class VextureRamp(NamedTuple):
    """A position on a ramp, its gradient in x and y, whether it exists, and the parts per side that it requires."""

    t: float
    way: Vec2
    exists: bool
    parts: Vec2


@kernel(allocates=False)
def halves(words: Whole2) -> Vec4:
    """Unpack four numbers, 0..65535, from two words."""
    mask, (low, high) = (1 << COORDINATE_BITS) - 1, words
    return float(low & mask), float(low >> COORDINATE_BITS), float(high & mask), float(high >> COORDINATE_BITS)


# --- blend.glsl ------------------------------------------------------------------------------------------------


@kernel(allocates=False)
def blended(below: Vec4, above: Vec4, mode: int) -> Vec4:
    if mode == NORMAL:
        return plus(above, below, 1.0 - above[3])
    if mode == PLUS_LIGHTER:
        red, green, blue = min(below[0] + above[0], 1.0), min(below[1] + above[1], 1.0), min(below[2] + above[2], 1.0)
        return red, green, blue, min(below[3] + above[3], 1.0)
    under, over = below[3], above[3]
    is_whole = mode >= HUE
    mixed = mixture(mode, straight_color(below, is_whole), straight_color(above, is_whole))
    red = above[0] * (1.0 - under) + below[0] * (1.0 - over) + over * under * mixed[0]
    green = above[1] * (1.0 - under) + below[1] * (1.0 - over) + over * under * mixed[1]
    blue = above[2] * (1.0 - under) + below[2] * (1.0 - over) + over * under * mixed[2]
    return red, green, blue, over + under * (1.0 - over)


@kernel(allocates=False)
def greyed(c: Vec3) -> Vec3:
    light = luminosity(c)
    return (light, light, light) if saturation(c) < GREY else c


@kernel(allocates=False)
def settled(c: float) -> float:
    return 0.0 if c < LEAST_COLOR else 1.0 if c > 1.0 - LEAST_COLOR else c


@kernel(allocates=False)
def straight_color(color: Vec4, is_whole: bool) -> Vec3:
    opacity = max(color[3], NOTHING)
    c = (settled(color[0] / opacity), settled(color[1] / opacity), settled(color[2] / opacity))
    return greyed(c) if is_whole else c


# --- gradient.glsl ---------------------------------------------------------------------------------------------


@kernel(allocates=False)
def dot(row: Vec3, point: Vec2) -> float:
    """Return ``dot(row.xy, point)`` of GLSL."""
    return row[0] * point[0] + row[1] * point[1]


@kernel(allocates=False)
def spans(way: Vec2, region: VextureRegion) -> Vec2:
    row = (way[0], way[1], 0.0)
    return abs(dot(row, region.right)), abs(dot(row, region.up))


@kernel(allocates=False)
def length(way: Vec2) -> float:
    """Mirror GLSL's built-in ``length``."""
    return math.hypot(way[0], way[1])


@kernel(allocates=False)
def along(slope: Vec2, across: Vec3, up: Vec3) -> Vec2:
    """Return ``slope.x * across.xy + slope.y * up.xy`` of GLSL."""
    return slope[0] * across[0] + slope[1] * up[0], slope[0] * across[1] + slope[1] * up[1]


@kernel(allocates=False)
def larger(a: Vec2, b: Vec2) -> Vec2:
    """Return ``max(a, b)`` of GLSL."""
    return max(a[0], b[0]), max(a[1], b[1])


@kernel(allocates=False)
def round_ramp(across: Vec3, up: Vec3, focus: Vec2, region: VextureRegion) -> VextureRamp:
    qx = dot(across, region.point) + across[2] - focus[0]
    qy = dot(up, region.point) + up[2]
    sides = larger(spans((across[0], across[1]), region), spans((up[0], up[1]), region))
    parts, most = (RAMP_PARTS * sides[0], RAMP_PARTS * sides[1]), (float(MOST_RAMP_PARTS), float(MOST_RAMP_PARTS))
    grows = 1.0 - focus[1]
    tip = focus[0] / max(grows, NOTHING) - focus[0]
    parts = most if length((qx - tip, qy)) < length(sides) else parts
    a = (focus[0] - grows) * (focus[0] + grows)
    if a >= 0.0 and grows > 0.0:
        outside = qx - tip + math.sqrt(a) / grows * abs(qy)
        qx -= max(outside, 0.0) if outside < 0.5 * MOST_RAMP_PARTS * length(sides) else 0.0
    b = focus[1] * grows - qx * focus[0]
    c = qx * qx + qy * qy - focus[1] * focus[1]
    inside = b * b - a * c
    if a >= 0.0:
        slope = (-2.0 * (b * focus[0] + a * qx), -2.0 * a * qy)
        sides = spans(along(slope, across, up), region)
        least = 0.25 * (sides[0] + sides[1])
        parts = most if inside < 4.0 * least else parts
        if inside < least:
            moved = (least - inside) / max(slope[0] * slope[0] + slope[1] * slope[1], NOTHING)
            qx, qy = qx + moved * slope[0], qy + moved * slope[1]
            b = focus[1] * grows - qx * focus[0]
            c = qx * qx + qy * qy - focus[1] * focus[1]
            inside = b * b - a * c
    root = math.sqrt(max(inside, 0.0))
    far = b - root if b < 0.0 else b + root
    first = far / a if a != 0.0 else NO_PLACE
    second = c / far if far != 0.0 else NO_PLACE
    t = max(first, second)
    t = min(first, second) if focus[1] + t * grows < -LEAST_RADIUS or t > -NO_PLACE else t
    radius = focus[1] + t * grows
    exists = radius >= -LEAST_RADIUS and t > NO_PLACE
    e = (qx + t * focus[0], qy)
    size = length(e)
    e = (e[0] / size, e[1] / size) if size > LEAST_RADIUS else (0.0, 0.0)
    down = grows - e[0] * focus[0]
    beside = spans(along((-e[1], e[0]), across, up), region)
    bend = (beside[0] * beside[0] + beside[1] * beside[1]) / 12.0
    bend /= max(math.sqrt(radius * radius + bend) + radius, NOTHING)
    ahead = spans(along(e, across, up), region)
    least_bend = math.sqrt(max(RAMP_BEND * max(radius, 0.0) * (ahead[0] + ahead[1]), NOTHING))
    parts = larger(parts, (beside[0] / least_bend, beside[1] / least_bend))
    inverse = 1.0 / down if down != 0.0 else 0.0
    way = along((inverse * e[0], inverse * e[1]), across, up)
    return VextureRamp(t + inverse * bend, way, exists, parts)


@kernel(allocates=False)
def premultiply(color: Vec4, weight: float) -> Vec4:
    """Return ``weight * vec4(color.rgb * color.a, color.a)`` of GLSL."""
    alpha = weight * color[3]
    return color[0] * alpha, color[1] * alpha, color[2] * alpha, alpha


@kernel(allocates=False)
def add_stretch(total: Vec4, color: Vec4, slope: Vec4, stretch: Vec2, edges: Vec4) -> Vec4:
    for k in range(3):
        first = edges[0] if k == 0 else edges[1] if k == 1 else edges[2]
        last = edges[1] if k == 0 else edges[2] if k == 1 else edges[3]
        low, high = clamp(first, stretch[0], stretch[1]), clamp(last, stretch[0], stretch[1])
        if high > low:
            w0, w2 = 1.0, 1.0
            if k == 0:
                w0, w2 = (low - first) / (last - first), (high - first) / (last - first)
            if k == 2:
                w0, w2 = (last - low) / (last - first), (last - high) / (last - first)
            c0, c2 = plus(color, slope, low - stretch[0]), plus(color, slope, high - stretch[0])
            c1 = premultiply(times(plus(c0, c2, 1.0), 0.5), 2.0 * (w0 + w2))
            both = plus(premultiply(c0, w0), premultiply(c2, w2), 1.0)
            total = plus(total, plus(both, c1, 1.0), (high - low) / 6.0)
    return total


@kernel(allocates=False)
def add_ramp(texels: Texels, total: Vec4, stops: int, number: int, edges: Vec4, bounds: Vec2) -> Vec4:
    before, begin = (0.0, 0.0, 0.0, 0.0), bounds[0]
    for k in range(number + 1):
        after, end = before, bounds[1]
        if k < number:
            stop = texel(texels, stops + k)
            after, end = times(halves((stop[1], stop[2])), 1.0 / PAINT_ONE), as_float(stop[0])
        before = after if k == 0 else before
        a = clamp(begin, bounds[0], bounds[1])
        b = clamp(end, a, bounds[1])
        if b > a:
            slope = times(plus(after, before, -1.0), 0.0 if k in (0, number) else 1.0 / (end - begin))
            total = add_stretch(total, plus(before, slope, a - begin), slope, (a, b), edges)
        if end >= bounds[1]:
            break
        begin, before = end, after
    return total


@kernel(allocates=False)
def spread_sum(texels: Texels, stops: int, number: int, spread: int, edges: Vec4) -> Vec4:
    pads = spread == PAD
    total, whole = (0.0, 0.0, 0.0, 0.0), 0.0 if pads else float(math.floor(edges[0]))
    for _ in range(3):
        here = (edges[0] - whole, edges[1] - whole, edges[2] - whole, edges[3] - whole)
        if spread == REFLECT and whole % 2.0 != 0.0:
            here = (1.0 - here[3], 1.0 - here[2], 1.0 - here[1], 1.0 - here[0])
        bounds = (here[0], here[3]) if pads else (clamp(here[0], 0.0, 1.0), clamp(here[3], 0.0, 1.0))
        total = add_ramp(texels, total, stops, number, here, bounds)
        whole += 1.0
        if pads or whole >= edges[3]:
            break
    return total


@kernel(allocates=False)
def ramp_mean(texels: Texels, stops: int, number: int, spread: int, middle: float, spans: Vec2) -> Vec4:
    pads, least = spread == PAD, 0.0 if spread == PAD else SHORTEST_RAMP
    first, second = clamp(spans[0], least, LONGEST_RAMP), clamp(spans[1], least, LONGEST_RAMP)
    period = 2.0 if spread == REFLECT else 1.0
    whole_first = 0.0 if pads else period * math.floor(first / period + 0.5)
    whole_second = 0.0 if pads else period * math.floor(second / period + 0.5)
    share = (1.0 - whole_first / max(first, NOTHING)) * (1.0 - whole_second / max(second, NOTHING))
    first, second = abs(first - whole_first), abs(second - whole_second)
    mean = (0.0, 0.0, 0.0, 0.0)
    if abs(share) >= 1.0 - NEARLY_WHOLE:
        wide, narrow = max(max(first, second), SHORTEST_RAMP), min(first, second)
        place = clamp(middle, -wide - narrow, 1.0 + wide + narrow)
        if not pads:
            place = (middle % 2.0 - 0.5 * ((whole_first + whole_second) % 4.0)) % 2.0
        outer, inner = 0.5 * (wide + narrow), 0.5 * (wide - narrow)
        edges = (place - outer, place - inner, place + inner, place + outer)
        size = 0.5 * (edges[3] - edges[0] + edges[2] - edges[1])
        mean = times(spread_sum(texels, stops, number, spread, edges), 1.0 / size)
    if whole_first != 0.0 or whole_second != 0.0:
        full = add_ramp(texels, (0.0, 0.0, 0.0, 0.0), stops, number, (0.0, 0.0, 1.0, 1.0), (0.0, 1.0))
        mean = plus(times(full, 1.0 - share), mean, share)
    return mean


@kernel(allocates=False)
def gradient_ramp(texels: Texels, at: int, record: Texel, region: VextureRegion) -> VextureRamp:
    kind, across, focus = record[3] >> KIND_SHIFT, as_floats(record), (0.0, 0.0)
    if kind == KIND_LINEAR:
        return VextureRamp(dot(across, region.point) + across[2], (across[0], across[1]), True, (0.0, 0.0))
    if kind == KIND_FOCAL:
        circle = as_floats(texel(texels, at + 2))
        focus = (circle[0], circle[1])
    return round_ramp(across, as_floats(texel(texels, at + 1)), focus, region)


@kernel(allocates=False)
def gradient(texels: Texels, at: int, record: Texel, number: int, region: VextureRegion) -> Vec4:
    found = gradient_ramp(texels, at, record, region)
    stops = at + (record[3] & ((1 << STOP_BITS) - 1))
    spread = (record[3] >> (STOP_BITS + STOP_COUNT_BITS)) & 3
    if not found.exists:
        return 0.0, 0.0, 0.0, 0.0
    return ramp_mean(texels, stops, number, spread, found.t, spans(found.way, region))


@kernel(allocates=False)
def picture_region(texels: Texels, at: int, region: VextureRegion) -> VextureRegion:
    across, down = as_floats(texel(texels, at + 1)), as_floats(texel(texels, at + 2))
    point = (dot(across, region.point) + across[2], dot(down, region.point) + down[2])
    right = (dot(across, region.right), dot(down, region.right))
    return VextureRegion(point, right, (dot(across, region.up), dot(down, region.up)))


@kernel(allocates=False)
def picture(texels: Texels, at: int, record: Texel, region: VextureRegion, share: float) -> Vec4:
    mask = (1 << COORDINATE_BITS) - 1
    size = (max(0 + (record[1] & mask), 1), max(0 + (record[1] >> COORDINATE_BITS), 1))  # of 64 bits
    sampling, pixels = record[3] & 7, picture_region(texels, at, region)
    level = first_level(size, 0 + at + record[2], sampling >= OPACITY)
    opacity = (record[0] & mask) / PAINT_ONE / COVERAGE_ONE
    mean = sampled_mean(texels, level, sampling, pixels.point, pixels.right, pixels.up, share)
    return times(flat_color(texel(texels, at + 1)[3], mean[0], sampling) if sampling >= OPACITY else mean, opacity)


@kernel(allocates=False)
def ended(kept: Vec4, color: Vec4, how: int) -> Vec4:
    if how < MASKS:
        return blended(kept, color, how)
    luminance = LUMINANCE_RED * color[0] + LUMINANCE_GREEN * color[1] + LUMINANCE_BLUE * color[2]
    return times(kept, luminance if how == MASKS + LUMINANCE else color[3])


@kernel(allocates=False)
def program_part(texels: Texels, at: int, end: int, region: VextureRegion, share: float) -> Vec4:
    nothing = (0.0, 0.0, 0.0, 0.0)
    color, kept, kept_before, kept_first = nothing, nothing, nothing, nothing
    left = MOST_STOPS
    for k in range(at, end):
        found = texel(texels, k)
        kind = found[3] >> KIND_SHIFT
        if kind == KIND_KEEP:
            kept_first, kept_before, kept, color = kept_before, kept, color, nothing
        elif kind == KIND_MIX:
            color = ended(kept, times(color, found[0] / PAINT_ONE), found[1])
            kept, kept_before = kept_before, kept_first
        elif kind != KIND_FOLLOWS:
            above = times(halves((found[0], found[1])), 1.0 / PAINT_ONE)
            if kind == KIND_PICTURE:
                above = picture(texels, k, found, region, share)
            elif kind != KIND_SOLID:
                number = min(max((found[3] >> STOP_BITS) & MOST_STOPS, 1), max(left, 1))
                left -= min(number, left)
                above = gradient(texels, k, found, number, region)
            color = plus(above, color, 1.0 - above[3])
    return color


@kernel(allocates=False)
def program_parts(texels: Texels, at: int, end: int, region: VextureRegion, area: float) -> Whole2:
    bends, ramps, factors, for_each = (0.0, 0.0), (0.0, 0.0), 0, float(PRODUCT_PARTS)
    for k in range(at, end):
        found = texel(texels, k)
        kind = found[3] >> KIND_SHIFT
        if kind == KIND_MIX:
            factors += 0 if found[1] == NORMAL else 2
            for_each = float(BLEND_PARTS) if COLOR_BURN < found[1] < MASKS else for_each
        elif KIND_LINEAR <= kind <= KIND_FOCAL:
            factors, place = factors + 1, gradient_ramp(texels, k, found, region)
            bends, ramps = larger(bends, place.parts), larger(ramps, spans(place.way, region))
        elif kind == KIND_PICTURE:
            factors, pixels = factors + 1, picture_region(texels, k, region)
            ramps = larger(ramps, (PICTURE_RAMP * length(pixels.right), PICTURE_RAMP * length(pixels.up)))
    parts = larger(bends, (for_each * ramps[0], for_each * ramps[1])) if factors > 1 else bends
    most = math.ceil(clamp(PIXEL_PARTS * math.sqrt(abs(area)), 1.0, float(MOST_RAMP_PARTS)))
    return math.ceil(clamp(parts[0], 1.0, most)), math.ceil(clamp(parts[1], 1.0, most))


@kernel(allocates=False)
def program(texels: Texels, at: int, count: int, region: VextureRegion, area: float) -> Vec4:
    """Premultiplied mean colour of a program over a region with area `area` of a pixel, 0..65535."""
    end = at + min(count, MOST_PROGRAM)
    across, high = program_parts(texels, at, end, region, area)
    right, up = (region.right[0] / across, region.right[1] / across), (region.up[0] / high, region.up[1] / high)
    total, share = (0.0, 0.0, 0.0, 0.0), max(abs(area), LEAST_SHARE) / (across * high)
    for k in range(across * high):
        x, y = k % across + 0.5 - 0.5 * across, k // across + 0.5 - 0.5 * high
        point = (region.point[0] + x * right[0] + y * up[0], region.point[1] + x * right[1] + y * up[1])
        total = plus(total, program_part(texels, at, end, VextureRegion(point, right, up), share), 1.0)
    return times(total, PAINT_ONE / (across * high))
