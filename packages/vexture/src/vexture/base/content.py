"""Content of a source file: read and decompress its bytes, and recognise the kind of the file."""

import csv
import os
import re
import stat
import struct
import warnings
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from enum import StrEnum
from io import BytesIO
from pathlib import Path
from typing import Final, NamedTuple

from vexture.base.errors import EXPECTED, DeviceError, LimitError, ParameterError, SourceError

LARGEST_FILE: Final = 256 * 2**20
"""Largest file in bytes, after decompression."""

BYTE_ORDER_MARK: Final = b"\xef\xbb\xbf"

GZIP: Final = b"\x1f\x8b"
KTX: Final = b"\xabKTX"
FLATGEOBUF: Final = b"fgb\x03fgb"
SHAPEFILE: Final = b"\0\0\x27\x0a"
SQLITE: Final = b"SQLite format 3\0"
ZIP: Final = b"PK\x03\x04"
PARQUET: Final = b"PAR1"
ARROW: Final = b"ARROW1"
RECORD: Final = b"\x1e"
"""Separator before each text of a JSON text sequence (RFC 8142; RFC 7464, 2)."""

GEODATABASE: Final = "a00000001.gdbtable"
"""File in the folder of a FileGDB that lists its tables."""

TIFF: Final = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
NETCDF: Final = (b"CDF\x01", b"CDF\x02", b"CDF\x05", b"\x89HDF\r\n\x1a\n")
"""First bytes of TIFF and BigTIFF, and of all kinds of NetCDF."""

GRIB: Final = b"GRIB"
"""First bytes of all editions of GRIB."""

ESRI_GRID: Final = (b"ncols", b"nrows", b"xll", b"yll", b"cellsize")
"""First bytes of Esri's ASCII grid, in lower case; Esri's .flt starts with numbers, so it has no mark."""

PNG: Final = b"\x89PNG"
PICTURES: Final = (PNG, b"\xff\xd8\xff", b"GIF87a", b"GIF89a")
"""First bytes of PNG, JPEG and GIF; `kind_of` recognises WebP and BMP, whose marks have gaps."""

PICTURE_FORMATS: Final = ("PNG", "JPEG", "WEBP", "GIF", "BMP")
"""Supported picture formats, by their names in Pillow."""

PICTURE_FAULTS: Final = (OSError, SyntaxError, ValueError, EOFError, IndexError, TypeError, KeyError, struct.error)
"""Errors that Pillow raises for damaged pictures."""

VECTOR_FILES: Final = (
    "GeoPackage, SpatiaLite, FlatGeobuf, shapefile, FileGDB, KML, KMZ, GPX, GML, GeoParquet, Feather, CSV of places"
)
"""Formats of features besides GeoJSON, as messages list them."""

READABLE: Final = (
    "give an SVG, GeoJSON, a picture (PNG, JPEG, WebP, GIF, BMP) or geographic data (GeoPackage, FlatGeobuf, zipped "
    "shapefile or FileGDB, KML, GPX, GML, GeoParquet, Feather, CSV, GeoTIFF, NetCDF, GRIB, Esri grid)"
)
"""Remedy for a file of an unknown kind."""

BEFORE_MARKUP: Final = BYTE_ORDER_MARK + b"\xff\xfe\0 \t\r\n"
"""Bytes that may precede the first < of XML in UTF-8, UTF-16 or UTF-32."""

START: Final = 4096
"""Number of bytes from which the kind of a file is recognised: more than the white space at the start of a text."""

PROLOG: Final = re.compile(r"\s*(?:<\?.*?\?>|<!--.*?-->|<!DOCTYPE[^\[>]*(?:\[.*?\]\s*)?>)", re.DOTALL)
ROOT: Final = re.compile(r"\s*<(?:[\w.-]+:)?([\w.-]+)")
"""Markup that may precede the root element of XML; start of the root element, with its name without a prefix."""

GML: Final = "http://www.opengis.net/gml"
"""Common start of the names of GML's namespaces, which every file of GML features declares."""

DELIMITERS: Final = ",;\t|"
LONGITUDES: Final = ("longitude", "lon", "long", "lng")
LATITUDES: Final = ("latitude", "lat")
ACROSS: Final = ("x", "easting")
UP: Final = ("y", "northing")
TEXTS: Final = ("wkt", "geom_wkt", "wkt_geom", "geometry", "geom", "the_geom")
"""CSV columns with places of features, in lower case: degrees, coordinates of any system, and geometries in WKT."""


class FileKind(StrEnum):
    """Kind of a file's content, which decides how it is read."""

    TEXTURE = "texture"
    PICTURE = "picture"
    GEOJSON = "GeoJSON"
    AREAS = "areas"
    DEPTHS = "depths"
    SVG = "SVG"


