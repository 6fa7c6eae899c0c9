"""Numbers of the shading method, for the shader and for its mirror."""

from typing import Final

POSITION_BITS: Final = 28
"""The shader's positions are integers in units of 2^-28 of the unit square, so that eight squares fit in 32 bits."""

REST_BITS: Final = 4
"""Low bits of a position, stored in a separate float; float32 can hold the other bits relative to any cell."""

NO_CELL: Final = 1 << 30
"""A value larger than all positions."""

SMALLEST_BOX: Final = 2.0**-20
"""Position units: below a 128th of the smallest pixel."""

FARTHEST: Final = 3.0
"""Unit squares. A pixel's centre is clamped to this distance from the base, in each direction."""

SMALLEST_PIXEL: Final = 2.0**-40
"""Unit-square units."""

THINNEST_PIXEL: Final = 2.0**-6
"""Least width of a footprint, as a share of its length: a plane seen from its edge has none."""

STEPS: Final = 6
"""Most Laguerre steps to find where a piece enters and leaves a footprint's box; a line needs one."""

CLOSE: Final = 0.02
"""Pixels. The iteration ends when a step moves a point on a piece by less."""

NO_SIZE: Final = 2.0**-16
"""In sides of a box: less than the smallest nonzero size of a piece, which is a lattice unit of its cell."""

BEND: Final = 20.0
"""Parts of a piece per square pixel of area that its end directions span with its chord."""

MOST_PARTS: Final = 8.0
"""Most parts of a piece."""

SHORT_WAY: Final = 2.0**-10
"""Pixels. The mean over a shorter distance is evaluated at its middle, because the quotient would lose its digits."""

DRAWN: Final = 0.7
"""Shift to the middle of the part of a cell in the footprint, as a share of the shift for an upright cell."""

SMALL_FINEST: Final = 8
"""Level down to which the sum over cells descends one level further."""

FOLLOWED_QUADS: Final = 256
"""Number of first quads of a shape, breadth first, that are followed below the finest cells. In most drawings these are
all quads. In a coast with thousands of edges they are only the coarse ones, as most of its pixels would slow down."""

FURTHER: Final = 2
"""Number of levels by which these quads are followed."""

LEAST_FINEST: Final = 4
"""Least level of the sum: even a picture of a few pixels uses the leaves of most drawings."""

LONG: Final = 2.0**-8
"""Least area that determines the finest cells, relative to the square of a footprint's length: bounds thin ones."""

LEVEL_BIAS: Final = 2.0**-8
"""Relative reduction of a size; without it, drivers would disagree on the level or parts if it is at the limit."""

GAUSS: Final = 0.5 / 3.0**0.5
"""Distance of the two points of Gauss-Legendre quadrature from the middle of an interval, relative to its length."""

NEARLY_WHOLE: Final = 1.0 - 2.0**-10
"""Share of a leaf in a footprint from which it counts as whole."""

LEAST_SHARE: Final = 2.0**-20
"""Share of a pixel below which a paint's area and moments count as rounding errors."""

NO_SHARE: Final = 2.0**60
"""More than any sum of shares of a pixel, even in a damaged texture."""

RAMP_PARTS: Final = 6
"""Parts of a region's side for each radius of a gradient's circle that it spans."""

RAMP_BEND: Final = 0.5
"""Square of a part's length along a circle, relative to its width across it times the circle's radius."""

PRODUCT_PARTS: Final = 4
"""Parts for each ramp that a region's side spans, where a product of ramps is averaged."""

BLEND_PARTS: Final = 256
"""The same for a blend mode whose result is more curved than a product, or has jumps."""

MOST_RAMP_PARTS: Final = 4
"""Most parts of a region's side."""

PIXEL_PARTS: Final = 8
"""Most parts of a side of a region that fills a pixel; scaled by the square root of a smaller region's share."""

SHORTEST_RAMP: Final = 2.0**-22
"""Least interval over which a gradient is averaged: two steps of float32 at the end of the ramp."""

LONGEST_RAMP: Final = 2.0**20
"""Longest interval over which a gradient is averaged."""

PICTURE_RAMP: Final = 0.25
"""Share of a ramp that a pixel of a picture counts as, where a product of a picture and another paint is averaged."""

PICTURE_AREA: Final = 256.0
"""Most pixels of a level in a footprint; coarser levels have at least a quarter of them, for errors of 2/255."""

PICTURE_LENGTH: Final = 2.0**-4
"""Least area that determines the level, relative to the square of a footprint's length: 64 pixels are the longest."""

SMOOTH_AREA: Final = 48.0
"""Most pixels in a footprint that are interpolated; in a larger one, steps between pixels change a mean by 2/255."""

SHORT_SMOOTH: Final = 2.0**-4
"""Pixels. A shorter footprint of interpolated pixels is replaced by an upright one with the same variances."""

LEAST_SMOOTH: Final = 2.0**-6
"""Pixels. Least side of that footprint: differences of smaller ones lose their digits."""

LEAST_OUTLINE: Final = 2.0**-18
"""Pixels. Least side of any footprint in a picture."""

THINNEST_OUTLINE: Final = 2.0**-8
"""Least width of a footprint in a picture, as a share of its length."""

SLANTED_PART: Final = 0.75
"""Grid steps. The mean of a spline over a parallelogram is that over upright boxes with the variances of its parts; it
counts what a part's side spans in both directions, as the root of the product, and that is at most this."""

MOST_SPLINE_BOXES: Final = 4
"""Most of these boxes; the mean over a footprint that needs more is that of interpolated pixels."""

WIDEST_SPLINE_BOX: Final = 12.0
"""Grid steps. Widest of these boxes."""

LEAST_SPLINE_BOX: Final = 2.0**-4
"""Grid steps. Least width: a blurred dot changes by 0.0002 at most, and smaller differences lose their digits."""

PICTURE_LINES: Final = 130
"""More rows or columns than such a footprint has: bounds the work for invalid texels."""

PICTURE_FAR: Final = 2.0**24
"""Pixels. Farther from a picture's corner, a footprint has the mean of the whole picture."""

GREY: Final = 2.0**-10
"""Saturation below which a colour is grey: the error of translucent colours in 16 bits; 8 bits store no less."""

LEAST_COLOR: Final = 2.0**-14
"""Distance from 0 or 1 below which a colour component counts as 0 or 1."""

NO_PLACE: Final = -1e30
"""Position of a point that is on no circle of a ramp."""

LEAST_RADIUS: Final = 2.0**-20
"""Radius of a gradient's circle that counts as 0: the error of float32 may be that large."""

NOTHING: Final = 2.0**-60
"""Replaces 0 in a divisor."""

WRAP_NONE: Final = 0
WRAP_CLAMP: Final = 1
WRAP_REPEAT: Final = 2
"""Content outside the unit square: nothing, the border's value, or repetitions of the shape."""

BISECTIONS: Final = 24
"""Halvings of a curve to find the face at a point: the number of bits of a float32's significand."""

BORDER: Final = 2.0**-22
"""Unit-square units. More than float32's rounding error of a position near the square's border."""

NEARLY_TILE: Final = 0.375
WHOLE_TILE: Final = 0.5
"""Half the length of a footprint, in tiles of a repeated shape, at which its coverage begins and ends to fade to the
tile's mean."""

COVERED: Final = 1.0 - 2.0**-10
"""Opacity above which the layers below are not drawn."""

FADED_CELL: Final = 4.0
"""Pixels. Borders of cells fade in as cells grow from this size to twice this size; else small views would be grey."""
