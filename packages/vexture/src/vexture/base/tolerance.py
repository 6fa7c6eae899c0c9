"""Tolerances that several modules share, each with its unit and its reason."""

from typing import Final

CLOSED: Final = 1e-9
"""Unit-square units. Ends of consecutive cubics closer than this are one point; the gap is closed exactly."""

GRAIN: Final = 2.0**-40
"""Unit-square units. Points on curves are rounded to this, so that a point within rounding of a cell line is on it."""

PARAMETER: Final = 1e-9
"""Parameter t. A cut nearer than this to an end of a cubic would make a piece too short to have a direction."""

COARSEST: Final = 1 / 2000
"""Unit-square units. The automatic tolerance is never looser: half a pixel in a picture of 1,000 pixels."""

FINEST: Final = 1 / 20000
"""Unit-square units. The automatic tolerance is never tighter: such detail is smaller than the deepest usual cells."""

DETAIL_SHARE: Final = 1 / 16
"""The automatic tolerance as a share of the extent of the drawing's smallest cubic (thesis 5.2.1)."""

CELL_SHARE: Final = 1 / 8
"""The automatic tolerance is at most this share of the size of the cell (thesis 6.2.1)."""

FLATNESS: Final = 2e-5
"""Pixels. Largest distance of the exact renderer's chords from the curve: 0.005/255 in a pixel with one curve."""

SCANLINE: Final = 2.0**-30
"""Pixels. Lattice of the heights at which the exact renderer's chords begin, end and cross (about 1e-9)."""

STEADY: Final = 1e-6
"""Colour component times pixels. The exact renderer refines a gradient's integral until it changes by less."""

ROUND: Final = 1e-5
"""Unit-square units. Largest distance from the true curve when a reader approximates arcs and strokes."""

UNSEEN: Final = 2e-5
"""Unit-square units. Default tolerance of a packed texture: 0.04 pixels in a picture of 2,000 pixels."""

HMIN: Final = 0.05
"""Metres. Water depth from which flood modellers count a place as wet."""
