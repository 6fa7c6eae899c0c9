"""The packed texture itself: one array of texels, any number of shapes."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import IDENTITY, Paint
from vexture.errors import FormatError

__all__ = ["PackedTexture", "Root"]


@dataclass(frozen=True, slots=True, eq=False)
class Root:
    """One shape of a packed texture.

    Parameters
    ----------
    name : str
        Names the shape within its texture.
    quad : int
        Index of its root quad's texel: all that a shader needs.
    to_source : (2, 3) float64 array
        Affine map from the unit square to the units of the source.
    tolerance : float
        Largest distance between the drawing's outline and the texture's before quantisation, in unit-square units.
    crs : str or None
        Coordinate reference system of the source units, where there is one.
    paint : Paint or None
        Its colour, where it is one layer of a drawing; None for a silhouette.
    """

    name: str
    quad: int = 0
    to_source: NDArray[np.float64] = field(default_factory=IDENTITY.copy)
    tolerance: float = 0.0
    crs: str | None = None
    paint: Paint | None = None


@dataclass(frozen=True, slots=True, eq=False)
class PackedTexture:
    """A texture of packed quads and curves (FORMAT.md, part B).

    Parameters
    ----------
    texels : (rows, width, 4) uint32 array
        Texel i lies in row i >> `layout.ROW_BITS`; the width is a power of two.
    roots : tuple of Root
        Its shapes; the layers of one drawing in painting order.
    name : str
        Names the texture in messages and files.
    source : str or None
        Where it was made from, for people.

    Raises
    ------
    FormatError
        If the texels are of another shape or type, or there is no root.
    """

    texels: NDArray[np.uint32]
    roots: tuple[Root, ...]
    name: str = "texture"
    source: str | None = None

    def __post_init__(self) -> None:
        if self.texels.ndim != 3 or self.texels.shape[2] != 4 or self.texels.dtype != np.uint32:
            raise FormatError(
                f"texels are {self.texels.dtype}{self.texels.shape}; they must be uint32 (rows, width, 4)"
            )
