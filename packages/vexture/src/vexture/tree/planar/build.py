"""Building a `PlanarMap` from a drawing: cells are divided depth first until each is a leaf.

A cell has a list of the paths whose outlines pass through it, with their winding numbers at its corner. An opaque path
that covers the cell hides all paths below it, and their pieces. A path that covers the cell and lies below all listed
paths becomes part of the cell's *ground*, the face on which the listed paths are painted. So a small cell has a short
list even under hundreds of layers.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.deadline import check_time
from vexture.base.errors import LimitError, SourceError
from vexture.base.kernels import kernel
from vexture.base.layout import LATTICE, MOST_PAINTS
from vexture.base.tolerance import CLOSED
from vexture.drawing.drawing import Drawing
from vexture.drawing.unit_square import FARTHEST
from vexture.tree.bounds import DEFAULT_DEPTH, Bounds, bounds_of, check_growth
from vexture.tree.build import CELL, SLICE, new_growth
from vexture.tree.divide import PARTS, Cell, divide
from vexture.tree.growth import (
    COUNT,
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
    has_room,
)
from vexture.tree.leaf import DIVIDE
from vexture.tree.parts import LARGE, usual_threads
from vexture.tree.planar.borders import key_of
from vexture.tree.planar.faces import FIRST_ROOM, CellFaces, FaceTable, face_of, new_faces, roomier_faces
from vexture.tree.planar.growth import (
    BASE,
    IS_MEAN,
    PlanarGrowth,
    State,
    planar_growth_from,
    state_from,
    with_map_room,
)
from vexture.tree.planar.layers import PlanarLayers, layers_of
from vexture.tree.planar.leaf import PlanarLeaf, PlanarWorkspace, new_workspace, planar_leaf
from vexture.tree.planar.map import PlanarMap, arrange_map, map_arrays_from, texels_of
from vexture.tree.planar.means import add_programs, set_flat_mean
from vexture.tree.planar.parts import grow_map_parts
from vexture.tree.planar.rows import rows_of
from vexture.tree.planar.source import MapSource, source_of
from vexture.tree.tree import MOST_QUADS
from vexture.tree.winding import child_windings, inside


class PlanarWork(NamedTuple):
    """Arrays that are reused from cell to cell."""

    counts: NDArray[np.int64]  # (5,): counts of the map before a cell is divided
    row: NDArray[np.int64]  # (7,): the cell's row of the stack
    child_at: NDArray[np.int64]  # (9,): start of each child's list of pieces; see `divide`
    windings: NDArray[np.int64]  # (paths, 8): what `child_windings` writes
    leaf: PlanarWorkspace


MOST_WORDS: Final = 1 << 40
"""More texels than any map has, where their number is not limited."""

DEFAULT_MAP_CAPACITY = 12
"""Pieces in a leaf of a map, in which more cells cut a border than in a silhouette. With 14, maps take 4 to 7 % fewer
texels, and a pixel reads about one more."""


@kernel(allocates=False)
def _child_paths(
    growth: PlanarGrowth,
    rows: tuple[int, int],
    child: int,
    windings: NDArray[np.int64],
    layers: PlanarLayers,
    faces: FaceTable,
    ground: int,
    end: int,
) -> tuple[int, int]:
    """Append the paths of a child to the lists, with their windings; return the new end and the child's ground.

    `rows` are the parent's first and last place in the lists, and `ground` is its ground.
    """
    present, here, folding = growth.tree.present, end, True
    for k in range(rows[1] - rows[0]):
        path, winding = present[rows[0] + k, 0], windings[k, child]
        changes = windings[k, 4 + child] != 0
        if not changes and not inside(winding, layers.rules[path]):
            continue
        alone = not changes and layers.group[path] < 0
        if layers.covers[path] and not changes:
            layers.hides[path] |= here > end or ground != 0
            here, ground, folding = end, 0, True
        if alone and folding:
            present[here, 0], present[here, 1] = path, winding
            one = present[here : here + 1]
            ground = face_of(faces, layers, ground, one, one[:, 1], layers.keys[path])
            continue
        folding = False
        present[here, 0], present[here, 1] = path, winding
        here += 1
    return here, ground


@kernel(allocates=False)
def _grow_quad(
    growth: PlanarGrowth,
    layers: PlanarLayers,
    faces: FaceTable,
    bounds: Bounds,
    work: PlanarWork,
) -> None:
    """Divide the cell on top of the stack: each child becomes a leaf or is pushed onto the stack.

    If the table of faces has no room, nothing is changed.
    """
    tree = growth.tree
    pool, present, stack, corner, counts = tree.pool, tree.present, tree.stack, tree.corner, tree.counts
    top = counts[WAITING] - 1
    before, row, child_at, windings = work.counts, work.row, work.child_at, work.windings
    x0, y0 = corner[top, 0], corner[top, 1]
    for k in range(len(before)):
        before[k] = counts[k]
    for k in range(len(row)):
        row[k] = stack[top, k]
    quad, depth, under = row[QUAD], row[DEPTH], growth.ground[top]
    rows, half = (row[FIRST_PATH], row[LAST_PATH]), 0.5 ** (row[DEPTH] + 1)
    divided = Cell(x0, y0, 2.0 * half, row[FIRST], row[LAST])
    grain = 0.5 ** max(depth + 1, bounds.least_depth) / LATTICE
    pieces = divide(pool, divided, grain, row[PIECES], False, child_at)
    touching = present[rows[0] : rows[1]]
    lists = (pool.points, pool.path, pool.numbers, pool.runs)
    child_windings(lists, child_at, touching, x0, y0, half, counts[WHOLE], windings)
    tree.first[quad, 0], tree.first[quad, 1] = counts[QUADS], counts[CURVES]
    end_path = rows[1]
    for child in range(4):
        here, ground = _child_paths(growth, rows, child, windings, layers, faces, under, end_path)
        first, last = child_at[child], child_at[child + 1]
        while first < last and (here == end_path or pool.path[pool.numbers[first]] < present[end_path, 0]):
            first += 1  # hidden by a path above
        cell = Cell(x0 + half * (child & 1), y0 + half * (child >> 1), half, first, last)
        cell_faces = CellFaces(faces, layers, ground, present[end_path:here], work.leaf.windings)
        leaf = _leaf(growth, cell, quad, child, cell_faces, depth + 1, bounds, work.leaf)
        if leaf.size == DIVIDE:
            stack[top, QUAD], stack[top, DEPTH], stack[top, FIRST] = counts[QUADS], depth + 1, first
            stack[top, LAST], stack[top, FIRST_PATH], stack[top, LAST_PATH] = last, end_path, here
            stack[top, PIECES], corner[top, 0], corner[top, 1] = pieces, cell.x, cell.y
            growth.ground[top] = ground
            top, end_path = top + 1, here
            counts[QUADS] += 1
    counts[WAITING] = top
    if faces.counts[1] != 0:
        top = before[WAITING] - 1
        for k in range(len(before)):
            counts[k] = before[k]
        for k in range(len(row)):
            stack[top, k] = row[k]
        corner[top, 0], corner[top, 1], growth.ground[top] = x0, y0, under


@kernel(allocates=False)
def _leaf(
    growth: PlanarGrowth,
    cell: Cell,
    quad: int,
    child: int,
    cell_faces: CellFaces,
    depth: int,
    bounds: Bounds,
    workspace: PlanarWorkspace,
) -> PlanarLeaf:
    """Write a cell of a quad and, if it is a leaf, the pieces of the leaf."""
    tree, mean = growth.tree, growth.mean[quad, child]
    if cell.first == cell.last:
        faces, layers, ground, present, _ = cell_faces
        face = face_of(faces, layers, ground, present, present[:, 1], key_of(layers, present, present[:, 1]))
        leaf = PlanarLeaf(0, faces.paint[face], 0.0, True)
        if set_flat_mean(workspace.pieces, 0, leaf.base, faces, mean):
            add_programs(workspace.pieces, 0, leaf.base, cell, layers, faces, mean)
    elif depth < bounds.least_depth:
        leaf = PlanarLeaf(DIVIDE, 0, 0.0, True)
    else:
        leaf = planar_leaf(tree.pool, cell, cell_faces, bounds, depth == bounds.max_depth, workspace, mean)
    out = tree.cells[quad, child]
    out[IS_QUAD], out[COUNT], out[BASE], out[IS_MEAN] = 0.0, 0.0, 0.0, 0.0
    if leaf.size == DIVIDE:
        out[IS_QUAD] = 1.0
        return leaf
    out[COUNT], out[BASE], out[IS_MEAN] = leaf.size, leaf.base, 0.0 if leaf.resolved else 1.0
    for k in range(leaf.size):
        at = tree.counts[CURVES] + k
        for point in range(4):
            for axis in range(2):
                tree.curves[at, point, axis] = workspace.pieces.curves[k, point, axis]
        for side in range(2):
            growth.sides[at, side] = workspace.pieces.sides[k, side]
    tree.counts[CURVES] += leaf.size
    tree.deviation[0] = max(tree.deviation[0], leaf.distance)
    tree.counts[UNRESOLVED] += 0 if leaf.resolved else 1
    return leaf


@kernel(allocates=False)
def _means(growth: PlanarGrowth) -> None:
    """Give each divided cell the mean colour of its quad; a quad comes after the quad that holds it."""
    tree, mean = growth.tree, growth.mean
    for quad in range(tree.counts[QUADS] - 1, -1, -1):
        below = tree.first[quad, 0]
        for k in range(4):
            if tree.cells[quad, k, IS_QUAD] == 1.0:
                for c in range(4):
                    mean[quad, k, c] = 0.25 * (
                        mean[below, 0, c] + mean[below, 1, c] + mean[below, 2, c] + mean[below, 3, c]
                    )
                below += 1


@kernel(ahead=True)
def plant_map(
    source: MapSource, max_depth: int, restyle: int
) -> tuple[PlanarGrowth, PlanarLayers, FaceTable, float, float]:
    """Make the undivided unit square, its layers and faces.

    Also return how far the outline lies outside it, and the largest coordinate of a band of a gradient.
    """
    rows = rows_of(source, restyle)
    layers = layers_of(source, rows, restyle)
    tree, outside = new_growth(rows.cubics, rows.owner, max_depth, False)
    growth = PlanarGrowth(
        tree,
        np.zeros(len(tree.stack), np.int64),
        np.zeros((len(tree.cells), 4, 4)),
        np.zeros((len(tree.curves), 2), np.int64),
    )
    return growth, layers, new_faces(FIRST_ROOM, FIRST_ROOM), outside, rows.reach


@kernel(ahead=True, shares=True)
def grow_map(
    growth: PlanarGrowth,
    layers: PlanarLayers,
    faces: FaceTable,
    bounds: Bounds,
    most_texels: int,
    most_work: int,
    aside: int,
) -> tuple[PlanarGrowth, FaceTable]:
    """Divide cells, depth first, until none waits, quads or texels are too many, or `most_work` is done.

    Unless `aside` is 0, also stop before a cell whose list is no longer than `aside`. Returns the map and its faces.
    The given ones are no longer valid: some of their arrays may be those of the new ones.
    """
    stack, counts, paths, in_cell = growth.tree.stack, growth.tree.counts, len(layers.rules), 0
    for k in range(counts[WAITING]):
        in_cell = max(in_cell, PARTS * (stack[k, LAST] - stack[k, FIRST]))
    row = np.empty(stack.shape[1], np.int64)
    child_at, windings = np.empty(9, np.int64), np.empty((paths, 8), np.int64)
    work = PlanarWork(np.empty(len(counts), np.int64), row, child_at, windings, new_workspace(paths, in_cell))
    while counts[WAITING] > 0 and counts[QUADS] <= bounds.most_quads and most_work > 0:
        top = counts[WAITING] - 1
        listed = stack[top, LAST] - stack[top, FIRST]
        if (aside > 0 and listed <= aside) or texels_of(counts[QUADS], counts[CURVES]) > most_texels:
            return growth, faces
        if not has_room(growth.tree):
            growth = with_map_room(growth)
        most_work -= CELL + listed
        _grow_quad(growth, layers, faces, bounds, work)
        if faces.counts[1] != 0:
            faces = roomier_faces(faces)
    if counts[WAITING] == 0:
        _means(growth)
    return growth, faces


def build_map(
    drawing: Drawing,
    *,
    tolerance: float = 0.0,
    max_depth: int = DEFAULT_DEPTH,
    capacity: int = DEFAULT_MAP_CAPACITY,
    precision: float | None = None,
    most_quads: int = MOST_QUADS,
    most_texels: int | None = None,
    restyle: bool = False,
    threads: int | None = None,
) -> PlanarMap | None:
    """Planar map of a drawing in its colours; None if it needs more than `most_texels`.

    With `restyle`, faces of different elements keep the border between them even if they have one colour. Large maps of
    crowded symbols are then built by `threads` threads, by default one for each processor; the map does not depend on
    their number.

    The other parameters and errors are those of `build_tree`.

    Examples
    --------
    >>> from vexture.drawing.drawing import Path
    >>> from vexture.drawing.paint import Paint
    >>> left = Drawing.polygon([(0, 0), (0.5, 0), (0.5, 1), (0, 1)]).paths[0].contours
    >>> right = Drawing.polygon([(0.5, 0), (1, 0), (1, 1), (0.5, 1)]).paths[0].contours
    >>> planar = build_map(Drawing((Path(left, paint=Paint((1.0, 0.0, 0.0))), Path(right))))
    >>> len(planar.count), planar.mean[0, 0], planar.mean[0, 1]
    (1, array([1., 0., 0., 1.]), array([0., 0., 0., 1.]))
    """
    bounds = bounds_of(tolerance, max_depth, capacity, precision, most_quads, DEFAULT_MAP_CAPACITY)
    state = grow_drawing(drawing, bounds, most_texels, restyle, threads)
    return None if state is None else map_of(drawing.name, state)


def grow_drawing(
    drawing: Drawing,
    bounds: Bounds,
    most_texels: int | None = None,
    restyle: bool = False,
    threads: int | None = None,
) -> State | None:
    """Divide the unit square for a drawing until no cell waits; parameters and result are as in `build_map`."""
    source = source_of(drawing, restyle)
    check_time(drawing.name)
    *root, outside, reach = plant_map(source, bounds.max_depth, int(restyle))
    check_reach(reach)
    if not outside <= CLOSED:  # NaN counts as outside
        raise SourceError(f"{drawing.name}: a curve leaves the unit square by {outside:.3g}; clip or scale it first")
    most = MOST_WORDS if most_texels is None else most_texels

    def step(state: State, aside: int) -> State:
        check_growth(int(state.growth.tree.counts[QUADS]), bounds.most_quads, drawing.name)
        growth, faces = grow_map(*state, bounds, most, SLICE, aside)
        return State(planar_growth_from(growth), state.layers, FaceTable(*faces))

    def check(quads: int, curves: int) -> bool:
        check_growth(quads, bounds.most_quads, drawing.name)
        return texels_of(quads, curves) <= most

    state = state_from(*root)
    # only drawings with hidden paths: parts number paints in another order, and other drawings must keep their bytes
    if restyle and state.layers.hides.any() and state.growth.tree.stack[0, LAST] > LARGE:
        return grow_map_parts(state, step, usual_threads() if threads is None else threads, check)
    while state.growth.tree.counts[WAITING] > 0:
        state = step(state, 0)
        if not check(*state.growth.tree.counts[[QUADS, CURVES]].tolist()):
            return None
    return state


def check_reach(reach: float) -> None:
    """Raise a `SourceError` if a band of a gradient has a coordinate that is too far away."""
    if not reach <= FARTHEST:
        raise SourceError(
            f"a coordinate is {reach:.3g} times the size of the drawing away; the limit is {FARTHEST:g}; "
            "correct the coordinate or the view box"
        )


def map_of(name: str, state: State) -> PlanarMap:
    """Make the final map; raise a `LimitError` if it has too many paints."""
    arrays, starts, members, flattened = arrange_map(*state)
    parts = map_arrays_from(arrays)
    if len(parts.paints) > MOST_PAINTS:
        raise LimitError(f"{name}: {len(parts.paints)} colours; the limit is {MOST_PAINTS}; use `split` paint")
    deviation = float(state.growth.tree.deviation[0])
    hiding = frozenset(np.flatnonzero(state.layers.hides).tolist())
    return PlanarMap(*parts, starts, members, flattened, deviation, hiding)
