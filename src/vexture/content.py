"""The content of a source file: its bytes, and the kind of file that they are."""

import os
import re
import stat
import warnings
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from enum import StrEnum
from io import BytesIO
from pathlib import Path
from typing import Final

from vexture.errors import EXPECTED, DeviceError, LimitError, ParameterError, SourceError

__all__ = [
    "BEFORE_MARKUP",
    "BYTE_ORDER_MARK",
    "ESRI_GRID",
    "FLATGEOBUF",
    "LARGEST_FILE",
    "NETCDF",
    "PICTURE_FORMATS",
    "PNG",
    "READABLE",
    "SHAPEFILE",
    "SQLITE",
    "TIFF",
    "ZIP",
    "FileKind",
    "about",
    "decompressed",
    "is_stream",
    "kind_of",
    "known_kind",
    "picture_size",
    "read_bytes",
    "renaming",
    "start_of",
    "unpacked",
]

LARGEST_FILE: Final = 256 * 2**20
"""Bytes, after decompression."""

BYTE_ORDER_MARK: Final = b"\xef\xbb\xbf"

GZIP: Final = b"\x1f\x8b"
KTX: Final = b"\xabKTX"
FLATGEOBUF: Final = b"fgb\x03fgb"
SHAPEFILE: Final = b"\0\0\x27\x0a"
SQLITE: Final = b"SQLite format 3\0"
ZIP: Final = b"PK\x03\x04"

TIFF: Final = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
NETCDF: Final = (b"CDF\x01", b"CDF\x02", b"CDF\x05", b"\x89HDF\r\n\x1a\n")
"""First bytes of TIFF and BigTIFF, and of NetCDF of all kinds."""

ESRI_GRID: Final = (b"ncols", b"nrows", b"xll", b"yll", b"cellsize")
"""First bytes of Esri's ASCII grid, in lower case; those of its .flt are numbers."""

PNG: Final = b"\x89PNG"
PICTURES: Final = (PNG, b"\xff\xd8\xff", b"GIF87a", b"GIF89a")
"""First bytes of PNG, JPEG and GIF; `kind_of` knows WebP and BMP, whose marks have gaps."""

PICTURE_FORMATS: Final = ("PNG", "JPEG", "WEBP", "GIF", "BMP")
"""Pictures that are read, as Pillow names them."""

READABLE: Final = (
    "give an SVG, GeoJSON, a picture (PNG, JPEG, WebP, GIF, BMP) or geographic data "
    "(GeoPackage, FlatGeobuf, zipped shapefile, GeoTIFF, NetCDF, Esri .asc and .flt)"
)
"""Remedy for a file of no kind that can be read."""

BEFORE_MARKUP: Final = BYTE_ORDER_MARK + b"\xff\xfe\0 \t\r\n"
"""Bytes that may stand before the first < of XML in UTF-8, UTF-16 or UTF-32."""

START: Final = 4096
"""Bytes that tell what a file is: more than the white space at the start of a text."""


class FileKind(StrEnum):
    """What a file holds, which decides how it is read."""

    TEXTURE = "texture"
    PICTURE = "picture"
    GEOJSON = "GeoJSON"
    AREAS = "areas"
    DEPTHS = "depths"
    SVG = "SVG"


SUFFIXES: Final[dict[FileKind, tuple[str, ...]]] = {
    FileKind.TEXTURE: (".ktx2",),
    FileKind.GEOJSON: (".geojson", ".json"),
    FileKind.AREAS: (".gpkg", ".fgb", ".shp"),
    FileKind.DEPTHS: (".tif", ".tiff", ".nc", ".nc4", ".cdf", ".asc", ".flt"),
}
"""Suffixes for files of unknown content: the reader that they name reports best what is wrong with them."""


