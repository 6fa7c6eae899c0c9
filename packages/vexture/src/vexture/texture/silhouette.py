"""The way of a silhouette from outlines to texels in one kernel, for callers without Python: see `tools/build_wasm.py`.

In Python, `build_tree` and `encode` call the same kernels one by one, and look at the clock between them.
"""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.tolerance import CLOSED
from vexture.texture.encode import tree_texels
from vexture.tree.bounds import Bounds
from vexture.tree.build import grow
from vexture.tree.cubics import are_finite
from vexture.tree.growth import QUADS, UNRESOLVED, WAITING, arrange_tree


@kernel
def silhouette_texels(
    cubics: NDArray[np.float64],
    lengths: NDArray[np.int64],
    path: NDArray[np.int64],
    rules: NDArray[np.int64],
    bounds: Bounds,
    first: int,
    most_work: int,
) -> tuple[NDArray[np.uint32], float, float, int, int]:
    """Texels of a silhouette, from the fields of `Outlines`, bounds and the index of the first texel.

    Also returns how far the outline leaves the unit square (NaN if a coordinate is not finite), the largest distance of
    a leaf's outline from the drawing's, the number of unresolved leaves, and the number of quads. There are no texels
    if the outline leaves the square by more than `CLOSED`, if there would be more than `bounds.most_quads` quads, or if
    the tree takes more than `most_work`, in units of `grow_on`.
    """
    if not are_finite(cubics):
        return np.zeros((0, 4), np.uint32), np.nan, 0.0, 0, 0
    tree, outside = grow(cubics, lengths, path, rules, bounds, most_work, 0)
    if not outside <= CLOSED or tree.counts[WAITING] > 0:
        return np.zeros((0, 4), np.uint32), outside, 0.0, 0, tree.counts[QUADS]
    is_quad, count, winding, first_quad, first_curve, coverage, curves = arrange_tree(
        tree.cells, tree.first, tree.curves, tree.counts
    )
    texels = tree_texels(is_quad, count, winding, first_quad, first_curve, coverage, curves, first)
    return texels, outside, tree.deviation[0], tree.counts[UNRESOLVED], tree.counts[QUADS]
