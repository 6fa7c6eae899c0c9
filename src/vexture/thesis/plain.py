"""Cells that one path crosses once: their pieces need neither quantising nor resolving."""

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.area import area_right_of, integral_x_dy
from vexture.bezier.monotone import Pieces
from vexture.bezier.split import subcubic
from vexture.kernels import kernel
from vexture.thesis.boundary_chain import Chain
from vexture.tree.winding import inside, winding_area

__all__ = ["filled_sides", "plain_chain", "to_cell", "touches_edge"]


@kernel
def to_cell(points: NDArray[np.float64], x0: float, y0: float, size: float) -> NDArray[np.float64]:
    """Cubics, (n, 4, 2), in the unit square of a cell; coordinates on its edge become exactly 0 or 1."""
    out = np.empty((len(points), 4, 2))
    for i in range(len(points)):
        for k in range(4):
            out[i, k, 0] = (points[i, k, 0] - x0) / size
            out[i, k, 1] = (points[i, k, 1] - y0) / size
    return out


@kernel(allocates=False)
def touches_edge(point: NDArray[np.float64]) -> bool:
    """Whether a coordinate of a point is exactly 0 or 1."""
    return point[0] == 0.0 or point[0] == 1.0 or point[1] == 0.0 or point[1] == 1.0


@kernel
def filled_sides(curves: NDArray[np.float64], corner_winding: int, rule: int, signed_area: float) -> tuple[bool, bool]:
    """Whether the right and the left side of one chain from edge to edge are filled.

    The winding number is w on the right and w + 1 on the left, except in loops; its mean over the cell gives w.
    `curves` are the chain's monotone pieces in the cell's unit square, all that the cell holds of the path.
    `signed_area` is the area on the right of the chain, with loops counted by their direction.
    """
    w = int(np.rint(winding_area(curves, corner_winding, 1.0) - 1.0 + signed_area))
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
def plain_chain(
    pieces: Pieces, first: int, last: int, corner_winding: int, rule: int, x0: float, y0: float, size: float
) -> tuple[Chain, float]:
    """Chain of a cell in which nothing needs to be resolved, and the exact filled part of the cell.

    Parameters as in `vexture.thesis.leaf.own_leaf`. The chain's `chains` is 0 if both sides are the same, and 2 if the
    cell is not so simple.
    """
    n = last - first
    curves = to_cell(pieces.points[first:last], x0, y0, size)
    chain = Chain(curves, pieces.segment[first:last], pieces.span[first:last], 1)
    if not _is_plain(curves):
        return Chain(curves, chain.segment, chain.span, 2), 0.0
    x_dy = 0.0
    for curve in curves:
        x_dy += integral_x_dy(curve)
    area = area_right_of(curves[0, 0], curves[n - 1, 3], x_dy)
    right, left = filled_sides(curves, corner_winding, rule, area)
    if right == left:
        return Chain(curves, chain.segment, chain.span, 0), 1.0 if right else 0.0
    if right:
        return chain, area
    turned = Chain(np.empty((n, 4, 2)), np.empty(n, np.int64), np.empty((n, 2)), 1)
    for i in range(n):
        subcubic(curves[n - 1 - i], 1.0, 0.0, turned.curves[i])
        turned.segment[i] = chain.segment[n - 1 - i]
        turned.span[i, 0], turned.span[i, 1] = chain.span[n - 1 - i, 1], chain.span[n - 1 - i, 0]
    return turned, 1.0 - area
