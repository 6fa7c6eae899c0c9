"""The mirror of ``shaders/tree.glsl``: positions, and the descent to the cells (see `vexture.renderers.cpu`)."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import (
    COUNT_SHIFT,
    COVERAGE_ONE,
    MOST_CURVES,
    MOST_DEPTH,
    QUAD_FLAG,
    ROW_BITS,
)
from vexture.renderers.method import (
    FARTHEST,
    FOLLOWED_QUADS,
    FURTHER,
    LEAST_FINEST,
    LEVEL_BIAS,
    LONG,
    NO_CELL,
    POSITION_BITS,
    REST_BITS,
    SMALL_FINEST,
)

Texels = NDArray[np.uint32]
Vec2 = tuple[float, float]
Whole2 = tuple[int, int]
Texel = tuple[int, int, int, int]


class VexturePlace(NamedTuple):
    """A point and the bounding box of the pixel around it."""

    point: Whole2
    rest: Vec2
    low: Whole2
    high: Whole2


class VextureCell(NamedTuple):
    """A leaf, given by its byte in a quad's texel; or a quad."""

    quad: int
    texel: Texel
    shift: int
    bit: int
    is_quad: bool


class VextureSquare(NamedTuple):
    """A square of cells, given by its lowest position in a pixel's box."""

    position: Whole2
    bit: int


class VextureTop(NamedTuple):
    """Start of a descent of the tree."""

    quad: int
    bit: int
    followed: int


@kernel(allocates=False)
def clamp(value: float, low: float, high: float) -> float:
    """Clamp a value to bounds."""
    return min(max(value, low), high)


@kernel(allocates=False)
def texel(texels: Texels, index: int) -> Texel:
    """Read a texel; clamp an index outside the texture, where a GPU may return anything, to the last row or column."""
    index &= 0xFFFFFFFF
    row = min(index >> ROW_BITS, texels.shape[0] - 1)
    column = min(index & ((1 << ROW_BITS) - 1), texels.shape[1] - 1)
    found = texels[row, column]
    return int(found[0]), int(found[1]), int(found[2]), int(found[3])


@kernel(allocates=False)
def place(base: Whole2, offset: Vec2, extent: Vec2) -> VexturePlace:
    """Position of a pixel and the box around it."""
    x, rest_x, low_x, high_x = place_coordinate(base[0], offset[0], extent[0])
    y, rest_y, low_y, high_y = place_coordinate(base[1], offset[1], extent[1])
    return VexturePlace((x, y), (rest_x, rest_y), (low_x, low_y), (high_x, high_y))


@kernel(allocates=False)
def place_coordinate(base: int, offset: float, extent: float) -> tuple[int, float, int, int]:
    """One coordinate of `place`, which GLSL computes with vectors."""
    spare = 32 - POSITION_BITS + REST_BITS
    one = float(1 << REST_BITS)
    scaled = clamp(offset, -FARTHEST, FARTHEST) * (float(1 << POSITION_BITS) / one)
    whole = math.floor(scaled)
    point = ((base >> spare) + int(whole)) << REST_BITS
    rest = (scaled - whole) * one + (base & ((1 << spare) - 1)) * (one / float(1 << spare))
    square = float(1 << POSITION_BITS)
    is_far = abs(offset) * square - square > extent
    extent = min(extent, FARTHEST * square)
    last = -1 if is_far else (1 << POSITION_BITS) - 1
    low = max(point + math.floor(rest - extent), 0)
    high = min(point + math.ceil(rest + extent) - 1, last)
    return point, rest, low, high


@kernel(allocates=False)
def first_square(place: VexturePlace) -> VextureSquare:
    """Smallest cell that contains the whole box of a place."""
    low, high = place.low, place.high
    differ = (low[0] ^ high[0]) | (low[1] ^ high[1])
    is_inside = low[0] <= high[0] and low[1] <= high[1]
    bit = max(math.frexp(float(differ))[1], POSITION_BITS - MOST_DEPTH)
    return VextureSquare((low[0] if is_inside else NO_CELL, low[1]), bit)


@kernel(allocates=False)
def next_square(position: Whole2, beyond: Whole2, place: VexturePlace) -> VextureSquare:
    """Next square of cells that meets the box."""
    low, high = place.low, place.high
    step_x = beyond[0] & -beyond[0] if beyond[0] <= high[0] else NO_CELL
    step_y = beyond[1] & -beyond[1] if beyond[1] <= high[1] else NO_CELL
    least = min(step_x, step_y)
    x, y = max(position[0] & -(step_y + step_y), low[0]), beyond[1]
    if step_x <= step_y:
        x, y = beyond[0], max(position[1] & -step_x, low[1])
    return VextureSquare((x if least < NO_CELL else NO_CELL, y), math.frexp(float(least))[1] - 1)


@kernel(allocates=False)
def bit_of(area: float) -> int:
    return (math.frexp(area * (1.0 - LEVEL_BIAS))[1] - 1) >> 1


@kernel(allocates=False)
def finest_bit(area: float, longer: float) -> int:
    """Bit of the smallest cells that the sum over cells visits."""
    finest = bit_of(max(area * (area / longer), longer * LONG)) - 1
    finest -= 1 if finest > POSITION_BITS - SMALL_FINEST else 0
    return min(max(finest, POSITION_BITS - MOST_DEPTH), POSITION_BITS - LEAST_FINEST)


@kernel(allocates=False)
def top(root: int) -> VextureTop:
    """Start of all descents of a shape."""
    return VextureTop(root, POSITION_BITS, root + FOLLOWED_QUADS)


@kernel(allocates=False)
def descend(
    texels: Texels, top: VextureTop, shared: int, finest: int, position: Whole2
) -> tuple[VextureCell, VextureTop]:
    """Descend to the cell at a position; also return the new `top`, which GLSL changes in place."""
    quad, bit = top.quad, top.bit
    found = texel(texels, quad)
    shift = 0
    is_quad = True
    while is_quad and bit > (finest - FURTHER if quad < top.followed else finest):
        bit -= 1
        shift = ((position[0] >> bit) & 1) * 8 + ((position[1] >> bit) & 1) * 16
        is_quad = ((found[2] >> shift) & QUAD_FLAG) != 0
        if is_quad:
            before = (found[2] >> 7) & 0x010101 & ((1 << shift) - 1)
            quad = found[0] + ((before * 0x010101 >> 16) & 3)
            found = texel(texels, quad)
            if bit == shared:
                top = VextureTop(quad, bit, top.followed)
    return VextureCell(quad, found, shift, bit, is_quad), top


@kernel(allocates=False)
def stored_coverage(cell: VextureCell) -> float:
    """Coverage from the cell's byte."""
    return ((cell.texel[3] >> cell.shift) & 255) / COVERAGE_ONE


@kernel(allocates=False)
def count(cell: VextureCell) -> int:
    """Number of pieces of the leaf."""
    return (cell.texel[2] >> (cell.shift + COUNT_SHIFT)) & MOST_CURVES


@kernel(allocates=False)
def winding_code(cell: VextureCell) -> int:
    """Corner winding of the leaf plus `WINDING_OFFSET`; 0 marks a constant leaf."""
    return (cell.texel[2] >> cell.shift) & 7


@kernel(allocates=False)
def first_curve(cell: VextureCell) -> int:
    """Index of the texel of the leaf's first piece."""
    before = (cell.texel[2] >> COUNT_SHIFT) & 0x0F0F0F & ((1 << cell.shift) - 1)
    return cell.texel[1] + ((before * 0x010101 >> 16) & 255)
