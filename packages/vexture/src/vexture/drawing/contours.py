"""Contours of cubics: parts of one shared array, which can be read as a whole without a copy."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import SourceError
from vexture.bezier.convert import write_lines

BLOCK = 1 << 18
"""Cubics of short contours that are checked in one batch, 17 MB."""


MANY, SHORT = 1 << 12, 16
"""Limits on the number of contours and on their mean length: for many short ones, copying is faster than looking."""

LINES: Final = 1 << 13
"""Lines that are written in one batch, which fits the processor's cache: 0.5 MB."""


class Closed(tuple[NDArray[np.float64], ...]):
    """Contours that were built closed, with the array that holds them all in order."""

    whole: NDArray[np.float64]

    def __reduce__(self) -> tuple[Any, ...]:
        return tuple, (list(self),)  # in another process they do not share an array


def ring_contours(points: NDArray[np.float64], ends: NDArray[np.intp]) -> tuple[NDArray[np.float64], ...]:
    """Make contours with straight sides through points (n, 2), as parts of one array.

    `ends` are the indices after the last point of each ring. The first point of a ring is not repeated at its end.

    Examples
    --------
    >>> corners = np.array([(0, 0), (1, 0), (0, 1), (0.5, 0.5), (1, 0.5), (0.5, 1)], float)
    >>> left, right = ring_contours(corners, np.array([3, 6]))
    >>> right[:, 3].tolist(), left.base is right.base
    ([[1.0, 0.5], [0.5, 1.0], [0.5, 0.5]], True)
    """
    if not len(ends):
        return ()
    cubics = np.empty((len(points), 4, 2))
    starts = np.append(0, ends[:-1])
    for first in range(0, len(points), LINES):
        last = min(first + LINES, len(points))
        following = np.arange(first + 1, last + 1)
        closing = slice(*np.searchsorted(ends, (first + 1, last + 1)))
        following[ends[closing] - 1 - first] = starts[closing]
        write_lines(points[first:last], points[following], cubics[first:last])
    contours = Closed(_parts(cubics, ends))
    contours.whole = cubics
    return contours


def _parts(cubics: NDArray[np.float64], ends: NDArray[np.intp]) -> list[NDArray[np.float64]]:
    """Split an array at indices; `numpy.split` takes four times as long."""
    places = [0, *ends.tolist()]
    return [cubics[start:end] for start, end in pairwise(places)]


def together(of_paths: Sequence[Sequence[NDArray[np.float64]]]) -> Sequence[NDArray[np.float64]]:
    """Return all contours of several paths."""
    if len(of_paths) == 1:
        return of_paths[0]  # may know its shared array
    return [contour for contours in of_paths for contour in contours]


def join_contours(contours: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    """Return all cubics of contours, (n, 4, 2), read-only: a view of the array that they share, or else a copy.

    Examples
    --------
    >>> whole = np.zeros((5, 4, 2))
    >>> [np.shares_memory(whole, join_contours(parts)) for parts in ([whole[1:3], whole[3:]], [whole[3:], whole[:3]])]
    [True, False]
    """
    if isinstance(contours, Closed):
        return contours.whole
    if not contours:
        return np.empty((0, 4, 2))
    if len(contours) > MANY and sum(map(len, contours)) < SHORT * len(contours):
        return _copy_contours(contours)
    base: Any = contours[0] if len(contours) == 1 else contours[0].base  # bytes if the array came from another process
    if not isinstance(base, np.ndarray) or base.dtype != np.float64:
        return _copy_contours(contours)
    if not (base.flags.c_contiguous and base.flags.writeable):
        return _copy_contours(contours)
    first = at = _address(contours[0])
    for contour in contours:
        if (contour.base is not base and contour is not base) or _address(contour) != at or not _is_plain(contour):
            return _copy_contours(contours)
        at += contour.nbytes
    start, end = ((place - _address(base)) // base.itemsize for place in (first, at))
    found: NDArray[np.float64] = base.reshape(-1)[start:end].reshape(-1, 4, 2)
    return found


def _copy_contours(contours: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    return np.ascontiguousarray(np.concatenate(contours))  # concatenate keeps the order of the axes


def _is_plain(contour: NDArray[np.float64]) -> bool:
    """Return whether kernels can read a contour without a copy."""
    return contour.flags.c_contiguous and contour.dtype == np.float64


def _address(array: NDArray[np.float64]) -> int:
    return int(array.__array_interface__["data"][0])


def check_contours(contours: Sequence[NDArray[np.float64]]) -> None:
    """Raise a `SourceError` unless each contour is a float64 array (n, 4, 2), finite and closed bit for bit."""
    if isinstance(contours, Closed):
        _check_finite(contours.whole)
        return
    batch: list[NDArray[np.float64]] = []
    cubics = 0
    for contour in contours:
        if contour.dtype != np.float64 or contour.ndim != 3 or contour.shape[1:] != (4, 2) or not len(contour):
            raise SourceError(f"a contour is {contour.dtype}{contour.shape}; it must be float64 (n, 4, 2), n >= 1")
        batch.append(contour)
        cubics += len(contour)
        if cubics >= BLOCK:
            _check_values(batch)
            batch, cubics = [], 0
    if batch:
        _check_values(batch)


def _check_finite(cubics: NDArray[np.float64]) -> None:
    for first in range(0, len(cubics), BLOCK):
        if not np.isfinite(cubics[first : first + BLOCK]).all():
            raise SourceError("a contour holds a coordinate that is not finite; correct the drawing")


def _check_values(contours: Sequence[NDArray[np.float64]]) -> None:
    cubics = join_contours(contours)
    _check_finite(cubics)
    lasts = np.cumsum([len(contour) for contour in contours]) - 1
    firsts = np.append(0, lasts[:-1] + 1)
    for axis in range(2):  # NumPy is slow along an axis of length two
        begins, ends = cubics[:, 0, axis], cubics[:, 3, axis]
        apart = ends[:-1] != begins[1:]
        apart[lasts[:-1]] = False
        if apart.any() or (ends[lasts] != begins[firsts]).any():
            raise SourceError("a contour is open; every cubic must start exactly where the one before it ends")
