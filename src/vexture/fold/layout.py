"""The one owner of the fold texture's bits (FORMAT.md, part C); shader and web get their constants from here."""

from typing import Final

__all__ = [
    "ENCODING_FOLD",
    "FOLD_FILE_LIMIT",
    "FOLD_KIND_SHIFT",
    "FOLD_LINEAR",
    "FOLD_MOST_DISPLACEMENT",
    "FOLD_MOST_SECONDS",
    "FOLD_MOST_SIDE",
    "FOLD_PERIODIC",
    "FOLD_SMOOTH_BOTH",
    "FOLD_SMOOTH_END",
    "FOLD_SMOOTH_START",
    "FOLD_SUFFIX",
    "FOLD_TICKS",
    "FOLD_VERSION",
    "TEXT_FOLD",
]

ENCODING_FOLD: Final = "fold"
FOLD_VERSION: Final = "1"
TEXT_FOLD: Final = "vexture.fold"
"""Key of the file's JSON text; version and encoding have the keys of the packed texture."""

FOLD_SUFFIX: Final = ".fold.ktx2"

FOLD_LINEAR: Final = 0
FOLD_SMOOTH_START: Final = 1
FOLD_SMOOTH_END: Final = 2
FOLD_SMOOTH_BOTH: Final = 3
FOLD_PERIODIC: Final = 4
"""Kinds of interpolation."""

FOLD_KIND_SHIFT: Final = 29
"""A texel's third word holds the kind above this many bits of its begin."""

FOLD_TICKS: Final = 65536
"""Units of time in a second."""

FOLD_MOST_SECONDS: Final = 8191
"""Of a begin, a duration, a cycle: what fits below the kind."""

FOLD_MOST_SIDE: Final = 256
"""Columns or rows: a fold is smooth, so it needs few."""

FOLD_MOST_DISPLACEMENT: Final = 1.0
"""Along each axis, in sides of the unit square."""

FOLD_FILE_LIMIT: Final = 1 << 22
"""Bytes. A longer file is not read: it is four times the most texels, not deflated."""
