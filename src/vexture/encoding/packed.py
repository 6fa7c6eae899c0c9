"""The packed encoding (FORMAT.md, part B): trees to one texture and back, what a texture says of itself."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.encoding import layout
from vexture.encoding.packed_texture import PackedTexture, Root
from vexture.encoding.packed_walk import WalkLevel, walk
from vexture.errors import LimitError
from vexture.quadtree.tree import PackedTree

__all__ = ["curve_points", "decode_packed", "encode_packed", "info_packed", "texel_rows"]


def encode_packed(
    trees: Sequence[PackedTree], roots: Sequence[Root], *, name: str, source: str | None = None
) -> PackedTexture:
    """Texture of some trees, one after another: the quads of each, then its curves.

    Parameters
    ----------
    trees : sequence of PackedTree
        Numbered as its docstring says.
    roots : sequence of Root
        What to say of each; their `quad` is filled in here.
    name, source : str
        Of the texture.

    Raises
    ------
    LimitError
        If there is no tree, or they take more texels than a texture has.
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
        raise LimitError(f"{name}: {at} texels; the limit is {most}; use several textures, or a larger --tolerance")
    if not placed:
        raise LimitError(f"{name}: no shapes; a texture has at least one")
    return PackedTexture(texel_rows(np.concatenate(texels)), tuple(placed), name, source)


def _quad_texels(tree: PackedTree, at: int) -> NDArray[np.uint32]:
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


def texel_rows(texels: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """Texels in rows, the last one filled up with zeros."""
    width = min(1 << (len(texels) - 1).bit_length(), 1 << layout.ROW_BITS)
    rows = -(-len(texels) // width)
    out = np.zeros((rows * width, 4), np.uint32)
    out[: len(texels)] = texels
    return out.reshape(rows, width, 4)


def decode_packed(texture: PackedTexture, root: str | int = 0) -> PackedTree:
    """Tree of one shape of a texture, with `deviation` and `unresolved` 0.

    What `encode_packed` has written comes back as it was but for the rounding of coverages, and becomes the same
    texels again. In what others have written quads and curves may lie in another order; here they are numbered as
    `PackedTree` says.

    Parameters
    ----------
    texture : PackedTexture
    root : str or int
        Name or place of the shape.

    Raises
    ------
    FormatError
        If there is no such shape, or its texels are no tree.

    Examples
    --------
    >>> texels = np.array([[[0, 0, 0, 0xFF]]], np.uint32)
    >>> decode_packed(PackedTexture(texels, (Root("a quarter"),))).coverage
    array([[1., 0., 0., 0.]])
    """
    flat = texture.flat
    levels = walk(flat, np.array([texture.root(root).quad]))
    is_quad, count = _joined(levels, "is_quad"), _joined(levels, "counts")
    quads_in, curves_in = is_quad.sum(axis=1), count.sum(axis=1)
    return PackedTree(
        is_quad,
        count.astype(np.uint8),
        _joined(levels, "windings").astype(np.int8),
        (1 + np.cumsum(quads_in) - quads_in).astype(np.int32),
        (np.cumsum(curves_in) - curves_in).astype(np.int32),
        _joined(levels, "coverages") / layout.COVERAGE_ONE,
        curve_points(flat[_joined(levels, "curves")]),
        deviation=0.0,
        unresolved=0,
    )


def _joined(levels: list[WalkLevel], what: str) -> NDArray[Any]:
    return np.concatenate([getattr(level, what) for level in levels])


def curve_points(texels: NDArray[np.uint32]) -> NDArray[np.int32]:
    """Points of curves in lattice units of their leaf, (n, 4) -> (n, 4, 2)."""
    mask = (1 << layout.COORDINATE_BITS) - 1
    points = np.stack([texels & mask, texels >> layout.COORDINATE_BITS], axis=2).astype(np.int32)
    points[:, 1:3] -= layout.CONTROL_OFFSET
    return points


def info_packed(texture: PackedTexture) -> dict[str, Any]:
    """Describe a texture, ready for JSON.

    Examples
    --------
    >>> texels = np.array([[[0, 0, 0, 0xFF]]], np.uint32)
    >>> info_packed(PackedTexture(texels, (Root("a quarter"),)))["roots"][0]["coverage"]
    0.25
    """
    levels = walk(texture.flat, texture.quads)
    trees = len(levels[0].quads)
    quads, curves, depth = np.zeros((3, trees), np.int64)
    for below, level in enumerate(levels):
        here = np.bincount(level.tree, minlength=trees)
        quads += here
        curves += np.bincount(level.tree, level.counts.sum(axis=1), trees).astype(np.int64)
        depth[here > 0] = below
    coverage = levels[0].coverages.mean(axis=1) / layout.COVERAGE_ONE
    roots = []
    for root in texture.roots:
        tree = np.searchsorted(levels[0].quads, root.quad)
        roots.append(
            {
                "name": root.name,
                "quad": root.quad,
                "coverage": float(coverage[tree]),
                "quads": int(quads[tree]),
                "curves": int(curves[tree]),
                "depth": int(depth[tree]),
                "transform": root.to_source.tolist(),
                "crs": root.crs,
                "tolerance": root.tolerance,
                "paint": None if root.paint is None else {"color": [*root.paint.color], "opacity": root.paint.opacity},
            }
        )
    return {
        "encoding": layout.ENCODING_PACKED,
        "version": layout.PACKED_VERSION,
        "name": texture.name,
        "source": texture.source,
        "width": texture.texels.shape[1],
        "height": texture.texels.shape[0],
        "texels": int(quads.sum() + curves.sum()),
        "depth": int(depth.max()),
        "bytes": texture.nbytes,
        "roots": roots,
    }
