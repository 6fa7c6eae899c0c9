"""A rectangle of the world, and where it stands in the unit square."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

__all__ = ["MARGIN", "Frame"]

MARGIN: Final = 1 / 32
"""Share of the unit square that is left free on each side: what folding moves in from beyond the frame is there."""


@dataclass(frozen=True, slots=True)
class Frame:
    """A rectangle of the world: all drawings that are read into one frame fit over one another.

    It stands in the middle of the unit square, at its aspect ratio on the ground, with `MARGIN` around its longer
    sides. Drawings go on to the borders of the square.

    Parameters
    ----------
    bounds : tuple of float
        West, south, east, north, in the units of the reference system; always in the order x, y.
    crs : str
        Reference system, as text that pyproj understands: ``EPSG:32610``, WKT.
    metres : tuple of float
        Width and height on the ground.

    Examples
    --------
    >>> frame = Frame((0.0, 0.0, 2000.0, 1000.0), "EPSG:28992", (2000.0, 1000.0))
    >>> frame.box
    (0.03125, 0.265625, 0.96875, 0.734375)
    >>> frame.to_source @ (0.5, 0.5, 1.0)
    array([1000.,  500.])
    """

    bounds: tuple[float, float, float, float]
    crs: str
    metres: tuple[float, float]

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Where the frame is in the unit square: x0, y0, x1, y1."""
        share = 0.5 - MARGIN
        half_x, half_y = (share * side / max(self.metres) for side in self.metres)
        return (0.5 - half_x, 0.5 - half_y, 0.5 + half_x, 0.5 + half_y)

    @property
    def to_source(self) -> NDArray[np.float64]:
        """Affine map from the unit square to the units of the reference system, (2, 3)."""
        west, south, east, north = self.bounds
        x0, y0, x1, y1 = self.box
        across, up = (east - west) / (x1 - x0), (north - south) / (y1 - y0)
        return np.array([[across, 0.0, west - across * x0], [0.0, up, south - up * y0]])
