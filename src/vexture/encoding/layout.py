"""The one owner of the textures' bits; shader text gets its constants from here (`vexture.shaders`).

The thesis encoding (FORMAT.md, part A) is a pair of RGB textures whose channels are read as numbers in [0, 1]. The
packed encoding (part B) is one texture of four 32-bit words to a texel, in which quads and curves share one index.
"""

from typing import Final

from vexture.quadtree.tree import CONTROL_MAX, CONTROL_MIN, LATTICE, MOST_CURVES, MOST_DEPTH

__all__ = [
    "CELL_BITS",
    "CELL_ORDER",
    "CONSTANT_ROWS",
    "CONTROL_MAX",
    "CONTROL_MIN",
    "CONTROL_OFFSET",
    "COORDINATE_BITS",
    "COUNT_SHIFT",
    "COVERAGE_ONE",
    "CURVES_SUFFIX",
    "CURVE_WIDTH",
    "EMPTY_ROW",
    "ENCODING_PACKED",
    "ENCODING_THESIS",
    "FILE_LIMIT",
    "FORMAT_VERSION",
    "FULL_ROW",
    "KIND_CORNER",
    "KIND_CURVE",
    "KIND_QUAD",
    "LATTICE",
    "LATTICE_BITS",
    "LIST_LIMIT",
    "MOST_CURVES",
    "MOST_DEPTH",
    "MOST_ROWS",
    "MOST_TEXT_BYTES",
    "PACKED_FILE_LIMIT",
    "PACKED_SUFFIX",
    "PACKED_VERSION",
    "QUADS_SUFFIX",
    "QUAD_FLAG",
    "QUAD_WIDTH",
    "ROW_BITS",
    "TEXT_CRS",
    "TEXT_ENCODING",
    "TEXT_NAME",
    "TEXT_ROOTS",
    "TEXT_SOURCE",
    "TEXT_TRANSFORM",
    "TEXT_VERSION",
    "TEXT_WRITER",
    "THRESHOLD_CORNER",
    "THRESHOLD_QUAD",
    "WINDING_OFFSET",
]

FORMAT_VERSION: Final = "1"
ENCODING_THESIS: Final = "thesis"

TEXT_VERSION: Final = "vexture.version"
TEXT_ENCODING: Final = "vexture.encoding"
TEXT_TRANSFORM: Final = "vexture.transform"
TEXT_CRS: Final = "vexture.crs"
"""Keywords of the PNG text chunks; the first two also of the packed file's key/value data."""

TEXT_WRITER: Final = "KTXwriter"
TEXT_NAME: Final = "vexture.name"
TEXT_SOURCE: Final = "vexture.source"
TEXT_ROOTS: Final = "vexture.roots"
"""Further keys of the packed file."""

QUADS_SUFFIX: Final = ".quads.png"
CURVES_SUFFIX: Final = ".curves.png"
"""What follows the name in the names of the two files."""

QUAD_WIDTH: Final = 4
"""Pixels in a row of the quad texture: one for each cell."""

CELL_ORDER: Final = (2, 3, 0, 1)
"""Cell of each pixel in a row: top left, top right, bottom left, bottom right, as (x half) + 2 (y half)."""

KIND_CURVE: Final = 0.0
KIND_CORNER: Final = 0.5
KIND_QUAD: Final = 1.0
"""What a cell is, in its red channel (thesis 4.2.4 and 6.1.2)."""

THRESHOLD_CORNER: Final = 0.25
THRESHOLD_QUAD: Final = 0.75
"""A red channel above the second is a quad, above the first a corner, else a curve."""

CURVE_WIDTH: Final = 2
"""Pixels in a row of the curve texture: one for P0 and x, one for P3 and y."""

FULL_ROW: Final = 0
EMPTY_ROW: Final = 1
CONSTANT_ROWS: Final = 2
"""The first rows of the curve texture stand for constant cells."""

LIST_LIMIT: Final = {8: 256, 16: 65_000}
"""Longest list for each number of bits; above 65,000 float32 no longer decodes every index."""

FILE_LIMIT: Final = 2 * LIST_LIMIT[16] * QUAD_WIDTH * 3 * 2
"""Bytes. A longer file is not read: twice the pixels of the longest list leave room for filters and texts."""

ENCODING_PACKED: Final = "packed"
PACKED_VERSION: Final = "1"

PACKED_SUFFIX: Final = ".ktx2"
"""What follows the name in the name of a packed texture's file."""

ROW_BITS: Final = 11
"""Texel i lies in row i >> ROW_BITS; a texture of one row may be narrower. Every WebGL2 device takes this width."""

MOST_ROWS: Final = 16384
"""Height that most devices take."""

MOST_TEXT_BYTES: Final = 1 << 24
"""Bytes of key/value data: room for 100,000 roots."""

PACKED_FILE_LIMIT: Final = (MOST_ROWS << ROW_BITS) * 16 + 2 * MOST_TEXT_BYTES
"""Bytes. A longer file is not read: the most texels, not deflated, and the longest texts."""

LATTICE_BITS: Final = int(LATTICE).bit_length() - 1
"""A lattice unit is 2^-LATTICE_BITS of its leaf."""

CELL_BITS: Final = 8
"""Each of a quad's cells has one byte in the word of cells and one in the word of coverages."""

QUAD_FLAG: Final = 1 << 7
"""Cell byte of a quad. In a leaf's, the number of curves stands above COUNT_SHIFT bits of corner winding."""

COUNT_SHIFT: Final = 3

WINDING_OFFSET: Final = 4
"""Added to the corner winding of a leaf with curves, -3 to 3; a constant leaf has 0 there."""

COVERAGE_ONE: Final = 255
"""Coverage byte of a full cell."""

COORDINATE_BITS: Final = 16
"""A point is one word: x in its low bits, y above."""

CONTROL_OFFSET: Final = 16384
"""Lattice units added to the coordinates of P1 and P2, which so span -1/2 to 3/2 of the leaf."""
