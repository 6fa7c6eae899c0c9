"""Decode a texture (FORMAT.md, part B) to the trees of its shapes."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.base import layout
from vexture.texture.curves import curve_points
from vexture.texture.texture import Texture
from vexture.texture.walk import WalkLevel, walk
from vexture.tree.tree import Tree


def decode(texture: Texture, root: str | int | None = None) -> Tree:
    """Decode the tree of one shape, by its name or number, with `deviation` and `unresolved` set to 0.

    The tree equals the one that was encoded, except for the rounding of coverages, and encodes to the same texels.
    Other writers may store quads and curves in another order; the result has them in the order of `Tree`. Raises a
    `ParameterError` as `Texture.root` does, and a `FormatError` if the texels are not a tree.
    """
    flat = texture.flat
    levels = walk(flat, np.array([texture.root(root).quad]))
    is_quad, count = _concatenate(levels, "is_quad"), _concatenate(levels, "counts")
    quads_in, curves_in = is_quad.sum(axis=1), count.sum(axis=1)
    return Tree(
        is_quad,
        count.astype(np.uint8),
        _concatenate(levels, "windings").astype(np.int8),
        (1 + np.cumsum(quads_in) - quads_in).astype(np.int32),
        (np.cumsum(curves_in) - curves_in).astype(np.int32),
        _concatenate(levels, "coverages") / layout.COVERAGE_ONE,
        curve_points(flat[_concatenate(levels, "curves")]),
        deviation=0.0,
        unresolved=0,
    )


def _concatenate(levels: list[WalkLevel], attribute: str) -> NDArray[Any]:
    return np.concatenate([getattr(level, attribute) for level in levels])
