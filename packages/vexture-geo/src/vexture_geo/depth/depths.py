"""Read rasters and meshes of water depths as an `Extent`."""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from math import isclose
from pathlib import Path
from typing import Any, Final, TypedDict

import numpy as np
from numpy.typing import NDArray

from vexture.base.content import GRIB, NETCDF, TIFF, start_of, unpack_source
from vexture.base.errors import ParameterError, SourceError
from vexture.base.notes import Note, Notes
from vexture.base.tolerance import HMIN
from vexture.base.workers import InProcess, Workers
from vexture.drawing.drawing import Drawing
from vexture_geo.base.coordinate_units import refuse_other_units
from vexture_geo.base.crs import choose_crs, frame_of, gis_packages, period
from vexture_geo.base.datasets import is_dataset
from vexture_geo.base.depth_ranges import DepthRange, format_range, wet_ranges
from vexture_geo.base.extent import Bounds, DepthClasses, Extent, Frame, Step
from vexture_geo.base.foreign import refuse_foreign_dataset
from vexture_geo.depth.esri_grids import is_esri_text, refuse_marked
from vexture_geo.depth.mesh import MeshInFrame, MeshSeries
from vexture_geo.depth.raster import RasterInFrame
from vexture_geo.depth.series import Meaning, Reading, Series, Values

MARKS: Final = (0.0, 1.0, 255.0)
"""Numbers of masks: 0 is dry and 1 is wet; 255 is wet if there is no 1, and otherwise unknown."""

MOST_CLASSES: Final = 8
"""Most classes that a map shows unchanged; some of more classes are joined."""

SAME: Final = 1e-6
"""Metres by which equal limits of classes may differ."""


@dataclass(frozen=True, slots=True)
class WaterRanks:
    """Ranks of numbers: 0 where it is dry or unknown, 1 for the first of the `ranges`, or for a mask's water.

    `wet` is the first number of water, and `mark` the only number of water in a mask. `leasts` are the ranks at which
    areas begin: that of all water, and those of the `contours`.
    """

    wet: float
    mark: float | None = None
    ranges: tuple[DepthRange, ...] = ()
    contours: tuple[float, ...] = ()
    leasts: tuple[int, ...] = (1,)

    def ranks(self, values: Values) -> Values:
        """Convert the numbers of a step to ranks."""
        if self.mark is not None:
            return np.where(values == self.mark, 1.0, 0.0)
        return np.where(np.isfinite(values), np.maximum(values - self.wet + 1.0, 0.0), 0.0)


def water_ranks(
    meaning: Meaning, steps: Iterable[Values], hmin: float, depths: Sequence[float], notes: Notes
) -> WaterRanks | None:
    """Interpret numbers that are not depths; return None if they are depths.

    `steps` are the values of all times, read only as far as needed. Notes receive what was chosen. Raises a
    `SourceError` if the numbers do not describe water.
    """
    if meaning.ranges:
        return _of_classes(meaning.ranges, hmin, depths, notes)
    if meaning.has_unit and not meaning.are_colors:
        return None
    marks = _marks(steps)
    if marks:
        mark = 1.0 if 1.0 in marks else 255.0
        notes.remark(
            f"its numbers are only {_list_numbers(sorted({0.0, *marks}))}: {mark:g} is read as water of no known "
            "depth; if they are depths, write their unit into the file, such as m"
        )
        return WaterRanks(mark, mark=mark)
    if meaning.are_colors:
        raise SourceError(
            "its numbers are those of colours, and no depths; give depths in metres, or a mask of 0 and 1; a picture "
            "is shown under the water by `ground`"
        )
    if meaning.are_whole:
        notes.remark(
            "it holds whole numbers without a unit, taken as metres; if they are centimetres or classes, write their "
            "unit, or flag_values and flag_meanings, into the file"
        )
    return None


def _marks(steps: Iterable[Values]) -> set[float]:
    """Numbers of a mask except 0; empty if it is not a mask."""
    found: set[float] = set()
    for values in steps:
        known = values[np.isfinite(values)]
        if not np.isin(known, MARKS).all():
            return set()
        found |= {mark for mark in MARKS[1:] if (known == mark).any()}
    return found


