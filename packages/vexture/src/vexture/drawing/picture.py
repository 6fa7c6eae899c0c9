"""Pictures as paints: pixels in the drawing's coordinates."""

from copy import copy
from dataclasses import dataclass
from enum import IntEnum
from math import floor, isfinite

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import SourceError
from vexture.base.layout import MOST_PICTURE_SIDE
from vexture.drawing.affine import Affine, compose_affine


class Sampling(IntEnum):
    """Colour between the centres of pixels: that of the pixel, or interpolated linearly in both directions."""

    PIXELS = 0
    LINEAR = 1


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """Pixels as a paint; beyond the picture's border, the colours at the border continue.

    Parameters
    ----------
    to_pixels : Affine
        Map from the drawing's coordinates to columns and rows. Pixel (0, 0), the first one of the top row, covers
        0..1 in both directions there.
    pixels : (rows, columns, 4) uint8 array
        Red, green, blue and opacity, sRGB, **premultiplied**.
    sampling : Sampling
    opacity : float
        Factor of all pixels.
    """

    to_pixels: Affine
    pixels: NDArray[np.uint8]
    sampling: Sampling = Sampling.LINEAR
    opacity: float = 1.0

    def __post_init__(self) -> None:
        shape, numbers = np.shape(self.pixels), [*self.to_pixels[0], *self.to_pixels[1]]
        if len(shape) != 3 or shape[2] != 4 or not (min(shape[:2]) > 0 and max(shape[:2]) <= MOST_PICTURE_SIDE):
            raise SourceError(
                f"a picture has the shape {shape}; it needs 1 to {MOST_PICTURE_SIDE:,} rows and columns of RGBA"
            )
        if self.pixels.dtype != np.uint8 or (self.pixels[..., :3] > self.pixels[..., 3:]).any():
            raise SourceError("a picture's pixels are not premultiplied bytes")
        if not all(map(isfinite, numbers)) or not 0.0 <= self.opacity <= 1.0:
            raise SourceError(f"a picture has the map {self.to_pixels} and the opacity {self.opacity}")

    def after(self, matrix: Affine) -> "Picture":
        """Return the picture in new coordinates; `matrix` maps the new ones to the old ones."""
        return self._copy_with("to_pixels", compose_affine(self.to_pixels, matrix))

    def fade(self, opacity: float) -> "Picture":
        """Return the picture with its opacity multiplied."""
        return self._copy_with("opacity", opacity * self.opacity)

    def with_sampling(self, sampling: Sampling) -> "Picture":
        """Return the same pixels with another sampling."""
        return self._copy_with("sampling", sampling)

    def _copy_with(self, name: str, value: object) -> "Picture":
        """Return a copy with one attribute changed. Its pixels are not checked again: a drawing may show them often."""
        picture = copy(self)
        object.__setattr__(picture, name, value)
        return picture

    @property
    def is_opaque(self) -> bool:
        """True if nothing shows through any part."""
        return self.opacity >= 1.0 and bool((self.pixels[..., 3] == 255).all())

    @property
    def mean(self) -> tuple[float, float, float, float]:
        """Mean colour, not premultiplied, and mean opacity, in 0..1.

        Examples
        --------
        >>> half = np.array([[[255, 0, 0, 255], [0, 0, 0, 0]]], np.uint8)
        >>> Picture(((2, 0, 0), (0, -1, 1)), half).mean
        (1.0, 0.0, 0.0, 0.5)
        """
        red, green, blue, alpha = (self.pixels.mean(axis=(0, 1)) / 255.0).tolist()
        straight = alpha if alpha > 0.0 else 1.0
        return min(red / straight, 1.0), min(green / straight, 1.0), min(blue / straight, 1.0), alpha * self.opacity

    def color_at(self, x: float, y: float) -> tuple[float, float, float, float]:
        """Return the premultiplied colour at a point of the drawing.

        Examples
        --------
        >>> ends = np.array([[[255, 0, 0, 255], [0, 0, 255, 255]]], np.uint8)
        >>> Picture(((2, 0, 0), (0, -1, 1)), ends).color_at(0.5, 0.5)
        (0.5, 0.0, 0.5, 1.0)
        """
        column, row = (a * x + b * y + c for a, b, c in self.to_pixels)
        if self.sampling is Sampling.LINEAR:
            weights = [(column - 0.5) - floor(column - 0.5), (row - 0.5) - floor(row - 0.5)]
            column, row = column - 0.5, row - 0.5
        else:
            weights = [0.0, 0.0]
        rows, columns = self.pixels.shape[:2]
        total = np.zeros(4)
        for i in range(2):
            for j in range(2):
                share = (weights[0] if i else 1.0 - weights[0]) * (weights[1] if j else 1.0 - weights[1])
                at = min(max(floor(row) + j, 0), rows - 1), min(max(floor(column) + i, 0), columns - 1)
                total += share * self.pixels[at]
        red, green, blue, alpha = (self.opacity / 255.0 * total).tolist()
        return red, green, blue, alpha
