"""The planar map, as arrays."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vexture.tree.planar.programs import Program


def texels_of(quads: int, curves: int) -> int:
    """Texels of quads, at 3 each, and of curves, at 5/4 each, without the paints."""
    return 3 * quads + curves + curves // 4


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
    programs: dict[int, Program]  # programs of the paints that hold gradients, by the paints' numbers
    stacks: tuple[NDArray[np.int32], ...]  # paths inside, from below, where each paint was met first
    flattened: int  # paints that are mean colours, because no program can hold their gradients or the blending
    deviation: float  # largest distance between the drawing's outlines and the map's, before quantisation
    hiding: frozenset[int] = frozenset()  # paths that hide something, which the map therefore lacks

    @property
    def coverage(self) -> NDArray[np.float64]:
        """Mean opacity of each cell, (quads, 4)."""
        return self.mean[..., 3]

    @property
    def texels(self) -> int:
        """Texels that the map takes in a texture, approximately, because lists are rounded up."""
        return texels_of(len(self.count), len(self.curves)) + len(self.paints) // 2

    @property
    def unresolved(self) -> int:
        """Number of cells at the depth limit that have only a mean."""
        return int(self.is_mean.sum())
