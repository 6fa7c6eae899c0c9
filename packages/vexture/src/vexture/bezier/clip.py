"""Clip contours to a box without changing any winding number inside it.

A part beyond a side of the box is replaced by its shadow on that side: the straight line between its projected ends.
Seen from a point inside the box, the line and the replaced curve turn by the same angle. So all winding numbers inside
stay the same, and the result is right for every fill rule.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.roots import cubic_at, solve_monotone, turning_points
from vexture.bezier.split import copy_curve, subcubic

MOST_PIECES = 4
"""Most pieces of a cubic that a line cuts: they meet at most three times."""

Corner = Sequence[float] | NDArray[np.float64]


def clip_contour(contour: NDArray[np.float64], low: Corner, high: Corner) -> NDArray[np.float64]:
    """Clip a closed contour (n, 4, 2) to the box between the points `low` and `high`.

    Each cubic of a closed contour starts, bit for bit, where the one before it ends; so does each cubic of the result
    (m, 4, 2). No end point leaves the box, and cut points lie exactly on it. Control points may lie outside. m is 0 if
    only lines along one side are left.
    """
    corners = np.asarray(low, np.float64), np.asarray(high, np.float64)
    return clip_to_box(np.ascontiguousarray(contour, np.float64), *corners)


@kernel
def clip_to_box(
    contour: NDArray[np.float64], low: NDArray[np.float64], high: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Clip a closed contour as `clip_contour` does; a contour that needs no cut is returned itself."""
    for axis in range(2):
        for end in range(2):
            bound, side = (low[axis], 1.0) if end == 0 else (high[axis], -1.0)
            if _is_beyond(contour, axis, bound, side):
                pieces = np.empty((MOST_PIECES * len(contour), 4, 2))
                contour = pieces[: _drop_points(pieces, cut_to_side(contour, axis, bound, side, pieces))]
    hold_ends(contour, low, high)  # rounding may leave a cut point one unit in the last place outside another side
    return contour


@kernel(allocates=False)
def hold_ends(contour: NDArray[np.float64], low: NDArray[np.float64], high: NDArray[np.float64]) -> None:
    """Move the ends of cubics into a box."""
    for i in range(len(contour)):
        for end in (0, 3):
            for axis in range(2):
                contour[i, end, axis] = min(max(contour[i, end, axis], low[axis]), high[axis])


@kernel(allocates=False)
def _is_beyond(contour: NDArray[np.float64], axis: int, bound: float, side: float) -> bool:
    """Whether any control point lies beyond a line."""
    for i in range(len(contour)):
        for k in range(4):
            if (contour[i, k, axis] - bound) * side < 0.0:
                return True
    return False


@kernel(allocates=False)
def _drop_points(pieces: NDArray[np.float64], count: int) -> int:
    """Leave out pieces that are points; return the number of the others."""
    left = 0
    for i in range(count):
        is_point = True
        for k in range(1, 4):
            is_point = is_point and pieces[i, k, 0] == pieces[i, 0, 0] and pieces[i, k, 1] == pieces[i, 0, 1]
        if not is_point:
            copy_curve(pieces[i], pieces[left])
            left += 1
    return left


@kernel
def cut_to_side(contour: NDArray[np.float64], axis: int, bound: float, side: float, pieces: NDArray[np.float64]) -> int:
    """Write the parts where ``(coordinate - bound) * side >= 0``, and the shadows of the others on the line.

    Consecutive shadows are merged. Returns the number of pieces.
    """
    cuts = np.empty(MOST_PIECES + 1)
    count = 0
    in_shadow = False
    for k in range(len(contour)):
        curve = contour[k]
        last = crossings(curve, axis, bound, cuts)
        x, y = curve[0, 0], curve[0, 1]
        for n in range(last):
            piece = pieces[count]
            subcubic(curve, cuts[n], cuts[n + 1], piece)
            piece[0, 0], piece[0, 1] = x, y
            if n == last - 1:
                piece[3, 0], piece[3, 1] = curve[3, 0], curve[3, 1]
            else:
                piece[3, axis] = bound
            x, y = piece[3, 0], piece[3, 1]
            middle = cubic_at(piece[0, axis], piece[1, axis], piece[2, axis], piece[3, axis], 0.5)
            # the piece does not cross the line, and at least one of these three points is off it
            if (piece[0, axis] + middle + piece[3, axis] - 3.0 * bound) * side >= 0.0:
                in_shadow = False
                count += 1
                continue
            if in_shadow:
                count -= 1
                pieces[count, 3, 0], pieces[count, 3, 1] = x, y
            shadow(pieces[count], axis, bound)
            in_shadow = True
            count += 1
    return count


@kernel
def crossings(curve: NDArray[np.float64], axis: int, bound: float, cuts: NDArray[np.float64]) -> int:
    """Write 0, the parameters where a cubic crosses a line, and 1; return the number of pieces between them."""
    turns = np.empty(2)
    part = np.empty((4, 2))
    turned = turning_points(curve[0, axis], curve[1, axis], curve[2, axis], curve[3, axis], turns)
    cuts[0] = 0.0
    count = 1
    start = 0.0
    for n in range(turned + 1):
        end = turns[n] if n < turned else 1.0
        subcubic(curve, start, end, part)
        if (part[0, axis] - bound) * (part[3, axis] - bound) < 0.0:
            t = solve_monotone(part[0, axis], part[1, axis], part[2, axis], part[3, axis], bound)
            cuts[count] = start + (end - start) * t
            count += 1
        start = end
    cuts[count] = 1.0
    return count


@kernel
def shadow(piece: NDArray[np.float64], axis: int, bound: float) -> None:
    """Replace a piece by the straight line between the projections of its ends."""
    free = 1 - axis
    along = piece[3, free] - piece[0, free]
    piece[1, free] = piece[0, free] + along / 3.0
    piece[2, free] = piece[0, free] + along * (2.0 / 3.0)
    for k in range(4):
        piece[k, axis] = bound
