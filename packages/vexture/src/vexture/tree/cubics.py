"""The cubics of a drawing in one array, without copies of contours that change nothing."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.split import copy_curve
from vexture.drawing.contours import join_contours, together
from vexture.drawing.drawing import Drawing

SPREAD: Final = 1021.0
"""Factor that spreads numbers which differ little over the whole table of contours."""

MOST_ALIKE: Final = 8
"""Different contours, or paths, of one key that are compared with another one. The time stays proportional to the
length of the contours, whatever they are; any further copies stay, and cost only time."""


class Outlines(NamedTuple):
    """All contours of a drawing, in the order of its paths."""

    cubics: NDArray[np.float64]  # (n, 4, 2)
    lengths: NDArray[np.int64]  # (contours,): cubics in each contour
    path: NDArray[np.int64]  # (contours,): the path of each, in rising order
    rules: NDArray[np.int64]  # (paths,): fill rules


def outlines_of(drawing: Drawing) -> Outlines:
    """Collect the contours of a drawing.

    Examples
    --------
    >>> outlines = outlines_of(Drawing.polygon([(0, 0), (1, 0), (0, 1)]))
    >>> outlines.cubics.shape, outlines.lengths, outlines.path, outlines.rules
    ((3, 4, 2), array([3]), array([0]), array([0]))
    """
    paths = drawing.paths
    contours = together([path.contours for path in paths])
    return Outlines(
        join_contours(contours),
        np.fromiter(map(len, contours), np.int64, len(contours)),
        np.repeat(np.arange(len(paths), dtype=np.int64), [len(path.contours) for path in paths]),
        np.array([int(path.fill_rule) for path in paths], np.int64),
    )


def gather(drawing: Drawing) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    """Cubics of a drawing (n, 4, 2) without needless copies, the path of each (n,), and the fill rules (paths,)."""
    outlines = outlines_of(drawing)
    return (*leave_out_copies(*outlines), outlines.rules)


@kernel(allocates=False)
def are_finite(cubics: NDArray[np.float64]) -> bool:
    """Whether all coordinates of cubics (n, 4, 2) are finite.

    Examples
    --------
    >>> are_finite(np.zeros((1, 4, 2))), are_finite(np.full((1, 4, 2), np.inf))
    (True, False)
    """
    total = 0.0
    for i in range(len(cubics)):
        for k in range(4):
            total += 0.0 * cubics[i, k, 0] + 0.0 * cubics[i, k, 1]
    return total == 0.0


@kernel
def leave_out_copies(
    cubics: NDArray[np.float64], lengths: NDArray[np.int64], path: NDArray[np.int64], rules: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Cubics that decide what a drawing's silhouette is, and the path of each; the arguments are those of `Outlines`.

    A path that repeats an earlier one adds nothing and is left out, and so are copies of a contour that do not change
    where its path is filled. If nothing is left out, the cubics are the given array itself.
    """
    starts = _starts_of(lengths)
    names = _name_contours(cubics, starts)
    is_needed = _needed_contours(names, path, rules)
    count = 0
    for i in range(len(lengths)):
        count += lengths[i] if is_needed[i] else 0
    owner, end = np.empty(count, np.int64), 0
    out = cubics if count == len(cubics) else np.empty((count, 4, 2))
    for i in range(len(lengths)):
        if is_needed[i]:
            for k in range(lengths[i]):
                if count < len(cubics):
                    copy_curve(cubics[starts[i] + k], out[end])
                owner[end] = path[i]
                end += 1
    return out, owner


@kernel
def _starts_of(lengths: NDArray[np.int64]) -> NDArray[np.int64]:
    """Number of the first cubic of each contour, and of all cubics."""
    starts = np.empty(len(lengths) + 1, np.int64)
    starts[0] = 0
    for i in range(len(lengths)):
        starts[i + 1] = starts[i] + lengths[i]
    return starts


@kernel(allocates=False)
def _key_of(contour: NDArray[np.float64]) -> float:
    """Number in 0..1 that copies of a contour share; that of most others differs.

    It reads three handles, so that the bits of a long coast need not be read to find that it has no copies.
    """
    number = float(len(contour))
    for cubic in (0, len(contour) >> 1, len(contour) - 1):
        for point in range(2):
            for axis in range(2):
                number = SPREAD * number + contour[cubic, point, axis]
                number -= np.floor(number)
    return number if 0.0 <= number < 1.0 else 0.0


