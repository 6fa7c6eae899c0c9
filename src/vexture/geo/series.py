"""Depths on a lattice, step by step: what the readers of rasters find in their files."""

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import Drawing
from vexture.geo.lattice import Lattice

__all__ = ["Reading", "Series", "Values", "plausible"]

Values = NDArray[np.float64]

FARTHEST: Final = 12_000.0
"""Metres. Depths and heights beyond it are none: files without a fill value write 1e37."""

MISSING: Final = (-999.0, -9999.0)
"""And these."""


@dataclass(frozen=True, slots=True, eq=False)
class Reading:
    """One step in a frame.

    Parameters
    ----------
    drawing : Drawing
        Where water is; its name and reference system are not set.
    depth, bed : (rows, columns) float32 array or None
        As `Step` and `Extent` have them.
    known : bool
        Whether the file has any number there.
    """

    drawing: Drawing
    depth: NDArray[np.float32]
    bed: NDArray[np.float32] | None
    known: bool


def plausible(values: Values) -> Values:
    """Values without those that cannot be depths or heights in metres.

    Examples
    --------
    >>> plausible(np.array([1.5, -9999.0, 1e37, -2.0]))
    array([ 1.5,  nan,  nan, -2. ])
    """
    with np.errstate(invalid="ignore"):
        absurd = (np.abs(values) > FARTHEST) | np.isin(values, MISSING)
    return np.where(absurd, np.nan, values)


@dataclass(frozen=True, slots=True, eq=False)
class Series:
    """A file of depths that is open.

    Parameters
    ----------
    lattice : Lattice
        Where its samples are.
    crs : str or None
        What the file says of its reference system.
    variable : str
        What is read, as messages name it.
    times : tuple of datetime or None
        One for each step.
    read : function
        Depth and, if the file has it, height of the bed at a step, of a range of rows and of columns (which may skip
        some); metres, NaN where nothing is known.
    """

    lattice: Lattice
    crs: str | None
    variable: str
    times: tuple[datetime | None, ...]
    read: Callable[[int, slice, slice], tuple[Values, Values | None]]

    @property
    def box(self) -> tuple[float, float, float, float]:
        """West, south, east, north."""
        return self.lattice.box
