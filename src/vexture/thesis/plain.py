"""A cell that one path crosses once, plainly: nothing in it needs to be quantised or resolved."""

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
    """Cubics, (n, 4, 2), in the unit square of a cell; exactly 0 or 1 for what lies on its edge."""
    out = np.empty((len(points), 4, 2))
    for i in range(len(points)):
        for k in range(4):
            out[i, k, 0] = (points[i, k, 0] - x0) / size
            out[i, k, 1] = (points[i, k, 1] - y0) / size
    return out


@kernel(allocates=False)
def touches_edge(point: NDArray[np.float64]) -> bool:
    """Whether a point lies exactly on a line of the unit square's edge."""
    return point[0] == 0.0 or point[0] == 1.0 or point[1] == 0.0 or point[1] == 1.0


@kernel
def filled_sides(curves: NDArray[np.float64], corner_winding: int, rule: int, signed_area: float) -> tuple[bool, bool]:
    """Whether the right and the left side of one chain from edge to edge are filled.

    The winding number is w on the right and w + 1 on the left, loops aside; its mean over the cell tells w.

    Parameters
    ----------
    curves : (n, 4, 2) float64 array
        The chain's monotone pieces in the cell's unit square: all that is in the cell of its path.
    corner_winding, rule : int
        Of that path.
    signed_area : float
        Area on the right of the chain, that of its loops counted by their direction.
    """
    w = int(np.rint(winding_area(curves, corner_winding, 1.0) - 1.0 + signed_area))
    return inside(w, rule), inside(w + 1, rule)


@kernel(allocates=False)
def _apart(a: NDArray[np.float64], b: NDArray[np.float64]) -> bool:
    """Whether the boxes of two monotone pieces, which their ends span, share no more than an edge."""
    for axis in range(2):
        if max(a[0, axis], a[3, axis]) <= min(b[0, axis], b[3, axis]):
            return True
        if max(b[0, axis], b[3, axis]) <= min(a[0, axis], a[3, axis]):
            return True
    return False


@kernel(allocates=False)
def _is_plain(curves: NDArray[np.float64]) -> bool:
    """Whether monotone pieces are one open chain from edge to edge that cannot cross itself nor follows the edge."""
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
    """Chain of a cell in which nothing needs to be resolved, and its exact filled area.

    Parameters
    ----------
    pieces : Pieces
        Those of the cell, all of one path, are first..last-1.
    corner_winding, rule : int
        Of that path.
    x0, y0, size : float
        The cell.

    Returns
    -------
    Chain
        Of `chains` 1, or 0 if both sides are the same; 2 if the cell is not so simple.
    float
        Filled part of the cell.
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
