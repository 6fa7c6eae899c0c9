"""Cells of a curvilinear grid: which of them are there, and their corners, from the places of their middles."""

import numpy as np
from numpy.typing import NDArray

Places = NDArray[np.float64]

FAR: float = 1e9
"""No coordinate in metres or degrees exceeds it; files without a declared fill value contain 1e37."""


def without_fill(x: Places, y: Places) -> tuple[Places, Places]:
    """Coordinates with NaN for cells that a model has not: those with fill values, which several cells share.

    Where both coordinates are the same number, such as 0 or -999, in more than one cell, that number is a fill value.

    Examples
    --------
    >>> without_fill(np.array([[0.0, 0.0, 5.0]]), np.array([[0.0, 0.0, 0.0]]))[0]
    array([[nan, nan,  5.]])
    """
    with np.errstate(invalid="ignore"):
        lost = ~np.isfinite(x) | ~np.isfinite(y) | (np.abs(x) > FAR) | (np.abs(y) > FAR)
    alike = ~lost & (x == y)
    values, counts = np.unique(x[alike], return_counts=True)
    lost |= alike & np.isin(x, values[counts > 1])
    return np.where(lost, np.nan, x), np.where(lost, np.nan, y)


def corners_of(centres: Places, known: NDArray[np.bool_]) -> Places:
    """Corners of cells, (rows + 1, columns + 1, 2), from their middles, (rows, columns, 2); NaN where no cell is.

    Amid four known cells a corner is the mean of their middles. Along a border it is half a cell beyond the middles, by
    the distance between those on this side of it.

    Examples
    --------
    >>> x, y = np.meshgrid([0.0, 10.0], [0.0, 4.0])
    >>> corners_of(np.stack([x, y], axis=-1), np.ones((2, 2), bool))[:, 0]
    array([[-5., -2.],
           [-5.,  2.],
           [-5.,  6.]])
    """
    rows, columns = known.shape
    middles = np.where(known[..., None], centres, np.nan)
    down, across = _with_other(*(_steps(middles, axis) for axis in (0, 1)))
    total, among = np.zeros((rows + 1, columns + 1, 2)), np.zeros((rows + 1, columns + 1, 2))
    count = np.zeros((rows + 1, columns + 1, 1))
    for below in (0, 1):
        for right in (0, 1):
            at = slice(below, rows + below), slice(right, columns + right)
            corner = middles + (below - 0.5) * down + (right - 0.5) * across
            total[at] += np.where(known[..., None], corner, 0.0)
            among[at] += np.where(known[..., None], middles, 0.0)
            count[at] += known[..., None]
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(count == 4.0, among, total) / count


def _steps(middles: Places, axis: int) -> Places:
    """Way from one cell to the next along an axis: the mean of the ways to its known neighbours; NaN without any."""
    ways = np.diff(middles, axis=axis)
    none = np.full_like(np.take(middles, [0], axis), np.nan)
    both = np.stack([np.concatenate([none, ways], axis), np.concatenate([ways, none], axis)])
    there = np.isfinite(both)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(np.where(there, both, 0.0).sum(axis=0) / there.sum(axis=0))


def _with_other(down: Places, across: Places) -> tuple[Places, Places]:
    """Ways down and across; where there is one of them only, as in a channel of one cell, the other is as long."""
    turned = down[..., 0] * across[..., 1] - down[..., 1] * across[..., 0]
    hand = -1.0 if np.nansum(np.sign(turned)) < 0.0 else 1.0

    def square(way: Places, sign: float) -> Places:
        return sign * hand * np.stack([-way[..., 1], way[..., 0]], axis=-1)

    return (
        np.where(np.isfinite(down), down, np.nan_to_num(square(across, -1.0))),
        np.where(np.isfinite(across), across, np.nan_to_num(square(down, 1.0))),
    )
