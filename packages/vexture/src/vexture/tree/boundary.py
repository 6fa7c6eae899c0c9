"""The boundary in one candidate leaf, after fill rules, overlaps and crossings are resolved.

The pieces of all paths in a cell are rounded to the leaf's integer lattice, so that every comparison of y is exact.
The cell is cut into horizontal *slabs* at the y of each end and of each crossing. In a slab nothing crosses. One sweep
from the left edge, with prefix sums of the paths' windings, finds the pieces that separate inside from outside. No
winding is evaluated geometrically, so a wrong order of two nearly coincident curves costs area, never parity.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import LATTICE
from vexture.tree.crossings import crossing_heights, x_at
from vexture.tree.separate import CellPieces
from vexture.tree.winding import inside

NEAR = 1.0
"""Lattice units. Curves that stay closer than this are one boundary."""

MOST_RESOLVED = 160
"""Pieces. A cell with more is not resolved, because resolving compares every pair."""

SCANLINES = 64
"""Horizontal lines along which a cell with too many pieces to resolve is measured."""


class Boundary(NamedTuple):
    """The resolved boundary in a leaf. Its *runs* are the parts of pieces that separate inside from outside."""

    heights: NDArray[np.float64]  # (slabs + 1,): lattice y of the slabs' borders
    left: NDArray[np.int64]  # (slabs,): 1 where the left edge of the leaf is inside
    run_piece: NDArray[np.int64]  # (runs,): the piece that the run is part of
    run_role: NDArray[np.int64]  # (runs,): 1 if the right side is inside, -1 if the left side is
    run_y: NDArray[np.float64]  # (runs, 2): lattice y of the lower and upper end


@kernel
def quantise(points: NDArray[np.float64], x0: float, y0: float, size: float) -> NDArray[np.float64]:
    """Round the pieces of a cell to its lattice: ends become integers, and inner control points move with them.

    A point on the left edge stays there, and no other point is moved onto it, because the rule of windings counts the
    ends on that edge.
    """
    out = np.empty((len(points), 4, 2))
    for i in range(len(points)):
        quantise_piece(points[i], x0, y0, size, out[i])
    return out


@kernel(allocates=False)
def quantise_piece(points: NDArray[np.float64], x0: float, y0: float, size: float, out: NDArray[np.float64]) -> None:
    """Write one piece, (4, 2), rounded to its cell's lattice; see `quantise`."""
    scale = LATTICE / size
    for k in range(4):
        out[k, 0] = (points[k, 0] - x0) * scale
        out[k, 1] = (points[k, 1] - y0) * scale
    for end, control in ((0, 1), (3, 2)):
        x = 0.0 if points[end, 0] == x0 else min(max(np.rint(out[end, 0]), 1.0), LATTICE)
        y = min(max(np.rint(out[end, 1]), 0.0), LATTICE)
        out[control, 0] += x - out[end, 0]
        out[control, 1] += y - out[end, 1]
        out[end, 0], out[end, 1] = x, y


@kernel(allocates=False)
def _sift(keys: NDArray[np.float64], order: NDArray[np.int64], root: int, count: int) -> None:
    """Restore the heap below place `root`."""
    while 2 * root + 1 < count:
        child = 2 * root + 1
        if child + 1 < count and keys[order[child]] < keys[order[child + 1]]:
            child += 1
        if keys[order[root]] >= keys[order[child]]:
            return
        order[root], order[child] = order[child], order[root]
        root = child


