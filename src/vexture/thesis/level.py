"""The cells of one depth, and how they are cut into the cells of the next, by the rules of `vexture.tree.divide`."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.monotone import Pieces, empty_pieces
from vexture.bezier.roots import solve_monotone
from vexture.bezier.split import copy_curve, split
from vexture.kernels import kernel
from vexture.tree.divide import child_of, snap
from vexture.tree.winding import child_windings, inside

__all__ = ["Level", "children"]


class Level(NamedTuple):
    """Cells of one depth that are neither leaves nor constant yet, as arrays.

    Each cell owns a range of `pieces` and a range of `present`: the paths that have pieces in it, with their
    corner windings (see `vexture.tree.winding`). Both are in the order of the paths, so that the pieces of a
    path are consecutive.

    Attributes
    ----------
    origin : (n, 2) float64 array
        Bottom-left corner.
    slot : (n,) int64 array
        4 * (parent quad) + (cell of that quad).
    piece_at, path_at : (n + 1,) int64 arrays
        Where each cell's range starts; the last entry is the total.
    pieces : Pieces
        In unit-square units.
    present : (m, 2) int64 array
        Path and corner winding.
    """

    origin: NDArray[np.float64]
    slot: NDArray[np.int64]
    piece_at: NDArray[np.int64]
    path_at: NDArray[np.int64]
    pieces: Pieces
    present: NDArray[np.int64]


@kernel(allocates=False)
def _copy_piece(source: Pieces, i: int, target: Pieces, k: int) -> None:
    """Copy piece i to place k."""
    copy_curve(source.points[i], target.points[k])
    target.path[k] = source.path[i]
    target.segment[k] = source.segment[i]
    target.span[k, 0], target.span[k, 1] = source.span[i, 0], source.span[i, 1]


@kernel(allocates=False)
def _cut(source: Pieces, first: int, last: int, axis: int, line: float, grain: float, target: Pieces, end: int) -> int:
    """Append pieces first..last-1 to target[end:], cut where they cross a line; return the new end."""
    other = 1 - axis
    for i in range(first, last):
        curve = source.points[i]
        a, d = curve[0, axis], curve[3, axis]
        _copy_piece(source, i, target, end)
        if a == line:
            snap(target.points[end], 0, other, grain)
        if d == line:
            snap(target.points[end], 3, other, grain)
        if (a < line < d) or (d < line < a):
            t = solve_monotone(a, curve[1, axis], curve[2, axis], d, line)
            _copy_piece(source, i, target, end + 1)
            before, after = target.points[end], target.points[end + 1]
            split(curve, t, before, after)
            before[3, axis], after[0, axis] = line, line
            snap(before, 3, other, grain)
            snap(after, 0, other, grain)
            t0, t1 = source.span[i, 0], source.span[i, 1]
            middle = t0 + t * (t1 - t0)
            target.span[end, 1], target.span[end + 1, 0] = middle, middle
            end += 1
        end += 1
    return end


@kernel(allocates=False)
def _sort_by_child(
    cut: Pieces, count: int, xm: float, ym: float, target: Pieces, end: int, child_at: NDArray[np.int64]
) -> int:
    """Append cut pieces child by child, in their order; write where each child starts; drop point-like pieces."""
    for child in range(4):
        child_at[child] = end
        for i in range(count):
            curve = cut.points[i]
            point_like = curve[0, 0] == curve[3, 0] and curve[0, 1] == curve[3, 1]
            if not point_like and child_of(curve, xm, ym) == child:
                _copy_piece(cut, i, target, end)
                end += 1
    child_at[4] = end
    return end


@kernel(allocates=False)
def _copy_present(
    level: Level,
    c: int,
    child: int,
    windings: NDArray[np.int64],
    rules: NDArray[np.int64],
    present: NDArray[np.int64],
    end: int,
) -> int:
    """Append the paths that have pieces in a child; return the new end, or -1 if another path fills the child."""
    for k in range(len(windings)):
        path = level.present[level.path_at[c] + k, 0]
        if windings[k, 4 + child]:
            present[end, 0], present[end, 1] = path, windings[k, child]
            end += 1
        elif inside(windings[k, child], rules[path]):
            return -1
    return end


@kernel(allocates=False)
def _room_for(level: Level, split_cells: NDArray[np.bool_], size: float) -> tuple[int, int, int]:
    """Upper bounds: pieces of all children, pieces of one cell, paths of all children."""
    pieces, widest, paths = 0, 0, 0
    for c in range(len(split_cells)):
        if split_cells[c]:
            paths += 4 * (level.path_at[c + 1] - level.path_at[c])
            widest = max(widest, level.piece_at[c + 1] - level.piece_at[c])
            for i in range(level.piece_at[c], level.piece_at[c + 1]):
                pieces += 1
                for axis in range(2):  # each line cuts a monotone piece at most once
                    line = level.origin[c, axis] + 0.5 * size
                    a, d = level.pieces.points[i, 0, axis], level.pieces.points[i, 3, axis]
                    if (a < line < d) or (d < line < a):
                        pieces += 1
    return pieces, widest, paths


@kernel
def children(
    level: Level,
    split_cells: NDArray[np.bool_],
    split_count: int,
    rules: NDArray[np.int64],
    size: float,
    grain: float,
    first_quad: int,
) -> tuple[Level, NDArray[np.int64]]:
    """Cut cells of a level into the cells of the next.

    Parameters
    ----------
    level : Level
        Of n cells, each `size` wide.
    split_cells : (n,) bool array
        The cells to cut, `split_count` of them; each becomes a quad, numbered from `first_quad`.
    rules : (paths,) int64 array
        `FillRule` of each path.
    size : float
        Width of this level's cells, in unit-square units.
    grain : float
        Spacing of the lattice that points on the middle lines are rounded to, a power of two.

    Returns
    -------
    Level
        Of the children that have pieces and are not covered by another path.
    (m,) int64 array
        Slots of the children that are full; all others are empty.
    """
    half = 0.5 * size
    piece_room, widest, path_room = _room_for(level, split_cells, size)
    out, once, twice = empty_pieces(piece_room), empty_pieces(2 * widest), empty_pieces(3 * widest)
    origin, slot = np.empty((4 * split_count, 2)), np.empty(4 * split_count, np.int64)
    piece_at, path_at = np.empty(4 * split_count + 1, np.int64), np.empty(4 * split_count + 1, np.int64)
    present, full = np.empty((path_room, 2), np.int64), np.empty(4 * split_count, np.int64)
    child_at, places = np.empty(5, np.int64), np.arange(piece_room)
    cells, end, paths, full_count, quad = 0, 0, 0, 0, first_quad
    for c in range(len(split_cells)):
        if not split_cells[c]:
            continue
        x0, y0 = level.origin[c, 0], level.origin[c, 1]
        xm, ym = x0 + half, y0 + half
        once_end = _cut(level.pieces, level.piece_at[c], level.piece_at[c + 1], 0, xm, grain, once, 0)
        twice_end = _cut(once, 0, once_end, 1, ym, grain, twice, 0)
        _sort_by_child(twice, twice_end, xm, ym, out, end, child_at)
        parent_present = level.present[level.path_at[c] : level.path_at[c + 1]]
        windings = np.empty((len(parent_present), 8), np.int64)
        child_windings(out.points, out.path, places, child_at, parent_present, x0, y0, xm, ym, windings)
        for child in range(4):
            here = _copy_present(level, c, child, windings, rules, present, paths)
            if here < 0:
                full[full_count] = 4 * quad + child
                full_count += 1
            elif child_at[child] < child_at[child + 1]:
                origin[cells, 0], origin[cells, 1] = x0 + half * (child & 1), y0 + half * (child >> 1)
                slot[cells], piece_at[cells], path_at[cells] = 4 * quad + child, end, paths
                for i in range(child_at[child], child_at[child + 1]):
                    _copy_piece(out, i, out, end)
                    end += 1
                paths = here
                cells += 1
        quad += 1
    piece_at[cells], path_at[cells] = end, paths
    pieces = Pieces(out.points[:end], out.path[:end], out.segment[:end], out.span[:end])
    below = Level(origin[:cells], slot[:cells], piece_at[: cells + 1], path_at[: cells + 1], pieces, present[:paths])
    return below, full[:full_count]
