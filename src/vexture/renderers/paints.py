"""The mirror of ``glsl/paints.glsl`` and ``glsl/srgb.glsl``: the paints of a planar map, and a sum of them.

See `vexture.renderers.cpu`. `is_linear` is what ``VEXTURE_LINEAR`` is in the shader.
"""

from typing import NamedTuple

from vexture.kernels import kernel
from vexture.layout import COVERAGE_ONE, MOST_BYTE_PAINTS, MOST_HALF_PAINTS
from vexture.renderers.cells import Cell, Texel, Texels, Vec2, Whole2, clamp, texel
from vexture.renderers.gradient import Region, Vec3, Vec4, halves, plus, program, times
from vexture.renderers.method import LEAST_SHARE

__all__ = [
    "Planar",
    "Sum",
    "add_paint",
    "add_piece",
    "base_paint",
    "has_room",
    "mean_color",
    "means_at",
    "nothing",
    "numbered",
    "planar",
    "settle",
    "unpacked",
]


class Planar(NamedTuple):
    """Where the parts of a planar map begin."""

    root: int
    cells: int
    sides: int
    paints: int
    packing: int


@kernel(allocates=False)
def linear(encoded: Vec3) -> Vec3:
    """Linear components of sRGB (IEC 61966-2-1)."""
    return linear_component(encoded[0]), linear_component(encoded[1]), linear_component(encoded[2])


@kernel(allocates=False)
def linear_component(encoded: float) -> float:
    """One component of what GLSL computes as vectors."""
    return encoded / 12.92 if encoded <= 0.04045 else ((encoded + 0.055) / 1.055) ** 2.4


@kernel(allocates=False)
def planar(texels: Texels, root: int) -> Planar:
    """Where the parts of the map with a root quad begin."""
    head = texel(texels, root - 1)
    packing = 0 if head[0] > MOST_HALF_PAINTS else 1 if head[0] > MOST_BYTE_PAINTS else 2
    return Planar(root, 0 + head[1], 0 + head[2], 0 + head[3], packing)  # of 64 bits


@kernel(allocates=False)
def means_at(planar: Planar, quad: int) -> int:
    """The texel of the means of a quad's cells."""
    place = quad - planar.root
    return planar.cells + 1 + place + (place >> planar.packing)


@kernel(allocates=False)
def numbered(planar: Planar, word: int, place: int) -> int:
    """The number at a place among others that fill words, of which `word` is that of the place."""
    bits = 32 >> planar.packing
    return 0 + (word >> (bits * (place & ((1 << planar.packing) - 1)))) & (0xFFFFFFFF >> (32 - bits))  # of 64 bits


@kernel(allocates=False)
def base_paint(texels: Texels, planar: Planar, cell: Cell) -> int:
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
def paint(texels: Texels, is_linear: int, planar: Planar, number: int, region: Region) -> Vec4:
    both = texel(texels, planar.paints + (number >> 1))
    low, high = (both[0], both[1]) if number & 1 == 0 else (both[2], both[3])
    color = halves((low, high))
    if low != 0 and color[3] == 0.0:
        color = program(texels, low, high, region)
    return averaged(is_linear, color)


class Sum(NamedTuple):
    """The colours of a pixel, times their areas; of `paints` whose colours are not added yet, areas and moments."""

    color: Vec4
    paints: tuple[int, int, int, int]
    areas: Vec4
    across: Vec4
    up: Vec4


@kernel(allocates=False)
def nothing() -> Sum:
    """The empty sum."""
    none = (0.0, 0.0, 0.0, 0.0)
    return Sum(none, (0, 0, 0, 0), none, none, none)


@kernel(allocates=False)
def taken(sum: Sum) -> tuple[bool, bool, bool, bool]:
    areas, across, up = sum.areas, sum.across, sum.up
    return (
        abs(areas[0]) + abs(across[0]) + abs(up[0]) > LEAST_SHARE,
        abs(areas[1]) + abs(across[1]) + abs(up[1]) > LEAST_SHARE,
        abs(areas[2]) + abs(across[2]) + abs(up[2]) > LEAST_SHARE,
        abs(areas[3]) + abs(across[3]) + abs(up[3]) > LEAST_SHARE,
    )


