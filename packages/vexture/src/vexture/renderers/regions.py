"""Faces with gradients, pictures or blurs between two chords, merged from slab to slab, for the exact renderer.

A slab ends wherever any chord of its row does, so a row has hundreds of slabs. A *region* continues from slab to slab
while the same chords bound the same face. Likewise, a column of the image that a face fills continues while regions of
the face fill it. So a few large cells are integrated instead of very many thin ones.

The colour of such a face varies within a pixel. Its integral over the part of a region in one column, a *cell*, is an
integral over y of integrals over x. Each line is cut where a ramp has a corner or a jump (`vexture.renderers.ramps`),
or a picture a seam (`vexture.renderers.samples`), and into parts that are short compared with the detail of a spline or
a blur (`vexture.renderers.smooth`). The cell is cut where the cuts of its lines begin, end or turn.
Between cuts the colour is smooth, except for corners that blend modes make. There, Gauss-Legendre quadrature with one,
two and three points is refined until more points change nothing.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.tolerance import STEADY
from vexture.renderers.faces import FLAT, MEMBERS, PathStack, SweepFaces, composite
from vexture.renderers.ramps import MOST_CUTS, Place, add_cut, cut_line, cut_turns
from vexture.renderers.samples import cut_corners, cut_seams
from vexture.renderers.smooth import MOST_PARTS, cut_borders, cut_evenly, extent

MOST_HALVINGS: Final = (64, 256)
"""Most halvings in a cell, and in a line of it; the rest is then integrated without refinement."""

MOST_POINTS: Final = 3

GAUSS = np.zeros((MOST_POINTS + 1, MOST_POINTS, 2))
"""Points in 0..1 and weights of Gauss-Legendre quadrature with one, two and three points."""
for count in range(1, MOST_POINTS + 1):
    GAUSS[count, :count] = np.array(np.polynomial.legendre.leggauss(count)).T * 0.5 + (0.5, 0.0)

CELL, ROWS, ROWS_BEFORE, LINE, POINTS, POINTS_BEFORE, POINT = range(7)
"""Rows of `Room.sums`: a cell; a part of it by rows, now and before refinement; a line; likewise by points; a point."""


class SlabCell(NamedTuple):
    """Part of one column of the image between two edges that run from `top` to `bottom`."""

    start: int  # range of the face's members
    end: int
    left: Place  # x at the top and at the bottom
    right: Place
    top: float
    bottom: float
    column: int


class Room(NamedTuple):
    """Scratch arrays of the integrals."""

    down: NDArray[np.float64]  # (MOST_CUTS,): cuts of a cell
    across: NDArray[np.float64]  # (MOST_CUTS,): cuts of a line in it
    sums: NDArray[np.float64]  # (7, 4)

    @classmethod
    def empty(cls) -> "Room":
        """Allocate scratch arrays for one cell at a time."""
        return cls(np.empty(MOST_CUTS), np.empty(MOST_CUTS), np.zeros((7, 4)))


@kernel(allocates=False)
def add_cell(cell: SlabCell, stack: PathStack, faces: SweepFaces, room: Room, change: NDArray[np.float64]) -> None:
    """Add the integral over a cell to `change`."""
    total, rows = room.sums[CELL], room.sums[ROWS]
    total[:] = 0.0
    cuts = cut_cell(cell, stack, faces, room.down)
    start, halvings, fixed = 0.0, 0, points_needed(cell, stack, faces)
    for k in range(cuts + 1):
        next_cut = room.down[k] if k < cuts else 1.0
        while start < next_cut:
            end = next_cut
            while not settle_rows(cell, start, end, fixed, stack, faces, room) and halvings < MOST_HALVINGS[0]:
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
    """Cut a cell, from top to bottom, where edges leave the column, and where corners or seams begin, end or turn."""
    column, beyond = float(cell.column), cell.column + 1.0
    count = 0
    for high, low in (cell.left, cell.right):
        for x in (column, beyond):
            count = add_cut((x - high) / (low - high), cuts, count)
    ramps, has_splines = len(stack.ramps.radial), False
    for path in faces.members[cell.start : cell.end]:
        k = stack.shades[path]
        if k >= ramps + len(stack.samples.starts):
            has_splines = True
        elif k >= ramps:
            count = cut_picture(cell, stack, k - ramps, cuts, count)
        elif k >= 0:
            for high, low in (cell.left, cell.right, (column, column), (beyond, beyond)):
                count = cut_line(stack.ramps, k, (high, cell.top), (low, cell.bottom), cuts, count)
            for high, low in ((column, beyond), (beyond, column)):
                count = cut_turns(stack.ramps, k, (high, cell.top), (low, cell.bottom), cuts, count)
    return cut_splines(cell, stack, faces, cuts, count) if has_splines else count


@kernel(allocates=False)
def cut_splines(cell: SlabCell, stack: PathStack, faces: SweepFaces, cuts: NDArray[np.float64], count: int) -> int:
    """Cut a cell at the borders of splines, and into parts that are short enough for quadrature."""
    column, beyond = float(cell.column), cell.column + 1.0
    height = cell.bottom - cell.top
    splines = len(stack.ramps.radial) + len(stack.samples.starts)
    for high, low in (cell.left, cell.right, (column, column), (beyond, beyond)):
        start, end = part_in_column(high, low, column)
        if start < end:
            begin = high + start * (low - high), cell.top + start * height
            last = high + end * (low - high), cell.top + end * height
            length = 0.0
            for path in faces.members[cell.start : cell.end]:
                k = stack.shades[path] - splines
                if k >= 0:
                    count = cut_borders(stack.splines, k, begin, last, (start, end), cuts, count)
                    length = max(length, extent(stack.splines, k, begin, last))
            count = cut_evenly(length, (start, end), cuts, count)
    return count


@kernel(allocates=False)
def part_in_column(high: float, low: float, column: float) -> Place:
    """Return the part, in 0..1, of a straight edge, given by x at its top and bottom, that lies in a column."""
    if low == high:
        return 0.0, 1.0
    one, other = (column - high) / (low - high), (column + 1.0 - high) / (low - high)
    return max(min(one, other), 0.0), min(max(one, other), 1.0)


@kernel(allocates=False)
def points_needed(cell: SlabCell, stack: PathStack, faces: SweepFaces) -> int:
    """Return the number of points between cuts if all varying paints of a face are blurs; 0 if it is to be found."""
    column, beyond, length = float(cell.column), cell.column + 1.0, 0.0
    splines = len(stack.ramps.radial) + len(stack.samples.starts)
    for path in faces.members[cell.start : cell.end]:
        k = stack.shades[path] - splines
        if k >= 0 and stack.splines.blurs[k]:
            for high, low in ((column, beyond), (beyond, column)):
                length = max(length, extent(stack.splines, k, (high, cell.top), (low, cell.bottom)))
        elif stack.shades[path] >= 0:
            return 0
    if stack.has_corners or length > MOST_PARTS:
        return 0
    return 2 if length <= 1.0 / 3.0 else 3


@kernel(allocates=False)
def cut_picture(cell: SlabCell, stack: PathStack, k: int, cuts: NDArray[np.float64], count: int) -> int:
    """Cut a cell at the seams of a picture, where they meet its edges, in the column, or one another."""
    column, beyond = float(cell.column), cell.column + 1.0
    count = cut_corners(stack.samples, k, (column, cell.top), (beyond, cell.bottom), cuts, count)
    height = cell.bottom - cell.top
    for high, low in (cell.left, cell.right, (column, column), (beyond, beyond)):
        start, end = part_in_column(high, low, column)
        if start < end:
            begin = high + start * (low - high), cell.top + start * height
            last = high + end * (low - high), cell.top + end * height
            count = cut_seams(stack.samples, k, begin, last, (start, end), cuts, count)
    return count


@kernel(allocates=False)
def settle_rows(
    cell: SlabCell, start: float, end: float, fixed: int, stack: PathStack, faces: SweepFaces, room: Room
) -> bool:
    """Integrate a part of a cell, from `start` to `end` in 0..1, by rows; return whether more rows change nothing.

    If `fixed` is not 0, it is the number of points that is known to be enough, along each axis.
    """
    rows, before, line = room.sums[ROWS], room.sums[ROWS_BEFORE], room.sums[LINE]
    first_count, last_count = (fixed, fixed) if fixed else (1, MOST_POINTS)
    for points in range(first_count, last_count + 1):
        for channel in range(4):
            before[channel] = rows[channel]
            rows[channel] = 0.0
        for place, weight in GAUSS[points, :points]:
            part = start + place * (end - start)
            x0 = max(cell.left[0] + part * (cell.left[1] - cell.left[0]), float(cell.column))
            x1 = min(cell.right[0] + part * (cell.right[1] - cell.right[0]), cell.column + 1.0)
            if x1 > x0:
                sum_line(cell, (x0, x1), cell.top + part * (cell.bottom - cell.top), fixed, stack, faces, room)
                for channel in range(4):
                    rows[channel] += weight * (end - start) * (cell.bottom - cell.top) * line[channel]
        if points > 1 and near(before, rows):
            return True
    return fixed != 0


@kernel(allocates=False)
def sum_line(
    cell: SlabCell, ends: Place, y: float, fixed: int, stack: PathStack, faces: SweepFaces, room: Room
) -> None:
    """Integrate the colour along a horizontal line."""
    (x0, x1), line, points = ends, room.sums[LINE], room.sums[POINTS]
    line[:] = 0.0
    cuts, length, ramps = 0, 0.0, len(stack.ramps.radial)
    splines = ramps + len(stack.samples.starts)
    for path in faces.members[cell.start : cell.end]:
        k = stack.shades[path]
        if k >= splines:
            cuts = cut_borders(stack.splines, k - splines, (x0, y), (x1, y), (0.0, 1.0), room.across, cuts)
            length = max(length, extent(stack.splines, k - splines, (x0, y), (x1, y)))
        elif k >= ramps:
            cuts = cut_seams(stack.samples, k - ramps, (x0, y), (x1, y), (0.0, 1.0), room.across, cuts)
        elif k >= 0:
            cuts = cut_line(stack.ramps, k, (x0, y), (x1, y), room.across, cuts)
    cuts = cut_evenly(length, (0.0, 1.0), room.across, cuts)
    start, halvings = x0, 0
    for k in range(cuts + 1):
        next_cut = x0 + room.across[k] * (x1 - x0) if k < cuts else x1
        while start < next_cut:
            end = next_cut
            while not settle_points(cell, (start, end), y, fixed, stack, faces, room) and halvings < MOST_HALVINGS[1]:
                end = 0.5 * (start + end)
                halvings += 1
            for channel in range(4):
                line[channel] += points[channel]
            start = end


@kernel(allocates=False)
def settle_points(
    cell: SlabCell, ends: Place, y: float, fixed: int, stack: PathStack, faces: SweepFaces, room: Room
) -> bool:
    """Integrate a part of a line, between two x, by points; return whether more points change nothing."""
    x0, x1 = ends
    sums, before, colour = room.sums[POINTS], room.sums[POINTS_BEFORE], room.sums[POINT]
    first_count, last_count = (fixed, fixed) if fixed else (1, MOST_POINTS)
    for points in range(first_count, last_count + 1):
        for channel in range(4):
            before[channel] = sums[channel]
            sums[channel] = 0.0
        for place, weight in GAUSS[points, :points]:
            composite(stack, faces, cell.start, cell.end, x0 + place * (x1 - x0), y, colour)
            for channel in range(4):
                sums[channel] += weight * (x1 - x0) * colour[channel]
        if points > 1 and near(before, sums):
            return True
    return fixed != 0


@kernel(allocates=False)
def near(one: NDArray[np.float64], other: NDArray[np.float64]) -> bool:
    """Return whether two integrals of a colour differ by at most `STEADY`."""
    for channel in range(4):
        if abs(one[channel] - other[channel]) > STEADY:
            return False
    return True


SIDE: Final = -1
"""Stands for the right side of the image in place of a chord."""


class Regions(NamedTuple):
    """Regions that may continue in the slab below, one for each chord on the left; columns that are filled so far."""

    lines: NDArray[np.float64]  # (n, 4): lines of `Chords`
    rights: NDArray[np.int64]  # (n,): the chord on the right, or SIDE
    faces: NDArray[np.int64]  # (n, 2): range of the face's members
    heights: NDArray[np.float64]  # (n, 2): top and bottom; equal if there is no region
    listed: NDArray[np.int64]  # (n,): the chords that have had a region in this row
    is_listed: NDArray[np.bool_]  # (n,)
    used: NDArray[np.int64]  # (1,): number of listed chords
    filled: NDArray[np.int64]  # (width, 2): range of members of the face that fills a column
    spans: NDArray[np.float64]  # (width, 2): top and bottom of the filled part
    room: Room

    @classmethod
    def between(cls, lines: NDArray[np.float64], width: int) -> "Regions":
        """Start without regions."""
        count = len(lines)
        return cls(
            lines,
            np.zeros(count, np.int64),
            np.full((count, 2), FLAT),
            np.zeros((count, 2)),
            np.zeros(count, np.int64),
            np.zeros(count, np.bool_),
            np.zeros(1, np.int64),
            np.full((width, 2), FLAT),
            np.zeros((width, 2)),
            Room.empty(),
        )


@kernel(allocates=False)
def add_region(
    chords: tuple[int, int],
    face: tuple[int, int],
    heights: tuple[float, float],
    stack: PathStack,
    faces: SweepFaces,
    regions: Regions,
    change: NDArray[np.float64],
) -> None:
    """Extend the region of a face between two chords by a slab, or start a new region."""
    left, right = chords
    held = regions.faces[left]
    if not regions.is_listed[left]:
        regions.listed[regions.used[0]] = left
        regions.is_listed[left] = True
        regions.used[0] += 1
    if regions.rights[left] != right or held[0] != face[0] or regions.heights[left, 1] != heights[0]:
        end_region(left, stack, faces, regions, change)
        regions.rights[left], held[0], held[1] = right, face[0], face[1]
        regions.heights[left, 0] = heights[0]
    regions.heights[left, 1] = heights[1]
    if face[1] > MEMBERS:  # its members will be overwritten
        end_region(left, stack, faces, regions, change)


@kernel(allocates=False)
def end_region(left: int, stack: PathStack, faces: SweepFaces, regions: Regions, change: NDArray[np.float64]) -> None:
    """End the region right of a chord, if any: extend the columns that it fills, and integrate the rest."""
    top, bottom = regions.heights[left]
    if not bottom > top:
        return
    width, (start, end), right = len(regions.filled), regions.faces[left], regions.rights[left]
    x0, x1 = place(regions.lines[left], top), place(regions.lines[left], bottom)
    x2, x3 = float(width), float(width)
    if right != SIDE:
        x2, x3 = place(regions.lines[right], top), place(regions.lines[right], bottom)
    first, beyond = max(min(x0, x1), 0.0), np.ceil(min(max(x2, x3), float(width)))
    for column in range(int(min(first, beyond)), int(beyond)):
        if max(x0, x1) <= column and min(x2, x3) >= column + 1.0 and end <= MEMBERS:
            filled, span = regions.filled[column], regions.spans[column]
            if filled[0] != start or span[1] != top:
                end_column(column, stack, faces, regions, change)
                filled[0], filled[1], span[0] = start, end, top
            span[1] = bottom
        else:
            cell = SlabCell(start, end, (x0, x1), (x2, x3), top, bottom, column)
            add_cell(cell, stack, faces, regions.room, change)
    regions.heights[left, 0] = bottom


@kernel(allocates=False)
def place(line: NDArray[np.float64], y: float) -> float:
    """Coordinate x of a chord at a height."""
    return float(line[2] + (y - line[0]) * line[3])


@kernel(allocates=False)
def end_column(column: int, stack: PathStack, faces: SweepFaces, regions: Regions, change: NDArray[np.float64]) -> None:
    """Add the integral over the filled part of a column, if any."""
    (start, end), (top, bottom), x = regions.filled[column], regions.spans[column], float(column)
    if bottom > top:
        cell = SlabCell(start, end, (x, x), (x + 1.0, x + 1.0), top, bottom, column)
        add_cell(cell, stack, faces, regions.room, change)
        regions.spans[column, 0] = bottom


@kernel(allocates=False)
def end_row(stack: PathStack, faces: SweepFaces, regions: Regions, change: NDArray[np.float64]) -> None:
    """End all regions and columns of a row."""
    for left in regions.listed[: regions.used[0]]:
        end_region(left, stack, faces, regions, change)
        regions.is_listed[left] = False
    regions.used[0] = 0
    for column in range(len(regions.filled)):
        end_column(column, stack, faces, regions, change)
