"""Sorting by keys, as small kernels: NumPy's sort costs Numba seconds to compile."""

import numpy as np
from numpy.typing import NDArray

from vexture.kernels import kernel

__all__ = ["sort_order"]


@kernel(allocates=False)
def _sift(keys: NDArray[np.float64], order: NDArray[np.int64], root: int, count: int) -> None:
    """Restore the heap below a place."""
    while 2 * root + 1 < count:
        child = 2 * root + 1
        if child + 1 < count and keys[order[child]] < keys[order[child + 1]]:
            child += 1
        if keys[order[root]] >= keys[order[child]]:
            return
        order[root], order[child] = order[child], order[root]
        root = child


@kernel
def sort_order(keys: NDArray[np.float64], count: int) -> NDArray[np.int64]:
    """Numbers of the first `count` keys in rising order of the keys (heap sort).

    Examples
    --------
    >>> sort_order(np.array([3.0, 1.0, 2.0]), 3)
    array([1, 2, 0])
    """
    order = np.empty(count, np.int64)
    for k in range(count):
        order[k] = k
    for root in range(count // 2 - 1, -1, -1):
        _sift(keys, order, root, count)
    for last in range(count - 1, 0, -1):
        order[0], order[last] = order[last], order[0]
        _sift(keys, order, 0, last)
    return order
