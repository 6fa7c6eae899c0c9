"""Winding numbers, which are counted rather than computed geometrically.

The winding number of a point is the sum of -sign(dy) over the pieces that cross the ray from it to x = -infinity, each
over its half-open range of y. A cell has one integer for each path in it, the *corner winding* Wc, such that anywhere
in the cell

    W(p) = Wc + (starts on the left edge at or below p) - (ends there) + sum of -sign(dy) over pieces left of p.

The rule needs no special case for pieces on the left edge, pieces through a corner, or tangencies. The children's
corner windings follow from their parent's by comparisons and counting alone.
"""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.area import integral_x_dy

Lists = tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]
"""Pieces, the path of each, lists of piece numbers, and runs, as in a `PiecePool`."""


@kernel(allocates=False)
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


@kernel(allocates=False)
def child_windings(
    lists: Lists,
    child_at: NDArray[np.int64],
    present: NDArray[np.int64],
    x0: float,
    y0: float,
    half: float,
    whole: int,
    out: NDArray[np.int64],
) -> None:
    """Write the corner windings of a cell's four children to `out` (m or more, 8).

    Each row describes one path in `present`: four corner windings, then whether the path has a piece in each child.
    `lists` hold a list of pieces for each child, in the order of `present`; `child_at` (5 or more,) holds each list's
    start and the last one's end. The children are `half` wide, and the first one's corner is (x0, y0). Runs, and the
    first `whole` pieces, which were never cut, end on the lines of no cell: they change no winding at its corners.
    """
    points, path, numbers, runs = lists
    whole = whole if x0 > 0.0 and y0 > 0.0 else 0  # they may end on the sides of the unit square
    for k in range(len(present)):
        for column in range(8):
            out[k, column] = 0
    for child in range(4):
        cx = x0 if (child & 1) == 0 else x0 + half
        cy = y0 if child < 2 else y0 + half
        k = 0
        for place in range(child_at[child], child_at[child + 1]):
            i = numbers[place]
            owner = path[i] if i >= 0 else runs[-1 - i, 2]
            while present[k, 0] != owner:
                k += 1
            out[k, 4 + child] = 1
            if i < whole:
                continue
            for end, event in ((0, 1), (3, -1)):
                if points[i, end, 0] == cx:
                    at_bottom = points[i, end, 1] == cy
                    if child == 0:
                        out[k, 2] += event  # the left edge of child 0, its top included, is all that is below child 2
                        out[k, 1] += event if at_bottom else 0
                    elif at_bottom:
                        out[k, child] += -event if child != 2 else 0
                        out[k, 3] += event if child == 2 else 0
            a, d = points[i, 0, 1], points[i, 3, 1]
            if a != d and min(a, d) == cy and (child == 0 or child == 2):
                out[k, child + 1] += -1 if d > a else 1
    for k in range(len(present)):
        out[k, 0] = present[k, 1]
        out[k, 1] += out[k, 0]
        out[k, 2] += out[k, 0]
        out[k, 3] += out[k, 2]


@kernel(allocates=False)
def winding_area(curves: NDArray[np.float64], corner_winding: int, side: float) -> float:
    """Mean winding number over a cell of width `side`, which is the exact coverage if all winding numbers are 0 or 1.

    The origin of `curves` is the cell's bottom-left corner; x is exactly 0 for points on its left edge.

    Examples
    --------
    >>> rising = np.array([[[0.25, 0.0], [0.25, 1 / 3], [0.25, 2 / 3], [0.25, 1.0]]])
    >>> winding_area(rising, 1, 1.0)
    0.25
    """
    area = corner_winding * side * side
    for i in range(len(curves)):
        if curves[i, 0, 0] == 0.0:
            area += side * (side - curves[i, 0, 1])
        if curves[i, 3, 0] == 0.0:
            area -= side * (side - curves[i, 3, 1])
        area += side * (curves[i, 0, 1] - curves[i, 3, 1]) + integral_x_dy(curves[i])
    return area / (side * side)
