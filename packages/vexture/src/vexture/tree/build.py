"""Building a `Tree` from a drawing: cells are divided depth first until each is a leaf."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.deadline import check_time
from vexture.base.errors import SourceError
from vexture.base.kernels import kernel
from vexture.base.layout import LATTICE, MOST_CURVES
from vexture.base.tolerance import CLOSED
from vexture.drawing.drawing import Drawing
from vexture.tree.bounds import DEFAULT_CAPACITY, DEFAULT_DEPTH, Bounds, bounds_of, check_growth
from vexture.tree.cubics import leave_out_copies, outlines_of
from vexture.tree.divide import CROWDED, PARTS, Cell, PiecePool, divide, holds_runs, list_all
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
    growth_from,
    has_room,
    tree_of,
    with_room,
)
from vexture.tree.leaf import DIVIDE, TreeLeaf, Workspace, leaf_of, new_workspace
from vexture.tree.parts import LARGE, PART, grow_parts, usual_threads
from vexture.tree.tree import MOST_QUADS, Tree
from vexture.tree.winding import child_windings, inside

SLICE = 300_000
"""Work between two checks of the clock, about 0.1 s. A cell that is divided costs its pieces and `CELL`."""

IN_RUNS = 1 << 14
"""Cubics. A smaller drawing gains nothing from runs, and cells that hold runs cannot be leaves, even if crowded with
copies."""

CELL = 20
"""Work of dividing a cell and making its leaves, besides the work for its pieces."""


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
    """Append the paths that have pieces in a child to the lists; return the new end, or -1 if another path fills it."""
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
    quad, depth = stack[top, QUAD], stack[top, DEPTH]
    first_path, last_path = stack[top, FIRST_PATH], stack[top, LAST_PATH]
    x0, y0, half = corner[top, 0], corner[top, 1], 0.5 ** (depth + 1)
    divided = Cell(x0, y0, 2.0 * half, stack[top, FIRST], stack[top, LAST])
    grain = 0.5 ** max(depth + 1, bounds.least_depth) / LATTICE
    at_limit = depth + 1 == bounds.max_depth
    pieces = divide(pool, divided, grain, stack[top, PIECES], at_limit, child_at)
    touching = present[first_path:last_path]
    lists = (pool.points, pool.path, pool.numbers, pool.runs)
    child_windings(lists, child_at, touching, x0, y0, half, counts[WHOLE], windings)
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
        x, y, first, last = x0 + half * (child & 1), y0 + half * (child >> 1), child_at[child], child_at[child + 1]
        leaf = TreeLeaf(DIVIDE, 0, 0.0, 0.0, True)
        if depth + 1 >= bounds.least_depth and not holds_runs(pool, first, last):
            cell, paths, target = Cell(x, y, half, first, last), present[end_path:here], tree.curves[counts[CURVES] :]
            leaf = leaf_of(pool, cell, paths, rules, bounds, at_limit, work.leaf, target)
        if leaf.size == DIVIDE:
            cells[quad, child, IS_QUAD] = 1.0
            stack[top, QUAD], stack[top, DEPTH], stack[top, FIRST] = counts[QUADS], depth + 1, first
            stack[top, LAST], stack[top, FIRST_PATH], stack[top, LAST_PATH] = last, end_path, here
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
    """Move ends of pieces into the unit square; return the largest move."""
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
    """Paths of the unit square, with corner windings 0 and room for more paths, and their number."""
    paths, before = 0, -1
    present = np.zeros((16, 2), np.int64)
    for counted in (True, False):
        if not counted:
            present = np.zeros((5 * paths + 64, 2), np.int64)
            paths, before = 0, -1
        for place in range(listed):
            i = pool.numbers[place]
            path = pool.path[i] if i >= 0 else pool.runs[-1 - i, 2]
            if path != before:
                if not counted:
                    present[paths, 0] = path
                paths, before = paths + 1, path
    return present, paths


@kernel(ahead=True, shares=True)
def grow_on(tree: Growth, rules: NDArray[np.int64], bounds: Bounds, most_work: int, aside: int) -> Growth:
    """Divide cells, depth first, until none waits, quads are too many or `most_work` is done; return the tree.

    Unless `aside` is 0, also stop before a cell whose list is no longer than `aside`. The given tree is no longer
    valid: some of its arrays may be those of the new one.
    """
    work = Work(np.empty(9, np.int64), np.empty((len(rules), 8), np.int64), new_workspace(len(rules)))
    stack, counts = tree.stack, tree.counts
    while counts[WAITING] > 0 and counts[QUADS] <= bounds.most_quads and most_work > 0:
        top = counts[WAITING] - 1
        listed = stack[top, LAST] - stack[top, FIRST]
        if aside > 0 and listed <= aside:
            return tree
        if not has_room(tree):
            tree = with_room(tree)
        most_work -= CELL + listed
        _grow_quad(tree, rules, bounds, work)
    if counts[WAITING] == 0:
        _mean_coverages(tree, counts[QUADS])
    return tree


@kernel(ahead=True)
def grow(
    cubics: NDArray[np.float64],
    lengths: NDArray[np.int64],
    path: NDArray[np.int64],
    rules: NDArray[np.int64],
    bounds: Bounds,
    most_work: int,
    aside: int,
) -> tuple[Growth, float]:
    """Divide the unit square as `grow_on` does; return the tree and how far the outline lies outside the square.

    The first four arguments are those of `Outlines`. The square stays undivided if the outline lies outside.
    """
    needed, owner = leave_out_copies(cubics, lengths, path, rules)
    tree, outside = new_growth(needed, owner, bounds.max_depth, len(needed) > IN_RUNS)
    if outside <= CLOSED:
        tree = grow_on(tree, rules, bounds, most_work, aside)
    return tree, outside


@kernel
def new_growth(
    cubics: NDArray[np.float64], owner: NDArray[np.int64], max_depth: int, in_runs: bool
) -> tuple[Growth, float]:
    """Make the undivided unit square with the pieces of cubics; also return how far the outline lies outside it."""
    n = len(cubics)
    room = (PARTS + 2) * n + 64
    rows = n if in_runs and n > CROWDED else 0
    boxes, spans = np.empty((rows, 4)), np.empty((rows, 3), np.int64)
    points, path = np.empty((room, 4, 2)), np.empty(room, np.int64)
    numbers, child, part = np.empty(room, np.int64), np.empty(room, np.int64), np.empty(room, np.int64)
    listed, pieces, runs = list_all(PiecePool(points, path, numbers, child, part, boxes, spans, cubics), owner)
    read = cubics if runs > 0 else cubics[:0]  # the caller must keep what runs are read from
    pool = PiecePool(points, path, numbers, child, part, boxes[:runs], spans[:runs], read)
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
        np.empty((4 * n + 8 * MOST_CURVES, 4, 2), np.int32),
        np.array([1, 0, 0, 1, pieces]),
        np.zeros(1),
        np.zeros(5, np.int64),
    ), outside


def build_tree(
    drawing: Drawing,
    *,
    tolerance: float = 0.0,
    max_depth: int = DEFAULT_DEPTH,
    capacity: int = DEFAULT_CAPACITY,
    precision: float | None = None,
    most_quads: int = MOST_QUADS,
    threads: int | None = None,
) -> Tree:
    """Quad-tree of a drawing's silhouette. Parameters and errors as in `vexture.convert`.

    Lengths are in unit-square units. `tolerance` bounds the distance between the drawing's outline and a leaf's before
    quantisation, within which chains of pieces become one cubic; 0 keeps every piece. The unit square has depth 0. A
    leaf holds more pieces than `capacity` (up to 15) only at the depth limit, or where all of them meet at one point.
    `precision` bounds the displacement by quantisation: leaves with curves are made small enough for it; None forces no
    depth. Large drawings are built by `threads` threads, by default one for each processor; the tree does not depend
    on their number. A tree of more than `most_quads` raises a `LimitError`, a curve outside the unit square a
    `SourceError`.

    Examples
    --------
    >>> tree = build_tree(Drawing.polygon([(0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.2, 0.8)]))
    >>> len(tree.count), len(tree.curves), round(float(tree.coverage[0].mean()), 4)
    (1, 6, 0.36)
    """
    bounds = bounds_of(tolerance, max_depth, capacity, precision, most_quads)
    outlines = outlines_of(drawing)
    check_time(drawing.name)
    aside = PART if len(outlines.cubics) > LARGE else 0
    grown, outside = grow(*outlines, bounds, SLICE, aside)
    if not outside <= CLOSED:  # NaN counts as outside
        raise SourceError(f"{drawing.name}: a curve leaves the unit square by {outside:.3g}; clip or scale it first")

    def check(quads: int) -> None:
        check_growth(quads, most_quads, drawing.name)

    def step(tree: Growth, aside: int) -> Growth:
        check(int(tree.counts[QUADS]))
        return growth_from(grow_on(tree, outlines.rules, bounds, SLICE, aside))

    tree = growth_from(grown)
    if aside:
        return tree_of(grow_parts(tree, step, usual_threads() if threads is None else threads, check))
    while tree.counts[WAITING] > 0:
        tree = step(tree, 0)
    return tree_of(tree)
