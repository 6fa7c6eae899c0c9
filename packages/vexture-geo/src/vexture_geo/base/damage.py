"""Detect damage that GDAL ignores, in shapefiles and TopoJSON, and explain damage that netCDF reports badly."""

import json
from errno import E2BIG, EINVAL
from typing import Any, Final

from vexture.base.content import SHAPEFILE
from vexture.base.errors import SourceError, reason_of

HEADER: Final = 100
"""Bytes of the header of a .shp and of a .shx, which states the file's length."""

LENGTH: Final = slice(24, 28)
WORD: Final = 2
"""Bytes per word, the unit of that length."""


def refuse_cut(name: str, start: bytes, size: int) -> None:
    """Raise a `SourceError` if a .shp or .shx has fewer bytes than its header states.

    Examples
    --------
    >>> refuse_cut("a.shp", SHAPEFILE + bytes(20) + (100).to_bytes(4) + bytes(72), 150)
    Traceback (most recent call last):
    vexture.base.errors.SourceError: a.shp is damaged: it has 150 of the 200 bytes that it says; copy it again
    """
    if not start.startswith(SHAPEFILE):
        return  # GDAL reports the error
    said = WORD * int.from_bytes(start[LENGTH], "big", signed=True)
    if size < said:
        raise SourceError(f"{name} is damaged: it has {size:,} of the {said:,} bytes that it says; copy it again")


def missing_arcs(content: bytes) -> int:
    """Count geometries of a TopoJSON that refer to missing arcs.

    Examples
    --------
    >>> missing_arcs(b'{"arcs": [[]], "objects": {"a": {"geometries": [{"arcs": [[0, -1]]}, {"arcs": [[1]]}]}}}')
    1
    """
    try:
        topology = json.loads(content.decode("utf-8-sig"))
        count = len(topology["arcs"])
        objects = list(topology["objects"].values())
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return 0
    found = 0
    while objects:
        one = objects.pop()
        if isinstance(one, dict):
            objects += one.get("geometries") or []
            found += any(not -count <= arc < count for arc in _numbers(one.get("arcs")))
    return found


def _numbers(arcs: Any) -> list[int]:
    """Collect the numbers in nested lists."""
    found, left = list[int](), [arcs]
    while left:
        one = left.pop()
        if isinstance(one, list):
            left += one
        elif isinstance(one, int):
            found.append(one)
    return found


def netcdf_error(error: Exception, place: str) -> SourceError:
    """Make the error for a file that netCDF4, h5py or xarray cannot read.

    The netCDF library reports impossible sizes and types in a header as operating-system errors.

    Examples
    --------
    >>> print(netcdf_error(OSError(7, "Argument list too long"), "a.nc"))
    the NetCDF file is damaged (its header says what cannot be); write it again
    """
    if isinstance(error, OSError) and error.errno in (E2BIG, EINVAL):
        return SourceError("the NetCDF file is damaged (its header says what cannot be); write it again")
    return SourceError(f"it cannot be read as NetCDF ({reason_of(error, hidden=place)}); write it again")
