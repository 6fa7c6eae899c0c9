"""The layers of a drawing, of which its faces are composited, as arrays."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Blend, Group, groups_around
from vexture.drawing.paint import Gradient
from vexture.tree.planar.bands import Bands, bands_of
from vexture.tree.planar.shades import Shades, shades_of
from vexture.tree.planar.style import elements_of

MARGIN: Final = 2.0**-10
"""Width by which the box for cutting a gradient exceeds its path, because their sides would coincide otherwise."""


JUMPING: Final = {Blend.COLOR_DODGE, Blend.COLOR_BURN, Blend.HUE, Blend.SATURATION, Blend.COLOR, Blend.LUMINOSITY}
"""Blend modes that jump where a component of a colour is 0 or 1, or where the colour is grey, mostly at stops."""


class Rows(NamedTuple):
    """The paths of a drawing, each followed by the regions that cut its gradient into bands."""

    paths: tuple[Path, ...]
    cut: NDArray[np.int64]  # row of the path that a region cuts; -1 for a path
    shade: NDArray[np.int64]  # first of each path's `bands`, or -1
    bands: NDArray[np.int64]  # numbers of gradients; the bands of one path are consecutive
    gradients: tuple[Gradient, ...]


class PlanarLayers(NamedTuple):
    """Parts of which faces are composited. The first arrays have a row for each path, in painting order."""

    rules: NDArray[np.int64]
    rgba: NDArray[np.float64]  # (paths, 4), premultiplied; the mean of a gradient
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
    bands: NDArray[np.int64]  # numbers of gradients
    shades: Shades


def rows_of(drawing: Drawing, restyle: bool = False) -> Rows:
    """Rows of a drawing; with `restyle` they are just its paths, because colours that can be changed are flat."""
    numbers: dict[Gradient, int] = {}
    at_all_stops = any(group.blend in JUMPING for group in drawing.groups)
    paths: list[Path] = []
    cut: list[int] = []
    shade: list[int] = []
    bands: list[int] = []
    for path in drawing.paths:
        gradient, row = path.paint.gradient, len(paths)
        has_gradient = gradient is not None and len(path.contours) > 0
        paths.append(path)
        cut.append(-1)
        shade.append(len(bands) if has_gradient else -1)
        if gradient is None or not has_gradient:
            continue
        box = np.clip(path.box + np.array([[-MARGIN], [MARGIN]]), 0.0, 1.0)
        found = Bands((gradient,), ()) if restyle else bands_of(gradient, box, at_all_stops)
        bands += [numbers.setdefault(each, len(numbers)) for each in found.gradients]
        paths += [Path((region,) if len(region) else (), group=path.group) for region in found.regions]
        cut += [row] * len(found.regions)
        shade += [-1] * len(found.regions)
    return Rows(
        tuple(paths), np.array(cut, np.int64), np.array(shade, np.int64), np.array(bands, np.int64), tuple(numbers)
    )


def layers_of(rows: Rows, groups: tuple[Group, ...], looks: NDArray[np.int64] | None = None) -> PlanarLayers:
    """Make the arrays of rows; with `looks`, a key for each row, faces are compared by these keys, not by colours."""
    paints = [path.paint for path in rows.paths]
    rgba = np.array([(*paint.color, paint.opacity) for paint in paints]).reshape(-1, 4)
    group = np.array([path.group for path in rows.paths], np.int64)
    opaque = np.array([paint.is_opaque for paint in paints], np.bool_) & (rows.cut < 0)
    return solid_layers(rgba, group, groups)._replace(
        rules=np.array([int(path.fill_rule) for path in rows.paths], np.int64),
        opaque=opaque,
        covers=opaque & (group < 0),
        hides=np.array([path.hides for path in rows.paths], np.bool_),
        shade=rows.shade,
        cut=rows.cut,
        look=np.zeros(len(paints), np.int64) if looks is None else looks,
        bands=rows.bands,
        shades=shades_of(rows.gradients),
    )


def solid_layers(rgba: NDArray[np.float64], group: NDArray[np.int64], groups: tuple[Group, ...]) -> PlanarLayers:
    """Make the arrays of flat colours, (n, 4), not premultiplied, in their groups."""
    zeros, false = np.zeros(len(rgba), np.int64), np.zeros(len(rgba), np.bool_)
    return PlanarLayers(
        zeros,
        np.hstack([rgba[:, :3] * rgba[:, 3:], rgba[:, 3:]]),
        false,
        false,
        np.zeros(len(rgba), np.bool_),
        zeros - 1,
        zeros - 1,
        _keys(len(rgba)),
        zeros,
        group,
        np.array([each.outer for each in groups], np.int64),
        np.array([len(groups_around(groups, place)) - 1 for place in range(len(groups))], np.int64),
        np.array([each.opacity for each in groups], np.float64),
        np.array([int(each.blend) for each in groups], np.int64),
        np.array([int(each.mask) for each in groups], np.int64),
        np.bincount([each.outer for each in groups if each.mask], minlength=len(groups)).astype(np.int64),
        np.zeros(0, np.int64),
        shades_of(()),
    )


def looks_of(drawing: Drawing) -> NDArray[np.int64]:
    """Key of each path's element."""
    elements, number = elements_of(drawing)
    return _keys(len(elements))[number]


def _keys(count: int) -> NDArray[np.int64]:
    """Pseudorandom numbers, by SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators")."""
    z = np.arange(1, count + 1, dtype=np.uint64) * np.uint64(0x9E3779B97F4A7C15)
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return (z ^ (z >> np.uint64(31))).view(np.int64)
