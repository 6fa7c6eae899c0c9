"""Depths of water as `Extent`: from rasters and meshes to outlines and grids."""

import os
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.errors import LimitError, SourceError, SourceWarning, VextureError
from vexture.sources.contours import HMIN, shored, wet_drawing
from vexture.sources.extent import Extent, Step
from vexture.sources.frame import Frame
from vexture.sources.lattice import Lattice
from vexture.sources.reference import (
    Bounds,
    frame_around,
    gis_packages,
    period,
    reference,
    shown_bounds,
    transformed,
    transformed_bounds,
)
from vexture.sources.series import Series, Values

__all__ = ["MOST_SAMPLES", "is_geotiff", "is_netcdf", "read_depths"]

GEOTIFF: Final = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
NETCDF: Final = (b"CDF\1", b"CDF\2", b"CDF\5", b"\x89HDF\r\n\x1a\n")
"""How files begin: TIFF and BigTIFF; NetCDF 3 and, as HDF5, 4."""

MOST_CELLS: Final = 4_194_304
"""Cells of a raster that are contoured at once; of more, every second one, third one and so on is read."""

MOST_SAMPLES: Final = 256
"""Samples of a grid of depths on its longer side."""

FARTHEST: Final = 12_000.0
"""Metres. Depths and heights beyond it are none: files without a fill value write -9999 or 1e37."""

MISSING: Final = (-999.0, -9999.0)
"""And these."""

NEAR: Final = 1.5
"""Cells. A frame that ends so near to the raster's border, or before it, has water beyond as there is at the border."""


def is_geotiff(start: bytes) -> bool:
    """Whether a file that begins like this is a GeoTIFF.

    Examples
    --------
    >>> is_geotiff(b"II*\\0...."), is_geotiff(b"CDF\\1")
    (True, False)
    """
    return start.startswith(GEOTIFF)


def is_netcdf(start: bytes) -> bool:
    """Whether a file that begins like this is NetCDF.

    Examples
    --------
    >>> is_netcdf(b"CDF\\1....")
    True
    """
    return start.startswith(NETCDF)


@gis_packages()
def read_depths(
    source: bytes | str | os.PathLike[str],
    file_name: str,
    *,
    frame: Frame | None = None,
    bounds: Bounds | None = None,
    crs: str | None = None,
    time_dim: str | None = None,
    hmin: float = HMIN,
    variable: str | None = None,
) -> Extent:
    """Read where water is from depths: GeoTIFF, NetCDF on rows and columns, or a UGRID mesh.

    Parameters
    ----------
    source : bytes or path
        Content of the file, or where it is.
    file_name : str
        Names it in messages.
    frame : Frame, optional
        Where the drawings stand; without one, a new one around the bounds.
    bounds : tuple of float, optional
        West, south, east, north in the file's reference system (or `crs`); without them, all of the file.
    crs : str, optional
        Reference system, in place of the file's.
    time_dim : str, optional
        Dimension that is time; without it, the one that looks like time, if there is one. With any name, the bands
        of a GeoTIFF are steps.
    hmin : float
        Metres; under less water, the ground counts as dry.
    variable : str, optional
        Which variable, or band.

    Raises
    ------
    SourceError, LimitError
        If it cannot be read; one line that names the file.
    """
    if not hmin > 0.0 or not np.isfinite(hmin):
        raise LimitError(f"hmin is {hmin:g} m; it must be above 0")
    name = Path(file_name).stem or "flood"
    try:
        with _opened(source, time_dim, variable) as series:
            return _extent(series, name, frame, bounds, crs, hmin)
    except VextureError as error:
        raise type(error)(f"{file_name}: {error}") from None


@contextmanager
def _opened(source: bytes | str | os.PathLike[str], time_dim: str | None, variable: str | None) -> Iterator[Series]:
    """Open a file by how it begins."""
    start = source[:16] if isinstance(source, bytes) else _start(source)
    if is_geotiff(start):
        from vexture.sources.rasters import open_geotiff

        with open_geotiff(source, time_dim, variable) as series:
            yield series
    elif is_netcdf(start):
        from vexture.sources.netcdf import opened, series_of

        with opened(source) as dataset:
            yield series_of(dataset, time_dim, variable)
    else:
        raise SourceError("it is neither GeoTIFF nor NetCDF; write it as one of them")


def _start(path: str | os.PathLike[str]) -> bytes:
    try:
        with open(path, "rb") as file:
            return file.read(16)
    except OSError as error:
        raise SourceError(f"it cannot be opened: {error.strerror}") from None


