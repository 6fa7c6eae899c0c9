"""Depths on the rows and columns of a NetCDF file, at one time or at several."""

import os
import tempfile
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from typing import Any, Final

import numpy as np

from vexture.errors import LimitError, SourceError
from vexture.geo.lattice import Lattice
from vexture.geo.series import Series, Values

__all__ = [
    "check_dimension", "crs_of", "depths_of", "line_of", "listed", "opened", "read_variable", "series_of",
    "time_axis", "times_of",
]  # fmt: skip

DEPTHS: Final = (
    {"depth", "waterdepth", "wd", "h", "hs", "hh", "flooddepth", "inundationdepth", "mesh2dwaterdepth", "hmax"},
    {
        "water_depth",
        "sea_floor_depth_below_sea_surface",
        "flood_water_thickness",
        "depth",
        "water_depth_at_cell_center",
    },
)
"""Names, in small letters without ``_``, and standard names of depths of water."""

LEVELS: Final = (
    {
        "waterlevel",
        "wl",
        "level",
        "zs",
        "s1",
        "mesh2ds1",
        "wse",
        "watersurface",
        "watersurfaceelevation",
        "ssh",
        "zeta",
    },
    {
        "sea_surface_height",
        "sea_surface_height_above_geoid",
        "sea_surface_height_above_mean_sea_level",
        "water_surface_height_above_reference_datum",
        "sea_surface_height_above_reference_ellipsoid",
        "water_surface_reference_datum_altitude",
    },
)
"""The same of water levels."""

BEDS: Final = (
    {
        "bed",
        "bedlevel",
        "zb",
        "bl",
        "altitude",
        "elevation",
        "dem",
        "topography",
        "topo",
        "ground",
        "mesh2dflowelembl",
        "mesh2dnodez",
        "groundlevel",
    },
    {"altitude", "surface_altitude", "ground_level_altitude", "height_above_mean_sea_level", "bed_level"},
)
"""The same of heights of the bed."""

TIMES: Final = {"time", "t", "times", "datetime"}
EAST: Final = {"x", "lon", "longitude", "easting", "xc", "mx", "m", "column", "columns", "col"}
NORTH: Final = {"y", "lat", "latitude", "northing", "yc", "my", "n", "row", "rows"}
LATITUDES: Final = {"degrees_north", "degree_north", "degrees_n", "degree_n"}
LONGITUDES: Final = {"degrees_east", "degree_east", "degrees_e", "degree_e"}

MOST_STEPS: Final = 1000


@contextmanager
def opened(source: bytes | str | os.PathLike[str]) -> Iterator[Any]:
    """Dataset of a file or of its content, by xarray; times are not decoded."""
    import xarray

    folder = None
    try:
        if isinstance(source, bytes):
            folder = tempfile.TemporaryDirectory(prefix="vexture-")
            place = os.path.join(folder.name, "depths.nc")
            with open(place, "wb") as file:
                file.write(source)
        else:
            place = os.path.abspath(source)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                dataset = xarray.open_dataset(place, engine="netcdf4", decode_times=False, cache=False)
        except Exception as error:  # of a stranger's file the libraries raise what they like
            raise SourceError(f"it cannot be read as NetCDF ({line_of(error, place)}); write it again") from None
        with dataset:
            yield dataset
    finally:
        if folder:
            folder.cleanup()


def line_of(error: Exception, place: str = "") -> str:
    """What a library says, in one short line that names no temporary file."""
    text = " ".join(str(error).split())
    if place:
        text = text.replace(place, "the file")
    return (text if len(text) <= 120 else text[:117] + "...") or type(error).__name__


def check_dimension(dataset: Any, time_dim: str | None) -> None:
    """Refuse a dimension that is not there.

    Raises
    ------
    LimitError
        Naming those that are.
    """
    if time_dim is not None and time_dim not in dataset.dims:
        raise LimitError(
            f"there is no dimension {time_dim!r}; it has {listed(dataset.dims)}; choose another `time_dim`"
        )


def series_of(dataset: Any, time_dim: str | None, variable: str | None) -> Series:
    """Depths of an open dataset.

    Raises
    ------
    SourceError, LimitError
        If there are none, or more than one.
    """
    check_dimension(dataset, time_dim)
    grids = {str(name): axes for name in dataset.data_vars if (axes := axes_of(dataset, name, time_dim))}
    name, depth, bed = depths_of(dataset, list(grids), variable)
    time, north, east = grids[name]
    x, y = (_axis(dataset, dim) for dim in (east, north))
    order = tuple(dim for dim in (time, north, east) if dim is not None)
    times = times_of(dataset, time) if time is not None else (None,)
    extra = [dim for dim in dataset[name].dims if dim not in order and dataset.sizes[dim] > 1]
    if extra:
        raise SourceError(
            f"variable {name!r} also has the dimension {listed(extra)} ({dataset.sizes[extra[0]]} long); "
            "write a file with one layer, or name another `variable`"
        )

    def read(step: int, rows: slice, columns: slice) -> tuple[Values, Values | None]:
        places = {time: step, north: rows, east: columns}
        return depth(places, (north, east)), bed(places, (north, east)) if bed else None

    return Series(
        Lattice(x, y, np.eye(2, 3)),
        crs_of(dataset, name, [_along(dataset, dim) for dim in (east, north)]),
        name,
        times,
        read,
    )


