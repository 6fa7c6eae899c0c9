"""The textures themselves, as arrays."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import IDENTITY

__all__ = ["ThesisTexture"]


@dataclass(frozen=True, slots=True, eq=False)
class ThesisTexture:
    """The thesis's pair of textures (FORMAT.md, part A).

    Parameters
    ----------
    quads : (quads, 4, 3) uint8 or uint16 array
        A row for each quad, a pixel for each cell: what it is, which one, the quad's coverage.
    curves : (2 + curves, 2, 3) array of the same type
        A row for each curve; the first two stand for *full* and *empty*.
    to_source : (2, 3) float64 array
        Affine map from the unit square to the units of the source.
    name : str
        Names the shape in messages and files.
    crs : str or None
        Coordinate reference system of the source units, where there is one.
    """

    quads: NDArray[Any]
    curves: NDArray[Any]
    to_source: NDArray[np.float64] = field(default_factory=IDENTITY.copy)
    name: str = "texture"
    crs: str | None = None

    @property
    def bits(self) -> int:
        """Bits per channel, 8 or 16."""
        return 8 * int(self.quads.dtype.itemsize)
