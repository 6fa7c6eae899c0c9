"""Write the pixels of pictures and their levels as texels, in kernels, and read them (FORMAT.md, D.6)."""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import CELL_BITS
from vexture.tree.planar.pixels import BYTE, FIRST_PIXEL, size_at


@kernel(allocates=False)
def count_levels(columns: int, rows: int) -> int:
    """Number of levels of a picture, of which the last has one pixel."""
    levels = 1
    while max(columns, rows) > 1 << levels - 1:
        levels += 1
    return levels


@kernel(allocates=False)
def count_pixel_texels(columns: int, rows: int) -> int:
    """Number of texels of all levels of a picture."""
    texels = 0
    for level in range(count_levels(columns, rows)):
        size = 1 << level
        texels += texels_of_level((columns + size - 1) >> level, (rows + size - 1) >> level)
    return texels


@kernel(allocates=False)
def texels_of_level(columns: int, rows: int) -> int:
    """Number of texels of so many pixels: a texel holds 2 x 2."""
    return ((columns + 1) >> 1) * ((rows + 1) >> 1)


@kernel(allocates=False)
def _write_pixel(out: NDArray[np.uint32], first: int, columns: int, i: int, j: int, word: int) -> None:
    """Write the pixel in column i and row j of a level whose texels begin at `first`."""
    texel = first + (j >> 1) * ((columns + 1) >> 1) + (i >> 1)
    out[texel, 2 * (j & 1) + (i & 1)] = word


@kernel
def write_pixels(words: NDArray[np.uint32], begin: int, first: int, out: NDArray[np.uint32]) -> int:
    """Write all levels of the picture whose words begin at `begin`; return the texel after them."""
    columns, rows = size_at(words, begin)
    for j in range(rows):
        for i in range(columns):
            _write_pixel(out, first, columns, i, j, int(np.int64(words[begin + FIRST_PIXEL + j * columns + i])))
    first += texels_of_level(columns, rows)
    sums = np.zeros((1, 1, 4), np.int64)
    for level in range(1, count_levels(columns, rows)):
        across, down = (columns - 1 >> level) + 1, (rows - 1 >> level) + 1
        sums = _sum_pixels(words, begin) if level == 1 else _sum_blocks(sums)
        for j in range(down):
            high = min(j + 1 << level, rows) - (j << level)
            for i in range(across):
                pixels = high * (min(i + 1 << level, columns) - (i << level))
                word = 0
                for c in range(4):
                    word |= (2 * sums[j, i, c] + pixels) // (2 * pixels) << CELL_BITS * c
                _write_pixel(out, first, across, i, j, word)
        first += texels_of_level(across, down)
    return first


@kernel
def _sum_pixels(words: NDArray[np.uint32], begin: int) -> NDArray[np.int64]:
    """Sums of the components of blocks of 2 x 2 pixels, (rows, columns, 4)."""
    columns, rows = size_at(words, begin)
    sums = np.zeros(((rows + 1) >> 1, (columns + 1) >> 1, 4), np.int64)
    for j in range(rows):
        for i in range(columns):
            word = int(np.int64(words[begin + FIRST_PIXEL + j * columns + i]))
            for c in range(4):
                sums[j >> 1, i >> 1, c] += word >> CELL_BITS * c & BYTE
    return sums


@kernel
def _sum_blocks(sums: NDArray[np.int64]) -> NDArray[np.int64]:
    """Sums of blocks of 2 x 2 sums."""
    rows, columns, _ = sums.shape
    total = np.zeros(((rows + 1) >> 1, (columns + 1) >> 1, 4), np.int64)
    for j in range(rows):
        for i in range(columns):
            for c in range(4):
                total[j >> 1, i >> 1, c] += sums[j, i, c]
    return total


def read_pixels(texels: NDArray[np.uint32], first: int, columns: int, rows: int) -> NDArray[np.uint32]:
    """Words of the pixels of a picture, whose texels begin at `first`, row by row: its first level."""
    across, down = (columns + 1) >> 1, (rows + 1) >> 1
    tiles = texels[first : first + across * down].reshape(down, across, 2, 2)
    return tiles.transpose(0, 2, 1, 3).reshape(2 * down, 2 * across)[:rows, :columns].ravel()


def first_bad_pixel(texels: NDArray[np.uint32], step: int = 1 << 18) -> int | None:
    """Return the first of some texels of pixels that holds a colour above its opacity, or None."""
    for start in range(0, len(texels), step):
        words = texels[start : start + step]
        alpha, bad = words >> 3 * CELL_BITS, np.zeros(len(words), np.bool_)
        for c in range(3):
            bad |= ((words >> CELL_BITS * c & BYTE) > alpha).any(axis=1)
        if bad.any():
            return start + int(bad.argmax())
    return None
