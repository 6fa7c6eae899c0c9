"""The shader's mirror on the CPU: the functions of ``shaders/``, in float64.

The names are the shader's without their prefix: ``vexture_place`` is `place`, ``vextureCoverage`` is `coverage`. The
cells of the tree are in `vexture.renderers.cells`, the mathematics of one piece is in `vexture.renderers.piece`.

Change both sides together; a test compares names and arguments. The shader computes in float32, so its pictures differ
from the mirror's by the error of float32. The shader's comments give the reasons for the code.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import WINDING_OFFSET
from vexture.renderers.cells import (
    Texel,
    Texels,
    Vec2,
    VextureCell,
    VexturePlace,
    VextureSquare,
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
from vexture.renderers.flat import flat, flat_coverage
from vexture.renderers.method import (
    BEND,
    DRAWN,
    MOST_PARTS,
    NO_CELL,
)
from vexture.renderers.piece import (
    VextureBox,
    VextureEnds,
    VextureFrame,
    VexturePiece,
    at,
    beside,
    beside_sloped,
    box,
    box_area,
    bulge,
    cross,
    ends,
    frame,
    in_box,
    into_frame,
    mean,
    part_inside,
    piece,
    slope,
    slopes,
    view_pixel,
    word,
)
from vexture.renderers.uniforms import HasTexels, uniforms_of
from vexture.renderers.view import Size, ViewLike


class VextureCorner(NamedTuple):
    """A box as a parallelogram in the footprint's frame."""

    origin: Vec2
    x: Vec2
    y: Vec2


class VexturePath(NamedTuple):
    """Path along a box's sides: on the left, on the right, and from the piece's ends to the right side."""

    corner: VextureCorner
    l0: Vec2
    l1: Vec2
    r0: Vec2
    r1: Vec2
    e0: Vec2
    e1: Vec2


class VextureLook(NamedTuple):
    """Result from the ends of a piece alone: the filled share of the box, and whether more must be read."""

    filled: float
    turns: bool
    crosses: bool


# --- coverage.glsl ---------------------------------------------------------------------------------------------


@kernel(allocates=False)
def corner(falls: tuple[bool, bool], box: VextureBox, frame: VextureFrame) -> VextureCorner:
    low, size, right, up = box.low, box.size, frame.right, frame.up
    x = -size[0] if falls[0] else size[0]
    y = -size[1] if falls[1] else size[1]
    start = (low[0] + size[0] if falls[0] else low[0], low[1] + size[1] if falls[1] else low[1])
    return VextureCorner(into_frame(frame, start), (right[0] * x, up[0] * x), (right[1] * y, up[1] * y))


@kernel(allocates=False)
def from_corner(corner: VextureCorner, x: float, y: float) -> Vec2:
    origin, along, above = corner.origin, corner.x, corner.y
    return origin[0] + along[0] * x + above[0] * y, origin[1] + along[1] * x + above[1] * y


@kernel(allocates=False)
def piece_parts(piece: VexturePiece, ends: VextureEnds, corner: VextureCorner) -> int:
    """Number of parts into which a piece is divided because of its bend."""
    along, above = corner.x, corner.y
    p = from_corner(corner, ends.enter[0], ends.enter[1])
    q = from_corner(corner, ends.leave[0], ends.leave[1])
    way = slope(piece, ends.start)
    first = (along[0] * way[0] + above[0] * way[1], along[1] * way[0] + above[1] * way[1])
    way = slope(piece, ends.end)
    last = (along[0] * way[0] + above[0] * way[1], along[1] * way[0] + above[1] * way[1])
    chord = (q[0] - p[0], q[1] - p[1])
    bend = (ends.end - ends.start) * (abs(cross(first, chord)) + abs(cross(last, chord)))
    return 1 + int(min(BEND * bend, MOST_PARTS - 1.0))


@kernel(allocates=False)
def curve_area(piece: VexturePiece, ends: VextureEnds, corner: VextureCorner) -> float:
    along, above = corner.x, corner.y
    parts = piece_parts(piece, ends, corner)
    step_t = (ends.end - ends.start) / parts
    p = from_corner(corner, ends.enter[0], ends.enter[1])
    way = slope(piece, ends.start)
    first = (along[0] * way[0] + above[0] * way[1], along[1] * way[0] + above[1] * way[1])
    area = 0.0
    t = ends.start
    while parts > 0:
        parts -= 1
        t = ends.end if parts == 0 else t + step_t
        there = ends.leave if parts == 0 else at(piece, t)
        way = slope(piece, t)
        q = from_corner(corner, there[0], there[1])
        last = (along[0] * way[0] + above[0] * way[1], along[1] * way[0] + above[1] * way[1])
        more = bulge(step_t / 3.0, first, last, (q[0] - p[0], q[1] - p[1]))
        area += beside(p, q) + more * part_inside(p, q)
        p = q
        first = last
    return area