@kernel(allocates=False)
def waits(sum: Sum) -> bool:
    a, b, c, d = taken(sum)
    return a or b or c or d


@kernel(allocates=False)
def has_room(sum: Sum) -> bool:
    """Whether there is room for the two paints beside a piece."""
    number = 0
    for one in taken(sum):
        number += 1 if one else 0
    return number < 3


@kernel(allocates=False)
def added(values: Vec4, at: int, value: float) -> Vec4:
    """Four values, to one of which GLSL adds in place."""
    a, b = values[0] + (value if at == 0 else 0.0), values[1] + (value if at == 1 else 0.0)
    return a, b, values[2] + (value if at == 2 else 0.0), values[3] + (value if at == 3 else 0.0)


@kernel(allocates=False)
def add_paint(sum: Sum, planar: Planar, paint: int, share: Vec3, region: Region) -> Sum:
    """Return the new `sum`, which GLSL changes in place, as with ``VEXTURE_GRADIENTS``."""
    (a, b, c, d), is_taken = sum.paints, taken(sum)
    free, same = 0, -1
    for slot in range(4):
        free = free if is_taken[slot] else slot
        same = slot if is_taken[slot] and sum.paints[slot] == paint else same
    at = free if same < 0 else same
    a, b = paint if at == 0 else a, paint if at == 1 else b
    c, d = paint if at == 2 else c, paint if at == 3 else d
    areas, across = added(sum.areas, at, share[0]), added(sum.across, at, share[1])
    return Sum(sum.color, (a, b, c, d), areas, across, added(sum.up, at, share[2]))


@kernel(allocates=False)
def add_piece(sum: Sum, planar: Planar, sides: Whole2, share: Vec3, region: Region) -> Sum:
    """Return the sum with the paint on the left of a piece, less that on its right."""
    sum = add_paint(sum, planar, sides[0], share, region)
    return add_paint(sum, planar, sides[1], (-share[0], -share[1], -share[2]), region)


@kernel(allocates=False)
def part(region: Region, place: Vec2) -> Region:
    point, right, up = region.point, region.right, region.up
    x, y = clamp(place[0], -0.5, 0.5), clamp(place[1], -0.5, 0.5)
    share_x, share_y = 1.0 - 2.0 * abs(x), 1.0 - 2.0 * abs(y)
    middle = (point[0] + x * (abs(right[0]) + abs(up[0])), point[1] + y * (abs(right[1]) + abs(up[1])))
    return Region(middle, (right[0] * share_x, right[1] * share_y), (up[0] * share_x, up[1] * share_y))


@kernel(allocates=False)
def settle(texels: Texels, is_linear: int, sum: Sum, planar: Planar, region: Region) -> Sum:
    """Return the sum with the colours of its paints added."""
    if not waits(sum):
        return sum
    color = sum.color
    for slot in range(4):
        area = sum.areas[slot]
        if area != 0.0:
            here = part(region, (sum.across[slot] / area, sum.up[slot] / area))
            color = plus(color, paint(texels, is_linear, planar, sum.paints[slot], here), area)
    none = (0.0, 0.0, 0.0, 0.0)
    return Sum(color, sum.paints, none, none, none)


@kernel(allocates=False)
def unpacked(is_linear: int, word: int) -> Vec4:
    """A stored mean, in steps of a byte."""
    red, green, blue = float(word & 255), float((word >> 8) & 255), float((word >> 16) & 255)
    return averaged(is_linear, (red, green, blue, float(word >> 24)))


@kernel(allocates=False)
def mean_color(is_linear: int, stored: Texel, place: Vec2) -> Vec4:
    """Mean of a quad about a place in its own unit square, in steps of a byte."""
    x, y = 2.0 * place[0] - 0.5, 2.0 * place[1] - 0.5
    low = plus(times(unpacked(is_linear, stored[0]), 1.0 - x), unpacked(is_linear, stored[1]), x)
    high = plus(times(unpacked(is_linear, stored[2]), 1.0 - x), unpacked(is_linear, stored[3]), x)
    found = plus(times(low, 1.0 - y), high, y)
    most = float(COVERAGE_ONE)
    red, green, blue = clamp(found[0], 0.0, most), clamp(found[1], 0.0, most), clamp(found[2], 0.0, most)
    return red, green, blue, clamp(found[3], 0.0, most)
