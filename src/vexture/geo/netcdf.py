"""Depths on the rows and columns of a NetCDF file, at one time or at several."""

import os
import warnings
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from datetime import UTC, datetime
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Final

import numpy as np

from vexture.errors import LimitError, ParameterError, SourceError, reason_of
from vexture.geo.series import Lattice, Series, Values

__all__ = ["crs_of", "depths_of", "listed", "opened", "refuse_layers", "series_of", "time_axis", "times_of"]

# fmt: off
DEPTHS: Final = (
    {"depth", "waterdepth", "wd", "h", "hs", "hh", "flooddepth", "inundationdepth", "mesh2dwaterdepth", "hmax"},
    {"water_depth", "sea_floor_depth_below_sea_surface", "flood_water_thickness", "depth",
     "water_depth_at_cell_center"},
)
"""Names of water depths, in lower case without ``_`` and ``-``, and their CF standard names."""

LEVELS: Final = (
    {"waterlevel", "wl", "level", "zs", "s1", "mesh2ds1", "wse", "watersurface", "watersurfaceelevation", "ssh",
     "zeta"},
    {"sea_surface_height", "sea_surface_height_above_geoid", "sea_surface_height_above_mean_sea_level",
     "sea_surface_height_above_reference_ellipsoid", "water_surface_height_above_reference_datum",
     "water_surface_reference_datum_altitude"},
)
"""Those of water levels."""

BEDS: Final = (
    {"bed", "bedlevel", "zb", "bl", "altitude", "elevation", "dem", "topography", "topo", "ground", "groundlevel",
     "mesh2dflowelembl", "mesh2dnodez"},
    {"altitude", "surface_altitude", "ground_level_altitude", "height_above_mean_sea_level", "bed_level"},
)
"""Those of heights of the bed."""
# fmt: on

UNITS: Final = {"cm": 0.01, "mm": 0.001, "centimetre": 0.01, "ft": 0.3048, "feet": 0.3048, "foot": 0.3048}
"""Length in metres of units other than the metre."""

TIMES: Final = {"time", "t", "times", "datetime"}
EAST: Final = {"x", "lon", "longitude", "easting", "xc", "mx", "m", "column", "columns", "col"}
NORTH: Final = {"y", "lat", "latitude", "northing", "yc", "my", "n", "row", "rows"}
LATITUDES: Final = {"degrees_north", "degree_north", "degrees_n", "degree_n"}
LONGITUDES: Final = {"degrees_east", "degree_east", "degrees_e", "degree_e"}

MOST_STEPS: Final = 1000


@contextmanager
def opened(source: bytes | str | os.PathLike[str], time_dim: str | None) -> Iterator[Any]:
    """Dataset of a file or of its content, by xarray, with times not decoded."""
    import xarray

    with ExitStack() as stack:
        place = os.path.abspath(source) if not isinstance(source, bytes) else ""
        if isinstance(source, bytes):
            place = os.path.join(stack.enter_context(TemporaryDirectory(prefix="vexture-")), "depths.nc")
            Path(place).write_bytes(source)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                dataset = xarray.open_dataset(place, engine="netcdf4", decode_times=False, cache=False)
        except Exception as error:  # xarray and netCDF4 raise any type of exception for a damaged file
            why = reason_of(error, hidden=place)
            raise SourceError(f"it cannot be read as NetCDF ({why}); write it again") from None
        stack.enter_context(dataset)
        if time_dim is not None and time_dim not in dataset.dims:
            raise ParameterError(
                f"there is no dimension {time_dim!r}; it has {listed(dataset.dims)}; choose another `time_dim`"
            )
        yield dataset


def series_of(dataset: Any, time_dim: str | None, variable: str | None) -> Series:
    """Depths of an open dataset on rows and columns; `ParameterError` if `variable` holds none."""
    grids = {str(name): axes for name in dataset.data_vars if (axes := _axes_of(dataset, name, time_dim))}
    name, depth, bed = depths_of(dataset, list(grids), variable)
    time, north, east = grids[name]
    x, y = (_axis(dataset, dim) for dim in (east, north))
    times = times_of(dataset, time)
    refuse_layers(dataset, name, (time, north, east))

    def read(step: int, rows: slice, columns: slice) -> tuple[Values, Values | None]:
        places = {time: step, north: rows, east: columns}
        return depth(places, (north, east)), bed(places, (north, east)) if bed else None

    crs = crs_of(dataset, name, [_along(dataset, dim) for dim in (east, north)])
    return Series(Lattice(x, y, np.eye(2, 3)), crs, name, times, read)


def refuse_layers(dataset: Any, name: str, known: tuple[str | None, ...]) -> None:
    """Refuse a variable with a further dimension, such as layers of water."""
    extra = [dim for dim in dataset[name].dims if dim not in known and dataset.sizes[dim] > 1]
    if extra:
        raise SourceError(
            f"variable {name!r} also has the dimension {listed(extra)} ({dataset.sizes[extra[0]]} long); "
            "write a file with one layer, or name another `variable`"
        )


def _axes_of(dataset: Any, name: Any, time_dim: str | None) -> tuple[str | None, str, str] | None:
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


