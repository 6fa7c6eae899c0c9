"""The cells of one depth, and how they are cut into the cells of the next.

A cell is cut at its middle lines, x first. The cut coordinate is set exactly in both halves, so that neighbouring
cells share the very same floating-point point and no seam can open between them. A piece goes to the upper (right)
child iff **both** its ends are at or beyond the line: a decision by their midpoint fails where it rounds up.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.monotone import Pieces, empty_pieces
from vexture.bezier.roots import solve_monotone
from vexture.bezier.split import split
from vexture.kernels import kernel
from vexture.quadtree.winding import child_windings, inside

__all__ = ["Level", "children"]


class Level(NamedTuple):
    """Cells of one depth that are neither leaves nor constant yet, as arrays.

    Each cell owns a range of `pieces` and a range of `present`: the paths that have pieces in it, with their
    corner windings (see `vexture.quadtree.winding`). Both are in the order of the paths, so that the pieces of a
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


@kernel
def _copy_piece(source: Pieces, i: int, target: Pieces, k: int) -> None:
    """Copy piece i to place k."""
    target.points[k] = source.points[i]
    target.path[k] = source.path[i]
    target.segment[k] = source.segment[i]
    target.span[k] = source.span[i]


@kernel
def _cut(source: Pieces, first: int, last: int, axis: int, line: float, target: Pieces, end: int) -> int:
    """Append pieces first..last-1 to target[end:], cut where they cross a line; return the new end."""
    for i in range(first, last):
        curve = source.points[i]
        a, d = curve[0, axis], curve[3, axis]
        _copy_piece(source, i, target, end)
        if (a < line < d) or (d < line < a):
            t = solve_monotone(a, curve[1, axis], curve[2, axis], d, line)
            _copy_piece(source, i, target, end + 1)
            before, after = target.points[end], target.points[end + 1]
            split(curve, t, before, after)
            other = 1 - axis
            low, high = min(curve[0, other], curve[3, other]), max(curve[0, other], curve[3, other])
            point = min(max(before[3, other], low), high)
            before[3, axis], after[0, axis] = line, line
            before[3, other], after[0, other] = point, point
            t0, t1 = source.span[i, 0], source.span[i, 1]
            middle = t0 + t * (t1 - t0)
            target.span[end, 1], target.span[end + 1, 0] = middle, middle
            end += 1
        end += 1
    return end


@kernel
def _child_of(curve: NDArray[np.float64], xm: float, ym: float) -> int:
    """Child that a piece which crosses no middle line belongs to: (x half) + 2 (y half)."""
    right = 1 if curve[0, 0] >= xm and curve[3, 0] >= xm else 0
    upper = 2 if curve[0, 1] >= ym and curve[3, 1] >= ym else 0
    return right + upper


@kernel
def _count_cuts(level: Level, split_cells: NDArray[np.bool_], half: float) -> int:
    """Upper bound of the number of pieces in all children; each line cuts a monotone piece once."""
    count = 0
    for c in range(len(split_cells)):
        if split_cells[c]:
            for i in range(level.piece_at[c], level.piece_at[c + 1]):
                count += 1
                for axis in range(2):
                    line = level.origin[c, axis] + half
                    a, d = level.pieces.points[i, 0, axis], level.pieces.points[i, 3, axis]
                    if (a < line < d) or (d < line < a):
                        count += 1
    return count


@kernel
def _sort_by_child(
    cut: Pieces, count: int, xm: float, ym: float, target: Pieces, end: int, child_at: NDArray[np.int64]
) -> int:
    """Append cut pieces child by child, in their order; write where each child starts; drop point-like pieces."""
    for child in range(4):
        child_at[child] = end
        for i in range(count):
            curve = cut.points[i]
            point_like = curve[0, 0] == curve[3, 0] and curve[0, 1] == curve[3, 1]
            if not point_like and _child_of(curve, xm, ym) == child:
                _copy_piece(cut, i, target, end)
                end += 1
    child_at[4] = end
    return end


@kernel
def children(
    level: Level,
    split_cells: NDArray[np.bool_],
    rules: NDArray[np.int64],
    size: float,
    first_quad: int,
    constant: NDArray[np.int64],
) -> Level:
    """Cut cells of a level into the cells of the next that have pieces; tell which of the others are full.

    Parameters
    ----------
    level : Level
        Of n cells, each `size` wide.
    split_cells : (n,) bool array
        The cells to cut; each becomes a quad, numbered from `first_quad`.
    rules : (paths,) int64 array
        `FillRule` of each path.
    size : float
        Width of this level's cells, in unit-square units.
    first_quad : int
        Number of the first new quad.
    constant : (4 * new quads,) int64 array
        Written: 1 for a child without pieces that is full, 0 for one that is empty, -1 for one in the next level.

    Returns
    -------
    Level
        Of the children that have pieces and are not covered by another path.
    """
    half = 0.5 * size
    room = _count_cuts(level, split_cells, half)
    quad_count = split_cells.sum()
    out = empty_pieces(room)
    most_paths = 0
    widest = 0
    for c in range(len(split_cells)):
        if split_cells[c]:
            most_paths += level.path_at[c + 1] - level.path_at[c]
            widest = max(widest, level.piece_at[c + 1] - level.piece_at[c])
    origin = np.empty((4 * quad_count, 2))
    slot = np.empty(4 * quad_count, np.int64)
    piece_at = np.empty(4 * quad_count + 1, np.int64)
    path_at = np.empty(4 * quad_count + 1, np.int64)
    present = np.empty((4 * most_paths, 2), np.int64)
    once, twice = empty_pieces(2 * widest), empty_pieces(3 * widest)
    child_at = np.empty(5, np.int64)
    cells, end, paths, quad = 0, 0, 0, first_quad
    for c in range(len(split_cells)):
        if not split_cells[c]:
            continue
        xm, ym = level.origin[c, 0] + half, level.origin[c, 1] + half
        once_end = _cut(level.pieces, level.piece_at[c], level.piece_at[c + 1], 0, xm, once, 0)
        twice_end = _cut(once, 0, once_end, 1, ym, twice, 0)
        _sort_by_child(twice, twice_end, xm, ym, out, end, child_at)
        windings = child_windings(
            out, child_at, level.present[level.path_at[c] : level.path_at[c + 1]], xm - half, ym - half, xm, ym
        )
        for child in range(4):
            here, is_full = paths, False
            for k in range(len(windings)):
                path, winding = level.present[level.path_at[c] + k, 0], windings[k, child]
                if windings[k, 4 + child]:
                    present[here, 0], present[here, 1] = path, winding
                    here += 1
                elif inside(winding, rules[path]):
                    is_full = True
            index = 4 * (quad - first_quad) + child
            if is_full or child_at[child] == child_at[child + 1]:
                constant[index] = 1 if is_full else 0
                continue
            constant[index] = -1
            origin[cells, 0], origin[cells, 1] = xm - half + half * (child & 1), ym - half + half * (child >> 1)
            slot[cells] = 4 * quad + child
            piece_at[cells], path_at[cells] = end, paths
            for i in range(child_at[child], child_at[child + 1]):
                _copy_piece(out, i, out, end)
                end += 1
            paths = here
            cells += 1
        quad += 1
    piece_at[cells], path_at[cells] = end, paths
    pieces = Pieces(out.points[:end], out.path[:end], out.segment[:end], out.span[:end])
    return Level(origin[:cells], slot[:cells], piece_at[: cells + 1], path_at[: cells + 1], pieces, present[:paths])