def axes_of(dataset: Any, name: Any, time_dim: str | None) -> tuple[str | None, str, str] | None:
    """Dimensions of time, north and east of a variable; None if it is none of depths."""
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


def time_axis(dataset: Any, dims: Any, time_dim: str | None) -> str | None:
    """Dimension of time among some: the one that is asked for, else one that is called so or counts since a date."""
    if time_dim is not None:
        return time_dim if time_dim in dims else None
    for dim in map(str, dims):
        axis = dataset.variables.get(dim)
        about = {} if axis is None else axis.attrs
        if dim.lower() in TIMES or about.get("standard_name") == "time" or " since " in str(about.get("units", "")):
            return dim
    return None


def _points(dataset: Any, dim: str, names: set[str], axis: str, units: set[str]) -> bool:
    """Whether a dimension runs to the east, or to the north."""
    along = _along(dataset, dim)
    about = {} if along is None else along.attrs
    standard = f"projection_{axis}_coordinate", f"grid_{'longitude' if axis == 'x' else 'latitude'}"
    return (
        dim.lower() in names
        or str(about.get("axis", "")).lower() == axis
        or about.get("standard_name") in (*standard, "longitude" if axis == "x" else "latitude")
        or str(about.get("units", "")).lower() in units
    )


def _along(dataset: Any, dim: str) -> Any:
    """Coordinate of a dimension: of its own name, else the only one along it."""
    if dim in dataset.variables:
        return dataset[dim]
    found = [
        dataset[name] for name in dataset.coords if dataset[name].dims == (dim,) and dataset[name].dtype.kind in "iuf"
    ]
    return found[0] if len(found) == 1 else None


def _axis(dataset: Any, dim: str) -> Values:
    """Places of the samples along a dimension, rising or falling."""
    along = _along(dataset, dim)
    if along is None or along.ndim != 1:
        raise SourceError(
            f"dimension {dim!r} has no coordinates of its own (a curvilinear grid?); write it on rows and columns"
        )
    places: Values = _loaded(along).astype(np.float64)
    if not np.isfinite(places).all():
        raise SourceError(
            f"coordinate {along.name!r} is not finite at position {int(np.argmin(np.isfinite(places))) + 1}"
        )
    sign = np.sign(np.diff(places))
    if len(places) == 0 or (sign == 0).any() or (sign != sign[:1]).any():
        wrong = int(np.argmax(sign != (sign[0] or 1))) + 2 if len(sign) else 1
        raise SourceError(
            f"coordinate {along.name!r} neither rises nor falls throughout: see position {wrong}; "
            f"sort it: xarray's sortby({along.name!r})"
        )
    return places


