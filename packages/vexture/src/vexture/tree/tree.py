"""The quad-tree, as arrays."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

MOST_QUADS = 2_000_000
"""Quads of the largest tree that is built, about 200 MB."""


@dataclass(frozen=True, slots=True, eq=False)
class Tree:
    """A quad-tree with packed leaves: each holds a few monotone pieces on the leaf's own lattice.

    Quad 0 is the unit square. Cell k of a quad is (x half) + 2 (y half), with y up. Quads are numbered level by level.
    The quads below a quad have consecutive numbers, in the order of the cells that they divide. The curves of a quad's
    leaves have consecutive numbers, in the order of the leaves.

    In every leaf the winding number is 0 or 1, and 1 means filled: the filled side is on the left of a piece. At a
    point p of a leaf it is the leaf's corner winding, plus the starts minus the ends on the leaf's left edge at or
    below p, plus the sum of -sign(dy) over the pieces left of p.
    """

    is_quad: NDArray[np.bool_]  # (quads, 4): whether a cell is divided
    count: NDArray[np.uint8]  # (quads, 4): pieces in each leaf; 0 in quads and constant leaves
    winding: NDArray[np.int8]  # (quads, 4): corner winding of each leaf with pieces; 0 elsewhere
    first_quad: NDArray[np.int32]  # (quads,): first of the quads below each quad; 0 without any
    first_curve: NDArray[np.int32]  # (quads,): first curve of its leaves; 0 without any
    coverage: NDArray[np.float64]  # (quads, 4): filled part of each cell, 0..1
    # (curves, 4, 2): P0 P1 P2 P3, monotone in x and in y, in lattice units of their leaf (32768 to its side). An end
    # with x = 0 lies on the leaf's left edge.
    curves: NDArray[np.int32]
    # largest distance between the drawing's outline and the leaves', in unit-square units, before quantisation
    deviation: float
    unresolved: int  # constant leaves at the depth limit, of cells that hold more than a leaf can store

    @property
    def texels(self) -> int:
        """Texels that the tree takes in a texture."""
        return len(self.count) + len(self.curves)

    @property
    def widest_leaf(self) -> float:
        """Width of the largest leaf with pieces, in unit-square units; 0 without any."""
        width = 0.5
        for level in levels(self.is_quad, self.first_quad):
            if self.count[level].any():
                return width
            width /= 2
        return 0.0


def runs(first: NDArray[np.integer[Any]], length: NDArray[np.integer[Any]]) -> NDArray[np.int64]:
    """Runs of consecutive numbers, one after another: `length[k]` numbers from `first[k]` on.

    Examples
    --------
    >>> runs(np.array([7, 0, 3]), np.array([2, 0, 1])).tolist()
    [7, 8, 3]
    """
    return np.repeat(first - np.cumsum(length) + length, length) + np.arange(length.sum())


def levels(is_quad: NDArray[np.bool_], first_quad: NDArray[np.integer[Any]]) -> Iterator[NDArray[np.int64]]:
    """Quads of each level of a tree, in the order of their parents and of the parents' cells."""
    level = np.zeros(1, np.int64)
    while len(level):
        yield level
        level = runs(first_quad[level], is_quad[level].sum(axis=1))
