"""Building a `Tree` from a drawing: cells are divided depth first until each is a leaf."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.deadline import check_time
from vexture.drawing import Drawing
from vexture.errors import LimitError, ParameterError, SourceError
from vexture.kernels import kernel
from vexture.layout import LATTICE, MOST_CURVES, MOST_DEPTH
from vexture.tolerance import CLOSED
from vexture.tree.cubics import gather
from vexture.tree.divide import CROWDED, PARTS, RUN, PiecePool, divide, holds_runs, list_all
from vexture.tree.growth import (
    COUNT,
    COVERAGE,
    CURVES,
    DEPTH,
    FIRST,
    FIRST_PATH,
    IS_QUAD,
    LAST,
    LAST_PATH,
    PIECES,
    QUAD,
    QUADS,
    UNRESOLVED,
    WAITING,
    WHOLE,
    WINDING,
    Growth,
    has_room,
    tree_of,
    with_needed_room,
)
from vexture.tree.leaf import DIVIDE, Leaf, Workspace, leaf_of, new_workspace
from vexture.tree.tree import MOST_QUADS, Tree
from vexture.tree.winding import child_windings, inside

__all__ = [
    "CELL",
    "DEFAULT_CAPACITY",
    "DEFAULT_DEPTH",
    "SLICE",
    "Bounds",
    "bounds_of",
    "build_tree",
    "check_growth",
    "check_whole",
    "grow",
    "grow_on",
    "largest_shift",
    "new_growth",
    "root_paths",
]

DEFAULT_CAPACITY = 8
"""Pieces in a leaf."""

DEFAULT_DEPTH = 16
"""Depth limit. Cells of this depth are 1.5e-5 of the drawing wide."""

DISPLACEMENT = 2.0
"""Lattice units by which a curve may move: its points are rounded when it is cut, and again in its leaf."""

COINCIDENT = 0.25
"""Share of the largest shift within which the pieces of a crowded cell count as one. Rounding takes half of it."""

SLICE = 300_000
"""Work between two looks at the clock, some 0.1 s: pieces in the cells that are divided, and `CELL` for each cell."""

CELL = 20
"""Work of dividing a cell without pieces, and of its leaves."""


class Bounds(NamedTuple):
    """Limits of a tree."""

    capacity: int  # pieces in a leaf
    tolerance: float  # unit-square units
    near: float  # unit-square units within which pieces of a crowded cell are one
    least_depth: int  # depth of the largest leaf with pieces
    max_depth: int
    most_quads: int


class Work(NamedTuple):
    """Arrays that are reused from cell to cell."""

    child_at: NDArray[np.int64]  # (9,): start of each child's list of pieces; see `divide`
    windings: NDArray[np.int64]  # (paths, 8): what `child_windings` writes
    leaf: Workspace


@kernel(allocates=False)
def _child_paths(
    present: NDArray[np.int64],
    first: int,
    last: int,
    child: int,
    windings: NDArray[np.int64],
    rules: NDArray[np.int64],
    end: int,
) -> int:
    """Append the paths that have pieces in a child; return the new end, or -1 if another path fills the child."""
    for k in range(last - first):
        path = present[first + k, 0]
        if windings[k, 4 + child]:
            present[end, 0], present[end, 1] = path, windings[k, child]
            end += 1
        elif inside(windings[k, child], rules[path]):
            return -1
    return end


@kernel(allocates=False)
def _mean_coverages(tree: Growth, quads: int) -> None:
    """Give each divided cell the mean coverage of its quad; a quad comes after the quad that holds it."""
    for quad in range(quads - 1, -1, -1):
        below = tree.first[quad, 0]
        for k in range(4):
            if tree.cells[quad, k, IS_QUAD] == 1.0:
                total = 0.0
                for cell in range(4):
                    total += tree.cells[below, cell, COVERAGE]
                tree.cells[quad, k, COVERAGE] = 0.25 * total
                below += 1


@kernel(allocates=False)
def _grow_quad(tree: Growth, rules: NDArray[np.int64], bounds: Bounds, work: Work) -> None:
    """Divide the cell on top of the stack: each child becomes a leaf or is pushed onto the stack."""
    pool, present, stack, corner, counts = tree.pool, tree.present, tree.stack, tree.corner, tree.counts
    child_at, windings, cells, first_below = work.child_at, work.windings, tree.cells, tree.first
    top = counts[WAITING] - 1
    quad, depth, first, last = stack[top, QUAD], stack[top, DEPTH], stack[top, FIRST], stack[top, LAST]
    first_path, last_path = stack[top, FIRST_PATH], stack[top, LAST_PATH]
    x0, y0, half = corner[top, 0], corner[top, 1], 0.5 ** (depth + 1)
    xm, ym = x0 + half, y0 + half
    grain = 0.5 ** max(depth + 1, bounds.least_depth) / LATTICE
    at_limit = depth + 1 == bounds.max_depth
    pieces = divide(pool, first, last, xm, ym, grain, stack[top, PIECES], at_limit, child_at)
    touching = present[first_path:last_path]
    child_windings(
        pool.points,
        pool.path,
        pool.numbers,
        pool.owner,
        child_at,
        touching,
        x0,
        y0,
        xm,
        ym,
        counts[WHOLE],
        windings,
    )
    first_below[quad, 0], first_below[quad, 1] = counts[QUADS], counts[CURVES]
    end_path = last_path
    for child in range(4):
        for column in range(4):
            cells[quad, child, column] = 0.0
        here = _child_paths(present, first_path, last_path, child, windings, rules, end_path)
        if here < 0:
            cells[quad, child, COVERAGE] = 1.0
        if here < 0 or child_at[child] == child_at[child + 1]:
            continue
        x, y, end = x0 + half * (child & 1), y0 + half * (child >> 1), child_at[child + 1]
        leaf = Leaf(DIVIDE, 0, 0.0, 0.0, True)
        if depth + 1 >= bounds.least_depth and not holds_runs(pool, child_at[child], end):
            paths, target = present[end_path:here], tree.curves[counts[CURVES] :]
            leaf = leaf_of(
                pool,
                child_at[child],
                end,
                paths,
                rules,
                x,
                y,
                half,
                bounds.capacity,
                bounds.tolerance,
                bounds.near,
                at_limit,
                work.leaf,
                target,
            )
        if leaf.size == DIVIDE:
            cells[quad, child, IS_QUAD] = 1.0
            stack[top, QUAD], stack[top, DEPTH], stack[top, FIRST] = counts[QUADS], depth + 1, child_at[child]
            stack[top, LAST], stack[top, FIRST_PATH], stack[top, LAST_PATH] = end, end_path, here
            stack[top, PIECES], corner[top, 0], corner[top, 1] = pieces, x, y
            top, end_path = top + 1, here
            counts[QUADS] += 1
        else:
            cells[quad, child, COUNT], cells[quad, child, WINDING] = leaf.size, leaf.winding
            cells[quad, child, COVERAGE] = leaf.coverage
            counts[CURVES] += leaf.size
            counts[UNRESOLVED] += 0 if leaf.resolved else 1
            tree.deviation[0] = max(tree.deviation[0], leaf.distance)
    counts[WAITING] = top


@kernel
def _into_square(points: NDArray[np.float64]) -> float:
    """Move ends of pieces into the unit square, and return by how much at most."""
    outside = 0.0
    for i in range(len(points)):
        for end in (0, 3):
            for axis in range(2):
                inner = min(max(points[i, end, axis], 0.0), 1.0)
                outside = max(outside, abs(points[i, end, axis] - inner))
                points[i, end, axis] = inner
    return outside


@kernel
def root_paths(pool: PiecePool, listed: int) -> tuple[NDArray[np.int64], int]:
    """Paths of the unit square with corner windings 0, with room for more, and their number."""
    paths, before = 0, -1
    present = np.zeros((16, 2), np.int64)
    for counted in (True, False):
        if not counted:
            present = np.zeros((5 * paths + 64, 2), np.int64)
            paths, before = 0, -1
        for place in range(listed):
            i = pool.numbers[place]
            path = pool.path[i] if i >= 0 else pool.owner[RUN * (-1 - i)]
            if path != before:
                if not counted:
                    present[paths, 0] = path
                paths, before = paths + 1, path
    return present, paths


@kernel(ahead=True)
def grow_on(tree: Growth, rules: NDArray[np.int64], bounds: Bounds, most_work: int) -> None:
    """Divide cells, depth first, until none waits, quads are too many, an array lacks room or `most_work` is done."""
    work = Work(np.empty(9, np.int64), np.empty((len(rules), 8), np.int64), new_workspace(len(rules)))
    stack, counts = tree.stack, tree.counts
    while counts[WAITING] > 0 and counts[QUADS] <= bounds.most_quads and most_work > 0 and has_room(tree):
        top = counts[WAITING] - 1
        most_work -= CELL + stack[top, LAST] - stack[top, FIRST]
        _grow_quad(tree, rules, bounds, work)
    if counts[WAITING] == 0:
        _mean_coverages(tree, counts[QUADS])


@kernel(ahead=True)
def grow(
    cubics: NDArray[np.float64], owner: NDArray[np.int64], rules: NDArray[np.int64], bounds: Bounds, most_work: int
) -> tuple[Growth, float]:
    """Divide the unit square as `grow_on` does; also returns how far the outline lies outside the unit square."""
    tree, outside = new_growth(cubics, owner, bounds.max_depth, True)
    grow_on(tree, rules, bounds, most_work)
    return tree, outside


@kernel
def new_growth(
    cubics: NDArray[np.float64], owner: NDArray[np.int64], max_depth: int, in_runs: bool
) -> tuple[Growth, float]:
    """The unit square with the pieces of cubics, to be divided, and how far the outline lies outside it."""
    n = len(cubics)
    room = (PARTS + 2) * n + 64
    runs = n // RUN if in_runs and n > CROWDED else 0
    pool = PiecePool(
        np.empty((room, 4, 2)),
        np.empty(room, np.int64),
        np.empty(room, np.int64),
        np.empty(room, np.int64),
        np.empty(room, np.int64),
        np.empty((runs, 4)),
        cubics,
        owner,
    )
    listed, pieces = list_all(pool)
    outside = _into_square(pool.points[:pieces])
    present, paths = root_paths(pool, listed)
    cells = 4 * max_depth + 4
    stack = np.zeros((cells, 7), np.int64)
    stack[0, LAST], stack[0, LAST_PATH], stack[0, PIECES] = listed, paths, pieces
    return Growth(
        pool,
        present,
        stack,
        np.zeros((cells, 2)),
        np.empty((n + 16, 4, 4)),
        np.empty((n + 16, 2), np.int64),
        np.empty((4 * n + 8 * MOST_CURVES, 4, 2)),
        np.array([1, 0, 0, 1, pieces]),
        np.zeros(1),
        np.empty(5, np.int64),
    ), outside


def largest_shift(precision: float | None) -> float:
    """Largest shift of an outline by rounding, in unit-square units, at a `precision` of `build_tree`.

    Examples
    --------
    >>> largest_shift(1e-7), round(largest_shift(None), 7)
    (1e-07, 3.05e-05)
    """
    return 0.5 * DISPLACEMENT / LATTICE if precision is None else precision


def check_whole(name: str, value: object, most: int, default: int) -> None:
    """Raise a `ParameterError` unless a parameter is a whole number in 1..`most`."""
    if isinstance(value, bool) or not (isinstance(value, int | np.integer) and 1 <= value <= most):
        raise ParameterError(f"`{name}` {value!r} is no whole number in 1..{most}; the default is {default}")


def _is_number(value: object) -> bool:
    return isinstance(value, float | int | np.number) and not isinstance(value, bool)


def bounds_of(
    tolerance: float,
    max_depth: int,
    capacity: int,
    precision: float | None,
    most_quads: int,
    default_capacity: int = DEFAULT_CAPACITY,
) -> Bounds:
    """Bounds of a tree from the parameters of `build_tree`; raises a `ParameterError` if one is out of range."""
    check_whole("max_depth", max_depth, MOST_DEPTH, DEFAULT_DEPTH)
    check_whole("capacity", capacity, MOST_CURVES, default_capacity)
    finest = DISPLACEMENT * 0.5**max_depth / LATTICE
    if not (precision is None or (_is_number(precision) and finest <= precision <= 1.0)):
        raise ParameterError(
            f"`precision` {precision!r} is no number in {finest:.1e}..1 (unit-square units), at `max_depth` "
            f"{max_depth}; leave it out for views up to 1,000 times, or give 1e-7 for 10,000"
        )
    least_depth = 1 if precision is None else max(math.ceil(math.log2(DISPLACEMENT / (precision * LATTICE))), 1)
    if not (_is_number(tolerance) and 0.0 <= tolerance < 1.0):
        raise ParameterError(
            f"`tolerance` {tolerance!r} is no number from 0 to below 1 (unit-square units); 0 keeps every piece"
        )
    near = COINCIDENT * largest_shift(precision)
    return Bounds(capacity, float(tolerance), near, least_depth, max_depth, most_quads)


def check_growth(tree: Growth, most_quads: int, name: str) -> None:
    """Raise a `LimitError` if a tree has too many quads or has taken too long."""
    if tree.counts[QUADS] > most_quads:
        raise LimitError(
            f"{name}: {tree.counts[QUADS]} quads at least; the limit is {most_quads}; "
            "use a smaller `max_depth`, a larger `tolerance` or a larger `precision`"
        )
    check_time(name)


def build_tree(
    drawing: Drawing,
    *,
    tolerance: float = 0.0,
    max_depth: int = DEFAULT_DEPTH,
    capacity: int = DEFAULT_CAPACITY,
    precision: float | None = None,
    most_quads: int = MOST_QUADS,
) -> Tree:
    """Quad-tree of a drawing's silhouette. Parameters and errors as in `vexture.convert`.

    Lengths are in unit-square units. `tolerance` bounds the distance between the drawing's outline and a leaf's before
    quantisation, within which chains of pieces become one cubic; 0 keeps every piece. The unit square has depth 0. A
    leaf holds more pieces than `capacity` (up to 15) only at the depth limit, or where all of them meet at one point.
    `precision` bounds the displacement by quantisation: leaves with curves are made small enough for it; None forces no
    depth. A tree of more than `most_quads` raises a `LimitError`, a curve outside the unit square a `SourceError`.

    Examples
    --------
    >>> tree = build_tree(Drawing.polygon([(0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.2, 0.8)]))
    >>> len(tree.count), len(tree.curves), round(float(tree.coverage[0].mean()), 4)
    (1, 6, 0.36)
    """
    bounds = bounds_of(tolerance, max_depth, capacity, precision, most_quads)
    cubics, owner, rules = gather(drawing)
    check_time(drawing.name)
    arrays, outside = grow(cubics, owner, rules, bounds, SLICE)
    if not outside <= CLOSED:  # NaN counts as outside
        raise SourceError(f"{drawing.name}: a curve leaves the unit square by {outside:.3g}; clip or scale it first")
    tree = Growth(*arrays)
    while tree.counts[WAITING] > 0:
        check_growth(tree, most_quads, drawing.name)
        tree = with_needed_room(tree)
        grow_on(tree, rules, bounds, SLICE)
    return tree_of(tree)
