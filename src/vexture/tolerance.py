"""Every tolerance in the package: its name, its unit and its reason."""

from typing import Final

__all__ = ["CLOSED", "PARAMETER", "ROUND"]

CLOSED: Final = 1e-9
"""Unit-square units. Ends of consecutive cubics closer than this are one point; the gap is closed exactly."""

PARAMETER: Final = 1e-9
"""Parameter t. A cut nearer than this to an end of a cubic would make a piece too short to have a direction."""

ROUND: Final = 1e-5
"""Unit-square units. Largest distance from the true curve of what a reader must approximate: arcs and strokes."""
