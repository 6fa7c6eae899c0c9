"""Font files: TrueType and OpenType, collections, WOFF and WOFF2."""

import io
import logging
import struct
import zlib
from collections.abc import Collection
from importlib import import_module
from typing import Final

from vexture.base.errors import DeviceError, SourceError, reason_of

SUFFIXES: Final = (".ttf", ".otf", ".ttc", ".otc", ".woff", ".woff2")
"""Suffixes of font files."""

SFNT: Final = (b"\0\1\0\0", b"OTTO", b"true", b"ttcf")
"""First bytes of the fonts that HarfBuzz reads: TrueType, CFF, Apple's TrueType, collections."""

DESCRIBING: Final = frozenset({"OS/2", "STAT", "cmap", "fvar", "head", "hhea", "maxp", "name", "post"})
"""Tables that state the names, the style and the characters of a face."""

WOFF, WOFF2 = b"wOFF", b"wOF2"
WOFF_HEADER, WOFF2_HEADER, METADATA = 44, 48, 20
"""Lengths of the headers, and of the part at their end that locates the metadata."""

LARGEST_FONT: Final = 64 * 2**20
"""Largest font in bytes, after decompression; the largest fonts for Han scripts have 30 MB."""


def is_sfnt(start: bytes) -> bool:
    """Return whether a file with these first bytes is a font that HarfBuzz reads."""
    return start.startswith(SFNT)


def sfnt_of(content: bytes, tables: Collection[str] | None = None) -> bytes:
    """Return the content of a font file as HarfBuzz reads it; WOFF and WOFF2 are decompressed.

    If `tables` are given, only these are decompressed, because the outlines of a WOFF2 take most of the time. Raise a
    `SourceError` if it is not a font, is damaged or too large, and a `DeviceError` if a package is missing.
    """
    check_size(len(content))
    if content.startswith((WOFF, WOFF2)):
        try:
            (check_woff if content.startswith(WOFF) else check_woff2)(content)
            content = decompress(content, tables)
        except (SourceError, DeviceError):
            raise
        except Exception as error:  # fontTools raises all kinds of errors for damaged tables
            raise SourceError(f"the font is damaged ({reason_of(error)}); save it again") from None
    if not is_sfnt(content):
        raise SourceError("holds no font; give a TrueType, OpenType, WOFF or WOFF2 font")
    return content


def check_size(size: int) -> None:
    """Raise a `SourceError` if a font is too large."""
    if size > LARGEST_FONT:
        raise SourceError(f"the font is larger than {LARGEST_FONT:,} bytes; give a subset of it")


def check_woff(content: bytes) -> None:
    """Raise an error if decompression would exceed the largest font: fontTools trusts the table (WOFF 1.0, 5)."""
    left = LARGEST_FONT
    (count,) = struct.unpack_from(">H", content, 12)
    for entry in range(count):
        start, packed, size = struct.unpack_from(">3I", content, WOFF_HEADER + 20 * entry + 4)
        if packed < size:  # otherwise it is stored uncompressed
            left -= len(zlib.decompressobj().decompress(content[start : start + packed], left + 1))
            check_size(LARGEST_FONT - left)


def check_woff2(content: bytes) -> None:
    """Raise an error if decompression would exceed the largest font (WOFF 2.0, 4)."""
    from fontTools.ttLib.woff2 import WOFF2DirectoryEntry

    try:
        brotli = import_module("brotli")
    except ImportError:
        raise DeviceError("WOFF2 fonts need the package brotli; install it: pip install 'vexture[text]'") from None
    file = io.BytesIO(content)
    count, packed = struct.unpack_from(">H6xI", content, 12)
    file.seek(WOFF2_HEADER)
    for _ in range(count):
        WOFF2DirectoryEntry().fromFile(file)
    check_size(len(brotli.Decompressor().process(file.read(packed), output_buffer_limit=LARGEST_FONT + 1)))


def decompress(content: bytes, tables: Collection[str] | None) -> bytes:
    """Decompress a WOFF or WOFF2, or some of its tables, without the metadata, whose size is unlimited."""
    from fontTools.ttLib import TTFont

    logging.getLogger("fontTools").addHandler(logging.NullHandler())  # errors are raised, and nobody needs the warnings
    header = WOFF_HEADER if content.startswith(WOFF) else WOFF2_HEADER
    file = io.BytesIO(content[: header - METADATA] + bytes(METADATA) + content[header:])
    font = TTFont(file, recalcBBoxes=False, recalcTimestamp=False)
    font.flavor = None
    if tables is not None:
        for tag in set(font.reader.keys()) - set(tables):
            del font[tag]
    plain = io.BytesIO()
    font.save(plain, reorderTables=None)
    return plain.getvalue()
