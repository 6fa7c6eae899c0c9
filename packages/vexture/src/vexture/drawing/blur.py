"""Gaussian blurs as paints: shadows of drawings, and drawings out of focus.

A drawing has no type here, as it has paints itself.
"""

from copy import copy
from dataclasses import dataclass
from math import ceil, isfinite
from typing import Any, Final

from vexture.base.errors import SourceError
from vexture.drawing.affine import Affine, compose_affine

Window = tuple[float, float, float, float]
"""Least x and y, greatest x and y."""

SPACING: Final = 0.75
"""Deviations between coefficients of a grid. The cubic spline through a Gaussian's values is off by up to 0.0014."""

REACH: Final = 3.5
"""Deviations beyond which a blurred edge is not seen: 0.0002 of its opacity are left."""


@dataclass(frozen=True, slots=True, eq=False)
class Blur:
    """A Gaussian blur of a drawing as a paint: of its opacity, in one colour, or of its colours.

    Without `has_colors`, the paint is its flat colour, with an opacity of its own opacity times the blurred opacity of
    the source, or times 1 minus that if `is_inverted`.

    Parameters
    ----------
    source : Drawing
        In its own unit square. Nothing is painted outside it.
    to_source : Affine
        Map from the drawing's coordinates to those of the source.
    deviations : (float, float)
        Standard deviations along x and y of the source, in its unit-square units; both are above 0.
    window : (float, float, float, float)
        Least x and y, greatest x and y, in coordinates of the source, of the part that is painted; beyond it, the
        colours at its border continue.
    has_colors : bool
        True if the paint is the blurred picture of the source, in its colours, times the paint's opacity.
    is_inverted : bool
        Only without `has_colors`.
    is_linear : bool
        True if colours are blurred in linear light; only with `has_colors`.
    """

    source: Any
    to_source: Affine
    deviations: tuple[float, float]
    window: Window
    has_colors: bool = False
    is_inverted: bool = False
    is_linear: bool = False

    def __post_init__(self) -> None:
        numbers = [*self.to_source[0], *self.to_source[1], *self.deviations, *self.window]
        left, low, right, high = self.window
        if not all(map(isfinite, numbers)) or min(self.deviations) <= 0.0 or not (left < right and low < high):
            raise SourceError(
                f"a blur has the map {self.to_source}, deviations {self.deviations}, window {self.window}"
            )
        if (self.is_inverted and self.has_colors) or (self.is_linear and not self.has_colors):
            raise SourceError("only a blur in one colour can be inverted, and only one of colours is in linear light")

    def after(self, matrix: Affine) -> "Blur":
        """Return the blur in new coordinates; `matrix` maps the new ones to the old ones."""
        blur = copy(self)
        object.__setattr__(blur, "to_source", compose_affine(self.to_source, matrix))
        return blur

    @property
    def size(self) -> tuple[int, int]:
        """Columns and rows of coefficients that represent the blur in a texture."""
        left, low, right, high = self.window
        across, up = self.deviations
        return ceil((right - left) / (SPACING * across)) + 3, ceil((high - low) / (SPACING * up)) + 3
