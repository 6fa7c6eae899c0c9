"""The shader's mirror on the CPU: the functions of ``glsl/`` again, in float64.

The names are the shader's without their prefix: ``vexture_place`` is `place`, ``vextureCoverage`` is `coverage`. The
mathematics of one piece is in `vexture.renderers.piece`.

Change both sides together; a test compares names and arguments. The shader computes in float32, so the difference
between the two is the error of float32. The shader's comments give the reasons.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.kernels import kernel
from vexture.layout import (
    COUNT_SHIFT,
    COVERAGE_ONE,
    LATTICE,
    LATTICE_BITS,
    MOST_CURVES,
    MOST_DEPTH,
    QUAD_FLAG,
    ROW_BITS,
    WINDING_OFFSET,
)
from vexture.renderers.method import (
    CROSSING,
    FARTHEST,
    LEAST_FINEST,
    LEVEL_BIAS,
    LEVELS_BELOW,
    LONG,
    MOST_CELLS,
    POSITION_BITS,
    SMALL_FINEST,
)
from vexture.renderers.piece import Frame, Texel, Vec2, Whole2, box_area, clear_side, frame, piece, piece_area
from vexture.renderers.shader import QUALITIES
from vexture.renderers.uniforms import HasTexels, uniforms_of
from vexture.renderers.view import Size, ViewLike

__all__ = ["render_cpu"]

Texels = NDArray[np.uint32]


class Place(NamedTuple):
    """A point and the box of a pixel around it."""

    point: Whole2
    rest: Vec2
    low: Whole2
    high: Whole2


class Cell(NamedTuple):
    """A cell, as the byte of a texel."""

    texel: Texel
    shift: int
    level: int
    is_quad: bool


class Top(NamedTuple):
    """Start of a descent of the tree."""

    quad: int
    level: int


class Lattice(NamedTuple):
    """Position of a cell's lattice relative to the pixel."""

    whole: Whole2
    part: Vec2
    low: Vec2
    high: Vec2
    frame: Frame


# --- tree.glsl -------------------------------------------------------------------------------------------------


@kernel(allocates=False)
def texel(texels: Texels, index: int) -> Texel:
    index &= 0xFFFFFFFF
    row = min(index >> ROW_BITS, texels.shape[0] - 1)
    column = min(index & ((1 << ROW_BITS) - 1), texels.shape[1] - 1)
    found = texels[row, column]
    return int(found[0]), int(found[1]), int(found[2]), int(found[3])


@kernel(allocates=False)
def place(base: Whole2, offset: Vec2, reach: Vec2) -> Place:
    x, rest_x, low_x, high_x = place_coordinate(base[0], offset[0], reach[0])
    y, rest_y, low_y, high_y = place_coordinate(base[1], offset[1], reach[1])
    return Place((x, y), (rest_x, rest_y), (low_x, low_y), (high_x, high_y))


@kernel(allocates=False)
def place_coordinate(base: int, offset: float, reach: float) -> tuple[int, float, int, int]:
    """One coordinate of what GLSL computes as vectors."""
    spare = 32 - POSITION_BITS
    one = float(1 << POSITION_BITS)
    scaled = min(max(offset, -FARTHEST), FARTHEST) * one
    whole = math.floor(scaled)
    point = (base >> spare) + int(whole)
    rest = scaled - whole + (base & ((1 << spare) - 1)) / float(1 << spare)
    extent = min(reach, FARTHEST) * one
    low = max(point + math.floor(rest - extent), 0)
    high = min(point + math.ceil(rest + extent) - 1, (1 << POSITION_BITS) - 1)
    return point, rest, low, high


@kernel(allocates=False)
def shared_levels(low: Whole2, high: Whole2) -> int:
    differ = (low[0] ^ high[0]) | (low[1] ^ high[1])
    bits = math.frexp(float(differ))[1]
    return min(max(POSITION_BITS - bits, 0), MOST_DEPTH)


@kernel(allocates=False)
def level_of(area: float) -> int:
    return -1 - ((math.frexp(area * (1.0 - LEVEL_BIAS))[1] - 1) >> 1)


