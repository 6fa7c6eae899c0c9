"""The mirror of ``shaders/leaf.glsl``: the pieces of a planar map's leaf (see `vexture.renderers.cpu`)."""

from typing import NamedTuple

from vexture.base.kernels import kernel
from vexture.base.layout import CONTROL_OFFSET, COORDINATE_BITS, COUNT_SHIFT, MOST_CURVES, STRAIGHT
from vexture.renderers.cells import Texel, Texels, VextureCell, Whole2, texel
from vexture.renderers.paints import VexturePlanar, numbered


class VextureLeaf(NamedTuple):
    """Position of a leaf's pieces, and the texels of pieces and sides that were read last."""

    first: int
    number: int
    is_straight: bool
    at: int
    texel: Texel
    sides_at: int
    sides: Texel


@kernel(allocates=False)
def leaf(cell: VextureCell) -> VextureLeaf:
    """Position of a leaf's pieces, before any of them is read."""
    counts = (cell.texel[2] >> COUNT_SHIFT) & 0x0F0F0F & ((1 << cell.shift) - 1)
    paired = (cell.texel[2] & (STRAIGHT * 0x010101)) * MOST_CURVES
    texels = counts - ((counts >> 1) & 0x070707 & paired)
    first = cell.texel[1] + ((texels * 0x010101 >> 16) & 255)
    number = cell.texel[3] + ((counts * 0x010101 >> 16) & 255)
    is_straight = (cell.texel[2] >> cell.shift) & STRAIGHT != 0
    return VextureLeaf(first, number, is_straight, 0, cell.texel, 0, cell.texel)


@kernel(allocates=False)
def straight(ends: tuple[int, int]) -> Texel:
    start, end, first, second = ends[0], ends[1], 0, 0
    for shift in (0, COORDINATE_BITS):
        a, b = (start >> shift) & ((1 << COORDINATE_BITS) - 1), (end >> shift) & ((1 << COORDINATE_BITS) - 1)
        first += (2 * a + b + 1) // 3 + CONTROL_OFFSET << shift
        second += (a + 2 * b + 1) // 3 + CONTROL_OFFSET << shift
    return start, first & 0xFFFFFFFF, second & 0xFFFFFFFF, end


@kernel(allocates=False)
def leaf_piece(texels: Texels, leaf: VextureLeaf, i: int) -> tuple[Texel, VextureLeaf]:
    """Read piece i; also return the new `leaf`, which GLSL changes in place."""
    at = leaf.first + (i >> 1 if leaf.is_straight else i)
    if at != leaf.at:
        leaf = VextureLeaf(leaf.first, leaf.number, leaf.is_straight, at, texel(texels, at), leaf.sides_at, leaf.sides)
    found = leaf.texel
    if leaf.is_straight:
        found = straight((found[0], found[1]) if i & 1 == 0 else (found[2], found[3]))
    return found, leaf


@kernel(allocates=False)
def leaf_sides(texels: Texels, leaf: VextureLeaf, planar: VexturePlanar, i: int) -> tuple[Whole2, VextureLeaf]:
    """Read the paints on the left and on the right of piece i; also return the new `leaf`."""
    place, packing = 2 * (leaf.number + i), planar.packing
    at = planar.sides + (place >> (2 + packing))
    if at != leaf.sides_at:
        leaf = VextureLeaf(leaf.first, leaf.number, leaf.is_straight, leaf.at, leaf.texel, at, texel(texels, at))
    left, right = leaf.sides[(place >> packing) & 3], leaf.sides[((place + 1) >> packing) & 3]
    return (numbered(planar, left, place), numbered(planar, right, place + 1)), leaf
