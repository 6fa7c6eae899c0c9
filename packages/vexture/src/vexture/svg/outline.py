"""The outline of a shape, before it is filled or stroked."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.convert import line_cubics

SAME = 1e-12
"""Distance of an end from the start that is mere rounding, relative to the outline's coordinates."""


@dataclass(frozen=True, slots=True, eq=False)
class ShapeOutline:
    """Consecutive cubics, open or closed."""

    cubics: NDArray[np.float64]  # (n, 4, 2), n >= 1; each starts, bit for bit, at the end of the one before
    closed: bool  # True if a stroke joins the last to the first

    @classmethod
    def polygon(cls, points: NDArray[np.float64], closed: bool) -> "ShapeOutline":
        """Return straight sides through points (n, 2)."""
        if closed or len(points) == 1:
            points = np.concatenate([points, points[:1]])
        return cls(line_cubics(points[:-1], points[1:]), closed)

    @classmethod
    def rectangle(cls, x: float, y: float, width: float, height: float) -> "ShapeOutline":
        """Return the sides of an upright rectangle."""
        right, bottom = x + width, y + height
        return cls.polygon(np.array([(x, y), (right, y), (right, bottom), (x, bottom)]), closed=True)

    @property
    def loop(self) -> NDArray[np.float64]:
        """Contour to fill, (n, 4, 2), closed by a straight line if necessary."""
        gap = np.abs(self.cubics[-1, 3] - self.cubics[0, 0]).max()
        if gap == 0.0:
            return self.cubics
        if gap <= SAME * np.abs(self.cubics).max():
            cubics = self.cubics.copy()
            cubics[-1, 3] = cubics[0, 0]
            return cubics
        return np.concatenate([self.cubics, line_cubics(self.cubics[-1:, 3], self.cubics[:1, 0])])
