"""The mirror of ``shaders/feature.glsl``: the face of a planar map at a point (see `vexture.renderers.cpu`)."""

from vexture.base.kernels import kernel
from vexture.base.layout import CONTROL_OFFSET, IS_MEAN, LATTICE_BITS, MOST_DEPTH, MOST_PAINTS
from vexture.renderers.cells import Texel, Texels, Vec2, Whole2, count, descend, place, top
from vexture.renderers.leaf import leaf, leaf_piece, leaf_sides
from vexture.renderers.method import BISECTIONS, POSITION_BITS
from vexture.renderers.paints import base_paint, planar
from vexture.renderers.piece import word


@kernel(allocates=False)
def x_at(texel: Texel, y: float) -> float:
    p0, p1, p2, p3 = word(texel[0]), word(texel[1]), word(texel[2]), word(texel[3])
    x, low, high = p0[0], 0.0, 1.0
    for _ in range(BISECTIONS):
        t = 0.5 * (low + high)
        s = 1.0 - t
        a, b, c, d = s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t
        x = a * p0[0] + b * (p1[0] - CONTROL_OFFSET) + c * (p2[0] - CONTROL_OFFSET) + d * p3[0]
        if a * p0[1] + b * (p1[1] - CONTROL_OFFSET) + c * (p2[1] - CONTROL_OFFSET) + d * p3[1] <= y:
            low = t
        else:
            high = t
    return x


@kernel(allocates=False)
def counted(texel: Texel, point: Vec2) -> int:
    p0, p3 = word(texel[0]), word(texel[3])
    starts = 1 if p0[0] == 0.0 and p0[1] <= point[1] else 0
    ends = 1 if p3[0] == 0.0 and p3[1] <= point[1] else 0
    is_beside = p0[1] <= point[1] < p3[1] and min(p0[0], p3[0]) <= point[0]
    if is_beside and point[0] < max(p0[0], p3[0]):
        is_beside = x_at(texel, point[1]) <= point[0]
    return starts - ends - (1 if is_beside else 0)


@kernel(allocates=False)
def feature(texels: Texels, root: int, base: Whole2, offset: Vec2) -> int:
    """Number of the paint at a point, or -1."""
    there = place(base, offset, (1.0, 1.0))
    x, y = there.point[0] + int(there.rest[0]), there.point[1] + int(there.rest[1])
    last = (1 << POSITION_BITS) - 1
    if there.high[0] < there.low[0] or there.high[1] < there.low[1] or x != x & last or y != y & last:
        return -1
    parts = planar(texels, root)
    cell, _ = descend(texels, top(root), -1, POSITION_BITS - MOST_DEPTH, (x, y))
    if (cell.texel[2] >> cell.shift) & 255 == IS_MEAN:
        return -1
    inner, unit = (1 << cell.bit) - 1, 2.0 ** (LATTICE_BITS - cell.bit)
    point = ((x & inner) + there.rest[0] % 1.0) * unit, ((y & inner) + there.rest[1] % 1.0) * unit
    number = base_paint(texels, parts, cell)
    square, pieces = number * number, leaf(cell)
    for i in range(count(cell)):
        found, pieces = leaf_piece(texels, pieces, i)
        times = counted(found, point)
        sides, pieces = leaf_sides(texels, pieces, parts, i)
        left, right = sides
        number += times * (left - right)
        square += times * (left * left - right * right)
    return number if 0 <= number < MOST_PAINTS and number * number == square else -1
