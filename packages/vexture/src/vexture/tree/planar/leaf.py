"""The leaf of a planar map: a few monotone pieces, each between two faces of different paint."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import LATTICE, MOST_CURVES
from vexture.tree.boundary import MOST_RESOLVED
from vexture.tree.divide import PiecePool
from vexture.tree.leaf import DIVIDE, SPARE, round_controls
from vexture.tree.merge import MOST_MERGED
from vexture.tree.planar.borders import Borders, PlanarCell, find_borders, merge_borders, new_borders
from vexture.tree.planar.faces import FaceTable
from vexture.tree.planar.layers import PlanarLayers
from vexture.tree.planar.left_edge import Tally, new_tally, settle_left_edge
from vexture.tree.planar.means import add_programs, set_crowded_mean, set_flat_mean
from vexture.tree.planar.slabs import PlanarPieces, clean_borders, sweep
from vexture.tree.separate import all_separate

KNOT = LATTICE / 4.0
"""Pieces that all have an end in a square this wide are one *knot*: dividing the leaf would follow it down many levels.
They need not meet exactly: crossings are rounded, and maps have short borders between two junctions."""

MOST_PIECES = 250
"""Pieces of a resolved cell at the depth limit that are kept to measure its mean."""


class PlanarLeaf(NamedTuple):
    """Content of a cell that a leaf stores, besides its mean."""

    size: int  # number of pieces, or `DIVIDE`
    base: int  # paint at the bottom left corner, before what starts or ends there
    distance: float  # by which merging moved borders at most, in unit-square units
    resolved: bool  # False if the cell, at the depth limit, holds more than a leaf can store: only its mean counts


class PlanarWorkspace(NamedTuple):
    """Arrays that are reused from cell to cell."""

    borders: Borders
    windings: NDArray[np.int64]  # (paths,)
    pieces: PlanarPieces
    tally: Tally


@kernel
def new_workspace(paths: int, in_cell: int) -> PlanarWorkspace:
    """Arrays for the cells of a drawing of so many paths, and of so many pieces in one cell."""
    room = MOST_PIECES + 2 * MOST_RESOLVED
    return PlanarWorkspace(
        new_borders(MOST_RESOLVED + 1, in_cell),
        np.empty(paths, np.int64),
        PlanarPieces(np.empty((room, 4, 2)), np.empty((room, 2), np.int64)),
        new_tally(MOST_RESOLVED, room),
    )


@kernel(allocates=False)
def _is_knot(pieces: PlanarPieces, count: int) -> bool:
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
def planar_leaf(
    pool: PiecePool,
    cell: PlanarCell,
    ground: int,
    present: NDArray[np.int64],
    layers: PlanarLayers,
    faces: FaceTable,
    capacity: int,
    tolerance: float,
    at_limit: bool,
    workspace: PlanarWorkspace,
    mean: NDArray[np.float64],
) -> PlanarLeaf:
    """Leaf of a cell above a face, `ground`; its pieces are left in the workspace, its mean colour in `mean` (4,).

    `capacity` is the number of pieces in a leaf; more are allowed only at the depth limit and in knots. `tolerance`
    bounds the distance by which merging moves borders, in unit-square units; 0 merges nothing. With `at_limit` the cell
    may not be divided.
    """
    borders, windings, out, distance = workspace.borders, workspace.windings, workspace.pieces, 0.0
    most = MOST_RESOLVED if at_limit else capacity + SPARE
    found = max(most, MOST_MERGED) if tolerance > 0.0 else most
    count = find_borders(pool, cell, present, found, borders)
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
            set_crowded_mean(pool, cell, ground, present, layers, faces, windings, mean)
        return PlanarLeaf(0 if at_limit else DIVIDE, 0, 0.0, False)
    made, base = settle_left_edge(borders, count, ground, present, layers, faces, windings, out, made, workspace.tally)
    round_controls(out.curves, made)
    if set_flat_mean(out, made, base, faces, mean):
        add_programs(out, made, base, cell, layers, faces, mean)
    if made > capacity and not (made <= MOST_CURVES and (at_limit or _is_knot(out, made))):
        return PlanarLeaf(0 if at_limit else DIVIDE, base, distance, False)
    return PlanarLeaf(made, base, distance, True)
