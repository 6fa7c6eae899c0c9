"""Encode a planar map as texels, and decode it (FORMAT.md, part D)."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base import layout
from vexture.base.errors import FormatError, LimitError
from vexture.texture.curves import LeafCurves, leaf_points, texels_in
from vexture.texture.map_texels import encode_map
from vexture.texture.program_texels import count_operations, stop_runs
from vexture.texture.programs import ProgramTexels, check_programs, halves, read_programs
from vexture.texture.walk import REMEDY, WalkLevel, walk
from vexture.tree.planar.map import PlanarMap


def map_texels(planar: PlanarMap, at: int) -> NDArray[np.uint32]:
    """Encode a map as texels (n, 4), in the order of `PARTS`; `at` is the index of the first texel."""
    texels: NDArray[np.uint32] = encode_map(planar.arrays, at)
    if len(texels) == 0:
        count = count_operations(planar.table, planar.shades) + stop_runs(planar.table, planar.shades).texels
        most = (1 << layout.STOP_BITS) - 1
        raise LimitError(f"a map: {count} texels of gradients; the limit is {most}; divide it")
    return texels


def _before(count: NDArray[np.int64]) -> NDArray[np.int64]:
    """Exclusive cumulative sum: for each element, the sum of the elements before it."""
    before: NDArray[np.int64] = np.cumsum(count) - count
    return before


def _number(paints: int) -> np.dtype[np.unsignedinteger]:
    """Data type of a paint number in a map with `paints` paints."""
    if paints > layout.MOST_HALF_PAINTS:
        return np.dtype("<u4")
    return np.dtype("<u1" if paints <= layout.MOST_BYTE_PAINTS else "<u2")


def quads_in_block(paints: int) -> int:
    """Number of quads whose base paints fit in one texel of a map with `paints` paints."""
    return sides_in_texel(paints) // 2


def sides_in_texel(paints: int) -> int:
    """Number of curves whose left and right paints fit in one texel of a map with `paints` paints."""
    return np.dtype("4<u4").itemsize // (2 * _number(paints).itemsize)


class MapHead(NamedTuple):
    """Head of a planar map (FORMAT.md, D.1)."""

    used: int  # number of paints
    cells: int
    sides: int
    paints: int

    @property
    def paint_texels(self) -> slice:
        """Position of the paints in the texels."""
        return slice(self.paints, self.paints + (self.used + 1) // 2)


def head_of(flat: NDArray[np.uint32], quad: int) -> MapHead:
    """Read the head of the map with root quad `quad`, without checks."""
    return MapHead(*flat[quad - 1].tolist())


def holds_pictures(flat: NDArray[np.uint32], quad: int) -> bool:
    """Whether the head of an unchecked map says that there are texels of pixels."""
    return layout.MAP_HEAD <= quad <= len(flat) and bool(flat[quad - layout.MAP_HEAD, 3])


PARTS: Final = ("head", "quads", "curves", "cells", "sides", "paints", "programs")


class MapTexels(NamedTuple):
    """Positions and checked content of the texels of a planar map."""

    levels: list[WalkLevel]
    quad: int
    first_curve: int
    curves: int  # number of texels of curves
    points: NDArray[np.int32]  # (curves, 4, 2): control points, in the order of the levels
    texels: NDArray[np.int64]  # (curves,): index of each curve's texel
    cells: int
    sides: int
    paints: int
    used: int  # number of paints
    programs: int
    operations: int  # number of texels of programs; those of stops follow
    stops: int
    pixels: int  # those of pictures, after the stops

    @property
    def ranges(self) -> list[tuple[int, int]]:
        """Half-open range of the texels of each part."""
        quads = sum(len(level.quads) for level in self.levels)
        return [
            (self.quad - layout.MAP_HEAD, self.quad),
            (self.quad, self.quad + quads),
            (self.first_curve, self.first_curve + self.curves),
            (self.cells, self.cells + quads + -(-quads // quads_in_block(self.used))),
            (self.sides, self.sides + -(-len(self.points) // sides_in_texel(self.used))),
            (self.paints, self.paints + (self.used + 1) // 2),
            (self.programs, self.programs + self.operations + self.stops + self.pixels),
        ]


def read_map(flat: NDArray[np.uint32], quad: int) -> MapTexels:
    """Read the planar map with root quad `quad`; raise a `FormatError` where it contradicts FORMAT.md."""
    levels = walk(flat, np.array([quad]), of_maps=True)
    if quad < layout.MAP_HEAD:
        raise FormatError(f"the root of a map is quad {quad}, which has no head before it; {REMEDY}")
    used, cells, sides, paints = head_of(flat, quad)
    programs, operations, stops, pixels = flat[quad - layout.MAP_HEAD].tolist()
    if operations == 0 and programs + stops + pixels:
        raise FormatError(f"the map with root {quad} has a head that is not 0 where it must be; {REMEDY}")
    if not 1 <= used <= layout.MOST_PAINTS:
        raise FormatError(f"the map with root {quad} has {used} paints; the limit is {layout.MOST_PAINTS}; {REMEDY}")
    quads = np.concatenate([level.quads for level in levels])
    curves = np.concatenate([level.curves for level in levels])
    for what, listed in (("quads", quads), ("curves", curves)):
        if len(listed) and np.ptp(listed) + 1 != len(listed):
            raise FormatError(f"the {what} of the map with root {quad} are not consecutive; {REMEDY}")
    first_curve = int(curves.min()) if len(curves) else 0
    points, at = _curves(flat, levels, curves)
    parts = (cells, sides, paints, used, programs, operations, stops, pixels)
    found = MapTexels(levels, quad, first_curve, len(curves), points, at, *parts)
    count = np.concatenate([level.counts for level in levels]).sum(axis=1)
    order = np.argsort(quads)
    if (flat[quads[order], 3] != _before(count[order])).any() or (points[:, 0, 1] > points[:, 3, 1]).any():
        raise FormatError(f"the map with root {quad} has curves out of number or a curve that goes down; {REMEDY}")
    for what, (_, stop) in zip(PARTS, found.ranges, strict=True):
        if stop > len(flat):
            raise FormatError(f"the {what} of the map with root {quad} end at texel {stop} of {len(flat)}; {REMEDY}")
    last = max(int(_bases(flat, found).max()), int(_sides(flat, found).max(initial=0)))
    if last >= used:
        raise FormatError(f"the map with root {quad} has paint {last} of {used}; {REMEDY}")
    check_programs(*_programs(flat, found))
    table, means = _paints(flat, found), _means(flat, found)
    if (table[:, :3] > table[:, 3:]).any() or (means[..., :3] > means[..., 3:]).any():
        raise FormatError(f"the map with root {quad} has a colour above its opacity; {REMEDY}")
    return found


def _curves(
    flat: NDArray[np.uint32], levels: list[WalkLevel], texels: NDArray[np.int64]
) -> tuple[NDArray[np.int32], NDArray[np.int64]]:
    """Curves of a map, (curves, 4, 2), and the texel of each; like `texels`, they are in the order of the levels."""
    count = np.concatenate([level.counts.ravel() for level in levels])
    straight = np.concatenate([level.windings.ravel() & layout.STRAIGHT > 0 for level in levels])
    at = LeafCurves.of_counts(count, straight)
    points = leaf_points(flat[texels], at)
    alone = np.cumsum(texels_in(count, straight))[straight & (count % 2 == 1)] - 1
    if flat[texels[alone], 2:].any():
        raise FormatError(f"texel {texels[alone][0]} or another of one curve has a second one; {REMEDY}")
    return points, texels[at.texel]


def _parts(flat: NDArray[np.uint32], found: MapTexels, part: int) -> NDArray[np.uint32]:
    start, stop = found.ranges[part]
    return flat[start:stop]


def _blocks(flat: NDArray[np.uint32], found: MapTexels) -> NDArray[np.uint32]:
    """Texels of cells, (blocks, 1 + quads, 4); the last block is filled with zeros."""
    texels, size = _parts(flat, found, 3), 1 + quads_in_block(found.used)
    blocks = np.zeros((-(-len(texels) // size), size, 4), np.uint32)
    blocks.reshape(-1, 4)[: len(texels)] = texels
    return blocks


def _bases(flat: NDArray[np.uint32], found: MapTexels) -> NDArray[np.int64]:
    """Base paint of each cell, (quads, 4); 0 for a cell without one."""
    blocks, number = _blocks(flat, found)[:, 0], _number(found.used)
    bases = np.ascontiguousarray(blocks).astype("<u4").view(number).reshape(-1, 4).astype(np.int64)
    quads = np.concatenate([level.quads for level in found.levels]) - found.quad
    none = np.concatenate([level.is_quad | (level.windings == layout.IS_MEAN) for level in found.levels])
    if (bases[quads][none] != 0).any():
        raise FormatError(f"a cell without a base paint has one; {REMEDY}")
    return bases[: len(quads)]


def _means(flat: NDArray[np.uint32], found: MapTexels) -> NDArray[np.int64]:
    """Mean colour of each cell, (quads, 4, 4), 0..255."""
    shift = np.arange(4) * layout.CELL_BITS
    words = _blocks(flat, found)[:, 1:].reshape(-1, 4)[: sum(len(level.quads) for level in found.levels)]
    means: NDArray[np.int64] = words.astype(np.int64)[:, :, None] >> shift & layout.COVERAGE_ONE
    return means


def _sides(flat: NDArray[np.uint32], found: MapTexels) -> NDArray[np.int64]:
    """Paints on the left and right of each curve, (curves, 2)."""
    numbers = _parts(flat, found, 4).astype("<u4").view(_number(found.used)).reshape(-1, 2)
    return numbers[: len(found.points)].astype(np.int64)


def paints_from(texels: NDArray[np.uint32], used: int) -> NDArray[np.uint16]:
    """Decode paints (used, 4) from their texels; none of them is a program."""
    return halves(texels.reshape(-1, 2)[:used]).astype(np.uint16)


def _paint_words(flat: NDArray[np.uint32], found: MapTexels) -> tuple[NDArray[np.uint32], NDArray[np.bool_]]:
    """Words of each paint, (paints, 2), and whether it is a program: opacity 0, but a first word that is not 0."""
    words = _parts(flat, found, 5).reshape(-1, 2)[: found.used]
    return words, (words[:, 0] != 0) & (words[:, 1] >> layout.COORDINATE_BITS == 0)


def _paints(flat: NDArray[np.uint32], found: MapTexels) -> NDArray[np.uint16]:
    """Paints, (paints, 4); 0 for programs."""
    words, is_program = _paint_words(flat, found)
    return np.where(is_program[:, None], 0, halves(words)).astype(np.uint16)


def _programs(flat: NDArray[np.uint32], found: MapTexels) -> tuple[ProgramTexels, dict[int, tuple[int, int]]]:
    """Texels of programs, and the first one and the number of those of each paint that is a program."""
    words, is_program = _paint_words(flat, found)
    starts = {int(j): (int(words[j, 0]) - found.programs, int(words[j, 1])) for j in np.flatnonzero(is_program)}
    texels, stops = _parts(flat, found, 6), found.operations + found.stops
    return ProgramTexels(texels[: found.operations], texels[found.operations : stops], texels[stops:]), starts


def decode_map(flat: NDArray[np.uint32], quad: int) -> PlanarMap:
    """Decode the planar map with root quad `quad`, in the order of `PlanarMap`; its means are rounded to 8 bits."""
    found = read_map(flat, quad)
    levels = found.levels
    quads = np.concatenate([level.quads for level in levels])
    is_quad = np.concatenate([level.is_quad for level in levels])
    count = np.concatenate([level.counts for level in levels])
    quads_in, curves_in = is_quad.sum(axis=1), count.sum(axis=1)
    first = _before(curves_in)
    number = np.arange(len(found.points)) + np.repeat(flat[quads, 3] - first, curves_in)
    return PlanarMap(
        is_quad,
        np.concatenate([level.windings == layout.IS_MEAN for level in levels]),
        count.astype(np.uint8),
        _bases(flat, found)[quads - found.quad].astype(np.int32),
        np.where(quads_in > 0, 1 + np.cumsum(quads_in) - quads_in, 0).astype(np.int32),
        np.where(curves_in > 0, first, 0).astype(np.int32),
        _means(flat, found)[quads - found.quad] / layout.COVERAGE_ONE,
        found.points,
        _sides(flat, found)[number].astype(np.int32),
        _paints(flat, found),
        *read_programs(*_programs(flat, found)),
        np.zeros(1, np.int64),
        np.zeros(0, np.int32),
    )
