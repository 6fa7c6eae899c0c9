"""The layers of a drawing, of which its faces are composited, as arrays."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.tree.planar.rows import Rows
from vexture.tree.planar.shades import Shades, is_opaque_shade
from vexture.tree.planar.source import BLEND, ELEMENT, GRADIENT, GROUP, HIDES, MASK, OUTER, MapSource


class PlanarLayers(NamedTuple):
    """Parts of which faces are composited. The first arrays have a row for each path, in painting order."""

    rules: NDArray[np.int64]
    rgba: NDArray[np.float64]  # (paths, 4), premultiplied; the mean of a gradient or picture
    opaque: NDArray[np.bool_]
    covers: NDArray[np.bool_]  # whether a path hides all paths below it, because it is opaque and in no group
    hides: NDArray[np.bool_]  # whether it has hidden something, which the map lacks
    shade: NDArray[np.int64]  # first of each path's `bands`, or -1
    cut: NDArray[np.int64]  # row of the path that a region cuts into bands, which itself paints nothing; -1 for a path
    keys: NDArray[np.int64]
    look: NDArray[np.int64]  # key of each path's element, in a map to be restyled, else 0
    group: NDArray[np.int64]  # innermost group of each path, or -1
    outer: NDArray[np.int64]  # (groups,): the group around each group, or -1
    depth: NDArray[np.int64]  # (groups,): number of groups around it
    opacity: NDArray[np.float64]
    blend: NDArray[np.int64]
    mask: NDArray[np.int64]
    masked: NDArray[np.int64]  # (groups,): number of its masks
    bands: NDArray[np.int64]  # numbers of gradients and pictures
    shades: Shades


@kernel
def layers_of(source: MapSource, rows: Rows, restyle: int) -> PlanarLayers:
    """Make the arrays of rows; if `restyle` is 1, faces are compared by their elements, not by their colours."""
    count = len(rows.path)
    rgba, group = np.zeros((count, 4)), np.empty(count, np.int64)
    for row in range(count):
        path = rows.path[row]
        group[row] = source.paths[path, GROUP]
        for c in range(4):
            # a region paints nothing
            rgba[row, c] = source.rgba[path, c] if rows.cut[row] < 0 else (1.0 if c == 3 else 0.0)
    flat = solid_layers(rgba, group, source.groups, source.opacities)
    rules, look = np.zeros(count, np.int64), np.zeros(count, np.int64)
    opaque, covers, hides = np.zeros(count, np.bool_), np.zeros(count, np.bool_), np.zeros(count, np.bool_)
    for row in range(count):
        path = rows.path[row]
        if rows.cut[row] >= 0:
            continue
        rules[row] = source.rules[path]
        opaque[row] = _is_opaque(source, path)
        covers[row] = opaque[row] and group[row] < 0
        hides[row] = source.paths[path, HIDES] == 1
        look[row] = key_of_number(source.paths[path, ELEMENT]) if restyle == 1 else 0
    return PlanarLayers(
        rules,
        flat.rgba,
        opaque,
        covers,
        hides,
        rows.shade,
        rows.cut,
        flat.keys,
        look,
        group,
        flat.outer,
        flat.depth,
        flat.opacity,
        flat.blend,
        flat.mask,
        flat.masked,
        rows.bands,
        rows.shades,
    )


@kernel(allocates=False)
def _is_opaque(source: MapSource, path: int) -> bool:
    """Whether nothing below shows through any part of a path's paint, as `Paint.is_opaque` says."""
    gradient = source.paths[path, GRADIENT]
    if gradient < 0:
        return source.rgba[path, 3] >= 1.0
    return is_opaque_shade(source.gradients, source.stops, source.pixels, gradient)


@kernel
def solid_layers(
    rgba: NDArray[np.float64], group: NDArray[np.int64], groups: NDArray[np.int64], opacities: NDArray[np.float64]
) -> PlanarLayers:
    """Make the arrays of flat colours, (n, 4), not premultiplied, in groups as in `MapSource`."""
    count = len(rgba)
    zeros, none, false = np.zeros(count, np.int64), np.full(count, -1), np.zeros(count, np.bool_)
    colours, keys = np.empty((count, 4)), np.empty(count, np.int64)
    for k in range(count):
        keys[k], colours[k, 3] = key_of_number(k), rgba[k, 3]
        for c in range(3):
            colours[k, c] = rgba[k, c] * rgba[k, 3]
    depth, masked = np.zeros(len(groups), np.int64), np.zeros(len(groups), np.int64)
    outer, blend, mask = np.empty(len(groups), np.int64), np.empty(len(groups), np.int64), np.empty_like(depth)
    for g in range(len(groups)):
        outer[g], blend[g], mask[g] = groups[g, OUTER], groups[g, BLEND], groups[g, MASK]
        depth[g] = depth[outer[g]] + 1 if outer[g] >= 0 else 0
        if mask[g] != 0:
            masked[outer[g]] += 1
    shades = Shades(np.zeros((0, 11)), np.zeros((0, 5)), np.zeros(0, np.uint32))
    return PlanarLayers(
        zeros,
        colours,
        false,
        false,
        false,
        none,
        none,
        keys,
        zeros,
        group,
        outer,
        depth,
        opacities,
        blend,
        mask,
        masked,
        zeros[:0],
        shades,
    )


@kernel(allocates=False)
def key_of_number(number: int) -> int:
    """Pseudorandom number, by SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators")."""
    z = np.uint64(number + 1) * np.uint64(0x9E3779B97F4A7C15)
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return int(np.int64(z ^ (z >> np.uint64(31))))
