"""The quad-tree itself, as arrays."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Tree"]


@dataclass(frozen=True, slots=True, eq=False)
class Tree:
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
