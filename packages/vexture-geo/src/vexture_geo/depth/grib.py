"""Depths in GRIB of editions 1 and 2, as a dataset of xarray, which is read as that of NetCDF is.

A variable is a parameter at a level, by the tables of GDAL; its fields are sorted by the times at which they are valid.
"""

import os
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np

from vexture.base.content import LARGEST_FILE, read_bytes
from vexture.base.deadline import check_time
from vexture.base.errors import LimitError, ParameterError, SourceError
from vexture.base.notes import Notes
from vexture_geo.base.gdal import open_grib, raster_errors
from vexture_geo.base.quiet_output import quiet_output
from vexture_geo.depth.grib_messages import count_fields
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
"""Standard names of CF by what the tables of GRIB call a parameter, in lower case."""

SINCE: Final = "seconds since 1970-01-01"
"""Units of the times that GDAL gives."""


class Field(NamedTuple):
    """A band: what its parameter and level are, and the time at which it is valid, None if that is unknown."""

    band: int
    element: str
    level: str
    meaning: str
    unit: str
    seconds: float | None


@contextmanager
def open_fields(source: bytes | str | os.PathLike[str], variable: str | None, notes: Notes) -> Iterator[Any]:
    """Open the fields of depths, of water levels, of the bed and of what `variable` names as a dataset.

    A field is decoded when its values are asked for.
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
    """Content of a file, which is read from memory, so that nothing beside it counts."""
    if not isinstance(source, bytes) and Path(source).stat().st_size > LARGEST_FILE:
        raise LimitError(
            f"it is larger than {LARGEST_FILE:,} bytes; write the depths alone (cdo selname,NAME IN OUT), or NetCDF, "
            "which may be of any size (cdo -f nc copy IN OUT)"
        )
    return read_bytes(source)


def _dataset(file: "DatasetReader", variable: str | None) -> Any:
    """Dataset of the variables that can count."""
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
        if len(fields) == 1 and fields[0].meaning in BEDS:  # it is that of all times
            values = values.isel({time: 0})
        elif None not in times:
            coordinates[time] = (time, list(times), {"units": SINCE})
        variables[name] = values
    return xarray.Dataset(variables, coordinates)


def _coordinates(file: "DatasetReader") -> dict[str, Any]:
    """Places of columns and rows, and their reference system."""
    a, _, c, _, e, f = file.transform[:6]
    x, y = c + a * (np.arange(file.width) + 0.5), f + e * (np.arange(file.height) + 0.5)
    is_geographic = file.crs.is_geographic
    return {
        "x": ("x", x, {"units": "degrees_east"} if is_geographic else {}),
        "y": ("y", y, {"units": "degrees_north"} if is_geographic else {}),
        "spatial_ref": ((), 0, {"crs_wkt": file.crs.to_wkt()}),
    }


def _fields(file: "DatasetReader") -> list[Field]:
    """All fields of a file, in the order of their times."""
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
    """Fields by the names of their parameters, with the level where a parameter has several."""
    found: dict[tuple[str, str], list[Field]] = {}
    for field in fields:
        found.setdefault((field.element, field.level), []).append(field)
    elements = [element for element, _ in found]
    return {
        element if elements.count(element) == 1 else f"{element}:{level}": group
        for (element, level), group in found.items()
    }


def _choose_fields(found: dict[str, list[Field]], variable: str | None) -> dict[str, list[Field]]:
    """The variables that are known, and the one that the user names."""
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
    """Values of bands, (band, row, column), each read when it is asked for."""
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
