"""Read depths from GRIB of editions 1 and 2 as a dataset of xarray, which is then read like NetCDF.

A variable is a parameter at a level, by the tables of GDAL; its fields are sorted by the times at which they are valid.
The number of fields and their grids are checked before GDAL decodes any of them: GDAL takes the grid of the first field
for that of all, and allocates what a header states.
References: WMO Manual on Codes, I.2, FM 92 GRIB editions 1 and 2.
"""

import os
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np

from vexture.base.content import GRIB, LARGEST_FILE, read_bytes
from vexture.base.deadline import check_time
from vexture.base.errors import LimitError, ParameterError, SourceError
from vexture.base.notes import Notes
from vexture_geo.base.gdal import open_grib, raster_errors
from vexture_geo.base.quiet_output import quiet_output
from vexture_geo.depth.variables import list_names

if TYPE_CHECKING:
    from rasterio import DatasetReader

DEPTHS: Final = {"water depth": "sea_floor_depth_below_sea_surface"}
LEVELS: Final = dict.fromkeys(
    (
        *("deviation of sea level from mean", "ocean surface elevation relative to geoid", "storm surge and tide"),
        *("sea surface height relative to geoid", "extra tropical storm surge combined surge and tide"),
    ),
    "sea_surface_height_above_geoid",
)
BEDS: Final = {
    "bathymetry": "sea_floor_depth_below_geoid",
    **dict.fromkeys(("model terrain height", "orography"), "surface_altitude"),
}
STANDARD_NAMES: Final = DEPTHS | LEVELS | BEDS
"""Standard names of CF by the parameter names in GRIB tables, in lower case."""

SINCE: Final = "seconds since 1970-01-01"
"""Units of GDAL's times."""

MOST_FIELDS: Final = 10_000
"""Most fields of a file. A year of hours has fewer; GDAL lists all fields before one can be chosen."""

MOST_POINTS: Final = 2**25
"""Most points of a grid, of which GDAL holds several copies as doubles; weather radars have 25 million."""

END: Final = b"7777"
REDUCED: Final = 0xFFFFFFFF, 0xFFFF
"""Values, in 4 and in 2 bytes, that mark rows with different numbers of points."""

GRID, DATA = 3, 7
"""Sections of edition 2: the definition of a grid, and the numbers of a field."""

HAS_GRID: Final = 0x80
"""Flag of edition 1 for a message that defines its grid, rather than naming one known to its centre."""

PLANAR: Final = 100
"""Templates of grids below this number have rows and columns."""

ALONE: Final = "write the depths alone into a file: cdo selname,NAME IN OUT"


class Field(NamedTuple):
    """A band: its parameter, its level, and the time at which it is valid, None if unknown."""

    band: int
    element: str
    level: str
    meaning: str
    unit: str
    seconds: float | None


@contextmanager
def open_fields(source: bytes | str | os.PathLike[str], variable: str | None, notes: Notes) -> Iterator[Any]:
    """Open the fields of depths, of water levels, of the bed, and of `variable` as a dataset.

    A field is decoded when its values are read.
    """
    content = _content(source)
    held = count_fields(content)
    with ExitStack() as stack:
        try:
            file = stack.enter_context(open_grib(content))
        except raster_errors():
            raise SourceError("GDAL cannot read its grid; write it as NetCDF: cdo -f nc copy IN OUT") from None
        if file.count < held:
            notes.remark(f"of its {held:,} fields, {file.count:,} can be read; write the others again")
        yield _dataset(file, variable)


def _content(source: bytes | str | os.PathLike[str]) -> bytes:
    """Read a file into memory, so that files beside it have no effect."""
    if not isinstance(source, bytes) and Path(source).stat().st_size > LARGEST_FILE:
        raise LimitError(
            f"it is larger than {LARGEST_FILE:,} bytes; write the depths alone (cdo selname,NAME IN OUT), or NetCDF, "
            "which may be of any size (cdo -f nc copy IN OUT)"
        )
    return read_bytes(source)


