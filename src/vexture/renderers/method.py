"""The numbers of the shading method, defined once: the shader and its mirror read them here."""

from typing import Final

__all__ = [
    "BEND",
    "BORDER",
    "CLOSE",
    "COVERED",
    "CROSSING",
    "EXACT",
    "FADED_CELL",
    "FARTHEST",
    "FAST",
    "LEAST_FINEST",
    "LEVELS_BELOW",
    "LEVEL_BIAS",
    "LONG",
    "MOST_CELLS",
    "MOST_PARTS",
    "NEAR",
    "NEARLY_TILE",
    "NO_SIZE",
    "POSITION_BITS",
    "SHORT_WAY",
    "SMALLEST_PIXEL",
    "SMALL_FINEST",
    "STEPS",
    "THINNEST_PIXEL",
    "WHOLE_TILE",
    "WRAP_CLAMP",
    "WRAP_NONE",
    "WRAP_REPEAT",
]


FAST: Final = 0
EXACT: Final = 1
"""Qualities of the packed texture's shader: how finely it looks at bent pieces and at cells smaller than a pixel."""

POSITION_BITS: Final = 28
"""The packed shader's positions are whole numbers of 2^-28 of the unit square: eight squares fit 32 bits."""

FARTHEST: Final = 3.0
"""Unit squares from the base, in each direction; a pixel is looked up as if its centre were no farther away."""

SMALLEST_PIXEL: Final = 2.0**-40
"""Unit-square units."""

THINNEST_PIXEL: Final = 2.0**-6
"""A footprint seen from its edge is made this wide, in its lengths."""

STEPS: Final = 6
"""Laguerre's steps, at most, to where a piece enters and leaves a footprint's box; a line needs one."""

CLOSE: Final = 0.02
"""Pixels. A step that moves a point on a piece by less was the last."""

NO_SIZE: Final = 2.0**-10
"""Lattice units: less than the least size of a piece that has one."""

NEAR: Final = 0.125
"""Part of a footprint's box: a point that is to be on its side is nearer."""

BEND: Final = 8.0
"""Parts for each square pixel of the cross product of a piece's derivatives at the ends of what a box holds of it."""

MOST_PARTS: Final = 4.0
"""Parts into which such a piece is divided at most."""

SHORT_WAY: Final = 2.0**-10
"""Pixels. The mean over a shorter way is taken in its middle, because the quotient would lose its digits."""

LEVELS_BELOW: Final = 2
"""Levels that the sum over cells goes below the footprint's own; there a divided cell counts by its stored coverage."""

SMALL_FINEST: Final = 8
"""Level down to which it goes one deeper."""

LEAST_FINEST: Final = 4
"""Level that this sum reaches at least: a picture of a few pixels sees the leaves themselves of most drawings."""

LONG: Final = 0.64
"""Part of the reach of a footprint's box that cells are no smaller than, before LEVELS_BELOW: 14 to a row at most."""

LEVEL_BIAS: Final = 2.0**-8
"""Without it drivers would disagree on the level of a footprint whose size is a power of two."""

CROSSING: Final = 2
"""Side of a piece that is not clear."""

MOST_CELLS: Final = 256
"""Cells that one pixel looks at."""

WRAP_NONE: Final = 0
WRAP_CLAMP: Final = 1
WRAP_REPEAT: Final = 2
"""What lies beyond the unit square: nothing, what its border shows, or the shape again."""

BORDER: Final = 2.0**-22
"""Unit-square units; more than float32 loses of a position near the square's border."""

NEARLY_TILE: Final = 0.375
WHOLE_TILE: Final = 0.5
"""Half the length of a footprint, in tiles of a repeated shape, from which its coverage fades into the tile's mean, and
at which nothing else is left."""

COVERED: Final = 1.0 - 2.0**-10
"""Opacity of what has been painted over a pixel from which layers below do not show."""

FADED_CELL: Final = 4.0
"""Pixels. The borders of cells of this size are not drawn, lest small views turn grey; from twice that on they are."""
