"""The planar map, as arrays."""

from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import PAINT_ONE
from vexture.bezier.split import copy_curve
from vexture.tree.growth import COUNT, CURVES, IS_QUAD, QUADS, number_quads
from vexture.tree.planar.faces import FaceTable
from vexture.tree.planar.growth import BASE, IS_MEAN, PlanarGrowth
from vexture.tree.planar.layers import PlanarLayers
from vexture.tree.planar.programs import Program, ProgramTable, list_programs, programs_of
from vexture.tree.planar.shades import Shades


@kernel(ahead=True)
def texels_of(quads: int, curves: int) -> int:
    """Texels of quads, at 3 each, and of curves, at 5/4 each, without the paints."""
    return 3 * quads + curves + curves // 4


class MapArrays(NamedTuple):
    """The part of a planar map that is encoded: the first fields of `PlanarMap`."""

    is_quad: NDArray[np.bool_]
    is_mean: NDArray[np.bool_]
    pieces: NDArray[np.uint8]  # `count`
    base: NDArray[np.int32]
    first_quad: NDArray[np.int32]
    first_curve: NDArray[np.int32]
    mean: NDArray[np.float64]
    curves: NDArray[np.int32]
    sides: NDArray[np.int32]
    paints: NDArray[np.uint16]
    table: ProgramTable
    shades: Shades


@dataclass(frozen=True, slots=True, eq=False)
class PlanarMap:
    """A quad-tree whose leaves hold monotone pieces between faces of different paint.

    Quads, cells and curves are numbered as in a `Tree`. All pieces go up. The colour at a point of a leaf is that of
    the base paint, plus (left paint - right paint) for each end of a piece on the leaf's left edge at or below the
    point, positive at a start and negative at an end, minus the same for each piece left of the point.
    """

    is_quad: NDArray[np.bool_]  # (quads, 4): whether a cell is divided
    is_mean: NDArray[np.bool_]  # (quads, 4): leaves of cells that hold more than can be stored, which have only a mean
    count: NDArray[np.uint8]  # (quads, 4): pieces in each leaf
    base: NDArray[np.int32]  # (quads, 4): base paint of each leaf; 0 elsewhere
    first_quad: NDArray[np.int32]  # (quads,): first of the quads below each quad; 0 without any
    first_curve: NDArray[np.int32]  # (quads,): first curve of its leaves; 0 without any
    mean: NDArray[np.float64]  # (quads, 4, 4): exact mean colour of each cell, premultiplied
    curves: NDArray[np.int32]  # (curves, 4, 2), in lattice units of their leaf
    sides: NDArray[np.int32]  # (curves, 2): paint on the left and on the right of each
    paints: NDArray[np.uint16]  # (paints, 4): premultiplied, in steps of 1/65535; 0 for paint 0, nothing, and programs
    table: ProgramTable  # programs of the paints that hold gradients or pictures
    shades: Shades  # their gradients and pictures
    starts: NDArray[np.int64]  # (paints + 1,): where the stack of each paint begins in `members`
    members: NDArray[np.int32]  # stacks: paths inside, from below, where each paint was met first
    flattened: int = (
        0  # paints that are mean colours, because no program can hold their gradients, pictures or blending
    )
    deviation: float = 0.0  # largest distance between the drawing's outlines and the map's, before quantisation
    hiding: frozenset[int] = frozenset()  # paths that hide something, which the map therefore lacks

    @property
    def arrays(self) -> MapArrays:
        """The part that is encoded."""
        firsts = self.first_quad, self.first_curve
        cells = self.is_quad, self.is_mean, self.count, self.base, *firsts, self.mean
        return MapArrays(*cells, self.curves, self.sides, self.paints, self.table, self.shades)

    @property
    def programs(self) -> dict[int, Program]:
        """Programs of the paints that hold gradients or pictures, by the paints' numbers."""
        return list_programs(self.table, self.shades)

    @property
    def stacks(self) -> tuple[NDArray[np.int32], ...]:
        """Paths inside, from below, where each paint was met first."""
        return tuple(self.members[start:end] for start, end in pairwise(self.starts.tolist()))

    @property
    def coverage(self) -> NDArray[np.float64]:
        """Mean opacity of each cell, (quads, 4)."""
        return self.mean[..., 3]

    @property
    def texels(self) -> int:
        """Texels that the map takes in a texture, approximately, without gradients and pictures."""
        return texels_of(len(self.count), len(self.curves)) + len(self.paints) // 2

    @property
    def unresolved(self) -> int:
        """Number of cells at the depth limit that have only a mean."""
        return int(self.is_mean.sum())


