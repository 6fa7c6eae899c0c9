"""Encode the programs of a planar map as texels, and decode them (FORMAT.md, D.6)."""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base import layout
from vexture.base.errors import FormatError, LimitError
from vexture.drawing.group import Blend, Mask
from vexture.drawing.paint import Gradient, Spread, Stop
from vexture.texture.walk import REMEDY
from vexture.tree.planar.programs import Keep, Mix, Operation, Program, Solid, ending_of, number_of_ending

ENDS: Final = [*map(number_of_ending, Blend), *(number_of_ending(mask) for mask in Mask if mask)]
"""Numbers of the allowed endings of a group."""

FOLLOWING: Final = np.array([0, 0, 0, 1, 2, 0, 0, 0])
"""Number of texels of the kind `FOLLOWS` after the first texel of an operation, by its kind."""

STOP_BYTES: Final = 16
"""Size of the texel of a stop."""

SPREAD_SHIFT: Final = layout.STOP_BITS + layout.STOP_COUNT_BITS


class ProgramTexels(NamedTuple):
    """The texels of a map's programs."""

    operations: NDArray[np.uint32]  # (n, 4)
    stops: NDArray[np.uint32]  # (m, 4): they follow the operations
    starts: dict[int, tuple[int, int]]  # for each paint that is a program: its first operation texel and their number


NO_PROGRAMS: Final = ProgramTexels(np.zeros((0, 4), np.uint32), np.zeros((0, 4), np.uint32), {})


