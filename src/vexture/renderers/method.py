"""Numbers of the shading method, for the shader and for its mirror."""

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
"""Qualities of the packed texture's shader: resolution of bent pieces and of cells smaller than a pixel."""

POSITION_BITS: Final = 28
"""The packed shader's positions are whole numbers of 2^-28 of the unit square: eight squares fit 32 bits."""

FARTHEST: Final = 3.0
"""Unit squares. A pixel's centre is clamped to this distance from the base, in each direction."""

SMALLEST_PIXEL: Final = 2.0**-40
"""Unit-square units."""

THINNEST_PIXEL: Final = 2.0**-6
"""Least width of a footprint, as a share of its length: a plane seen from its edge has none."""

STEPS: Final = 6
"""Most Laguerre steps to where a piece enters and leaves a footprint's box; a line needs one."""

CLOSE: Final = 0.02
"""Pixels. The iteration ends when a step moves a point on a piece by less."""

NO_SIZE: Final = 2.0**-10
"""Lattice units: below the least nonzero size of a piece."""

NEAR: Final = 0.125
"""Share of a footprint's box: a point nearer to its side may be moved onto it."""

BEND: Final = 8.0
"""Parts for each square pixel of the cross product of a piece's derivatives, where it enters and leaves a box."""

MOST_PARTS: Final = 4.0
"""Most parts into which such a piece is divided."""

SHORT_WAY: Final = 2.0**-10
"""Pixels. The mean over a shorter distance is evaluated at its middle, because the quotient would lose its digits."""

LEVELS_BELOW: Final = 2
"""Levels that the sum over cells descends below the footprint's; there a divided cell counts by its stored coverage."""

SMALL_FINEST: Final = 8
"""Down to this level, the sum descends one more."""

LEAST_FINEST: Final = 4
"""Least level of this sum: even a picture of a few pixels uses the leaves of most drawings."""

LONG: Final = 0.64
"""Least size of cells as a share of the reach of a footprint's box, before LEVELS_BELOW: at most 14 in a row."""

LEVEL_BIAS: Final = 2.0**-8
"""Relative; without it drivers would disagree on the level of a footprint whose size is a power of two."""

CROSSING: Final = 2
"""Side of a piece that may cross the box."""

MOST_CELLS: Final = 256
"""Most cells that one pixel visits."""

WRAP_NONE: Final = 0
WRAP_CLAMP: Final = 1
WRAP_REPEAT: Final = 2
"""Beyond the unit square: nothing, the border's value, or the shape again."""

BORDER: Final = 2.0**-22
"""Unit-square units; more than float32 loses of a position near the square's border."""

NEARLY_TILE: Final = 0.375
WHOLE_TILE: Final = 0.5
"""Half the length of a footprint, in tiles of a repeated shape, at which the fade of its coverage into the tile's mean
begins and ends."""

COVERED: Final = 1.0 - 2.0**-10
"""Opacity above which the layers below are not drawn."""

FADED_CELL: Final = 4.0
"""Pixels. Borders of cells fade in from this size to twice this size; otherwise small views would turn grey."""
