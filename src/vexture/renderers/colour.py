"""The mirror of ``glsl/colour.glsl``: the colour of a pixel from a planar map.

See `vexture.renderers.cpu`. `is_linear` is what ``VEXTURE_LINEAR`` is in the shader.
"""

import math

import numpy as np
from numpy.typing import NDArray

from vexture.kernels import kernel
from vexture.layout import COUNT_SHIFT, COVERAGE_ONE, HOLDS_PROGRAM, IS_MEAN, PAINT_ONE
from vexture.renderers.cells import (
    Cell,
    Texel,
    Texels,
    Vec2,
    Whole2,
    clamp,
    count,
    descend,
    finest_bit,
    first_square,
    next_square,
    place,
    texel,
    top,
)
from vexture.renderers.cpu import (
    Flat,
    Look,
    above_ends,
    cut_place,
    first_look,
    flat,
    flat_piece_area,
    is_beside,
    piece_area,
)
from vexture.renderers.gradient import Region, Vec4, plus, times
from vexture.renderers.leaf import leaf, leaf_piece, leaf_sides
from vexture.renderers.method import NEARLY_WHOLE, NO_CELL, POSITION_BITS
from vexture.renderers.moment import lift, moment
from vexture.renderers.paints import (
    Planar,
    Sum,
    add_paint,
    add_piece,
    base_paint,
    has_room,
    mean_color,
    means_at,
    nothing,
    planar,
    settle,
    unpacked,
)
from vexture.renderers.piece import Box, Frame, box, box_area, ends, frame, in_box, piece, view_pixel, word
from vexture.renderers.uniforms import HasTexels, uniforms_of
from vexture.renderers.view import Size, ViewLike

__all__ = ["render_cpu_colours"]


@kernel(allocates=False)
def leaf_kind(cell: Cell) -> int:
    return (cell.texel[2] >> cell.shift) & ((1 << COUNT_SHIFT) - 1)


@kernel(allocates=False)
def holds_program(cell: Cell) -> bool:
    return leaf_kind(cell) & HOLDS_PROGRAM != 0


@kernel(allocates=False)
def reads_mean(cell: Cell, share: float) -> bool:
    is_whole = holds_program(cell) and share > NEARLY_WHOLE
    return is_whole or leaf_kind(cell) == IS_MEAN


@kernel(allocates=False)
def add_whole(
    texels: Texels,
    is_linear: int,
    sum: Sum,
    planar: Planar,
    cell: Cell,
    is_mean: bool,
    place: Vec2,
    area: float,
    region: Region,
) -> Sum:
    if not cell.is_quad and not is_mean:
        return add_paint(sum, planar, base_paint(texels, planar, cell), (area, 0.0, 0.0), region)
    stored = texel(texels, means_at(planar, cell.quad))
    step = area * (PAINT_ONE / COVERAGE_ONE)
    if cell.is_quad:
        color = plus(sum.color, mean_color(is_linear, stored, place), step)
    else:
        color = plus(sum.color, unpacked(is_linear, 0 + stored[cell.shift >> 3]), step)  # of 64 bits
    return Sum(color, sum.paints, sum.areas, sum.across, sum.up)


@kernel(allocates=False)
def region(origin: Whole2, middle: Vec2, right: Vec2, up: Vec2) -> Region:
    unit = 1.0 / float(1 << POSITION_BITS)
    point = ((origin[0] + middle[0]) * unit, (origin[1] + middle[1]) * unit)
    return Region(point, (right[0] * unit, right[1] * unit), (up[0] * unit, up[1] * unit))


@kernel(allocates=False)
def flat_look(texel: Texel, box: Box) -> Look:
    p0, p3 = word(texel[0]), word(texel[3])
    r0, r3 = in_box(p0, box), in_box(p3, box)
    y0, y3 = clamp(r0[1], 0.0, 1.0), clamp(r3[1], 0.0, 1.0)
    filled = above_ends(p0, p3, y0, y3)
    right = max(r0[0], r3[0])
    filled += y0 - y3 if right <= 0.0 else 0.0
    left = min(r0[0], r3[0]) if right > 0.0 else 1.0
    return Look(filled, False, left < 1.0 and y0 != y3)


