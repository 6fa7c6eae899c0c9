"""Permitted distance between a leaf's outline and the drawing's."""

from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import ParameterError
from vexture.base.kernels import kernel
from vexture.base.tolerance import CELL_SHARE, COARSEST, DETAIL_SHARE, FINEST


class Accuracy(NamedTuple):
    """Rule for the largest distance between the outlines before quantisation, in cells of any size."""

    distance: float  # upper limit, in unit-square units
    share: float  # upper limit, as a share of the cell
    step: float  # lower limit, as a share of the cell: quantisation moves the outline that far


@kernel
def cell_tolerance(accuracy: Accuracy, size: float) -> float:
    """Tolerance in a cell of a given size, both in unit-square units."""
    return max(min(accuracy.distance, accuracy.share * size), accuracy.step * size)


def accuracy_of(tolerance: float | Literal["auto"], cubics: NDArray[np.float64], step: float = 0.0) -> Accuracy:
    """Accuracy for a tolerance in unit-square units or "auto"; raises a `ParameterError` unless it is between 0 and 1.

    "auto" depends on the smallest detail of the drawing's cubics (n, 4, 2) (thesis 5.2.1) and on the size of the cell
    (thesis 6.2.1). It is no coarser than what is invisible at usual sizes, and no finer than usual depth limits can use
    or than `step`, the share of a cell by which quantisation moves an outline.

    Examples
    --------
    >>> accuracy_of("auto", np.empty((0, 4, 2))).distance == COARSEST
    True
    """
    if tolerance != "auto":
        if not (isinstance(tolerance, int | float) and 0.0 < tolerance < 1.0):
            raise ParameterError(
                f"`tolerance` {tolerance!r} is not between 0 and 1 (unit-square units); use auto or e.g. 0.0005"
            )
        return Accuracy(float(tolerance), np.inf, 0.0)
    detail = np.ptp(cubics, axis=1).max(axis=1).min() if len(cubics) else np.inf
    return Accuracy(float(np.clip(DETAIL_SHARE * detail, FINEST, COARSEST)), CELL_SHARE, step)
