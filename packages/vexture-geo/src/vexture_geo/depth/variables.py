"""Variables of a NetCDF file: choose the one with depths, and read it."""

import re
import warnings
from collections.abc import Callable
from typing import Any, Final, NamedTuple

import numpy as np

from vexture.base.errors import LimitError, ParameterError, SourceError, reason_of
from vexture.base.notes import Notes
from vexture_geo.base.depth_ranges import DepthRange, has_flags, ranges_of_flags
from vexture_geo.base.lengths import NO_UNIT, metres_in
from vexture_geo.depth.implicit_no_data import codes_of, without_undeclared
from vexture_geo.depth.series import METRES, Meaning, Values

# fmt: off
DEPTHS: Final = (
    {"depth", "waterdepth", "wd", "h", "hs", "hh", "flooddepth", "inundationdepth", "hmax"},
    {"water_depth", "sea_floor_depth_below_sea_surface", "flood_water_thickness", "depth",
     "water_depth_at_cell_center"},
)
"""Names of water depths, in lower case without ``_``, ``-`` and the name of a mesh, and their CF standard names."""

LEVELS: Final = (
    {"waterlevel", "wl", "level", "zs", "s1", "wse", "watersurface", "watersurfaceelevation", "ssh",
     "zeta"},
    {"sea_surface_height", "sea_surface_height_above_geoid", "sea_surface_height_above_mean_sea_level",
     "sea_surface_height_above_reference_ellipsoid", "water_surface_height_above_reference_datum",
     "water_surface_reference_datum_altitude"},
)
"""Names of water levels, likewise."""

BEDS: Final = (
    {"bed", "bedlevel", "zb", "bl", "altitude", "elevation", "dem", "topography", "topo", "ground", "groundlevel",
     "flowelembl", "nodez"},
    {"altitude", "surface_altitude", "ground_level_altitude", "height_above_mean_sea_level", "bed_level"},
)
"""Names of heights of the bed, likewise."""

SOUNDINGS: Final = (
    {"dps", "dps0", "bathymetry", "bathy"},
    {"sea_floor_depth", "sea_floor_depth_below_geoid", "sea_floor_depth_below_mean_sea_level",
     "sea_floor_depth_below_reference_ellipsoid", "depth_below_geoid"},
)
"""Names of depths of the bed below the zero of heights, which are positive downwards, likewise."""
# fmt: on

RISING: Final = {"elevation", "elev"}
"""Names that SCHISM uses for its water level: they count as levels if they have times and depths have none."""

SOUNDED: Final = re.compile(r"bathymetr|below (the )?(geoid|datum|mean sea level)", re.IGNORECASE)
"""Words in descriptions of soundings with a name of water depths, such as ``h`` of ROMS."""

TIMES: Final = {"time", "t", "times", "datetime"}

MESH: Final = re.compile(r"^mesh(2d?)?_", re.IGNORECASE)
"""Prefix that models add to the names of variables on a mesh."""


Reader = Callable[[dict[Any, Any], tuple[str, ...]], Values]
"""Reads a variable at places along its dimensions, with the dimensions in a given order."""


class Depths(NamedTuple):
    """Variable of depths: its name, its reader, the reader of the bed's height, and the meaning of its numbers."""

    name: str
    read: Reader
    bed: Reader | None
    meaning: Meaning


