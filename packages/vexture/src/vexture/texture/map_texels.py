"""The texels of a planar map, in one kernel (FORMAT.md, part D)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import (
    CELL_BITS,
    COORDINATE_BITS,
    COUNT_SHIFT,
    COVERAGE_ONE,
    HOLDS_PROGRAM,
    IS_MEAN,
    MAP_HEAD,
    MOST_BYTE_PAINTS,
    MOST_HALF_PAINTS,
    QUAD_FLAG,
    STRAIGHT,
)
from vexture.texture.curves import NEAR, write_curve
from vexture.texture.program_texels import StopRuns, count_operations, stop_runs, write_programs
from vexture.tree.planar.map import MapArrays


class _Places(NamedTuple):
    """Index of the first texel of each part."""

    quads: int
    curves: int
    cells: int
    sides: int
    paints: int
    operations: int
    end: int


@kernel(ahead=True)
def encode_map(planar: MapArrays, first: int) -> NDArray[np.uint32]:
    """Texels of a map, of which `first` is the index of the first one; none if its programs are too large."""
    straight, curves = _straight_leaves(planar)
    runs = stop_runs(planar.table, planar.shades)
    operations = count_operations(planar.table, planar.shades)
    at = _places(planar, curves, operations, runs, first)
    if runs.fit == 0:
        return np.zeros((0, 4), np.uint32)
    texels = np.zeros((at.end - first, 4), np.uint32)
    if len(planar.table.code) > 0:
        texels[0, 0], texels[0, 1], texels[0, 2], texels[0, 3] = at.operations, operations, runs.texels, runs.pixels
    texels[1, 0], texels[1, 1], texels[1, 2], texels[1, 3] = len(planar.paints), at.cells, at.sides, at.paints
    _write_quads(planar, straight, at, texels[MAP_HEAD:])
    _write_curves(planar, straight, texels[at.curves - first :])
    _write_cells(planar, texels[at.cells - first :])
    packing = packing_of_paints(len(planar.paints))
    for k in range(len(planar.sides)):
        for side in range(2):
            _write_number(texels[at.sides - first :], 2 * k + side, packing, planar.sides[k, side])
    write_paints(planar.paints, texels[at.paints - first :])
    write_programs(planar.table, planar.shades, runs, at.operations, texels[at.paints - first :])
    return texels


@kernel(allocates=False)
def packing_of_paints(paints: int) -> int:
    """Binary logarithm of the count of paint numbers in a word of a map with so many paints: 2, 1 or 0."""
    return (1 if paints <= MOST_HALF_PAINTS else 0) + (1 if paints <= MOST_BYTE_PAINTS else 0)


@kernel(allocates=False)
def _places(planar: MapArrays, curves: int, operations: int, runs: StopRuns, first: int) -> _Places:
    """Places of all parts, in the order of `PARTS`, for a map that begins at texel `first`."""
    quads, packing = len(planar.pieces), packing_of_paints(len(planar.paints))
    at_curves = first + MAP_HEAD + quads
    at_cells = at_curves + curves
    at_sides = at_cells + quads + (quads + (1 << packing) - 1 >> packing)
    at_paints = at_sides + (len(planar.sides) + (2 << packing) - 1 >> packing + 1)
    at_operations = at_paints + (len(planar.paints) + 1 >> 1)
    places = (at_curves, at_cells, at_sides, at_paints, at_operations)
    return _Places(first + MAP_HEAD, *places, at_operations + operations + runs.texels + runs.pixels)


@kernel
def _straight_leaves(planar: MapArrays) -> tuple[NDArray[np.bool_], int]:
    """Return which leaves have curves that are all straight, (quads, 4), and the number of texels of all curves."""
    straight, curve, texels = np.zeros(planar.pieces.shape, np.bool_), 0, 0
    for quad in range(len(straight)):
        for k in range(4):
            count = int(np.int64(planar.pieces[quad, k]))
            straight[quad, k] = is_straight_leaf(planar.curves, curve, count)
            texels += (count + 1) >> 1 if straight[quad, k] else count
            curve += count
    return straight, texels


@kernel(allocates=False)
def is_straight_leaf(curves: NDArray[np.int32], first: int, count: int) -> bool:
    """Whether a leaf has curves and all of them are straight, except for rounding."""
    for i in range(first, first + count):
        for axis in range(2):
            a, b = int(np.int64(curves[i, 0, axis])), int(np.int64(curves[i, 3, axis]))
            if abs(curves[i, 1, axis] - (2 * a + b + 1) // 3) > NEAR:
                return False
            if abs(curves[i, 2, axis] - (a + 2 * b + 1) // 3) > NEAR:
                return False
    return count > 0


@kernel
def _write_quads(planar: MapArrays, straight: NDArray[np.bool_], at: _Places, out: NDArray[np.uint32]) -> None:
    """Write the quads."""
    is_program = np.zeros(len(planar.paints), np.bool_)
    for k in range(len(planar.table.paint)):
        is_program[planar.table.paint[k]] = True
    curve, texel = 0, at.curves
    for quad in range(len(planar.pieces)):
        word, begin = 0, curve
        out[quad, 0], out[quad, 1] = at.quads + planar.first_quad[quad], texel
        for k in range(4):
            count = int(np.int64(planar.pieces[quad, k]))
            byte = count << COUNT_SHIFT
            if straight[quad, k]:
                byte += STRAIGHT
            holds_program = is_program[planar.base[quad, k]]
            for i in range(curve, curve + count):
                holds_program = holds_program or is_program[planar.sides[i, 0]] or is_program[planar.sides[i, 1]]
            if holds_program:
                byte += HOLDS_PROGRAM
            byte = QUAD_FLAG if planar.is_quad[quad, k] else IS_MEAN if planar.is_mean[quad, k] else byte
            word |= byte << CELL_BITS * k
            texel += (count + 1) >> 1 if straight[quad, k] else count
            curve += count
        out[quad, 2], out[quad, 3] = word, begin


@kernel(allocates=False)
def _write_curves(planar: MapArrays, straight: NDArray[np.bool_], out: NDArray[np.uint32]) -> None:
    """Write the curves of all leaves; `out` begins at the first."""
    curve, texel = 0, 0
    for quad in range(len(planar.pieces)):
        for k in range(4):
            count = int(np.int64(planar.pieces[quad, k]))
            texel += write_leaf(planar.curves, curve, count, straight[quad, k], out[texel:])
            curve += count


@kernel(allocates=False)
def write_leaf(curves: NDArray[np.int32], first: int, count: int, is_straight: bool, out: NDArray[np.uint32]) -> int:
    """Write the curves of a leaf, two in a texel if all are straight; return the number of texels."""
    if not is_straight:
        for i in range(count):
            write_curve(curves[first + i], out[i])
        return count
    for i in range(count):
        for end in range(2):
            x, y = int(np.int64(curves[first + i, 3 * end, 0])), int(np.int64(curves[first + i, 3 * end, 1]))
            out[i >> 1, 2 * (i & 1) + end] = x | y << COORDINATE_BITS
    return (count + 1) >> 1


@kernel(allocates=False)
def _write_cells(planar: MapArrays, out: NDArray[np.uint32]) -> None:
    """Write cells in blocks of quads: a texel with all base paints, then for each quad a texel with its means."""
    packing = packing_of_paints(len(planar.paints))
    for quad in range(len(planar.pieces)):
        block = quad >> packing
        bases = (block << packing) + block
        for k in range(4):
            number = 4 * (quad - (block << packing)) + k
            _write_number(out, (bases << 2 + packing) + number, packing, planar.base[quad, k])
            mean, word = planar.mean[quad, k], 0
            alpha = int(np.rint(min(max(mean[3], 0.0), 1.0) * COVERAGE_ONE))
            for c in range(4):
                part = int(np.rint(min(max(mean[c], 0.0), 1.0) * COVERAGE_ONE))
                # rounding in the sums of areas could lift a colour above its opacity
                word |= min(part, alpha) << CELL_BITS * c
            out[1 + quad + block, k] = word


@kernel(allocates=False)
def _write_number(texels: NDArray[np.uint32], place: int, packing: int, number: int) -> None:
    """Add a paint number to texels that are 0 there; places count numbers from the first texel on."""
    word = place >> packing
    shift = (place & (1 << packing) - 1) * (32 >> packing)
    texels[word >> 2, word & 3] |= np.uint32(number << shift)


@kernel(allocates=False)
def write_paints(paints: NDArray[np.uint16], out: NDArray[np.uint32]) -> None:
    """Write paints (n, 4), two in a texel, each as red and green, blue and opacity."""
    for paint in range(len(paints)):
        for half in range(2):
            low, high = int(np.int64(paints[paint, 2 * half])), int(np.int64(paints[paint, 2 * half + 1]))
            out[paint >> 1, 2 * (paint & 1) + half] = low | high << COORDINATE_BITS