SUFFIXES: Final[dict[FileKind, tuple[str, ...]]] = {
    FileKind.TEXTURE: (".ktx2",),
    FileKind.GEOJSON: (".geojson", ".json", ".geojsons", ".geojsonl", ".ndjson"),
    FileKind.AREAS: (".gpkg", ".fgb", ".shp", ".gdb", ".kml", ".kmz", ".gpx", ".gml", ".csv", ".tsv", ".sqlite"),
    FileKind.DEPTHS: (".tif", ".tiff", ".nc", ".nc4", ".cdf", ".asc", ".flt", ".grib", ".grib2", ".grb", ".grb2"),
}
"""Suffixes that select the reader of unrecognised content, as that reader reports best what is wrong with the file."""


def kind_of(start: bytes, file_name: str | os.PathLike[str] = "") -> FileKind:
    r"""Recognise the kind of a file by its first bytes (from `start_of`), else by its suffix; ``SVG`` by default.

    Examples
    --------
    >>> kind_of(b"GIF89a"), kind_of(b"RIFF\x1a\0\0\0WEBPVP8L")
    (<FileKind.PICTURE: 'picture'>, <FileKind.PICTURE: 'picture'>)
    >>> kind_of(b'  {"type": "Feature"}', "delft.svg"), kind_of(b"<svg/>", "delft.geojson")
    (<FileKind.GEOJSON: 'GeoJSON'>, <FileKind.SVG: 'SVG'>)
    >>> kind_of(b"CDF\x01", "run"), kind_of(b"fgb\x03fgb", "run.nc"), kind_of(b"?", "run.nc")
    (<FileKind.DEPTHS: 'depths'>, <FileKind.AREAS: 'areas'>, <FileKind.DEPTHS: 'depths'>)
    >>> kind_of(b"<gpx/>"), kind_of(b"name,lat,lon"), kind_of(b"name,width")
    (<FileKind.AREAS: 'areas'>, <FileKind.AREAS: 'areas'>, <FileKind.SVG: 'SVG'>)
    """
    if start.startswith(KTX):
        return FileKind.TEXTURE
    webp = start.startswith(b"RIFF") and start[8:12] == b"WEBP"
    if start.startswith(PICTURES) or webp or (start.startswith(b"BM") and start[6:10] == bytes(4)):
        return FileKind.PICTURE
    if start.startswith((FLATGEOBUF, SHAPEFILE, SQLITE, ZIP, PARQUET, ARROW)) or markup_of(start):
        return FileKind.AREAS
    if start.startswith((*TIFF, *NETCDF, GRIB)) or start.lstrip().lower().startswith(ESRI_GRID):
        return FileKind.DEPTHS
    first = start.removeprefix(BYTE_ORDER_MARK).lstrip()[:1]
    if first in (b"{", RECORD):
        return FileKind.GEOJSON
    if first != b"<" and header_of(start).has_places:
        return FileKind.AREAS
    suffix = Path(file_name).suffix.lower()
    named = next((kind for kind, suffixes in SUFFIXES.items() if suffix in suffixes), FileKind.SVG)
    return FileKind.SVG if first == b"<" else named


def known_kind(start: bytes, file_name: str | os.PathLike[str] = "") -> FileKind:
    """Return `kind_of` of a file; raise a `SourceError` if the file is empty or its content is of no known kind."""
    if not start:
        raise SourceError(f"is empty; {READABLE}")
    kind = kind_of(start, file_name)
    no_texture = kind is FileKind.TEXTURE and not start.startswith(KTX)
    if no_texture or (kind is FileKind.SVG and not start.lstrip(BEFORE_MARKUP).startswith(b"<")):
        raise SourceError(f"holds nothing that can be read; {READABLE}")
    return kind


