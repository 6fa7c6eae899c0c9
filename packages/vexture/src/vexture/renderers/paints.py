"""The mirror of ``shaders/paints.glsl`` and ``shaders/srgb.glsl``: the paints of a planar map and their sum.

See `vexture.renderers.cpu`. `is_linear` corresponds to ``VEXTURE_LINEAR`` in the shader.
"""

import math
from typing import NamedTuple

from vexture.base.kernels import kernel
from vexture.base.layout import COVERAGE_ONE, MOST_BYTE_PAINTS, MOST_HALF_PAINTS
from vexture.renderers.cells import Texel, Texels, Vec2, VextureCell, Whole2, clamp, texel
from vexture.renderers.gradient import VextureRegion, halves, program
from vexture.renderers.method import LEAST_SHARE, NEARLY_WHOLE, NO_SHARE, NOTHING
from vexture.renderers.moment import VextureShare, area_share, plus_share
from vexture.renderers.vectors import Vec3, Vec4, plus, times


class VexturePlanar(NamedTuple):
    """First texel of each part of a planar map."""

    root: int
    cells: int
    sides: int
    paints: int
    packing: int


@kernel(allocates=False)
def linear(encoded: Vec3) -> Vec3:
    """Convert sRGB components to linear ones (IEC 61966-2-1)."""
    return linear_component(encoded[0]), linear_component(encoded[1]), linear_component(encoded[2])


@kernel(allocates=False)
def linear_component(encoded: float) -> float:
    """One component of `linear`, which GLSL computes with vectors."""
    return encoded / 12.92 if encoded <= 0.04045 else ((encoded + 0.055) / 1.055) ** 2.4


@kernel(allocates=False)
def planar(texels: Texels, root: int) -> VexturePlanar:
    """Read the head of the map with root quad `root`."""
    head = texel(texels, root - 1)
    packing = 0 if head[0] > MOST_HALF_PAINTS else 1 if head[0] > MOST_BYTE_PAINTS else 2
    return VexturePlanar(root, 0 + head[1], 0 + head[2], 0 + head[3], packing)  # of 64 bits


@kernel(allocates=False)
def means_at(planar: VexturePlanar, quad: int) -> int:
    """Index of the texel with the means of a quad's cells."""
    place = quad - planar.root
    return planar.cells + 1 + place + (place >> planar.packing)


@kernel(allocates=False)
def numbered(planar: VexturePlanar, word: int, place: int) -> int:
    """Number at a place in a sequence of packed numbers; `word` is the word that contains it."""
    bits = 32 >> planar.packing
    return 0 + (word >> (bits * (place & ((1 << planar.packing) - 1)))) & (0xFFFFFFFF >> (32 - bits))  # of 64 bits


@kernel(allocates=False)
def base_paint(texels: Texels, planar: VexturePlanar, cell: VextureCell) -> int:
    """Number of the base paint of a leaf."""
    place, packing = cell.quad - planar.root, planar.packing
    block = place >> packing
    numbers = texel(texels, planar.cells + (block << packing) + block)
    k = 4 * place + (cell.shift >> 3)
    return numbered(planar, numbers[(k >> packing) & 3], k)


@kernel(allocates=False)
def averaged(is_linear: int, stored: Vec4) -> Vec4:
    if not is_linear:
        return stored
    alpha = max(stored[3], 1.0)
    red, green, blue = min(stored[0] / alpha, 1.0), min(stored[1] / alpha, 1.0), min(stored[2] / alpha, 1.0)
    red, green, blue = linear((red, green, blue))
    return red * stored[3], green * stored[3], blue * stored[3], stored[3]


@kernel(allocates=False)
def paint_words(texels: Texels, planar: VexturePlanar, number: int) -> Whole2:
    both = texel(texels, planar.paints + (number >> 1))
    return (0 + both[0], 0 + both[1]) if number & 1 == 0 else (0 + both[2], 0 + both[3])  # of 64 bits


@kernel(allocates=False)
def is_program(words: Whole2) -> bool:
    return words[0] != 0 and words[1] >> 16 == 0


class VextureSum(NamedTuple):
    """Sum of a pixel's colours times their areas, and the shares of programs whose colours are not added yet."""

    color: Vec4
    kept: int
    kept_share: VextureShare
    done: int
    is_left: bool
    cell: float
    paints: tuple[int, int, int, int]
    areas: Vec4
    x: Vec4
    y: Vec4
    xx: Vec4
    xy: Vec4
    yy: Vec4