@kernel(ahead=True)
def arrange_map(
    growth: PlanarGrowth, layers: PlanarLayers, faces: FaceTable
) -> tuple[MapArrays, NDArray[np.int64], NDArray[np.int32], int]:
    """Arrays of a map whose cells are all done, with quads numbered level by level, and paints as they were met.

    Also returns the stacks of the paints and the number of flattened paints, as in `PlanarMap`.
    """
    cells, quads, curves = growth.tree.cells, growth.tree.counts[QUADS], growth.tree.counts[CURVES]
    order = number_quads(cells, growth.tree.first, quads)
    number, used = _number_paints(growth, faces)
    is_quad, is_mean = np.empty((quads, 4), np.bool_), np.empty((quads, 4), np.bool_)
    count, base, mean = np.empty((quads, 4), np.uint8), np.zeros((quads, 4), np.int32), np.empty((quads, 4, 4))
    first_quad, first_curve = np.zeros(quads, np.int32), np.zeros(quads, np.int32)
    outlines, sides = np.empty((curves, 4, 2), np.int32), np.empty((curves, 2), np.int32)
    quad, curve = 1, 0
    for i in range(quads):
        below, pieces, first = 0, 0, growth.tree.first[order[i], 1]
        for k in range(4):
            cell = cells[order[i], k]
            is_quad[i, k], is_mean[i, k], count[i, k] = cell[IS_QUAD] == 1.0, cell[IS_MEAN] == 1.0, int(cell[COUNT])
            if not is_quad[i, k] and not is_mean[i, k]:
                base[i, k] = number[int(cell[BASE])]
            for c in range(4):
                mean[i, k, c] = growth.mean[order[i], k, c]
            below, pieces = below + int(cell[IS_QUAD]), pieces + int(cell[COUNT])
        # 0 compresses better where there is none
        first_quad[i], first_curve[i] = quad if below > 0 else 0, curve if pieces > 0 else 0
        for k in range(pieces):
            copy_curve(growth.tree.curves[first + k], outlines[curve + k])
            for side in range(2):
                sides[curve + k, side] = number[growth.sides[first + k, side]]
        quad, curve = quad + below, curve + pieces
    paints, starts, members = _paints_of(faces, number, used)
    table, flattened = programs_of(layers, starts, members)
    parts = (is_quad, is_mean, count, base, first_quad, first_curve, mean, outlines, sides, paints)
    return MapArrays(*parts, table, layers.shades), starts, members, flattened


@kernel
def _number_paints(growth: PlanarGrowth, faces: FaceTable) -> tuple[NDArray[np.int64], int]:
    """Number of each face's paint, which is -1 if it is not used, and the number of used paints; paint 0 always is."""
    number, used = np.full(faces.counts[0], -1), 1
    number[0] = 0
    for quad in range(growth.tree.counts[QUADS]):
        for k in range(4):
            cell = growth.tree.cells[quad, k]
            if cell[IS_QUAD] == 0.0 and cell[IS_MEAN] == 0.0:
                number[int(cell[BASE])] = 0
    for curve in range(growth.tree.counts[CURVES]):
        number[growth.sides[curve, 0]] = number[growth.sides[curve, 1]] = 0
    for face in range(1, len(number)):
        if number[face] == 0:
            number[face] = used
            used += 1
    return number, used


@kernel
def _paints_of(
    faces: FaceTable, number: NDArray[np.int64], used: int
) -> tuple[NDArray[np.uint16], NDArray[np.int64], NDArray[np.int32]]:
    """Colours of the used paints, and their stacks."""
    paints, starts, end = np.zeros((used, 4), np.uint16), np.zeros(used + 1, np.int64), 0
    for face in range(len(number)):
        if number[face] >= 0:
            end += faces.starts[face + 1] - faces.starts[face]
            starts[number[face] + 1] = end
    members = np.empty(end, np.int32)
    for face in range(len(number)):
        paint = number[face]
        if paint >= 0:
            for c in range(4):
                paints[paint, c] = int(np.rint(PAINT_ONE * min(max(faces.rgba[face, c], 0.0), 1.0)))
            for k in range(starts[paint + 1] - starts[paint]):
                members[starts[paint] + k] = faces.paths[faces.starts[face] + k]
    return paints, starts, members


def map_arrays_from(values: Any) -> MapArrays:
    """Make `MapArrays` from the plain tuples that code compiled ahead of time returns."""
    return MapArrays(*(*values[:-2], ProgramTable(*values[-2]), Shades(*values[-1])))
