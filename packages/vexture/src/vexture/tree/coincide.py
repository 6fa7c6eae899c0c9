"""Matching the coincident pieces of a crowded cell, which become one piece with a multiplicity.

Dividing a cell does not separate coincident pieces: a hundred copies of an outline would be divided down to the depth
limit along their whole length. So the pieces of a crowded cell are compared with one piece of each *kind* met so far.
Of several paths that then fill the same area, one is kept.

Ends are matched first, and pieces between the same two ends afterwards, so pieces that meet still meet. Starts and ends
on the cell's left edge change windings. At each point inside the cell there are as many starts as ends, so such points
may match those on an edge, and move onto it. An end on the left edge never matches one on another edge.

Matching stops as soon as a cell holds more kinds than a leaf could, so it costs other cells little.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.split import copy_curve
from vexture.tree.boundary import quantise_piece
from vexture.tree.divide import Cell, PiecePool
from vexture.tree.separate import CellPieces

NEARNESS = 1.0 / 128.0
"""Cell sides. Ends farther apart do not match, however large a shift is allowed."""

MOST_KINDS = 20
"""Pieces of different kinds in a cell. With more, the cell would be divided in any case."""

INSIDE, LEFT, OTHER = range(3)
"""Where an end lies: inside the cell, on its left edge, or on another."""


class Kinds(NamedTuple):
    """The different ends and pieces of a cell."""

    ends: NDArray[np.float64]  # (2 room, 2)
    edge: NDArray[np.int64]  # (2 room,): `INSIDE`, `LEFT` or `OTHER`
    pieces: NDArray[np.float64]  # (room, 4, 2): the first of each kind
    curves: NDArray[np.float64]  # (room, 4, 2): these pieces between their common ends, on the cell's lattice
    between: NDArray[np.int64]  # (room, 2): the ends of each piece
    multiplicity: NDArray[np.int64]  # (room,): copies of each piece in one path; a reversed copy counts -1
    written: NDArray[np.int64]  # (room,): 1 if any path has more of the piece in one direction than in the other


@kernel
def _no_kinds() -> Kinds:
    """Arrays for the kinds of a cell."""
    return Kinds(
        np.empty((2 * MOST_KINDS, 2)),
        np.empty(2 * MOST_KINDS, np.int64),
        np.empty((MOST_KINDS, 4, 2)),
        np.empty((MOST_KINDS, 4, 2)),
        np.empty((MOST_KINDS, 2), np.int64),
        np.empty(MOST_KINDS, np.int64),
        np.zeros(MOST_KINDS, np.int64),
    )


@kernel(allocates=False)
def _end_of(kinds: Kinds, count: int, point: NDArray[np.float64], cell: Cell, near: float) -> int:
    """Number of the end that a point matches; a point that matches none is added as end `count`, or -1 without room."""
    x, y = point[0], point[1]
    beside, level = x == cell.x or x == cell.x + cell.size, y == cell.y or y == cell.y + cell.size
    edge = LEFT if x == cell.x else OTHER if beside or level else INSIDE
    for k in range(count):
        known = kinds.edge[k]
        apart = max(abs(kinds.ends[k, 0] - x), abs(kinds.ends[k, 1] - y))
        if apart <= near and (edge == INSIDE or known in (edge, INSIDE)):
            kinds.edge[k] = max(known, edge)
            kinds.ends[k, 0] = x if beside else kinds.ends[k, 0]
            kinds.ends[k, 1] = y if level else kinds.ends[k, 1]
            return k
    if count < len(kinds.ends):
        kinds.ends[count, 0], kinds.ends[count, 1], kinds.edge[count] = x, y, edge
        return count
    return -1


@kernel(allocates=False)
def _piece_of(
    kinds: Kinds, count: int, piece: NDArray[np.float64], start: int, stop: int, near: float
) -> tuple[int, int]:
    """Kind that a piece matches, and 1, or -1 if the piece is reversed; `count` and 1 if it matches none."""
    for k in range(count):
        for turn in (1, -1):
            a, d = (start, stop) if turn == 1 else (stop, start)
            if kinds.between[k, 0] != a or kinds.between[k, 1] != d:
                continue
            apart = 0.0
            for control in (1, 2):
                for axis in range(2):
                    other = kinds.pieces[k, control if turn == 1 else 3 - control, axis]
                    apart = max(apart, abs(piece[control, axis] - other))
            if apart <= near:
                return k, turn
    return count, 1


@kernel(allocates=False)
def _quantise_kind(kinds: Kinds, k: int, cell: Cell) -> None:
    """Move a piece of one kind to its common ends, and round it to the cell's lattice."""
    piece = kinds.pieces[k]
    for column, end, control in ((0, 0, 1), (1, 3, 2)):
        for axis in range(2):
            shift = kinds.ends[kinds.between[k, column], axis] - piece[end, axis]
            piece[end, axis] = kinds.ends[kinds.between[k, column], axis]
            piece[control, axis] += shift
    quantise_piece(piece, cell.x, cell.y, cell.size, kinds.curves[k])


