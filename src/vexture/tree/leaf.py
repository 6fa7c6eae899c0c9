"""The packed leaf: a few monotone pieces on the leaf's lattice, between which the winding number is 0 or 1.

In the cells of most drawings no two pieces touch but at their ends; then each piece's sides are found by counting, and
it is kept, turned or dropped. All other cells go through `vexture.tree.boundary`. In both cases horizontal pieces
vanish, for they change no winding, but for those that end on the left edge where the rule of windings needs an end.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.roots import solve_monotone
from vexture.bezier.split import copy_curve, subcubic
from vexture.kernels import kernel
from vexture.layout import LATTICE, MOST_CURVES
from vexture.tree.boundary import HOPELESS, Boundary, cell_paths, crowded_area, quantise_piece, resolve
from vexture.tree.left_edge import corner_winding
from vexture.tree.merge import MOST_MERGED, merge_chains
from vexture.tree.pool import Pool
from vexture.tree.separate import UNSURE, CellPieces, all_separate, clean_pieces
from vexture.tree.winding import winding_area

__all__ = ["DIVIDE", "Leaf", "leaf_of", "new_workspace"]

DIVIDE = -1
"""Count of pieces of a cell that is to be divided."""

SPARE = 4
"""Pieces above the capacity with which a cell is still looked at: horizontal ones and overlaps will vanish."""

MOST_RUNS = 1000
"""Parts of resolved pieces that are kept to measure a cell's area."""


class Leaf(NamedTuple):
    """What a cell can be said to hold.

    Attributes
    ----------
    size : int
        Number of pieces, or `DIVIDE`.
    winding : int
        Corner winding, 0 if there are no pieces.
    coverage : float
        Filled part of the cell.
    distance : float
        Largest distance by which merging moved the outline, in unit-square units.
    resolved : bool
        False if this is the best that a cell at the depth limit can say, rather than all.
    """

    size: int
    winding: int
    coverage: float
    distance: float
    resolved: bool


class Workspace(NamedTuple):
    """Arrays that are used for one cell after another: to make them costs more than most cells."""

    cell: CellPieces
    path: NDArray[np.int64]
    merged_path: NDArray[np.int64]
    out: NDArray[np.float64]


@kernel(allocates=False)
def _round_controls(curves: NDArray[np.float64], count: int) -> None:
    """Round inner control points to the lattice, within the range that the format can hold."""
    for i in range(count):
        for k in (1, 2):
            for axis in range(2):
                curves[i, k, axis] = min(max(np.rint(curves[i, k, axis]), -0.5 * LATTICE), 1.5 * LATTICE - 1.0)


@kernel(allocates=False)
def _keep_run(curve: NDArray[np.float64], role: int, low: float, high: float, out: NDArray[np.float64]) -> None:
    """Write the part of a piece between two heights, the filled side on its left."""
    start, stop = (high, low) if role == 1 else (low, high)
    u0 = solve_monotone(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], start)
    u1 = solve_monotone(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], stop)
    subcubic(curve, u0, u1, out)
    for end, control, u, y in ((0, 1, u0, start), (3, 2, u1, stop)):
        inner = u != 0.0 and u != 1.0
        x = max(np.rint(out[end, 0]), 1.0) if inner else np.rint(out[end, 0])
        out[control, 0] += x - out[end, 0]
        out[control, 1] += y - out[end, 1]
        out[end, 0], out[end, 1] = x, y


@kernel(allocates=False)
def _resolved_pieces(curves: NDArray[np.float64], boundary: Boundary, out: NDArray[np.float64]) -> int:
    """Write the runs of a resolved boundary as pieces; return how many."""
    count = min(len(boundary.run_piece), len(out) - 2 * HOPELESS)
    for r in range(count):
        curve = curves[boundary.run_piece[r]]
        _keep_run(curve, boundary.run_role[r], boundary.run_y[r, 0], boundary.run_y[r, 1], out[r])
    return count


@kernel(allocates=False)
def _meet(out: NDArray[np.float64], count: int) -> bool:
    """Whether all pieces have an end at one point: then dividing the cell separates none of them there."""
    for end in (0, 3):
        x, y = out[0, end, 0], out[0, end, 1]
        meeting = 0
        for k in range(count):
            at_start, at_stop = out[k, 0, 0] == x and out[k, 0, 1] == y, out[k, 3, 0] == x and out[k, 3, 1] == y
            meeting += 1 if at_start or at_stop else 0
        if meeting == count:
            return True
    return False


@kernel(allocates=False)
def _upright(curves: NDArray[np.float64]) -> int:
    """Number of pieces that are not horizontal: no others count, but at the left edge."""
    count = 0
    for i in range(len(curves)):
        count += 1 if curves[i, 0, 1] != curves[i, 3, 1] else 0
    return count


