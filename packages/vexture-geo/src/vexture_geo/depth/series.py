"""An open raster of depths: the places of its samples, and a function that reads the values of a step."""

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from itertools import pairwise
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture_geo.base.depth_ranges import DepthRange
from vexture_geo.base.extent import Bounds

Values = NDArray[np.float64]

FARTHEST: Final = 12_000.0
"""Metres. Limit of depths and heights; files without a declared fill value contain 1e37."""

MISSING: Final = (-999.0, -9999.0)
"""Fill values that files use without declaring them."""


class Reading(NamedTuple):
    """Values of one step, in metres and seconds: NaN where unknown, None where the file has none.

    `bed` is the height of the bed, `speed` the speed of the water.
    """

    depth: Values
    bed: Values | None = None
    speed: Values | None = None

    def each(self, change: Callable[[Values], Values]) -> "Reading":
        """Apply a function to all values that exist."""
        return Reading(*(None if values is None else change(values) for values in self))  # type: ignore[arg-type]

    def at(self, places: Any) -> "Reading":
        """Select the values at some of the places."""
        return self.each(lambda values: values[places])

    @property
    def plausible(self) -> "Reading":
        """Replace impossible values by NaN."""
        return self.each(plausible)


@dataclass(frozen=True, slots=True)
class Meaning:
    """Meaning of the numbers of a file.

    They are metres or, with `ranges`, ranks of classes of depth: 1 for the first class. `has_unit` means that the file
    names a unit, `are_whole` that they were written as whole numbers, and `are_colors` that they belong to a picture or
    a table of colours.
    """

    ranges: tuple[DepthRange, ...] = ()
    has_unit: bool = True
    are_whole: bool = False
    are_colors: bool = False


METRES: Final = Meaning()
"""Meaning of depths that the file states to be in metres."""


def plausible(values: Values) -> Values:
    """Replace values that cannot be depths or heights in metres by NaN.

    Examples
    --------
    >>> plausible(np.array([1.5, -9999.0, 1e37, -2.0]))
    array([ 1.5,  nan,  nan, -2. ])
    """
    with np.errstate(invalid="ignore"):
        absurd = (np.abs(values) > FARTHEST) | np.isin(values, MISSING)
    return np.where(absurd, np.nan, values)


def box_around(points: NDArray[np.float64]) -> Bounds:
    """West, south, east and north of points, (n, 2)."""
    (west, south), (east, north) = points.min(axis=0), points.max(axis=0)
    return (float(west), float(south), float(east), float(north))


@dataclass(frozen=True, slots=True, eq=False)
class Lattice:
    """Rows and columns of samples in a reference system.

    Positions are (column, row), counted from the middle of the first sample; each sample stands for the half steps
    around it. Along their axes, columns are at `x` and rows at `y`, rising or falling, at any spacing. `affine`,
    (2, 3), maps these places to the units of the reference system.

    Examples
    --------
    >>> lattice = Lattice(np.array([0.0, 1.0, 3.0]), np.array([20.0, 10.0]), np.eye(2, 3))
    >>> lattice.place(np.array([[1.5, 0.5], [-1.0, 0.0]]))
    array([[ 2., 15.],
           [-1., 20.]])
    >>> lattice.find(np.array([[2.0, 15.0]]))
    array([[1.5, 0.5]])
    >>> lattice.box
    (-0.5, 5.0, 4.0, 25.0)
    """

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    affine: NDArray[np.float64]

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return len(self.y), len(self.x)

    @property
    def box(self) -> Bounds:
        """West, south, east and north of the area that the samples represent."""
        return box_around(self.place(self.outline(-0.5, -0.5, self.shape[1] - 0.5, self.shape[0] - 0.5, 2)))

    @staticmethod
    def outline(x0: float, y0: float, x1: float, y1: float, count: int = 33) -> NDArray[np.float64]:
        """Points around a rectangle, `count` to a side."""
        share = np.linspace(0.0, 1.0, count)
        corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)]
        sides = [np.column_stack([a[k] + (b[k] - a[k]) * share for k in range(2)]) for a, b in pairwise(corners)]
        return np.concatenate(sides)

    def place(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Convert positions, (n, 2), to units of the reference system; they may lie beyond the outermost samples."""
        along = np.column_stack([_at(axis, positions[:, k]) for k, axis in enumerate((self.x, self.y))])
        placed: NDArray[np.float64] = np.einsum("nk,ik->ni", along, self.affine[:, :2]) + self.affine[:, 2]
        return placed

    def find(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Convert points of the reference system, (n, 2), to positions: the inverse of `place`."""
        along = (points - self.affine[:, 2]) @ np.linalg.inv(self.affine[:, :2]).T
        return np.column_stack([_index(axis, along[:, k]) for k, axis in enumerate((self.x, self.y))])


def _steps(axis: NDArray[np.float64]) -> tuple[float, float]:
    """First and last step; 1 for an axis of one sample."""
    return (float(axis[1] - axis[0]), float(axis[-1] - axis[-2])) if len(axis) > 1 else (1.0, 1.0)


def _at(axis: NDArray[np.float64], index: NDArray[np.float64]) -> NDArray[np.float64]:
    first, last = _steps(axis)
    end = len(axis) - 1
    inside = np.interp(index, np.arange(len(axis)), axis)
    return inside + np.minimum(index, 0.0) * first + np.maximum(index - end, 0.0) * last


def _index(axis: NDArray[np.float64], place: NDArray[np.float64]) -> NDArray[np.float64]:
    sign = -1.0 if axis[-1] < axis[0] else 1.0
    first, last = _steps(axis)
    inside = np.interp(sign * place, sign * axis, np.arange(len(axis)))
    before = np.minimum((place - axis[0]) / first, 0.0)
    found: NDArray[np.float64] = inside + before + np.maximum((place - axis[-1]) / last, 0.0)
    return found


@dataclass(frozen=True, slots=True, eq=False)
class Series:
    """An open file of depths on a lattice, at one time or at several.

    `read` returns the values of a step for a slice of rows and one of columns. `crs` is the reference system that the
    file names, if any. `meaning` is that of the numbers of depths, and `unit` is the file's unit of coordinates.
    """

    lattice: Lattice
    crs: str | None
    variable: str
    times: tuple[datetime | None, ...]
    read: Callable[[int, slice, slice], Reading]
    meaning: Meaning = METRES
    unit: str = ""

    @property
    def box(self) -> Bounds:
        """West, south, east, north."""
        return self.lattice.box
