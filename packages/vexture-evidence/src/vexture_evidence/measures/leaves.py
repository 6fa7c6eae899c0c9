"""Quads and leaves of a tree, packed or the thesis's, as arrays: positions, depths, coverage and curves."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.base.layout import LATTICE
from vexture.bezier.points import points_along
from vexture.texture.decode import decode as decode_packed
from vexture.texture.texture import Texture
from vexture.thesis.decode import decode as decode_thesis
from vexture.thesis.texture import ThesisTexture
from vexture.thesis.tree import CellKind, CellTree
from vexture.tree.tree import Tree as PackedTree

Tree = CellTree | PackedTree

HALVES = np.array([(0, 0), (1, 0), (0, 1), (1, 1)])
"""Place of each cell in its quad."""


@dataclass(frozen=True, slots=True, eq=False)
class QuadArrays:
    """The divided squares of a tree; quad 0 is the unit square.

    Parameters
    ----------
    x, y, side : (n,) float64 arrays
        Lower left corner and side, in unit-square units, y up.
    depth : (n,) int64 array
        0 for the unit square.
    coverage : (n,) float64 array
        Filled part: the mean over the four cells, which the thesis calls the MIP value.
    child : (n, 4) int64 array
        Index of the quad that each cell is; -1 where the cell is a leaf.
    """

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    side: NDArray[np.float64]
    depth: NDArray[np.int64]
    coverage: NDArray[np.float64]
    child: NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class LeafArrays:
    """The cells of a tree that are not divided, in the order of their quads and of the cells in each quad.

    Parameters
    ----------
    x, y, side : (n,) float64 arrays
        Lower left corner and side, in unit-square units, y up.
    coverage : (n,) float64 array
        Filled part.
    depth : (n,) int64 array
        1 for a quarter of the unit square; `side` is 0.5 ** `depth`.
    quad, cell : (n,) int64 arrays
        Index of each leaf in the tree's arrays.
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

    def lines(self, chords: int = 16, selection: NDArray[Any] | slice = slice(None)) -> NDArray[np.float64]:
        """Points along curves, ends included; on a corner, half of the points lie on each of its two lines.

        Parameters
        ----------
        chords : int
            An even number.
        selection : index or mask
            Curves to use; all by default.

        Returns
        -------
        (curves, chords + 1, 2) float64 array
        """
        t = np.linspace(0.0, 1.0, chords + 1)
        bent = np.stack([np.clip(1 - 2 * t, 0, 1), 1 - np.abs(2 * t - 1), np.zeros_like(t), np.clip(2 * t - 1, 0, 1)])
        points = points_along(self.curves[selection], t)
        corners = self.is_corner[selection]
        points[corners] = np.einsum("kt,mkc->mtc", bent, self.curves[selection][corners])
        return points


def tree_of(shape: Tree | ThesisTexture | Texture, root: str | int | None = None) -> Tree:
    """The given tree, or the tree of a texture's shape; `root` chooses the shape of a packed texture."""
    if isinstance(shape, Texture):
        return decode_packed(shape, root)
    return decode_thesis(shape) if isinstance(shape, ThesisTexture) else shape


def leaves(shape: Tree | ThesisTexture | Texture, root: str | int | None = None) -> LeafArrays:
    """All leaves of a tree, or of a texture's shape.

    Parameters
    ----------
    shape : CellTree, Tree, ThesisTexture or Texture
    root : str or int, optional
        Name or index of the shape in a packed texture; not needed if there is only one.

    Examples
    --------
    >>> import vexture
    >>> from vexture.drawing.drawing import Drawing
    >>> found = leaves(vexture.convert(Drawing.polygon([(0, 0), (1, 0), (0, 1)]), encoding="thesis"))
    >>> found.side.tolist(), found.coverage.round(1).tolist(), found.curves[:, 0].tolist()
    ([0.5, 0.5, 0.5, 0.5], [1.0, 0.5, 0.5, 0.0], [[0.5, 0.5], [0.0, 1.0]])
    """
    tree = tree_of(shape, root)
    parents = quads(tree)
    quad, cell = np.nonzero(parents.child < 0)
    side = parents.side[quad] / 2
    low = np.stack([parents.x, parents.y], axis=1)[quad] + HALVES[cell] * side[:, None]
    if isinstance(tree, CellTree):
        first = tree.ref[quad, cell].astype(np.int64)
        number = np.where(first >= 0, 1, 0)
        scale, corners = 1.0, (tree.kind == CellKind.CORNER)[quad, cell]
    else:
        counts = np.where(tree.is_quad, 0, tree.count.astype(np.int64))
        first = (tree.first_curve[:, None] + np.cumsum(counts, axis=1) - counts)[quad, cell]
        number = counts[quad, cell]
        scale, corners = LATTICE, np.zeros(len(quad), np.bool_)
    owner = np.repeat(np.arange(len(quad)), number)
    place = np.arange(len(owner)) - np.repeat(np.cumsum(number) - number, number)
    curves = low[owner][:, None] + side[owner][:, None, None] * (tree.curves[first[owner] + place] / scale)
    coverage, depth = tree.coverage[quad, cell], parents.depth[quad] + 1
    return LeafArrays(low[:, 0], low[:, 1], side, coverage, depth, quad, cell, curves, owner, corners[owner])


def quads(shape: Tree | ThesisTexture | Texture, root: str | int | None = None) -> QuadArrays:
    """All quads of a tree, or of a texture's shape; parameters as in `leaves`.

    Examples
    --------
    >>> import vexture
    >>> from vexture.drawing.drawing import Drawing
    >>> found = quads(vexture.convert(Drawing.polygon([(0, 0), (0.5, 0), (0, 0.5)]), encoding="thesis"))
    >>> found.depth.tolist(), found.coverage.round(3).tolist()
    ([0], [0.125])
    """
    tree = tree_of(shape, root)
    child = np.full((len(tree.coverage), 4), -1, np.int64)
    if isinstance(tree, CellTree):
        below = tree.kind == CellKind.QUAD
        child[below] = tree.ref[below]
    else:
        below = tree.is_quad
        child[below] = (tree.first_quad[:, None] + np.cumsum(below, axis=1) - 1)[below]
    low, depth = np.zeros((len(child), 2)), np.zeros(len(child), np.int64)
    level = np.zeros(1, np.int64)
    while len(level):
        place, cell = np.nonzero(below[level])
        quad, parent = child[level[place], cell], level[place]
        depth[quad] = depth[parent] + 1
        low[quad] = low[parent] + HALVES[cell] * np.ldexp(1.0, -depth[quad])[:, None]
        level = quad
    return QuadArrays(low[:, 0], low[:, 1], np.ldexp(1.0, -depth), depth, tree.coverage.mean(axis=1), child)
