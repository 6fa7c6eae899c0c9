"""Depths on the rows and columns of a NetCDF file, at one time or at several."""

import os
import re
import warnings
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from datetime import UTC, datetime
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Final

import numpy as np

from vexture.base.errors import LimitError, ParameterError, SourceError
from vexture.base.notes import Notes
from vexture_geo.base.crs import system
from vexture_geo.base.damage import netcdf_error
from vexture_geo.base.datasets import dataset_of, is_dataset
from vexture_geo.base.file_references import refuse_files_of_system
from vexture_geo.base.foreign import refuse_foreign_hdf5
from vexture_geo.base.hdf5 import refuse_links_of_netcdf
from vexture_geo.base.lengths import NO_UNIT, metres_in
from vexture_geo.base.time_texts import rising_moments
from vexture_geo.depth.series import Lattice, Reading, Series, Values
from vexture_geo.depth.speeds import speed_of
from vexture_geo.depth.variables import depths_of, list_names, load_values, refuse_layers, time_axis, unit_of

EAST: Final = {"x", "lon", "longitude", "easting", "xc", "mx", "m", "column", "columns", "col"}
NORTH: Final = {"y", "lat", "latitude", "northing", "yc", "my", "n", "row", "rows"}
LATITUDES: Final = {"degrees_north", "degree_north", "degrees_n", "degree_n"}
LONGITUDES: Final = {"degrees_east", "degree_east", "degrees_e", "degree_e"}

MOST_STEPS: Final = 1000

OURS: Final = frozenset({"standard", "gregorian", "proleptic_gregorian"})
JULIAN: Final = "julian"
"""Calendars, in lower case: names of the Gregorian one, and one with valid dates that mean other days."""

SINCE: Final = "write 'hours since 2026-01-01' or the like"

UNSAID: Final = re.compile(r"-|(EPSG:)?(nan|none|0)?", re.IGNORECASE)
"""Texts that models write for an unknown reference system."""

UNNAMED: Final = re.compile(r"\W+")
"""Characters that names of grid mappings never contain, unlike texts for pyproj."""

LEAST_CODE: Final = 1024
"""Least code of EPSG. A smaller number in a variable of a reference system only carries its attributes."""


@contextmanager
def open_dataset(source: Any, time_dim: str | None) -> Iterator[Any]:
    """Open a file or its content with xarray, without decoding times; a dataset that is already open stays open."""
    with ExitStack() as stack:
        dataset = dataset_of(source) if is_dataset(source) else stack.enter_context(_file(source, stack))
        if time_dim is not None and time_dim not in dataset.dims:
            raise ParameterError(
                f"there is no dimension {time_dim!r}; it has {list_names(dataset.dims)}; choose another `time_dim`"
            )
        yield dataset


def _file(source: bytes | str | os.PathLike[str], stack: ExitStack) -> Any:
    """Open a file, or content that is written to a temporary file for as long as the stack is open."""
    import xarray

    place = os.path.abspath(source) if not isinstance(source, bytes) else ""
    if isinstance(source, bytes):
        try:
            place = os.path.join(stack.enter_context(TemporaryDirectory(prefix="vexture-")), "depths.nc")
            Path(place).write_bytes(source)
        except OSError as error:
            here = os.path.dirname(os.path.dirname(place)) or "all usual folders"
            raise OSError(error.errno, error.strerror, f"temporary files in {here} (TMPDIR)") from None
    refuse_links_of_netcdf(place)
    refuse_foreign_hdf5(place)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return xarray.open_dataset(
                place, engine="netcdf4", decode_times=False, cache=False, drop_variables=_counts(place)
            )
    except Exception as error:  # xarray and netCDF4 raise any type of exception for a damaged file
        raise netcdf_error(error, place) from None


def _counts(place: str) -> list[str]:
    """List scalars named like a dimension, as ADCIRC writes, because xarray allows only coordinates there."""
    import netCDF4

    with netCDF4.Dataset(place) as file:
        return [name for name, variable in file.variables.items() if name in file.dimensions and not variable.ndim]


def series_of(dataset: Any, time_dim: str | None, variable: str | None, notes: Notes) -> Series:
    """Read depths of an open dataset on rows and columns; `ParameterError` if `variable` holds none."""
    grids = {str(name): axes for name in dataset.data_vars if (axes := axes_of(dataset, name, time_dim))}
    name, depth, bed, meaning = depths_of(dataset, list(grids), variable, notes)
    time, north, east = grids[name]
    x, y = (_axis(dataset, dim) for dim in (east, north))
    times = times_of(dataset, time, notes)
    refuse_layers(dataset, name, (time, north, east))

    speed = speed_of(dataset, name, (north, east), time)

    def read(step: int, rows: slice, columns: slice) -> Reading:
        places, order = {time: step, north: rows, east: columns}, (north, east)
        return Reading(depth(places, order), *(one(places, order) if one else None for one in (bed, speed)))

    along = [_along(dataset, dim) for dim in (east, north)]
    crs = crs_of(dataset, name, along)
    across, up = (_in_system(one, crs) for one in along)
    lattice = Lattice(x, y, np.array([[across, 0.0, 0.0], [0.0, up, 0.0]]))
    return Series(lattice, crs, name, times, read, meaning, unit_of(along[0]))


