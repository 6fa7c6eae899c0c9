"""The quad-tree itself, as arrays."""

from dataclasses import dataclass
from enum import IntEnum
from typing import Final

import numpy as np
from numpy.typing import NDArray

__all__ = ["CONTROL_MAX", "CONTROL_MIN", "LATTICE", "MOST_CURVES", "MOST_DEPTH", "CellKind", "CellTree", "PackedTree"]

CONTROL_MIN: Final = -1.25
CONTROL_MAX: Final = 2.25
"""Range of P1 and P2 in their cell: 9/4, because max 3 (1 - t) t^2 = 4/9 (thesis 4.2.4)."""


LATTICE: Final = 32768.0
"""Lattice units across a leaf; a power of two, so that the lattices of all depths nest."""

MOST_CURVES: Final = 15
"""Pieces that a packed leaf can hold."""

MOST_DEPTH: Final = 20
"""Depth of the smallest leaf: float32 shaders resolve no more."""


class CellKind(IntEnum):
    """What a cell of a quad is."""

    CURVE = 0
    QUAD = 1
    CORNER = 2
    FULL = 3
    EMPTY = 4


@dataclass(frozen=True, slots=True, eq=False)
class CellTree:
    """A quad-tree with thesis leaves: one cubic or one straight corner from edge to edge of its cell.

    Quads are numbered breadth first, quad 0 is the unit square; cell k of a quad is its (x half) + 2 (y half),
    y up. References rise with the index of the quad and the cell that hold them. The filled side of a curve or
    corner is on the right going from P0 to P3.

    Parameters
    ----------
    kind : (quads, 4) uint8 array
        A `CellKind` for each cell.
    ref : (quads, 4) int32 array
        Index of the quad (QUAD) or of the curve (CURVE, CORNER) that a cell refers to; -1 where it is constant.
    coverage : (quads, 4) float64 array
        Filled part of each cell, 0..1.
    curves : (curves, 4, 2) float64 array
        P0 P1 P2 P3 in their cell's own unit square; P0 and P3 lie on its edge. A corner's P1 and P2 are both the
        corner.
    deviation : float
        Largest distance between the drawing's outline and the leaves', in unit-square units, before quantisation.
    unresolved : int
        Number of cells at the depth limit that hold more than a leaf can say.
    """

    kind: NDArray[np.uint8]
    ref: NDArray[np.int32]
    coverage: NDArray[np.float64]
    curves: NDArray[np.float64]
    deviation: float
    unresolved: int

    @property
    def quad_coverage(self) -> NDArray[np.float64]:
        """Filled part of each quad: the mean of its cells', (quads,)."""
        mean: NDArray[np.float64] = self.coverage.mean(axis=1)
        return mean

    @property
    def quad_depth(self) -> NDArray[np.int32]:
        """Depth of each quad, (quads,); the unit square has depth 0."""
        depth = np.zeros(len(self.kind), np.int32)
        for quad, cell in zip(*np.nonzero(self.kind == CellKind.QUAD), strict=True):
            depth[self.ref[quad, cell]] = depth[quad] + 1
        return depth

    @property
    def widest_leaf(self) -> float:
        """Width of the largest cell with a curve or corner, in unit-square units; 0 if there is none."""
        drawn = np.isin(self.kind, (CellKind.CURVE, CellKind.CORNER)).any(axis=1)
        return 0.5 ** (1 + int(self.quad_depth[drawn].min())) if drawn.any() else 0.0


@dataclass(frozen=True, slots=True, eq=False)
class PackedTree:
    """A quad-tree with packed leaves: up to a few monotone pieces in each, on the leaf's own lattice.

    Quad 0 is the unit square; cell k of a quad is its (x half) + 2 (y half), y up. The quads below one quad are
    numbered one after another, after it, in the order of its cells, leaves left out; so are the curves of its leaves,
    quads left out. In every leaf the winding number is 0 or 1 and 1 means filled: a piece has the filled side on its
    left. At a point p of a leaf it is the leaf's corner winding, plus the starts minus the ends on the leaf's left edge
    at or below p, plus the sum of -sign(dy) over the pieces left of p.

    Parameters
    ----------
    is_quad : (quads, 4) bool array
        Whether a cell is divided.
    count : (quads, 4) uint8 array
        Number of pieces in each leaf; 0 in quads and in constant leaves.
    winding : (quads, 4) int8 array
        Corner winding of each leaf that has pieces; 0 elsewhere.
    first_quad, first_curve : (quads,) int32 arrays
        Where the quads below each quad and the curves of its leaves start.
    coverage : (quads, 4) float64 array
        Filled part of each cell, 0..1.
    curves : (curves, 4, 2) int32 array
        P0 P1 P2 P3, monotone in x and in y, in lattice units of their leaf (32768 to its side). An x of exactly 0 at
        an end means that it lies on the leaf's left edge.
    deviation : float
        Largest distance between the drawing's outline and the leaves', in unit-square units, before quantisation.
    unresolved : int
        Number of leaves at the depth limit that hold more than a leaf can say; they are constant.
    """

    is_quad: NDArray[np.bool_]
    count: NDArray[np.uint8]
    winding: NDArray[np.int8]
    first_quad: NDArray[np.int32]
    first_curve: NDArray[np.int32]
    coverage: NDArray[np.float64]
    curves: NDArray[np.int32]
    deviation: float
    unresolved: int

    @property
    def widest_leaf(self) -> float:
        """Width of the largest leaf with pieces, in unit-square units; 0 if there is none."""
        level, width = np.zeros(1, np.int64), 0.5
        while len(level):
            if self.count[level].any():
                return width
            below = self.is_quad[level].sum(axis=1)
            within = np.arange(below.sum()) - np.repeat(np.cumsum(below) - below, below)
            level, width = np.repeat(self.first_quad[level], below) + within, width / 2
        return 0.0
