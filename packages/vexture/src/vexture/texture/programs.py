"""Decode the programs of a planar map from its texels (FORMAT.md, D.6)."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base import layout
from vexture.base.errors import FormatError
from vexture.drawing.group import Blend, Mask
from vexture.drawing.paint import Spread
from vexture.drawing.picture import Sampling
from vexture.texture.opacity_texels import count_blocks, entries_of, read_opacities
from vexture.texture.pixel_texels import first_bad_pixel, read_pixels
from vexture.texture.program_texels import SPREAD_SHIFT
from vexture.texture.walk import REMEDY
from vexture.tree.planar.compose import KEEP, MIX, SHADE, SOLID
from vexture.tree.planar.pixels import BYTE, FIRST_PIXEL, SIDE_BITS
from vexture.tree.planar.programs import ProgramTable, number_of_ending
from vexture.tree.planar.shades import COUNT, FIRST, FOCUS, PICTURE, RADIUS, SAMPLING_BITS, SPREAD, Shades

ENDS: Final = [*map(number_of_ending, Blend), *(number_of_ending(mask) for mask in Mask if mask)]
"""Numbers of the allowed endings of a group."""

CODES: Final = np.array([SHADE, SOLID, SHADE, SHADE, SHADE, KEEP, MIX, 0])
"""Code of an operation, by its kind."""

FOLLOWING: Final = np.array([2, 0, 0, 1, 2, 0, 0, 0])
"""Number of texels of the kind `FOLLOWS` after the first texel of an operation, by its kind."""


COLOUR: Final = (1 << 3 * layout.CELL_BITS) - 1
"""Bits of the colour of a picture of opacities."""


def halves(words: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """Red, green, blue and opacity, (n, 4), in steps of 1/65535, from two words each, (n, 2)."""
    both = np.stack([words & layout.PAINT_ONE, words >> layout.COORDINATE_BITS], axis=2)
    return both.reshape(-1, 4)


class ProgramTexels(NamedTuple):
    """Texels of the programs of a map, (n, 4) each."""

    operations: NDArray[np.uint32]
    stops: NDArray[np.uint32]
    pixels: NDArray[np.uint32]


def read_programs(texels: ProgramTexels, starts: dict[int, tuple[int, int]]) -> tuple[ProgramTable, Shades]:
    """Decode the programs of a map, which `check_programs` has checked."""
    operations = texels.operations
    kind = (operations[:, 3] >> layout.KIND_SHIFT).astype(np.int64)
    rows = np.flatnonzero(kind != layout.KIND_FOLLOWS)
    kind = kind[rows]
    is_shade = CODES[kind] == SHADE
    number = np.zeros(len(rows), np.int64)
    number[is_shade] = np.arange(is_shade.sum())
    mixes = operations[rows[kind == layout.KIND_MIX]].astype(np.int64)
    number[kind == layout.KIND_MIX] = mixes[:, 1] << 16 | mixes[:, 0]
    rgba = np.zeros((len(rows), 4))
    rgba[kind == layout.KIND_SOLID] = halves(operations[rows[kind == layout.KIND_SOLID], :2]) / layout.PAINT_ONE
    begin = np.searchsorted(rows, [start for start, _ in starts.values()])
    table = ProgramTable(
        np.array([*starts], np.int64), np.append(begin, len(rows)).astype(np.int64), CODES[kind], number, rgba
    )
    return table, _read_shades(texels, rows[is_shade])


def _read_shades(texels: ProgramTexels, rows: NDArray[np.int64]) -> Shades:
    """Gradients and pictures whose first texels are rows of checked texels."""
    operations, stops, _ = texels
    words = operations[rows, 3].astype(np.int64)
    kind = words >> layout.KIND_SHIFT
    shades = np.full((len(rows), 11), -1.0)
    for part, of_kinds in enumerate((layout.KIND_LINEAR, layout.KIND_RADIAL, layout.KIND_FOCAL)):
        some = kind >= of_kinds
        floats = np.ascontiguousarray(operations[rows[some] + part, :3]).view(np.float32)
        shades[some, 3 * part : 3 * part + 3] = floats
    shades[kind == layout.KIND_LINEAR, 3:FOCUS] = 0.0
    shades[kind == layout.KIND_RADIAL, FOCUS : RADIUS + 1] = 0.0
    shades[:, SPREAD] = words >> SPREAD_SHIFT & 3
    shades[:, FIRST] = rows + (words & (1 << layout.STOP_BITS) - 1) - len(operations)
    shades[:, COUNT] = words >> layout.STOP_BITS & layout.MOST_STOPS
    pictures = kind == layout.KIND_PICTURE
    shades[pictures], pixels = _read_pictures(texels, rows[pictures])
    offsets = np.ascontiguousarray(stops[:, 0]).view(np.float32).astype(np.float64)
    return Shades(shades, np.column_stack([halves(stops[:, 1:3]) / layout.PAINT_ONE, offsets]), pixels)


def _read_pictures(texels: ProgramTexels, rows: NDArray[np.int64]) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """Rows of pictures, and the words of their pixels."""
    begins: dict[tuple[int, int, int], int] = {}
    parts, end, found = [np.zeros(0, np.uint32)], 0, np.zeros((len(rows), 11))
    for k, key in enumerate(zip(*(part.tolist() for part in _pictures_in(texels, rows)), strict=True)):
        if key not in begins:
            is_opaque = False
            if texels.operations[rows[k], 3] >= Sampling.OPACITY:
                words = read_opacities(texels.pixels, *key)
            else:
                words = read_pixels(texels.pixels, *key)
                is_opaque = bool((words >> 3 * layout.CELL_BITS == BYTE).all())
            parts += [np.array([key[1] | key[2] << SIDE_BITS, is_opaque], np.uint32), words]
            begins[key], end = end, end + FIRST_PIXEL + len(words)
        found[k, FIRST] = begins[key]
    for part in range(2):
        found[:, 3 * part : 3 * part + 3] = np.ascontiguousarray(texels.operations[rows + 1 + part, :3]).view(
            np.float32
        )
    found[:, FOCUS], found[:, RADIUS] = PICTURE, texels.operations[rows, 0] / layout.PAINT_ONE
    colours = texels.operations[rows + 1, 3].astype(np.int64) & COLOUR
    found[:, SPREAD] = texels.operations[rows, 3] | colours << SAMPLING_BITS
    return found, np.concatenate(parts)


def _pictures_in(
    texels: ProgramTexels, rows: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """First texel, among those of pixels, of each picture, its columns and its rows."""
    size = texels.operations[rows, 1].astype(np.int64)
    first = rows + texels.operations[rows, 2].astype(np.int64) - len(texels.operations) - len(texels.stops)
    return first, size & (1 << SIDE_BITS) - 1, size >> SIDE_BITS


def _need(holds: bool, message: str) -> None:
    if not holds:
        raise FormatError(f"a map's programs: {message}; {REMEDY}")


def check_programs(texels: ProgramTexels, runs: dict[int, tuple[int, int]]) -> None:
    """Raise a `FormatError` unless the programs of a map conform to FORMAT.md.

    `runs` holds the first operation texel of each paint that is a program, and the number of its texels.
    """
    operations, stops, _ = texels
    starts = np.array([*runs.values()], np.int64).reshape(-1, 2)
    begin, counts = starts.T
    _need(bool((begin == np.cumsum(counts) - counts).all()) and counts.sum() == len(operations), "they leave gaps")
    _need(counts.min(initial=1) >= 1 and counts.max(initial=1) <= layout.MOST_PROGRAM, "one is empty or too long")
    kind = (operations[:, 3] >> layout.KIND_SHIFT).astype(np.int64)
    first = np.flatnonzero(kind != layout.KIND_FOLLOWS)
    _need(bool(np.isin(begin, first).all()), "half of an operation")
    ends = np.append(first[1:], len(kind)) if len(first) else first
    _need(bool((ends - first - 1 == FOLLOWING[kind[first]]).all()), "an operation of the wrong length")
    rest = operations[:, 3] & np.uint32((1 << layout.KIND_SHIFT) - 1)
    is_gradient = (kind >= layout.KIND_LINEAR) & (kind <= layout.KIND_FOCAL)
    is_picture = kind == layout.KIND_PICTURE
    is_soft = np.flatnonzero(is_picture & (rest >= Sampling.OPACITY))
    rest[is_soft + 1] &= np.uint32(~COLOUR & 0xFFFFFFFF)
    _need(
        not rest[~is_gradient & ~is_picture].any() and not operations[kind == layout.KIND_KEEP, :3].any(),
        "a word that is not 0",
    )
    solids, mixes = operations[kind == layout.KIND_SOLID], operations[kind == layout.KIND_MIX]
    _need(not solids[:, 2].any() and not mixes[:, 2].any(), "a word that is not 0")
    halves = np.stack([solids[:, :2] & layout.PAINT_ONE, solids[:, :2] >> layout.COORDINATE_BITS], axis=2).reshape(
        -1, 4
    )
    _need(bool((halves[:, :3] <= halves[:, 3:]).all()), "a colour above its opacity")
    _need(bool((mixes[:, 0] <= layout.PAINT_ONE).all() and np.isin(mixes[:, 1], ENDS).all()), "no such group")
    opened = np.cumsum((kind == layout.KIND_KEEP).astype(np.int64) - (kind == layout.KIND_MIX))
    _need(not opened[begin + counts - 1].any(), "a group is not ended")
    _need(opened.min(initial=0) >= 0 and opened.max(initial=0) <= layout.MOST_KEPT, "too many groups in one another")
    number = np.where(is_gradient, operations[:, 3] >> layout.STOP_BITS & layout.MOST_STOPS, 0)
    total = np.append(0, np.cumsum(number, dtype=np.int64))
    _need(bool((total[begin + counts] - total[begin] <= layout.MOST_STOPS).all()), "one has too many stops")
    _check_gradients(operations, np.flatnonzero(is_gradient), kind, stops)
    _check_pictures(texels, np.flatnonzero(is_picture))


def _check_gradients(
    operations: NDArray[np.uint32], rows: NDArray[np.int64], kind: NDArray[np.int64], stops: NDArray[np.uint32]
) -> None:
    numbers = operations[(kind >= layout.KIND_LINEAR) & (kind <= layout.KIND_FOCAL) | (kind == layout.KIND_FOLLOWS), :3]
    offsets = np.ascontiguousarray(stops[:, 0]).view(np.float32)
    _need(bool(np.isfinite(np.ascontiguousarray(numbers).view(np.float32)).all()), "a number is not finite")
    focus = operations[rows[kind[rows] == layout.KIND_FOCAL] + 2]
    _need(not focus[:, 2].any() and bool((focus[:, :2] >> 31 == 0).all()), "a focal circle")
    words = operations[rows, 3].astype(np.int64)
    first = rows + (words & (1 << layout.STOP_BITS) - 1) - len(operations)
    number, spread = words >> layout.STOP_BITS & layout.MOST_STOPS, words >> SPREAD_SHIFT & 3
    _need(bool((first >= 0).all() and (number >= 1).all() and (first + number <= len(stops)).all()), "stops elsewhere")
    _need(bool((spread <= max(Spread)).all()) and not stops[:, 3].any(), "no such spread, or a word that is not 0")
    _need(bool(((offsets >= 0.0) & (offsets <= 1.0)).all()), "a stop that is not in 0..1")
    falls = np.append(0, np.cumsum(offsets[1:] < offsets[:-1])) if len(stops) else np.zeros(0, np.int64)
    _need(bool((falls[first] == falls[first + number - 1]).all()), "stops that are not in order")


def _texels_of_picture(columns: int, rows: int) -> int:
    """Number of texels of all levels of a picture; plain Python, because a check of a file must not compile kernels."""
    levels = range((max(columns, rows) - 1).bit_length() + 1)
    return sum(((columns - 1 >> level) // 2 + 1) * ((rows - 1 >> level) // 2 + 1) for level in levels)


def _check_pictures(texels: ProgramTexels, rows: NDArray[np.int64]) -> None:
    operations = texels.operations[rows].astype(np.int64)
    _need(
        bool((operations[:, 0] <= layout.PAINT_ONE).all() and (operations[:, 3] <= max(Sampling)).all()),
        "a picture's opacity or sampling",
    )
    first, columns, lines = _pictures_in(texels, rows)
    sides = np.concatenate([columns, lines])
    _need(
        bool(((sides >= 1) & (sides <= layout.MOST_PICTURE_SIDE)).all()),
        f"a picture without pixels, or more than {layout.MOST_PICTURE_SIDE} a side",
    )
    _need(bool((operations[:, 2] > 0).all() and (first >= 0).all()), "pixels elsewhere")
    are_opacities = operations[:, 3] >= Sampling.OPACITY
    pictures = np.unique(np.column_stack([first, columns, lines, are_opacities]), axis=0)
    ends = np.array([_end_of_picture(texels.pixels, *key) for key in pictures.tolist()], np.int64)
    _need(bool((ends <= len(texels.pixels)).all()), "pixels elsewhere")
    _need(bool((pictures[1:, 0] >= ends[:-1]).all()), "pictures that overlap")
    for (begin, *_, is_soft), end in zip(pictures.tolist(), ends.tolist(), strict=True):
        bad = None if is_soft else first_bad_pixel(texels.pixels[begin:end])
        _need(bad is None, f"a colour above its opacity in texel {begin + (bad or 0)} of pixels")


def _end_of_picture(pixels: NDArray[np.uint32], first: int, columns: int, rows: int, is_soft: bool) -> int:
    """Return the texel after a picture; raise a `FormatError` if its index does not fit."""
    if not is_soft:
        return first + _texels_of_picture(columns, rows)
    entries = entries_of(pixels, first, columns, rows)
    count = count_blocks(columns, rows)
    _need(len(entries) >= count and not entries[count:].any(), "an index of blocks")
    return first + len(entries) // 8 + max(int(entries.max(initial=0)) + 1 - layout.FIRST_BLOCK, 0)
