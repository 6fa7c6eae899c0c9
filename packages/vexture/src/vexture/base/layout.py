"""The bits of a texture (FORMAT.md, part B), defined once for Python, and for the GLSL and JavaScript made from them.

A texture is one image of four 32-bit words to a texel, in which quads and curves share one index.
"""

from typing import Final

LATTICE: Final = 32768.0
"""Lattice units across a leaf; a power of two, so that the lattices of all depths nest."""

MOST_CURVES: Final = 15
"""Pieces that a leaf can hold."""

MOST_DEPTH: Final = 20
"""Depth of the smallest leaf: float32 shaders resolve no more."""

TEXT_VERSION: Final = "vexture.version"
TEXT_ENCODING: Final = "vexture.encoding"
"""Keys in the files of every encoding, which identify a texture."""

TEXT_WRITER: Final = "KTXwriter"
TEXT_NAME: Final = "vexture.name"
TEXT_SOURCE: Final = "vexture.source"
TEXT_ROOTS: Final = "vexture.roots"
TEXT_STYLES: Final = "vexture.styles"
"""Further keys of the packed file."""

ENCODING_PACKED: Final = "packed"
PACKED_VERSION: Final = "1"

MAP_HEAD: Final = 2
"""Texels before the root quad of a planar map, which say where its parts lie."""

MAP_VERSION: Final = "2"
"""Version of a texture with planar maps."""

PACKED_SUFFIX: Final = ".ktx2"
"""Suffix of a packed texture's file."""

ROW_BITS: Final = 11
"""Texel i lies in row i >> ROW_BITS; a texture of one row may be narrower. Every WebGL2 device takes this width."""

MOST_ROWS: Final = 16384
"""Height that most devices take."""

MOST_TEXT_BYTES: Final = 1 << 24
"""Bytes of key/value data: room for 100,000 roots."""

MOST_STYLE_BYTES: Final = 1 << 26
"""Bytes of the text of deflated styles: room for a million elements."""

PACKED_FILE_LIMIT: Final = (MOST_ROWS << ROW_BITS) * 16 + 2 * MOST_TEXT_BYTES
"""Bytes. A longer file is not read: the most texels, not deflated, and the longest texts."""

LATTICE_BITS: Final = int(LATTICE).bit_length() - 1
"""A lattice unit is 2^-LATTICE_BITS of its leaf."""

CELL_BITS: Final = 8
"""Each of a quad's cells has one byte in the word of cells and one in the word of coverages."""

QUAD_FLAG: Final = 1 << 7
"""Cell byte of a quad. In a leaf's, the number of curves stands above COUNT_SHIFT bits of corner winding."""

COUNT_SHIFT: Final = 3

IS_MEAN: Final = 2
"""Cell byte of a planar map's leaf of which only the mean is known."""

STRAIGHT: Final = 1
"""Added to the cell byte of a planar map's leaf with curves, if all of them are straight: two of them share a texel."""

WINDING_OFFSET: Final = 4
"""Added to the corner winding of a leaf with curves, -3 to 3; a constant leaf has 0 there."""

COVERAGE_ONE: Final = 255
"""Coverage byte of a full cell."""

COORDINATE_BITS: Final = 16
"""A point is one word: x in its low bits, y above."""

MOST_BYTE_PAINTS: Final = 1 << CELL_BITS
"""Most paints of a map in which those beside a curve are two bytes."""

MOST_HALF_PAINTS: Final = 1 << COORDINATE_BITS
"""Most paints of one in which they are two halves of a word; in others they are words."""

MOST_PAINTS: Final = 1 << 24
"""Paints of a planar map: more would not fit into a texture with the curves between them."""

PAINT_ONE: Final = 65535
"""A channel of a paint that is full; a mean has `COVERAGE_ONE`."""

MOST_PROGRAM: Final = 64
"""Texels of a program: what a pixel runs at most for one paint."""

KIND_SHIFT: Final = 29
"""The last word of a program's texel has its kind above these bits."""

KIND_SOLID, KIND_LINEAR, KIND_RADIAL, KIND_FOCAL, KIND_KEEP, KIND_MIX, KIND_FOLLOWS = range(1, 8)
"""Kinds: a colour; gradients, radial ones without and with a focal circle; a group's begin and end; what follows the
first texel of a gradient."""

HOLDS_PROGRAM: Final = 4
"""Added to the cell byte of a planar map's leaf, if a paint in it is a program."""

MOST_KEPT: Final = 3
"""Groups of a program that are open at once: each needs a colour in the shader's registers."""

MASKS: Final = 32
"""Added to a group's `vexture.drawing.group.Mask`, where its end has a blend mode if it is no mask."""

LUMINANCE_RED, LUMINANCE_GREEN, LUMINANCE_BLUE = 0.2125, 0.7154, 0.0721
"""Parts of a premultiplied colour's components in what a mask by luminance leaves (CSS Masking 1, 7.10.1)."""

STOP_BITS: Final = 19
STOP_COUNT_BITS: Final = 8
"""Of a gradient's word: how far its stops are from its texel, and above that how many there are."""

MOST_STOPS: Final = (1 << STOP_COUNT_BITS) - 1
"""Stops of a gradient, and of all gradients of a program."""

CONTROL_OFFSET: Final = 16384
"""Lattice units added to the coordinates of P1 and P2, which so span -1/2 to 3/2 of the leaf."""
