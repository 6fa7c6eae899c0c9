"""The packed leaf: a few monotone pieces on the leaf's lattice, between which the winding number is 0 or 1.

In the cells of most drawings no two pieces touch but at their ends; then each piece's sides are found by counting, and
it is kept, turned or dropped. All other cells go through `vexture.quadtree.boundary`. In both cases horizontal pieces
vanish, for they change no winding, but for those that end on the left edge where the rule of windings needs an end.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.monotone import Pieces
from vexture.bezier.roots import solve_monotone
from vexture.bezier.split import copy_curve, subcubic
from vexture.kernels import kernel
from vexture.quadtree.boundary import Boundary, cell_paths, crowded_area, quantise, resolve
from vexture.quadtree.crossings import x_at
from vexture.quadtree.tree import LATTICE, MOST_CURVES
from vexture.quadtree.winding import inside, winding_area

__all__ = ["DIVIDE", "PackedLeaf", "packed_leaf"]

DIVIDE = -1
"""Count of pieces of a cell that is to be divided."""

UNSURE = 2
"""Role of a piece whose place among its neighbours is not clear."""

TOUCH = 2.0
"""Lattice units: a resolved end nearer to the left edge may be moved onto it."""

SPARE = 4
"""Pieces above the capacity with which a cell is still looked at: horizontal ones and overlaps will vanish."""

HOPELESS = 160
"""Pieces in a cell above which it is not resolved at all: resolving looks at every pair."""


class PackedLeaf(NamedTuple):
    """What a cell can be said to hold.

    Attributes
    ----------
    count : int
        Number of pieces, or `DIVIDE`.
    winding : int
        Corner winding, 0 if there are no pieces.
    coverage : float
        Filled part of the cell.
    resolved : bool
        False if this is the best that a cell at the depth limit can say, rather than all.
    """

    count: int
    winding: int
    coverage: float
    resolved: bool


@kernel
def _round_controls(curves: NDArray[np.float64], count: int) -> None:
    """Round inner control points to the lattice, within the range that the format can hold."""
    for i in range(count):
        for k in (1, 2):
            for axis in range(2):
                curves[i, k, axis] = min(max(np.rint(curves[i, k, axis]), -0.5 * LATTICE), 1.5 * LATTICE - 1.0)


@kernel
def _beside(a: NDArray[np.float64], b: NDArray[np.float64], line: NDArray[np.float64]) -> bool:
    """Whether two pieces lie on different sides of a direction: that of `line`, which is one of them."""
    dx, dy = line[3, 0] - line[0, 0], line[3, 1] - line[0, 1]
    a_low, a_high, b_low, b_high = np.inf, -np.inf, np.inf, -np.inf
    for k in range(4):
        across = dx * (a[k, 1] - line[0, 1]) - dy * (a[k, 0] - line[0, 0])
        a_low, a_high = min(a_low, across), max(a_high, across)
        across = dx * (b[k, 1] - line[0, 1]) - dy * (b[k, 0] - line[0, 0])
        b_low, b_high = min(b_low, across), max(b_high, across)
    return (a_high <= b_low and a_low < b_high) or (b_high <= a_low and b_low < a_high)


@kernel
def _separate(a: NDArray[np.float64], b: NDArray[np.float64]) -> bool:
    """Whether two monotone pieces surely touch at most at their ends: their boxes, or their hulls, do."""
    for axis in range(2):
        a_low, a_high = min(a[0, axis], a[3, axis]), max(a[0, axis], a[3, axis])
        b_low, b_high = min(b[0, axis], b[3, axis]), max(b[0, axis], b[3, axis])
        if (a_high <= b_low and a_low < b_high) or (b_high <= a_low and b_low < a_high):
            return True
    return _beside(a, b, a) or _beside(a, b, b)


@kernel
def _ends_on(a: NDArray[np.float64], b: NDArray[np.float64]) -> bool:
    """Whether an end of one piece may lie on another that is not horizontal, between its ends."""
    if b[0, 1] == b[3, 1]:
        return False
    for end in (0, 3):
        x, y = a[end, 0], a[end, 1]
        if (x == b[0, 0] and y == b[0, 1]) or (x == b[3, 0] and y == b[3, 1]):
            continue
        if min(b[0, 0], b[3, 0]) <= x <= max(b[0, 0], b[3, 0]) and min(b[0, 1], b[3, 1]) <= y <= max(b[0, 1], b[3, 1]):
            return True
    return False


@kernel
def _all_separate(curves: NDArray[np.float64]) -> bool:
    """Whether no two pieces touch but at their ends, two horizontal ones aside: then each has one role all along."""
    for i in range(len(curves)):
        for j in range(i):
            a, b = curves[i], curves[j]
            if a[0, 1] == a[3, 1] and b[0, 1] == b[3, 1]:
                continue
            if not _separate(a, b) or _ends_on(a, b) or _ends_on(b, a):
                return False
    return True


@kernel
def _any_inside(windings: NDArray[np.int64], rules: NDArray[np.int64]) -> bool:
    """Whether a point is inside any path."""
    for k in range(len(windings)):
        if inside(windings[k], rules[k]):
            return True
    return False


@kernel
def _left_edge_windings(
    curves: NDArray[np.float64],
    owner: NDArray[np.int64],
    corner: NDArray[np.int64],
    y: float,
    below: bool,
    windings: NDArray[np.int64],
) -> None:
    """Write each path's winding number at the left edge just above height y, or just below it."""
    for k in range(len(corner)):
        windings[k] = corner[k]
    for i in range(len(curves)):
        for end, event in ((0, 1), (3, -1)):
            if curves[i, end, 0] == 0.0 and (curves[i, end, 1] < y or (curves[i, end, 1] == y and not below)):
                windings[owner[i]] += event