def _loaded(variable: Any) -> Any:
    """Values of a variable."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return np.asarray(variable.values)
    except Exception as error:  # HDF5 and codecs raise what they like
        raise SourceError(
            f"variable {variable.name!r} cannot be read ({line_of(error)}); write the file again"
        ) from None


def read_variable(variable: Any, places: dict[Any, Any], order: tuple[str, ...]) -> Values:
    """Values of a variable at some places of its dimensions, in the order of dimensions asked for."""
    taken = variable.isel({dim: place for dim, place in places.items() if dim in variable.dims})
    taken = taken.squeeze([dim for dim in taken.dims if dim not in order])
    values: Values = _loaded(taken.transpose(*order)).astype(np.float64)
    units = str(variable.attrs.get("units", "m")).strip().lower()
    return values * UNITS.get(units, 1.0) if units in UNITS else values


UNITS: Final = {"cm": 0.01, "mm": 0.001, "centimetre": 0.01, "ft": 0.3048, "feet": 0.3048, "foot": 0.3048}
"""Metres to units that are not metres."""


def depths_of(dataset: Any, candidates: list[str], variable: str | None) -> tuple[str, Any, Any]:
    """What holds depths: its name, a function that reads it, one that reads the bed's height or None.

    A file without depths but with water levels and the bed has their difference.
    """

    def reader(name: str) -> Any:
        down = str(dataset[name].attrs.get("positive", "up")).lower() == "down"
        sign = -1.0 if down and name == bed else 1.0
        return lambda places, order: sign * read_variable(dataset[name], places, order)

    bed = _only(dataset, candidates, BEDS)
    level = _only(dataset, candidates, LEVELS)
    bed_reader = reader(bed) if bed is not None else None
    if variable is not None:
        if variable not in candidates:
            raise LimitError(f"there are no depths in {variable!r}; `variable` may be {listed(candidates)}")
        chosen = variable
    else:
        named = [name for name in candidates if _is(dataset, name, DEPTHS)]
        rest = [name for name in candidates if name not in (bed, level)]
        choice = named or rest
        if not choice and level is not None and bed is not None:
            choice = [level]
        if not choice:
            raise SourceError(f"no variable is on rows and columns; it has {listed(dataset.data_vars)}")
        if len(choice) > 1:
            raise LimitError(f"depths may be in {listed(choice)}; choose one by `variable`")
        chosen = choice[0]
    if chosen == bed or (chosen == level and bed_reader is None):
        what = "heights of the bed" if chosen == bed else "water levels, and nothing says where the bed is"
        others = [name for name in candidates if name not in (bed, level)]
        remedy = f"`variable` may be {listed(others)}" if others else "write depths into the file"
        raise LimitError(f"{chosen!r} holds {what}; {remedy}")
    if chosen == level and bed_reader is not None:
        at = reader(chosen)
        return chosen, lambda places, order: at(places, order) - bed_reader(places, order), bed_reader
    return chosen, reader(chosen), bed_reader


def _is(dataset: Any, name: str, known: tuple[set[str], set[str]]) -> bool:
    plain = name.lower().replace("_", "").replace("-", "")
    return plain in known[0] or str(dataset[name].attrs.get("standard_name", "")).lower() in known[1]


def _only(dataset: Any, candidates: list[str], known: tuple[set[str], set[str]]) -> str | None:
    found = [name for name in candidates if _is(dataset, name, known)]
    return found[0] if len(found) == 1 else None


def times_of(dataset: Any, dim: str) -> tuple[datetime | None, ...]:
    """Times of the steps along a dimension, None where the file has no dates."""
    import xarray

    count = int(dataset.sizes[dim])
    if count == 0:
        raise SourceError(f"dimension {dim!r} has no steps; write at least one")
    if count > MOST_STEPS:
        raise LimitError(f"dimension {dim!r} has {count:,} steps; the limit is {MOST_STEPS:,}; write fewer")
    if dim not in dataset.variables or dataset[dim].ndim != 1 or dataset[dim].dtype.kind not in "iuf":
        return (None,) * count
    places = _loaded(dataset[dim]).astype(np.float64)
    step = np.diff(places)
    if not (step > 0.0).all():
        wrong = int(np.argmin(step > 0.0)) + 1
        how = "the same time as" if step[wrong - 1] == 0.0 else "before"
        remedy = "drop_duplicates" if step[wrong - 1] == 0.0 else "sortby"
        raise SourceError(
            f"the time axis {dim!r} is out of order: step {wrong + 1} is {how} step {wrong} (counted from 1); "
            f"write it in order: xarray's {remedy}({dim!r})"
        )
    if " since " not in str(dataset[dim].attrs.get("units", "")):
        return (None,) * count
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            decoded = xarray.decode_cf(xarray.Dataset(coords={dim: dataset[dim].variable}))[dim].values
        return tuple(_moment(time) for time in decoded)
    except Exception:  # a calendar without such a date
        return (None,) * count


def _moment(time: Any) -> datetime:
    """A time as datetime, in UTC, from numpy or from a model's calendar."""
    if isinstance(time, np.datetime64):
        return datetime.fromtimestamp(float(time.astype("datetime64[us]").astype(np.int64)) / 1e6, UTC)
    return datetime(time.year, time.month, time.day, time.hour, time.minute, time.second, time.microsecond, UTC)


def crs_of(dataset: Any, name: str, coordinates: list[Any]) -> str | None:
    """What a file says of its reference system, as text for pyproj."""
    from pyproj import CRS

    mappings = [dataset[name].attrs.get("grid_mapping"), dataset[name].encoding.get("grid_mapping")]
    named = [str(text).split(":")[0].split()[0] for text in mappings if text]
    named += ["spatial_ref", "crs", "projected_coordinate_system", "wgs84"]
    for about in [dataset[key].attrs for key in named if key in dataset.variables] + [dataset.attrs]:
        for key in ("crs_wkt", "spatial_ref", "epsg_code", "EPSG_code", "epsg", "proj4_params", "proj4", "crs"):
            if about.get(key) not in (None, "", 0):
                text = str(about[key])
                return f"EPSG:{text}" if text.isdigit() else text
        if about.get("grid_mapping_name"):
            try:
                return str(CRS.from_cf(dict(about)).to_wkt())
            except Exception as error:  # of a stranger's attributes pyproj raises what it likes
                raise SourceError(f"its grid mapping is unknown ({line_of(error)}); give `crs` EPSG:...") from None
    degrees = [
        about is not None
        and (about.attrs.get("standard_name") == kind or str(about.attrs.get("units", "")).lower() in units)
        for about, kind, units in zip(coordinates, ("longitude", "latitude"), (LONGITUDES, LATITUDES), strict=True)
    ]
    return "EPSG:4326" if all(degrees) else None


def listed(names: Any) -> str:
    """Names in a message: the first eight."""
    shown = [repr(str(name)) for name in names]
    return ", ".join(shown[:8]) + (f" and {len(shown) - 8} more" if len(shown) > 8 else "") or "none"
