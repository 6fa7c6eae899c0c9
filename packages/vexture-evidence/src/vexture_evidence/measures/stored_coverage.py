"""The coverage that textures store for their cells, compared with the exact coverage (thesis 6.2.3)."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing
from vexture.renderers.exact import render_exact
from vexture.thesis.cpu import cell_value, read_leaf
from vexture.thesis.layout import CONSTANT_ROWS
from vexture.thesis.method import CURVE, SAMPLES
from vexture.thesis.texture import ThesisTexture
from vexture.thesis.tree import CellKind, CellTree
from vexture_evidence.measures.leaves import LeafArrays, Tree, leaves, quads


class StoredValues(NamedTuple):
    """Coverage of every leaf and quad as a texture stores it, and its error.

    Attributes
    ----------
    found : LeafArrays
        The leaves, with their stored coverage.
    off : (n,) float64 array
        Absolute error of each leaf.
    quad_depth : (m,) int64 array
    quad_off : (m,) float64 array
        Absolute error of each quad's stored coverage, its MIP value.
    """

    found: LeafArrays
    off: NDArray[np.float64]
    quad_depth: NDArray[np.int64]
    quad_off: NDArray[np.float64]


def stored_values(drawing: Drawing, tree: Tree, texture: ThesisTexture | None = None) -> StoredValues:
    """Compare the coverage that a tree stores for its cells with the exact coverage of the drawing.

    Parameters
    ----------
    drawing : Drawing
    tree : CellTree or Tree
        A tree of the drawing.
    texture : ThesisTexture, optional
        Texture of the tree. If it is given, the coverage of a leaf is the mean of 16 samples of its curve, as the
        thesis proposes (6.2.3), and that of a quad the mean of its cells.

    Examples
    --------
    >>> from vexture.conversion.pipeline import run_encoding
    >>> half = Drawing.polygon([(0, 0), (1, 0), (1, 0.5), (0, 0.5)])
    >>> stored_values(half, run_encoding(half, "thesis").tree).quad_off.round(6).tolist()
    [0.0]
    """
    if texture is not None:
        assert isinstance(tree, CellTree)
        tree = replace(tree, coverage=_sampled_coverage(tree, texture))
    found, above = leaves(tree), quads(tree)
    truths = {
        int(depth): render_exact(drawing, (1 << int(depth),) * 2)
        for depth in np.unique(np.concatenate([found.depth, above.depth]))
    }
    return StoredValues(
        found,
        abs(found.coverage - _exact_coverage(truths, found.x, found.y, found.depth)),
        above.depth,
        abs(above.coverage - _exact_coverage(truths, above.x, above.y, above.depth)),
    )


def _exact_coverage(
    truths: dict[int, NDArray[np.float32]], x: NDArray[np.float64], y: NDArray[np.float64], depth: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Exact coverage of squares of side 0.5 ** depth; each is a pixel of the exact picture of its depth."""
    out = np.empty(len(x))
    for level, truth in truths.items():
        at = depth == level
        column, row = (np.rint(np.ldexp(axis[at], level)).astype(np.int64) for axis in (x, y))
        out[at] = truth[len(truth) - 1 - row, column]
    return out


def _sampled_coverage(tree: CellTree, texture: ThesisTexture) -> NDArray[np.float64]:
    """Coverage of cells by 4 x 4 samples of each curve, and of quads by the mean of their cells."""
    curves = texture.curves / texture.maximum
    coverage = tree.coverage.copy()
    grid = [((i + 0.5) / SAMPLES, (j + 0.5) / SAMPLES) for i in range(SAMPLES) for j in range(SAMPLES)]
    for quad in range(len(coverage) - 1, -1, -1):
        for cell in range(4):
            ref = int(tree.ref[quad, cell])
            if tree.kind[quad, cell] == CellKind.CURVE:
                leaf = read_leaf(curves, (0.0, 0.0), 1.0, CURVE, CONSTANT_ROWS + ref)
                coverage[quad, cell] = sum(cell_value(leaf, point) for point in grid) / len(grid)
            elif tree.kind[quad, cell] == CellKind.QUAD:
                coverage[quad, cell] = coverage[ref].mean()
    return coverage