@kernel(allocates=False)
def path_of(
    texel: Texel, turns: bool, piece: VexturePiece, ends: VextureEnds, box: VextureBox, frame: VextureFrame
) -> VexturePath:
    """Path along the box's sides that closes a piece."""
    there = corner(piece.falls, box, frame)
    falls = piece.falls[0]
    top = 0.0 if piece.falls[1] else 1.0
    y0 = clamp(piece.d[1], 0.0, 1.0)
    y3 = clamp(piece.d[1] + piece.way[1], 0.0, 1.0)
    y0 = top if turns and texel[0] & 0xFFFF == 0 else y0
    y3 = top if turns and texel[3] & 0xFFFF == 0 else y3
    left = 1.0 if falls else 0.0
    right = 1.0 - left
    left_end = y3 if falls else ends.enter[1]
    right_end = ends.enter[1] if falls else y0
    left_start = ends.leave[1] if falls else y0
    right_start = y3 if falls else ends.leave[1]
    l0, l1 = from_corner(there, left, left_start), from_corner(there, left, left_end)
    r0, r1 = from_corner(there, right, right_start), from_corner(there, right, right_end)
    e0, e1 = from_corner(there, ends.enter[0], right_end), from_corner(there, ends.leave[0], right_start)
    return VexturePath(there, l0, l1, r0, r1, e0, e1)


@kernel(allocates=False)
def piece_area(
    texel: Texel, turns: bool, piece: VexturePiece, ends: VextureEnds, box: VextureBox, frame: VextureFrame
) -> float:
    path = path_of(texel, turns, piece, ends, box, frame)
    level = slopes(frame.right[0], frame.up[0])
    upright = slopes(frame.right[1], frame.up[1])
    area = beside_sloped(path.l0, path.l1[1], upright) + beside_sloped(path.r0, path.r1[1], upright)
    area += beside_sloped(path.e1, path.r0[1], level) + beside_sloped(path.r1, path.e0[1], level)
    return area + curve_area(piece, ends, path.corner)


@kernel(allocates=False)
def cut_place(cell: VextureCell, box: VextureBox, frame: VextureFrame) -> Vec2:
    right, up, low, size = frame.right, frame.up, box.low, box.size
    middle = (low[0] + 0.5 * size[0], low[1] + 0.5 * size[1])
    along, above = into_frame(frame, middle)
    moved_x = cut_way(along, abs(right[0]) * size[0], abs(right[1]) * size[1])
    moved_y = cut_way(above, abs(up[0]) * size[0], abs(up[1]) * size[1])
    x = 0.5 * size[0] + (up[1] * moved_x - right[1] * moved_y) * frame.size
    y = 0.5 * size[1] + (right[0] * moved_y - up[0] * moved_x) * frame.size
    side = 2.0**-cell.bit
    x = (box.way[0] + box.part[0] * size[0] + x) * side
    y = (box.way[1] + box.part[1] * size[1] + y) * side
    return clamp(x, 0.0, 1.0), clamp(y, 0.0, 1.0)


@kernel(allocates=False)
def cut_way(at: float, x: float, y: float) -> float:
    """One coordinate of `cut_place`, which GLSL computes with vectors."""
    reach = 0.5 * (x + y)
    low, high = max(at - reach, -0.5), min(at + reach, 0.5)
    return DRAWN * (0.5 * (low + high) - at)


@kernel(allocates=False)
def above_ends(p0: Vec2, p3: Vec2, y0: float, y3: float) -> float:
    return (1.0 - y0 if p0[0] == 0.0 else 0.0) - (1.0 - y3 if p3[0] == 0.0 else 0.0)


@kernel(allocates=False)
def first_look(texel: Texel, box: VextureBox) -> VextureLook:
    p0, p3 = word(texel[0]), word(texel[3])
    r0, r3 = in_box(p0, box), in_box(p3, box)
    y0, y3 = clamp(r0[1], 0.0, 1.0), clamp(r3[1], 0.0, 1.0)
    is_left = max(r0[0], r3[0]) <= 0.0
    is_right = min(r0[0], r3[0]) >= 1.0
    passed = y0 - y3 if is_left else 0.0
    crosses = passed != math.floor(passed) or (not is_left and not is_right and y0 != y3)
    turns = False
    filled = 0.0
    if p0[0] * p3[0] == 0.0:
        above = above_ends(p0, p3, y0, y3)
        turns = above != math.floor(above)
        cancels = p0[0] == p3[0]
        filled = 0.0 if turns and not cancels else above
        crosses = (turns or crosses) and not cancels
    return VextureLook(filled if crosses else filled + passed, turns, crosses)


