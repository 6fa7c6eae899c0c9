"""Validate all texels of a texture against FORMAT.md."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from vexture.base import layout
from vexture.base.errors import FormatError
from vexture.texture.curves import curve_points
from vexture.texture.planar import head_of, read_map
from vexture.texture.root import Root
from vexture.texture.walk import REMEDY, check_ends, walk


def check_texels(flat: NDArray[np.uint32], plain: NDArray[np.int64], maps: list[int]) -> None:
    """Raise a `FormatError` where texels contradict FORMAT.md.

    `plain` holds the root quads of silhouettes and layers, `maps` the distinct root quads of planar maps.
    """
    levels = walk(flat, plain)
    times = np.zeros(len(flat), np.int64)
    for level in levels:
        times[level.quads] += 1
        times[level.curves] += 1
    curves = [(curve_points(flat[level.curves]), level.curves) for level in levels]
    for quad in maps:
        found = read_map(flat, quad)
        curves.append((found.points, found.texels))
        for start, stop in found.ranges:
            times[start:stop] += 1
    if times.max() > 1:
        raise FormatError(f"texel {times.argmax()} is a part of two things; {REMEDY}")
    unmet = flat.any(axis=1) & (times == 0)
    if unmet.any():
        raise FormatError(f"texel {unmet.argmax()} belongs to no root and is not 0; {REMEDY}")
    for points, texels in curves:
        check_ends(points[:, [0, 3]], texels)


def check_styles(flat: NDArray[np.uint32], roots: Sequence[Root]) -> None:
    """Raise a `FormatError` where a map's style has another number of paints; the maps themselves are valid."""
    for root in roots:
        if root.style is None:
            continue
        if flat[root.quad - layout.MAP_HEAD].any():
            raise FormatError(f"the map {root.name[:60]!r} has a style, and paints that are programs; {REMEDY}")
        used, stacks = head_of(flat, root.quad).used, len(root.style.starts) - 1
        if used != stacks:
            raise FormatError(f"the map {root.name[:60]!r} has {used} paints, and stacks of {stacks}; {REMEDY}")
