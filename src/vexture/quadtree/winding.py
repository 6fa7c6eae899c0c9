"""Winding numbers, counted and never solved for.

The winding number of a point is the sum of -sign(dy) over the pieces that cross the ray from it to x = -infinity,
each over its half-open range of y. A cell keeps one integer for each path in it, the *corner winding* Wc, such that
anywhere in the cell

    W(p) = Wc + (starts on the left edge at or below p) - (ends there) + sum of -sign(dy) over pieces left of p.

Pieces on the left edge, corners hit exactly and tangencies all telescope in this rule, and the children's corner
windings follow from their parent's by comparing and counting alone.
"""

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.area import integral_x_dy
from vexture.bezier.monotone import Pieces
from vexture.kernels import kernel

__all__ = ["child_windings", "inside", "winding_area"]


@kernel
def inside(winding: int, rule: int) -> bool:
    """Whether a winding number is inside by a `FillRule`.

    Examples
    --------
    >>> inside(2, 0), inside(2, 1)
    (True, False)
    """
    if rule == 1:
        return (winding & 1) != 0
    return winding != 0


@kernel
def child_windings(
    pieces: Pieces,
    child_at: NDArray[np.int64],
    present: NDArray[np.int64],
    x0: float,
    y0: float,
    xm: float,
    ym: float,
) -> NDArray[np.int64]:
    """Corner windings of a cell's four children.

    Parameters
    ----------
    pieces : Pieces
        Those of child c are ``child_at[c] .. child_at[c + 1] - 1``, in the order of `present`.
    child_at : (5,) int64 array
        Where each child's pieces start.
    present : (n, 2) int64 array
        The paths in the cell and their corner windings.
    x0, y0, xm, ym : float
        The cell's bottom-left corner and its middle.

    Returns
    -------
    (n, 8) int64 array
        For each path the four corner windings, then whether it has a piece in each child.
    """
    out = np.zeros((len(present), 8), np.int64)
    at = child_at[:4].copy()
    for k in range(len(present)):
        low_edge = 0  # events on the left edge of child 0, its top included
        corner = np.zeros(4, np.int64)  # events on child c's left edge, at its bottom
        bottom = np.zeros(4, np.int64)  # sum of -sign(dy) over child c's pieces that start from its bottom
        for child in range(4):
            cx = x0 if (child & 1) == 0 else xm
            cy = y0 if child < 2 else ym
            while at[child] < child_at[child + 1] and pieces.path[at[child]] == present[k, 0]:
                curve = pieces.points[at[child]]
                at[child] += 1
                out[k, 4 + child] = 1
                for end, event in ((0, 1), (3, -1)):
                    if curve[end, 0] == cx:
                        if child == 0:
                            low_edge += event
                        if curve[end, 1] == cy:
                            corner[child] += event
                if curve[0, 1] != curve[3, 1] and min(curve[0, 1], curve[3, 1]) == cy:
                    bottom[child] += -1 if curve[3, 1] > curve[0, 1] else 1
        out[k, 0] = present[k, 1]
        out[k, 1] = out[k, 0] + corner[0] + bottom[0] - corner[1]
        out[k, 2] = out[k, 0] + low_edge
        out[k, 3] = out[k, 2] + corner[2] + bottom[2] - corner[3]
    return out


@kernel
def winding_area(curves: NDArray[np.float64], corner_winding: int) -> float:
    """Integral of the winding number over a cell, from its pieces in cell-local coordinates.

    Where the winding number is 0 or 1 this is the exact coverage.

    Parameters
    ----------
    curves : (n, 4, 2) float64 array
        Pieces of one path in the cell's unit square; x is exactly 0 for points on its left edge.
    corner_winding : int
        The path's Wc.

    Examples
    --------
    >>> rising = np.array([[[0.25, 0.0], [0.25, 1 / 3], [0.25, 2 / 3], [0.25, 1.0]]])
    >>> winding_area(rising, 1)
    0.25
    """
    area = float(corner_winding)
    for curve in curves:
        if curve[0, 0] == 0.0:
            area += 1.0 - curve[0, 1]
        if curve[3, 0] == 0.0:
            area -= 1.0 - curve[3, 1]
        area += curve[0, 1] - curve[3, 1] + integral_x_dy(curve)
    return area