@kernel(allocates=False)
def cell_area(texels: Texels, cell: VextureCell, box: VextureBox, frame: VextureFrame) -> float:
    low, size, extent = box.low, box.size, frame.extent
    whole = 1.0
    if low[0] > -extent[0] or low[1] > -extent[1] or low[0] + size[0] < extent[0] or low[1] + size[1] < extent[1]:
        whole = box_area(frame, low, size)
    if cell.is_quad:
        return whole * mean(cell.texel[3], cut_place(cell, box, frame))
    code = winding_code(cell)
    curve = first_curve(cell)
    filled = stored_coverage(cell) if code == 0 else float(code - WINDING_OFFSET)
    area = 0.0
    for i in range(count(cell) if whole > 0.0 else 0):
        found = texel(texels, curve + i)
        look = first_look(found, box)
        filled += look.filled
        if look.crosses:
            one = piece(found, box)
            area += piece_area(found, look.turns, one, ends(one), box, frame)
    return area + filled * whole


@kernel(allocates=False)
def is_beside(square: VextureSquare, place: VexturePlace, frame: VextureFrame) -> bool:
    side = 1 << square.bit
    right, up = frame.right, frame.up
    x = float((square.position[0] & -side) - place.point[0]) - place.rest[0] + 0.5 * side
    y = float((square.position[1] & -side) - place.point[1]) - place.rest[1] + 0.5 * side
    along, above = into_frame(frame, (x, y))
    reach_x = 0.5 + 0.5 * side * (abs(right[0]) + abs(right[1]))
    reach_y = 0.5 + 0.5 * side * (abs(up[0]) + abs(up[1]))
    return abs(along) > reach_x or abs(above) > reach_y


@kernel(allocates=False)
def coverage(texels: Texels, root: int, base: Whole2, offset: Vec2, dx: Vec2, dy: Vec2) -> float:
    pixel = frame(dx, dy)
    there = place(base, offset, pixel.extent)
    square = first_square(there)
    shared = square.bit
    finest = finest_bit(pixel.size, pixel.longer)
    start = top(root)
    area = 0.0
    beside = False
    while square.position[0] < NO_CELL:
        position, bit = square.position, square.bit
        if not beside:
            cell, start = descend(texels, start, shared, finest, position)
            bit = cell.bit
        side = 1 << bit
        origin = (position[0] & -side, position[1] & -side)
        if not beside:
            area += cell_area(texels, cell, box(origin, bit, there, pixel.extent), pixel)
        square = next_square(position, (origin[0] + side, origin[1] + side), there)
        beside = square.position[0] < NO_CELL and is_beside(square, there, pixel)
    return min(area, 1.0) if area > 0.0 else 0.0


# --- view_coverage.glsl ----------------------------------------------------------------------------------------


@kernel(allocates=False)
def view_coverage(
    texels: Texels, flat_view: int, root: int, base: Whole2, to_unit: NDArray[np.float64], pixel: Vec2
) -> float:
    found = view_pixel(to_unit, pixel)
    if not found.seen:
        return 0.0
    if flat_view:
        return flat_coverage(texels, root, base, found.offset, flat(found.dx, found.dy))
    return coverage(texels, root, base, found.offset, found.dx, found.dy)


@kernel(allocates=False, ahead=True)
def draw(
    texels: Texels, flat_view: int, root: int, base: Whole2, to_unit: NDArray[np.float64], image: NDArray[np.float32]
) -> None:
    for row in range(image.shape[0]):
        for column in range(image.shape[1]):
            pixel = (column + 0.5, row + 0.5)
            image[row, column] = view_coverage(texels, flat_view, root, base, to_unit, pixel)


def render_cpu(
    texture: HasTexels,
    size: Size,
    view: ViewLike = None,
    *,
    root: int = 0,
    base: tuple[int, int] | None = None,
) -> NDArray[np.float32]:
    """Render one shape of a packed texture as its shader would with exact arithmetic.

    `size` and `view` are as in `vexture.coverage`; `root` is the number of the shape. Positions are relative to the
    point `base` of the unit square, where 1.0 is 2^32; the default is `view_base`.
    """
    uniforms = uniforms_of(texture, size, view, root, base)
    image = np.empty(uniforms.size[::-1], np.float32)
    draw(texture.texels, int(uniforms.is_flat), uniforms.quad, uniforms.base, uniforms.to_unit, image)
    return image