@kernel(allocates=False)
def may_coincide(pool: PiecePool, cell: Cell) -> bool:
    """Whether about a quarter or more of a cell's pieces share their middles with others: a quick test before `match`.

    Middles are hashed into 64 drawers by a grid over the cell.
    """
    scale = 0.5 / (NEARNESS * cell.size)
    drawers, used = 0, 0
    for place in range(cell.first, cell.last):
        piece = pool.points[pool.numbers[place]]
        column = int((piece[0, 0] + piece[3, 0] - 2.0 * cell.x) * scale)
        row = int((piece[0, 1] + piece[3, 1] - 2.0 * cell.y) * scale)
        drawer = 1 << ((column * 37 + row * 11) & 63)
        if drawers & drawer == 0:
            drawers |= drawer
            used += 1
            if used > MOST_KINDS:
                return False
    return 4 * used <= 3 * (cell.last - cell.first)


@kernel
def match(
    pool: PiecePool,
    cell: Cell,
    near: float,
    present: NDArray[np.int64],
    rules: NDArray[np.int64],
    out: CellPieces,
    kind_at: NDArray[np.int64],
) -> tuple[int, int]:
    """Write the pieces of a cell to `out`, each kind once for each path that has it.

    `near` is the largest distance of ends that match, in unit-square units. `out.windings` is not written, and
    `kind_at` is scratch. Returns how many pieces were written, or -1 if no two of them coincide or there is no room,
    and how many of their kinds are not horizontal.
    """
    first, last = cell.first, cell.last
    near, kinds = min(near, NEARNESS * cell.size), _no_kinds()
    kind, turn = pool.child, pool.part  # scratch there as well, with room for the pieces of any cell
    ends, count = 0, 0
    for place in range(first, last):
        piece = pool.points[pool.numbers[place]]
        start, stop = -1, -1
        for end in (0, 3):
            k = _end_of(kinds, ends, piece[end], cell, near)
            if k < 0:
                return -1, 0
            ends = max(ends, k + 1)
            start, stop = (k, stop) if end == 0 else (start, k)
        kind[place - first] = -1
        if start == stop:
            continue
        k, turn[place - first] = _piece_of(kinds, count, piece, start, stop, 2.0 * near)
        if k == MOST_KINDS:
            return -1, 0
        if k == count:
            copy_curve(piece, kinds.pieces[k])
            kinds.between[k, 0], kinds.between[k, 1], kinds.multiplicity[k] = start, stop, 0
            count += 1
        kind[place - first] = k
    if count == last - first:
        return -1, 0
    for k in range(count):
        _quantise_kind(kinds, k, cell)
    written = _count_by_path(pool, cell, kinds, count, present, rules, out, kind_at)
    upright = 0
    for k in range(count):
        upright += 1 if kinds.written[k] == 1 and kinds.curves[k, 0, 1] != kinds.curves[k, 3, 1] else 0
    return written, upright


@kernel(allocates=False)
def _count_by_path(
    pool: PiecePool,
    cell: Cell,
    kinds: Kinds,
    count: int,
    present: NDArray[np.int64],
    rules: NDArray[np.int64],
    out: CellPieces,
    kind_at: NDArray[np.int64],
) -> int:
    """Write the kinds of each path whose multiplicity is not 0; return how many, or -1 without room.

    A path that fills the same as another one is left out, as if it were outside everywhere.
    """
    first, last = cell.first, cell.last
    for k in range(len(present)):
        out.corner[k], out.rules[k] = present[k, 1], rules[present[k, 0]]
    written, owner = 0, 0
    for place in range(first, last):
        path = pool.path[pool.numbers[place]]
        if pool.child[place - first] >= 0:
            kinds.multiplicity[pool.child[place - first]] += pool.part[place - first]
        if place + 1 < last and pool.path[pool.numbers[place + 1]] == path:
            continue
        while present[owner, 0] != path:
            owner += 1
        begin = written
        for k in range(count):
            if kinds.multiplicity[k] == 0:
                continue
            if written == len(out.multiplicity):
                return -1
            copy_curve(kinds.curves[k], out.curves[written])
            out.multiplicity[written], out.owner[written], kind_at[written] = kinds.multiplicity[k], owner, k
            kinds.multiplicity[k], kinds.written[k] = 0, 1
            written += 1
        if _is_repeated(out, kind_at, begin, written):
            out.corner[owner], written = 0, begin
    return written


@kernel(allocates=False)
def _is_repeated(cell: CellPieces, kind_at: NDArray[np.int64], begin: int, end: int) -> bool:
    """Whether the last path, of the pieces begin..end-1, has the pieces, corner winding and rule of an earlier path."""
    start = 0
    while start < begin:
        one, other = cell.owner[start], cell.owner[begin]
        alike = begin < end and cell.corner[one] == cell.corner[other] and cell.rules[one] == cell.rules[other]
        stop = start
        while stop < begin and cell.owner[stop] == one:
            k = begin + stop - start
            alike = (
                alike and k < end and kind_at[stop] == kind_at[k] and cell.multiplicity[stop] == cell.multiplicity[k]
            )
            stop += 1
        if alike and stop - start == end - begin:
            return True
        start = stop
    return False
