"""Outlines of glyphs as closed contours of cubics."""

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.fonts.engine import harfbuzz

Contours = tuple[NDArray[np.float64], ...]


def glyph_outline(font: Any, glyph: int) -> Contours:
    """Closed contours (n, 4, 2) of a glyph in font units, y up, filled by the nonzero rule."""
    pen = OutlinePen()
    font.draw_glyph(glyph, draw_funcs(), pen)
    return tuple(np.array(points, dtype=np.float64).reshape(-1, 4, 2) for points in pen.contours if points)


class OutlinePen:
    """Collects cubics: P0 to P3 of each in turn, one flat list for each contour. HarfBuzz closes contours by lines."""

    def __init__(self) -> None:
        self.contours: list[list[float]] = []
        self.at = (0.0, 0.0)

    def move(self, x: float, y: float) -> None:
        """Begin a contour."""
        self.contours.append([])
        self.at = (x, y)

    def line(self, x: float, y: float) -> None:
        """Add a line."""
        (a, b), dx, dy = self.at, x - self.at[0], y - self.at[1]
        if dx or dy:
            self.cubic(a + dx / 3.0, b + dy / 3.0, a + dx * (2.0 / 3.0), b + dy * (2.0 / 3.0), x, y)

    def quadratic(self, u: float, v: float, x: float, y: float) -> None:
        """Add a quadratic as the same curve of degree three."""
        a, b = self.at
        third = 2.0 / 3.0
        self.cubic(a + (u - a) * third, b + (v - b) * third, x + (u - x) * third, y + (v - y) * third, x, y)

    def cubic(self, *points: float) -> None:
        """Add a cubic from its last three points."""
        self.contours[-1] += (*self.at, *points)
        self.at = points[4], points[5]


@cache
def draw_funcs() -> Any:
    """Callbacks by which HarfBuzz draws with a `OutlinePen`."""
    funcs = harfbuzz().DrawFuncs()
    funcs.set_move_to_func(lambda x, y, pen: pen.move(x, y))
    funcs.set_line_to_func(lambda x, y, pen: pen.line(x, y))
    funcs.set_quadratic_to_func(lambda u, v, x, y, pen: pen.quadratic(u, v, x, y))
    funcs.set_cubic_to_func(lambda a, b, c, d, x, y, pen: pen.cubic(a, b, c, d, x, y))
    return funcs
