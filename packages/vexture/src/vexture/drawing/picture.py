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
    """Meaning of the pixels of a picture.

    The colour of a point is that of the pixel that holds it (PIXELS) or is interpolated between the centres of pixels,
    linearly in both directions (LINEAR). With SPLINE, pixels are the coefficients of a uniform cubic B-spline in both
    directions, each at the centre of its pixel. OPACITY and INVERSE are splines of one component, the opacity of a flat
    colour, or 1 minus that opacity.
    """

    PIXELS = 0
    LINEAR = 1
    SPLINE = 2
    OPACITY = 3
    INVERSE = 4

    @property
    def components(self) -> int:
        """Number of components of a pixel."""
        return 1 if self >= Sampling.OPACITY else 4


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """Pixels as a paint; beyond the picture's border, the colours at the border continue.

    Parameters
    ----------
    to_pixels : Affine
        Map from the drawing's coordinates to columns and rows. Pixel (0, 0), the first one of the top row, covers
        0..1 in both directions there.
    pixels : (rows, columns, 4) uint8 array
        Red, green, blue and opacity, sRGB, **premultiplied**; (rows, columns, 1) if they are opacities.
    sampling : Sampling
    opacity : float
        Factor of all pixels.
    color : Color or None
        The flat colour, not premultiplied, if pixels are opacities.
    """

    to_pixels: Affine
    pixels: NDArray[np.uint8]
    sampling: Sampling = Sampling.LINEAR
    opacity: float = 1.0
    color: tuple[float, float, float] | None = None

    def __post_init__(self) -> None:
        shape, numbers = np.shape(self.pixels), [*self.to_pixels[0], *self.to_pixels[1], *(self.color or ())]
        if (self.color is None) != (self.sampling.components == 4):
            raise SourceError("a picture has a flat colour if and only if its pixels are opacities")
        if (
            len(shape) != 3
            or shape[2] != self.sampling.components
            or not (min(shape[:2]) > 0 and max(shape[:2]) <= MOST_PICTURE_SIDE)
        ):
            raise SourceError(
                f"a picture has the shape {shape}; it needs 1 to {MOST_PICTURE_SIDE:,} rows and columns of RGBA, "
                "or of opacities"
            )
        if self.pixels.dtype != np.uint8 or (self.pixels[..., :-1] > self.pixels[..., -1:]).any():
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
        return self.opacity >= 1.0 and self.color is None and bool((self.pixels[..., 3] == 255).all())

    @property
    def mean(self) -> tuple[float, float, float, float]:
        """Mean colour, not premultiplied, and mean opacity, in 0..1.

        Examples
        --------
        >>> half = np.array([[[255, 0, 0, 255], [0, 0, 0, 0]]], np.uint8)
        >>> Picture(((2, 0, 0), (0, -1, 1)), half).mean
        (1.0, 0.0, 0.0, 0.5)
        """
        values = self.pixels.mean(axis=(0, 1)) / 255.0
        if self.color is not None:
            return *self.color, self.opacity * self._opacity_of(float(values[0]))
        red, green, blue, alpha = values.tolist()
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
        rows, columns = self.pixels.shape[:2]
        values = np.zeros(self.pixels.shape[2])
        for j, share in self._weights_at(row, rows):
            for i, part in self._weights_at(column, columns):
                values += share * part / 255.0 * self.pixels[j, i]
        if self.color is not None:
            alpha = self._opacity_of(min(max(float(values[0]), 0.0), 1.0))
            values = np.array([*(alpha * part for part in self.color), alpha])
        red, green, blue, alpha = (self.opacity * values).tolist()
        return red, green, blue, alpha

    def _opacity_of(self, value: float) -> float:
        """Return the opacity for the value of a spline of opacities."""
        return 1.0 - value if self.sampling is Sampling.INVERSE else value

    def _weights_at(self, place: float, count: int) -> list[tuple[int, float]]:
        """Return the columns or rows, of `count`, that have a part in the colour at a place, and their weights."""
        if self.sampling is Sampling.PIXELS:
            return [(min(max(floor(place), 0), count - 1), 1.0)]
        first = floor(place - 0.5)
        t = place - 0.5 - first
        if self.sampling is Sampling.LINEAR:
            weights = [1.0 - t, t]
        else:
            first, u = first - 1, 1.0 - t
            weights = [u**3 / 6.0, 2.0 / 3.0 - t * t * (1.0 - t / 2.0), 2.0 / 3.0 - u * u * (1.0 - u / 2.0), t**3 / 6.0]
        return [(min(max(first + k, 0), count - 1), weight) for k, weight in enumerate(weights)]