@kernel(allocates=False)
def nothing() -> VextureSum:
    """Empty sum."""
    none = (0.0, 0.0, 0.0, 0.0)
    return VextureSum(none, 0, area_share(0.0), 0, False, 0.0, (0, 0, 0, 0), none, none, none, none, none, none)


@kernel(allocates=False)
def replace_state(
    sum: VextureSum, color: Vec4, kept_paint: int, kept_share: VextureShare, done: int, is_left: bool, cell: float
) -> VextureSum:
    """Return the sum with the same four paints and these new values."""
    paints, areas, x, y, xx, xy, yy = sum.paints, sum.areas, sum.x, sum.y, sum.xx, sum.xy, sum.yy
    return VextureSum(color, kept_paint, kept_share, done, is_left, cell, paints, areas, x, y, xx, xy, yy)


@kernel(allocates=False)
def set_component(values: Vec4, at: int, value: float) -> Vec4:
    """Set one of four values, as GLSL does in place."""
    a, b = value if at == 0 else values[0], value if at == 1 else values[1]
    return a, b, value if at == 2 else values[2], value if at == 3 else values[3]


@kernel(allocates=False)
def with_color(sum: VextureSum, color: Vec4, share: float) -> VextureSum:
    """Return the sum plus `share` times a colour."""
    found = plus(sum.color, color, share)
    return replace_state(sum, found, sum.kept, sum.kept_share, sum.done, sum.is_left, sum.cell)


@kernel(allocates=False)
def slot(sum: VextureSum, paint: int) -> int:
    best = 0
    for place in range(4):
        if sum.paints[place] == paint:
            return place
        if sum.paints[best] != 0 and (sum.paints[place] == 0 or sum.paints[place] > sum.paints[best]):
            best = place
    return best if sum.paints[best] == 0 or sum.paints[best] > paint else 4


@kernel(allocates=False)
def add_program(sum: VextureSum, paint: int, share: VextureShare) -> VextureSum:
    """Add a program's share; return the new `sum`, which GLSL changes in place."""
    at = slot(sum, paint)
    if at == 4:
        return replace_state(sum, sum.color, sum.kept, sum.kept_share, sum.done, True, sum.cell)
    (a, b, c, d), is_new = sum.paints, sum.paints[at] != paint
    kept = 0.0 if is_new else 1.0
    is_left = sum.is_left or (is_new and sum.paints[at] != 0)
    a, b, c, d = paint if at == 0 else a, paint if at == 1 else b, paint if at == 2 else c, paint if at == 3 else d
    return VextureSum(
        sum.color,
        sum.kept,
        sum.kept_share,
        sum.done,
        is_left,
        sum.cell,
        (a, b, c, d),
        set_component(sum.areas, at, kept * sum.areas[at] + share.area),
        set_component(sum.x, at, kept * sum.x[at] + share.x),
        set_component(sum.y, at, kept * sum.y[at] + share.y),
        set_component(sum.xx, at, kept * sum.xx[at] + share.xx),
        set_component(sum.xy, at, kept * sum.xy[at] + share.xy),
        set_component(sum.yy, at, kept * sum.yy[at] + share.yy),
    )


@kernel(allocates=False)
def add_paint(
    texels: Texels, is_linear: int, sum: VextureSum, planar: VexturePlanar, paint: int, share: VextureShare
) -> VextureSum:
    """Add a paint's share, as with ``VEXTURE_GRADIENTS``; return the new `sum`, which GLSL changes in place."""
    if paint <= sum.done:
        return sum
    a, b, c, d = sum.paints
    words = (1, 0)
    if a != paint and b != paint and c != paint and d != paint:
        words = paint_words(texels, planar, paint)
    if is_program(words):
        return add_program(sum, paint, share)
    return sum if sum.done > 0 else with_color(sum, averaged(is_linear, halves(words)), share.area)


@kernel(allocates=False)
def add_piece(
    texels: Texels, is_linear: int, sum: VextureSum, planar: VexturePlanar, sides: Whole2, share: VextureShare
) -> VextureSum:
    """Return the sum plus the paint on the left of a piece, minus the paint on its right."""
    sum = add_paint(texels, is_linear, sum, planar, sides[0], share)
    return add_paint(texels, is_linear, sum, planar, sides[1], plus_share(area_share(0.0), share, -1.0))


@kernel(allocates=False)
def holds_kept(sum: VextureSum) -> bool:
    """Return whether a program has been kept for later."""
    return sum.kept != 0


