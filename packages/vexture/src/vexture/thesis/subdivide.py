"""Divide the cells of one depth into those of the next, by the rules of `vexture.tree.divide`."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.tolerance import GRAIN
from vexture.bezier.monotone import Pieces, empty_pieces
from vexture.bezier.roots import solve_monotone
from vexture.bezier.split import copy_curve, split
from vexture.tree.divide import child_of, snap
from vexture.tree.winding import child_windings, inside


class ThesisLevel(NamedTuple):
    """Cells of one depth that are not yet leaves or constant.

    Each cell owns a range of `pieces` and a range of `present`: the paths with pieces in the cell, and their corner
    windings (see `vexture.tree.winding`). Both ranges are in the order of the paths, so that the pieces of a path are
    consecutive.
    """

    origin: NDArray[np.float64]  # (n, 2): bottom-left corners
    slot: NDArray[np.int64]  # (n,): 4 * (parent quad) + (cell of that quad)
    piece_at: NDArray[np.int64]  # (n + 1,): start of each cell's range; the last entry is the total
    path_at: NDArray[np.int64]  # (n + 1,): the same for `present`
    pieces: Pieces  # in unit-square units
    present: NDArray[np.int64]  # (m, 2): path and corner winding


class LevelCell(NamedTuple):
    """One cell of a level: its bottom-left corner and width in unit-square units, its pieces and paths."""

    x0: float
    y0: float
    size: float
    pieces: Pieces
    present: NDArray[np.int64]


@kernel
def cell_of(level: ThesisLevel, c: int, size: float) -> LevelCell:
    """Cell c of a level whose cells have width `size`."""
    first, last = level.piece_at[c], level.piece_at[c + 1]
    points, path, segment, span = level.pieces
    pieces = Pieces(points[first:last], path[first:last], segment[first:last], span[first:last])
    present = level.present[level.path_at[c] : level.path_at[c + 1]]
    return LevelCell(level.origin[c, 0], level.origin[c, 1], size, pieces, present)


@kernel(allocates=False)
def _copy_piece(source: Pieces, i: int, target: Pieces, k: int) -> None:
    """Copy piece i of `source` to index k of `target`."""
    copy_curve(source.points[i], target.points[k])
    target.path[k] = source.path[i]
    target.segment[k] = source.segment[i]
    target.span[k, 0], target.span[k, 1] = source.span[i, 0], source.span[i, 1]


@kernel(allocates=False)
def _cut(source: Pieces, count: int, axis: int, line: float, target: Pieces) -> int:
    """Copy pieces to `target`, cut where they cross a line; return the new number of pieces."""
    other, end = 1 - axis, 0
    for i in range(count):
        curve = source.points[i]
        a, d = curve[0, axis], curve[3, axis]
        _copy_piece(source, i, target, end)
        if a == line:
            snap(target.points[end], 0, other, GRAIN)
        if d == line:
            snap(target.points[end], 3, other, GRAIN)
        if (a < line < d) or (d < line < a):
            t = solve_monotone(a, curve[1, axis], curve[2, axis], d, line)
            _copy_piece(source, i, target, end + 1)
            before, after = target.points[end], target.points[end + 1]
            split(curve, t, before, after)
            before[3, axis], after[0, axis] = line, line
            snap(before, 3, other, GRAIN)
            snap(after, 0, other, GRAIN)
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
    """Append cut pieces child by child, except point-like ones; write the start of each child; return the new end."""
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
    cell: LevelCell,
    child: int,
    windings: NDArray[np.int64],
    rules: NDArray[np.int64],
    present: NDArray[np.int64],
    end: int,
) -> int:
    """Append the paths with pieces in a child; return the new end, or -1 if another path fills the child."""
    for k in range(len(windings)):
        path = cell.present[k, 0]
        if windings[k, 4 + child]:
            present[end, 0], present[end, 1] = path, windings[k, child]
            end += 1
        elif inside(windings[k, child], rules[path]):
            return -1
    return end


@kernel(allocates=False)
def _room_for(level: ThesisLevel, split_cells: NDArray[np.bool_]) -> tuple[int, int, int, int]:
    """Upper bounds of array sizes: children, pieces of all children, pieces of one cell, paths of all children."""
    cells, pieces, widest, paths = 0, 0, 0, 0
    for c in range(len(split_cells)):
        if split_cells[c]:
            here = level.piece_at[c + 1] - level.piece_at[c]
            pieces += 3 * here  # each middle line cuts a monotone piece at most once
            widest = max(widest, here)
            cells += 4
            paths += 4 * (level.path_at[c + 1] - level.path_at[c])
    return cells, pieces, widest, paths


@kernel
def children(
    level: ThesisLevel, split_cells: NDArray[np.bool_], rules: NDArray[np.int64], size: float, first_quad: int
) -> tuple[ThesisLevel, NDArray[np.int64]]:
    """Divide cells of a level, each `size` wide; return the next level and the slots of full children.

    Each cell in the mask `split_cells` becomes a quad, numbered from `first_quad`. The next level holds the children
    with pieces that no other path covers. Children in neither result are empty.
    """
    half = 0.5 * size
    room, piece_room, widest, path_room = _room_for(level, split_cells)
    out, once, twice = empty_pieces(piece_room), empty_pieces(2 * widest), empty_pieces(3 * widest)
    origin, slot = np.empty((room, 2)), np.empty(room, np.int64)
    piece_at, path_at = np.empty(room + 1, np.int64), np.empty(room + 1, np.int64)
    present, full = np.empty((path_room, 2), np.int64), np.empty(room, np.int64)
    child_at, places = np.empty(5, np.int64), np.arange(piece_room)
    cells, end, paths, full_count, quad = 0, 0, 0, 0, first_quad
    for c in range(len(split_cells)):
        if not split_cells[c]:
            continue
        cell = cell_of(level, c, size)
        x0, y0 = cell.x0, cell.y0
        xm, ym = x0 + half, y0 + half
        once_end = _cut(cell.pieces, len(cell.pieces.path), 0, xm, once)
        twice_end = _cut(once, once_end, 1, ym, twice)
        _sort_by_child(twice, twice_end, xm, ym, out, end, child_at)
        windings = np.empty((len(cell.present), 8), np.int64)
        lists = (out.points, out.path, places, windings)  # no runs
        child_windings(lists, child_at, cell.present, x0, y0, half, 0, windings)
        for child in range(4):
            here = _copy_present(cell, child, windings, rules, present, paths)
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
    below = ThesisLevel(
        origin[:cells], slot[:cells], piece_at[: cells + 1], path_at[: cells + 1], pieces, present[:paths]
    )
    return below, full[:full_count]
