"""The leaf of a planar map: a few monotone pieces, each between two faces of different paint."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.area import integral_x_dy
from vexture.kernels import kernel
from vexture.layout import LATTICE, MOST_CURVES
from vexture.tree.boundary import MOST_RESOLVED, sort_order
from vexture.tree.crossings import x_at
from vexture.tree.divide import PiecePool
from vexture.tree.leaf import DIVIDE, SPARE, round_controls
from vexture.tree.merge import MOST_MERGED
from vexture.tree.planar.borders import Borders, Cell, find_borders, key_of, merge_borders, new_borders
from vexture.tree.planar.faces import Faces, Layers, face_of
from vexture.tree.planar.left_edge import settle_left_edge
from vexture.tree.planar.slabs import Pieces, clean_borders, sweep
from vexture.tree.separate import all_separate
from vexture.tree.winding import inside

__all__ = ["PlanarLeaf", "Workspace", "new_workspace", "planar_leaf"]

KNOT = LATTICE / 4.0
"""Pieces that all have an end in a square this wide are one *knot*: dividing the leaf would follow it down many levels.
They need not meet exactly: crossings are rounded, and maps have short borders between two junctions."""

SCANLINES = 64
"""Heights at which a cell with too many pieces to resolve is measured."""

MOST_PIECES = 250
"""Pieces of a resolved cell at the depth limit that are kept to measure its mean."""


class PlanarLeaf(NamedTuple):
    """What a leaf stores of a cell, beside its mean."""

    size: int  # number of pieces, or `DIVIDE`
    base: int  # paint at the bottom left corner, before what starts or ends there
    distance: float  # by which merging moved borders at most, in unit-square units
    resolved: bool  # False if the cell, at the depth limit, holds more than a leaf can store: only its mean counts


class Workspace(NamedTuple):
    """Arrays that are reused from cell to cell."""

    borders: Borders
    windings: NDArray[np.int64]  # (paths,)
    pieces: Pieces


@kernel
def new_workspace(paths: int) -> Workspace:
    """Arrays for the cells of a drawing of so many paths."""
    room = MOST_PIECES + 2 * MOST_RESOLVED
    return Workspace(
        new_borders(MOST_RESOLVED + 1),
        np.empty(paths, np.int64),
        Pieces(np.empty((room, 4, 2)), np.empty((room, 2), np.int64)),
    )


@kernel(allocates=False)
def _is_knot(pieces: Pieces, count: int) -> bool:
    """Whether all pieces have an end near an end of the first."""
    for end in (0, 3):
        x, y = pieces.curves[0, end, 0], pieces.curves[0, end, 1]
        meeting = 0
        for k in range(count):
            near = False
            for other in (0, 3):
                apart = max(abs(pieces.curves[k, other, 0] - x), abs(pieces.curves[k, other, 1] - y))
                near = near or apart <= KNOT
            meeting += 1 if near else 0
        if meeting == count:
            return True
    return False


@kernel(allocates=False)
def _set_mean(pieces: Pieces, count: int, base: int, faces: Faces, mean: NDArray[np.float64]) -> None:
    """Write the mean colour of a leaf."""
    for c in range(4):
        mean[c] = faces.rgba[base, c]
    for k in range(count):
        curve = pieces.curves[k]
        area = (curve[0, 1] - curve[3, 1]) / LATTICE + integral_x_dy(curve) / LATTICE**2
        area += 1.0 - curve[0, 1] / LATTICE if curve[0, 0] == 0.0 else 0.0
        area -= 1.0 - curve[3, 1] / LATTICE if curve[3, 0] == 0.0 else 0.0
        for c in range(4):
            mean[c] += area * (faces.rgba[pieces.sides[k, 0], c] - faces.rgba[pieces.sides[k, 1], c])
    for c in range(4):
        mean[c] = min(max(mean[c], 0.0), 1.0)


@kernel
def _set_crowded_mean(
    pool: PiecePool,
    cell: Cell,
    ground: int,
    present: NDArray[np.int64],
    layers: Layers,
    faces: Faces,
    windings: NDArray[np.int64],
    mean: NDArray[np.float64],
) -> None:
    """Write the mean colour of a cell with too many pieces to resolve: that of `SCANLINES` lines."""
    n = cell.last - cell.first
    crossing_x, crossing, owner = np.empty(n), np.empty(n, np.int64), np.empty(n, np.int64)
    k = 0
    for i in range(n):
        while present[k, 0] != pool.path[pool.numbers[cell.first + i]]:
            k += 1
        owner[i] = k
    mean[:4] = 0.0
    for line in range(SCANLINES):
        y, count = cell.y + cell.size * (line + 0.5) / SCANLINES, 0
        for k in range(len(present)):
            windings[k] = present[k, 1]
        for i in range(n):
            curve = pool.points[pool.numbers[cell.first + i]]
            for end, event in ((0, 1), (3, -1)):
                if curve[end, 0] == cell.x and curve[end, 1] <= y:
                    windings[owner[i]] += event
            if min(curve[0, 1], curve[3, 1]) <= y < max(curve[0, 1], curve[3, 1]):
                crossing_x[count], crossing[count] = x_at(curve, y), i
                count += 1
        key, x, at = key_of(layers, present, windings), cell.x, 0
        order = sort_order(crossing_x, count)
        while at <= count:
            end_x = cell.x + cell.size if at == count else crossing_x[order[at]]
            if end_x > x:
                face = face_of(faces, layers, ground, present, windings, key)
                for c in range(4):
                    mean[c] += (end_x - x) / (cell.size * SCANLINES) * faces.rgba[face, c]
                x = end_x
            if at < count:
                i = crossing[order[at]]
                curve, path = pool.points[pool.numbers[cell.first + i]], present[owner[i], 0]
                before = inside(windings[owner[i]], layers.rules[path])
                windings[owner[i]] += -1 if curve[3, 1] > curve[0, 1] else 1
                key ^= 0 if before == inside(windings[owner[i]], layers.rules[path]) else layers.keys[path]
            at += 1


@kernel
def planar_leaf(
    pool: PiecePool,
    cell: Cell,
    ground: int,
    present: NDArray[np.int64],
    layers: Layers,
    faces: Faces,
    capacity: int,
    tolerance: float,
    at_limit: bool,
    workspace: Workspace,
    mean: NDArray[np.float64],
) -> tuple[PlanarLeaf, Workspace]:
    """Leaf of a cell above a face, `ground`; its pieces are left in the workspace, its mean colour in `mean` (4,).

    `capacity` is the number of pieces in a leaf; more are allowed only at the depth limit and in knots. `tolerance`
    bounds the distance by which merging moves borders, in unit-square units; 0 merges nothing. With `at_limit` the cell
    may not be divided. The workspace that is returned may have more room.
    """
    windings, out, distance = workspace.windings, workspace.pieces, 0.0
    most = MOST_RESOLVED if at_limit else capacity + SPARE
    found = max(most, MOST_MERGED) if tolerance > 0.0 else most
    count, borders = find_borders(pool, cell, present, found, workspace.borders)
    workspace = Workspace(borders, windings, out)
    if tolerance > 0.0 and 1 < count <= MOST_MERGED:
        count, distance = merge_borders(borders, count, tolerance * LATTICE / cell.size, most, out.curves)
        distance *= cell.size / LATTICE
    made = -1
    if 0 <= count <= most and all_separate(borders.curves[:count]):
        made = clean_borders(borders, count, ground, present, layers, faces, windings, out)
    if 0 <= count <= most and made < 0:
        stored = MOST_PIECES if at_limit else MOST_CURVES
        made = sweep(borders, count, ground, present, layers, faces, windings, stored, out)
    if made < 0:
        if at_limit:
            _set_crowded_mean(pool, cell, ground, present, layers, faces, windings, mean)
        return PlanarLeaf(0 if at_limit else DIVIDE, 0, 0.0, False), workspace
    made, base = settle_left_edge(borders, count, ground, present, layers, faces, windings, out, made)
    round_controls(out.curves, made)
    _set_mean(out, made, base, faces, mean)
    if made > capacity and not (made <= MOST_CURVES and (at_limit or _is_knot(out, made))):
        return PlanarLeaf(0 if at_limit else DIVIDE, base, distance, False), workspace
    return PlanarLeaf(made, base, distance, True), workspace
