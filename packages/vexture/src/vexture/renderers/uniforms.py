"""Values of the shader's uniforms, for the GPU and for the mirror on the CPU."""

from typing import Final, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import ParameterError
from vexture.renderers.view import Size, ViewLike, size_of, view_base, view_matrix

FLAT: Final = 2.0**-40
"""Largest slope of a pixel's side that counts as none: far less than a pixel over the widest picture."""


class HasTexels(Protocol):
    """Part of a `vexture.Texture` that a renderer reads."""

    @property
    def texels(self) -> NDArray[np.uint32]:
        """Image of texels, (rows, width, 4)."""

    @property
    def quads(self) -> NDArray[np.int64]:
        """Index of the root quad of each shape."""


class Uniforms(NamedTuple):
    """One shape of a texture in a view."""

    size: tuple[int, int]  # width and height of the image in pixels
    quad: int  # the shape's root quad
    base: tuple[int, int]  # point of the unit square to which positions are relative; 1.0 is 2^32
    to_unit: NDArray[np.float64]  # (3, 3): from pixel coordinates to the unit square, relative to `base`

    @property
    def is_flat(self) -> bool:
        """True if all pixels are equal rectangles with horizontal and vertical sides, except for rounding."""
        steps = np.abs(self.to_unit[:2, :2])
        small = FLAT * steps.max()
        level = max(steps[0, 1], steps[1, 0]) <= small or max(steps[0, 0], steps[1, 1]) <= small
        return bool(level and not self.to_unit[2, :2].any())


def uniforms_of(
    texture: HasTexels, size: Size, view: ViewLike, root: int, base: tuple[int, int] | None = None
) -> Uniforms:
    """Check a renderer's arguments; return the uniforms. The default of `base` is `view_base`."""
    size = size_of(size)
    matrix = view_matrix(view, size)
    if not 0 <= root < len(texture.quads):
        raise ParameterError(f"`root` is {root}; the texture has {len(texture.quads)} shapes, numbered from 0")
    base = view_base(matrix, size) if base is None else base
    relative = matrix.copy()
    relative[:2] -= np.outer(base, matrix[2]) / 2.0**32
    return Uniforms(size, int(texture.quads[root]), base, relative)
