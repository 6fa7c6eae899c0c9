"""The normal form between every source and the quad-tree.

A `Drawing` is a list of painted `Path` objects in the unit square: x to the right, **y up**, origin at the bottom
left. Every contour is closed and made of cubics only; a straight line is a cubic with its inner control points at
one and two thirds.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from vexture.errors import SourceError

__all__ = ["Drawing", "FillRule", "Paint", "Path"]

IDENTITY = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])


class FillRule(IntEnum):
    """Which winding numbers are inside."""

    NONZERO = 0
    EVENODD = 1


@dataclass(frozen=True, slots=True)
class Paint:
    """A flat colour: sRGB components and opacity, each in 0..1."""

    color: tuple[float, float, float] = (0.0, 0.0, 0.0)
    opacity: float = 1.0


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """Closed contours that are filled together by one rule.

    Parameters
    ----------
    contours : tuple of (n, 4, 2) float64 arrays
        Cubics P0 P1 P2 P3 in unit-square units; each starts, bit for bit, where the one before it ends, and the
        first starts where the last ends.
    fill_rule : FillRule
        Which winding numbers are inside.
    paint : Paint
        The colour it is filled with.

    Raises
    ------
    SourceError
        If a contour is of another shape, is not closed or is not finite.
    """

    contours: tuple[NDArray[np.float64], ...]
    fill_rule: FillRule = FillRule.NONZERO
    paint: Paint = Paint()

    def __post_init__(self) -> None:
        for contour in self.contours:
            if contour.dtype != np.float64 or contour.ndim != 3 or contour.shape[1:] != (4, 2) or not len(contour):
                raise SourceError(f"a contour is {contour.dtype}{contour.shape}; it must be float64 (n, 4, 2), n >= 1")
            if not np.isfinite(contour).all():
                raise SourceError("a contour holds a coordinate that is not finite; correct the drawing")
            if not np.array_equal(contour[:, 3], np.roll(contour[:, 0], -1, axis=0)):
                raise SourceError("a contour is open; every cubic must start exactly where the one before it ends")


@dataclass(frozen=True, slots=True, eq=False)
class Drawing:
    """Painted paths in the unit square, in painting order.

    Its *silhouette* is the union of everything painted.

    Parameters
    ----------
    paths : tuple of Path
        In painting order; all coordinates lie in [0, 1].
    to_source : (2, 3) float64 array
        Affine map from the unit square to the units of the source, so that a user can map back.
    name : str
        Names the shape in messages and files.

    Examples
    --------
    >>> square = Drawing.polygon([(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)])
    >>> square.segments
    4
    """

    paths: tuple[Path, ...]
    to_source: NDArray[np.float64] = field(default_factory=IDENTITY.copy)
    name: str = "drawing"

    def __post_init__(self) -> None:
        for path in self.paths:
            for contour in path.contours:
                ends = contour[:, 0]
                if ends.min() < 0.0 or ends.max() > 1.0:
                    raise SourceError(f"{self.name}: a contour leaves the unit square; clip or scale it first")

    @property
    def segments(self) -> int:
        """Number of cubics."""
        return sum(len(contour) for path in self.paths for contour in path.contours)

    @classmethod
    def polygon(cls, *contours: Iterable[tuple[float, float]], fill_rule: FillRule = FillRule.NONZERO) -> "Drawing":
        """Drawing of one path with straight sides, from its corners in unit-square units.

        Examples
        --------
        >>> Drawing.polygon([(0, 0), (1, 0), (0, 1)]).paths[0].contours[0][0]
        array([[0.        , 0.        ],
               [0.33333333, 0.        ],
               [0.66666667, 0.        ],
               [1.        , 0.        ]])
        """
        closed = []
        for contour in contours:
            start = np.array(list(contour), dtype=np.float64)
            end = np.roll(start, -1, axis=0)
            closed.append(np.stack([start, start + (end - start) / 3, start + (end - start) * (2 / 3), end], axis=1))
        return cls((Path(tuple(closed), fill_rule),))
