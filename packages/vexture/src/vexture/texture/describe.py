"""Describe the shapes of a texture as JSON-ready data."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.base import layout
from vexture.texture.planar import read_map
from vexture.texture.root import Root
from vexture.texture.walk import walk


def facts_of(flat: NDArray[np.uint32], roots: Sequence[Root]) -> dict[str, Any]:
    """Number of texels, depth, and a description of each shape; shapes with the same root quad share one tree."""
    plain = np.array([root.quad for root in roots if not root.is_map], np.int64)
    trees = _tree_facts(flat, plain) | {root.quad: _map_facts(flat, root.quad) for root in roots if root.is_map}
    return {
        "texels": sum(tree.pop("texels") for tree in trees.values()),
        "depth": max(tree["depth"] for tree in trees.values()),
        "roots": [
            {
                "name": root.name,
                "quad": root.quad,
                **({"map": True} if root.is_map else {}),
                **trees[root.quad],
                **({} if root.style is None else {"elements": [*dict.fromkeys(filter(None, root.style.names))]}),
                "transform": root.to_source.tolist(),
                "crs": root.crs,
                "tolerance": root.tolerance,
                "paint": root.paint and {"color": [*root.paint.color], "opacity": root.paint.opacity},
            }
            for root in roots
        ],
    }


def _tree_facts(flat: NDArray[np.uint32], roots: NDArray[np.int64]) -> dict[int, dict[str, Any]]:
    """Describe silhouettes and layers, by their root quads."""
    levels = walk(flat, roots)
    if not levels:
        return {}
    distinct = levels[0].quads
    quads, curves, depth = np.zeros((3, len(distinct)), np.int64)
    for below, level in enumerate(levels):
        here = np.bincount(level.tree, minlength=len(distinct))
        quads += here
        curves += np.bincount(level.tree, level.counts.sum(axis=1), len(distinct)).astype(np.int64)
        depth[here > 0] = below
    coverage = levels[0].coverages.mean(axis=1) / layout.COVERAGE_ONE
    return {
        int(quad): {
            "coverage": float(coverage[tree]),
            "quads": int(quads[tree]),
            "curves": int(curves[tree]),
            "depth": int(depth[tree]),
            "texels": int(quads[tree] + curves[tree]),
        }
        for tree, quad in enumerate(distinct)
    }


def _map_facts(flat: NDArray[np.uint32], quad: int) -> dict[str, Any]:
    """Describe a planar map."""
    found = read_map(flat, quad)
    alpha = flat[found.cells + 1] >> layout.CELL_BITS * 3
    return {
        "coverage": float(alpha.mean()) / layout.COVERAGE_ONE,
        "quads": sum(len(level.quads) for level in found.levels),
        "curves": len(found.points),
        "paints": found.used,
        "depth": len(found.levels) - 1,
        "texels": sum(stop - start for start, stop in found.ranges),
    }
