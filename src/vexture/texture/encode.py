"""From trees to one texture (FORMAT.md, part B)."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from vexture import layout
from vexture.errors import LimitError
from vexture.texture.texture import Root, Texture
from vexture.tree.tree import Tree

__all__ = ["encode", "texel_rows"]


def texel_rows(texels: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """Texels in rows of an image; the last row is filled with zeros."""
    width = min(1 << (len(texels) - 1).bit_length(), 1 << layout.ROW_BITS)
    rows = -(-len(texels) // width)
    out = np.zeros((rows * width, 4), np.uint32)
    out[: len(texels)] = texels
    return out.reshape(rows, width, 4)


def encode(trees: Sequence[Tree], roots: Sequence[Root], *, name: str, source: str | None = None) -> Texture:
    """Texture of some trees, one after another: the quads of each, then its curves.

    Each root describes one tree; its `quad` is filled in here. Raises a `LimitError` if there is no tree, or if the
    trees need more texels than a texture has.
    """
    texels: list[NDArray[np.uint32]] = []
    placed: list[Root] = []
    at = 0
    for tree, root in zip(trees, roots, strict=True):
        placed.append(replace(root, quad=at))
        texels += [_quad_texels(tree, at), _curve_texels(tree.curves)]
        at += len(tree.count) + len(tree.curves)
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


def _curve_texels(curves: NDArray[np.int32]) -> NDArray[np.uint32]:
    offset = np.array([0, layout.CONTROL_OFFSET, layout.CONTROL_OFFSET, 0])[:, None]
    stored = curves + offset
    texels: NDArray[np.uint32] = (stored[:, :, 0] | (stored[:, :, 1] << layout.COORDINATE_BITS)).astype(np.uint32)
    return texels
