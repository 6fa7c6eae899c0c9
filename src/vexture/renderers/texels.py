"""What a renderer reads of a texture, and which of its shapes it is asked for."""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from vexture.errors import ParameterError
from vexture.renderers.shader import QUALITIES

__all__ = ["Texels", "asked_of"]


class Texels(Protocol):
    """The data that the shader is given, and its mirror."""

    @property
    def texels(self) -> NDArray[np.uint32]:
        """The image, (rows, width, 4) uint32."""

    @property
    def quads(self) -> NDArray[np.int64]:
        """Index of the root quad of each shape."""


def asked_of(texture: Texels, root: int, quality: str) -> tuple[int, int]:
    """Root quad and number of a quality.

    Raises
    ------
    ParameterError
        If there is no such shape or quality.
    """
    if not 0 <= root < len(texture.quads):
        raise ParameterError(f"`root` is {root}; the texture has {len(texture.quads)} shapes, numbered from 0")
    if quality not in QUALITIES:
        raise ParameterError(f"`quality` is {quality!r}; it must be one of {', '.join(map(repr, QUALITIES))}")
    return int(texture.quads[root]), QUALITIES[quality]