def _in_system(along: Any, crs: str | None) -> float:
    """Units of a reference system per unit of a coordinate; 1 if the coordinate names no length.

    If the file's system is not known, the user's applies, which is assumed to be in metres.
    """
    own = None if unit_of(along).lower() in NO_UNIT else metres_in(unit_of(along))
    if own is None:
        return 1.0
    try:
        found = None if crs is None else system(crs)
    except ParameterError:  # raised again where the system is chosen
        found = None
    if found is None:
        return own
    return 1.0 if found.is_geographic else own / float(found.axis_info[0].unit_conversion_factor)


def axes_of(dataset: Any, name: Any, time_dim: str | None) -> tuple[str | None, str, str] | None:
    """Dimensions of time, north and east of a variable; None if it cannot hold depths."""
    variable = dataset[name]
    if variable.dtype.kind not in "iuf":
        return None
    time = time_axis(dataset, variable.dims, time_dim)
    others = [str(dim) for dim in variable.dims if dim != time]
    east = [dim for dim in others if _points(dataset, dim, EAST, "x", LONGITUDES)]
    north = [dim for dim in others if _points(dataset, dim, NORTH, "y", LATITUDES)]
    if len(east) == 1 and len(north) == 1 and east != north:
        return time, north[0], east[0]
    if len(others) >= 2 and not east and not north and all(_along(dataset, dim) is not None for dim in others[-2:]):
        return time, others[-2], others[-1]
    return None


def points_east(coordinate: Any) -> bool:
    """Return whether a coordinate lies along the x axis."""
    return _says(coordinate.attrs, "x", LONGITUDES)


def points_north(coordinate: Any) -> bool:
    """Return whether a coordinate lies along the y axis."""
    return _says(coordinate.attrs, "y", LATITUDES)


def _points(dataset: Any, dim: str, names: set[str], axis: str, units: set[str]) -> bool:
    """Return whether a dimension lies along the axis "x", east, or "y", north."""
    along = _along(dataset, dim)
    return dim.lower() in names or _says({} if along is None else along.attrs, axis, units)


def _says(about: Any, axis: str, units: set[str]) -> bool:
    """Return whether a coordinate lies along an axis by its attributes."""
    standard = f"projection_{axis}_coordinate", f"grid_{'longitude' if axis == 'x' else 'latitude'}"
    return (
        str(about.get("axis", "")).lower() == axis
        or about.get("standard_name") in (*standard, "longitude" if axis == "x" else "latitude")
        or str(about.get("units", "")).lower() in units
    )


def _along(dataset: Any, dim: str) -> Any:
    """Return the coordinate of a dimension: the one with its name, or else the only one along it."""
    if dim in dataset.variables:
        return dataset[dim]
    found = [
        dataset[name] for name in dataset.coords if dataset[name].dims == (dim,) and dataset[name].dtype.kind in "iuf"
    ]
    return found[0] if len(found) == 1 else None


def _axis(dataset: Any, dim: str) -> Values:
    """Read the places of samples along a dimension, rising or falling."""
    along = _along(dataset, dim)
    if along is None or along.ndim != 1:
        raise SourceError(
            f"dimension {dim!r} has no coordinates; write them into the file: along it, or two for each cell"
        )
    places: Values = load_values(along).astype(np.float64)
    if not np.isfinite(places).all():
        raise SourceError(
            f"coordinate {along.name!r} is not finite at position {int(np.argmin(np.isfinite(places))) + 1}"
        )
    if str(along.attrs.get("units", "")).lower() in LONGITUDES and (np.abs(np.diff(places)) > 180.0).sum() == 1:
        places = np.unwrap(places, period=360.0)  # across the antimeridian
    sign = np.sign(np.diff(places))
    if len(places) == 0 or (sign == 0).any() or (sign != sign[:1]).any():
        wrong = int(np.argmax(sign != (sign[0] or 1))) + 2 if len(sign) else 1
        raise SourceError(
            f"coordinate {along.name!r} neither rises nor falls throughout: see position {wrong}; "
            f"sort it: xarray's sortby({along.name!r})"
        )
    return places


