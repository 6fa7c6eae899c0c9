"""Which reader a file needs, by its suffix or its first bytes."""

import os
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Final

from vexture.errors import LimitError, SourceError, SourceWarning

if TYPE_CHECKING:
    from vexture.drawing import Drawing

__all__ = [
    "BYTE_ORDER_MARK",
    "FLATGEOBUF",
    "NETCDF",
    "PNG",
    "SHAPEFILE",
    "SQLITE",
    "TIFF",
    "ZIP",
    "holds_depths",
    "is_geographic",
    "is_geojson",
    "is_picture",
    "read_drawing",
    "start_of",
]

GEOJSON_SUFFIXES: Final = (".geojson", ".json")
BYTE_ORDER_MARK: Final = b"\xef\xbb\xbf"

FLATGEOBUF: Final = b"fgb\x03fgb"
KTX: Final = b"\xabKTX"
SHAPEFILE: Final = b"\0\0\x27\x0a"
SQLITE: Final = b"SQLite format 3\0"
ZIP: Final = b"PK\x03\x04"

TIFF: Final = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
NETCDF: Final = (b"CDF\x01", b"CDF\x02", b"CDF\x05", b"\x89HDF\r\n\x1a\n")
"""How TIFF and BigTIFF start, and NetCDF of all kinds."""

PNG: Final = b"\x89PNG"
PICTURES: Final = (PNG, b"\xff\xd8\xff", b"GIF87a", b"GIF89a")
"""How PNG, JPEG and GIF start; WebP and BMP have something in between."""

DEPTH_SUFFIXES: Final = (".tif", ".tiff", ".nc", ".nc4", ".cdf")
AREA_SUFFIXES: Final = (".gpkg", ".fgb", ".shp")

START: Final = 64
"""Bytes that tell what a file is."""


def is_geojson(start: bytes, file_name: str | os.PathLike[str]) -> bool:
    """Whether a file is GeoJSON, from how its content starts and what it is called.

    Examples
    --------
    >>> is_geojson(b'  {"type": "Feature"}', "delft"), is_geojson(b"<svg/>", "delft.svg")
    (True, False)
    """
    by_name = Path(file_name).suffix.lower() in GEOJSON_SUFFIXES
    return by_name or start.removeprefix(BYTE_ORDER_MARK).lstrip()[:1] == b"{"


def holds_depths(start: bytes, file_name: str | os.PathLike[str]) -> bool:
    r"""Whether a file is a grid or a mesh, which may hold depths: GeoTIFF, NetCDF.

    Its first bytes decide; its name only where they say nothing.

    Examples
    --------
    >>> holds_depths(b"CDF\x01", "run"), holds_depths(b"fgb\x03fgb", "run.nc")
    (True, False)
    """
    if start.startswith((*TIFF, *NETCDF)):
        return True
    return Path(file_name).suffix.lower() in DEPTH_SUFFIXES and not _holds_areas(start)


def _holds_areas(start: bytes) -> bool:
    text = start.removeprefix(BYTE_ORDER_MARK).lstrip()[:1] == b"{"
    return text or start.startswith((FLATGEOBUF, SHAPEFILE, SQLITE, ZIP))


def is_picture(start: bytes) -> bool:
    r"""Whether a file is a picture of pixels, from how its content starts: PNG, JPEG, GIF, WebP or BMP.

    Examples
    --------
    >>> is_picture(b"GIF89a"), is_picture(b"RIFF\x1a\0\0\0WEBPVP8L"), is_picture(b"<svg/>")
    (True, True, False)
    """
    if start.startswith(PICTURES):
        return True
    webp = start.startswith(b"RIFF") and start[8:12] == b"WEBP"
    return webp or (start.startswith(b"BM") and start[6:10] == bytes(4))


def is_geographic(start: bytes, file_name: str | os.PathLike[str]) -> bool:
    r"""Whether a file is geographic data, which `read_extent` reads: GeoJSON is, as are GeoPackage and NetCDF.

    Parameters
    ----------
    start : bytes
        How its content starts, as `start_of` gives it.
    file_name : path
        What it is called.

    Examples
    --------
    >>> is_geographic(b"SQLite format 3\0", "flood"), is_geographic(b"<svg/>", "flood.svg")
    (True, False)
    """
    if is_geojson(start, file_name) or _holds_areas(start) or holds_depths(start, file_name):
        return True
    return Path(file_name).suffix.lower() in AREA_SUFFIXES


def read_drawing(path: str | os.PathLike[str], select: str | None = None) -> "Drawing":
    """Read a drawing of any kind of file that there is a reader for.

    Parameters
    ----------
    path : path
        SVG, GeoJSON, or other geographic data with the packages of ``vexture[gis]``: of a series, its first step; or
        PNG, JPEG, WebP, GIF or BMP with the package of ``vexture[trace]``.
    select : str, optional
        A CSS selector, of SVG only.

    Raises
    ------
    SourceError
        If it cannot be read.
    LimitError
        If `select` is given where it means nothing, or as `read_svg` says.
    """
    start = start_of(path)
    if start.startswith(KTX):
        raise SourceError(f"{os.fspath(path)}: is a texture already; give the drawing that it was made from")
    if is_picture(start):
        if select is not None:
            raise LimitError(f"{os.fspath(path)}: select={select!r} chooses elements of an SVG; leave it out")
        from vexture.tracing.trace import read_image

        return read_image(path)
    if is_geographic(start, path):
        if select is not None:
            raise LimitError(f"{os.fspath(path)}: select={select!r} chooses elements of an SVG; leave it out")
        if not is_geojson(start, path):
            return _read_geographic(path)
        from vexture.geo.geojson import read_geojson

        return read_geojson(path)
    from vexture.svg.read import read_svg

    return read_svg(path, select)


def _read_geographic(path: str | os.PathLike[str]) -> "Drawing":
    """Where water is, of a file that need not say where in the world it is."""
    from vexture.geo.extent import read_extent
    from vexture.geo.reference import UNPLACED, MissingReferenceError

    name = Path(path).name
    try:
        extent = read_extent(path, name)
    except MissingReferenceError:
        extent = read_extent(path, name, crs=UNPLACED)
    if len(extent.steps) > 1:
        warnings.warn(
            SourceWarning(
                f"{name}: it has {len(extent.steps)} times, of which the first is read; vexture flood shows all"
            ),
            stacklevel=3,
        )
    return extent.steps[0].drawing


def start_of(source: str | os.PathLike[str] | bytes) -> bytes:
    """Return first bytes of a file, or of its content; none if it cannot be read: the reader says why."""
    if isinstance(source, bytes):
        return source[:START]
    try:
        with Path(source).open("rb") as file:
            return file.read(START)
    except (OSError, ValueError):
        return b""
