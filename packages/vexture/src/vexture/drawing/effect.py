"""Pictures that a function makes of drawings: the results of filters that have to be sampled.

A drawing has no type here, as it has paints itself.
"""

from collections.abc import Callable
from copy import copy
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import SourceError
from vexture.drawing.affine import Affine, compose_affine

Pixels: TypeAlias = NDArray[np.float64]
"""Premultiplied sRGB and opacity, 0..1, (rows, columns, 4), the top row first."""

LEAST_DEPTH, MOST_DEPTH = 2, 9
"""Binary logarithms of the least and greatest number of pixels on a side."""


@dataclass(frozen=True, slots=True, eq=False)
class ProcessChain:
    """A process of an effect that is followed by a further function of its pixels."""

    process: Callable[[tuple[Pixels, ...]], Pixels]
    change: Callable[[Pixels], Pixels]

    def __call__(self, rasters: tuple[Pixels, ...]) -> Pixels:
        """Return the changed pixels."""
        return self.change(self.process(rasters))


@dataclass(frozen=True, slots=True, eq=False)
class Effect:
    """A picture as a paint that a function makes of the pixels of drawings.

    Parameters
    ----------
    sources : tuple of Drawing
        Each in the same unit square, which the picture covers.
    to_source : Affine
        Map from the drawing's coordinates to that unit square.
    depth : int
        Binary logarithm of the number of pixels on a side of the unit square.
    process : callable
        Makes the pixels of the picture from those of each source. Its result has as many rows and columns; values
        beyond 0..1, and colours above their opacity, are limited. It can be pickled, as drawings go from process to
        process.
    """

    sources: tuple[Any, ...]
    to_source: Affine
    depth: int
    process: Callable[[tuple[Pixels, ...]], Pixels]

    def __post_init__(self) -> None:
        if not LEAST_DEPTH <= self.depth <= MOST_DEPTH:
            raise SourceError(f"a sampled picture has 2^{self.depth} pixels a side; use {LEAST_DEPTH} to {MOST_DEPTH}")

    def after(self, matrix: Affine) -> "Effect":
        """Return the picture in new coordinates; `matrix` maps the new ones to the old ones."""
        effect = copy(self)
        object.__setattr__(effect, "to_source", compose_affine(self.to_source, matrix))
        return effect

    def then(self, change: Callable[[Pixels], Pixels]) -> "Effect":
        """Return the picture after a further function of its pixels."""
        return replace(self, process=ProcessChain(self.process, change))

    @property
    def to_pixels(self) -> Affine:
        """Map from the drawing's coordinates to columns and rows of the picture."""
        side = float(1 << self.depth)
        return compose_affine(((side, 0.0, 0.0), (0.0, -side, side)), self.to_source)

    def to_bytes(self, rasters: tuple[Pixels, ...]) -> NDArray[np.uint8]:
        """Return the pixels of the picture, as those of `Picture`, from the pixels of its sources."""
        made = self.process(rasters).clip(0.0, 1.0)
        made[..., :3] = np.minimum(made[..., :3], made[..., 3:])
        return np.floor(255.0 * made + 0.5).astype(np.uint8)
