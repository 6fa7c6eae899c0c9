"""The leaves of a tree of either kind as arrays: where they are, how deep, how full, and their curves."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.encoding import PackedTexture, ThesisTexture, decode, decode_packed
from vexture.quadtree.tree import LATTICE, CellKind, CellTree, PackedTree

__all__ = ["Leaves", "Tree", "leaves", "tree_of"]

Tree = CellTree | PackedTree

HALVES = np.array([(0, 0), (1, 0), (0, 1), (1, 1)])
"""Place of each cell in its quad."""


@dataclass(frozen=True, slots=True, eq=False)
class Leaves:
    """The cells of a tree that are not divided, in the order of their quads and of the cells of these.

    Parameters
    ----------
    x, y, side : (n,) float64 arrays
        Lower left corner and side, in unit-square units, y up.
    coverage : (n,) float64 array
        Filled part.
    depth : (n,) int64 array
        1 for a quarter of the unit square; `side` is 0.5 ** `depth`.
    quad, cell : (n,) int64 arrays
        Where the tree's arrays hold each.
    curves : (m, 4, 2) float64 array
        P0 P1 P2 P3 of all curves in the unit square.
    owner : (m,) int64 array
        Leaf of each curve.
    is_corner : (m,) bool array
        Whether a curve is two straight lines that meet at P1 = P2.
    """

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    side: NDArray[np.float64]
    coverage: NDArray[np.float64]
    depth: NDArray[np.int64]
    quad: NDArray[np.int64]
    cell: NDArray[np.int64]
    curves: NDArray[np.float64]
    owner: NDArray[np.int64]
    is_corner: NDArray[np.bool_]

    def lines(self, chords: int = 16, which: NDArray[Any] | slice = slice(None)) -> NDArray[np.float64]:
        """Points along curves, the ends included; half of them lie on either line of a corner.

        Parameters
        ----------
        chords : int
            An even number.
        which : index or mask
            Of the curves; all by default.

        Returns
        -------
        (curves, chords + 1, 2) float64 array
        """
        t = np.linspace(0.0, 1.0, chords + 1)
        weights = np.stack([(1 - t) ** 3, 3 * (1 - t) ** 2 * t, 3 * (1 - t) * t**2, t**3])
        bent = np.stack([np.clip(1 - 2 * t, 0, 1), 1 - np.abs(2 * t - 1), np.zeros_like(t), np.clip(2 * t - 1, 0, 1)])
        points: NDArray[np.float64] = np.einsum("kt,mkc->mtc", weights, self.curves[which])
        corners = self.is_corner[which]
        points[corners] = np.einsum("kt,mkc->mtc", bent, self.curves[which][corners])
        return points


def tree_of(shape: Tree | ThesisTexture | PackedTexture, root: str | int = 0) -> Tree:
    """The tree itself, or that of a texture's shape; `root` chooses one of a packed texture."""
    if isinstance(shape, PackedTexture):
        return decode_packed(shape, root)
    return decode(shape) if isinstance(shape, ThesisTexture) else shape


def leaves(shape: Tree | ThesisTexture | PackedTexture, root: str | int = 0) -> Leaves:
    """All leaves of a tree, or of a texture's shape.

    Parameters
    ----------
    shape : CellTree, PackedTree, ThesisTexture or PackedTexture
    root : str or int
        Name or place of the shape in a packed texture.

    Examples
    --------
    >>> import vexture
    >>> from vexture.drawing import Drawing
    >>> found = leaves(vexture.convert(Drawing.polygon([(0, 0), (1, 0), (0, 1)]), encoding="thesis"))
    >>> found.side.tolist(), found.coverage.round(1).tolist(), found.curves[:, 0].tolist()
    ([0.5, 0.5, 0.5, 0.5], [1.0, 0.5, 0.5, 0.0], [[0.5, 0.5], [0.0, 1.0]])
    """
    tree = tree_of(shape, root)
    if isinstance(tree, CellTree):
        below = tree.kind == CellKind.QUAD
        children = tree.ref[below].astype(np.int64)
        counts = np.where(~below & (tree.ref >= 0), 1, 0)
    else:
        below = tree.is_quad
        within = np.cumsum(below, axis=1) - 1
        children = (tree.first_quad[:, None] + within)[below].astype(np.int64)
        counts = np.where(below, 0, tree.count.astype(np.int64))
    corner, depth = _places(below, children)
    quad, cell = np.nonzero(~below)
    side = np.ldexp(1.0, -1 - depth[quad])
    low = corner[quad] + HALVES[cell] * side[:, None]
    number = counts[quad, cell]
    owner = np.repeat(np.arange(len(quad)), number)
    if isinstance(tree, CellTree):
        stored = tree.curves[tree.ref[quad, cell][owner]]
        is_corner = (tree.kind == CellKind.CORNER)[quad, cell][owner]
    else:
        before = (np.cumsum(counts, axis=1) - counts)[quad, cell] + tree.first_curve[quad]
        place = np.arange(len(owner)) - np.repeat(np.cumsum(number) - number, number)
        stored = tree.curves[before[owner] + place] / LATTICE
        is_corner = np.zeros(len(owner), np.bool_)
    curves = low[owner][:, None] + side[owner][:, None, None] * stored
    coverage = tree.coverage[quad, cell]
    return Leaves(low[:, 0], low[:, 1], side, coverage, depth[quad] + 1, quad, cell, curves, owner, is_corner)


def _places(below: NDArray[np.bool_], children: NDArray[np.int64]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Lower left corner and depth of each quad, from which cells are quads and, in order, which."""
    corner, depth = np.zeros((len(below), 2)), np.zeros(len(below), np.int64)
    child = np.full(below.shape, -1, np.int64)
    child[below] = children
    level = np.zeros(1, np.int64)
    while len(level):
        parent, cell = np.nonzero(below[level])
        quad, parent = child[level[parent], cell], level[parent]
        depth[quad] = depth[parent] + 1
        corner[quad] = corner[parent] + HALVES[cell] * np.ldexp(1.0, -depth[quad])[:, None]
        level = quad
    return corner, depth
