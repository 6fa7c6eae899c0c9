"""The quad-tree of the thesis, as arrays."""

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray


class CellKind(IntEnum):
    """Kind of a quad's cell."""

    CURVE = 0
    QUAD = 1
    CORNER = 2
    FULL = 3
    EMPTY = 4


@dataclass(frozen=True, slots=True, eq=False)
class CellTree:
    """A quad-tree with thesis leaves: one cubic or one straight corner from edge to edge of its cell.

    Quads are numbered breadth first, and quad 0 is the unit square. The number of a cell in its quad is (x half) +
    2 (y half), y up. References increase with the quad and the cell that hold them. The filled side of a curve or
    corner is on the right of the direction from P0 to P3.
    """

    kind: NDArray[np.uint8]  # (quads, 4): a `CellKind` for each cell
    ref: NDArray[np.int32]  # (quads, 4): index of the quad or curve; -1 for a constant cell
    coverage: NDArray[np.float64]  # (quads, 4): filled part of each cell, 0..1
    curves: NDArray[np.float64]  # (curves, 4, 2): P0 P1 P2 P3 in the cell's unit square; P1 = P2 is a corner
    deviation: float  # largest distance between the outlines before quantisation, in unit-square units
    unresolved: int  # number of cells at the depth limit whose content a leaf cannot represent

    @property
    def quad_coverage(self) -> NDArray[np.float64]:
        """Filled part of each quad, (quads,): the mean over its cells."""
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
