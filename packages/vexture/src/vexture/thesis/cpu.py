"""The shader's mirror on the CPU: each function of ``shaders/``, by the same name, in float64.

The root solver is in `vexture.thesis.cubic`. As with `vexture.renderers.cpu`, change both sides together.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.renderers.view import Size, ViewLike, size_of, view_matrix
from vexture.thesis.cubic import solve_cubic
from vexture.thesis.layout import (
    CELL_ORDER,
    CONSTANT_ROWS,
    CONTROL_MAX,
    CONTROL_MIN,
    FULL_ROW,
    THRESHOLD_CORNER,
    THRESHOLD_QUAD,
)
from vexture.thesis.method import CONSTANT, CORNER, CURVE, SAMPLES, SHORTEST_CHORD
from vexture.thesis.shader_text import ThesisPair

Vec2 = tuple[float, float]
Vec3 = tuple[float, float, float]
List = NDArray[np.float64]


class ThesisCell(NamedTuple):
    """A leaf, or as a constant a quad smaller than a pixel."""

    origin: Vec2
    size: float
    shape: int
    value: float
    start: Vec2
    along: Vec2
    p1: Vec2
    p2: Vec2
    heights: Vec2


# --- inside.glsl ------------------------------------------------------------------------------------------------------


@kernel
def change_basis(along: Vec2, offset: Vec2) -> Vec2:
    return along[0] * offset[0] + along[1] * offset[1], along[0] * offset[1] - along[1] * offset[0]


@kernel
def height(y1: float, y2: float, t: float) -> float:
    return 3.0 * (1.0 - t) * t * ((1.0 - t) * y1 + t * y2)


@kernel
def inside_curve(p1: Vec2, p2: Vec2, point: Vec2) -> bool:
    roots = solve_cubic(3.0 * (p1[0] - p2[0]) + 1.0, 3.0 * p2[0] - 6.0 * p1[0], 3.0 * p1[0], -point[0])
    crossings = 0
    above = 0
    for k in range(roots.found):
        t = roots.t[k]
        if 0.0 <= t <= 1.0:
            crossings += 1
            above += 1 if height(p1[1], p2[1], t) > point[1] else 0
    if crossings % 2 == 0 and point[1] < 0.0:
        above += 1
    return above % 2 == 1


@kernel
def inside_corner(corner: Vec2, point: Vec2) -> bool:
    after_start = point[0] >= 0.0
    after_corner = point[0] >= corner[0]
    after_end = point[0] >= 1.0
    inside = point[1] < 0.0 and after_start == after_end
    if after_start != after_corner and point[1] < corner[1] * point[0] / corner[0]:
        inside = not inside
    if after_corner != after_end and point[1] < corner[1] * (1.0 - point[0]) / (1.0 - corner[0]):
        inside = not inside
    return inside


# --- cells.glsl -------------------------------------------------------------------------------------------------------


@kernel
def constant_cell(origin: Vec2, size: float, value: float) -> ThesisCell:
    nowhere = (0.0, 0.0)
    return ThesisCell(origin, size, CONSTANT, value, nowhere, nowhere, nowhere, nowhere, nowhere)


@kernel
def edge_point(edge: float) -> Vec2:
    s = 4.0 * edge
    if s < 1.0:
        return s, 1.0
    if s < 2.0:
        return 1.0, 2.0 - s
    return (3.0 - s, 0.0) if s < 3.0 else (0.0, s - 3.0)


@kernel
def end_point(edge0: float, edge3: float, p1: Vec2, p2: Vec2) -> Vec2:
    if edge0 != edge3:
        return edge_point(edge3)
    start = edge_point(edge0)
    turn = (p1[0] - start[0]) * (p2[1] - start[1]) - (p1[1] - start[1]) * (p2[0] - start[0])
    return edge_point((edge0 + (SHORTEST_CHORD if turn > 0.0 else 1.0 - SHORTEST_CHORD)) % 1.0)


@kernel
def read_leaf(curves: List, origin: Vec2, size: float, shape: int, row: int) -> ThesisCell:
    left, right = curves[row, 0], curves[row, 1]
    p1 = (left[1], right[1])
    p2 = p1
    if shape == CURVE:
        span = CONTROL_MAX - CONTROL_MIN
        p1 = (CONTROL_MIN + span * left[1], CONTROL_MIN + span * right[1])
        p2 = (CONTROL_MIN + span * left[2], CONTROL_MIN + span * right[2])
    start = edge_point(left[0])
    end = end_point(left[0], right[0], p1, p2)
    x, y = end[0] - start[0], end[1] - start[1]
    along = (x / (x * x + y * y), y / (x * x + y * y))
    p1 = change_basis(along, (p1[0] - start[0], p1[1] - start[1]))
    p2 = change_basis(along, (p2[0] - start[0], p2[1] - start[1]))
    weight = 0.75 if shape == CURVE else 1.0
    heights = (weight * min(0.0, p1[1], p2[1]), weight * max(0.0, p1[1], p2[1]))
    return ThesisCell(origin, size, shape, 0.0, start, along, p1, p2, heights)


@kernel
def outside_square(point: Vec2) -> bool:
    return not (0.0 <= point[0] < 1.0 and 0.0 <= point[1] < 1.0)


@kernel
def find_cell(quads: List, curves: List, point: Vec2, footprint: float) -> ThesisCell:
    x, y = 0.0, 0.0
    size = 1.0
    row = 0
    if outside_square(point):
        return constant_cell((x, y), 0.0, 0.0)
    for _ in range(len(quads)):  # the thesis's bound; the shader uses the texture's depth
        right, upper = point[0] >= x + 0.5 * size, point[1] >= y + 0.5 * size
        texel = quads[row, CELL_ORDER[right + 2 * upper]]
        if footprint > size:
            return constant_cell((x, y), size, texel[2])
        size *= 0.5
        x, y = x + size * right, y + size * upper
        if texel[0] > THRESHOLD_QUAD:
            row = int(texel[1] * (len(quads) - 1) + 0.5)
            continue
        row = int(texel[1] * (len(curves) - 1) + 0.5)
        if row < CONSTANT_ROWS:
            return constant_cell((x, y), size, 1.0 if row == FULL_ROW else 0.0)
        return read_leaf(curves, (x, y), size, CORNER if texel[0] > THRESHOLD_CORNER else CURVE, row)
    return constant_cell((x, y), size, 0.0)


@kernel
def cell_contains(cell: ThesisCell, low: Vec2, high: Vec2) -> bool:
    x, y = cell.origin
    return low[0] >= x and low[1] >= y and high[0] < x + cell.size and high[1] < y + cell.size


@kernel
def cell_point(cell: ThesisCell, point: Vec2) -> Vec2:
    x = (point[0] - cell.origin[0]) / cell.size - cell.start[0]
    y = (point[1] - cell.origin[1]) / cell.size - cell.start[1]
    return change_basis(cell.along, (x, y))


@kernel
def cell_value(cell: ThesisCell, point: Vec2) -> float:
    if cell.shape == CONSTANT:
        return cell.value
    c = cell_point(cell, point)
    if c[1] >= cell.heights[1] or c[1] < cell.heights[0]:
        return 1.0 if c[1] < cell.heights[0] else 0.0
    return 1.0 if (inside_curve(cell.p1, cell.p2, c) if cell.shape == CURVE else inside_corner(cell.p1, c)) else 0.0


# --- coverage.glsl, view.glsl -----------------------------------------------------------------------------------------


@kernel
def coverage(quads: List, curves: List, center: Vec2, dx: Vec2, dy: Vec2) -> float:
    footprint = max(math.hypot(dx[0], dx[1]), math.hypot(dy[0], dy[1]))
    reach = (0.5 * (abs(dx[0]) + abs(dy[0])), 0.5 * (abs(dx[1]) + abs(dy[1])))
    cell = find_cell(quads, curves, center, footprint)
    low, high = (center[0] - reach[0], center[1] - reach[1]), (center[0] + reach[0], center[1] + reach[1])
    if cell_contains(cell, low, high):
        if cell.shape == CONSTANT:
            return cell.value
        y = cell_point(cell, center)[1]
        spread = 0.5 * (abs(change_basis(cell.along, dx)[1]) + abs(change_basis(cell.along, dy)[1])) / cell.size
        if y - spread >= cell.heights[1] or y + spread < cell.heights[0]:
            return 1.0 if y < cell.heights[0] else 0.0
    total = 0.0
    for i in range(SAMPLES * SAMPLES):
        row = i // SAMPLES
        column = i % SAMPLES if row % 2 == 0 else SAMPLES - 1 - i % SAMPLES
        s = (column + (row + 0.5) / SAMPLES) / SAMPLES - 0.5
        t = (row + (SAMPLES - column - 0.5) / SAMPLES) / SAMPLES - 0.5
        point = (center[0] + s * dx[0] + t * dy[0], center[1] + s * dx[1] + t * dy[1])
        if not cell_contains(cell, point, point):
            cell = find_cell(quads, curves, point, footprint)
        total += cell_value(cell, point)
    return total / (SAMPLES * SAMPLES)


@kernel
def view_point(to_unit: List, pixel: Vec2) -> Vec3:
    x, y = pixel
    return (
        to_unit[0, 0] * x + to_unit[0, 1] * y + to_unit[0, 2],
        to_unit[1, 0] * x + to_unit[1, 1] * y + to_unit[1, 2],
        to_unit[2, 0] * x + to_unit[2, 1] * y + to_unit[2, 2],
    )


@kernel
def view_step(to_unit: List, center: Vec2, pixel: Vec2, step: Vec2) -> Vec2:
    """Mirror dFdx and dFdy: the difference between two pixels of a 2 x 2 group, equal for both."""
    sign = -1.0 if int(pixel[0] * step[0] + pixel[1] * step[1]) % 2 == 1 else 1.0
    x, y, w = view_point(to_unit, (pixel[0] + sign * step[0], pixel[1] + sign * step[1]))
    return sign * (x / w - center[0]), sign * (y / w - center[1])


@kernel
def view_coverage(quads: List, curves: List, to_unit: List, pixel: Vec2) -> float:
    x, y, w = view_point(to_unit, pixel)
    if w <= abs(to_unit[2, 0]) + abs(to_unit[2, 1]):
        return 0.0
    center = (x / w, y / w)
    dx = view_step(to_unit, center, pixel, (1.0, 0.0))
    dy = view_step(to_unit, center, pixel, (0.0, 1.0))
    return coverage(quads, curves, center, dx, dy)


@kernel
def draw(quads: List, curves: List, to_unit: List, image: NDArray[np.float32]) -> None:
    for row in range(image.shape[0]):
        for column in range(image.shape[1]):
            image[row, column] = view_coverage(quads, curves, to_unit, (column + 0.5, row + 0.5))


def render_thesis_cpu(texture: ThesisPair, size: Size, view: ViewLike = None) -> NDArray[np.float32]:
    """Render a texture as the thesis's shader would with exact arithmetic; parameters as in `vexture.coverage`.

    Examples
    --------
    >>> from vexture.thesis.texture import ThesisTexture
    >>> full = ThesisTexture(np.zeros((1, 4, 3), np.uint8), np.zeros((2, 2, 3), np.uint8))
    >>> render_thesis_cpu(full, (1, 1))
    array([[1.]], dtype=float32)
    """
    width, height = size_of(size)
    image = np.empty((height, width), np.float32)
    largest = np.iinfo(texture.quads.dtype).max
    draw(texture.quads / largest, texture.curves / largest, view_matrix(view, (width, height)), image)
    return image
