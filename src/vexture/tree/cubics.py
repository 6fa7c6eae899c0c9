"""The cubics of a drawing in one array."""

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.contours import joined
from vexture.drawing import Drawing, FillRule

__all__ = ["gather"]


def gather(drawing: Drawing) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    """Cubics of a drawing (n, 4, 2), the path of each (n,), and the paths' fill rules (paths,).

    A path that repeats an earlier one bit for bit adds nothing to the silhouette and is left out, and so are copies of
    a contour that do not change where its path is filled.
    """
    different: dict[tuple[Any, ...], list[NDArray[np.float64]]] = {}
    names = _names([contour for path in drawing.paths for contour in path.contours])
    for path in drawing.paths:
        bits = list(islice(names, len(path.contours)))
        if (path.fill_rule, *bits) not in different:
            different[path.fill_rule, *bits] = [path.contours[k] for k in _needed(path.fill_rule, bits)]
    contours = [contour for kept in different.values() for contour in kept]
    lengths = [sum(map(len, kept)) for kept in different.values()]
    cubics = joined(contours)
    owner = np.repeat(np.arange(len(lengths), dtype=np.int64), lengths)
    return cubics, owner, np.array([int(rule) for rule, *_ in different], dtype=np.int64)


def _names(contours: Sequence[NDArray[np.float64]]) -> Iterator[bytes]:
    """A name of each contour, alike for copies alone: length and first handle, or all its bits if others share those.

    So a coast is not copied once more to find that it has no copies.
    """
    short = [b"%d " % len(contour) + contour[0, :2].tobytes() for contour in contours]
    shared = Counter(short)
    for contour, name in zip(contours, short, strict=True):
        yield name if shared[name] == 1 else contour.tobytes()


def _needed(rule: FillRule, contours: list[bytes]) -> Iterable[int]:
    """Places of the contours that decide where a path is filled.

    Under the even-odd rule two copies cancel. Under the nonzero rule all winding numbers may be divided by a common
    factor.

    Examples
    --------
    >>> list(_needed(FillRule.NONZERO, [b"a", b"a", b"b", b"b"])), list(_needed(FillRule.EVENODD, [b"a", b"a", b"b"]))
    ([0, 2], [2])
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
