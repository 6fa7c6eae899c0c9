"""Encode trees as one texture (FORMAT.md, part B)."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import LimitError
from vexture.base.kernels import kernel
from vexture.base.layout import (
    CELL_BITS,
    COUNT_SHIFT,
    COVERAGE_ONE,
    MAP_HEAD,
    MOST_ROWS,
    QUAD_FLAG,
    ROW_BITS,
    WINDING_OFFSET,
)
from vexture.texture.curves import write_curve
from vexture.texture.planar import map_texels
from vexture.texture.root import Root
from vexture.texture.texture import Texture
from vexture.tree.planar.map import PlanarMap
from vexture.tree.tree import Tree


def texel_rows(texels: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """Arrange texels in rows of an image; fill the last row with zeros."""
    width = min(1 << (len(texels) - 1).bit_length(), 1 << ROW_BITS)
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
            placed.append(replace(root, quad=at + MAP_HEAD, is_map=True))
        else:
            arrays = tree.is_quad, tree.count, tree.winding, tree.first_quad, tree.first_curve, tree.coverage
            texels.append(tree_texels(*arrays, tree.curves, at))
            placed.append(replace(root, quad=at))
        at += len(texels[-1])
    most = MOST_ROWS << ROW_BITS
    if at > most:
        raise LimitError(f"{name}: {at} texels; the limit is {most}; use several textures, or a larger `tolerance`")
    if not placed:
        raise LimitError(f"{name}: no shapes; a texture has at least one")
    return Texture(texel_rows(np.concatenate(texels)), tuple(placed), name, source)


@kernel(ahead=True)
def tree_texels(
    is_quad: NDArray[np.bool_],
    count: NDArray[np.uint8],
    winding: NDArray[np.int8],
    first_quad: NDArray[np.int32],
    first_curve: NDArray[np.int32],
    coverage: NDArray[np.float64],
    curves: NDArray[np.int32],
    first: int,
) -> NDArray[np.uint32]:
    """Texels of a tree, from the fields of a `Tree` and the index of the first texel."""
    quads = len(count)
    texels = np.zeros((quads + len(curves), 4), np.uint32)
    for i in range(quads):
        cells, coverages = 0, 0
        for k in range(4):
            byte = QUAD_FLAG
            if not is_quad[i, k]:
                pieces = int(count[i, k])
                byte = (pieces << COUNT_SHIFT) + (int(winding[i, k]) + WINDING_OFFSET if pieces > 0 else 0)
            cells |= byte << CELL_BITS * k
            coverages |= int(np.rint(min(max(coverage[i, k], 0.0), 1.0) * COVERAGE_ONE)) << CELL_BITS * k
        texels[i, 0], texels[i, 1] = first + first_quad[i], first + quads + first_curve[i]
        texels[i, 2], texels[i, 3] = cells, coverages
    for i in range(len(curves)):
        write_curve(curves[i], texels[quads + i])
    return texels
