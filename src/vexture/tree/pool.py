"""Pieces in a pool, cells as lists of their numbers: cutting a cell moves numbers and copies only what is cut.

A cell is cut at its middle lines, x first. The cut coordinate is set exactly in both halves, so that neighbouring
cells share the same floating-point point and no seam can open between them; the other coordinate is rounded to a
lattice, so that a line through a cell's corner leaves no sliver beside it and leaves of any depth can hold the point
exactly. So is that of an end which lies on the line already. A piece goes to the upper (right) child iff **both** its
ends are at or beyond the line: a decision by their midpoint fails where it rounds up.

Cells are divided depth first. What a cell appended to the pool and to the lists is forgotten once all below it is
done, so both stay small and in the processor's cache.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.roots import solve_monotone
from vexture.bezier.split import copy_curve, split
from vexture.kernels import kernel

__all__ = ["MOST_QUADS", "PARTS", "Pool", "child_of", "divide", "new_pool", "pool_with_room", "snap", "with_room"]

PARTS = 4
"""Most parts of one piece: each of the two middle lines cuts it at most once."""

MOST_QUADS = 2_000_000
"""Largest tree that is built, some 200 MB."""


class Pool(NamedTuple):
    """Growing arrays.

    Attributes
    ----------
    points : (room, 4, 2) float64 array
        Pieces.
    path : (room,) int64 array
        The path of each.
    numbers : (room,) int64 array
        Lists of pieces, one after another.
    child : (room,) int64 array
        Scratch: the child that each part belongs to.
    part : (room,) int64 array
        Scratch: the number of each part.
    """

    points: NDArray[np.float64]
    path: NDArray[np.int64]
    numbers: NDArray[np.int64]
    child: NDArray[np.int64]
    part: NDArray[np.int64]


@kernel
def new_pool(points: NDArray[np.float64], path: NDArray[np.int64]) -> Pool:
    """Pool of pieces, with one list that holds them all."""
    n = len(path)
    numbers = np.empty(n, np.int64)
    for i in range(n):
        numbers[i] = i
    return Pool(points, path, numbers, np.empty(0, np.int64), np.empty(0, np.int64))


@kernel
def _longer(values: NDArray[np.int64], count: int, room: int) -> NDArray[np.int64]:
    """First values of an array, with room for more."""
    out = np.empty(room, np.int64)
    for i in range(count):
        out[i] = values[i]
    return out


@kernel
def pool_with_room(pool: Pool, pieces: int, numbers: int, parts: int) -> Pool:
    """Larger pool, with room for parts behind its first pieces and its first numbers."""
    points = np.empty((2 * pieces + parts, 4, 2))
    for i in range(pieces):
        copy_curve(pool.points[i], points[i])
    room = 2 * numbers + parts
    return Pool(
        points,
        _longer(pool.path, pieces, len(points)),
        _longer(pool.numbers, numbers, room),
        np.empty(room, np.int64),
        np.empty(room, np.int64),
    )


@kernel(allocates=False)
def _cut(
    points: NDArray[np.float64], path: NDArray[np.int64], i: int, axis: int, line: float, grain: float, count: int
) -> int:
    """Cut piece i where it crosses a line, its second part to place `count`; return the new count."""
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
    pool: Pool, first: int, last: int, xm: float, ym: float, grain: float, pieces: int, child_at: NDArray[np.int64]
) -> int:
    """Lists of a cell's four children, behind its own list; return the new number of pieces in the pool.

    Parameters
    ----------
    pool : Pool
        With room; the cell's list is numbers first..last-1.
    xm, ym : float
        The cell's middle.
    grain : float
        Spacing of the lattice that points on the middle lines are rounded to.
    pieces : int
        Number of pieces in the pool.
    child_at : (5,) int64 array
        Written: where each child's list starts.
    """
    points, path, numbers, owner, part = pool.points, pool.path, pool.numbers, pool.child, pool.part
    parts = 0
    for place in range(first, last):
        i = numbers[place]
        x, y = points[i, 0, 0], points[i, 0, 1]
        if (x - xm) * (points[i, 3, 0] - xm) > 0.0 and (y - ym) * (points[i, 3, 1] - ym) > 0.0:
            owner[parts], part[parts] = (1 if x > xm else 0) + (2 if y > ym else 0), i
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
                owner[parts], part[parts] = child_of(points[k], xm, ym), k
                parts += 1
    for child in range(4):
        child_at[child] = 0
    for k in range(parts):
        child_at[owner[k]] += 1
    start = last
    for child in range(4):
        start, child_at[child] = start + child_at[child], start
    for k in range(parts):
        numbers[child_at[owner[k]]] = part[k]
        child_at[owner[k]] += 1
    for child in range(4, 0, -1):  # each start has become the next one's
        child_at[child] = child_at[child - 1]
    child_at[0] = last
    return pieces


@kernel(allocates=False)
def snap(curve: NDArray[np.float64], end: int, axis: int, grain: float) -> None:
    """Round one coordinate of an end to a lattice; the control point beside it moves along."""
    snapped = np.rint(curve[end, axis] / grain) * grain
    curve[1 if end == 0 else 2, axis] += snapped - curve[end, axis]
    curve[end, axis] = snapped


@kernel(allocates=False)
def child_of(curve: NDArray[np.float64], xm: float, ym: float) -> int:
    """Child that a piece which crosses no middle line belongs to: (x half) + 2 (y half)."""
    right = 1 if curve[0, 0] >= xm and curve[3, 0] >= xm else 0
    upper = 2 if curve[0, 1] >= ym and curve[3, 1] >= ym else 0
    return right + upper


@kernel
def with_room(rows: NDArray[np.float64], count: int, room: int) -> NDArray[np.float64]:
    """Array of rows with room for more behind the first `count`; itself if it has that, else twice as large."""
    if count + room <= len(rows):
        return rows
    out = np.empty((2 * count + room, rows.shape[1], rows.shape[2]))
    for i in range(count):
        for j in range(rows.shape[1]):
            for k in range(rows.shape[2]):
                out[i, j, k] = rows[i, j, k]
    return out
