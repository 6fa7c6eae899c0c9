"""Files of fonts: TrueType and OpenType, collections of those, WOFF and WOFF2."""

import io
import logging
import struct
import zlib
from collections.abc import Collection
from importlib import import_module
from typing import Final

from vexture.base.errors import DeviceError, SourceError, reason_of

SUFFIXES: Final = (".ttf", ".otf", ".ttc", ".otc", ".woff", ".woff2")
"""Of files that hold fonts."""

SFNT: Final = (b"\0\1\0\0", b"OTTO", b"true", b"ttcf")
"""First bytes of fonts that HarfBuzz reads: TrueType, CFF, Apple's TrueType, collections."""

DESCRIBING: Final = frozenset({"OS/2", "STAT", "cmap", "fvar", "head", "hhea", "maxp", "name", "post"})
"""Tables that say what a face is called, which style it has and of which characters it has glyphs."""

WOFF, WOFF2 = b"wOFF", b"wOF2"
WOFF_HEADER, WOFF2_HEADER, METADATA = 44, 48, 20
"""Bytes of the headers, and of their end, which says where metadata is."""

LARGEST_FONT: Final = 64 * 2**20
"""Bytes, after decompression; the largest fonts of the Han scripts have 30 MB."""


def is_sfnt(start: bytes) -> bool:
    """Whether a file of some first bytes holds fonts as HarfBuzz reads them."""
    return start.startswith(SFNT)


def sfnt_of(content: bytes, tables: Collection[str] | None = None) -> bytes:
    """Content of a font file as HarfBuzz reads it: that of a WOFF or WOFF2 decompressed.

    Of a WOFF or WOFF2 it is some `tables` only, if they are given: the outlines of a WOFF2 take most of the time.

    Raises a `SourceError` if it is no font, is damaged or too large, a `DeviceError` if a package is missing.
    """
    check_size(len(content))
    if content.startswith((WOFF, WOFF2)):
        try:
            (check_woff if content.startswith(WOFF) else check_woff2)(content)
            content = decompress(content, tables)
        except (SourceError, DeviceError):
            raise
        except Exception as error:  # fontTools raises whatever a damaged table leads to
            raise SourceError(f"the font is damaged ({reason_of(error)}); save it again") from None
    if not is_sfnt(content):
        raise SourceError("holds no font; give a TrueType, OpenType, WOFF or WOFF2 font")
    return content


def check_size(size: int) -> None:
    """Raise a `SourceError` about a font that is too large."""
    if size > LARGEST_FONT:
        raise SourceError(f"the font is larger than {LARGEST_FONT:,} bytes; give a subset of it")


def check_woff(content: bytes) -> None:
    """Raise an error if fontTools would decompress more than a font may have: it trusts the tables (WOFF 1.0, 5)."""
    left = LARGEST_FONT
    (count,) = struct.unpack_from(">H", content, 12)
    for entry in range(count):
        start, packed, size = struct.unpack_from(">3I", content, WOFF_HEADER + 20 * entry + 4)
        if packed < size:  # else it is stored as it is
            left -= len(zlib.decompressobj().decompress(content[start : start + packed], left + 1))
            check_size(LARGEST_FONT - left)


def check_woff2(content: bytes) -> None:
    """Raise an error if fontTools would decompress more than a font may have (WOFF 2.0, 4)."""
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
    """Font in a WOFF or WOFF2, or some of its tables, without the metadata, which may be of any size."""
    from fontTools.ttLib import TTFont

    logging.getLogger("fontTools").addHandler(logging.NullHandler())  # errors are raised, and warnings are nobody's
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