def depths_of(dataset: Any, candidates: list[str], variable: str | None, notes: Notes) -> Depths:
    """Choose the variable of depths. From water levels, the bed's height is subtracted.

    Classes of depth are read as ranks. Other variables with flags are ignored, unless `variable` names one.
    """
    candidates = _without_flags(dataset, candidates, variable)
    bed = _bed(dataset, candidates)
    read_bed = reader_of(dataset[bed], _sign(dataset, bed), notes) if bed is not None else None
    if variable is not None and variable not in candidates:
        raise ParameterError(f"there are no depths in {variable!r}; `variable` may be {list_names(candidates)}")
    level = _level(dataset, candidates)
    chosen = _choose_variable(dataset, candidates, bed, level) if variable is None else variable
    is_level = chosen == level or (_is(dataset, chosen, LEVELS) and not _has_name(chosen, DEPTHS))
    if chosen == bed or (is_level and read_bed is None):
        what = "heights of the bed" if chosen == bed else "water levels, and no variable holds heights of the bed"
        others = [name for name in candidates if name not in (bed, level)]
        remedy = f"`variable` may be {list_names(others)}" if others else "write depths into the file"
        raise (SourceError if variable is None else ParameterError)(f"{chosen!r} holds {what}; {remedy}")
    for name in (chosen, bed if is_level else None):
        if name is not None and metres_in(unit_of(dataset[name])) is None:
            raise (SourceError if variable is None else ParameterError)(
                f"{name!r} is in {unit_of(dataset[name])!r}, no unit of length that is known, so it holds no depths; "
                "`variable` names another, or write depths in metres into the file"
            )
    if has_flags(dataset[chosen]):
        return _classes(dataset, chosen, is_level, read_bed)
    read = reader_of(dataset[chosen], notes=notes, are_depths=not is_level)
    if is_level and read_bed is not None:
        return Depths(chosen, lambda places, order: read(places, order) - read_bed(places, order), read_bed, METRES)
    return Depths(chosen, read, read_bed, _meaning(dataset[chosen]))


def _without_flags(dataset: Any, candidates: list[str], variable: str | None) -> list[str]:
    """Select variables that hold metres, or classes of depth."""
    found, error = [], None
    for name in candidates:
        try:
            if has_flags(dataset[name]):
                _ranges(dataset, name)
            found.append(name)
        except SourceError as problem:
            if name == variable:
                raise ParameterError(str(problem)) from None
            error = error or problem
    if error is not None and not found:
        raise error
    return found


def _ranges(dataset: Any, name: str) -> dict[float, DepthRange]:
    return ranges_of_flags(dataset, name, metres_in(unit_of(dataset[name])) or 1.0)


def _classes(dataset: Any, name: str, is_level: bool, bed: Reader | None) -> Depths:
    """Make a reader of ranks of classes of depth."""
    if is_level:
        raise SourceError(
            f"{name!r} holds classes of water levels, from which no depths follow; `variable` names one of depths"
        )
    by_value = _ranges(dataset, name)
    ranges = tuple(sorted(by_value.values()))
    read_numbers = reader_of(dataset[name], unit=1.0)

    def read(places: dict[Any, Any], order: tuple[str, ...]) -> Values:
        numbers = read_numbers(places, order)
        ranks = np.full(numbers.shape, np.nan)
        for value, one in by_value.items():
            ranks[numbers == value] = 1.0 + ranges.index(one)
        return ranks

    return Depths(name, read, bed, Meaning(ranges))


def _meaning(variable: Any) -> Meaning:
    """Determine the meaning of the numbers of a variable without flags."""
    written = variable.encoding.get("dtype", variable.dtype)
    is_packed = any(key in variable.encoding for key in ("scale_factor", "add_offset"))
    are_whole = np.dtype(written).kind in "iu" and not is_packed
    return Meaning((), unit_of(variable).lower() not in NO_UNIT, are_whole)


def has_depths(dataset: Any, candidates: list[str]) -> bool:
    """Return whether variables hold depths by name, or both a water level and the bed."""
    bed = _bed(dataset, candidates)
    both = bed is not None and _level(dataset, candidates) is not None
    return both or any(_is(dataset, name, DEPTHS) for name in candidates if name != bed)


