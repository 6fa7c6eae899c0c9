"""Cut cubics into pieces that are monotone in x and in y."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.tolerance import PARAMETER
from vexture.bezier.roots import turning_points
from vexture.bezier.split import copy_curve, split

MOST_PARTS: Final = 5
"""Most pieces of a cubic: it turns at most twice in x and twice in y."""


class Pieces(NamedTuple):
    """Monotone pieces, n of them; a horizontal or vertical line meets a piece at most once."""

    points: NDArray[np.float64]  # (n, 4, 2): P0 P1 P2 P3
    path: NDArray[np.int64]  # (n,): path of each piece
    segment: NDArray[np.int64]  # (n,): cubic of the source that contains the piece
    span: NDArray[np.float64]  # (n, 2): parameters t0 < t1 of the piece on that cubic


@kernel
def empty_pieces(count: int) -> Pieces:
    """Allocate arrays for pieces."""
    return Pieces(
        np.empty((count, 4, 2), np.float64),
        np.empty(count, np.int64),
        np.empty(count, np.int64),
        np.empty((count, 2), np.float64),
    )


@kernel(allocates=False)
def _is_ordered(curve: NDArray[np.float64], axis: int) -> bool:
    """Return whether a coordinate of the control points never turns, so that the cubic's does not: a quick test."""
    a, b, c, d = curve[0, axis], curve[1, axis], curve[2, axis], curve[3, axis]
    return a <= b <= c <= d or a >= b >= c >= d


@kernel(allocates=False)
def is_monotone(curve: NDArray[np.float64]) -> bool:
    """Return whether the control points, and so the cubic, turn neither in x nor in y; finds all straight lines."""
    return _is_ordered(curve, 0) and _is_ordered(curve, 1)


@kernel(allocates=False)
def turns(curve: NDArray[np.float64], out: NDArray[np.float64]) -> int:
    """Write the parameters at which x or y turns, in ascending order; return their number (0 to 4)."""
    if is_monotone(curve):
        return 0
    count = turning_points(curve[0, 0], curve[1, 0], curve[2, 0], curve[3, 0], out)
    count += turning_points(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], out[count:])
    for i in range(1, count):
        t, k = out[i], i
        while k > 0 and out[k - 1] > t:
            out[k] = out[k - 1]
            k -= 1
        out[k] = t
    return count


@kernel
def write_monotone(cubics: NDArray[np.float64], path: NDArray[np.int64], out: Pieces) -> int:
    """Write the pieces of `monotone_pieces` to `out`, whose `segment` and `span` may be empty; return their number."""
    at = np.empty(4)
    rest = np.empty((4, 2))
    count, with_spans = 0, len(out.segment) > 0
    for i in range(len(cubics)):
        copy_curve(cubics[i], rest)
        turn_count = turns(cubics[i], at)
        t0 = 0.0
        for k in range(turn_count + 1):
            t1 = at[k] if k < turn_count else 1.0
            if k < turn_count and t1 - t0 < PARAMETER:
                continue
            piece = out.points[count]
            if k < turn_count:
                split(rest, (t1 - t0) / (1.0 - t0), piece, rest)
            else:
                copy_curve(rest, piece)
            out.path[count] = path[i]
            if with_spans:
                out.segment[count] = i
                out.span[count, 0], out.span[count, 1] = t0, t1
            t0 = t1
            if piece[0, 0] != piece[3, 0] or piece[0, 1] != piece[3, 1]:
                count += 1
    return count


@kernel
def monotone_pieces(cubics: NDArray[np.float64], path: NDArray[np.int64]) -> Pieces:
    """Split the cubics (m, 4, 2) of contours where x or y turns; `path` (m,) is the path of each.

    The pieces keep the order of the cubics. Pieces whose ends coincide are dropped; common end points are equal bit for
    bit.
    """
    out = empty_pieces(MOST_PARTS * len(cubics))
    count = write_monotone(cubics, path, out)
    return Pieces(out.points[:count], out.path[:count], out.segment[:count], out.span[:count])
