"""Building a `Tree` from a drawing: cells are divided depth first until each is a leaf."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.monotone import monotone_pieces
from vexture.drawing import Drawing
from vexture.errors import LimitError, ParameterError, SourceError
from vexture.kernels import kernel
from vexture.layout import LATTICE, MOST_CURVES, MOST_DEPTH
from vexture.tolerance import CLOSED
from vexture.tree.cubics import gather
from vexture.tree.divide import PARTS, PiecePool, divide, new_pool, pool_with_room, with_room
from vexture.tree.leaf import DIVIDE, Leaf, Workspace, leaf_of, new_workspace
from vexture.tree.tree import MOST_QUADS, Tree
from vexture.tree.winding import child_windings, inside

__all__ = ["DEFAULT_CAPACITY", "DEFAULT_DEPTH", "build_tree", "check_whole", "largest_shift"]

DEFAULT_CAPACITY = 4
"""Pieces in a leaf."""

DEFAULT_DEPTH = 16
"""Depth limit. Cells of this depth are 1.5e-5 of the drawing wide."""

DISPLACEMENT = 2.0
"""Lattice units by which a curve may move: its points are rounded when it is cut, and again in its leaf."""

COINCIDENT = 0.25
"""Share of the largest shift within which the pieces of a crowded cell count as one. Rounding takes half of it."""

IS_QUAD, COUNT, WINDING, COVERAGE = range(4)
"""Columns of the cells while the tree grows."""

QUAD, DEPTH, FIRST, LAST, FIRST_PATH, LAST_PATH, PIECES = range(7)
"""Columns of the stack of cells to divide: quad, depth, lists of pieces and of paths, and pieces in the pool."""


class Arrays(NamedTuple):
    """The arrays of a `Tree`."""

    is_quad: NDArray[np.bool_]
    counts: NDArray[np.uint8]
    winding: NDArray[np.int8]
    first_quad: NDArray[np.int32]
    first_curve: NDArray[np.int32]
    coverage: NDArray[np.float64]
    curves: NDArray[np.int32]


QUADS, CURVES, UNRESOLVED, WAITING = range(4)
"""Counts while the tree grows: quads, curves, unresolved leaves, cells on the stack."""


class Growth(NamedTuple):
    """The tree while it grows; rows beyond the counts are free."""

    # (room, 4, 4): for each cell of each quad: whether a quad, count, corner winding, coverage
    cells: NDArray[np.float64]
    first: NDArray[np.int64]  # (room, 2): first quad below each quad, first curve of its leaves
    curves: NDArray[np.float64]  # (room, 4, 2), in lattice units


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

    stack: NDArray[np.int64]  # (room, 7): cells to divide
    corner: NDArray[np.float64]  # (room, 2): their bottom-left corners
    child_at: NDArray[np.int64]  # (5,): start of each child's list of pieces
    windings: NDArray[np.int64]  # (paths, 8): what `child_windings` writes
    deviation: NDArray[np.float64]  # (1,): largest distance of a leaf's outline from the drawing's
    leaf: Workspace


@kernel
def _room_for_quad(tree: Growth, quads: int, curves: int) -> Growth:
    """The tree, with room for all that one quad can hold."""
    cells, first = with_room(tree.cells, quads, 4), tree.first
    if len(first) < len(cells):
        first = np.empty((len(cells), 2), np.int64)
        for quad in range(quads):
            first[quad, 0], first[quad, 1] = tree.first[quad, 0], tree.first[quad, 1]
    return Growth(cells, first, with_room(tree.curves, curves, 4 * MOST_CURVES))


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


@kernel
def _paths_with_room(present: NDArray[np.int64], count: int, room: int) -> NDArray[np.int64]:
    """The list of paths, or a longer copy if it has not enough room."""
    if count + room <= len(present):
        return present
    out = np.empty((2 * len(present) + room, 2), np.int64)
    for k in range(count):
        out[k, 0], out[k, 1] = present[k, 0], present[k, 1]
    return out


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
def _grow_quad(
    pool: PiecePool,
    present: NDArray[np.int64],
    rules: NDArray[np.int64],
    bounds: Bounds,
    work: Work,
    tree: Growth,
    counts: NDArray[np.int64],
) -> None:
    """Divide the cell on top of the stack: each child becomes a leaf or is pushed onto the stack."""
    stack, corner, child_at, windings = work.stack, work.corner, work.child_at, work.windings
    cells, first_below = tree.cells, tree.first
    top = counts[WAITING] - 1
    quad, depth, first, last = stack[top, QUAD], stack[top, DEPTH], stack[top, FIRST], stack[top, LAST]
    first_path, last_path = stack[top, FIRST_PATH], stack[top, LAST_PATH]
    x0, y0, half = corner[top, 0], corner[top, 1], 0.5 ** (depth + 1)
    xm, ym = x0 + half, y0 + half
    grain = 0.5 ** max(depth + 1, bounds.least_depth) / LATTICE
    pieces = divide(pool, first, last, xm, ym, grain, stack[top, PIECES], child_at)
    child_windings(
        pool.points, pool.path, pool.numbers, child_at, present[first_path:last_path], x0, y0, xm, ym, windings
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
        if depth + 1 >= bounds.least_depth:
            paths, target = present[end_path:here], tree.curves[counts[CURVES] :]
            at_limit = depth + 1 == bounds.max_depth
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
            work.deviation[0] = max(work.deviation[0], leaf.distance)
    counts[WAITING] = top


@kernel
def _root(points: NDArray[np.float64], path: NDArray[np.int64]) -> tuple[NDArray[np.int64], float]:
    """Paths of the unit square with corner windings 0; move ends into the square, and return by how much at most."""
    paths = 0
    for i in range(len(path)):
        paths += 1 if i == 0 or path[i] != path[i - 1] else 0
    present, outside, k = np.zeros((paths, 2), np.int64), 0.0, -1
    for i in range(len(path)):
        if i == 0 or path[i] != path[i - 1]:
            k += 1
            present[k, 0] = path[i]
        for end in (0, 3):
            for axis in range(2):
                inner = min(max(points[i, end, axis], 0.0), 1.0)
                outside = max(outside, abs(points[i, end, axis] - inner))
                points[i, end, axis] = inner
    return present, outside


@kernel
def _typed(tree: Growth, quads: int, curves: int) -> Arrays:
    """The arrays of a `Tree`, in their final types."""
    out = Arrays(
        np.empty((quads, 4), np.bool_),
        np.empty((quads, 4), np.uint8),
        np.empty((quads, 4), np.int8),
        np.empty(quads, np.int32),
        np.empty(quads, np.int32),
        np.empty((quads, 4)),
        np.empty((curves, 4, 2), np.int32),
    )
    for quad in range(quads):
        out.first_quad[quad], out.first_curve[quad] = tree.first[quad, 0], tree.first[quad, 1]
        for k in range(4):
            out.is_quad[quad, k] = tree.cells[quad, k, IS_QUAD] == 1.0
            out.counts[quad, k], out.winding[quad, k] = tree.cells[quad, k, COUNT], tree.cells[quad, k, WINDING]
            out.coverage[quad, k] = tree.cells[quad, k, COVERAGE]
    for i in range(curves):
        for k in range(4):
            out.curves[i, k, 0], out.curves[i, k, 1] = tree.curves[i, k, 0], tree.curves[i, k, 1]
    return out


@kernel(ahead=True)
def grow(
    cubics: NDArray[np.float64], owner: NDArray[np.int64], rules: NDArray[np.int64], bounds: Bounds
) -> tuple[Arrays, float, int, float]:
    """Divide the unit square, depth first, until every cell is a leaf.

    Returns the arrays of the tree; its deviation; the number of unresolved leaves, or minus the number of quads so far
    if there are too many; and how far the outline lies outside the unit square.
    """
    pieces = monotone_pieces(cubics, owner)
    present, outside = _root(pieces.points, pieces.path)
    pool = new_pool(pieces.points, pieces.path)
    tree = Growth(np.empty((16, 4, 4)), np.empty((16, 2), np.int64), np.empty((4 * MOST_CURVES, 4, 2)))
    work = Work(
        np.empty((4 * bounds.max_depth + 4, 7), np.int64),
        np.zeros((4 * bounds.max_depth + 4, 2)),
        np.empty(5, np.int64),
        np.empty((len(present), 8), np.int64),
        np.zeros(1),
        new_workspace(len(present)),
    )
    counts = np.array([1, 0, 0, 1])
    for column, value in enumerate((0, 0, 0, len(pool.path), 0, len(present), len(pool.path))):
        work.stack[0, column] = value
    while counts[WAITING] > 0:
        top = counts[WAITING] - 1
        last, last_path = work.stack[top, LAST], work.stack[top, LAST_PATH]
        parts, paths = PARTS * (last - work.stack[top, FIRST]), 4 * (last_path - work.stack[top, FIRST_PATH])
        if work.stack[top, PIECES] + parts > len(pool.path) or last + parts > len(pool.numbers):
            pool = pool_with_room(pool, work.stack[top, PIECES], last, parts)
        if last_path + paths > len(present):
            present = _paths_with_room(present, last_path, paths)
        if counts[QUADS] + 4 > len(tree.first) or counts[CURVES] + 4 * MOST_CURVES > len(tree.curves):
            tree = _room_for_quad(tree, counts[QUADS], counts[CURVES])
        _grow_quad(pool, present, rules, bounds, work, tree, counts)
        if counts[QUADS] > bounds.most_quads:
            return _typed(tree, 0, 0), 0.0, -counts[QUADS], outside
    _mean_coverages(tree, counts[QUADS])
    return _typed(tree, counts[QUADS], counts[CURVES]), work.deviation[0], counts[UNRESOLVED], outside


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
    check_whole("max_depth", max_depth, MOST_DEPTH, DEFAULT_DEPTH)
    check_whole("capacity", capacity, MOST_CURVES, DEFAULT_CAPACITY)
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
    bounds = Bounds(capacity, float(tolerance), near, least_depth, max_depth, most_quads)
    arrays, deviation, unresolved, outside = grow(*gather(drawing), bounds)
    if not outside <= CLOSED:  # NaN counts as outside
        raise SourceError(f"{drawing.name}: a curve leaves the unit square by {outside:.3g}; clip or scale it first")
    if unresolved < 0:
        raise LimitError(
            f"{drawing.name}: {-unresolved} quads at least; the limit is {most_quads}; "
            "use a smaller `max_depth`, a larger `tolerance` or a larger `precision`"
        )
    return Tree(*arrays, deviation=deviation, unresolved=unresolved)