def _dataset(file: "DatasetReader", variable: str | None) -> Any:
    """Make a dataset of the usable variables."""
    import xarray

    if file.crs is None or file.transform.is_identity or file.transform.determinant == 0.0:
        raise SourceError("its grid is not one of rows and columns in a known reference system; write it as NetCDF")
    coordinates = _coordinates(file)
    dims: dict[tuple[float | None, ...], str] = {}
    variables = {}
    for name, fields in _choose_fields(_group_by_name(_fields(file)), variable).items():
        times = tuple(field.seconds for field in fields)
        if any(one == other for one, other in pairwise(times)):
            raise SourceError(
                f"{name!r} has several fields at one time, as those of an ensemble are; write one of them into a file: "
                "grib_copy -w number=1 IN OUT"
            )
        about = {"units": fields[0].unit, "standard_name": STANDARD_NAMES.get(fields[0].meaning, "")}
        time = dims.setdefault(times, f"time{len(dims) or ''}")
        values = xarray.Variable((time, "y", "x"), _values(file, [field.band for field in fields]), about)
        if len(fields) == 1 and fields[0].meaning in BEDS:  # a single bed applies at all times
            values = values.isel({time: 0})
        elif None not in times:
            coordinates[time] = (time, list(times), {"units": SINCE})
        variables[name] = values
    return xarray.Dataset(variables, coordinates)


def _coordinates(file: "DatasetReader") -> dict[str, Any]:
    """Make the coordinates of columns and rows, and their reference system."""
    a, _, c, _, e, f = file.transform[:6]
    x, y = c + a * (np.arange(file.width) + 0.5), f + e * (np.arange(file.height) + 0.5)
    is_geographic = file.crs.is_geographic
    return {
        "x": ("x", x, {"units": "degrees_east"} if is_geographic else {}),
        "y": ("y", y, {"units": "degrees_north"} if is_geographic else {}),
        "spatial_ref": ((), 0, {"crs_wkt": file.crs.to_wkt()}),
    }


def _fields(file: "DatasetReader") -> list[Field]:
    """List all fields of a file in the order of their times."""
    found = []
    for band in range(1, file.count + 1):
        check_time()
        element, level, meaning, unit, time = (
            str(file.get_tag_item(f"GRIB_{key}", bidx=band) or "").strip()
            for key in ("ELEMENT", "SHORT_NAME", "COMMENT", "UNIT", "VALID_TIME")
        )
        seconds = time.split()[0] if time else ""
        meaning = meaning.removesuffix(unit).strip().lower()
        found.append(Field(band, element, level, meaning, unit, float(seconds) if seconds.isdecimal() else None))
    return sorted(found, key=lambda field: field.seconds or 0.0)


def _group_by_name(fields: Sequence[Field]) -> dict[str, list[Field]]:
    """Group fields by the names of their parameters, with the level if a parameter has several."""
    found: dict[tuple[str, str], list[Field]] = {}
    for field in fields:
        found.setdefault((field.element, field.level), []).append(field)
    elements = [element for element, _ in found]
    return {
        element if elements.count(element) == 1 else f"{element}:{level}": group
        for (element, level), group in found.items()
    }


def _choose_fields(found: dict[str, list[Field]], variable: str | None) -> dict[str, list[Field]]:
    """Select the known variables, and the one that the user names."""
    if variable is not None and variable not in found:
        raise ParameterError(f"there is no {variable!r}; `variable` may be {list_names(found)}")
    chosen = {name: fields for name, fields in found.items() if name == variable or fields[0].meaning in STANDARD_NAMES}
    if not chosen:
        held = list_names(f"{name}, {fields[0].meaning} {fields[0].unit}" for name, fields in found.items())
        raise SourceError(
            f"it holds {held}, and no depth of water by the tables of GRIB; `variable` names one that is a depth"
        )
    return chosen


def _values(file: "DatasetReader", bands: Sequence[int]) -> Any:
    """Make an array of bands, (band, row, column), which are read lazily."""
    from xarray.backends import BackendArray
    from xarray.core.indexing import IndexingSupport, LazilyIndexedArray, explicit_indexing_adapter

    class Values(BackendArray):
        shape = (len(bands), file.height, file.width)
        dtype = np.dtype(np.float64)

        def __getitem__(self, key: Any) -> Any:
            return explicit_indexing_adapter(key, self.shape, IndexingSupport.BASIC, self._read)

        def _read(self, key: Any) -> Any:
            step, rows, columns = key
            wanted = np.asarray(bands)[step]
            with quiet_output():
                decoded = [file.read(int(band), masked=True) for band in np.atleast_1d(wanted)]
            read = [values.astype(np.float64).filled(np.nan)[rows, columns] for values in decoded]
            return np.stack(read) if wanted.ndim else read[0]

    return LazilyIndexedArray(Values())


