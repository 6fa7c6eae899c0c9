"""Sizes of pictures: the room that they take in a texture, and means of squares of their pixels."""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.layout import MOST_PICTURE_SIDE
from vexture.drawing.drawing import Path
from vexture.drawing.picture import Picture


class Reduction(NamedTuple):
    """A picture that was halved until it fitted."""

    original: NDArray[np.uint8]
    reduced: NDArray[np.uint8]


def texel_count(columns: int, rows: int) -> int:
    """Return the number of texels of a picture with all its levels: 2 x 2 pixels each.

    Examples
    --------
    >>> texel_count(1, 1), texel_count(4, 4), texel_count(5, 3)
    (1, 6, 10)
    """
    total = 0
    while True:
        total += -(-columns // 2) * -(-rows // 2)
        if columns == rows == 1:
            return total
        columns, rows = -(-columns // 2), -(-rows // 2)


def halvings_needed(columns: int, rows: int, most: int) -> int:
    """Return how often a picture must be halved to take at most a number of texels.

    Examples
    --------
    >>> halvings_needed(1024, 512, 262_144), halvings_needed(1024, 1024, 262_144), halvings_needed(40_000, 1, 262_144)
    (0, 1, 2)
    """
    count = 0
    while texel_count(columns, rows) > most or max(columns, rows) > MOST_PICTURE_SIDE:
        columns, rows, count = -(-columns // 2), -(-rows // 2), count + 1
    return count


def halve(pixels: NDArray[np.uint8], times: int) -> NDArray[np.uint8]:
    """Return the means of squares of 2^times pixels, of those that exist; the pixels are premultiplied.

    Examples
    --------
    >>> halve(np.array([[[9] * 4, [10] * 4, [4] * 4]], np.uint8), 1)[..., 0].tolist()
    [[10, 4]]
    """
    if times == 0:
        return pixels
    side = 1 << times
    rows, columns = pixels.shape[:2]
    by_rows = np.zeros((-(-rows // side), columns, 4), np.uint32)
    for first in range(min(side, rows)):
        part = pixels[first::side]
        by_rows[: len(part)] += part
    sums = np.zeros((len(by_rows), -(-columns // side), 4), np.int64)
    for first in range(min(side, columns)):
        part = by_rows[:, first::side]
        sums[:, : part.shape[1]] += part
    heights, widths = (np.diff(np.append(np.arange(0, size, side), size)) for size in (rows, columns))
    counts = (heights[:, None] * widths)[..., None]
    means: NDArray[np.uint8] = ((2 * sums + counts) // (2 * counts)).astype(np.uint8)
    return means


def fit_pictures(paths: Sequence[Path], most: int) -> tuple[tuple[Path, ...], list[Reduction]]:
    """Halve the largest of the pictures of some paths until all together take at most a number of texels."""
    originals = {id(path.paint.picture.pixels): path.paint.picture.pixels for path in paths if path.paint.picture}
    times = dict.fromkeys(originals, 0)
    counts = {key: texel_count(pixels.shape[1], pixels.shape[0]) for key, pixels in originals.items()}
    while sum(counts.values()) > most and max(counts.values()) > 1:
        key = max(counts, key=lambda each: counts[each])
        times[key] += 1
        rows, columns = (-(-side >> times[key]) for side in originals[key].shape[:2])
        counts[key] = texel_count(columns, rows)
    if not any(times.values()):
        return tuple(paths), []
    reduced = {key: halve(originals[key], count) for key, count in times.items() if count}
    fitted = []
    for path in paths:
        picture = path.paint.picture
        if picture is not None and id(picture.pixels) in reduced:
            key = id(picture.pixels)
            path = replace(path, paint=replace(path.paint, picture=shrink(picture, reduced[key], times[key])))
        fitted.append(path)
    return tuple(fitted), [Reduction(originals[key], pixels) for key, pixels in reduced.items()]


def shrink(picture: Picture, pixels: NDArray[np.uint8], times: int) -> Picture:
    """Return a picture with pixels that were halved a number of times."""
    (a, b, c), (d, e, f) = picture.to_pixels
    part = 0.5**times
    return replace(picture, to_pixels=((part * a, part * b, part * c), (part * d, part * e, part * f)), pixels=pixels)
