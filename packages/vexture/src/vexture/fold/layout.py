"""Layout of the fold texture (FORMAT.md, part C), from which the shader and the web modules take their constants."""

from typing import Final

ENCODING_FOLD: Final = "fold"
FOLD_VERSION: Final = "1"
TEXT_FOLD: Final = "vexture.fold"
"""Key of the file's JSON text; the keys of version and encoding are those of the packed texture."""

FOLD_SUFFIX: Final = ".fold.ktx2"

FOLD_LINEAR: Final = 0
FOLD_SMOOTH_START: Final = 1
FOLD_SMOOTH_END: Final = 2
FOLD_SMOOTH_BOTH: Final = 3
FOLD_PERIODIC: Final = 4
"""Kinds of interpolation."""

FOLD_KIND_SHIFT: Final = 29
"""Position of the kind in a texel's third word, above the bits of its begin."""

FOLD_TICKS: Final = 65536
"""Units of time in a second."""

FOLD_MOST_SECONDS: Final = 8191
"""Largest begin, duration or cycle in seconds that fits below the kind."""

FOLD_MOST_SIDE: Final = 256
"""Most columns or rows; a fold is smooth, so few are enough."""

FOLD_MOST_DISPLACEMENT: Final = 1.0
"""Largest displacement along each axis, in unit-square units."""

FOLD_FILE_LIMIT: Final = 1 << 22
"""Largest file in bytes: four times the most texels, uncompressed."""
