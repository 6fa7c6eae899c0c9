"""Depths on a lattice, step by step: what the readers of rasters find in their files."""

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime

import numpy as np
from numpy.typing import NDArray

from vexture.sources.lattice import Lattice

__all__ = ["Series"]

Values = NDArray[np.float64]


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
