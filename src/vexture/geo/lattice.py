"""Where the samples of a raster are: straight axes, whatever their spacing, and an affine map."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

__all__ = ["Lattice"]


@dataclass(frozen=True, slots=True, eq=False)
class Lattice:
    """Rows and columns of samples in a reference system.

    Positions are (column, row), counted from the middle of the first sample; each sample stands for the half steps
    around it.

    Parameters
    ----------
    x, y : float64 arrays
        Where the columns and the rows are along their axes, both rising or falling.
    affine : (2, 3) float64 array
        From positions along the axes to the units of the reference system.

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
    def box(self) -> tuple[float, float, float, float]:
        """West, south, east and north of all that the samples stand for."""
        edge = self.place(self.outline(-0.5, -0.5, self.shape[1] - 0.5, self.shape[0] - 0.5, 2))
        low, high = edge.min(axis=0), edge.max(axis=0)
        return (float(low[0]), float(low[1]), float(high[0]), float(high[1]))

    @staticmethod
    def outline(x0: float, y0: float, x1: float, y1: float, count: int = 33) -> NDArray[np.float64]:
        """Points around a rectangle, `count` to a side."""
        share = np.linspace(0.0, 1.0, count)
        corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)]
        sides = [np.column_stack([a[k] + (b[k] - a[k]) * share for k in range(2)]) for a, b in pairwise(corners)]
        return np.concatenate(sides)

    def place(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Positions, (n, 2), in the units of the reference system; straight on beyond the outermost samples."""
        along = np.column_stack([_at(axis, positions[:, k]) for k, axis in enumerate((self.x, self.y))])
        return along @ self.affine[:, :2].T + self.affine[:, 2]

    def find(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Positions of points of the reference system, (n, 2): the inverse of `place`."""
        along = (points - self.affine[:, 2]) @ np.linalg.inv(self.affine[:, :2]).T
        return np.column_stack([_index(axis, along[:, k]) for k, axis in enumerate((self.x, self.y))])

    def cut(self, rows: slice, columns: slice) -> "Lattice":
        """Only some of its samples."""
        return Lattice(self.x[columns], self.y[rows], self.affine)

    def moved(self, east: float) -> "Lattice":
        """Lattice so many units to the east."""
        return Lattice(self.x, self.y, self.affine + np.array([[0.0, 0.0, east], [0.0, 0.0, 0.0]]))


def _steps(axis: NDArray[np.float64]) -> tuple[float, float]:
    """First and last step; one sample stands for a step of 1."""
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
