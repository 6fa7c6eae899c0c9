"""From the edge index of the thesis's Table 4.1 (`vexture.bezier.area.edge_index`) to a point, and in whole steps."""

import numpy as np
from numpy.typing import NDArray

__all__ = ["edge_point", "quantised_ends"]


def edge_point(index: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points at edge indices: (..., 2) from (...); 1 is 0 again. One coordinate is exactly 0 or 1.

    Examples
    --------
    >>> edge_point(np.array([0.125, 0.375, 0.625, 0.875]))
    array([[0.5, 1. ], [1. , 0.5], [0.5, 0. ], [0. , 0.5]])
    """
    position = index % 1.0 * 4.0
    side = position.astype(np.intp)
    along = position - side
    x = np.choose(side, [along, 1.0, 1.0 - along, 0.0])
    y = np.choose(side, [1.0, 1.0 - along, 0.0, along])
    return np.stack([x, y], axis=-1)


def quantised_ends(index: NDArray[np.float64], clockwise: NDArray[np.bool_], steps: int) -> NDArray[np.int64]:
    """Edge indices of P0 and P3 as whole numbers of steps around the cell, never the same number for both.

    The order of the two around the cell says which side is filled: the filled part is bounded by the edge from P3
    clockwise to P0. Where both would round to one step, the one that errs least is moved to the next step in the
    direction that keeps this order; neither is then off by more than one step.

    Parameters
    ----------
    index : (n, 2) float64 array
        Edge index of P0 and P3, 0..1.
    clockwise : (n,) bool array
        Whether the curve itself turns clockwise; decides where P0 and P3 are the same point.
    steps : int
        Steps around the cell.

    Returns
    -------
    (n, 2) int64 array
        0 <= step < steps, distinct in every row.

    Examples
    --------
    >>> quantised_ends(np.array([[0.502, 0.5], [0.5, 0.502]]), np.array([True, True]), 100)
    array([[51, 50], [50, 51]])
    """
    exact = index * steps
    nearest = np.rint(exact)
    whole = nearest.astype(np.int64) % steps
    for i in np.flatnonzero(whole[:, 0] == whole[:, 1]):
        walk = (exact[i, 0] - exact[i, 1]) % steps  # clockwise from P3 to P0
        first = clockwise[i] if walk == 0.0 else walk < 0.5 * steps
        direction = 1 if first else -1  # of P0, seen from P3
        moved = exact[i] - nearest[i]
        if direction * (moved[0] + moved[1]) >= 0.0:
            whole[i, 0] += direction
        else:
            whole[i, 1] -= direction
    return whole % steps
