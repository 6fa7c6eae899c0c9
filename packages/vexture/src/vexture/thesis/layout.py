"""Layout of the thesis's textures (FORMAT.md, part A); the constants in GLSL and JavaScript are generated from it.

A texture is a pair of RGB images whose channels are read as numbers in [0, 1].
"""

from typing import Final

CONTROL_MIN: Final = -1.25
CONTROL_MAX: Final = 2.25
"""Range of P1 and P2 in their cell: 9/4, because max 3 (1 - t) t^2 = 4/9 (thesis 4.2.4)."""

FORMAT_VERSION: Final = "1"
ENCODING_THESIS: Final = "thesis"

QUADS_SUFFIX: Final = ".quads.png"
CURVES_SUFFIX: Final = ".curves.png"
"""Suffixes of the two files."""

QUAD_WIDTH: Final = 4
"""Pixels per row of the quad texture: one for each cell."""

CELL_ORDER: Final = (2, 3, 0, 1)
"""Cell of each pixel in a row, as (x half) + 2 (y half): top left, top right, bottom left, bottom right."""

KIND_CURVE: Final = 0.0
KIND_CORNER: Final = 0.5
KIND_QUAD: Final = 1.0
"""Kinds of a cell in its red channel (thesis 4.2.4 and 6.1.2)."""

THRESHOLD_CORNER: Final = 0.25
THRESHOLD_QUAD: Final = 0.75
"""Limits of the red channel: above THRESHOLD_QUAD is a quad, else above THRESHOLD_CORNER a corner, else a curve."""

CURVE_WIDTH: Final = 2
"""Pixels per row of the curve texture: one for P0 and x, one for P3 and y."""

FULL_ROW: Final = 0
EMPTY_ROW: Final = 1
CONSTANT_ROWS: Final = 2
"""First rows of the curve texture, which represent full and empty cells, and their number."""

LIST_LIMIT: Final = {8: 256, 16: 65_000}
"""Longest list for each number of bits; above 65,000, float32 does not decode every index."""

FILE_LIMIT: Final = 2 * LIST_LIMIT[16] * QUAD_WIDTH * 3 * 2
"""Limit in bytes of a file that is read: twice the pixels of the longest list, to have room for filters and texts."""

TEXT_TRANSFORM: Final = "vexture.transform"
TEXT_CRS: Final = "vexture.crs"
"""Keywords of PNG text chunks, besides those of every encoding (`vexture.base.layout`)."""