def _extent(
    series: Series, name: str, frame: Frame | None, bounds: Bounds | None, crs: str | None, hmin: float
) -> Extent:
    """All steps of a series in one frame."""
    system = reference(crs, series.crs)
    if frame is None:
        frame = frame_around(bounds or _whole(series.lattice.box, system), system)
    lattice = _turned(series.lattice, system, frame)
    square = transformed_bounds(_square(frame), frame.crs, system)
    rows, columns = _window(lattice, square, frame, system)
    whole = (rows.stop - rows.start, columns.stop - columns.start) == lattice.shape
    near = lattice.cut(rows, columns)
    inverse = _Inverse(near, system, frame)
    beyond = inverse.beyond()
    steps, bed, seen = [], None, False
    for number, time in enumerate(series.times):
        depth, ground = (_plausible(values) for values in series.read(number, rows, columns))
        if depth is None or not np.isfinite(depth).any():
            if whole:
                raise SourceError(
                    f"variable {series.variable!r} holds no number at step {number + 1} of {len(series.times)}; "
                    "write depths, 0 where it is dry"
                )
            depth = np.zeros(near.shape)
        else:
            seen = True
        drawing = wet_drawing(shored(depth, hmin, ground), inverse.to_unit, beyond)
        drawing = replace(drawing, to_source=frame.to_source, name=name, crs=frame.crs)
        steps.append(Step(drawing, time, inverse.grid(np.where(depth < 0.0, 0.0, depth))))
        if bed is None and ground is not None:
            bed = inverse.grid(ground)
    if not seen:
        raise SourceError(
            f"variable {series.variable!r} holds no number within the bounds; write depths, 0 where it is dry"
        )
    return Extent(frame, tuple(steps), bed)


def _whole(box: Bounds, system: str) -> Bounds:
    """Box of a raster, its longitudes as people write them if it does not cross the antimeridian."""
    turn = period(system)
    if turn and box[0] >= turn / 2:
        return (box[0] - turn, box[1], box[2] - turn, box[3])
    return box


def _turned(lattice: Lattice, system: str, frame: Frame) -> Lattice:
    """Lattice, so many turns around the world that it meets the frame."""
    turn = period(system)
    square = transformed_bounds(frame.bounds, frame.crs, system)
    if not turn or square is None:
        return lattice
    turns = [lattice.moved(k * turn) for k in (0, -1, 1)]
    return max(turns, key=lambda moved: min(moved.box[2], square[2]) - max(moved.box[0], square[0]))


def _square(frame: Frame) -> Bounds:
    """Unit square in the units of the frame's system."""
    (west, south), (east, north) = (frame.to_source @ (corner, corner, 1.0) for corner in (0.0, 1.0))
    return (float(west), float(south), float(east), float(north))


def _window(lattice: Lattice, square: Bounds | None, frame: Frame, system: str) -> tuple[slice, slice]:
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
            f"it covers {shown_bounds(lattice.box, system)}; give other --bounds"
        )
    (c0, r0), (c1, r1) = found
    stride = int(np.ceil(np.sqrt((r1 - r0) * (c1 - c0) / MOST_CELLS)))
    if stride > 1:
        warnings.warn(
            SourceWarning(
                f"{r1 - r0:,} x {c1 - c0:,} cells are too many: one in {stride} x {stride} was read; "
                "give smaller --bounds for all of them"
            ),
            stacklevel=2,
        )
    return slice(int(r0), int(r1), stride), slice(int(c0), int(c1), stride)


def _plausible(values: Values | None) -> Values | None:
    """Values without those that cannot be depths or heights."""
    if values is None:
        return None
    with np.errstate(invalid="ignore"):
        absurd = (np.abs(values) > FARTHEST) | np.isin(values, MISSING)
    return np.where(absurd, np.nan, values)


class _Inverse:
    """From positions in a lattice to the unit square of a frame, and back."""

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
        width, height = self._frame.metres
        columns, rows = (max(1, round(MOST_SAMPLES * side / max(width, height))) for side in (width, height))
        x0, y0, x1, y1 = self._frame.box
        u = x0 + (x1 - x0) * (np.arange(columns) + 0.5) / columns
        v = y1 + (y0 - y1) * (np.arange(rows) + 0.5) / rows
        places = np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 2)
        found = self.positions(places)
        inside = np.isfinite(found).all(axis=1) & (found >= -0.5 - NEAR).all(axis=1)
        inside &= (found <= np.array(values.shape[::-1]) - 0.5 + NEAR).all(axis=1)
        nearest = np.rint(np.where(inside[:, None], found, 0.0)).astype(int)
        nearest = np.clip(nearest, 0, np.array(values.shape[::-1]) - 1)
        taken = values[nearest[:, 1], nearest[:, 0]]
        return np.where(inside, taken, np.nan).reshape(rows, columns).astype(np.float32)