@kernel
def sort_order(keys: NDArray[np.float64], count: int) -> NDArray[np.int64]:
    """Numbers of the first `count` keys in rising order (heap sort; NumPy's sort takes Numba seconds to compile).

    Examples
    --------
    >>> sort_order(np.array([3.0, 1.0, 2.0]), 3)
    array([1, 2, 0])
    """
    order = np.empty(count, np.int64)
    for k in range(count):
        order[k] = k
    for root in range(count // 2 - 1, -1, -1):
        _sift(keys, order, root, count)
    for last in range(count - 1, 0, -1):
        order[0], order[last] = order[last], order[0]
        _sift(keys, order, 0, last)
    return order


@kernel
def slab_heights(curves: NDArray[np.float64]) -> NDArray[np.float64]:
    """Heights of the slabs' borders, sorted and distinct: of the leaf's edges, the ends and the crossings."""
    n = len(curves)
    heights, count = crossing_heights(curves, NEAR, 2 * n + 2)
    heights[count], heights[count + 1] = 0.0, LATTICE
    count += 2
    for i in range(n):
        heights[count], heights[count + 1] = curves[i, 0, 1], curves[i, 3, 1]
        count += 2
    out = np.empty(count)
    different = 0
    for k in sort_order(heights, count):
        if different == 0 or heights[k] != out[different - 1]:
            out[different] = heights[k]
            different += 1
    return out[:different]


@kernel(allocates=False)
def order_slab(
    curves: NDArray[np.float64], low: float, high: float, active: NDArray[np.int64], x: NDArray[np.float64]
) -> int:
    """Order the pieces that span a slab by x; return how many there are.

    Their numbers are written to `active`, and their x at three inner heights to `x`. They are ordered by x at the
    middle height, or by the sum of all three where neighbours are close.
    """
    count, height = 0, high - low
    for i in range(len(curves)):
        a, d = curves[i, 0, 1], curves[i, 3, 1]
        if min(a, d) <= low and max(a, d) >= high:
            x[i, 1] = x_at(curves[i], low + 0.5 * height)
            k = count
            while k > 0 and x[active[k - 1], 1] > x[i, 1]:
                active[k] = active[k - 1]
                k -= 1
            active[k] = i
            count += 1
    close = False
    for k in range(count - 1):
        i, j = active[k], active[k + 1]
        lean = max(abs(curves[i, 3, 0] - curves[i, 0, 0]), abs(curves[j, 3, 0] - curves[j, 0, 0])) / height
        close = close or x[j, 1] - x[i, 1] <= NEAR * (1.0 + lean)
    if not close:
        for k in range(count):
            x[active[k], 0] = np.inf  # not compared
        return count
    for k in range(count):
        i = active[k]
        x[i, 0], x[i, 2] = x_at(curves[i], low + 0.15 * height), x_at(curves[i], low + 0.85 * height)
    for k in range(1, count):
        i, m = active[k], k
        total = x[i, 0] + x[i, 1] + x[i, 2]
        while m > 0 and x[active[m - 1], 0] + x[active[m - 1], 1] + x[active[m - 1], 2] > total:
            active[m] = active[m - 1]
            m -= 1
        active[m] = i
    return count


@kernel(allocates=False)
def coincide(x: NDArray[np.float64], i: int, j: int, height: float) -> bool:
    """Whether two pieces of a slab are one boundary: less than a unit apart, across them, at three heights."""
    if x[i, 0] == np.inf:
        return False
    lean = max(abs(x[i, 2] - x[i, 0]), abs(x[j, 2] - x[j, 0])) / (0.7 * height)
    for k in range(3):
        if abs(x[i, k] - x[j, k]) > NEAR * (1.0 + lean):
            return False
    return True


@kernel
def _roles_in_slab(
    cell: CellPieces,
    active: NDArray[np.int64],
    count: int,
    x: NDArray[np.float64],
    height: float,
    previous: NDArray[np.int64],
    role: NDArray[np.int64],
) -> int:
    """Sweep a slab from the left: set the role of each piece in it; return 1 if the left edge is inside, else 0.

    The cell's windings are those at the left edge. Neighbours that coincide form a group. If a group has the same side
    before and after it, all its pieces are dropped. Otherwise one piece stays: preferably one that had the same role in
    the slab below, else the one that reaches highest.
    """
    curves, owner, multiplicity, rules = cell.curves, cell.owner, cell.multiplicity, cell.rules
    w = np.empty(len(cell.windings), np.int64)
    paths_inside = 0
    for p in range(len(w)):
        w[p] = cell.windings[p]
        paths_inside += 1 if inside(w[p], rules[p]) else 0
    left = 1 if paths_inside > 0 else 0
    first = 0
    while first < count:
        before = paths_inside > 0
        last = first
        while last < count and (last == first or coincide(x, active[first], active[last], height)):
            i = active[last]
            p = owner[i]
            paths_inside -= 1 if inside(w[p], rules[p]) else 0
            w[p] += -multiplicity[i] if curves[i, 3, 1] > curves[i, 0, 1] else multiplicity[i]
            paths_inside += 1 if inside(w[p], rules[p]) else 0
            last += 1
        if before != (paths_inside > 0):
            new_role = -1 if before else 1
            best, best_reach = -1, -1.0
            for k in range(first, last):
                i = active[k]
                reach = max(curves[i, 0, 1], curves[i, 3, 1]) + (2.0 * LATTICE if previous[i] == new_role else 0.0)
                if reach > best_reach:
                    best, best_reach = i, reach
            role[best] = new_role
        first = last
    return left


@kernel
def resolve(
    curves: NDArray[np.float64],
    owner: NDArray[np.int64],
    multiplicity: NDArray[np.int64],
    corner: NDArray[np.int64],
    rules: NDArray[np.int64],
) -> Boundary:
    """Boundary of the union of all paths in a leaf, from its pieces on the lattice (`quantise`).

    `corner` and `rules` hold the corner windings and fill rules of the leaf's own paths. `owner` (n,) is the path of
    each piece, an index into both. `multiplicity` (n,) is the number of copies of each piece; it is negative if they
    run in the other direction.
    """
    heights = slab_heights(curves)
    slabs, count = len(heights) - 1, len(curves)
    left = np.zeros(slabs, np.int64)
    run_piece, run_role = np.empty(count * slabs, np.int64), np.empty(count * slabs, np.int64)
    run_y = np.empty((count * slabs, 2))
    role, previous = np.zeros(count, np.int64), np.zeros(count, np.int64)
    since = np.zeros(count)
    windings = np.empty(len(corner), np.int64)
    for p in range(len(corner)):
        windings[p] = corner[p]
    cell = CellPieces(curves, owner, multiplicity, corner, rules, windings)
    active, x = np.empty(count, np.int64), np.empty((count, 3))
    runs = 0
    for slab in range(slabs + 1):
        low = heights[slab]
        for i in range(count):
            role[i] = 0
        if slab < slabs:
            for i in range(count):
                for end, event in ((0, 1), (3, -1)):
                    if curves[i, end, 0] == 0.0 and curves[i, end, 1] == low:
                        windings[owner[i]] += event * multiplicity[i]
            high = heights[slab + 1]
            spanning = order_slab(curves, low, high, active, x)
            left[slab] = _roles_in_slab(cell, active, spanning, x, high - low, previous, role)
        for i in range(count):
            if role[i] != previous[i]:
                if previous[i] != 0:
                    run_piece[runs], run_role[runs] = i, previous[i]
                    run_y[runs, 0], run_y[runs, 1] = since[i], low
                    runs += 1
                previous[i], since[i] = role[i], low
    return Boundary(heights, left, run_piece[:runs], run_role[:runs], run_y[:runs])


@kernel(allocates=False)
def cell_paths(
    path: NDArray[np.int64],
    present: NDArray[np.int64],
    rules: NDArray[np.int64],
    owner: NDArray[np.int64],
    corner: NDArray[np.int64],
    cell_rules: NDArray[np.int64],
) -> None:
    """Number the paths of a cell from 0; write the `owner` of each piece, and the paths' corner windings and rules.

    The pieces, whose paths are `path`, are in the order of `present`.
    """
    k = 0
    for i in range(len(path)):
        while present[k, 0] != path[i]:
            k += 1
        owner[i] = k
    for k in range(len(present)):
        corner[k], cell_rules[k] = present[k, 1], rules[present[k, 0]]


@kernel
def crowded_area(
    points: NDArray[np.float64],
    path: NDArray[np.int64],
    present: NDArray[np.int64],
    rules: NDArray[np.int64],
    x0: float,
    y0: float,
    size: float,
) -> float:
    """Filled part of a cell that holds too many pieces to resolve: the mean over `SCANLINES` lines."""
    windings = np.zeros(len(rules), np.int64)
    crossing_x, crossing = np.empty(len(path)), np.empty(len(path), np.int64)
    total = 0.0
    for line in range(SCANLINES):
        y = y0 + size * (line + 0.5) / SCANLINES
        for k in range(len(present)):
            windings[present[k, 0]] = present[k, 1]
        count = 0
        for i in range(len(path)):
            curve = points[i]
            for end, event in ((0, 1), (3, -1)):
                if curve[end, 0] == x0 and curve[end, 1] <= y:
                    windings[path[i]] += event
            if min(curve[0, 1], curve[3, 1]) <= y < max(curve[0, 1], curve[3, 1]):
                crossing_x[count], crossing[count] = x_at(curve, y), i
                count += 1
        paths_inside = 0
        for k in range(len(present)):
            paths_inside += 1 if inside(windings[present[k, 0]], rules[present[k, 0]]) else 0
        x = x0
        for k in sort_order(crossing_x, count):
            total += crossing_x[k] - x if paths_inside > 0 else 0.0
            x, i = crossing_x[k], crossing[k]
            p = path[i]
            paths_inside -= 1 if inside(windings[p], rules[p]) else 0
            windings[p] += -1 if points[i, 3, 1] > points[i, 0, 1] else 1
            paths_inside += 1 if inside(windings[p], rules[p]) else 0
        total += x0 + size - x if paths_inside > 0 else 0.0
    return total / (size * SCANLINES)