def times_of(dataset: Any, dim: str | None, notes: Notes) -> tuple[datetime | None, ...]:
    """Read the times of steps along a dimension, None if the file has no dates; one step without a dimension.

    A note describes what the file has in place of dates.
    """
    import xarray

    if dim is None:
        return (None,)
    count = int(dataset.sizes[dim])
    if count == 0:
        raise SourceError(f"dimension {dim!r} has no steps; write at least one")
    if count > MOST_STEPS:
        raise LimitError(f"dimension {dim!r} has {count:,} steps; the limit is {MOST_STEPS:,}; write fewer")
    if dim not in dataset.variables or dataset[dim].ndim != 1 or dataset[dim].dtype.kind not in "iuf":
        return _written_times(dataset, dim, count, notes)
    places = load_values(dataset[dim]).astype(np.float64)
    if not np.isfinite(places).all():
        missing = int(np.argmin(np.isfinite(places))) + 1
        raise SourceError(
            f"the time axis {dim!r} has no time at step {missing} (counted from 1); write one for each step, or leave "
            f"such steps out: xarray's dropna({dim!r})"
        )
    step = np.diff(places)
    if not (step > 0.0).all():
        wrong = int(np.argmin(step > 0.0)) + 1
        how = "the same time as" if step[wrong - 1] == 0.0 else "before"
        remedy = "drop_duplicates" if step[wrong - 1] == 0.0 else "sortby"
        raise SourceError(
            f"the time axis {dim!r} is out of order: step {wrong + 1} is {how} step {wrong} (counted from 1); "
            f"write it in order: xarray's {remedy}({dim!r})"
        )
    unit, calendar = unit_of(dataset[dim]), str(dataset[dim].attrs.get("calendar", "standard"))
    if " since " not in unit:
        return _number_steps(count, f"{dim!r} is in {unit!r}, since no date" if unit not in ("", "1") else "", notes)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            decoded = xarray.decode_cf(xarray.Dataset(coords={dim: dataset[dim].variable}))[dim].values
        found = tuple(_moment(time) for time in decoded)
    except Exception:  # a calendar without such a date, or text that is no date
        if calendar.lower() in OURS:
            return _number_steps(count, f"{dim!r} has dates that are none of ours ({unit!r})", notes)
        why = f"{dim!r} has dates that are none of ours, by its calendar {calendar!r}"
        return _number_steps(
            count, why, notes, "write times of the calendar 'standard', as xarray's convert_calendar does"
        )
    if calendar.lower() == JULIAN:
        notes.remark(
            f"{dim!r} has dates of the calendar {calendar!r}, 13 days before ours in this century, left as they are"
        )
    return found


def _written_times(dataset: Any, dim: str, count: int, notes: Notes) -> tuple[datetime | None, ...]:
    """Read times that a file stores as texts along a dimension."""
    if dim not in dataset.variables or dataset[dim].ndim != 1 or dataset[dim].dtype.kind not in "SUO":
        return (None,) * count
    texts = [one.decode(errors="replace") if isinstance(one, bytes) else str(one) for one in load_values(dataset[dim])]
    return rising_moments(texts) or _number_steps(
        count, f"{dim!r} holds texts that are no times ({list_names(texts)})", notes
    )


def _number_steps(count: int, reason: str, notes: Notes, remedy: str = SINCE) -> tuple[None, ...]:
    """Number steps without dates; if there are several and the file describes their times, a note gives the reason."""
    if count > 1 and reason:
        notes.remark(f"its steps are numbered: {reason}; {remedy}")
    return (None,) * count


def _moment(time: Any) -> datetime:
    """Convert a time of numpy or of cftime to datetime, in UTC."""
    if isinstance(time, np.datetime64):
        return datetime.fromtimestamp(float(time.astype("datetime64[us]").astype(np.int64)) / 1e6, UTC)
    return datetime(time.year, time.month, time.day, time.hour, time.minute, time.second, time.microsecond, UTC)


def crs_of(dataset: Any, name: str, coordinates: list[Any]) -> str | None:
    """Reference system that a file names, as text for pyproj; an unknown system gives a text that pyproj rejects."""
    from pyproj import CRS

    mappings = [dataset[name].attrs.get("grid_mapping"), dataset[name].encoding.get("grid_mapping")]
    named = [str(text).split(":")[0].split()[0] for text in mappings if text]
    named += ["spatial_ref", "crs", "projected_coordinate_system", "wgs84"]
    known = [dataset[key] for key in named if key in dataset.variables]
    for about in [variable.attrs for variable in known] + [dataset.attrs]:
        for key in ("crs_wkt", "spatial_ref", "epsg_code", "EPSG_code", "epsg", "proj4_params", "proj4", "crs", "EPSG"):
            text = str(about.get(key, ""))
            if text not in ("", "0") and UNSAID.fullmatch(text) is None:
                return f"EPSG:{text}" if text.isdigit() else text
        if about.get("grid_mapping_name"):
            for key, text in about.items():
                if str(key).endswith("_name"):  # pyproj also takes names of datums and ellipsoids for systems
                    refuse_files_of_system(str(text))
            try:
                return str(CRS.from_cf(dict(about)).to_wkt())
            except Exception:  # pyproj raises any type of exception for invalid attributes
                return f"grid_mapping_name={UNNAMED.sub('_', str(about['grid_mapping_name']))}"
    numbers = [int(load_values(one)) for one in known if one.ndim == 0 and one.dtype.kind in "iu"]
    if any(number >= LEAST_CODE for number in numbers):
        return f"EPSG:{max(numbers)}"
    degrees = [
        about is not None
        and (about.attrs.get("standard_name") == kind or str(about.attrs.get("units", "")).lower() in units)
        for about, kind, units in zip(coordinates, ("longitude", "latitude"), (LONGITUDES, LATITUDES), strict=True)
    ]
    return "EPSG:4326" if all(degrees) else None