def kind_of(start: bytes, file_name: str | os.PathLike[str] = "") -> FileKind:
    r"""Kind of a file by its first bytes (from `start_of`), or else by its suffix; ``SVG`` if neither decides.

    Examples
    --------
    >>> kind_of(b"GIF89a"), kind_of(b"RIFF\x1a\0\0\0WEBPVP8L")
    (<FileKind.PICTURE: 'picture'>, <FileKind.PICTURE: 'picture'>)
    >>> kind_of(b'  {"type": "Feature"}', "delft.svg"), kind_of(b"<svg/>", "delft.geojson")
    (<FileKind.GEOJSON: 'GeoJSON'>, <FileKind.SVG: 'SVG'>)
    >>> kind_of(b"CDF\x01", "run"), kind_of(b"fgb\x03fgb", "run.nc"), kind_of(b"?", "run.nc")
    (<FileKind.DEPTHS: 'depths'>, <FileKind.AREAS: 'areas'>, <FileKind.DEPTHS: 'depths'>)
    """
    if start.startswith(KTX):
        return FileKind.TEXTURE
    webp = start.startswith(b"RIFF") and start[8:12] == b"WEBP"
    if start.startswith(PICTURES) or webp or (start.startswith(b"BM") and start[6:10] == bytes(4)):
        return FileKind.PICTURE
    if start.startswith((FLATGEOBUF, SHAPEFILE, SQLITE, ZIP)):
        return FileKind.AREAS
    if start.startswith((*TIFF, *NETCDF)) or start.lstrip().lower().startswith(ESRI_GRID):
        return FileKind.DEPTHS
    first = start.removeprefix(BYTE_ORDER_MARK).lstrip()[:1]
    if first == b"{":
        return FileKind.GEOJSON
    suffix = Path(file_name).suffix.lower()
    named = next((kind for kind, suffixes in SUFFIXES.items() if suffix in suffixes), FileKind.SVG)
    return FileKind.SVG if first == b"<" else named


def known_kind(start: bytes, file_name: str | os.PathLike[str] = "") -> FileKind:
    """Kind of a file as `kind_of` says; raises a `SourceError` if it is empty or its content is of no known kind."""
    if not start:
        raise SourceError(f"is empty; {READABLE}")
    kind = kind_of(start, file_name)
    no_texture = kind is FileKind.TEXTURE and not start.startswith(KTX)
    if no_texture or (kind is FileKind.SVG and not start.lstrip(BEFORE_MARKUP).startswith(b"<")):
        raise SourceError(f"holds nothing that can be read; {READABLE}")
    return kind


def picture_size(content: bytes) -> tuple[str, int, int] | None:
    """What a picture is, its width and its height in pixels, as it declares them; None if it is no picture."""
    if kind_of(start_of(content)) is not FileKind.PICTURE:
        return None
    from PIL import Image

    try:
        with warnings.catch_warnings(action="ignore"), Image.open(BytesIO(content), formats=PICTURE_FORMATS) as picture:
            return str(picture.format), picture.width, picture.height
    except (Image.DecompressionBombError, OSError, SyntaxError, ValueError, EOFError, IndexError, TypeError, KeyError):
        return None  # too large or damaged; who reads it says so


def start_of(source: str | os.PathLike[str] | bytes) -> bytes:
    """Return the first bytes of a file or of its content; none if it cannot be read: the reader says why."""
    if isinstance(source, bytes):
        return source[:START]
    try:
        with Path(source).open("rb") as file:
            return file.read(START)
    except (OSError, ValueError):
        return b""


def is_stream(source: str | os.PathLike[str] | bytes) -> bool:
    """Whether a source is the path of a pipe, a terminal or the like, which can be read only once."""
    if isinstance(source, bytes):
        return False
    try:
        mode = os.stat(source).st_mode
    except (OSError, ValueError):
        return False
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


def unpacked(source: str | os.PathLike[str] | bytes) -> str | os.PathLike[str] | bytes:
    """Return the source itself or, of a gzipped file or a stream, its content; raises as `read_bytes` does."""
    if is_stream(source):
        return read_bytes(source)
    return read_bytes(source) if start_of(source).startswith(GZIP) else source


def read_bytes(source: str | os.PathLike[str] | bytes) -> bytes:
    """Content of a file, or the content that is given, decompressed if it is gzip (`.svgz`).

    Raises a `SourceError` if it cannot be read, is damaged or too large.
    """
    if isinstance(source, bytes):
        return decompressed(source)
    try:
        with Path(source).open("rb") as file:
            content = file.read(LARGEST_FILE + 1)
    except (OSError, ValueError) as error:  # ValueError: a null character in the name
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise SourceError(f"cannot be read: {reason}; check the file's name and permissions") from None
    return decompressed(content)


def decompressed(content: bytes) -> bytes:
    """Content that may be gzip, as it is or decompressed; raises as `read_bytes` does."""
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
    """Put the name of a source in front of the errors about it."""
    try:
        yield
    except (SourceError, LimitError, DeviceError, ParameterError) as error:
        raise type(error)(f"{source}: {error}") from None


@contextmanager
def renaming(names: Mapping[str, str]) -> Iterator[None]:
    """Let errors call parameters as who is called does, rather than as what it calls.

    Examples
    --------
    >>> with renaming({"color": "column"}):
    ...     raise ParameterError("it has no column 'a' for `color`")
    Traceback (most recent call last):
    vexture.errors.ParameterError: it has no column 'a' for `column`
    """
    try:
        yield
    except EXPECTED as error:
        text = re.sub(r"`(\w+)`", lambda found: f"`{names.get(found[1], found[1])}`", str(error))
        raise type(error)(text) from None