@kernel(allocates=False)
def _is_copy(cubics: NDArray[np.float64], one: int, other: int, length: int) -> bool:
    """Whether runs of cubics that start with `one` and `other` are equal."""
    for i in range(length):
        for point in range(4):
            for axis in range(2):
                if cubics[one + i, point, axis] != cubics[other + i, point, axis]:
                    return False
    return True


@kernel
def _name_contours(cubics: NDArray[np.float64], starts: NDArray[np.int64]) -> NDArray[np.int64]:
    """Number of the first copy of each contour, which is its own number if it is the first one."""
    count, size = len(starts) - 1, 2
    while size < 2 * count:
        size *= 2
    names, keys, table = np.empty(count, np.int64), np.empty(count), np.empty(size, np.int64)
    for slot in range(size):
        table[slot] = -1
    for i in range(count):
        length = starts[i + 1] - starts[i]
        names[i], keys[i], alike = i, _key_of(cubics[starts[i] : starts[i + 1]]) if length > 0 else 0.0, 0
        slot = int(size * keys[i])
        while table[slot] >= 0 and alike < MOST_ALIKE:
            other = table[slot]
            if keys[other] == keys[i]:
                same = starts[other + 1] - starts[other] == length
                if same and _is_copy(cubics, starts[other], starts[i], length):
                    names[i] = other
                    break
                alike += 1
            slot = (slot + 1) & (size - 1)
        if table[slot] < 0:
            table[slot] = i
    return names


@kernel
def _needed_contours(names: NDArray[np.int64], path: NDArray[np.int64], rules: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Whether each contour decides where a path is filled that does not repeat an earlier path."""
    count = len(names)
    is_needed, counts = np.empty(count, np.bool_), np.zeros((count, 2), np.int64)
    # ends of the paths that begin with a contour of a name: the latest one, and for each the one before it
    latest, before = np.zeros(count, np.int64), np.zeros(count + 1, np.int64)
    starts = np.zeros(count + 1, np.int64)
    first = 0
    while first < count:
        last = first + 1
        while last < count and path[last] == path[first]:
            last += 1
        starts[last] = first
        if _repeats(names, path, rules, starts, latest[names[first]], before, last):
            for i in range(first, last):
                is_needed[i] = False
        else:
            before[last], latest[names[first]] = latest[names[first]], last
            _mark_deciding(names, first, last, rules[path[first]] == 1, counts, is_needed)
        first = last
    return is_needed


@kernel(allocates=False)
def _repeats(
    names: NDArray[np.int64],
    path: NDArray[np.int64],
    rules: NDArray[np.int64],
    starts: NDArray[np.int64],
    other: int,
    before: NDArray[np.int64],
    last: int,
) -> bool:
    """Whether the path that ends before contour `last` has the contours and the rule of one in the list of `other`."""
    length = last - starts[last]
    for _ in range(MOST_ALIKE):
        if other == 0:
            break
        same = other - starts[other] == length and rules[path[other - 1]] == rules[path[last - 1]]
        for i in range(length):
            same = same and names[starts[other] + i] == names[starts[last] + i]
        if same:
            return True
        other = before[other]
    return False


@kernel(allocates=False)
def _mark_deciding(
    names: NDArray[np.int64],
    first: int,
    last: int,
    is_even_odd: bool,
    counts: NDArray[np.int64],
    is_needed: NDArray[np.bool_],
) -> None:
    """Mark the contours of a path that decide where it is filled; `counts` (contours, 2) is 0 before and after.

    Under the even-odd rule two copies cancel. Under the nonzero rule all winding numbers may be divided by a common
    factor.
    """
    for i in range(first, last):
        counts[names[i], 0] += 1
    common = 0
    for i in range(first, last):
        rest = counts[names[i], 0]
        while rest > 0:
            common, rest = rest, common % rest
    for i in range(first, last):
        copies, place = counts[names[i], 0], counts[names[i], 1]
        is_needed[i] = place < (copies % 2 if is_even_odd else copies // common)
        counts[names[i], 1] = place + 1
    for i in range(first, last):
        counts[names[i], 0] = counts[names[i], 1] = 0
