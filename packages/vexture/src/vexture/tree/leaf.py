"""The packed leaf: a few monotone pieces on the leaf's lattice, between which the winding number is 0 or 1.

In most cells pieces touch only at their ends. Then counting windings gives the sides of each piece (`separate.py`), and
the piece is kept, reversed or dropped. All other cells are resolved (`boundary.py`). In both cases horizontal pieces
are dropped, because they change no winding. Only those stay that end on the left edge where the rule of windings needs
an end: the leaf's corner winding and the ends on the edge must agree with what is inside there.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import LATTICE, MOST_CURVES
from vexture.bezier.roots import solve_monotone
from vexture.bezier.split import copy_curve, subcubic
from vexture.tree.boundary import MOST_RESOLVED, Boundary, cell_paths, crowded_area, quantise_piece, resolve
from vexture.tree.bounds import Bounds
from vexture.tree.coincide import match, may_coincide
from vexture.tree.divide import Cell, PiecePool
from vexture.tree.merge import MOST_MERGED, follows, merge_chains
from vexture.tree.separate import UNSURE, CellPieces, all_separate, any_inside, clean_pieces, left_edge_windings
from vexture.tree.winding import winding_area

TOUCH = 2.0
"""Lattice units. A resolved end closer than this to the left edge may be moved onto it."""


@kernel(allocates=False)
def _events(out: NDArray[np.float64], count: int, y: float) -> int:
    """Starts minus ends on the left edge at a height."""
    total = 0
    for k in range(count):
        for end, event in ((0, 1), (3, -1)):
            if out[k, end, 0] == 0.0 and out[k, end, 1] == y:
                total += event
    return total


@kernel(allocates=False)
def _match_left_edge(out: NDArray[np.float64], count: int, y: float, target: int) -> int:
    """Make starts minus ends on the left edge at a height equal to `target`; return the new count of pieces.

    If they differ, an end is moved off the edge, or an end beside the edge onto it. If there is no such end, the
    boundary leaves the edge horizontally, and a horizontal piece is added.
    """
    for _ in range(2 * len(out)):
        missing = target - _events(out, count, y)
        if missing == 0:
            break
        best, best_end, best_x = -1, 0, TOUCH
        for k in range(count):
            for end, event in ((0, 1), (3, -1)):
                x = out[k, end, 0]
                if out[k, end, 1] != y:
                    continue
                if x == 0.0 and event * missing < 0:
                    best, best_end, best_x = k, end, -1.0
                elif 0.0 < x <= best_x and event * missing > 0:
                    best, best_end, best_x = k, end, x
        if best < 0:
            count = _add_horizontal(out, count, y, missing > 0)
            continue
        moved = 1.0 if best_x < 0.0 else -best_x
        out[best, best_end, 0] += moved
        out[best, 1 if best_end == 0 else 2, 0] += moved
    return count


@kernel(allocates=False)
def _add_horizontal(out: NDArray[np.float64], count: int, y: float, starts: bool) -> int:
    """Append a horizontal piece from (or to) the left edge, as far as the next end; return the new count."""
    x = LATTICE
    for k in range(count):
        for end in (0, 3):
            if out[k, end, 1] == y and 0.0 < out[k, end, 0] < x:
                x = out[k, end, 0]
    for k in range(4):
        part = k if starts else 3 - k
        out[count, k, 0], out[count, k, 1] = x * part / 3.0, y
    return count + 1


@kernel(allocates=False)
def corner_winding(cell: CellPieces, out: NDArray[np.float64], count: int) -> tuple[int, int]:
    """Make the ends on the left edge agree with the windings there; return the new count and the corner winding."""
    curves, windings, rules = cell.curves, cell.windings, cell.rules
    for i in range(len(curves)):
        for end in (0, 3):
            y = curves[i, end, 1]
            if curves[i, end, 0] == 0.0 and 0.0 < y < LATTICE:
                left_edge_windings(cell, y, True)
                below = 1 if any_inside(windings, rules) else 0
                left_edge_windings(cell, y, False)
                above = 1 if any_inside(windings, rules) else 0
                count = _match_left_edge(out, count, y, above - below)
    left_edge_windings(cell, 0.0, False)
    return count, (1 if any_inside(windings, rules) else 0) - _events(out, count, 0.0)


DIVIDE = -1
"""`TreeLeaf.size` of a cell that must be divided."""

SPARE = 12
"""Pieces above the capacity that a cell may have before it is resolved. Horizontal and overlapping ones vanish."""

LONG_HANDLE = 512.0
"""Lattice units. Rounding turns a longer handle by too little to be seen."""

MOST_RUNS = 1000
"""Most runs of resolved pieces that are kept to measure a cell's area."""