@kernel(allocates=False)
def finest_level(area: float, reach: Vec2) -> int:
    length = LONG * max(reach[0], reach[1])
    usual = level_of(max(area, length * length)) + LEVELS_BELOW
    small = level_of(max(area, 4.0 * length * length)) + LEVELS_BELOW + 1
    return min(max(max(usual, min(small, SMALL_FINEST)), LEAST_FINEST), MOST_DEPTH)


@kernel(allocates=False)
def descend(texels: Texels, top: Top, shared: int, finest: int, position: Whole2) -> tuple[Cell, Top]:
    """Return the new `top` too, which GLSL changes in place."""
    found = (0, 0, 0, 0)
    shift = 0
    quad = top.quad
    is_quad = True
    bit = POSITION_BITS - 1 - top.level
    last = POSITION_BITS - finest
    while is_quad and bit >= last:
        found = texel(texels, quad)
        shift = ((position[0] >> bit) & 1) * 8 + ((position[1] >> bit) & 1) * 16
        is_quad = ((found[2] >> shift) & QUAD_FLAG) != 0
        flags = (found[2] >> 7) & 0x01010101
        quad = found[0] + ((((flags * 0x01010100) & 0xFFFFFFFF) >> shift) & 3)
        bit -= 1
        if POSITION_BITS - 1 - bit == shared and is_quad:
            top = Top(quad, shared)
    return Cell(found, shift, POSITION_BITS - 1 - bit, is_quad), top


@kernel(allocates=False)
def stored_coverage(cell: Cell) -> float:
    return ((cell.texel[3] >> cell.shift) & 255) / COVERAGE_ONE


@kernel(allocates=False)
def count(cell: Cell) -> int:
    return (cell.texel[2] >> (cell.shift + COUNT_SHIFT)) & MOST_CURVES


@kernel(allocates=False)
def winding_code(cell: Cell) -> int:
    return (cell.texel[2] >> cell.shift) & 7


@kernel(allocates=False)
def first_curve(cell: Cell) -> int:
    counts = (cell.texel[2] >> COUNT_SHIFT) & 0x0F0F0F0F
    return cell.texel[1] + ((((counts * 0x01010100) & 0xFFFFFFFF) >> cell.shift) & 255)


# --- coverage.glsl ---------------------------------------------------------------------------------------------


@kernel(allocates=False)
def lattice(origin: Whole2, level: int, place: Place, frame: Frame) -> Lattice:
    finer = POSITION_BITS - level - LATTICE_BITS
    coarser = max(-finer, 0)
    finer = max(finer, 0)
    unit = LATTICE * float(1 << level)
    scale = float(1 << coarser) / float(1 << finer)
    below = (1 << finer) - 1
    way_x, way_y = place.point[0] - origin[0], place.point[1] - origin[1]
    whole = ((way_x >> finer) << coarser, (way_y >> finer) << coarser)
    part = (((way_x & below) + place.rest[0]) * scale, ((way_y & below) + place.rest[1]) * scale)
    reach_x, reach_y = frame.reach[0] * unit, frame.reach[1] * unit
    right, up = frame.right, frame.up
    return Lattice(
        whole,
        part,
        (max(-whole[0] - part[0], -reach_x), max(-whole[1] - part[1], -reach_y)),
        (min(LATTICE - whole[0] - part[0], reach_x), min(LATTICE - whole[1] - part[1], reach_y)),
        Frame(
            (right[0] / unit, right[1] / unit),
            (up[0] / unit, up[1] / unit),
            frame.level,
            frame.upright,
            frame.reach,
            frame.turned,
            frame.size * unit * unit,
        ),
    )


@kernel(allocates=False)
def cell_area(texels: Texels, quality: int, cell: Cell, lattice: Lattice) -> float:
    code = 0 if cell.is_quad else winding_code(cell)
    curve = first_curve(cell)
    winding = code - WINDING_OFFSET
    low, high = lattice.low, lattice.high
    area = 0.0
    for i in range(0 if code == 0 else count(cell)):
        one = piece(texel(texels, curve + i), lattice.whole, lattice.part)
        if one.starts_left and one.ends_left:
            continue
        winding += 1 if one.starts_left and one.p0[1] <= low[1] else 0
        winding -= 1 if one.ends_left and one.p3[1] <= low[1] else 0
        starts = one.starts_left and low[1] < one.p0[1] < high[1]
        ends = one.ends_left and low[1] < one.p3[1] < high[1]
        side = CROSSING if starts or ends else clear_side(one, low, high)
        if side == CROSSING:
            area += piece_area(quality, one, lattice.frame, low, high)
        else:
            winding += side
    whole = stored_coverage(cell) if code == 0 else float(winding)
    return area + whole * box_area(lattice.frame, low, high)