def markup_of(start: bytes) -> str:
    """Return ``kml``, ``gpx`` or ``gml`` if a file with these first bytes is one of them, else an empty text.

    Examples
    --------
    >>> markup_of(b'<?xml version="1.0"?><!-- a --><kml/>'), markup_of(b"<svg/>")
    ('kml', '')
    """
    if not start.lstrip(BEFORE_MARKUP).startswith(b"<"):
        return ""
    wide = {b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16", b"<\0": "utf-16-le", b"\0<": "utf-16-be"}
    text = start.decode(wide.get(start[:2], "utf-8-sig"), errors="replace")
    at = 0
    while found := PROLOG.match(text, at):
        at = found.end()
    root = ROOT.match(text, at)
    if root is None or root[1] == "svg":
        return ""
    return root[1] if root[1] in ("kml", "gpx") else "gml" if GML in text[at:] else ""


class Header(NamedTuple):
    """First line of a CSV file: its columns, their delimiter, and the columns with the places of features."""

    names: tuple[str, ...]
    delimiter: str
    text: str | None = None
    across: str | None = None
    up: str | None = None

    @property
    def has_places(self) -> bool:
        """True if there are columns of places."""
        return self.text is not None or (self.across is not None and self.up is not None)

    @property
    def is_degrees(self) -> bool:
        """True if the names of the columns say that places are longitudes and latitudes."""
        return self.text is None and str(self.across).lower() in LONGITUDES


def header_of(start: bytes) -> Header:
    r"""Parse the header of a CSV file from its first bytes; without columns if its first line is not printable text.

    Examples
    --------
    >>> header_of(b"name;Lat;Lon\n1;52;4\n")[2:]
    (None, 'Lon', 'Lat')
    """
    line = start.decode("utf-8-sig", errors="replace").splitlines()[:1]
    if not line or not line[0].replace("\t", " ").isprintable():
        return Header((), ",")
    delimiter = max(DELIMITERS, key=line[0].count)
    try:
        names = tuple(name.strip() for name in next(csv.reader(line, delimiter=delimiter), ()))
    except csv.Error:
        return Header((), ",")
    known = {name.lower(): name for name in reversed(names)}
    across, up = _first(known, LONGITUDES), _first(known, LATITUDES)
    if across is None or up is None:
        across, up = _first(known, ACROSS), _first(known, UP)
    return Header(names, delimiter, _first(known, TEXTS), across, up)


def _first(known: Mapping[str, str], names: tuple[str, ...]) -> str | None:
    return next((known[name] for name in names if name in known), None)


def is_geodatabase(source: str | os.PathLike[str] | bytes) -> bool:
    """Return whether a source is the folder of a FileGDB."""
    try:
        return not isinstance(source, bytes) and Path(source, GEODATABASE).is_file()
    except (OSError, ValueError):
        return False


def picture_size(content: bytes) -> tuple[str, int, int] | None:
    """Format, width and height in pixels that a picture declares; None if the content is not a picture."""
    if kind_of(start_of(content)) is not FileKind.PICTURE:
        return None
    from PIL import Image

    try:
        with warnings.catch_warnings(action="ignore"), Image.open(BytesIO(content), formats=PICTURE_FORMATS) as picture:
            return str(picture.format), picture.width, picture.height
    except (Image.DecompressionBombError, *PICTURE_FAULTS):
        return None  # too large or damaged: its reader reports it


def start_of(source: str | os.PathLike[str] | bytes) -> bytes:
    """Return the first bytes of a file or of its content; empty if it cannot be read, which its reader reports."""
    if isinstance(source, bytes):
        return source[:START]
    try:
        with Path(source).open("rb") as file:
            return file.read(START)
    except (OSError, ValueError):
        return b""


def is_stream(source: str | os.PathLike[str] | bytes) -> bool:
    """Return whether a source is the path of a pipe, a terminal or the like, which can be read only once."""
    if isinstance(source, bytes):
        return False
    try:
        mode = os.stat(source).st_mode
    except (OSError, ValueError):
        return False
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


def unpack_source(source: str | os.PathLike[str] | bytes) -> str | os.PathLike[str] | bytes:
    """Return the content of a gzipped file or a stream, else the source itself; errors as in `read_bytes`."""
    if is_stream(source):
        return read_bytes(source)
    return read_bytes(source) if start_of(source).startswith(GZIP) else source


def read_bytes(source: str | os.PathLike[str] | bytes) -> bytes:
    """Return the content of a file, or content passed as bytes, decompressed if it is gzip (`.svgz`).

    Raises a `SourceError` if the file cannot be read, is damaged or too large.
    """
    if isinstance(source, bytes):
        return decompress(source)
    try:
        with Path(source).open("rb") as file:
            content = file.read(LARGEST_FILE + 1)
    except (OSError, ValueError) as error:  # ValueError: a null character in the name
        if isinstance(error, OSError) and Path(source).is_dir():
            raise SourceError("is a folder, and no FileGDB; name a file in it") from None
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise SourceError(f"cannot be read: {reason}; check the file's name and permissions") from None
    return decompress(content)


def decompress(content: bytes) -> bytes:
    """Decompress content if it is gzip, else return it unchanged; errors as in `read_bytes`."""
    if content.startswith(GZIP):
        stream = zlib.decompressobj(wbits=zlib.MAX_WBITS | 16)
        try:
            content = stream.decompress(content, LARGEST_FILE + 1)
        except zlib.error as error:
            raise SourceError(f"the gzip data is damaged ({error}); save the file again") from None
        if not stream.eof and len(content) <= LARGEST_FILE:
            raise SourceError("the gzip data breaks off; save the file again")
    if len(content) > LARGEST_FILE:
        raise SourceError(f"the file is larger than {LARGEST_FILE:,} bytes; simplify or split the drawing")
    return content


@contextmanager
def about(source: str) -> Iterator[None]:
    """Prefix the errors about a source with its name."""
    try:
        yield
    except (SourceError, LimitError, DeviceError, ParameterError) as error:
        raise type(error)(f"{source}: {error}") from None


@contextmanager
def renaming(names: Mapping[str, str]) -> Iterator[None]:
    """Translate the names of parameters in errors of an inner function to those of its caller.

    Examples
    --------
    >>> with renaming({"color": "column"}):
    ...     raise ParameterError("it has no column 'a' for `color`")
    Traceback (most recent call last):
    vexture.base.errors.ParameterError: it has no column 'a' for `column`
    """
    try:
        yield
    except EXPECTED as error:
        text = re.sub(r"`(\w+)`", lambda found: f"`{names.get(found[1], found[1])}`", str(error))
        raise type(error)(text) from None