class TreeLeaf(NamedTuple):
    """Content of a cell that a leaf stores."""

    size: int  # number of pieces, or `DIVIDE`
    winding: int  # corner winding, 0 without pieces
    coverage: float  # filled part of the cell
    distance: float  # the farthest that merging moved the outline, in unit-square units
    resolved: bool  # False if the cell, at the depth limit, holds more than a leaf can store


class Workspace(NamedTuple):
    """Arrays that are reused from cell to cell, because allocating them takes longer than most cells."""

    cell: CellPieces
    path: NDArray[np.int64]
    merged_path: NDArray[np.int64]
    out: NDArray[np.float64]


@kernel(allocates=False)
def round_controls(curves: NDArray[np.float64], count: int) -> None:
    """Round inner control points to the lattice, within the range of the format, and keep directions at the ends."""
    for i in range(count):
        for end, control in ((0, 1), (3, 2)):
            _aim(curves[i], end, control)
        for k in (1, 2):
            for axis in range(2):
                curves[i, k, axis] = min(max(np.rint(curves[i, k, axis]), -0.5 * LATTICE), 1.5 * LATTICE - 1.0)


@kernel(allocates=False)
def _aim(curve: NDArray[np.float64], end: int, control: int) -> None:
    """Change the length of a short handle so that rounding turns it least, because its direction is visible at the end.

    The piece bends little, so the length hardly matters, as long as it moves the curve by no more than half a unit.
    """
    x, y = curve[control, 0] - curve[end, 0], curve[control, 1] - curve[end, 1]
    far_x, far_y = curve[3 - control, 0] - curve[end, 0], curve[3 - control, 1] - curve[end, 1]
    length = max(abs(x), abs(y))
    if length > LONG_HANDLE or length < 1.0:
        return
    chord_x, chord_y = curve[3, 0] - curve[0, 0], curve[3, 1] - curve[0, 1]
    chord = np.sqrt(chord_x * chord_x + chord_y * chord_y)
    across = abs(x * chord_y - y * chord_x) / chord if chord > 0.0 else length
    best, least = 1.0, np.inf
    for k in range(int(length)):
        change = -(k + 1) // 2 if k % 2 == 1 else k // 2  # units, shorter and longer in turn
        share = (length + change) / length
        if abs(share - 1.0) * across > 0.5:
            break
        if change > 0 and (abs(share * x) > abs(far_x) or abs(share * y) > abs(far_y)):
            continue  # must not pass the other handle, so that the piece stays monotone
        to_x, to_y = np.rint(share * x), np.rint(share * y)
        turn = abs(to_x * y - to_y * x) / max(np.sqrt(to_x * to_x + to_y * to_y), 0.5)
        if turn < 0.9 * least:
            best, least = share, turn
            if turn == 0.0:
                break
    curve[control, 0], curve[control, 1] = curve[end, 0] + best * x, curve[end, 1] + best * y


@kernel(allocates=False)
def keep_run(curve: NDArray[np.float64], role: int, low: float, high: float, out: NDArray[np.float64]) -> None:
    """Write the part of a piece between two heights, with the filled side on its left."""
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
    count = min(len(boundary.run_piece), len(out) - 2 * MOST_RESOLVED)
    for r in range(count):
        curve = curves[boundary.run_piece[r]]
        keep_run(curve, boundary.run_role[r], boundary.run_y[r, 0], boundary.run_y[r, 1], out[r])
    return count


@kernel(allocates=False)
def _meet(out: NDArray[np.float64], count: int) -> bool:
    """Whether all pieces have an end at one point, where dividing the cell does not separate them."""
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
def _write_chains(out: NDArray[np.float64], count: int, target: NDArray[np.int32]) -> None:
    """Copy pieces, each after the one that ends where it starts, because equal points side by side compress better."""
    for k in range(count):
        best, rank = k, 0
        for j in range(k, count):
            first = True
            for i in range(k, count):
                if follows(out, j, i):
                    first = False
                    break
            next_one = k > 0 and follows(out, j, k - 1)
            if 2 * next_one + first > rank:
                best, rank = j, 2 * next_one + first
        copy_curve(out[best], target[k])
        copy_curve(out[k], out[best])
        copy_curve(target[k], out[k])


@kernel(allocates=False)
def _upright(curves: NDArray[np.float64]) -> int:
    """Number of pieces that are not horizontal."""
    count = 0
    for i in range(len(curves)):
        count += 1 if curves[i, 0, 1] != curves[i, 3, 1] else 0
    return count


@kernel
def new_workspace(paths: int) -> Workspace:
    """Arrays for any cell that may be resolved, in a drawing of `paths` paths.

    Copies that cancel leave paths without pieces, so a cell may have more paths than pieces.
    """
    return Workspace(
        CellPieces(
            np.empty((MOST_RESOLVED, 4, 2)),
            np.empty(MOST_RESOLVED, np.int64),
            np.empty(MOST_RESOLVED, np.int64),
            np.empty(paths, np.int64),
            np.empty(paths, np.int64),
            np.empty(paths, np.int64),
        ),
        np.empty(MOST_RESOLVED, np.int64),
        np.empty(MOST_RESOLVED, np.int64),
        np.empty((MOST_RUNS + 2 * MOST_RESOLVED, 4, 2)),
    )


