"""Write splines of opacities as texels, in kernels, and read them (FORMAT.md, D.6).

Blocks of 4 x 4 coefficients that are all equal take only an entry of an index.
"""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import BLOCK_SIDE, CELL_BITS, COORDINATE_BITS, ENTRY_BITS, FIRST_BLOCK
from vexture.texture.pixel_texels import count_levels
from vexture.tree.planar.pixels import BYTE, FIRST_PIXEL, size_at


@kernel(allocates=False)
def count_entries(columns: int, rows: int) -> int:
    """Number of blocks of all levels of a picture, and of entries in its index."""
    entries = 0
    for level in range(count_levels(columns, rows)):
        across, down = (columns - 1 >> level) + 1, (rows - 1 >> level) + 1
        entries += ((across - 1) // BLOCK_SIDE + 1) * ((down - 1) // BLOCK_SIDE + 1)
    return entries


@kernel(allocates=False)
def index_texels(entries: int) -> int:
    """Number of texels of an index."""
    return entries + (1 << ENTRY_BITS) - 1 >> ENTRY_BITS


@kernel
def count_opacity_texels(words: NDArray[np.uint32], begin: int) -> int:
    """Number of texels of the picture of opacities whose words begin at `begin`."""
    return write_opacities(words, begin, 0, np.zeros((0, 4), np.uint32))


@kernel
def write_opacities(words: NDArray[np.uint32], begin: int, first: int, out: NDArray[np.uint32]) -> int:
    """Write all levels of the picture of opacities whose words begin at `begin`; return the texel after them.

    Nothing is written if `out` is empty.
    """
    columns, rows = size_at(words, begin)
    sums = np.empty((rows, columns), np.int64)
    for j in range(rows):
        for i in range(columns):
            sums[j, i] = np.int64(words[begin + FIRST_PIXEL + j * columns + i])
    entry, blocks = 0, first + index_texels(count_entries(columns, rows))
    end = blocks
    for level in range(count_levels(columns, rows)):
        sums = sums if level == 0 else _sum_squares(sums)
        values = np.empty(sums.shape, np.int64)
        for j in range(values.shape[0]):
            high = min(j + 1 << level, rows) - (j << level)
            for i in range(values.shape[1]):
                pixels = high * (min(i + 1 << level, columns) - (i << level))
                values[j, i] = (2 * sums[j, i] + pixels) // (2 * pixels)
        for j in range(0, values.shape[0], BLOCK_SIDE):
            for i in range(0, values.shape[1], BLOCK_SIDE):
                number = _write_block(values, i, j, end, out)
                if number < 0:
                    number, end = FIRST_BLOCK + end - blocks, end + 1
                if len(out) > 0:
                    at, shift = first + (entry >> ENTRY_BITS), COORDINATE_BITS * (entry & 1)
                    out[at, entry >> 1 & 3] |= np.uint32(number << shift)
                entry += 1
    return end


@kernel
def _sum_squares(sums: NDArray[np.int64]) -> NDArray[np.int64]:
    """Sums of squares of 2 x 2 sums."""
    rows, columns = sums.shape
    total = np.zeros((rows + 1 >> 1, columns + 1 >> 1), np.int64)
    for j in range(rows):
        for i in range(columns):
            total[j >> 1, i >> 1] += sums[j, i]
    return total


@kernel(allocates=False)
def _write_block(values: NDArray[np.int64], i: int, j: int, at: int, out: NDArray[np.uint32]) -> int:
    """Return the value of a block that has only one; write another one to texel `at` and return -1."""
    value, is_equal, (rows, columns) = int(values[j, i]), True, values.shape
    end_row, end = min(j + BLOCK_SIDE, rows), min(i + BLOCK_SIDE, columns)
    for row in range(j, end_row):
        for column in range(i, end):
            is_equal = is_equal and values[row, column] == value
    if is_equal:
        return value
    for row in range(j, end_row if len(out) > 0 else j):
        word = 0
        for column in range(i, end):
            word |= values[row, column] << CELL_BITS * (column - i)
        out[at, row - j] = word
    return -1


def count_blocks(columns: int, rows: int) -> int:
    """Return the number of `count_entries` without a kernel, because a check of a file must not compile any."""
    levels = range((max(columns, rows) - 1).bit_length() + 1)
    return sum(((columns - 1 >> level) // BLOCK_SIDE + 1) * ((rows - 1 >> level) // BLOCK_SIDE + 1) for level in levels)


def entries_of(texels: NDArray[np.uint32], first: int, columns: int, rows: int) -> NDArray[np.int64]:
    """Entries in the texels of the index of a picture of opacities, which begin at `first`."""
    words = texels[first : first + (count_blocks(columns, rows) + 7 >> ENTRY_BITS)].ravel()
    both = np.stack([words & (1 << COORDINATE_BITS) - 1, words >> COORDINATE_BITS], axis=1)
    return both.ravel().astype(np.int64)


def read_opacities(texels: NDArray[np.uint32], first: int, columns: int, rows: int) -> NDArray[np.uint32]:
    """Opacities of a picture, whose texels begin at `first`, row by row: its first level."""
    across, down = (columns + 3) // 4, (rows + 3) // 4
    entries = entries_of(texels, first, columns, rows)
    blocks = first + (len(entries) >> ENTRY_BITS)
    entries = entries[: across * down]
    stored = texels[np.where(entries < FIRST_BLOCK, 0, blocks + entries - FIRST_BLOCK)]
    values = np.stack([stored >> CELL_BITS * c & BYTE for c in range(4)], axis=2)  # (blocks, rows, columns)
    values = np.where(entries[:, None, None] < FIRST_BLOCK, entries[:, None, None], values)
    tiles = values.reshape(down, across, 4, 4).transpose(0, 2, 1, 3).reshape(4 * down, 4 * across)
    return tiles[:rows, :columns].ravel().astype(np.uint32)