def halves(words: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """Red, green, blue and opacity, (n, 4), in steps of 1/65535, from two words each, (n, 2)."""
    both = np.stack([words & layout.PAINT_ONE, words >> layout.COORDINATE_BITS], axis=2)
    return both.reshape(-1, 4)


def program_texels(programs: dict[int, Program], name: str = "a map") -> ProgramTexels:
    """Encode programs as texels; gradients with equal stops share them."""
    rows: list[list[int]] = []
    runs: dict[bytes, int] = {}
    of_row: dict[int, bytes] = {}
    starts = {}
    for paint, program in programs.items():
        start = len(rows)
        for operation in program:
            if isinstance(operation, Gradient):
                of_row[len(rows)] = _stop_texels(operation.stops).tobytes()
            rows += _rows(operation)
        starts[paint] = start, len(rows) - start
    after = len(rows)
    for run in dict.fromkeys(of_row.values()):
        runs[run], after = after, after + len(run) // STOP_BYTES
    if after >> layout.STOP_BITS:
        raise LimitError(f"{name}: {after} texels of gradients; the limit is {(1 << layout.STOP_BITS) - 1}; divide it")
    for row, run in of_row.items():
        rows[row][3] |= runs[run] - row
    stops = np.frombuffer(b"".join(runs), np.uint32).reshape(-1, 4)
    return ProgramTexels(np.array(rows, np.uint32).reshape(-1, 4), stops, starts)


def _rows(operation: Operation) -> list[list[int]]:
    """Texels of an operation, without the position of its stops."""
    if isinstance(operation, Keep):
        return [[0, 0, 0, layout.KIND_KEEP << layout.KIND_SHIFT]]
    if isinstance(operation, Mix):
        return [[operation.opacity, number_of_ending(operation.how), 0, layout.KIND_MIX << layout.KIND_SHIFT]]
    if isinstance(operation, Solid):
        red, green, blue, alpha = operation.rgba
        word, other = red | green << layout.COORDINATE_BITS, blue | alpha << layout.COORDINATE_BITS
        return [[word, other, 0, layout.KIND_SOLID << layout.KIND_SHIFT]]
    across, up = (np.array(row, np.float32).view(np.uint32).tolist() for row in operation.to_ramp)
    focus, follows = operation.focus, layout.KIND_FOLLOWS << layout.KIND_SHIFT
    kind = layout.KIND_LINEAR if focus is None else layout.KIND_RADIAL if focus == (0.0, 0.0) else layout.KIND_FOCAL
    word = kind << layout.KIND_SHIFT | operation.spread << SPREAD_SHIFT | len(operation.stops) << layout.STOP_BITS
    rows = [[*across, word], [*up, follows]]
    rows += [[*np.array(focus, np.float32).view(np.uint32).tolist(), 0, follows]] if kind == layout.KIND_FOCAL else []
    return rows[: 1 + FOLLOWING[kind]]


def _stop_texels(stops: Sequence[Stop]) -> NDArray[np.uint32]:
    texels = np.zeros((len(stops), 4), np.uint32)
    texels[:, 0] = np.array([stop.offset for stop in stops], np.float32).view(np.uint32)
    colours = np.array([(*stop.color, stop.opacity) for stop in stops]).reshape(-1, 4)
    whole = np.rint(layout.PAINT_ONE * colours).astype(np.uint32)
    texels[:, 1:3] = whole[:, 0::2] | whole[:, 1::2] << layout.COORDINATE_BITS
    return texels


def read_programs(
    operations: NDArray[np.uint32], stops: NDArray[np.uint32], starts: dict[int, tuple[int, int]]
) -> dict[int, Program]:
    """Decode the programs of paints from the parts of `ProgramTexels`; raise a `FormatError` for invalid texels."""
    _check(operations, stops, np.array([*starts.values()], np.int64).reshape(-1, 2))
    listed = _stops(stops)
    return {
        paint: tuple(
            _operation(operations, row, listed)
            for row in range(start, start + count)
            if operations[row, 3] >> layout.KIND_SHIFT != layout.KIND_FOLLOWS
        )
        for paint, (start, count) in starts.items()
    }


def _need(holds: bool, message: str) -> None:
    if not holds:
        raise FormatError(f"a map's programs: {message}; {REMEDY}")


def _check(operations: NDArray[np.uint32], stops: NDArray[np.uint32], starts: NDArray[np.int64]) -> None:
    """Raise a `FormatError` unless the programs conform to FORMAT.md."""
    begin, counts = starts.T
    _need(bool((begin == np.cumsum(counts) - counts).all()) and counts.sum() == len(operations), "they leave gaps")
    _need(counts.min(initial=1) >= 1 and counts.max(initial=1) <= layout.MOST_PROGRAM, "one is empty or too long")
    kind = (operations[:, 3] >> layout.KIND_SHIFT).astype(np.int64)
    first = np.flatnonzero(kind != layout.KIND_FOLLOWS)
    _need(bool((kind != 0).all() and np.isin(begin, first).all()), "an unknown operation, or half of one")
    ends = np.append(first[1:], len(kind)) if len(first) else first
    _need(bool((ends - first - 1 == FOLLOWING[kind[first]]).all()), "an operation of the wrong length")
    rest = operations[:, 3] & np.uint32((1 << layout.KIND_SHIFT) - 1)
    is_gradient = (kind >= layout.KIND_LINEAR) & (kind <= layout.KIND_FOCAL)
    _need(not rest[~is_gradient].any() and not operations[kind == layout.KIND_KEEP, :3].any(), "a word that is not 0")
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


def _stops(stops: NDArray[np.uint32]) -> list[Stop]:
    offsets = np.ascontiguousarray(stops[:, 0]).view(np.float32).tolist()
    halves = np.stack([stops[:, 1:3] & layout.PAINT_ONE, stops[:, 1:3] >> layout.COORDINATE_BITS], axis=2).reshape(
        -1, 4
    )
    colours = (halves / layout.PAINT_ONE).tolist()
    return [Stop(offset, (r, g, b), a) for offset, (r, g, b, a) in zip(offsets, colours, strict=True)]


def _operation(operations: NDArray[np.uint32], row: int, stops: list[Stop]) -> Operation:
    """Decode the operation at a row of checked texels."""
    words, kind = operations[row].tolist(), int(operations[row, 3] >> layout.KIND_SHIFT)
    if kind == layout.KIND_KEEP:
        return Keep()
    if kind == layout.KIND_MIX:
        return Mix(words[0], ending_of(words[1]))
    if kind == layout.KIND_SOLID:
        red, green, blue, alpha = (word >> shift & layout.PAINT_ONE for word in words[:2] for shift in (0, 16))
        return Solid((red, green, blue, alpha))
    floats = operations[row : row + 3].view(np.float32).tolist()
    linear = kind == layout.KIND_LINEAR
    across, up = floats[0][:3], [0.0, 0.0, 0.0] if linear else floats[1][:3]
    focus = None if linear else (floats[2][0], floats[2][1]) if kind == layout.KIND_FOCAL else (0.0, 0.0)
    first = row + (words[3] & (1 << layout.STOP_BITS) - 1) - len(operations)
    number = words[3] >> layout.STOP_BITS & layout.MOST_STOPS
    spread = Spread(words[3] >> SPREAD_SHIFT & 3)
    rows = (across[0], across[1], across[2]), (up[0], up[1], up[2])
    return Gradient(rows, tuple(stops[first : first + number]), spread, focus)
