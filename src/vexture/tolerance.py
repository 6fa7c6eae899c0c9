"""Every tolerance in the package: its name, its unit and its reason."""

from typing import Final

__all__ = ["CLOSED", "FLATNESS", "PARAMETER", "SCANLINE"]

CLOSED: Final = 1e-9
"""Unit-square units. Ends of consecutive cubics closer than this are one point; the gap is closed exactly."""

PARAMETER: Final = 1e-9
"""Parameter t. A cut nearer than this to an end of a cubic would make a piece too short to have a direction."""

FLATNESS: Final = 2e-5
"""Pixels. The exact renderer's chords leave the curve by less: 0.005/255 in a pixel that one curve crosses."""

SCANLINE: Final = 2.0**-30
"""Pixels. Lattice of the heights at which the exact renderer's chords begin, end and cross (about 1e-9)."""