@kernel
def new_workspace() -> Workspace:
    """Room for any cell that is looked at."""
    return Workspace(
        CellPieces(
            np.empty((HOPELESS, 4, 2)),
            np.empty(HOPELESS, np.int64),
            np.empty(HOPELESS, np.int64),
            np.empty(HOPELESS, np.int64),
            np.empty(HOPELESS, np.int64),
        ),
        np.empty(HOPELESS, np.int64),
        np.empty(HOPELESS, np.int64),
        np.empty((MOST_RUNS + 2 * HOPELESS, 4, 2)),
    )


@kernel
def _crowded_area(
    pool: Pool,
    first: int,
    last: int,
    present: NDArray[np.int64],
    rules: NDArray[np.int64],
    x0: float,
    y0: float,
    size: float,
) -> float:
    """Filled part of a cell at the depth limit that holds too much to be resolved."""
    n = last - first
    points, path = np.empty((n, 4, 2)), np.empty(n, np.int64)
    for k in range(n):
        i = pool.numbers[first + k]
        copy_curve(pool.points[i], points[k])
        path[k] = pool.path[i]
    return crowded_area(points, path, present, rules, x0, y0, size)


@kernel
def _resolve_cell(cell: CellPieces, out: NDArray[np.float64]) -> int:
    """Write the pieces of a cell's boundary after its overlaps and crossings are resolved; return how many.

    There are no more than twice as many runs as pieces and crossings; beyond the room of `out` they are left out,
    in cells that hold far more than a leaf can take.
    """
    boundary = resolve(cell.curves, cell.owner, cell.corner, cell.rules)
    return _resolved_pieces(cell.curves, boundary, out)


@kernel(allocates=False)
def leaf_of(
    pool: Pool,
    first: int,
    last: int,
    present: NDArray[np.int64],
    rules: NDArray[np.int64],
    x0: float,
    y0: float,
    size: float,
    capacity: int,
    tolerance: float,
    at_limit: bool,
    workspace: Workspace,
    target: NDArray[np.float64],
) -> Leaf:
    """Leaf of a cell; its pieces are written to `target`.

    Parameters
    ----------
    pool : Pool
        The cell's pieces are its numbers first..last-1.
    present : (m, 2) int64 array
        The paths in the cell and their corner windings.
    rules : (paths,) int64 array
        `FillRule` of each path of the drawing.
    x0, y0, size : float
        The cell.
    capacity : int
        Pieces that a leaf may hold; more only at the depth limit, or where dividing would not separate them.
    tolerance : float
        Largest distance by which merging may move the outline, in unit-square units; 0 merges nothing.
    at_limit : bool
        Whether the cell may not be divided: then there always is a leaf.
    workspace : Workspace
        Scratch.
    target : (MOST_CURVES, 4, 2) float64 array
        Written, in lattice units.
    """
    n, paths = last - first, len(present)
    if n > HOPELESS and at_limit:
        return Leaf(0, 0, _crowded_area(pool, first, last, present, rules, x0, y0, size), 0.0, False)
    if n > (MOST_MERGED if tolerance > 0.0 else 2 * MOST_CURVES) and not at_limit:
        return Leaf(DIVIDE, 0, 0.0, 0.0, True)
    room, out, path, distance = workspace.cell, workspace.out, workspace.path[:n], 0.0
    points, paths_of, numbers, curves = pool.points, pool.path, pool.numbers, room.curves[:n]
    for k in range(n):
        i = numbers[first + k]
        quantise_piece(points[i], x0, y0, size, curves[k])
        path[k] = paths_of[i]
    if tolerance > 0.0 and 1 < n <= MOST_MERGED:
        n, distance = merge_chains(curves, path, tolerance * LATTICE / size, out, workspace.merged_path)
        curves, path = room.curves[:n], workspace.merged_path[:n]
        for k in range(n):
            copy_curve(out[k], curves[k])
    upright = _upright(curves)
    most = capacity + (SPARE if paths > 1 else 0)
    if not at_limit and upright > most and (upright > MOST_CURVES or not _meet(curves, n)):
        return Leaf(DIVIDE, 0, 0.0, 0.0, True)
    cell = CellPieces(curves, room.owner[:n], room.corner[:paths], room.rules[:paths], room.windings[:paths])
    cell_paths(path, present, rules, cell.owner, cell.corner, cell.rules)
    _round_controls(curves, n)
    count = clean_pieces(cell, out) if all_separate(curves) else UNSURE
    if count == UNSURE:
        count = _resolve_cell(cell, out)
    count, winding = corner_winding(cell, out, count)
    _round_controls(out, count)
    area = min(max(winding_area(out[:count], winding, LATTICE), 0.0), 1.0)
    distance *= size / LATTICE
    if count == 0:
        return Leaf(0, 0, area, distance, True)
    if count > capacity and not (count <= MOST_CURVES and (at_limit or _meet(out, count))):
        return Leaf(0 if at_limit else DIVIDE, 0, area, distance, False)
    for k in range(count):
        copy_curve(out[k], target[k])
    return Leaf(count, winding, area, distance, True)
