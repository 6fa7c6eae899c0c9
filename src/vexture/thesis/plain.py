"""Cells that one path crosses once: their pieces need neither quantising nor resolving."""

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.area import area_right_of, integral_x_dy
from vexture.bezier.split import subcubic
from vexture.kernels import kernel
from vexture.thesis.boundary_chain import Chain
from vexture.thesis.subdivide import Cell
from vexture.tree.winding import inside, winding_area

__all__ = ["filled_sides", "plain_chain", "to_cell", "touches_edge"]


@kernel
def to_cell(cell: Cell) -> NDArray[np.float64]:
    """Pieces of a cell, (n, 4, 2), in its unit square; coordinates on its edge become exactly 0 or 1."""
    points = cell.pieces.points
    out = np.empty((len(points), 4, 2))
    for i in range(len(points)):
        for k in range(4):
            out[i, k, 0] = (points[i, k, 0] - cell.x0) / cell.size
            out[i, k, 1] = (points[i, k, 1] - cell.y0) / cell.size
    return out


@kernel(allocates=False)
def touches_edge(point: NDArray[np.float64]) -> bool:
    """Whether a coordinate of a point is exactly 0 or 1."""
    return point[0] == 0.0 or point[0] == 1.0 or point[1] == 0.0 or point[1] == 1.0


@kernel
def filled_sides(cell: Cell, curves: NDArray[np.float64], rule: int, signed_area: float) -> tuple[bool, bool]:
    """Whether the right and the left side of one chain from edge to edge are filled.

    The winding number is w on the right and w + 1 on the left, except in loops; its mean over the cell gives w.
    `curves` are the cell's pieces in its unit square, all of one path. `signed_area` is the area on the right of the
    chain, with loops counted by their direction.
    """
    w = int(np.rint(winding_area(curves, cell.present[0, 1], 1.0) - 1.0 + signed_area))
    return inside(w, rule), inside(w + 1, rule)


@kernel(allocates=False)
def _apart(a: NDArray[np.float64], b: NDArray[np.float64]) -> bool:
    """Whether the bounding boxes of two monotone pieces share no more than an edge."""
    for axis in range(2):
        if max(a[0, axis], a[3, axis]) <= min(b[0, axis], b[3, axis]):
            return True
        if max(b[0, axis], b[3, axis]) <= min(a[0, axis], a[3, axis]):
            return True
    return False


@kernel(allocates=False)
def _is_plain(curves: NDArray[np.float64]) -> bool:
    """Whether monotone pieces form one open chain between edges that cannot cross itself or follow an edge."""
    n = len(curves)
    for axis in range(2):
        for i in range(n):
            if curves[i, 0, axis] == curves[i, 3, axis] and (curves[i, 0, axis] == 0.0 or curves[i, 0, axis] == 1.0):
                return False
            if i > 0 and curves[i, 0, axis] != curves[i - 1, 3, axis]:
                return False
    if not (touches_edge(curves[0, 0]) and touches_edge(curves[n - 1, 3])):
        return False
    if curves[0, 0, 0] == curves[n - 1, 3, 0] and curves[0, 0, 1] == curves[n - 1, 3, 1]:  # closed
        return False
    for i in range(n):
        for j in range(i):
            if not _apart(curves[i], curves[j]):
                return False
    return True


@kernel
def plain_chain(cell: Cell, rules: NDArray[np.int64]) -> Chain:
    """Chain of a cell with one path if nothing in it needs to be resolved; else one of `chains` 2 without area."""
    curves = to_cell(cell)
    n, segment, span = len(curves), cell.pieces.segment, cell.pieces.span
    if not _is_plain(curves):
        return Chain(curves, segment, span, 2, 0.0)
    x_dy = 0.0
    for curve in curves:
        x_dy += integral_x_dy(curve)
    area = area_right_of(curves[0, 0], curves[n - 1, 3], x_dy)
    right, left = filled_sides(cell, curves, rules[cell.present[0, 0]], area)
    if right == left:
        return Chain(curves, segment, span, 0, 1.0 if right else 0.0)
    if right:
        return Chain(curves, segment, span, 1, area)
    turned = Chain(np.empty((n, 4, 2)), np.empty(n, np.int64), np.empty((n, 2)), 1, 1.0 - area)
    for i in range(n):
        subcubic(curves[n - 1 - i], 1.0, 0.0, turned.curves[i])
        turned.segment[i] = segment[n - 1 - i]
        turned.span[i, 0], turned.span[i, 1] = span[n - 1 - i, 1], span[n - 1 - i, 0]
    return turned
