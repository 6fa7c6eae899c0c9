"""Which boundary counts: fill rules, overlaps and crossings, resolved inside one candidate leaf.

The pieces of all paths in a cell are quantised to the leaf's integer lattice, so that every comparison of y is
exact. Horizontal *slabs* are cut at each end point's and each crossing's y. In a slab nothing crosses: one sweep
from the left edge, with prefix sums of the paths' windings, tells which pieces separate inside from outside. No
winding is ever evaluated geometrically, so a wrong order of two near-coincident curves costs area, never parity.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.kernels import kernel
from vexture.layout import LATTICE
from vexture.tree.crossings import crossing_heights, x_at
from vexture.tree.order import sort_order
from vexture.tree.winding import inside

__all__ = ["HOPELESS", "Boundary", "cell_paths", "crowded_area", "quantise", "quantise_piece", "resolve"]

NEAR = 1.0
"""Lattice units: curves that stay closer than this are one boundary."""


HOPELESS = 160
"""Pieces in a cell above which it is not resolved at all: resolving looks at every pair."""


class Boundary(NamedTuple):
    """The resolved boundary in a leaf.

    Attributes
    ----------
    heights : (slabs + 1,) float64 array
        Lattice y of the slabs' borders.
    left : (slabs,) int64 array
        1 where the leaf is inside at its left edge.
    run_piece : (runs,) int64 array
        The piece that each run is a part of.
    run_role : (runs,) int64 array
        1 where the right side of the run is inside, -1 where the left side is.
    run_y : (runs, 2) float64 array
        Lattice y of the run's lower and upper end.
    """

    heights: NDArray[np.float64]
    left: NDArray[np.int64]
    run_piece: NDArray[np.int64]
    run_role: NDArray[np.int64]
    run_y: NDArray[np.float64]


@kernel
def quantise(points: NDArray[np.float64], x0: float, y0: float, size: float) -> NDArray[np.float64]:
    """Pieces of a cell, (n, 4, 2), on its lattice: ends are integers, inner control points move along with them.

    A point on the left edge stays on it and no other point may come to lie there: the rule of windings counts
    ends on that edge.
    """
    out = np.empty((len(points), 4, 2))
    for i in range(len(points)):
        quantise_piece(points[i], x0, y0, size, out[i])
    return out


@kernel(allocates=False)
def quantise_piece(points: NDArray[np.float64], x0: float, y0: float, size: float, out: NDArray[np.float64]) -> None:
    """Write one piece, (4, 2), on its cell's lattice; see `quantise`."""
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