def _choose_variable(dataset: Any, candidates: list[str], bed: str | None, level: str | None) -> str:
    """Choose the variable that holds depths, or the water level above a known bed.

    The one with most times wins, because models write the largest depth of a run beside the levels at all times.
    """
    depths = [name for name in candidates if _is(dataset, name, DEPTHS) and name != bed]
    levels = [level] if level is not None and bed is not None else []
    best = _longest(dataset, depths + levels)
    choice = [name for name in best if name in depths] or best
    choice = choice or [name for name in candidates if name not in (bed, level)]
    choice = [name for name in choice if metres_in(unit_of(dataset[name])) is not None] or choice
    if not choice and level is None:
        raise SourceError(
            f"no variable is on rows and columns; it has {list_names(dataset.data_vars)}; write x and y, the "
            "coordinates of columns and rows, into the file, as to_netcdf of xarray does"
        )
    choice = choice or [level or ""]
    if len(choice) > 1:
        raise LimitError(f"depths may be in {list_names(choice)}; choose one by `variable`")
    return choice[0]


def _longest(dataset: Any, names: list[str]) -> list[str]:
    """Select the variables with most times; largest values of a run only if there is nothing else."""

    def steps(name: str) -> int:
        time = time_axis(dataset, dataset[name].dims, None)
        return 1 if time is None else int(dataset.sizes[time])

    most = max(map(steps, names), default=0)
    found = [name for name in names if steps(name) == most]
    return [name for name in found if not name.lower().endswith("max")] or found


def reader_of(
    variable: Any,
    sign: float = 1.0,
    notes: Notes | None = None,
    unit: float | None = None,
    *,
    are_depths: bool = False,
) -> Reader:
    """Make a function that reads a variable in metres, times a sign, and caches the last values, for a constant bed.

    `unit` replaces the metres in the variable's unit as the factor of its numbers; `notes` receive undeclared fill
    values.
    """
    metres = metres_in(unit_of(variable)) or 1.0 if unit is None else unit
    last: list[tuple[Any, Values]] = []

    def read_again(places: dict[Any, Any], order: tuple[str, ...]) -> Values:
        key = ({dim: place for dim, place in places.items() if dim in variable.dims}, order)
        if not last or last[0][0] != key:
            last[:] = [(key, sign * metres * _read(variable, places, order, metres, notes, are_depths))]
        return last[0][1]

    return read_again


def _bed(dataset: Any, candidates: list[str]) -> str | None:
    """Find the variable of the bed's heights, or of its depths below their zero."""
    if (above := _bed_and_level(dataset, candidates)) is not None:
        return above[0]
    described = [name for name in candidates if _is(dataset, name, DEPTHS) and _is_sounded(dataset, name)]
    known = BEDS[0] | SOUNDINGS[0], BEDS[1] | SOUNDINGS[1]
    found = known_as(dataset, candidates, known)
    return described[0] if found is None and len(described) == 1 else found


def _level(dataset: Any, candidates: list[str]) -> str | None:
    """Find the variable of water levels."""
    above = _bed_and_level(dataset, candidates)
    return known_as(dataset, candidates, LEVELS) if above is None else above[1]


def _bed_and_level(dataset: Any, candidates: list[str]) -> tuple[str, str] | None:
    """Find a bed named as a depth, and a level named as an elevation, as in SCHISM: only the level has times."""
    moving = {name: time_axis(dataset, dataset[name].dims, None) is not None for name in candidates}
    beds = [name for name in candidates if _has_name(name, DEPTHS) and not moving[name]]
    levels = [name for name in candidates if _has_name(name, (RISING, set())) and moving[name]]
    return (beds[0], levels[0]) if len(beds) == len(levels) == 1 else None


def _sign(dataset: Any, bed: str) -> float:
    """Return the factor that turns values of a bed into heights: -1 if they are positive downwards, as depths are."""
    is_height = _standard(dataset, bed) in BEDS[1]
    sounded = _is(dataset, bed, SOUNDINGS) or (_is(dataset, bed, DEPTHS) and not is_height)
    return -1.0 if str(dataset[bed].attrs.get("positive", "down" if sounded else "up")).lower() == "down" else 1.0


