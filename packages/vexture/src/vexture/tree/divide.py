"""Dividing a cell: its pieces are cut at the cell's middle lines and listed for its children.

All pieces are in one pool, and a cell is a list of numbers of pieces. So dividing moves numbers, and copies only pieces
that are cut. A cell is cut at its middle lines, x first. The cut coordinate is set exactly in both halves, so that
neighbouring cells share the same floating-point point and no seam can open between them. The other coordinate is
rounded to a lattice, so that a line through a cell's corner leaves no sliver beside it, and leaves of any depth can
hold the point exactly. An end that already lies on the line is rounded as well. A piece goes to the upper (right) child
iff **both** its ends are at or beyond the line: a decision by their midpoint fails where it rounds up.

Most pieces of a coast lie, with many neighbours along their contour, far inside one of a cell's children. So the lists
of crowded cells hold *runs*: up to 16 consecutive cubics of the drawing under one negative number. A run whose box
meets no middle line moves as a whole; the cubics of any other run are copied into the pool. The list of a cell that may
become a leaf holds no runs.

Cells are divided depth first. When all cells below a cell are done, the rows that it appended to the pool and to the
lists are free again, so both stay small and in the processor's cache.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.monotone import Pieces, is_monotone, write_monotone
from vexture.bezier.roots import solve_monotone
from vexture.bezier.split import copy_curve, split

PARTS = 4
"""Most parts of one piece: each of the two middle lines cuts it at most once."""

RUN = 16
"""Most pieces in a run."""

CROWDED = 512
"""Pieces. A shorter list holds no runs."""


class PiecePool(NamedTuple):
    """The pieces of all cells that are not done yet, and lists of their numbers."""

    points: NDArray[np.float64]  # (room, 4, 2): pieces that are in no run
    path: NDArray[np.int64]  # (room,): the path of each
    numbers: NDArray[np.int64]  # (room,): lists of pieces, one after another; -1 - k is run k
    child: NDArray[np.int64]  # (room,), scratch: the child that each part belongs to
    part: NDArray[np.int64]  # (room,), scratch: the number of each part
    boxes: NDArray[np.float64]  # (runs, 4): least x and y, greatest x and y of each run
    runs: NDArray[np.int64]  # (runs, 3): first cubic of each run, the cubic after its last, and its path
    cubics: NDArray[np.float64]  # (n, 4, 2): the drawing's cubics, which are only read


class Cell(NamedTuple):
    """A cell, whose pieces are the pool's numbers first..last-1, in the order of its paths."""

    x: float  # of the bottom-left corner
    y: float
    size: float
    first: int
    last: int


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
def _is_run(cubics: NDArray[np.float64], box: NDArray[np.float64]) -> bool:
    """Whether consecutive cubics may be a run; write its box.

    They must be monotone, have different ends, and lie in the unit square off its left and lower sides, where windings
    are counted.
    """
    box[0] = box[1] = np.inf
    box[2] = box[3] = -np.inf
    for i in range(len(cubics)):
        x, y, to_x, to_y = cubics[i, 0, 0], cubics[i, 0, 1], cubics[i, 3, 0], cubics[i, 3, 1]
        if (x == to_x and y == to_y) or not is_monotone(cubics[i]):
            return False
        box[0], box[1] = min(box[0], x, to_x), min(box[1], y, to_y)
        box[2], box[3] = max(box[2], x, to_x), max(box[3], y, to_y)
    return box[0] > 0.0 and box[1] > 0.0 and box[2] <= 1.0 and box[3] <= 1.0


@kernel(allocates=False)
def _run_end(cubics: NDArray[np.float64], owner: NDArray[np.int64], first: int) -> int:
    """Number of the cubic after the longest run that may start with cubic `first`, all in one contour."""
    last = first + 1
    while last < min(first + RUN, len(cubics)) and owner[last] == owner[first]:
        if cubics[last, 0, 0] != cubics[last - 1, 3, 0] or cubics[last, 0, 1] != cubics[last - 1, 3, 1]:
            break
        last += 1
    return last


@kernel
def list_all(pool: PiecePool, owner: NDArray[np.int64]) -> tuple[int, int, int]:
    """List a drawing, in runs if the pool has rows for them; return the numbers of list entries, pieces and runs.

    `owner` (n,) is the path of each cubic.
    """
    numbers, cubics = pool.numbers, pool.cubics
    end, pieces, runs, first = 0, 0, 0, 0
    while first < len(cubics):
        last = _run_end(cubics, owner, first) if len(pool.boxes) > 0 else len(cubics)
        if len(pool.boxes) > 0 and _is_run(cubics[first:last], pool.boxes[runs]):
            pool.runs[runs, 0], pool.runs[runs, 1], pool.runs[runs, 2] = first, last, owner[first]
            numbers[end] = -1 - runs
            end, runs, first = end + 1, runs + 1, last
            continue
        points, path = pool.points[pieces:], pool.path[pieces:]
        count = write_monotone(cubics[first:last], owner[first:last], Pieces(points, path, path[:0], points[:0, 0]))
        for _ in range(count):
            numbers[end] = pieces
            end, pieces = end + 1, pieces + 1
        first = last
    return end, pieces, runs