@kernel(allocates=False)
def add_kept(texels: Texels, is_linear: int, sum: VextureSum, planar: VexturePlanar) -> VextureSum:
    """Return the sum plus the kept program."""
    found = add_paint(texels, is_linear, sum, planar, sum.kept, sum.kept_share)
    return replace_state(found, found.color, 0, found.kept_share, found.done, found.is_left, NO_SHARE)


@kernel(allocates=False)
def add_base(
    texels: Texels, is_linear: int, sum: VextureSum, planar: VexturePlanar, paint: int, share: VextureShare
) -> VextureSum:
    """Return the sum plus the base paint of a cell, over the cell's part of the pixel."""
    sum = replace_state(sum, sum.color, sum.kept, sum.kept_share, sum.done, sum.is_left, share.area)
    return add_paint(texels, is_linear, sum, planar, paint, share)


@kernel(allocates=False)
def part(region: VextureRegion, share: VextureShare) -> VextureRegion:
    point, right, up = region.point, region.right, region.up
    x, y = clamp(share.x / share.area, -0.5, 0.5), clamp(share.y / share.area, -0.5, 0.5)
    xx = clamp(12.0 * (share.xx / share.area - x * x), 0.0, 3.0)
    yy = clamp(12.0 * (share.yy / share.area - y * y), 0.0, 3.0)
    most = math.sqrt(xx * yy)
    xy = clamp(12.0 * (share.xy / share.area - x * y), -most, most)
    root = math.sqrt(max(xx * yy - xy * xy, 0.0))
    inverse = 1.0 / math.sqrt(max(xx + yy + 2.0 * root, NOTHING))
    xx, xy, yy = (xx + root) * inverse, xy * inverse, (yy + root) * inverse
    return VextureRegion(
        (point[0] + x * right[0] + y * up[0], point[1] + x * right[1] + y * up[1]),
        (xx * right[0] + xy * up[0], xx * right[1] + xy * up[1]),
        (xy * right[0] + yy * up[0], xy * right[1] + yy * up[1]),
    )


@kernel(allocates=False)
def settle(texels: Texels, is_linear: int, sum: VextureSum, planar: VexturePlanar, region: VextureRegion) -> VextureSum:
    """Return the sum plus the colours of its programs; if the new `done` is not 0, more programs are left."""
    color, kept, kept_share, last = sum.color, sum.kept, sum.kept_share, sum.done
    for place in range(4):
        area, number = sum.areas[place], sum.paints[place]
        last = max(last, number)
        if number == 0 or abs(area) <= LEAST_SHARE:
            continue
        share = VextureShare(area, sum.x[place], sum.y[place], sum.xx[place], sum.xy[place], sum.yy[place])
        if abs(area - sum.cell) <= 1.0 - NEARLY_WHOLE:
            is_same, before = number == kept, kept_share
            kept_share = plus_share(share, before, 1.0 if is_same else 0.0)
            kept, number, share = number, 0 if is_same else kept, before
        if number != 0:
            words = paint_words(texels, planar, number)
            found = program(texels, words[0], words[1], part(region, share), share.area)
            color = plus(color, averaged(is_linear, found), share.area)
    done, none = last if sum.is_left else 0, (0.0, 0.0, 0.0, 0.0)
    return VextureSum(color, kept, kept_share, done, False, sum.cell, (0, 0, 0, 0), none, none, none, none, none, none)


@kernel(allocates=False)
def unpacked(is_linear: int, word: int) -> Vec4:
    """Unpack a stored mean, 0..255."""
    red, green, blue = float(word & 255), float((word >> 8) & 255), float((word >> 16) & 255)
    return averaged(is_linear, (red, green, blue, float(word >> 24)))


@kernel(allocates=False)
def mean_color(is_linear: int, stored: Texel, place: Vec2) -> Vec4:
    """Mean colour of a quad near a point of its own unit square, 0..255."""
    x, y = 2.0 * place[0] - 0.5, 2.0 * place[1] - 0.5
    low = plus(times(unpacked(is_linear, stored[0]), 1.0 - x), unpacked(is_linear, stored[1]), x)
    high = plus(times(unpacked(is_linear, stored[2]), 1.0 - x), unpacked(is_linear, stored[3]), x)
    found = plus(times(low, 1.0 - y), high, y)
    most = float(COVERAGE_ONE)
    red, green, blue = clamp(found[0], 0.0, most), clamp(found[1], 0.0, most), clamp(found[2], 0.0, most)
    return red, green, blue, clamp(found[3], 0.0, most)
