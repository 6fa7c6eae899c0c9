"""The borders in one cell: its pieces on the cell's lattice, with coincident pieces counted once.

In a map, every border between two areas is in the outlines of both, and copies of an outline coincide. Such pieces are
one *border* here, along which several paths run in one direction or the other.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import LATTICE
from vexture.bezier.split import copy_curve
from vexture.tree.boundary import quantise_piece
from vexture.tree.divide import Cell, PiecePool
from vexture.tree.merge import follows, merge_chains
from vexture.tree.planar.layers import PlanarLayers
from vexture.tree.winding import inside

SAME = 2.0
"""Lattice units by which control points of coincident pieces may differ: each is rounded where a cell cuts it."""


class Borders(NamedTuple):
    """The different pieces of a cell and the paths along them, with room for any cell that may become a leaf."""

    curves: NDArray[np.float64]  # (room, 4, 2), in lattice units
    rows: NDArray[np.int64]  # (room,): number of each border's list of paths
    begin: NDArray[np.int64]  # (room + 1,): start of each list in `path` and `times`
    path: NDArray[np.int64]  # (pieces,): places in the cell's list of paths
    times: NDArray[np.int64]  # (pieces,): how often each path runs along the border; negative in the other direction
    sums: NDArray[np.float64]  # (room,), scratch: the sum of each border's ends, the same in both directions
    work: NDArray[np.int64]  # (room,), scratch


@kernel
def new_borders(room: int, pieces: int) -> Borders:
    """Arrays for `room` borders, in cells of `pieces` pieces."""
    return Borders(
        np.empty((room, 4, 2)),
        np.empty(room, np.int64),
        np.empty(room + 1, np.int64),
        np.empty(pieces, np.int64),
        np.empty(pieces, np.int64),
        np.empty(room),
        np.empty(room, np.int64),
    )


@kernel(allocates=False)
def _same_border(a: NDArray[np.float64], b: NDArray[np.float64]) -> int:
    """Direction in which two pieces coincide: 1 for the same, -1 for the opposite, 0 if they do not."""
    for turn in (1, -1):
        same = True
        for k in (0, 3, 1, 2):
            other = k if turn == 1 else 3 - k
            most = 0.0 if k in (0, 3) else SAME
            for axis in range(2):
                same = same and abs(a[k, axis] - b[other, axis]) <= most
            if not same:
                break
        if same:
            return turn
    return 0


@kernel(allocates=False)
def find_borders(pool: PiecePool, cell: Cell, present: NDArray[np.int64], most: int, borders: Borders) -> int:
    """Write the borders in a cell; return how many, or -1 if there are more than `most`."""
    kind, turn = pool.child, pool.part  # scratch with room for the pieces of any cell
    count, curves, sums = 0, borders.curves, borders.sums
    for i in range(cell.last - cell.first):
        piece = curves[count]
        quantise_piece(pool.points[pool.numbers[cell.first + i]], cell.x, cell.y, cell.size, piece)
        for k in (1, 2):
            for axis in range(2):
                piece[k, axis] = np.rint(piece[k, axis])
        kind[i], turn[i] = -1, 0
        if piece[0, 0] == piece[3, 0] and piece[0, 1] == piece[3, 1]:
            continue
        kind[i], turn[i] = count, 1
        ends = piece[0, 0] + piece[3, 0] + 4.0 * LATTICE * (piece[0, 1] + piece[3, 1])
        for k in range(count):
            if sums[k] == ends:  # rules out most pairs
                turned = _same_border(curves[k], piece)
                if turned != 0:
                    kind[i], turn[i] = k, turned
                    break
        if kind[i] == count:
            sums[count] = ends
            count += 1
            if count > most:
                return -1
    return _crossing_paths(pool, cell, present, count, borders)


@kernel(allocates=False)
def _crossing_paths(pool: PiecePool, cell: Cell, present: NDArray[np.int64], count: int, borders: Borders) -> int:
    """Write the paths along each border; drop borders without any; return how many are left."""
    kind, turn, begin = pool.child, pool.part, borders.begin
    for k in range(count + 1):
        begin[k] = 0
    for i in range(cell.last - cell.first):
        if kind[i] >= 0:
            begin[kind[i] + 1] += 1
    for k in range(count):
        begin[k + 1] += begin[k]
    filled, owner = borders.work, 0
    for k in range(count):
        filled[k] = 0
    for i in range(cell.last - cell.first):
        path = pool.path[pool.numbers[cell.first + i]]
        while present[owner, 0] != path:
            owner += 1
        k = kind[i]
        if k < 0:
            continue
        at = begin[k] + filled[k]
        if filled[k] > 0 and borders.path[at - 1] == owner:
            borders.times[at - 1] += turn[i]
        else:
            borders.path[at], borders.times[at] = owner, turn[i]
            filled[k] += 1
    return _pack(borders, count)


@kernel(allocates=False)
def _pack(borders: Borders, count: int) -> int:
    """Close gaps between the borders' rows; drop rows of 0 times and borders without rows; return how many are left.

    `borders.work` holds the number of rows of each border that are filled.
    """
    begin, filled, kept, at = borders.begin, borders.work, 0, 0
    for k in range(count):
        start, first = begin[k], at
        for row in range(start, start + filled[k]):
            if borders.times[row] != 0:
                borders.path[at], borders.times[at] = borders.path[row], borders.times[row]
                at += 1
        if at > first:
            if kept < k:
                copy_curve(borders.curves[k], borders.curves[kept])
            begin[kept], borders.rows[kept] = first, kept
            kept += 1
    begin[kept] = at
    return kept


@kernel(allocates=False)
def _crossed_alike(borders: Borders, i: int, j: int) -> bool:
    """Whether the same paths run along two borders, equally often and in the same directions."""
    first, other = borders.begin[i], borders.begin[j]
    if borders.begin[i + 1] - first != borders.begin[j + 1] - other:
        return False
    for k in range(borders.begin[i + 1] - first):
        if borders.path[first + k] != borders.path[other + k] or borders.times[first + k] != borders.times[other + k]:
            return False
    return True


@kernel(allocates=False)
def merge_borders(
    borders: Borders, count: int, tolerance: float, most: int, room: NDArray[np.float64]
) -> tuple[int, float]:
    """Merge chains of borders with the same paths; return how many are left, and the farthest that they moved.

    Merging may stop when more than `most` are left, without the rest of them. `tolerance` and the distance are in
    lattice units; `room` is scratch for curves.
    """
    chains = False
    for k in range(count):
        borders.rows[k] = borders.rows[k - 1] if k > 0 and _crossed_alike(borders, k - 1, k) else k
        chains = chains or (k > 0 and borders.rows[k] == borders.rows[k - 1] and follows(borders.curves, k, k - 1))
    if not chains:
        return count, 0.0
    rows = borders.work
    merged, distance = merge_chains(borders.curves[:count], borders.rows[:count], tolerance, most, room, rows)
    for k in range(merged):
        copy_curve(room[k], borders.curves[k])
        borders.rows[k] = rows[k]
    return merged, distance


@kernel(allocates=False)
def key_of(layers: PlanarLayers, present: NDArray[np.int64], windings: NDArray[np.int64]) -> int:
    """Exclusive or of the keys of the paths that are inside."""
    key, rules, keys = 0, layers.rules, layers.keys
    for k in range(len(present)):
        if inside(windings[k], rules[present[k, 0]]):
            key ^= keys[present[k, 0]]
    return key


@kernel(allocates=False)
def cross(
    borders: Borders,
    border: int,
    by: int,
    layers: PlanarLayers,
    present: NDArray[np.int64],
    windings: NDArray[np.int64],
    key: int,
) -> int:
    """Add the paths of a border to the windings, `by` times; return the new key."""
    of, rules = borders.rows[border], layers.rules
    for row in range(borders.begin[of], borders.begin[of + 1]):
        k = borders.path[row]
        path = present[k, 0]
        before = inside(windings[k], rules[path])
        windings[k] += by * borders.times[row]
        if before != inside(windings[k], rules[path]):
            key ^= layers.keys[path]
    return key


@kernel(allocates=False)
def set_left_edge(
    borders: Borders,
    count: int,
    layers: PlanarLayers,
    present: NDArray[np.int64],
    y: float,
    windings: NDArray[np.int64],
) -> int:
    """Write the windings at the left edge just above a height, right of borders along the edge; return their key."""
    for k in range(len(present)):
        windings[k] = present[k, 1]
    key = key_of(layers, present, windings)
    for i in range(count):
        curve = borders.curves[i]
        for end, event in ((0, 1), (3, -1)):
            if curve[end, 0] == 0.0 and curve[end, 1] <= y:
                key = cross(borders, i, event, layers, present, windings, key)
        a, d = curve[0, 1], curve[3, 1]
        if curve[0, 0] == 0.0 and curve[3, 0] == 0.0 and min(a, d) <= y < max(a, d):
            key = cross(borders, i, -1 if d > a else 1, layers, present, windings, key)
    return key