@kernel
def _slab_heights(curves: NDArray[np.float64]) -> NDArray[np.float64]:
    """Heights of the slabs' borders: the leaf's own, every end's, every crossing's; sorted, each once."""
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
def _order_slab(
    curves: NDArray[np.float64], low: float, high: float, active: NDArray[np.int64], x: NDArray[np.float64]
) -> int:
    """Order the pieces that span a slab by x; return how many.

    Written are their numbers to `active` and their x at the three inner heights to `x`, by number. By the middle
    height alone where that is clear; by the sum of the three where neighbours are close.
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
def _coincide(x: NDArray[np.float64], i: int, j: int, height: float) -> bool:
    """Whether two pieces of a slab are one boundary: nearer than a unit, measured across them, at three heights."""
    if x[i, 0] == np.inf:
        return False
    lean = max(abs(x[i, 2] - x[i, 0]), abs(x[j, 2] - x[j, 0])) / (0.7 * height)
    for k in range(3):
        if abs(x[i, k] - x[j, k]) > NEAR * (1.0 + lean):
            return False
    return True


@kernel
def _roles_in_slab(
    curves: NDArray[np.float64],
    owner: NDArray[np.int64],
    windings: NDArray[np.int64],
    rules: NDArray[np.int64],
    active: NDArray[np.int64],
    count: int,
    x: NDArray[np.float64],
    height: float,
    previous: NDArray[np.int64],
    role: NDArray[np.int64],
) -> int:
    """Sweep a slab from the left: set the role of each piece in it; return whether its left edge is inside.

    Neighbours that coincide form a group of which only inside-before and inside-after count: equal, all go;
    different, one stays, preferably one that had that role in the slab below, else the one that reaches highest.
    """
    w = np.empty(len(windings), np.int64)
    paths_inside = 0
    for p in range(len(w)):
        w[p] = windings[p]
        paths_inside += 1 if inside(w[p], rules[p]) else 0
    left = 1 if paths_inside > 0 else 0
    first = 0
    while first < count:
        before = paths_inside > 0
        last = first
        while last < count and (last == first or _coincide(x, active[first], active[last], height)):
            i = active[last]
            p = owner[i]
            paths_inside -= 1 if inside(w[p], rules[p]) else 0
            w[p] += -1 if curves[i, 3, 1] > curves[i, 0, 1] else 1
            paths_inside += 1 if inside(w[p], rules[p]) else 0
            last += 1
        if before != (paths_inside > 0):
            wanted = -1 if before else 1
            best, best_reach = -1, -1.0
            for k in range(first, last):
                i = active[k]
                reach = max(curves[i, 0, 1], curves[i, 3, 1]) + (2.0 * LATTICE if previous[i] == wanted else 0.0)
                if reach > best_reach:
                    best, best_reach = i, reach
            role[best] = wanted
        first = last
    return left


@kernel
def resolve(
    curves: NDArray[np.float64], owner: NDArray[np.int64], corner: NDArray[np.int64], rules: NDArray[np.int64]
) -> Boundary:
    """Boundary of the union of all paths in a leaf.

    Parameters
    ----------
    curves : (n, 4, 2) float64 array
        Pieces on the leaf's lattice (`quantise`).
    owner : (n,) int64 array
        The path of each, as an index into `corner` and `rules`.
    corner : (paths,) int64 array
        Corner windings.
    rules : (paths,) int64 array
        `FillRule` of each path.
    """
    heights = _slab_heights(curves)
    slabs, count = len(heights) - 1, len(curves)
    left = np.zeros(slabs, np.int64)
    run_piece, run_role = np.empty(count * slabs, np.int64), np.empty(count * slabs, np.int64)
    run_y = np.empty((count * slabs, 2))
    role, previous = np.zeros(count, np.int64), np.zeros(count, np.int64)
    since = np.zeros(count)
    windings = np.empty(len(corner), np.int64)
    for p in range(len(corner)):
        windings[p] = corner[p]
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
                        windings[owner[i]] += event
            high = heights[slab + 1]
            spanning = _order_slab(curves, low, high, active, x)
            left[slab] = _roles_in_slab(curves, owner, windings, rules, active, spanning, x, high - low, previous, role)
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
    """Write the paths of a cell, numbered from 0: the one of each piece, their corner windings, their fill rules.

    Parameters
    ----------
    path : (n,) int64 array
        The path of each piece, in the order of `present`.
    present : (n, 2) int64 array
        The paths in the cell and their corner windings.
    rules : (paths,) int64 array
        `FillRule` of each path of the drawing.
    owner, corner, cell_rules : int64 arrays
        Written.
    """
    k = 0
    for i in range(len(path)):
        while present[k, 0] != path[i]:
            k += 1
        owner[i] = k
    for k in range(len(present)):
        corner[k], cell_rules[k] = present[k, 1], rules[present[k, 0]]


SCANLINES = 64
"""Heights at which a cell with too many pieces to resolve is measured."""


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
    """Filled part of a cell that holds too many pieces to resolve: the mean over scanlines.

    Parameters
    ----------
    points : (n, 4, 2) float64 array
        The cell's pieces.
    path : (n,) int64 array
        The path of each.
    present : (m, 2) int64 array
        The paths in it and their corner windings.
    rules : (paths,) int64 array
        `FillRule` of each path of the drawing.
    x0, y0, size : float
        The cell.
    """
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