@kernel(allocates=False)
def add_flat_cell(
    texels: Texels, is_linear: int, sum: Sum, planar: Planar, cell: Cell, origin: Whole2, box: Box, inverse: float
) -> Sum:
    whole = box.size[0] * box.size[1] * inverse
    side = 2.0**-cell.bit
    x = box.way[0] + (box.part[0] + 0.5) * box.size[0]
    y = box.way[1] + (box.part[1] + 0.5) * box.size[1]
    is_mean = reads_mean(cell, min(box.size[0], box.size[1]) * side)
    here = region(origin, (x, y), (box.size[0], 0.0), (0.0, box.size[1]))
    sum = add_whole(texels, is_linear, sum, planar, cell, is_mean, (x * side, y * side), whole, here)
    pieces = leaf(cell)
    for i in range(0 if cell.is_quad or is_mean else count(cell)):
        found, pieces = leaf_piece(texels, pieces, i)
        look = flat_look(found, box)
        if look.crosses or look.filled != 0.0:
            sum = sum if has_room(sum) else settle(texels, is_linear, sum, planar, here)
            area, moved, lifted = look.filled, 0.0, lift(found, look.crosses, box)
            if look.crosses:
                one = piece(found, box)
                both = ends(one)
                more = moment(one, both)
                area, moved, lifted = area + flat_piece_area(one, both), more[0], lifted + more[1]
            beside, pieces = leaf_sides(texels, pieces, planar, i)
            sum = add_piece(sum, planar, beside, (whole * area, whole * moved, whole * lifted), here)
    return settle(texels, is_linear, sum, planar, here)


@kernel(allocates=False)
def flat_color(texels: Texels, is_linear: int, root: int, base: Whole2, offset: Vec2, view: Flat) -> Vec4:
    parts = planar(texels, root)
    there = place(base, offset, view.extent)
    square = first_square(there)
    shared = square.bit
    start = top(root)
    sum = nothing()
    while square.position[0] < NO_CELL:
        position = square.position
        cell, start = descend(texels, start, shared, view.finest, position)
        side = 1 << cell.bit
        origin = (position[0] & -side, position[1] & -side)
        local = box(origin, cell.bit, there, view.extent)
        sum = add_flat_cell(texels, is_linear, sum, parts, cell, origin, local, view.inverse)
        square = next_square(position, (origin[0] + side, origin[1] + side), there)
    return held(times(sum.color, 1.0 / PAINT_ONE))


@kernel(allocates=False)
def held(color: Vec4) -> Vec4:
    alpha = held_channel(color[3], 1.0)
    return held_channel(color[0], alpha), held_channel(color[1], alpha), held_channel(color[2], alpha), alpha


@kernel(allocates=False)
def held_channel(value: float, most: float) -> float:
    """One channel of what GLSL computes as vectors."""
    return min(value, most) if value > 0.0 else 0.0


@kernel(allocates=False)
def add_cell(
    texels: Texels, is_linear: int, sum: Sum, planar: Planar, cell: Cell, origin: Whole2, box: Box, frame: Frame
) -> Sum:
    low, size, extent = box.low, box.size, frame.extent
    whole = 1.0
    if low[0] > -extent[0] or low[1] > -extent[1] or low[0] + size[0] < extent[0] or low[1] + size[1] < extent[1]:
        whole = box_area(frame, low, size)
    place = cut_place(cell, box, frame) if cell.is_quad or holds_program(cell) else (0.5, 0.5)
    side = 2.0**cell.bit
    is_mean = reads_mean(cell, whole * frame.size / (side * side))
    part = (size[0] / (2.0 * extent[0]), size[1] / (2.0 * extent[1]))
    right = (part[0] * frame.up[1] * frame.size, -part[1] * frame.up[0] * frame.size)
    up = (-part[0] * frame.right[1] * frame.size, part[1] * frame.right[0] * frame.size)
    here = region(origin, (place[0] * side, place[1] * side), right, up)
    sum = add_whole(texels, is_linear, sum, planar, cell, is_mean, place, whole, here)
    turned = whole * math.sqrt(clamp(whole * frame.size / (size[0] * size[1]), 0.0, 1.0))
    pieces = leaf(cell)
    for i in range(count(cell) if whole > 0.0 and not cell.is_quad and not is_mean else 0):
        found, pieces = leaf_piece(texels, pieces, i)
        look = first_look(found, box)
        if look.crosses or look.filled != 0.0:
            sum = sum if has_room(sum) else settle(texels, is_linear, sum, planar, here)
            area, moved, lifted = whole * look.filled, 0.0, turned * lift(found, look.crosses, box)
            if look.crosses:
                one = piece(found, box)
                both = ends(one)
                more = moment(one, both)
                area += piece_area(found, look.turns, one, both, box, frame)
                moved, lifted = turned * more[0], lifted + turned * more[1]
            beside, pieces = leaf_sides(texels, pieces, planar, i)
            sum = add_piece(sum, planar, beside, (area, moved, lifted), here)
    return settle(texels, is_linear, sum, planar, here)