@kernel
def _role(
    curves: NDArray[np.float64],
    owner: NDArray[np.int64],
    corner: NDArray[np.int64],
    rules: NDArray[np.int64],
    i: int,
    windings: NDArray[np.int64],
) -> int:
    """1 if only the right side of a piece is inside, -1 if only the left side is, else 0; or `UNSURE`."""
    y = 0.5 * (curves[i, 0, 1] + curves[i, 3, 1])
    _left_edge_windings(curves, owner, corner, y, False, windings)
    low, high = min(curves[i, 0, 0], curves[i, 3, 0]), max(curves[i, 0, 0], curves[i, 3, 0])
    for j in range(len(curves)):
        a, d = curves[j, 0, 1], curves[j, 3, 1]
        if j == i or not (min(a, d) <= y < max(a, d)):
            continue
        left = max(curves[j, 0, 0], curves[j, 3, 0]) <= low
        if not left and min(curves[j, 0, 0], curves[j, 3, 0]) < high:
            gap = x_at(curves[i], y) - x_at(curves[j], y)
            if gap == 0.0:
                return UNSURE
            left = gap > 0.0
        if left:
            windings[owner[j]] += -1 if d > a else 1
    before = _any_inside(windings, rules)
    windings[owner[i]] += -1 if curves[i, 3, 1] > curves[i, 0, 1] else 1
    after = _any_inside(windings, rules)
    return 0 if before == after else (1 if after else -1)


@kernel
def _keep_run(curve: NDArray[np.float64], role: int, low: float, high: float, out: NDArray[np.float64]) -> None:
    """Write the part of a piece between two heights, the filled side on its left."""
    start, stop = (high, low) if role == 1 else (low, high)
    u0 = solve_monotone(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], start)
    u1 = solve_monotone(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], stop)
    subcubic(curve, u0, u1, out)
    for end, control, u, y in ((0, 1, u0, start), (3, 2, u1, stop)):
        x = out[end, 0]
        if u != 0.0 and u != 1.0:
            x = min(max(np.rint(x), 1.0), LATTICE)
        else:
            x = np.rint(x)
        out[control, 0] += x - out[end, 0]
        out[control, 1] += y - out[end, 1]
        out[end, 0], out[end, 1] = x, y


@kernel
def _clean_pieces(
    curves: NDArray[np.float64],
    owner: NDArray[np.int64],
    corner: NDArray[np.int64],
    rules: NDArray[np.int64],
    out: NDArray[np.float64],
) -> int:
    """Write the pieces that bound inside, of a cell in which all are separate; return how many, or `DIVIDE`."""
    windings = np.empty(len(corner), np.int64)
    count = 0
    for i in range(len(curves)):
        if curves[i, 0, 1] == curves[i, 3, 1]:
            continue
        role = _role(curves, owner, corner, rules, i, windings)
        if role == UNSURE:
            return DIVIDE
        if role != 0:
            if (role == 1) == (curves[i, 3, 1] < curves[i, 0, 1]):
                copy_curve(curves[i], out[count])
            else:
                subcubic(curves[i], 1.0, 0.0, out[count])
            count += 1
    return count


@kernel
def _resolved_pieces(curves: NDArray[np.float64], boundary: Boundary, out: NDArray[np.float64]) -> int:
    """Write the runs of a resolved boundary as pieces; return how many."""
    for r in range(len(boundary.run_piece)):
        curve = curves[boundary.run_piece[r]]
        _keep_run(curve, boundary.run_role[r], boundary.run_y[r, 0], boundary.run_y[r, 1], out[r])
    return len(boundary.run_piece)


@kernel
def _events(out: NDArray[np.float64], count: int, y: float) -> int:
    """Starts minus ends on the left edge at a height."""
    total = 0
    for k in range(count):
        for end, event in ((0, 1), (3, -1)):
            if out[k, end, 0] == 0.0 and out[k, end, 1] == y:
                total += event
    return total


