"""Numbers of the shading method, for the shader and for its mirror."""

from typing import Final

POSITION_BITS: Final = 28
"""The packed shader's positions are whole numbers of 2^-28 of the unit square: eight squares fit 32 bits."""

REST_BITS: Final = 4
"""Low bits of a position that a float beside it holds, so that float32 holds the others from any cell on."""

NO_CELL: Final = 1 << 30
"""Beyond all positions."""

SMALLEST_BOX: Final = 2.0**-20
"""Positions: below a 128th of the smallest pixel."""

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

NO_SIZE: Final = 2.0**-16
"""Sides of a box: below the least nonzero size of a piece, a lattice unit of its cell."""

BEND: Final = 20.0
"""Parts of a piece for each square pixel that its end directions span with its chord."""

MOST_PARTS: Final = 8.0
"""Most parts into which such a piece is divided."""

SHORT_WAY: Final = 2.0**-10
"""Pixels. The mean over a shorter distance is evaluated at its middle, because the quotient would lose its digits."""

DRAWN: Final = 0.7
"""Way to the middle of the part of a cell in the footprint, as a share of that for an upright cell."""

SMALL_FINEST: Final = 8
"""Down to this level, the sum descends one more."""

FOLLOWED_QUADS: Final = 256
"""The first quads of a shape, breadth first, are followed below the finest cells: all of most drawings, and only the
coarse ones of a coast of thousands of edges, most of whose pixels would pay for it."""

FURTHER: Final = 2
"""Levels by which they are followed."""

LEAST_FINEST: Final = 4
"""Least level of this sum: even a picture of a few pixels uses the leaves of most drawings."""

LONG: Final = 2.0**-8
"""Least area of a square as wide as a footprint, relative to one as long, of which the finest cells are parts."""

LEVEL_BIAS: Final = 2.0**-8
"""Relative; without it drivers would disagree on the level of a footprint whose size is a power of two."""

GAUSS: Final = 0.5 / 3.0**0.5
"""Way from the middle of an interval to each of the two points of Gauss-Legendre quadrature, in its length."""

NEARLY_WHOLE: Final = 1.0 - 2.0**-10
"""Share of a leaf in a footprint from which all of it counts."""

LEAST_SHARE: Final = 2.0**-20
"""Share of a pixel, as area and moments, from which a paint's part is something: less is what rounding leaves."""

NO_SHARE: Final = 2.0**60
"""More than any sum of shares of a pixel, of a damaged texture as well."""

RAMP_PARTS: Final = 6
"""Parts of a region's side for each radius of a circle that it spans."""

RAMP_BEND: Final = 0.5
"""Square of a part's length along a circle, relative to its width across it times the circle's radius."""

PRODUCT_PARTS: Final = 4
"""Parts for each ramp that a region's side spans, where a product of ramps is averaged."""

BLEND_PARTS: Final = 256
"""The same where a blend mode bends what it makes of ramps more than a product does, or breaks it."""

MOST_RAMP_PARTS: Final = 4
"""Most parts of a side."""

PIXEL_PARTS: Final = 8
"""The same of a region that fills a pixel; of a smaller one, times the square root of its share of the pixel."""

SHORTEST_RAMP: Final = 2.0**-22
"""Least interval over which a gradient is averaged: two steps of float32 at the end of the ramp."""

LONGEST_RAMP: Final = 2.0**20
"""The longest one."""

GREY: Final = 2.0**-10
"""Saturation below which a colour is grey: 16 bits leave as much of translucent ones, and 8 bits have no less."""

LEAST_COLOR: Final = 2.0**-14
"""Of a component, likewise: as near to 0 or 1 it is that."""

NO_PLACE: Final = -1e30
"""Place on a ramp of what has none."""

LEAST_RADIUS: Final = 2.0**-20
"""Of a gradient's circle: float32 may make as much of 0, or as much less."""

NOTHING: Final = 2.0**-60
"""Instead of 0 in a divisor."""

WRAP_NONE: Final = 0
WRAP_CLAMP: Final = 1
WRAP_REPEAT: Final = 2
"""Beyond the unit square: nothing, the border's value, or the shape again."""

BISECTIONS: Final = 24
"""Halvings of a curve to find the face at a point: as many as a float32 has bits."""

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
