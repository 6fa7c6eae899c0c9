"""Encode trees as one texture (FORMAT.md, part B)."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from vexture.base import layout
from vexture.base.errors import LimitError
from vexture.texture.curves import curve_texels
from vexture.texture.planar import map_texels
from vexture.texture.root import Root
from vexture.texture.texture import Texture
from vexture.tree.planar.map import PlanarMap
from vexture.tree.tree import Tree


def texel_rows(texels: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """Arrange texels in rows of an image; fill the last row with zeros."""
    width = min(1 << (len(texels) - 1).bit_length(), 1 << layout.ROW_BITS)
    rows = -(-len(texels) // width)
    out = np.zeros((rows * width, 4), np.uint32)
    out[: len(texels)] = texels
    return out.reshape(rows, width, 4)


def encode(
    trees: Sequence[Tree | PlanarMap], roots: Sequence[Root], *, name: str, source: str | None = None
) -> Texture:
    """Encode trees and planar maps one after another; the quads of a tree precede its curves.

    Each root describes one of them; this function sets its `quad` and `is_map`. Raises a `LimitError` if there is no
    tree, or if the trees need more texels than a texture can have.
    """
    texels: list[NDArray[np.uint32]] = []
    placed: list[Root] = []
    at = 0
    for tree, root in zip(trees, roots, strict=True):
        if isinstance(tree, PlanarMap):
            texels.append(map_texels(tree, at))
            placed.append(replace(root, quad=at + layout.MAP_HEAD, is_map=True))
        else:
            texels.append(np.concatenate([_quad_texels(tree, at), curve_texels(tree.curves)]))
            placed.append(replace(root, quad=at))
        at += len(texels[-1])
    most = layout.MOST_ROWS << layout.ROW_BITS
    if at > most:
        raise LimitError(f"{name}: {at} texels; the limit is {most}; use several textures, or a larger `tolerance`")
    if not placed:
        raise LimitError(f"{name}: no shapes; a texture has at least one")
    return Texture(texel_rows(np.concatenate(texels)), tuple(placed), name, source)


def _quad_texels(tree: Tree, at: int) -> NDArray[np.uint32]:
    winding = np.where(tree.count > 0, tree.winding + layout.WINDING_OFFSET, 0)
    cells = np.where(tree.is_quad, layout.QUAD_FLAG, (tree.count.astype(np.int64) << layout.COUNT_SHIFT) + winding)
    coverage = np.rint(tree.coverage.clip(0.0, 1.0) * layout.COVERAGE_ONE).astype(np.int64)
    shift = layout.CELL_BITS * np.arange(4)
    texels = np.empty((len(tree.count), 4), np.uint32)
    texels[:, 0] = at + tree.first_quad
    texels[:, 1] = at + len(tree.count) + tree.first_curve
    texels[:, 2] = (cells << shift).sum(axis=1)
    texels[:, 3] = (coverage << shift).sum(axis=1)
    return texels