@kernel
def _match_left_edge(out: NDArray[np.float64], count: int, y: float, wanted: int) -> int:
    """Make starts minus ends on the left edge at a height what inside says there; return the new count.

    Where they disagree an end is nudged off the edge, or one beside it onto it, or, where the boundary leaves the
    edge horizontally, a horizontal piece says so.
    """
    for _ in range(2 * len(out)):
        missing = wanted - _events(out, count, y)
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


@kernel
def _add_horizontal(out: NDArray[np.float64], count: int, y: float, starts: bool) -> int:
    """Append a horizontal piece that starts or ends on the left edge, to where the next end is; return the count."""
    x = LATTICE
    for k in range(count):
        for end in (0, 3):
            if out[k, end, 1] == y and 0.0 < out[k, end, 0] < x:
                x = out[k, end, 0]
    for k in range(4):
        part = k if starts else 3 - k
        out[count, k, 0], out[count, k, 1] = x * part / 3.0, y
    return count + 1


@kernel
def _corner_winding(
    curves: NDArray[np.float64],
    owner: NDArray[np.int64],
    corner: NDArray[np.int64],
    rules: NDArray[np.int64],
    out: NDArray[np.float64],
    count: int,
) -> tuple[int, int]:
    """Let the ends on the left edge say what is inside there; return the new count and the corner winding."""
    windings = np.empty(len(corner), np.int64)
    for i in range(len(curves)):
        for end in (0, 3):
            y = curves[i, end, 1]
            if curves[i, end, 0] == 0.0 and 0.0 < y < LATTICE:
                _left_edge_windings(curves, owner, corner, y, True, windings)
                below = 1 if _any_inside(windings, rules) else 0
                _left_edge_windings(curves, owner, corner, y, False, windings)
                above = 1 if _any_inside(windings, rules) else 0
                count = _match_left_edge(out, count, y, above - below)
    _left_edge_windings(curves, owner, corner, 0.0, False, windings)
    return count, (1 if _any_inside(windings, rules) else 0) - _events(out, count, 0.0)


@kernel
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


@kernel
def _area(out: NDArray[np.float64], count: int, winding: int) -> float:
    """Filled part of the leaf."""
    local = np.empty((count, 4, 2))
    for i in range(count):
        for k in range(4):
            local[i, k, 0], local[i, k, 1] = out[i, k, 0] / LATTICE, out[i, k, 1] / LATTICE
    return min(max(winding_area(local, winding), 0.0), 1.0)


@kernel
def packed_leaf(
    pieces: Pieces,
    first: int,
    last: int,
    present: NDArray[np.int64],
    rules: NDArray[np.int64],
    x0: float,
    y0: float,
    size: float,
    capacity: int,
    at_limit: bool,
    target: NDArray[np.float64],
) -> PackedLeaf:
    """Leaf of a cell; its pieces are written to `target`.

    Parameters
    ----------
    pieces : Pieces
        Those of the cell are first..last-1.
    present : (n, 2) int64 array
        The paths in the cell and their corner windings.
    rules : (paths,) int64 array
        `FillRule` of each path of the drawing.
    x0, y0, size : float
        The cell.
    capacity : int
        Pieces that a leaf may hold; more only at the depth limit, or where dividing would not separate them.
    at_limit : bool
        Whether the cell may not be divided: then there always is a leaf.
    target : (MOST_CURVES, 4, 2) float64 array
        Written, in lattice units.
    """
    n = last - first
    if n > HOPELESS and at_limit:
        return PackedLeaf(0, 0, crowded_area(pieces, first, last, present, rules, x0, y0, size), False)
    if n > (HOPELESS if at_limit else MOST_CURVES):
        return PackedLeaf(DIVIDE, 0, 0.0, True)
    owner, corner, cell_rules = cell_paths(pieces, first, last, present, rules)
    curves = quantise(pieces.points[first:last], x0, y0, size)
    _round_controls(curves, n)
    out = np.empty((2 * n, 4, 2))
    count = DIVIDE
    if _all_separate(curves):
        count = _clean_pieces(curves, owner, corner, cell_rules, out)
    if count == DIVIDE:
        if not at_limit and n > capacity + SPARE:
            return PackedLeaf(DIVIDE, 0, 0.0, True)
        boundary = resolve(curves, owner, corner, cell_rules)
        out = np.empty((len(boundary.run_piece) + 2 * n, 4, 2))
        count = _resolved_pieces(curves, boundary, out)
    count, winding = _corner_winding(curves, owner, corner, cell_rules, out, count)
    _round_controls(out, count)
    area = _area(out, count, winding)
    if count == 0:
        return PackedLeaf(0, 0, area, True)
    if count > capacity and not (count <= MOST_CURVES and (at_limit or _meet(out, count))):
        return PackedLeaf(0 if at_limit else DIVIDE, 0, area, False)
    for k in range(count):
        copy_curve(out[k], target[k])
    return PackedLeaf(count, winding, area, True)
