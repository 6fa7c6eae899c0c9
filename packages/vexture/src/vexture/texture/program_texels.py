"""Write the programs of a planar map as texels, in kernels (FORMAT.md, D.6)."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import (
    COORDINATE_BITS,
    KIND_FOCAL,
    KIND_FOLLOWS,
    KIND_KEEP,
    KIND_LINEAR,
    KIND_MIX,
    KIND_PICTURE,
    KIND_RADIAL,
    KIND_SHIFT,
    KIND_SOLID,
    PAINT_ONE,
    STOP_BITS,
    STOP_COUNT_BITS,
)
from vexture.texture.opacity_texels import count_opacity_texels, write_opacities
from vexture.texture.pixel_texels import count_pixel_texels, write_pixels
from vexture.tree.planar.compose import KEEP, SHADE, SOLID
from vexture.tree.planar.pixels import SIZE, size_at
from vexture.tree.planar.programs import ProgramTable
from vexture.tree.planar.shades import (
    COUNT,
    FIRST,
    FOCUS,
    OFFSET,
    PICTURE,
    RADIUS,
    SAMPLING_BITS,
    SPREAD,
    Shades,
)
from vexture.tree.planar.splines import OPACITY

SPREAD_SHIFT: Final = STOP_BITS + STOP_COUNT_BITS
"""Position of the spread in a gradient's word."""


class StopRuns(NamedTuple):
    """The stops and pixels of a map: gradients with equal stops share one run of texels, and so do equal pictures."""

    first: NDArray[np.int64]  # (gradients and pictures,): texel of each one's run, from the first operation; or -1
    owner: NDArray[np.int64]  # (gradients and pictures,): the first one that has its run
    words: NDArray[np.int64]  # (stops, 3): the texels of all stops
    texels: int  # number of texels of stops
    pixels: int  # number of texels of pixels, which follow
    # 1 if all distances between gradients and stops can be encoded, else 0: with a bool at its end, LLVM copies a
    # structure as one value, whose addresses WebAssembly places otherwise
    fit: int


@kernel(allocates=False)
def _texels_of_operation(table: ProgramTable, shades: Shades, k: int) -> int:
    """Number of texels of an operation."""
    if table.code[k] != SHADE:
        return 1
    row = shades.rows[table.number[k]]
    if row[FOCUS] == PICTURE:
        return 3
    if row[FOCUS] < 0.0:
        return 1
    return 2 if row[FOCUS] == 0.0 and row[RADIUS] == 0.0 else 3


@kernel(allocates=False)
def count_operations(table: ProgramTable, shades: Shades) -> int:
    """Number of texels of all operations."""
    texels = 0
    for k in range(len(table.code)):
        texels += _texels_of_operation(table, shades, k)
    return texels


@kernel(allocates=False)
def _sampling(row: NDArray[np.float64]) -> int:
    """Sampling of a picture."""
    return int(row[SPREAD]) & (1 << SAMPLING_BITS) - 1


@kernel
def stop_runs(table: ProgramTable, shades: Shades) -> StopRuns:
    """Runs of the stops and pixels of all programs, in the order of their first use."""
    words, count = _stop_words(shades), len(shades.rows)
    first, owner, size = np.full(count, -1), np.full(count, -1), 4
    while size < 2 * count:
        size *= 2
    slots, start = np.zeros(size, np.int64), count_operations(table, shades)
    after, pixels = start, 0
    for k in range(len(table.code)):
        number = table.number[k]
        if table.code[k] != SHADE or first[number] >= 0:
            continue
        slot = _hash_of_run(shades, words, number) & (size - 1)
        while slots[slot] != 0 and not _is_same_run(shades, words, slots[slot] - 1, number):
            slot = (slot + 1) & (size - 1)
        if slots[slot] == 0:
            slots[slot], row = number + 1, shades.rows[number]
            if row[FOCUS] == PICTURE:
                first[number] = pixels
                if _sampling(row) >= OPACITY:
                    pixels += count_opacity_texels(shades.pixels, int(row[FIRST]))
                else:
                    columns, rows = size_at(shades.pixels, int(row[FIRST]))
                    pixels += count_pixel_texels(columns, rows)
            else:
                first[number] = after
                after += int(row[COUNT])
        owner[number] = slots[slot] - 1
        first[number] = first[owner[number]]
    for number in range(count):
        if first[number] >= 0 and shades.rows[number, FOCUS] == PICTURE:
            first[number] += after
    return StopRuns(first, owner, words, after - start, pixels, 1 if after >> STOP_BITS == 0 else 0)


@kernel
def _stop_words(shades: Shades) -> NDArray[np.int64]:
    """First three words of the texels of stops: the offset in float32, red and green, blue and opacity."""
    offsets, words = np.empty(len(shades.stops), np.float32), np.empty((len(shades.stops), 3), np.int64)
    for k in range(len(words)):
        stop = shades.stops[k]
        offsets[k] = stop[OFFSET]
        for half in range(2):
            low, high = int(np.rint(PAINT_ONE * stop[2 * half])), int(np.rint(PAINT_ONE * stop[2 * half + 1]))
            words[k, 1 + half] = low | high << COORDINATE_BITS
    bits = offsets.view(np.uint32)
    for k in range(len(words)):
        words[k, 0] = bits[k]
    return words


@kernel(allocates=False)
def _hash_of_run(shades: Shades, words: NDArray[np.int64], number: int) -> int:
    """Hash of the texels of a gradient's stops, or of the place of a picture's pixels."""
    row = shades.rows[number]
    key = int(row[FIRST]) * 0x5851F42D4C957F2D if row[FOCUS] == PICTURE else int(row[COUNT])
    key ^= key >> 29 if row[FOCUS] == PICTURE else 0
    for k in range(int(row[FIRST]), int(row[FIRST] + row[COUNT])):
        for c in range(3):
            key = (key ^ words[k, c]) * 0x5851F42D4C957F2D
            key ^= key >> 29
    return key