def _is_sounded(dataset: Any, name: str) -> bool:
    return SOUNDED.search(str(dataset[name].attrs.get("long_name", ""))) is not None


def _is(dataset: Any, name: str, known: tuple[set[str], set[str]]) -> bool:
    return _has_name(name, known) or _standard(dataset, name) in known[1]


def _has_name(name: str, known: tuple[set[str], set[str]]) -> bool:
    return MESH.sub("", name).lower().replace("_", "").replace("-", "") in known[0]


def _standard(dataset: Any, name: str) -> str:
    """Return the standard name, without the word for a maximum that SFINCS and ADCIRC add."""
    text = str(dataset[name].attrs.get("standard_name", "")).lower().replace(" ", "_")
    return text.removeprefix("maximum_").removeprefix("of_")


def known_as(dataset: Any, candidates: list[str], known: tuple[set[str], set[str]]) -> str | None:
    """Find the variable with a usual name and most times, or else with a standard name; None if several have it.

    Names come first, because the level at the previous step has the same standard name.
    """
    found = _longest(dataset, [name for name in candidates if _has_name(name, known)])
    found = found or _longest(dataset, [name for name in candidates if _standard(dataset, name) in known[1]])
    return found[0] if len(found) == 1 else None


def time_axis(dataset: Any, dims: Any, time_dim: str | None) -> str | None:
    """Find the dimension of time: the one that the user names, or else one with the name or the units of a time."""
    if time_dim is not None:
        return time_dim if time_dim in dims else None
    for dim in map(str, dims):
        axis = dataset.variables.get(dim)
        about = {} if axis is None else axis.attrs
        if dim.lower() in TIMES or about.get("standard_name") == "time" or " since " in str(about.get("units", "")):
            return dim
    return None


def refuse_layers(dataset: Any, name: str, known: tuple[str | None, ...]) -> None:
    """Raise an error for a variable with a further dimension, such as layers of water."""
    extra = [dim for dim in dataset[name].dims if dim not in known and dataset.sizes[dim] > 1]
    if extra:
        raise SourceError(
            f"variable {name!r} also has the dimension {list_names(extra)} ({dataset.sizes[extra[0]]} long); "
            "write a file with one layer, or name another `variable`"
        )


def load_values(variable: Any) -> Any:
    """Read the values of a variable."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return np.asarray(variable.values)
    except Exception as error:  # HDF5 and its codecs raise any type of exception for damaged data
        why = reason_of(error)
        raise SourceError(f"variable {variable.name!r} cannot be read ({why}); write the file again") from None


def _read(
    variable: Any,
    places: dict[Any, Any],
    order: tuple[str, ...],
    metres: float,
    notes: Notes | None,
    are_depths: bool,
) -> Values:
    """Read a variable in its unit, at given places along its dimensions, with the dimensions in a given order."""
    taken = variable.isel({dim: place for dim, place in places.items() if dim in variable.dims})
    extra = [dim for dim in taken.dims if dim not in order]
    if any(taken.sizes[dim] > 1 for dim in extra):
        raise SourceError(
            f"variable {variable.name!r} also has the dimension {list_names(extra)}, which the depths have not; "
            "write one that has none but theirs"
        )
    taken = taken.squeeze(extra)
    with np.errstate(invalid="ignore", over="ignore"):  # values that are not finite are no depths
        values: Values = load_values(taken.transpose(*order)).astype(np.float64)
    if has_flags(variable):
        return values
    name = repr(str(variable.name))
    return without_undeclared(values, codes_of(variable), metres, name, notes, are_depths=are_depths)


def unit_of(variable: Any) -> str:
    """Unit of a variable, as its file writes it."""
    return str(variable.attrs.get("units", "")).strip()


def list_names(names: Any) -> str:
    """Format the first eight names for a message."""
    shown = [repr(str(name)) for name in names]
    return ", ".join(shown[:8]) + (f" and {len(shown) - 8} more" if len(shown) > 8 else "") or "none"
