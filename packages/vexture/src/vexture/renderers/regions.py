"""Faces with gradients between two chords, for the exact renderer, put together from slab to slab.

A slab ends wherever any chord of its row does, so a row has hundreds. A *region* goes on from slab to slab while the
same chords bound the same face; and a column of the image that a face fills goes on while regions of it fill it. So few
large cells are integrated (`vexture.renderers.gradient_integral`) instead of very many thin ones.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.renderers.faces import FLAT, MEMBERS, PathStack, SweepFaces
from vexture.renderers.gradient_integral import Room, SlabCell, add_cell

SIDE: Final = -1
"""In place of a chord, the right side of the image."""


class Regions(NamedTuple):
    """Regions that may go on in the slab below, one for each chord on the left; columns that are filled so far."""

    lines: NDArray[np.float64]  # (n, 4), of `Chords`
    rights: NDArray[np.int64]  # (n,): the chord on the right, or SIDE
    faces: NDArray[np.int64]  # (n, 2): where the members of the face start and end
    heights: NDArray[np.float64]  # (n, 2): top and bottom; equal if there is no region
    listed: NDArray[np.int64]  # (n,): the chords that have had a region in this row
    is_listed: NDArray[np.bool_]  # (n,)
    used: NDArray[np.int64]  # (1,): how many are listed
    filled: NDArray[np.int64]  # (width, 2): the face that fills a column
    spans: NDArray[np.float64]  # (width, 2): from where to where
    room: Room

    @classmethod
    def between(cls, lines: NDArray[np.float64], width: int) -> "Regions":
        """None so far."""
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
    """Add the part in a slab of the region of a face between two chords."""
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
    """Add the region of a chord, if there is one: to the columns that it fills, as they go on, or by its integral."""
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
    """Value of x of a chord at a height."""
    return float(line[2] + (y - line[0]) * line[3])


@kernel(allocates=False)
def end_column(column: int, stack: PathStack, faces: SweepFaces, regions: Regions, change: NDArray[np.float64]) -> None:
    """Add what fills a column, if anything does."""
    (start, end), (top, bottom), x = regions.filled[column], regions.spans[column], float(column)
    if bottom > top:
        cell = SlabCell(start, end, (x, x), (x + 1.0, x + 1.0), top, bottom, column)
        add_cell(cell, stack, faces, regions.room, change)
        regions.spans[column, 0] = bottom


@kernel(allocates=False)
def end_row(stack: PathStack, faces: SweepFaces, regions: Regions, change: NDArray[np.float64]) -> None:
    """Add all regions and columns."""
    for left in regions.listed[: regions.used[0]]:
        end_region(left, stack, faces, regions, change)
        regions.is_listed[left] = False
    regions.used[0] = 0
    for column in range(len(regions.filled)):
        end_column(column, stack, faces, regions, change)