@kernel(allocates=False)
def coverage(texels: Texels, quality: int, root: int, base: Whole2, offset: Vec2, dx: Vec2, dy: Vec2) -> float:
    pixel = frame(dx, dy)
    there = place(base, offset, pixel.reach)
    low, high = there.low, there.high
    shared = shared_levels(low, high)
    finest = finest_level(pixel.size, pixel.reach)
    top = Top(root, 0)
    x, row, next_row = low[0], low[1], high[1] + 1
    cells = MOST_CELLS if low[0] <= high[0] and low[1] <= high[1] else 0
    area = 0.0
    while cells > 0:
        cell, top = descend(texels, top, shared, finest, (x, row))
        bits = POSITION_BITS - cell.level
        origin = ((x >> bits) << bits, (row >> bits) << bits)
        beyond_x, beyond_y = origin[0] + (1 << bits), origin[1] + (1 << bits)
        local = lattice(origin, cell.level, there, pixel)
        counted = origin[1] < row != low[1]
        if not counted and local.low[0] < local.high[0] and local.low[1] < local.high[1]:
            area += cell_area(texels, quality, cell, local)
        next_row = min(next_row, beyond_y)
        x = beyond_x
        if x > high[0]:
            x, row, next_row = low[0], next_row, high[1] + 1
        cells = 0 if row > high[1] else cells - 1
    area *= pixel.turned
    return min(area, 1.0) if area > 0.0 else 0.0


# --- view.glsl -------------------------------------------------------------------------------------------------


@kernel(allocates=False)
def view_coverage(
    texels: Texels, quality: int, root: int, base: Whole2, to_unit: NDArray[np.float64], pixel: Vec2
) -> float:
    x, y = pixel
    w = to_unit[2, 0] * x + to_unit[2, 1] * y + to_unit[2, 2]
    if w <= 0.5 * (abs(to_unit[2, 0]) + abs(to_unit[2, 1])):
        return 0.0
    u = (to_unit[0, 0] * x + to_unit[0, 1] * y + to_unit[0, 2]) / w
    v = (to_unit[1, 0] * x + to_unit[1, 1] * y + to_unit[1, 2]) / w
    dx = ((to_unit[0, 0] - u * to_unit[2, 0]) / w, (to_unit[1, 0] - v * to_unit[2, 0]) / w)
    dy = ((to_unit[0, 1] - u * to_unit[2, 1]) / w, (to_unit[1, 1] - v * to_unit[2, 1]) / w)
    return coverage(texels, quality, root, base, (u, v), dx, dy)


@kernel(allocates=False, ahead=True)
def draw(
    texels: Texels, quality: int, root: int, base: Whole2, to_unit: NDArray[np.float64], image: NDArray[np.float32]
) -> None:
    for row in range(image.shape[0]):
        for column in range(image.shape[1]):
            pixel = (column + 0.5, row + 0.5)
            image[row, column] = view_coverage(texels, quality, root, base, to_unit, pixel)


def render_cpu(
    texture: HasTexels,
    size: Size,
    view: ViewLike = None,
    *,
    root: int = 0,
    quality: str = "exact",
    base: tuple[int, int] | None = None,
) -> NDArray[np.float32]:
    """Render one shape of a packed texture as its shader would with exact arithmetic.

    `size`, `view` and `quality` are as in `vexture.coverage`; `root` is the number of the shape. Positions are relative
    to the point `base` of the unit square, 1.0 = 2^32; `view_base` by default.
    """
    uniforms = uniforms_of(texture, size, view, root, quality, base)
    image = np.empty(uniforms.size[::-1], np.float32)
    draw(texture.texels, QUALITIES[quality], uniforms.quad, uniforms.base, uniforms.to_unit, image)
    return image
