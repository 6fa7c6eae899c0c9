"""Rasters in a frame: the part that it needs, their outlines and their grids."""

from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.errors import SourceError
from vexture.geo.contours import shored, wet_drawing
from vexture.geo.frame import Frame
from vexture.geo.lattice import Lattice
from vexture.geo.reference import Bounds, period, shown_bounds, transformed, transformed_bounds
from vexture.geo.series import Reading, Series, Values, plausible
from vexture.notes import Notes

__all__ = ["frame_places", "raster_steps", "unit_square"]

MOST_CELLS: Final = 4_194_304
"""Cells of a raster that are contoured at once; of more, every second one, third one and so on is read."""

MOST_SAMPLES: Final = 256
"""Samples of a grid of depths on its longer side."""

NEAR: Final = 1.5
"""Cells. A frame that ends so near to the raster's border, or before it, has water beyond as there is at the border."""


def raster_steps(series: Series, system: str, frame: Frame, hmin: float, notes: Notes) -> Iterator[Reading]:
    """Read the steps of a series as far as a frame needs them."""
    lattice = _turned(series.lattice, system, frame)
    square = transformed_bounds(unit_square(frame), frame.crs, system)
    rows, columns = _window(lattice, square, frame, system, notes)
    placing = Placing(lattice.cut(rows, columns), system, frame)
    beyond = placing.beyond()
    for step in range(len(series.times)):
        read, ground = series.read(step, rows, columns)
        depth, bed = plausible(read), None if ground is None else plausible(ground)
        drawing = wet_drawing(shored(depth, hmin, bed), placing.to_unit, beyond)
        grid = placing.grid(np.where(depth < 0.0, 0.0, depth))
        known = bool(np.isfinite(depth).any())
        yield Reading(drawing, grid, None if bed is None else placing.grid(bed), known)


def unit_square(frame: Frame) -> Bounds:
    """Unit square in the units of the frame's system."""
    (west, south), (east, north) = (frame.to_source @ (corner, corner, 1.0) for corner in (0.0, 1.0))
    return (float(west), float(south), float(east), float(north))


def frame_places(frame: Frame) -> tuple[NDArray[np.float64], tuple[int, int]]:
    """Places in the unit square of the samples of a grid over a frame, (n, 2), and its rows and columns."""
    width, height = frame.metres
    columns, rows = (max(1, round(MOST_SAMPLES * side / max(width, height))) for side in (width, height))
    x0, y0, x1, y1 = frame.box
    u = x0 + (x1 - x0) * (np.arange(columns) + 0.5) / columns
    v = y1 + (y0 - y1) * (np.arange(rows) + 0.5) / rows
    return np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 2), (rows, columns)


def _turned(lattice: Lattice, system: str, frame: Frame) -> Lattice:
    """Lattice, so many turns around the world that it meets the frame."""
    turn = period(system)
    square = transformed_bounds(frame.bounds, frame.crs, system)
    if not turn or square is None:
        return lattice
    turns = [lattice.moved(k * turn) for k in (0, -1, 1)]
    return max(turns, key=lambda moved: min(moved.box[2], square[2]) - max(moved.box[0], square[0]))


def _window(lattice: Lattice, square: Bounds | None, frame: Frame, system: str, notes: Notes) -> tuple[slice, slice]:
    """Rows and columns that the unit square needs, thinned out if they are too many."""
    found = None
    if square is not None:
        places = lattice.find(Lattice.outline(*square))
        low, high = np.floor(places.min(axis=0)) - 2, np.ceil(places.max(axis=0)) + 3
        first = np.maximum(low, 0).astype(int)
        last = np.minimum(high, lattice.shape[::-1]).astype(int)
        if (first < last).all() and (high - 2.5 > 0).all() and (low + 2.5 < lattice.shape[::-1]).all():
            found = first, last
    if found is None:
        raise SourceError(
            f"nothing of it is within the bounds {shown_bounds(frame.bounds, frame.crs)}: "
            f"it covers {shown_bounds(lattice.box, system)}; give other `bounds`"
        )
    (c0, r0), (c1, r1) = found
    stride = int(np.ceil(np.sqrt((r1 - r0) * (c1 - c0) / MOST_CELLS)))
    if stride > 1:
        notes.remark(
            f"{r1 - r0:,} x {c1 - c0:,} cells are too many: one in {stride} x {stride} was read; "
            "give smaller `bounds` for all of them"
        )
    # of each block of cells its middle one, as GDAL takes it
    rows, columns = (
        slice(int(a) + stride // 2, int(a + (b - a) // stride * stride), stride) for a, b in ((r0, r1), (c0, c1))
    )
    return rows, columns


class Placing:
    """From positions in a lattice to the unit square of a frame, and back.

    Parameters
    ----------
    lattice : Lattice
    system : str
        Its reference system.
    frame : Frame
    """

    def __init__(self, lattice: Lattice, system: str, frame: Frame) -> None:
        self._lattice, self._system, self._frame = lattice, system, frame
        self._matrix, self._offset = frame.to_source[:, :2].diagonal(), frame.to_source[:, 2]

    def to_unit(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Positions, (n, 2), in the unit square."""
        points = transformed(self._lattice.place(positions), self._system, self._frame.crs)
        return (points - self._offset) / self._matrix

    def positions(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """Places in the unit square as positions: the inverse of `to_unit`."""
        points = transformed(places * self._matrix + self._offset, self._frame.crs, self._system)
        return self._lattice.find(points)

    def beyond(self) -> tuple[float, float, float, float]:
        """How many cells the outermost values go on to the left, first, right and last, to fill the unit square.

        None on a side on which the raster ends well inside of the frame.
        """
        rows, columns = self._lattice.shape
        frame = self.positions(Lattice.outline(*self._frame.box))
        square = self.positions(Lattice.outline(0.0, 0.0, 1.0, 1.0))
        if not np.isfinite(square).all():
            return (0.0, 0.0, 0.0, 0.0)
        low, high = -0.5 - frame.min(axis=0), frame.max(axis=0) - (columns - 0.5, rows - 0.5)
        need_low, need_high = -0.5 - square.min(axis=0), square.max(axis=0) - (columns - 0.5, rows - 0.5)
        sides = [(low[0], need_low[0]), (low[1], need_low[1]), (high[0], need_high[0]), (high[1], need_high[1])]
        left, first, right, last = (max(0.0, need + 1.0) if gap <= NEAR else 0.0 for gap, need in sides)
        return (left, first, right, last)

    def grid(self, values: Values) -> NDArray[np.float32]:
        """Values over the frame, the northernmost row first; the nearest sample's, NaN beyond all."""
        places, shape = frame_places(self._frame)
        found = self.positions(places)
        last = np.array(values.shape[::-1]) - 1
        inside = np.all((found >= -0.5 - NEAR) & (found <= last + 0.5 + NEAR), axis=1)
        nearest = np.clip(np.rint(np.where(inside[:, None], found, 0.0)), 0, last).astype(int)
        taken = values[nearest[:, 1], nearest[:, 0]]
        return np.where(inside, taken, np.nan).reshape(shape).astype(np.float32)