@kernel
def _crowded_area(pool: PiecePool, cell: Cell, present: NDArray[np.int64], rules: NDArray[np.int64]) -> float:
    """Filled part of a cell at the depth limit that holds too many pieces to resolve."""
    n = cell.last - cell.first
    points, path = np.empty((n, 4, 2)), np.empty(n, np.int64)
    for k in range(n):
        i = pool.numbers[cell.first + k]
        copy_curve(pool.points[i], points[k])
        path[k] = pool.path[i]
    return crowded_area(points, path, present, rules, cell.x, cell.y, cell.size)


@kernel
def _resolve_cell(cell: CellPieces, out: NDArray[np.float64]) -> int:
    """Resolve overlaps and crossings in a cell; write the pieces of its boundary; return how many.

    There are at most twice as many runs as pieces and crossings. Runs for which `out` has no room are left out, because
    such cells hold far more than a leaf can store.
    """
    boundary = resolve(cell.curves, cell.owner, cell.multiplicity, cell.corner, cell.rules)
    return _resolved_pieces(cell.curves, boundary, out)


@kernel(allocates=False)
def leaf_of(
    pool: PiecePool,
    cell: Cell,
    present: NDArray[np.int64],
    rules: NDArray[np.int64],
    bounds: Bounds,
    at_limit: bool,
    workspace: Workspace,
    target: NDArray[np.int32],
) -> TreeLeaf:
    """Make the leaf of a cell, and write the leaf's pieces to `target`, (MOST_CURVES, 4, 2), in lattice units.

    A leaf holds more pieces than `bounds.capacity` only at the depth limit, or where dividing would not separate them.
    Merging moves the outline by at most `bounds.tolerance`, and 0 merges nothing. With `at_limit` the cell may not be
    divided, and the result is always a leaf.
    """
    n, paths = cell.last - cell.first, len(present)
    room, out, distance = workspace.cell, workspace.out, 0.0
    capacity, tolerance = bounds.capacity, bounds.tolerance
    most = capacity + SPARE
    matched, upright = -1, 0
    if n > most and may_coincide(pool, cell):
        matched, upright = match(pool, cell, bounds.near, present, rules, room, workspace.path)
    if matched >= 0:
        n = matched
    elif n > MOST_RESOLVED and at_limit:
        return TreeLeaf(0, 0, _crowded_area(pool, cell, present, rules), 0.0, False)
    elif n > (MOST_MERGED if tolerance > 0.0 else 2 * MOST_CURVES) and not at_limit:
        return TreeLeaf(DIVIDE, 0, 0.0, 0.0, True)
    else:
        points, paths_of, numbers = pool.points, pool.path, pool.numbers
        curves, path = room.curves[:n], workspace.path[:n]
        for k in range(n):
            i = numbers[cell.first + k]
            quantise_piece(points[i], cell.x, cell.y, cell.size, curves[k])
            path[k] = paths_of[i]
        if tolerance > 0.0 and 1 < n <= MOST_MERGED:
            n, distance = merge_chains(
                room.curves[:n],
                workspace.path[:n],
                tolerance * LATTICE / cell.size,
                n if at_limit else max(most, MOST_CURVES),
                out,
                workspace.merged_path,
            )
            for k in range(n):
                copy_curve(out[k], room.curves[k])
                workspace.path[k] = workspace.merged_path[k]
        upright = _upright(room.curves[:n])
        room.multiplicity[:n] = 1
    curves = room.curves[:n]
    if not at_limit and upright > most and (upright > MOST_CURVES or not _meet(curves, n)):
        return TreeLeaf(DIVIDE, 0, 0.0, 0.0, True)
    local = CellPieces(
        curves, room.owner[:n], room.multiplicity[:n], room.corner[:paths], room.rules[:paths], room.windings[:paths]
    )
    if matched < 0:
        cell_paths(workspace.path[:n], present, rules, local.owner, local.corner, local.rules)
    round_controls(curves, n)
    count = clean_pieces(local, out) if all_separate(curves) else UNSURE
    if count == UNSURE:
        count = _resolve_cell(local, out)
    count, winding = corner_winding(local, out, count)
    round_controls(out, count)
    area = min(max(winding_area(out[:count], winding, LATTICE), 0.0), 1.0)
    distance *= cell.size / LATTICE
    if count == 0:
        return TreeLeaf(0, 0, area, distance, True)
    if count > capacity and not (count <= MOST_CURVES and (at_limit or _meet(out, count))):
        return TreeLeaf(0 if at_limit else DIVIDE, 0, area, distance, False)
    _write_chains(out, count, target)
    return TreeLeaf(count, winding, area, distance, True)