@kernel(allocates=False)
def color(texels: Texels, is_linear: int, root: int, base: Whole2, offset: Vec2, dx: Vec2, dy: Vec2) -> Vec4:
    parts = planar(texels, root)
    pixel = frame(dx, dy)
    there = place(base, offset, pixel.extent)
    square = first_square(there)
    shared = square.bit
    finest = finest_bit(pixel.size, pixel.longer)
    start = top(root)
    sum = nothing()
    beside = False
    while square.position[0] < NO_CELL:
        position, bit = square.position, square.bit
        if not beside:
            cell, start = descend(texels, start, shared, finest, position)
            bit = cell.bit
            origin = (position[0] & -(1 << bit), position[1] & -(1 << bit))
            local = box(origin, bit, there, pixel.extent)
            sum = add_cell(texels, is_linear, sum, parts, cell, origin, local, pixel)
        side = 1 << bit
        square = next_square(position, ((position[0] & -side) + side, (position[1] & -side) + side), there)
        beside = square.position[0] < NO_CELL and is_beside(square, there, pixel)
    return held(times(sum.color, 1.0 / PAINT_ONE))


# --- view_color.glsl -------------------------------------------------------------------------------------------


@kernel(allocates=False)
def view_color(
    texels: Texels,
    is_linear: int,
    flat_view: int,
    root: int,
    base: Whole2,
    to_unit: NDArray[np.float64],
    pixel: Vec2,
) -> Vec4:
    found = view_pixel(to_unit, pixel)
    if not found.seen:
        return 0.0, 0.0, 0.0, 0.0
    if flat_view:
        return flat_color(texels, is_linear, root, base, found.offset, flat(found.dx, found.dy))
    return color(texels, is_linear, root, base, found.offset, found.dx, found.dy)


@kernel(allocates=False, ahead=True)
def draw_colours(
    texels: Texels,
    is_linear: int,
    flat_view: int,
    root: int,
    base: Whole2,
    to_unit: NDArray[np.float64],
    image: NDArray[np.float32],
) -> None:
    for row in range(image.shape[0]):
        for column in range(image.shape[1]):
            pixel = (column + 0.5, row + 0.5)
            found = view_color(texels, is_linear, flat_view, root, base, to_unit, pixel)
            for c in range(4):
                image[row, column, c] = found[c]


def render_cpu_colours(
    texture: HasTexels, size: Size, view: ViewLike = None, *, root: int = 0, is_linear: bool = False
) -> NDArray[np.float32]:
    """Render one planar map of a texture as its shader would with exact arithmetic.

    `size` and `view` are as in `vexture.coverage`; `root` is the number of the map. The picture is (height, width, 4)
    float32, premultiplied, 0..1: averaged over pixels in sRGB, or, with `is_linear`, in linear light; then its
    components are linear.
    """
    uniforms = uniforms_of(texture, size, view, root)
    image = np.empty((*uniforms.size[::-1], 4), np.float32)
    is_flat, root = int(uniforms.is_flat), uniforms.quad
    draw_colours(texture.texels, int(is_linear), is_flat, root, uniforms.base, uniforms.to_unit, image)
    return image
