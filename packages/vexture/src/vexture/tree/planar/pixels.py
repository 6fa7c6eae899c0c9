"""The pixels of pictures, and the exact mean colour of an interpolated picture over a box of its plane."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.drawing.picture import Picture, Sampling
from vexture.tree.planar.splines import SPLINE, spline_integral, spline_span

SIZE, IS_OPAQUE, FIRST_PIXEL = range(3)
"""Places in the words of a picture: number of columns, and above it that of rows; 1 if nothing shows through any
pixel, else 0; the first pixel, which the others follow row by row, from the top.

A pixel is a word of premultiplied red, green, blue and opacity, from the low byte up, or of one component.
"""

SIDE_BITS: Final = 16
"""The number of columns is in the low bits of a picture's size, the number of rows above."""

BYTE: Final = 255
"""Full value of a pixel's component."""

LEAST_WIDTH: Final = 1e-6
"""Pixels. A narrower box counts as this wide."""

LINEAR = int(Sampling.LINEAR)


def list_pixels(pictures: Sequence[Picture]) -> tuple[NDArray[np.uint32], list[int]]:
    """Return the words of the pixels of pictures, and where those of each begin; equal pixels are there once."""
    known: dict[int, int] = {}  # by identity: copies of a tile share their array
    equal: dict[tuple[tuple[int, ...], bytes], int] = {}
    parts: list[NDArray[np.uint32]] = []
    begins, end = [], 0
    for picture in pictures:
        pixels = picture.pixels
        begin = known.get(id(pixels))
        if begin is None:
            begin = known[id(pixels)] = equal.setdefault((pixels.shape, pixels.tobytes()), end)
        if begin == end:
            rows, columns = pixels.shape[:2]
            is_opaque = pixels.shape[2] == 4 and bool((pixels[..., 3] == BYTE).all())
            head = [columns | rows << SIDE_BITS, int(is_opaque)]
            parts += [np.array(head, np.uint32), words_of(pixels)]
            end += FIRST_PIXEL + rows * columns
        begins.append(begin)
    return np.concatenate([np.zeros(0, np.uint32), *parts]), begins


def words_of(pixels: NDArray[np.uint8]) -> NDArray[np.uint32]:
    """Words of pixels (rows, columns, 1 or 4), row by row."""
    if pixels.shape[2] == 1:
        return pixels.ravel().astype(np.uint32)
    return np.ascontiguousarray(pixels).view("<u4").ravel().astype(np.uint32)


def pixels_of_words(words: NDArray[np.uint32], components: int = 4) -> NDArray[np.uint8]:
    """Pixels (rows, columns, components) from their words (rows, columns)."""
    return np.ascontiguousarray(words.astype("<u4")[..., None].view(np.uint8)[..., :components])


def pixels_at(words: NDArray[np.uint32], begin: int, components: int = 4) -> NDArray[np.uint8]:
    """Pixels (rows, columns, components) of the picture whose words begin at `begin`."""
    columns, rows = (int(part) for part in size_at(words, begin))
    return pixels_of_words(words[begin + FIRST_PIXEL :][: rows * columns].reshape(rows, columns), components)


@kernel(allocates=False)
def size_at(words: NDArray[np.uint32], begin: int) -> tuple[int, int]:
    """Return the numbers of columns and rows of the picture whose words begin at `begin`."""
    size = int(np.int64(words[begin + SIZE]))  # unsigned integers would make floats of sums
    return size & ((1 << SIDE_BITS) - 1), size >> SIDE_BITS


@kernel(allocates=False)
def _hat_integral(at: float, is_first: bool, is_last: bool) -> float:
    """Integral from 0 to `at` of the weight of a pixel at a distance from its centre; beyond the border it is 1."""
    if at < 0.0:
        low = at if is_first else max(at, -1.0)
        return low if is_first else low + 0.5 * low * low
    high = at if is_last else min(at, 1.0)
    return high if is_last else high - 0.5 * high * high


@kernel(allocates=False)
def _weight(sampling: int, last: int, k: int, low: float, high: float) -> float:
    """Integral from `low` to `high` of the weight of column or row k of 0..last."""
    if sampling == LINEAR:
        middle, is_first, is_last = k + 0.5, k == 0, k == last
        return _hat_integral(high - middle, is_first, is_last) - _hat_integral(low - middle, is_first, is_last)
    if sampling >= SPLINE:
        return spline_integral(high - (k + 0.5)) - spline_integral(low - (k + 0.5))
    begin, end = low if k == 0 else max(low, float(k)), high if k == last else min(high, k + 1.0)
    return max(end - begin, 0.0)


@kernel(allocates=False)
def _interval(middle: float, width: float, count: int) -> tuple[float, float]:
    """Return an interval about a place of `count` pixels; one that is all beyond the border is moved to it."""
    half = 0.5 * max(width, LEAST_WIDTH)
    middle = min(max(middle, -half), count + half)
    return middle - half, middle + half


@kernel(allocates=False)
def _span(sampling: int, count: int, low: float, high: float) -> tuple[int, int]:
    """Return the first column or row, of `count`, that has a weight in an interval, and the one after the last.

    Those of a spline may not exist.
    """
    if sampling >= SPLINE:
        return spline_span(low, high)
    away = 0.5 if sampling == LINEAR else 0.0
    first = int(np.floor(min(max(low - away, 0.0), count - 1.0)))
    last = int(np.floor(min(max(high + away, 0.0), count - 1.0)))
    return first, last + 1


@kernel(allocates=False)
def mean_of_picture(
    words: NDArray[np.uint32],
    begin: int,
    sampling: int,
    place: tuple[float, float],
    size: tuple[float, float],
    out: NDArray[np.float64],
) -> None:
    """Write the premultiplied mean colour (4,) of a picture over a box: `place` is its middle, in columns and rows.

    A picture of opacities has them in the first component.
    """
    columns, rows = size_at(words, begin)
    left, right = _interval(place[0], size[0], columns)
    top, bottom = _interval(place[1], size[1], rows)
    first, end = _span(sampling, columns, left, right)
    first_row, end_row = _span(sampling, rows, top, bottom)
    for c in range(4):
        out[c] = 0.0
    for j in range(first_row, end_row):
        down = _weight(sampling, rows - 1, j, top, bottom)
        for i in range(first, end):
            share = down * _weight(sampling, columns - 1, i, left, right)
            at = min(max(j, 0), rows - 1) * columns + min(max(i, 0), columns - 1)
            word = int(np.int64(words[begin + FIRST_PIXEL + at]))
            for c in range(4):
                out[c] += share * (word >> 8 * c & BYTE)
    area = BYTE * (right - left) * (bottom - top)
    for c in range(4):
        out[c] /= area