def time_axis(dataset: Any, dims: Any, time_dim: str | None) -> str | None:
    """Dimension of time among some: the one that the user names, else one with the name or the units of a time."""
    if time_dim is not None:
        return time_dim if time_dim in dims else None
    for dim in map(str, dims):
        axis = dataset.variables.get(dim)
        about = {} if axis is None else axis.attrs
        if dim.lower() in TIMES or about.get("standard_name") == "time" or " since " in str(about.get("units", "")):
            return dim
    return None


def _points(dataset: Any, dim: str, names: set[str], axis: str, units: set[str]) -> bool:
    """Whether a dimension runs along the axis "x", east, or "y", north."""
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
    """Coordinate of a dimension: the one with its name, else the only one along it."""
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
    except Exception as error:  # HDF5 and its codecs raise any type of exception for damaged data
        why = reason_of(error)
        raise SourceError(f"variable {variable.name!r} cannot be read ({why}); write the file again") from None


def _read(variable: Any, places: dict[Any, Any], order: tuple[str, ...]) -> Values:
    """Values of a variable in metres, at the given places along its dimensions, with the dimensions in an order."""
    taken = variable.isel({dim: place for dim, place in places.items() if dim in variable.dims})
    taken = taken.squeeze([dim for dim in taken.dims if dim not in order])
    with np.errstate(invalid="ignore", over="ignore"):  # what is not finite is no depth
        values: Values = _loaded(taken.transpose(*order)).astype(np.float64)
        return values * UNITS.get(str(variable.attrs.get("units", "m")).strip().lower(), 1.0)


def depths_of(dataset: Any, candidates: list[str], variable: str | None) -> tuple[str, Any, Any]:
    """Name of the variable of depths, a function that reads it, and one that reads the bed's height, or None.

    Where the variable holds water levels, the function subtracts the bed's height from them.
    """

    def reader(name: str) -> Any:
        down = str(dataset[name].attrs.get("positive", "up")).lower() == "down"
        sign = -1.0 if down and name == bed else 1.0
        return lambda places, order: sign * _read(dataset[name], places, order)

    bed, level = (_only(dataset, candidates, names) for names in (BEDS, LEVELS))
    read_bed = reader(bed) if bed is not None else None
    if variable is not None:
        if variable not in candidates:
            raise ParameterError(f"there are no depths in {variable!r}; `variable` may be {listed(candidates)}")
        choice = [variable]
    else:
        others = [name for name in candidates if name not in (bed, level)]
        choice = [name for name in candidates if _is(dataset, name, DEPTHS)] or others
        if not choice and level is not None and bed is not None:
            choice = [level]
        if not choice:
            raise SourceError(f"no variable is on rows and columns; it has {listed(dataset.data_vars)}")
        if len(choice) > 1:
            raise LimitError(f"depths may be in {listed(choice)}; choose one by `variable`")
    chosen = choice[0]
    if chosen == bed or (chosen == level and read_bed is None):
        what = "heights of the bed" if chosen == bed else "water levels, and no variable holds heights of the bed"
        others = [name for name in candidates if name not in (bed, level)]
        remedy = f"`variable` may be {listed(others)}" if others else "write depths into the file"
        raise (SourceError if variable is None else ParameterError)(f"{chosen!r} holds {what}; {remedy}")
    read = reader(chosen)
    if chosen == level and read_bed is not None:
        return chosen, lambda places, order: read(places, order) - read_bed(places, order), read_bed
    return chosen, read, read_bed


def _is(dataset: Any, name: str, known: tuple[set[str], set[str]]) -> bool:
    plain = name.lower().replace("_", "").replace("-", "")
    return plain in known[0] or str(dataset[name].attrs.get("standard_name", "")).lower() in known[1]


def _only(dataset: Any, candidates: list[str], known: tuple[set[str], set[str]]) -> str | None:
    found = [name for name in candidates if _is(dataset, name, known)]
    return found[0] if len(found) == 1 else None


def times_of(dataset: Any, dim: str | None) -> tuple[datetime | None, ...]:
    """Times of the steps along a dimension, None where the file has no dates; one step without a dimension."""
    import xarray

    if dim is None:
        return (None,)
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
    """A time of numpy or of cftime as datetime, in UTC."""
    if isinstance(time, np.datetime64):
        return datetime.fromtimestamp(float(time.astype("datetime64[us]").astype(np.int64)) / 1e6, UTC)
    return datetime(time.year, time.month, time.day, time.hour, time.minute, time.second, time.microsecond, UTC)


def crs_of(dataset: Any, name: str, coordinates: list[Any]) -> str | None:
    """Reference system that a file names, as text for pyproj."""
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
            except Exception as error:  # pyproj raises any type of exception for invalid attributes
                raise SourceError(f"its grid mapping is unknown ({reason_of(error)}); give `crs` EPSG:...") from None
    degrees = [
        about is not None
        and (about.attrs.get("standard_name") == kind or str(about.attrs.get("units", "")).lower() in units)
        for about, kind, units in zip(coordinates, ("longitude", "latitude"), (LONGITUDES, LATITUDES), strict=True)
    ]
    return "EPSG:4326" if all(degrees) else None


def listed(names: Any) -> str:
    """The first eight names, for a message."""
    shown = [repr(str(name)) for name in names]
    return ", ".join(shown[:8]) + (f" and {len(shown) - 8} more" if len(shown) > 8 else "") or "none"
