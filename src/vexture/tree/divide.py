"""Dividing a cell: its pieces are cut at the cell's middle lines and listed for its children.

All pieces are in one pool, and a cell is a list of numbers of pieces. So dividing moves numbers, and copies only pieces
that are cut. A cell is cut at its middle lines, x first. The cut coordinate is set exactly in both halves, so that
neighbouring cells share the same floating-point point and no seam can open between them. The other coordinate is
rounded to a lattice, so that a line through a cell's corner leaves no sliver beside it, and leaves of any depth can
hold the point exactly; so is that of an end that lies on the line already. A piece goes to the upper (right) child iff
**both** its ends are at or beyond the line: a decision by their midpoint fails where it rounds up.

Cells are divided depth first. What a cell appended to the pool and to the lists is discarded when all cells below it
are done, so both stay small and in the processor's cache.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.roots import solve_monotone
from vexture.bezier.split import copy_curve, split
from vexture.kernels import kernel

__all__ = ["PARTS", "PiecePool", "child_of", "divide", "snap"]

PARTS = 4
"""Most parts of one piece: each of the two middle lines cuts it at most once."""


class PiecePool(NamedTuple):
    """The pieces of all cells that are not done, and lists of their numbers."""

    points: NDArray[np.float64]  # (room, 4, 2): pieces
    path: NDArray[np.int64]  # (room,): the path of each
    numbers: NDArray[np.int64]  # (room,): lists of pieces, one after another
    child: NDArray[np.int64]  # (room,), scratch: the child that each part belongs to
    part: NDArray[np.int64]  # (room,), scratch: the number of each part


@kernel(allocates=False)
def _cut(
    points: NDArray[np.float64], path: NDArray[np.int64], i: int, axis: int, line: float, grain: float, count: int
) -> int:
    """Cut piece i where it crosses a line, and write its second part to place `count`; return the new count."""
    a, d = points[i, 0, axis], points[i, 3, axis]
    if a == line:
        snap(points[i], 0, 1 - axis, grain)
    if d == line:
        snap(points[i], 3, 1 - axis, grain)
    if not ((a < line < d) or (d < line < a)):
        return count
    t = solve_monotone(a, points[i, 1, axis], points[i, 2, axis], d, line)
    split(points[i], t, points[i], points[count])
    points[i, 3, axis], points[count, 0, axis] = line, line
    snap(points[i], 3, 1 - axis, grain)
    snap(points[count], 0, 1 - axis, grain)
    path[count] = path[i]
    return count + 1


@kernel(allocates=False)
def divide(
    pool: PiecePool, first: int, last: int, xm: float, ym: float, grain: float, pieces: int, child_at: NDArray[np.int64]
) -> int:
    """Append the lists of a cell's four children behind its own list, first..last-1; return the new number of pieces.

    `xm` and `ym` are the cell's middle, `grain` the spacing of the lattice to which points on the middle lines are
    rounded, and `pieces` the number of pieces in the pool, which must have room. The start of each child's list is
    written to `child_at` (5,).
    """
    points, path, numbers, owner, part = pool.points, pool.path, pool.numbers, pool.child, pool.part
    parts, lower, right_lower, upper = 0, 0, 0, 0
    for place in range(first, last):
        i = numbers[place]
        x, y = points[i, 0, 0], points[i, 0, 1]
        if (x - xm) * (points[i, 3, 0] - xm) > 0.0 and (y - ym) * (points[i, 3, 1] - ym) > 0.0:
            child = (1 if x > xm else 0) + (2 if y > ym else 0)
            owner[parts], part[parts] = child, i
            lower += child == 0
            right_lower += child == 1
            upper += child == 2
            parts += 1
            continue
        whole = pieces
        copy_curve(points[i], points[whole])
        path[whole] = path[i]
        right = _cut(points, path, whole, 0, xm, grain, whole + 1)
        pieces = _cut(points, path, whole, 1, ym, grain, right)
        if right > whole + 1:
            pieces = _cut(points, path, whole + 1, 1, ym, grain, pieces)
        for k in range(whole, pieces):
            if points[k, 0, 0] != points[k, 3, 0] or points[k, 0, 1] != points[k, 3, 1]:
                child = child_of(points[k], xm, ym)
                owner[parts], part[parts] = child, k
                lower += child == 0
                right_lower += child == 1
                upper += child == 2
                parts += 1
    child_at[0], child_at[1] = last, last + lower
    child_at[2], child_at[3] = last + lower + right_lower, last + lower + right_lower + upper
    for k in range(parts):
        numbers[child_at[owner[k]]] = part[k]
        child_at[owner[k]] += 1
    for child in range(4, 0, -1):  # each start has become the next one's
        child_at[child] = child_at[child - 1]
    child_at[0] = last
    return pieces


@kernel(allocates=False)
def snap(curve: NDArray[np.float64], end: int, axis: int, grain: float) -> None:
    """Round one coordinate of an end to a lattice; the control point beside the end moves along."""
    snapped = np.rint(curve[end, axis] / grain) * grain
    curve[1 if end == 0 else 2, axis] += snapped - curve[end, axis]
    curve[end, axis] = snapped


@kernel(allocates=False)
def child_of(curve: NDArray[np.float64], xm: float, ym: float) -> int:
    """Number of the child, (x half) + 2 (y half), of a piece that crosses no middle line."""
    right = 1 if curve[0, 0] >= xm and curve[3, 0] >= xm else 0
    upper = 2 if curve[0, 1] >= ym and curve[3, 1] >= ym else 0
    return right + upper
