"""A raster of depths in a frame: read the part that the frame needs, contour it and resample it."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture.drawing.drawing import Drawing
from vexture_geo.base.crs import format_bounds, period, transform_bounds, transform_points
from vexture_geo.base.extent import Bounds, Frame, bounds_of_square
from vexture_geo.depth.contours import shore_values, wet_drawing
from vexture_geo.depth.series import Lattice, Reading, Series, Values

MOST_CELLS: Final = 4_194_304
"""Most cells that are contoured at once. Of a larger raster, every second or third cell, and so on, is read."""

MOST_SAMPLES: Final = 256
"""Samples on the longer side of a grid of depths."""

NEAR: Final = 1.5
"""Cells. If the frame ends this close to the raster's border, the border values extend beyond it."""


class RasterInFrame:
    """A series of rasters in the unit square of a frame."""

    def __init__(self, series: Series, system: str, frame: Frame, notes: Notes) -> None:
        self._series, self._system, self._frame = series, system, frame
        self._scale, self._offset = frame.to_source[:, :2].diagonal(), frame.to_source[:, 2]
        whole = _turn_lattice(series.lattice, system, frame)
        self._rows, self._columns = _window(whole, system, frame, notes)
        self._lattice = replace(whole, x=whole.x[self._columns], y=whole.y[self._rows])
        self._beyond = self._cells_beyond()

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_series": None}  # a copy in another process reads nothing

    def read(self, step: int) -> Reading:
        """Read a step."""
        return self._series.read(step, self._rows, self._columns)

    def drawings(self, depth: Values, bed: Values | None, hmin: float, depths: Sequence[float]) -> list[Drawing]:
        """Draw the area under water, and the areas with at least each depth."""
        above = shore_values(depth, hmin, bed)
        return [wet_drawing(above + hmin - least, self._to_unit, self._beyond) for least in (hmin, *depths)]

    def grid(self, values: Values) -> NDArray[np.float32]:
        """Resample the nearest values over the frame, the northernmost row first; NaN beyond the raster."""
        places, shape = grid_places(self._frame)
        found = self._positions(places)
        last = np.array(values.shape[::-1]) - 1
        inside = np.all((found >= -0.5 - NEAR) & (found <= last + 0.5 + NEAR), axis=1)
        nearest = np.clip(np.rint(np.where(inside[:, None], found, 0.0)), 0, last).astype(int)
        taken = values[nearest[:, 1], nearest[:, 0]]
        return np.where(inside, taken, np.nan).reshape(shape).astype(np.float32)

    def heights(self, values: Values) -> NDArray[np.float32]:
        """Resample like `grid`, but linearly between four known cells, so that wide cells leave no steps."""
        places, shape = grid_places(self._frame)
        last = np.array(values.shape[::-1]) - 1
        found = np.clip(self._positions(places), 0.0, last)
        low = np.minimum(found.astype(int), np.maximum(last - 1, 0))
        high = np.minimum(low + 1, last)
        (x, y), (x0, y0), (x1, y1) = (found - low).T, low.T, high.T
        upper = values[y0, x0] * (1.0 - x) + values[y0, x1] * x
        lower = values[y1, x0] * (1.0 - x) + values[y1, x1] * x
        nearest = self.grid(values)
        between = (upper * (1.0 - y) + lower * y).reshape(shape).astype(np.float32)
        return np.where(np.isfinite(between) & np.isfinite(nearest), between, nearest)

    def _to_unit(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Transform positions of the lattice, (n, 2), to the unit square."""
        points = transform_points(self._lattice.place(positions), self._system, self._frame.crs)
        return (points - self._offset) / self._scale

    def _positions(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """Inverse of `_to_unit`."""
        points = transform_points(places * self._scale + self._offset, self._frame.crs, self._system)
        return self._lattice.find(points)

    def _cells_beyond(self) -> tuple[float, float, float, float]:
        """Count the cells by which border values extend to the left, first, right and last, to fill the unit square.

        0 for a side where the raster ends well inside the frame.
        """
        rows, columns = self._lattice.shape
        frame = self._positions(Lattice.outline(*self._frame.box))
        square = self._positions(Lattice.outline(0.0, 0.0, 1.0, 1.0))
        if not np.isfinite(square).all():
            return (0.0, 0.0, 0.0, 0.0)
        low, high = -0.5 - frame.min(axis=0), frame.max(axis=0) - (columns - 0.5, rows - 0.5)
        need_low, need_high = -0.5 - square.min(axis=0), square.max(axis=0) - (columns - 0.5, rows - 0.5)
        sides = [(low[0], need_low[0]), (low[1], need_low[1]), (high[0], need_high[0]), (high[1], need_high[1])]
        left, first, right, last = (max(0.0, need + 1.0) if gap <= NEAR else 0.0 for gap, need in sides)
        return (left, first, right, last)


def grid_places(frame: Frame) -> tuple[NDArray[np.float64], tuple[int, int]]:
    """Places of a frame's grid samples in the unit square, (n, 2), and the grid's rows and columns."""
    width, height = frame.metres
    columns, rows = (max(1, round(MOST_SAMPLES * side / max(width, height))) for side in (width, height))
    x0, y0, x1, y1 = frame.box
    u = x0 + (x1 - x0) * (np.arange(columns) + 0.5) / columns
    v = y1 + (y0 - y1) * (np.arange(rows) + 0.5) / rows
    return np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 2), (rows, columns)


def outside(frame: Frame, box: Bounds, system: str) -> SourceError:
    """Make the error for a file that covers nothing of the frame."""
    return SourceError(
        f"nothing of it is within the bounds {format_bounds(frame.bounds, frame.crs)}: "
        f"it covers {format_bounds(box, system)}; give other `bounds`"
    )


def _turn_lattice(lattice: Lattice, system: str, frame: Frame) -> Lattice:
    """Move a lattice by a full turn of longitude if it then overlaps the frame."""
    turn = period(system)
    square = transform_bounds(frame.bounds, frame.crs, system)
    if not turn or square is None:
        return lattice
    east = np.array([[0.0, 0.0, turn], [0.0, 0.0, 0.0]])
    turns = [replace(lattice, affine=lattice.affine + k * east) for k in (0, -1, 1)]
    return max(turns, key=lambda moved: min(moved.box[2], square[2]) - max(moved.box[0], square[0]))


def _window(lattice: Lattice, system: str, frame: Frame, notes: Notes) -> tuple[slice, slice]:
    """Select the rows and columns that the unit square needs, with a stride if there are too many."""
    square = transform_bounds(bounds_of_square(frame), frame.crs, system)
    if square is None:
        raise outside(frame, lattice.box, system)
    places = lattice.find(Lattice.outline(*square))
    low, high = np.floor(places.min(axis=0)) - 2, np.ceil(places.max(axis=0)) + 3
    (c0, r0), (c1, r1) = np.maximum(low, 0).astype(int), np.minimum(high, lattice.shape[::-1]).astype(int)
    overlaps = (high - 2.5 > 0).all() and (low + 2.5 < lattice.shape[::-1]).all()
    if not (c0 < c1 and r0 < r1 and overlaps):
        raise outside(frame, lattice.box, system)
    stride = int(np.ceil(np.sqrt((r1 - r0) * (c1 - c0) / MOST_CELLS)))
    if stride > 1:
        notes.remark(
            f"{r1 - r0:,} x {c1 - c0:,} cells are too many: one in {stride} x {stride} was read; "
            "give smaller `bounds` to read all of them"
        )
    # the middle cell of each block, which GDAL also chooses
    rows, columns = (
        slice(int(a) + stride // 2, int(a + (b - a) // stride * stride), stride) for a, b in ((r0, r1), (c0, c1))
    )
    return rows, columns
