"""The bit layout of a texture (FORMAT.md, part B), defined once; GLSL and JavaScript are generated from it.

A texture is one image with four 32-bit words per texel. Quads and curves share one index.
"""

from typing import Final

LATTICE: Final = 32768.0
"""Lattice units across a leaf; a power of two, so that the lattices of all depths nest."""

MOST_CURVES: Final = 15
"""Most pieces that a leaf can hold."""

MOST_DEPTH: Final = 20
"""Largest depth of a leaf: float32 shaders resolve no more."""

TEXT_VERSION: Final = "vexture.version"
TEXT_ENCODING: Final = "vexture.encoding"
"""Keys that identify a texture in the files of every encoding."""

TEXT_WRITER: Final = "KTXwriter"
TEXT_NAME: Final = "vexture.name"
TEXT_SOURCE: Final = "vexture.source"
TEXT_ROOTS: Final = "vexture.roots"
TEXT_STYLES: Final = "vexture.styles"
"""Further keys of the packed file."""

ENCODING_PACKED: Final = "packed"
PACKED_VERSION: Final = "1"

MAP_HEAD: Final = 2
"""Texels before the root quad of a planar map; they hold the positions of its parts."""

MAP_VERSION: Final = "2"
"""Format version of a texture with planar maps."""

PICTURE_VERSION: Final = "3"
"""Format version of a texture with pictures."""

PACKED_SUFFIX: Final = ".ktx2"
"""File suffix of a packed texture."""

ROW_BITS: Final = 11
"""Texel i lies in row i >> ROW_BITS; a texture of one row may be narrower. All WebGL2 devices support this width."""

MOST_ROWS: Final = 16384
"""Largest height that most devices support."""

MOST_TEXT_BYTES: Final = 1 << 24
"""Limit in bytes of the key/value data: room for 100,000 roots."""

MOST_STYLE_BYTES: Final = 1 << 26
"""Limit in bytes of the inflated text of styles: room for a million elements."""

PACKED_FILE_LIMIT: Final = (MOST_ROWS << ROW_BITS) * 16 + 2 * MOST_TEXT_BYTES
"""Limit in bytes of a file that is read: the most texels, not deflated, and the longest texts."""

LATTICE_BITS: Final = int(LATTICE).bit_length() - 1
"""A lattice unit is 2^-LATTICE_BITS of its leaf."""

CELL_BITS: Final = 8
"""Bits of a cell in each of two words of its quad: the word of cells and the word of coverages."""

QUAD_FLAG: Final = 1 << 7
"""Cell byte of a quad. A leaf's byte holds COUNT_SHIFT bits of corner winding, and above them the number of curves."""

COUNT_SHIFT: Final = 3

IS_MEAN: Final = 2
"""Cell byte of a planar map's leaf that has only a mean colour."""

STRAIGHT: Final = 1
"""Added to the cell byte of a planar map's leaf if all its curves are straight: two of them share a texel."""

WINDING_OFFSET: Final = 4
"""Added to the corner winding of a leaf with curves, -3 to 3; a constant leaf has 0 there."""

COVERAGE_ONE: Final = 255
"""Coverage byte of a full cell."""

COORDINATE_BITS: Final = 16
"""A point is one word: x in its low bits, y above."""

MOST_BYTE_PAINTS: Final = 1 << CELL_BITS
"""Most paints of a map that stores the two paints beside a curve as bytes."""

MOST_HALF_PAINTS: Final = 1 << COORDINATE_BITS
"""Most paints of a map that stores them as 16-bit halves of a word; a map with more paints uses words."""

MOST_PAINTS: Final = 1 << 24
"""Most paints of a planar map: more would not fit into a texture together with the curves between them."""

PAINT_ONE: Final = 65535
"""Full value of a paint's channel; that of a mean colour is `COVERAGE_ONE`."""

MOST_PROGRAM: Final = 64
"""Most texels of a program, and so the most that a pixel reads for one paint."""

KIND_SHIFT: Final = 29
"""Position of the kind of operation in the last word of a program's texel."""

KIND_PICTURE, KIND_SOLID, KIND_LINEAR, KIND_RADIAL, KIND_FOCAL, KIND_KEEP, KIND_MIX, KIND_FOLLOWS = range(8)
"""Kinds of operations: a picture; a colour; linear, radial and focal gradients; the begin and end of a group; a further
texel of a picture or gradient."""

MOST_PICTURE_SIDE: Final = 1 << 14
"""Most columns or rows of a picture."""

BLOCK_SIDE: Final = 4
"""Columns and rows of the pixels of a block, in a picture of opacities."""

ENTRY_BITS: Final = 3
"""Logarithm to base 2 of the number of entries in a texel of an index of blocks."""

FIRST_BLOCK: Final = 256
"""Entry of the first block that is stored; a smaller one is the value of all pixels of its block."""

HOLDS_PROGRAM: Final = 4
"""Added to the cell byte of a planar map's leaf if one of its paints is a program."""

MOST_KEPT: Final = 3
"""Most groups of a program that are open at once: each needs a colour in the shader's registers."""

MASKS: Final = 32
"""Added to a `vexture.drawing.group.Mask` in the end of a group; smaller values there are blend modes."""

LUMINANCE_RED, LUMINANCE_GREEN, LUMINANCE_BLUE = 0.2125, 0.7154, 0.0721
"""Weights of a premultiplied colour's components in a luminance mask (CSS Masking 1, 7.10.1)."""

STOP_BITS: Final = 19
STOP_COUNT_BITS: Final = 8
"""Fields of a gradient's word: the distance from its texel to its stops, and above it the number of stops."""

MOST_STOPS: Final = (1 << STOP_COUNT_BITS) - 1
"""Most stops of a gradient, and of all gradients of a program together."""

CONTROL_OFFSET: Final = 16384
"""Lattice units added to the coordinates of P1 and P2, which therefore span -1/2 to 3/2 of the leaf."""