def _of_classes(ranges: tuple[DepthRange, ...], hmin: float, depths: Sequence[float], notes: Notes) -> WaterRanks:
    """Make ranks of classes of water."""
    wet = wet_ranges(ranges, hmin)
    if not wet:
        told = ", ".join(map(format_range, ranges))
        raise SourceError(f"its classes ({told}) are all below `hmin`, {hmin:g} m; choose a smaller one")
    dry = len(ranges) - len(wet)
    wet_from = float(dry + 1)
    if len(wet) == 1 and wet[0].low <= 0.0:
        notes.remark("it says where it is wet, and no depths")
        return WaterRanks(wet_from)
    notes.remark(
        f"it holds classes of depth, from {format_range(wet[0])} to {format_range(wet[-1])}: depths are ranges"
    )
    if dry and ranges[dry - 1].high > hmin:
        notes.remark(f"its class {format_range(ranges[dry - 1])} holds dry ground too, and counts as dry")
    if wet[0].low < hmin:
        notes.remark(f"its class {format_range(wet[0])} counts as water, with `hmin` {hmin:g} m in it")
    lows = [one.low for one in wet]
    inner = lows[1:]
    contours = [low for low in inner if any(isclose(low, depth, abs_tol=SAME) for depth in depths)]
    if len(contours) < len(depths):
        if len(wet) <= MOST_CLASSES:
            contours = inner
        elif not contours:
            contours = [inner[len(inner) * k // MOST_CLASSES] for k in range(1, MOST_CLASSES)]
        notes.remark(f"maps of its classes have borders at {_list_numbers(contours)} m, where the file has them")
    return WaterRanks(wet_from, None, wet, tuple(contours), (1, *(1 + lows.index(contour) for contour in contours)))


def _list_numbers(numbers: Sequence[float]) -> str:
    """Format numbers for a sentence."""
    told = [f"{number:g}" for number in numbers]
    return told[0] if len(told) == 1 else f"{', '.join(told[:-1])} and {told[-1]}"


@gis_packages()
def read_depths(
    source: Any,
    file_name: str,
    *,
    frame: Frame | None = None,
    bounds: Bounds | None = None,
    crs: str | None = None,
    time_dim: str | None = None,
    hmin: float = HMIN,
    variable: str | None = None,
    depths: Sequence[float] = (),
    workers: Workers | None = None,
) -> Extent:
    """Read water from a GeoTIFF, GRIB, NetCDF or xarray, on rows and columns, straight or not, or on a mesh.

    A file named like a partition of D-Flow FM, ``run_0000_map.nc``, is read with all other partitions of its run. See
    `vexture.read_extent` for parameters and errors.
    """
    with depths_in_frame(
        source, file_name, frame=frame, bounds=bounds, crs=crs, time_dim=time_dim, hmin=hmin, variable=variable,
        depths=depths,
    ) as placed:  # fmt: skip
        return _extent(placed, workers or InProcess())


class DepthsInFrame:
    """An open file of depths in a frame: the values at each time, and the steps made of them."""

    def __init__(
        self,
        series: Series | MeshSeries,
        name: str,
        system: str,
        frame: Frame,
        hmin: float,
        depths: tuple[float, ...],
        notes: Notes,
    ) -> None:
        self._placed: MeshInFrame | RasterInFrame
        if isinstance(series, MeshSeries):
            self._placed = MeshInFrame(series, system, frame)
        else:
            self._placed = RasterInFrame(series, system, frame, notes)
        self.frame, self.times, self.variable = frame, series.times, series.variable
        self._name, self._hmin, self._depths, self._notes = name, hmin, depths, notes
        readings = (self._placed.read(number).plausible.depth for number in range(len(self.times)))
        self._told: WaterRanks | None = water_ranks(series.meaning, readings, hmin, depths, notes)

    @property
    def notes(self) -> tuple[Note, ...]:
        """Notes so far on what was left out, simplified or chosen."""
        return self._notes.in_order

    def values(self, number: int) -> Reading:
        """Read the values at a time near the frame."""
        return self._placed.read(number).plausible

    def step(self, number: int, reading: Reading) -> Step:
        """Make the step of some values."""
        depth, bed, speed = reading
        if self._told is not None:
            return self._ranks_step(number, depth, self._told)
        drawing, *deeper = self._place_in_frame(self._placed.drawings(depth, bed, self._hmin, self._depths))
        over = self.grid(np.where(depth < 0.0, 0.0, depth))
        if bed is not None:  # the same level above the page's heights gives another depth
            over = np.where(over > 0.0, np.maximum(over + self.grid(bed) - self.heights(bed), 0.0), over)
        return Step(drawing, self.times[number], over, tuple(deeper), None if speed is None else self.grid(speed))

    def _ranks_step(self, number: int, values: Values, water: WaterRanks) -> Step:
        """Make a step from numbers that give the class of water at each place, but no depth."""
        areas: list[Drawing] = []
        ranks = water.ranks(values)
        wet = [ranks >= least for least in water.leasts]
        for at, marked in enumerate(wet):
            same = at > 0 and np.array_equal(marked, wet[at - 1])
            areas.append(areas[-1] if same else self._placed.drawings(np.where(marked, 1.0, 0.0), None, 0.5, ())[0])
        drawing, *deeper = self._place_in_frame(areas)
        classes = None
        if water.ranges:
            over = [self.grid(np.where(ranks >= rank, 1.0, 0.0)) >= 0.5 for rank in range(1, len(water.ranges) + 1)]
            classes = DepthClasses(water.ranges, np.sum(over, axis=0, dtype=np.uint8), water.contours)
        return Step(drawing, self.times[number], deeper=tuple(deeper), classes=classes)

    def _place_in_frame(self, areas: list[Drawing]) -> list[Drawing]:
        return [
            replace(area, to_source=self.frame.to_source, name=self._name, crs=self.frame.crs, notes=self.notes)
            for area in areas
        ]

    def grid(self, values: Values) -> NDArray[np.float32]:
        """Resample values over the frame, the northernmost row first."""
        return self._placed.grid(values)

    def heights(self, bed: Values) -> NDArray[np.float32]:
        """Resample heights like `grid`, but smoothly where cells are wide."""
        return self._placed.heights(bed)

    def without_numbers(self) -> SourceError:
        """Make the error for a file without a number at any time."""
        when = "" if len(self.times) == 1 else f" at any of {len(self.times)} steps"
        return SourceError(
            f"variable {self.variable!r} holds no number within the bounds{when}; write depths, 0 where it is dry"
        )


class DepthOptions(TypedDict, total=False):
    """Parameters of `read_depths` that choose what of a file is water."""

    crs: str | None
    time_dim: str | None
    hmin: float
    variable: str | None
    depths: Sequence[float]


@contextmanager
def depths_in_frame(
    source: Any,
    file_name: str,
    *,
    frame: Frame | None,
    bounds: Bounds | None,
    crs: str | None = None,
    time_dim: str | None = None,
    hmin: float = HMIN,
    variable: str | None = None,
    depths: Sequence[float] = (),
) -> Iterator[DepthsInFrame]:
    """Open a file of depths in a frame, by default a new one around `bounds`; see `read_depths`."""
    if not hmin > 0.0 or not np.isfinite(hmin):
        raise ParameterError(f"`hmin` is {hmin:g} m; it must be above 0")
    for depth in depths:
        if not depth > hmin or not np.isfinite(depth):
            raise ParameterError(f"`depths` holds {depth:g} m; all must be above `hmin`, {hmin:g} m")
    notes = Notes()
    with _open_series(source if is_dataset(source) else unpack_source(source), time_dim, variable, notes) as series:
        system = choose_crs(crs, series.crs)
        refuse_other_units(system, series.crs, series.unit, series.box, is_given=crs is not None)
        if frame is None:
            frame = frame_of(bounds, _whole(series.box, system), system)
        yield DepthsInFrame(series, Path(file_name).stem or "flood", system, frame, hmin, tuple(depths), notes)


@contextmanager
def _open_series(
    source: Any, time_dim: str | None, variable: str | None, notes: Notes
) -> Iterator[Series | MeshSeries]:
    """Open a file of the format that its first bytes show, or a dataset of xarray."""
    start = b"" if is_dataset(source) else start_of(source)
    if is_dataset(source):
        from vexture_geo.depth.netcdf import open_dataset

        with open_dataset(source, time_dim) as dataset:
            yield _series_of(dataset, time_dim, variable, notes)
    elif start.startswith(TIFF) or _is_esri_grid(start, source):
        from vexture_geo.depth.geotiff import open_geotiff

        with open_geotiff(source, time_dim, variable, notes) as series:
            yield series
    elif start.startswith(NETCDF):
        from vexture_geo.depth.netcdf import open_dataset
        from vexture_geo.depth.partitions import open_partitions, partitions_beside

        partitions = [] if isinstance(source, bytes) else partitions_beside(Path(source))
        if partitions:
            with open_partitions(partitions, time_dim, variable, notes) as run:
                yield run
            return
        with open_dataset(source, time_dim) as dataset:
            yield _series_of(dataset, time_dim, variable, notes)
    elif start.startswith(GRIB):
        from vexture_geo.depth.grib import open_fields
        from vexture_geo.depth.netcdf import open_dataset

        with open_fields(source, variable, notes) as fields, open_dataset(fields, time_dim) as dataset:
            yield _series_of(dataset, time_dim, variable, notes)
    elif not start:
        raise SourceError("it cannot be opened or is empty; choose another file")
    else:
        raise SourceError("it is none of GeoTIFF, NetCDF, GRIB and grids of Esri (.asc, .flt); write it as one of them")


def _is_esri_grid(start: bytes, source: Any) -> bool:
    """Return whether a file is a grid of Esri: text, or numbers that only its name identifies."""
    refuse_marked(start)
    if is_esri_text(start):
        return True
    named = "" if isinstance(source, bytes) else Path(source).suffix.lower()
    return bool(start) and named == ".flt" and not start.startswith(NETCDF)


def _series_of(dataset: Any, time_dim: str | None, variable: str | None, notes: Notes) -> Series | MeshSeries:
    """Read the depths of an open dataset on its kind of grid or mesh."""
    from vexture_geo.depth.curvilinear import grid_series, places_of_grid
    from vexture_geo.depth.netcdf import series_of
    from vexture_geo.depth.ugrid import holds_mesh, mesh_series

    if holds_mesh(dataset):
        return mesh_series(dataset, time_dim, variable, notes)
    refuse_foreign_dataset(dataset)
    grids = places_of_grid(dataset, time_dim)
    if grids:
        return grid_series(dataset, grids, time_dim, variable, notes)
    return series_of(dataset, time_dim, variable, notes)


def _extent(placed: DepthsInFrame, workers: Workers) -> Extent:
    """Make all steps of a file: this process reads the values, and workers make steps of them."""
    bed, seen = None, False

    def values() -> Iterator[tuple[int, Reading]]:
        nonlocal bed, seen
        for number in range(len(placed.times)):
            reading = placed.values(number)
            if bed is None and reading.bed is not None:
                bed = placed.heights(reading.bed)
            seen = seen or bool(np.isfinite(reading.depth).any())
            yield number, reading

    steps = tuple(workers.map(_step, placed, values(), len(placed.times)))
    if not seen:
        raise placed.without_numbers()
    return Extent(placed.frame, steps, bed, placed.notes)


def _step(placed: DepthsInFrame, values: tuple[int, Reading]) -> Step:
    return placed.step(*values)


def _whole(box: Bounds, system: str) -> Bounds:
    """Move a raster's box to longitudes up to half a turn if it does not cross the antimeridian."""
    turn = period(system)
    if turn and turn / 2 <= box[0] <= turn:  # larger numbers are no degrees, and are reported as in the file
        return (box[0] - turn, box[1], box[2] - turn, box[3])
    return box