def count_fields(content: bytes) -> int:
    """Count the fields of all messages; an error if these are truncated, too many or too large, or differ in grid."""
    fields, first = 0, b""
    for message in _messages(content):
        check_time()
        edition = message[7]
        try:
            for grid, points in _grids(message) if edition == 2 else _grid_of_first(message):
                fields += 1
                first = first or grid
                _check(fields, points, grid == first)
        except IndexError:
            raise _damage_error(message) from None
    return fields


def _messages(content: bytes) -> Iterator[bytes]:
    """Yield each message, from its GRIB to its 7777."""
    at = content.find(GRIB)
    while at >= 0:
        edition = content[at + 7 : at + 8]
        if edition not in (b"\1", b"\2"):
            raise SourceError(
                f"it is of edition {edition[0] if edition else '?'} of GRIB, and editions 1 and 2 are read; "
                "write it as edition 2: grib_set -s edition=2 IN OUT"
            )
        size = content[at + 8 : at + 16] if edition == b"\2" else content[at + 4 : at + 7]
        end = at + int.from_bytes(size)
        if end > len(content) or content[max(at, end - len(END)) : end] != END:
            raise SourceError(
                f"its message at byte {at:,} says {end - at:,} bytes, and does not end there; copy the file again"
            )
        yield content[at:end]
        at = content.find(GRIB, end)


def _grids(message: bytes) -> Iterator[tuple[bytes, int]]:
    """Yield the definition of the grid and the number of points of each field of edition 2."""
    at, grid, points = 16, b"", 0
    while message[at : at + len(END)] != END:
        size, number = int.from_bytes(message[at : at + 4]), message[at + 4]
        if size < 5 or at + size > len(message):
            raise _damage_error(message)
        if number == GRID:
            grid = message[at + 5 : at + size]
            points = int.from_bytes(grid[1:5])
            if int.from_bytes(grid[7:9]) < PLANAR:
                points = max(points, _points(grid[25:29], grid[29:33]))
        elif number == DATA:
            yield grid, points
        at += size


def _grid_of_first(message: bytes) -> Iterator[tuple[bytes, int]]:
    """Yield the definition of the grid and the number of points of the field of edition 1."""
    if not message[15] & HAS_GRID:
        raise SourceError(
            "it names a grid by a number of its centre; write it as edition 2: grib_set -s edition=2 IN OUT"
        )
    at = 8 + int.from_bytes(message[8:11])
    grid = message[at : at + int.from_bytes(message[at : at + 3])]
    yield grid, _points(grid[6:8], grid[8:10])


def _points(columns: bytes, rows: bytes) -> int:
    """Count the points of a grid by its columns and rows."""
    across, up = int.from_bytes(columns), int.from_bytes(rows)
    if across in REDUCED[len(columns) == 2 :] or up in REDUCED[len(rows) == 2 :]:
        raise SourceError("its rows have different numbers of points; write it on rows and columns: cdo -R copy IN OUT")
    return across * up


def _check(fields: int, points: int, same: bool) -> None:
    if fields > MOST_FIELDS:
        raise LimitError(f"it has more than {MOST_FIELDS:,} fields, which is the limit; {ALONE}")
    if points > MOST_POINTS:
        raise LimitError(
            f"its grid has {points:,} points; the limit is {MOST_POINTS:,}; cut out a part: "
            "cdo sellonlatbox,WEST,EAST,SOUTH,NORTH IN OUT"
        )
    if not same:
        raise SourceError(f"its fields are on several grids; {ALONE}")


def _damage_error(message: bytes) -> SourceError:
    return SourceError(f"a message of {len(message):,} bytes is damaged (its sections do not fill it); copy it again")
