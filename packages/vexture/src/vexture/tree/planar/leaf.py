"""The leaf of a planar map: a few monotone pieces, each between two faces of different paint.

The base paint of a leaf and the ends on its left edge must agree with the faces there. At the height of an end on the
left edge the paint changes by the difference of its piece's two sides. Going up, the changes must telescope, paint by
paint, from each face on the edge to the next. Sums of colours could agree by chance, and would no longer agree after a
paint is changed.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import LATTICE, MOST_CURVES
from vexture.tree.boundary import MOST_RESOLVED
from vexture.tree.bounds import Bounds
from vexture.tree.divide import Cell, PiecePool
from vexture.tree.leaf import DIVIDE, SPARE, round_controls
from vexture.tree.merge import MOST_MERGED
from vexture.tree.planar.borders import Borders, find_borders, merge_borders, new_borders, set_left_edge
from vexture.tree.planar.faces import CellFaces, paint_of
from vexture.tree.planar.means import add_programs, set_crowded_mean, set_flat_mean
from vexture.tree.planar.slabs import PlanarPieces, clean_borders, sweep
from vexture.tree.separate import all_separate


@kernel(allocates=False)
def _tally(ids: NDArray[np.int64], sums: NDArray[np.int64], n: int, paint: int, by: int) -> int:
    """Add to the sum of a paint; return the new number of paints."""
    for k in range(n):
        if ids[k] == paint:
            sums[k] += by
            return n
    ids[n], sums[n] = paint, by
    return n + 1


@kernel(allocates=False)
def _changes(pieces: PlanarPieces, count: int, y: float, ids: NDArray[np.int64], sums: NDArray[np.int64]) -> int:
    """Tally the paints that ends on the left edge at a height add and remove; return the number of paints."""
    n = 0
    for k in range(count):
        for end, event in ((0, 1), (3, -1)):
            if pieces.curves[k, end, 0] == 0.0 and pieces.curves[k, end, 1] == y:
                n = _tally(ids, sums, n, pieces.sides[k, 0], event)
                n = _tally(ids, sums, n, pieces.sides[k, 1], -event)
    return n


@kernel(allocates=False)
def _move_off(pieces: PlanarPieces, count: int, y: float) -> None:
    """Move the ends on the left edge at a height off it, by one unit."""
    for k in range(count):
        for end, control in ((0, 1), (3, 2)):
            if pieces.curves[k, end, 0] == 0.0 and pieces.curves[k, end, 1] == y:
                pieces.curves[k, end, 0] += 1.0
                pieces.curves[k, control, 0] += 1.0


@kernel(allocates=False)
def _all_zero(sums: NDArray[np.int64], n: int) -> bool:
    for k in range(n):
        if sums[k] != 0:
            return False
    return True


class Tally(NamedTuple):
    """Arrays that are reused from cell to cell."""

    heights: NDArray[np.float64]  # (2 borders + 1,)
    ids: NDArray[np.int64]  # (4 pieces + 8,): paints
    sums: NDArray[np.int64]  # (4 pieces + 8,): how much more often each paint begins than ends


@kernel
def new_tally(borders: int, pieces: int) -> Tally:
    """Arrays for cells of at most `borders` borders and `pieces` pieces."""
    return Tally(np.empty(2 * borders + 1), np.empty(4 * pieces + 8, np.int64), np.empty(4 * pieces + 8, np.int64))


@kernel(allocates=False)
def _find_heights(borders: Borders, count: int, out: NDArray[np.float64]) -> int:
    """Write the distinct heights of ends on the left edge, after 0, in rising order; return how many."""
    n = 1
    out[0] = 0.0
    for i in range(count):
        for end in (0, 3):
            y = borders.curves[i, end, 1]
            if borders.curves[i, end, 0] == 0.0 and y < LATTICE:
                k = n
                while out[k - 1] > y:
                    k -= 1
                if out[k - 1] == y:
                    continue
                for m in range(n, k, -1):
                    out[m] = out[m - 1]
                out[k] = y
                n += 1
    return n


@kernel(allocates=False)
def settle_left_edge(
    borders: Borders,
    count: int,
    cell_faces: CellFaces,
    pieces: PlanarPieces,
    piece_count: int,
    tally: Tally,
) -> tuple[int, int]:
    """Make the ends on the left edge agree with the faces there; return the number of pieces and the base paint.

    Ends whose changes do not telescope move off the edge, and one horizontal piece makes the change instead. The base
    is the paint at the bottom-left corner, before any start or end there.
    """
    layers, present, windings = cell_faces.layers, cell_faces.present, cell_faces.windings
    heights, ids, sums = tally
    levels = _find_heights(borders, count, heights)
    key = set_left_edge(borders, count, layers, present, 0.0, windings)
    below = paint_of(cell_faces, key)
    n = _tally(ids, sums, _changes(pieces, piece_count, 0.0, ids, sums), below, -1)
    base, single = below, True
    for k in range(n):
        if sums[k] == -1 and base == below and single:
            base, single = ids[k], False
        elif sums[k] != 0:
            single = True
            break
    if single:
        _move_off(pieces, piece_count, 0.0)
        base = below
    for s in range(1, levels):
        y = heights[s]
        key = set_left_edge(borders, count, layers, present, y, windings)
        above = paint_of(cell_faces, key)
        n = _tally(ids, sums, _changes(pieces, piece_count, y, ids, sums), above, -1)
        n = _tally(ids, sums, n, below, 1)
        if not _all_zero(sums, n):
            _move_off(pieces, piece_count, y)
            if above != below and piece_count < len(pieces.sides):
                for k in range(4):
                    pieces.curves[piece_count, k, 0], pieces.curves[piece_count, k, 1] = k / 3.0, y
                pieces.sides[piece_count, 0], pieces.sides[piece_count, 1] = above, below
                piece_count += 1
        below = above
    return piece_count, base


KNOT = LATTICE / 4.0
"""Width of a square, in lattice units. Pieces that all have an end in it are a *knot*, which many divisions of the leaf
would not separate. They need not meet exactly: crossings are rounded, and maps have short borders between junctions."""

MOST_PIECES = 250
"""Most pieces of a resolved cell at the depth limit that are kept to measure its mean."""


class PlanarLeaf(NamedTuple):
    """Content of a cell that a leaf stores, besides its mean."""

    size: int  # number of pieces, or `DIVIDE`
    base: int  # paint at the bottom-left corner, before any start or end there
    distance: float  # the farthest that merging moved borders, in unit-square units
    resolved: (
        bool  # False if the cell, at the depth limit, holds more than a leaf can store, which then has only a mean
    )


class PlanarWorkspace(NamedTuple):
    """Arrays that are reused from cell to cell."""

    borders: Borders
    windings: NDArray[np.int64]  # (paths,)
    pieces: PlanarPieces
    tally: Tally


@kernel
def new_workspace(paths: int, in_cell: int) -> PlanarWorkspace:
    """Arrays for the cells of a drawing of `paths` paths, with at most `in_cell` pieces in one cell."""
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
    cell: Cell,
    cell_faces: CellFaces,
    bounds: Bounds,
    at_limit: bool,
    workspace: PlanarWorkspace,
    mean: NDArray[np.float64],
) -> PlanarLeaf:
    """Make the leaf of a cell; write its pieces to the workspace and its mean colour to `mean`, (4,).

    A leaf holds more pieces than `bounds.capacity` only at the depth limit and in knots. Merging moves borders by at
    most `bounds.tolerance`, and 0 merges nothing. With `at_limit` the cell may not be divided.
    """
    borders, out, distance = workspace.borders, workspace.pieces, 0.0
    capacity, tolerance, present = bounds.capacity, bounds.tolerance, cell_faces.present
    most = MOST_RESOLVED if at_limit else capacity + SPARE
    found = max(most, MOST_MERGED) if tolerance > 0.0 else most
    count = find_borders(pool, cell, present, found, borders)
    if tolerance > 0.0 and 1 < count <= MOST_MERGED:
        count, distance = merge_borders(borders, count, tolerance * LATTICE / cell.size, most, out.curves)
        distance *= cell.size / LATTICE
    made = -1
    if 0 <= count <= most and all_separate(borders.curves[:count]):
        made = clean_borders(borders, count, cell_faces, out)
    if 0 <= count <= most and made < 0:
        stored = MOST_PIECES if at_limit else MOST_CURVES
        made = sweep(borders, count, cell_faces, stored, out)
    if made < 0:
        if at_limit:
            set_crowded_mean(pool, cell, cell_faces, mean)
        return PlanarLeaf(0 if at_limit else DIVIDE, 0, 0.0, False)
    made, base = settle_left_edge(borders, count, cell_faces, out, made, workspace.tally)
    round_controls(out.curves, made)
    if set_flat_mean(out, made, base, cell_faces.faces, mean):
        add_programs(out, made, base, cell, cell_faces.layers, cell_faces.faces, mean)
    if made > capacity and not (made <= MOST_CURVES and (at_limit or _is_knot(out, made))):
        return PlanarLeaf(0 if at_limit else DIVIDE, base, distance, False)
    return PlanarLeaf(made, base, distance, True)
