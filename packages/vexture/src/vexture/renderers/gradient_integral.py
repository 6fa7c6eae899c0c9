"""Integrals over faces with gradients, for the exact renderer.

The colour of such a face varies within a pixel. Its integral over the part of a slab in a pixel, a *cell*, is one over
y of integrals over x. Each line is cut where a ramp has a corner or a jump (`vexture.renderers.ramps`), and so is the
cell where the cuts of its lines begin, end or turn. Between cuts the colour is smooth, but for corners that blend modes
make. There, Gauss-Legendre quadrature with one, two and three points is refined until more points change nothing.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.tolerance import STEADY
from vexture.renderers.faces import PathStack, SweepFaces, composite
from vexture.renderers.ramps import MOST_CUTS, Place, add_cut, cut_line, cut_turns

MOST_HALVINGS: Final = (64, 256)
"""Halvings in a cell, and in a line of it; then what is left counts as it is."""

MOST_POINTS: Final = 3

GAUSS = np.zeros((MOST_POINTS + 1, MOST_POINTS, 2))
"""Places on a line from 0 to 1, and weights, of Gauss-Legendre quadrature with one, two and three points."""
for count in range(1, MOST_POINTS + 1):
    GAUSS[count, :count] = np.array(np.polynomial.legendre.leggauss(count)).T * 0.5 + (0.5, 0.0)

CELL, ROWS, ROWS_BEFORE, LINE, POINTS, POINTS_BEFORE, POINT = range(7)
"""Sums of `Room`: a whole cell; rows in a part of it, and those before; a line; points in a part of it, likewise."""


class SlabCell(NamedTuple):
    """Part of one column of the image between two edges that go from the top to the bottom of a slab."""

    start: int  # of the face's members
    end: int
    left: Place  # x at the top and at the bottom
    right: Place
    top: float
    bottom: float
    column: int


class Room(NamedTuple):
    """Room for what integrals compute."""

    down: NDArray[np.float64]  # (MOST_CUTS,): where a cell is cut,
    across: NDArray[np.float64]  # (MOST_CUTS,): and a line in it
    sums: NDArray[np.float64]  # (7, 4)

    @classmethod
    def empty(cls) -> "Room":
        """Room for one cell at a time."""
        return cls(np.empty(MOST_CUTS), np.empty(MOST_CUTS), np.zeros((7, 4)))


@kernel(allocates=False)
def add_cell(cell: SlabCell, stack: PathStack, faces: SweepFaces, room: Room, change: NDArray[np.float64]) -> None:
    """Add the integral over a cell."""
    total, rows = room.sums[CELL], room.sums[ROWS]
    total[:] = 0.0
    cuts = cut_cell(cell, stack, faces, room.down)
    start, halvings = 0.0, 0
    for k in range(cuts + 1):
        next_cut = room.down[k] if k < cuts else 1.0
        while start < next_cut:
            end = next_cut
            while not settle_rows(cell, start, end, stack, faces, room) and halvings < MOST_HALVINGS[0]:
                end = 0.5 * (start + end)
                halvings += 1
            for channel in range(4):
                total[channel] += rows[channel]
            start = end
    for channel in range(4):
        change[cell.column, channel] += total[channel]
        change[cell.column + 1, channel] -= total[channel]


@kernel(allocates=False)
def cut_cell(cell: SlabCell, stack: PathStack, faces: SweepFaces, cuts: NDArray[np.float64]) -> int:
    """Find where, on the way down, the edges leave the column, and where a ramp's corners begin, end or turn."""
    column, beyond = float(cell.column), cell.column + 1.0
    count = 0
    for high, low in (cell.left, cell.right):
        for x in (column, beyond):
            count = add_cut((x - high) / (low - high), cuts, count)
    for path in faces.members[cell.start : cell.end]:
        k = stack.shades[path]
        if k >= 0:
            for high, low in (cell.left, cell.right, (column, column), (beyond, beyond)):
                count = cut_line(stack.ramps, k, (high, cell.top), (low, cell.bottom), cuts, count)
            for high, low in ((column, beyond), (beyond, column)):
                count = cut_turns(stack.ramps, k, (high, cell.top), (low, cell.bottom), cuts, count)
    return count


@kernel(allocates=False)
def settle_rows(cell: SlabCell, start: float, end: float, stack: PathStack, faces: SweepFaces, room: Room) -> bool:
    """Integrate over the rows between two parts of the way down a cell; return whether more rows change nothing."""
    rows, before, line = room.sums[ROWS], room.sums[ROWS_BEFORE], room.sums[LINE]
    for points in range(1, MOST_POINTS + 1):
        for channel in range(4):
            before[channel] = rows[channel]
            rows[channel] = 0.0
        for place, weight in GAUSS[points, :points]:
            part = start + place * (end - start)
            x0 = max(cell.left[0] + part * (cell.left[1] - cell.left[0]), float(cell.column))
            x1 = min(cell.right[0] + part * (cell.right[1] - cell.right[0]), cell.column + 1.0)
            if x1 > x0:
                sum_line(cell, x0, x1, cell.top + part * (cell.bottom - cell.top), stack, faces, room)
                for channel in range(4):
                    rows[channel] += weight * (end - start) * (cell.bottom - cell.top) * line[channel]
        if points > 1 and near(before, rows):
            return True
    return False


@kernel(allocates=False)
def sum_line(cell: SlabCell, x0: float, x1: float, y: float, stack: PathStack, faces: SweepFaces, room: Room) -> None:
    """Integrate the colour along a level line."""
    line, points = room.sums[LINE], room.sums[POINTS]
    line[:] = 0.0
    cuts = 0
    for path in faces.members[cell.start : cell.end]:
        if stack.shades[path] >= 0:
            cuts = cut_line(stack.ramps, stack.shades[path], (x0, y), (x1, y), room.across, cuts)
    start, halvings = x0, 0
    for k in range(cuts + 1):
        next_cut = x0 + room.across[k] * (x1 - x0) if k < cuts else x1
        while start < next_cut:
            end = next_cut
            while not settle_points(cell, start, end, y, stack, faces, room) and halvings < MOST_HALVINGS[1]:
                end = 0.5 * (start + end)
                halvings += 1
            for channel in range(4):
                line[channel] += points[channel]
            start = end


@kernel(allocates=False)
def settle_points(
    cell: SlabCell, x0: float, x1: float, y: float, stack: PathStack, faces: SweepFaces, room: Room
) -> bool:
    """Integrate over the points of a part of a line; return whether more points change nothing."""
    sums, before, colour = room.sums[POINTS], room.sums[POINTS_BEFORE], room.sums[POINT]
    for points in range(1, MOST_POINTS + 1):
        for channel in range(4):
            before[channel] = sums[channel]
            sums[channel] = 0.0
        for place, weight in GAUSS[points, :points]:
            composite(stack, faces, cell.start, cell.end, x0 + place * (x1 - x0), y, colour)
            for channel in range(4):
                sums[channel] += weight * (x1 - x0) * colour[channel]
        if points > 1 and near(before, sums):
            return True
    return False


@kernel(allocates=False)
def near(one: NDArray[np.float64], other: NDArray[np.float64]) -> bool:
    """Whether two integrals of a colour are the same, but for `STEADY`."""
    for channel in range(4):
        if abs(one[channel] - other[channel]) > STEADY:
            return False
    return True
