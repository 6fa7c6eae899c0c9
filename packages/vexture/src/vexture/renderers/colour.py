"""The mirror of ``shaders/colour.glsl``: the colour of a pixel from a planar map.

See `vexture.renderers.cpu`. `is_linear` corresponds to ``VEXTURE_LINEAR`` in the shader.
"""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import COUNT_SHIFT, COVERAGE_ONE, HOLDS_PROGRAM, IS_MEAN, PAINT_ONE
from vexture.renderers.cells import (
    Texel,
    Texels,
    Vec2,
    VextureCell,
    VexturePlace,
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
from vexture.renderers.cpu import VextureLook, above_ends, cut_place, first_look, is_beside, piece_area
from vexture.renderers.flat import VextureFlat, flat, flat_piece_area
from vexture.renderers.gradient import VextureRegion
from vexture.renderers.leaf import leaf, leaf_piece, leaf_sides
from vexture.renderers.method import NEARLY_WHOLE, NO_CELL, POSITION_BITS
from vexture.renderers.moment import (
    VextureShare,
    area_share,
    box_share,
    flat_ends_share,
    flat_piece_share,
    moved_share,
    piece_share,
    plus_share,
    whole_share,
)
from vexture.renderers.paints import (
    VexturePlanar,
    VextureSum,
    add_base,
    add_kept,
    add_piece,
    base_paint,
    holds_kept,
    mean_color,
    means_at,
    nothing,
    planar,
    settle,
    unpacked,
    with_color,
)
from vexture.renderers.piece import VextureBox, VextureFrame, box, ends, frame, in_box, piece, view_pixel, word
from vexture.renderers.uniforms import HasTexels, uniforms_of
from vexture.renderers.vectors import Vec4, times
from vexture.renderers.view import Size, ViewLike


@kernel(allocates=False)
def leaf_kind(cell: VextureCell) -> int:
    return (cell.texel[2] >> cell.shift) & ((1 << COUNT_SHIFT) - 1)


@kernel(allocates=False)
def holds_program(cell: VextureCell) -> bool:
    return leaf_kind(cell) & HOLDS_PROGRAM != 0


@kernel(allocates=False)
def reads_mean(cell: VextureCell, share: float) -> bool:
    is_whole = holds_program(cell) and share > NEARLY_WHOLE
    return is_whole or leaf_kind(cell) == IS_MEAN


@kernel(allocates=False)
def add_mean(
    texels: Texels, is_linear: int, sum: VextureSum, planar: VexturePlanar, cell: VextureCell, place: Vec2, area: float
) -> VextureSum:
    stored = texel(texels, means_at(planar, cell.quad))
    step = area * (PAINT_ONE / COVERAGE_ONE) if sum.done == 0 else 0.0
    if cell.is_quad:
        return with_color(sum, mean_color(is_linear, stored, place), step)
    return with_color(sum, unpacked(is_linear, 0 + stored[cell.shift >> 3]), step)  # of 64 bits


@kernel(allocates=False)
def region(place: VexturePlace, right: Vec2, up: Vec2) -> VextureRegion:
    unit = 1.0 / float(1 << POSITION_BITS)
    point = ((place.point[0] + place.rest[0]) * unit, (place.point[1] + place.rest[1]) * unit)
    return VextureRegion(point, (right[0] * unit, right[1] * unit), (up[0] * unit, up[1] * unit))


@kernel(allocates=False)
def flat_look(texel: Texel, box: VextureBox) -> VextureLook:
    p0, p3 = word(texel[0]), word(texel[3])
    r0, r3 = in_box(p0, box), in_box(p3, box)
    y0, y3 = clamp(r0[1], 0.0, 1.0), clamp(r3[1], 0.0, 1.0)
    filled = above_ends(p0, p3, y0, y3)
    right = max(r0[0], r3[0])
    filled += y0 - y3 if right <= 0.0 else 0.0
    left = min(r0[0], r3[0]) if right > 0.0 else 1.0
    return VextureLook(filled, False, left < 1.0 and y0 != y3)


@kernel(allocates=False)
def flat_filled_share(texel: Texel, look: VextureLook, box: VextureBox, has_moments: bool) -> VextureShare:
    if has_moments:
        share = flat_ends_share(texel, look.crosses, box)
        if look.crosses:
            one = piece(texel, box)
            share = plus_share(share, flat_piece_share(one, ends(one)), 1.0)
        return share
    area = look.filled
    if look.crosses:
        one = piece(texel, box)
        area += flat_piece_area(one, ends(one))
    return area_share(area)


@kernel(allocates=False)
def add_flat_leaf(
    texels: Texels,
    is_linear: int,
    sum: VextureSum,
    planar: VexturePlanar,
    cell: VextureCell,
    box: VextureBox,
    sides: Vec2,
    middle: Vec2,
) -> VextureSum:
    has_moments = holds_program(cell)
    whole = moved_share(whole_share(), sides, middle)
    sum = add_base(texels, is_linear, sum, planar, base_paint(texels, planar, cell), whole)
    pieces = leaf(cell)
    for i in range(count(cell)):
        found, pieces = leaf_piece(texels, pieces, i)
        look = flat_look(found, box)
        if look.crosses or look.filled != 0.0:
            filled = moved_share(flat_filled_share(found, look, box, has_moments), sides, middle)
            beside, pieces = leaf_sides(texels, pieces, planar, i)
            sum = add_piece(texels, is_linear, sum, planar, beside, filled)
    return sum


@kernel(allocates=False)
def add_flat_cell(
    texels: Texels,
    is_linear: int,
    sum: VextureSum,
    planar: VexturePlanar,
    cell: VextureCell,
    box: VextureBox,
    view: VextureFlat,
) -> VextureSum:
    low, size = box.low, box.size
    side = 2.0**-cell.bit
    if cell.is_quad or reads_mean(cell, min(size[0], size[1]) * side):
        x = box.way[0] + (box.part[0] + 0.5) * size[0]
        y = box.way[1] + (box.part[1] + 0.5) * size[1]
        return add_mean(texels, is_linear, sum, planar, cell, (x * side, y * side), size[0] * size[1] * view.inverse)
    across = (0.5 / view.extent[0], 0.5 / view.extent[1])
    middle = (across[0] * (low[0] + 0.5 * size[0]), across[1] * (low[1] + 0.5 * size[1]))
    return add_flat_leaf(texels, is_linear, sum, planar, cell, box, (across[0] * size[0], across[1] * size[1]), middle)


@kernel(allocates=False)
def flat_color(texels: Texels, is_linear: int, root: int, base: Whole2, offset: Vec2, view: VextureFlat) -> Vec4:
    parts = planar(texels, root)
    there = place(base, offset, view.extent)
    here = region(there, (2.0 * view.extent[0], 0.0), (0.0, 2.0 * view.extent[1]))
    square = first_square(there)
    shared = square.bit
    start = top(root)
    sum = nothing()
    while square.position[0] < NO_CELL or holds_kept(sum):
        position = square.position
        is_over = holds_kept(sum) and position[0] >= NO_CELL
        cell, start = descend(texels, start, shared, NO_CELL if is_over else view.finest, position)
        side = 1 << cell.bit
        origin = (position[0] & -side, position[1] & -side)
        is_left = True
        while is_left:
            if is_over:
                sum = add_kept(texels, is_linear, sum, parts)
            else:
                local = box(origin, cell.bit, there, view.extent)
                sum = add_flat_cell(texels, is_linear, sum, parts, cell, local, view)
            sum = settle(texels, is_linear, sum, parts, here)
            is_left = sum.done > 0
        if not is_over:
            square = next_square(position, (origin[0] + side, origin[1] + side), there)
    return held(times(sum.color, 1.0 / PAINT_ONE))


@kernel(allocates=False)
def held(color: Vec4) -> Vec4:
    alpha = held_channel(color[3], 1.0)
    return held_channel(color[0], alpha), held_channel(color[1], alpha), held_channel(color[2], alpha), alpha


@kernel(allocates=False)
def held_channel(value: float, most: float) -> float:
    """One channel of `held`, which GLSL computes with vectors."""
    return min(value, most) if value > 0.0 else 0.0


@kernel(allocates=False)
def filled_share(
    texel: Texel, look: VextureLook, box: VextureBox, frame: VextureFrame, whole: VextureShare, has_moments: bool
) -> VextureShare:
    found = plus_share(area_share(0.0), whole, look.filled)
    if look.crosses:
        one = piece(texel, box)
        both = ends(one)
        if has_moments:
            return plus_share(found, piece_share(texel, look.turns, one, both, box, frame), 1.0)
        found = plus_share(found, area_share(piece_area(texel, look.turns, one, both, box, frame)), 1.0)
    return found


@kernel(allocates=False)
def add_leaf(
    texels: Texels,
    is_linear: int,
    sum: VextureSum,
    planar: VexturePlanar,
    cell: VextureCell,
    box: VextureBox,
    frame: VextureFrame,
    whole: VextureShare,
) -> VextureSum:
    has_moments = holds_program(cell)
    sum = add_base(texels, is_linear, sum, planar, base_paint(texels, planar, cell), whole)
    pieces = leaf(cell)
    for i in range(count(cell) if whole.area > 0.0 else 0):
        found, pieces = leaf_piece(texels, pieces, i)
        look = first_look(found, box)
        if look.crosses or look.filled != 0.0:
            filled = filled_share(found, look, box, frame, whole, has_moments)
            beside, pieces = leaf_sides(texels, pieces, planar, i)
            sum = add_piece(texels, is_linear, sum, planar, beside, filled)
    return sum


@kernel(allocates=False)
def add_cell(
    texels: Texels,
    is_linear: int,
    sum: VextureSum,
    planar: VexturePlanar,
    cell: VextureCell,
    box: VextureBox,
    frame: VextureFrame,
) -> VextureSum:
    low, size, extent = box.low, box.size, frame.extent
    whole = whole_share()
    if low[0] > -extent[0] or low[1] > -extent[1] or low[0] + size[0] < extent[0] or low[1] + size[1] < extent[1]:
        whole = box_share(frame, low, size)
    side = 2.0**cell.bit
    if cell.is_quad or reads_mean(cell, whole.area * frame.size / (side * side)):
        place = cut_place(cell, box, frame) if cell.is_quad else (0.5, 0.5)
        return add_mean(texels, is_linear, sum, planar, cell, place, whole.area)
    return add_leaf(texels, is_linear, sum, planar, cell, box, frame, whole)


@kernel(allocates=False)
def color(texels: Texels, is_linear: int, root: int, base: Whole2, offset: Vec2, dx: Vec2, dy: Vec2) -> Vec4:
    parts = planar(texels, root)
    pixel = frame(dx, dy)
    there = place(base, offset, pixel.extent)
    finest = finest_bit(pixel.size, pixel.longer)
    right = (pixel.up[1] * pixel.size, -pixel.up[0] * pixel.size)
    here = region(there, right, (-pixel.right[1] * pixel.size, pixel.right[0] * pixel.size))
    square = first_square(there)
    shared = square.bit
    start = top(root)
    sum = nothing()
    beside = False
    while square.position[0] < NO_CELL or holds_kept(sum):
        position, bit = square.position, square.bit
        is_over = holds_kept(sum) and position[0] >= NO_CELL
        if not beside:
            cell, start = descend(texels, start, shared, NO_CELL if is_over else finest, position)
            bit = cell.bit
            origin = (position[0] & -(1 << bit), position[1] & -(1 << bit))
            is_left = True
            while is_left:
                if is_over:
                    sum = add_kept(texels, is_linear, sum, parts)
                else:
                    local = box(origin, bit, there, pixel.extent)
                    sum = add_cell(texels, is_linear, sum, parts, cell, local, pixel)
                sum = settle(texels, is_linear, sum, parts, here)
                is_left = sum.done > 0
        side = 1 << bit
        beside = False
        if not is_over:
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
    float32, premultiplied, 0..1. It is averaged over pixels in sRGB. With `is_linear` it is averaged in linear light,
    and its components are linear.
    """
    uniforms = uniforms_of(texture, size, view, root)
    image = np.empty((*uniforms.size[::-1], 4), np.float32)
    is_flat, root = int(uniforms.is_flat), uniforms.quad
    draw_colours(texture.texels, int(is_linear), is_flat, root, uniforms.base, uniforms.to_unit, image)
    return image