@kernel(allocates=False)
def _is_same_run(shades: Shades, words: NDArray[np.int64], one: int, other: int) -> bool:
    """Whether two gradients have the same texels of stops, or two pictures the same pixels."""
    count = int(shades.rows[one, COUNT])  # 0 for a picture only
    if count != int(shades.rows[other, COUNT]):
        return False
    if count == 0:
        return int(shades.rows[one, FIRST]) == int(shades.rows[other, FIRST])
    a, b = int(shades.rows[one, FIRST]), int(shades.rows[other, FIRST])
    for k in range(count):
        for c in range(3):
            if words[a + k, c] != words[b + k, c]:
                return False
    return True


@kernel
def write_programs(
    table: ProgramTable, shades: Shades, runs: StopRuns, at: int, paint_words: NDArray[np.uint32]
) -> None:
    """Write the programs, whose first texel has the index `at`, and their words among those of the paints.

    `paint_words` begins at the texels of the paints; operations, stops and pixels follow them.
    """
    if len(table.code) == 0:
        return
    numbers = np.empty((len(shades.rows), 9), np.float32)
    for g in range(len(numbers)):
        for c in range(9):  # across, up, and the focal circle with a 0
            numbers[g, c] = shades.rows[g, c] if c < RADIUS + 1 else 0.0
    bits = numbers.view(np.uint32)
    operations = count_operations(table, shades)
    out = paint_words[len(paint_words) - operations - runs.texels - runs.pixels :]
    row = 0
    for program in range(len(table.paint)):
        begin, paint = row, table.paint[program]
        for k in range(table.starts[program], table.starts[program + 1]):
            if table.code[k] == SHADE and shades.rows[table.number[k], FOCUS] == PICTURE:
                row += _write_picture(shades, runs, table.number[k], bits, row, out)
            elif table.code[k] == SHADE:
                row += _write_gradient(shades, runs, table.number[k], bits, row, out)
            else:
                _write_operation(table, k, out[row])
                row += 1
        half = 2 * (paint & 1)
        paint_words[paint >> 1, half], paint_words[paint >> 1, half + 1] = at + begin, row - begin
    for g in range(len(numbers)):
        for k in range(int(shades.rows[g, COUNT]) if runs.first[g] >= 0 else 0):
            for c in range(3):
                out[runs.first[g] + k, c] = runs.words[int(shades.rows[g, FIRST]) + k, c]
        if runs.owner[g] == g and shades.rows[g, FOCUS] == PICTURE:
            if _sampling(shades.rows[g]) >= OPACITY:
                write_opacities(shades.pixels, int(shades.rows[g, FIRST]), runs.first[g], out)
            else:
                write_pixels(shades.pixels, int(shades.rows[g, FIRST]), runs.first[g], out)


@kernel(allocates=False)
def _write_operation(table: ProgramTable, k: int, texel: NDArray[np.uint32]) -> None:
    """Write the texel of an operation that is no gradient or picture."""
    code, number = table.code[k], table.number[k]
    if code == KEEP:
        texel[3] = KIND_KEEP << KIND_SHIFT
    elif code == SOLID:
        for half in range(2):
            word = 0
            for c in range(2):
                part = min(max(table.rgba[k, 2 * half + c], 0.0), 1.0)
                word |= int(np.rint(PAINT_ONE * part)) << COORDINATE_BITS * c
            texel[half] = word
        texel[3] = KIND_SOLID << KIND_SHIFT
    else:
        texel[0], texel[1], texel[3] = number & PAINT_ONE, number >> 16, KIND_MIX << KIND_SHIFT


@kernel(allocates=False)
def _write_gradient(
    shades: Shades, runs: StopRuns, number: int, bits: NDArray[np.uint32], row: int, out: NDArray[np.uint32]
) -> int:
    """Write the texels of a gradient from texel `row` on; return their number."""
    shade = shades.rows[number]
    kind, texels = KIND_LINEAR, 1
    if shade[FOCUS] >= 0.0:
        is_focal = shade[FOCUS] != 0.0 or shade[RADIUS] != 0.0
        kind, texels = (KIND_FOCAL, 3) if is_focal else (KIND_RADIAL, 2)
    for k in range(texels):
        for c in range(3):
            out[row + k, c] = bits[number, 3 * k + c]
        out[row + k, 3] = KIND_FOLLOWS << KIND_SHIFT
    word = kind << KIND_SHIFT | int(shade[SPREAD]) << SPREAD_SHIFT | int(shade[COUNT]) << STOP_BITS
    out[row, 3] = word | runs.first[number] - row
    return texels


@kernel(allocates=False)
def _write_picture(
    shades: Shades, runs: StopRuns, number: int, bits: NDArray[np.uint32], row: int, out: NDArray[np.uint32]
) -> int:
    """Write the texels of a picture from texel `row` on; return their number."""
    shade = shades.rows[number]
    out[row, 0] = int(np.rint(PAINT_ONE * shade[RADIUS]))
    out[row, 1] = shades.pixels[int(shade[FIRST]) + SIZE]
    out[row, 2] = runs.first[number] - row
    out[row, 3] = KIND_PICTURE << KIND_SHIFT | _sampling(shade)
    for k in range(2):
        for c in range(3):
            out[row + 1 + k, c] = bits[number, 3 * k + c]
        out[row + 1 + k, 3] = KIND_FOLLOWS << KIND_SHIFT
    out[row + 1, 3] |= np.uint32(int(shade[SPREAD]) >> SAMPLING_BITS)  # the colour of a picture of opacities
    return 3
