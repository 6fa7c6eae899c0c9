"""The cubics of a drawing in one array."""

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.contours import Closed, join_contours, together
from vexture.drawing.drawing import Drawing, FillRule

MIXED: Final = 0.7548776662466927
"""Factor by which several numbers are combined into one."""


def gather(drawing: Drawing) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    """Cubics of a drawing (n, 4, 2), the path of each (n,), and the paths' fill rules (paths,).

    A path that repeats an earlier one bit for bit adds nothing to the silhouette and is left out, and so are copies of
    a contour that do not change where its path is filled.
    """
    of_paths = [path.contours for path in drawing.paths]
    if _all_differ(together(of_paths)):
        return (*cubics_and_paths(of_paths), np.array([int(path.fill_rule) for path in drawing.paths], dtype=np.int64))
    different: dict[tuple[Any, ...], list[NDArray[np.float64]]] = {}
    names = _names([contour for path in drawing.paths for contour in path.contours])
    for path in drawing.paths:
        bits = list(islice(names, len(path.contours)))
        if (path.fill_rule, *bits) not in different:
            different[path.fill_rule, *bits] = [path.contours[k] for k in _deciding_contours(path.fill_rule, bits)]
    rules = np.array([int(rule) for rule, *_ in different], dtype=np.int64)
    return (*cubics_and_paths([*different.values()]), rules)


def cubics_and_paths(
    of_paths: Sequence[Sequence[NDArray[np.float64]]],
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Cubics of some paths, and the number of each cubic's path."""
    lengths = [sum(map(len, contours)) for contours in of_paths]
    return join_contours(together(of_paths)), np.repeat(np.arange(len(lengths), dtype=np.int64), lengths)


def _all_differ(contours: Sequence[NDArray[np.float64]]) -> bool:
    """Whether contours that are parts of one array are certainly no copies, because their first handles differ.

    Equal handles give equal numbers, because each number is rounded in the same way.
    """
    if not isinstance(contours, Closed):
        return False
    lengths = np.fromiter(map(len, contours), np.int64, len(contours))
    handles = contours.whole[np.cumsum(lengths) - lengths]
    numbers = np.zeros(len(handles))
    for point in range(2):
        for axis in range(2):
            numbers = MIXED * numbers + handles[:, point, axis]
    return len(np.unique(numbers)) == len(numbers)


def _names(contours: Sequence[NDArray[np.float64]]) -> Iterator[bytes]:
    """A name for each contour, which only copies share.

    It is the contour's length and first handle, or all its bits if another contour shares those. So the bits of a long
    coast need not be copied to find that it has no copies.
    """
    short = [b"%d " % len(contour) + contour[0, :2].tobytes() for contour in contours]
    shared = Counter(short)
    for contour, name in zip(contours, short, strict=True):
        yield name if shared[name] == 1 else contour.tobytes()


def _deciding_contours(rule: FillRule, contours: list[bytes]) -> Iterable[int]:
    """Places of the contours that decide where a path is filled.

    Under the even-odd rule two copies cancel. Under the nonzero rule all winding numbers may be divided by a common
    factor.

    Examples
    --------
    >>> list(_deciding_contours(FillRule.NONZERO, [b"a", b"a", b"b", b"b"]))
    [0, 2]
    >>> list(_deciding_contours(FillRule.EVENODD, [b"a", b"a", b"b"]))
    [2]
    """
    copies = Counter(contours)
    if len(copies) == len(contours):
        return range(len(contours))
    common = math.gcd(*copies.values())
    left = {bits: count % 2 if rule is FillRule.EVENODD else count // common for bits, count in copies.items()}
    needed = []
    for place, bits in enumerate(contours):
        if left[bits]:
            left[bits] -= 1
            needed.append(place)
    return needed
