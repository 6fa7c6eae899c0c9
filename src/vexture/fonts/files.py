"""Files of fonts: TrueType and OpenType, collections of those, WOFF and WOFF2."""

import io
from typing import Final

from vexture.errors import DeviceError, SourceError, reason_of

__all__ = ["SUFFIXES", "is_sfnt", "sfnt_of"]

SUFFIXES: Final = (".ttf", ".otf", ".ttc", ".otc", ".woff", ".woff2")
"""Of files that hold fonts."""

SFNT: Final = (b"\0\1\0\0", b"OTTO", b"true", b"ttcf")
"""First bytes of fonts that HarfBuzz reads: TrueType, CFF, Apple's TrueType, collections."""

WOFF: Final = (b"wOFF", b"wOF2")

LARGEST_FONT: Final = 128 * 2**20
"""Bytes, after decompression; the largest fonts of the Han scripts have 30 MB."""


def sfnt_of(content: bytes) -> bytes:
    """Content of a font file as HarfBuzz reads it: that of a WOFF or WOFF2 decompressed.

    Raises a `SourceError` if it is no font, is damaged or too large, a `DeviceError` if a package is missing.
    """
    if content[:4] in WOFF:
        content = decompressed(content)
    if not is_sfnt(content):
        raise SourceError("holds no font; give a TrueType, OpenType, WOFF or WOFF2 font")
    if len(content) > LARGEST_FONT:
        raise SourceError(f"the font has {len(content):,} bytes, of at most {LARGEST_FONT:,}; give a subset of it")
    return content


def is_sfnt(start: bytes) -> bool:
    """Whether a file of some first bytes holds fonts as HarfBuzz reads them."""
    return start.startswith(SFNT)


def decompressed(content: bytes) -> bytes:
    """Font in a WOFF or WOFF2."""
    from fontTools.ttLib import TTFont

    if int.from_bytes(content[16:20]) > LARGEST_FONT:  # totalSfntSize: WOFF 2.0, 4.1
        raise SourceError(f"the font says that it has more than {LARGEST_FONT:,} bytes; give a subset of it")
    try:
        font = TTFont(io.BytesIO(content), recalcBBoxes=False, recalcTimestamp=False)
        font.flavor = None
        plain = io.BytesIO()
        font.save(plain)
    except ImportError:
        raise DeviceError("a WOFF2 font needs the package brotli; install it: pip install brotli") from None
    except Exception as error:  # fontTools raises whatever a damaged table leads to
        raise SourceError(f"the font is damaged ({reason_of(error)}); save it again") from None
    return plain.getvalue()
