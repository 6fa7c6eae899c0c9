"""The mirror of ``shaders/flat.glsl``: pixels with horizontal and vertical sides (see `vexture.renderers.cpu`)."""

from typing import NamedTuple

from vexture.base.kernels import kernel
from vexture.base.layout import WINDING_OFFSET
from vexture.renderers.cells import (
    Texels,
    Vec2,
    VextureCell,
    Whole2,
    clamp,
    count,
    descend,
    finest_bit,
    first_curve,
    first_square,
    next_square,
    place,
    stored_coverage,
    texel,
    top,
    winding_code,
)
from vexture.renderers.method import NO_CELL, POSITION_BITS, SMALLEST_PIXEL
from vexture.renderers.piece import (
    VextureBox,
    VextureEnds,
    VexturePiece,
    box,
    bulge,
    ends,
    in_box,
    mean,
    piece,
    slope,
    word,
)


class VextureFlat(NamedTuple):
    """Values that all pixels of a flat view share."""

    extent: Vec2
    inverse: float
    finest: int


@kernel(allocates=False)
def flat(dx: Vec2, dy: Vec2) -> VextureFlat:
    """Compute the values that all pixels of a view share, from the steps to the next pixels."""
    one = float(1 << POSITION_BITS)
    extent_x = max(0.5 * (abs(dx[0]) + abs(dy[0])), 0.5 * SMALLEST_PIXEL) * one
    extent_y = max(0.5 * (abs(dx[1]) + abs(dy[1])), 0.5 * SMALLEST_PIXEL) * one
    area = 4.0 * extent_x * extent_y
    longer = 2.0 * max(extent_x, extent_y)
    return VextureFlat((extent_x, extent_y), 1.0 / area, finest_bit(area, longer * longer))


@kernel(allocates=False)
def flat_piece_area(piece: VexturePiece, ends: VextureEnds) -> float:
    """Area of the box to the right of a piece; negative if the piece rises."""
    enter, leave = ends.enter, ends.leave
    chord = (leave[0] - enter[0], leave[1] - enter[1])
    first, last = slope(piece, ends.start), slope(piece, ends.end)
    left = 0.5 * (enter[0] + leave[0]) * chord[1] + bulge((ends.end - ends.start) / 3.0, first, last, chord)
    y0 = clamp(piece.d[1], 0.0, 1.0)
    y3 = clamp(piece.d[1] + piece.way[1], 0.0, 1.0)
    area = y3 - leave[1] + left if piece.falls[0] else leave[1] - y0 - left
    return area if piece.falls[1] else -area


@kernel(allocates=False)
def flat_cell_area(texels: Texels, cell: VextureCell, box: VextureBox) -> float:
    if cell.is_quad:
        side = 2.0**-cell.bit
        x = (box.way[0] + (box.part[0] + 0.5) * box.size[0]) * side
        y = (box.way[1] + (box.part[1] + 0.5) * box.size[1]) * side
        return mean(cell.texel[3], (x, y))
    code = winding_code(cell)
    curve = first_curve(cell)
    filled = stored_coverage(cell) if code == 0 else float(code - WINDING_OFFSET)
    for i in range(count(cell)):
        found = texel(texels, curve + i)
        p0, p3 = word(found[0]), word(found[3])
        r0, r3 = in_box(p0, box), in_box(p3, box)
        y0, y3 = clamp(r0[1], 0.0, 1.0), clamp(r3[1], 0.0, 1.0)
        filled += 1.0 - y0 if p0[0] == 0.0 else 0.0
        filled -= 1.0 - y3 if p3[0] == 0.0 else 0.0
        right = max(r0[0], r3[0])
        filled += y0 - y3 if right <= 0.0 else 0.0
        left = min(r0[0], r3[0]) if right > 0.0 else 1.0
        if left < 1.0 and y0 != y3:
            one = piece(found, box)
            filled += flat_piece_area(one, ends(one))
    return filled


@kernel(allocates=False)
def flat_coverage(texels: Texels, root: int, base: Whole2, offset: Vec2, view: VextureFlat) -> float:
    """Coverage of a pixel."""
    there = place(base, offset, view.extent)
    square = first_square(there)
    shared = square.bit
    start = top(root)
    area = 0.0
    while square.position[0] < NO_CELL:
        position = square.position
        cell, start = descend(texels, start, shared, view.finest, position)
        side = 1 << cell.bit
        origin = (position[0] & -side, position[1] & -side)
        local = box(origin, cell.bit, there, view.extent)
        area += flat_cell_area(texels, cell, local) * (local.size[0] * local.size[1])
        square = next_square(position, (origin[0] + side, origin[1] + side), there)
    area *= view.inverse
    return min(area, 1.0) if area > 0.0 else 0.0
