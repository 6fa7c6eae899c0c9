"""What the trees of a texture hold, in numbers."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture import layout
from vexture.texture.root import Root
from vexture.texture.walk import walk

__all__ = ["facts"]


def facts(flat: NDArray[np.uint32], roots: Sequence[Root]) -> dict[str, Any]:
    """Number of texels and depth of all trees; for each shape its coverage, quads, curves, depth and description.

    Parameters
    ----------
    flat : (n, 4) uint32 array
        The texels.
    roots : sequence of Root

    Raises
    ------
    FormatError
        If the texels are no trees.

    Examples
    --------
    >>> facts(np.array([[0, 0, 0, 0xFF]], np.uint32), [Root("a quarter")])["roots"][0]["coverage"]
    0.25
    """
    levels = walk(flat, np.array([root.quad for root in roots], np.int64))
    trees = len(levels[0].quads)
    quads, curves, depth = np.zeros((3, trees), np.int64)
    for below, level in enumerate(levels):
        here = np.bincount(level.tree, minlength=trees)
        quads += here
        curves += np.bincount(level.tree, level.counts.sum(axis=1), trees).astype(np.int64)
        depth[here > 0] = below
    coverage = levels[0].coverages.mean(axis=1) / layout.COVERAGE_ONE
    described = []
    for root in roots:
        tree = np.searchsorted(levels[0].quads, root.quad)
        described.append(
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
    return {"texels": int(quads.sum() + curves.sum()), "depth": int(depth.max()), "roots": described}