@kernel(allocates=False)
def _add_run(pool: PiecePool, number: int, pieces: int) -> int:
    """Append the cubics of a run, given by its negative number, to the pool; return the new number of pieces."""
    run = pool.runs[-1 - number]
    for i in range(run[0], run[1]):
        copy_curve(pool.cubics[i], pool.points[pieces])
        pool.path[pieces] = run[2]
        pieces += 1
    return pieces


@kernel(allocates=False)
def holds_runs(pool: PiecePool, first: int, last: int) -> bool:
    """Whether a list holds runs."""
    if len(pool.boxes) > 0:
        for place in range(first, last):
            if pool.numbers[place] < 0:
                return True
    return False


@kernel(allocates=False)
def _divide_piece(
    pool: PiecePool, i: int, xm: float, ym: float, grain: float, pieces: int, parts: int
) -> tuple[int, int]:
    """Cut a piece at the middle lines; append its parts and the child of each; return both new counts."""
    points, path, owner, part = pool.points, pool.path, pool.child, pool.part
    x, y = points[i, 0, 0], points[i, 0, 1]
    if (x - xm) * (points[i, 3, 0] - xm) > 0.0 and (y - ym) * (points[i, 3, 1] - ym) > 0.0:
        owner[parts], part[parts] = (1 if x > xm else 0) + (2 if y > ym else 0), i
        return pieces, parts + 1
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
    return pieces, parts


@kernel(allocates=False)
def divide(pool: PiecePool, cell: Cell, grain: float, pieces: int, at_limit: bool, child_at: NDArray[np.int64]) -> int:
    """Append the lists of a cell's four children behind its own list; return the new number of pieces.

    `grain` is the spacing of the lattice to which points on the middle lines are rounded. `pieces` is the number of
    pieces in the pool, which must have room. The children's lists hold no runs if the children are `at_limit`, the
    depth limit. The start of each child's list, and the end of the last, are written to `child_at` (9,), whose other
    four rows are scratch.
    """
    numbers, owner, part, boxes = pool.numbers, pool.child, pool.part, pool.boxes
    xm, ym = cell.x + 0.5 * cell.size, cell.y + 0.5 * cell.size
    parts = 0
    for place in range(cell.first, cell.last):
        i = numbers[place]
        if i >= 0:
            pieces, parts = _divide_piece(pool, i, xm, ym, grain, pieces, parts)
            continue
        box = boxes[-1 - i]
        if (box[0] - xm) * (box[2] - xm) > 0.0 and (box[1] - ym) * (box[3] - ym) > 0.0:
            owner[parts], part[parts] = (1 if box[0] > xm else 0) + (2 if box[1] > ym else 0), i
            parts += 1
            continue
        copied = pieces
        pieces = last_copied = _add_run(pool, i, pieces)
        for k in range(copied, last_copied):
            pieces, parts = _divide_piece(pool, k, xm, ym, grain, pieces, parts)
    return _write_lists(pool, cell.last, pieces, parts, at_limit, child_at)


@kernel(allocates=False)
def _write_lists(
    pool: PiecePool, start: int, pieces: int, parts: int, at_limit: bool, child_at: NDArray[np.int64]
) -> int:
    """Write the list of each child, in the order of the parts; return the new number of pieces.

    Only the lists of crowded children keep their runs.
    """
    numbers, owner, part = pool.numbers, pool.child, pool.part
    for column in range(9):
        child_at[column] = 0
    for k in range(parts):
        child_at[owner[k]] += 1
        child_at[5 + owner[k]] += 1 if part[k] >= 0 else pool.runs[-1 - part[k], 1] - pool.runs[-1 - part[k], 0]
    for child in range(4):
        if at_limit or child_at[5 + child] <= CROWDED:
            child_at[child] = child_at[5 + child]
        else:
            child_at[5 + child] = 0  # its runs stay
        start, child_at[child] = start + child_at[child], start
    first = child_at[0]
    for k in range(parts):
        i, child = part[k], owner[k]
        if i >= 0 or child_at[5 + child] == 0:
            numbers[child_at[child]] = i
            child_at[child] += 1
            continue
        copied = pieces
        pieces = _add_run(pool, i, pieces)
        for piece in range(copied, pieces):
            numbers[child_at[child]] = piece
            child_at[child] += 1
    for child in range(4, 0, -1):  # each start has become the next one's
        child_at[child] = child_at[child - 1]
    child_at[0] = first
    return pieces


@kernel(allocates=False)
def snap(curve: NDArray[np.float64], end: int, axis: int, grain: float) -> None:
    """Round one coordinate of an end to a lattice; the control point beside the end moves along."""
    snapped = np.rint(curve[end, axis] / grain) * grain
    curve[1 if end == 0 else 2, axis] += snapped - curve[end, axis]
    curve[end, axis] = snapped


@kernel(allocates=False)
def child_of(curve: NDArray[np.float64], xm: float, ym: float) -> int:
    """Number of the child, (x half) + 2 (y half), that holds a piece that crosses no middle line."""
    right = 1 if curve[0, 0] >= xm and curve[3, 0] >= xm else 0
    upper = 2 if curve[0, 1] >= ym and curve[3, 1] >= ym else 0
    return right + upper
