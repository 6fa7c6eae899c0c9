"""The layers of a drawing, as arrays: what its faces are composited of."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import Drawing
from vexture.group import Group, groups_around
from vexture.paint import Gradient
from vexture.tree.planar.shades import Shades, shades_of
from vexture.tree.planar.style import elements_of

__all__ = ["Layers", "gradients_of", "layers_of", "solid_layers"]


class Layers(NamedTuple):
    """What faces are composited of. The first arrays have a row for each path, in painting order."""

    rules: NDArray[np.int64]
    rgba: NDArray[np.float64]  # (paths, 4), premultiplied; of a gradient its mean
    opaque: NDArray[np.bool_]
    covers: NDArray[np.bool_]  # whether a path hides all below it: opaque, in no group
    hides: NDArray[np.bool_]  # whether it did: something below is not in the map
    shade: NDArray[np.int64]  # number of each path's gradient, or -1
    keys: NDArray[np.int64]
    look: NDArray[np.int64]  # key of each path's element, in a map to be restyled, else 0
    group: NDArray[np.int64]  # innermost group of each path, or -1
    outer: NDArray[np.int64]  # of each group: the group around it, or -1
    depth: NDArray[np.int64]  # of each group: how many there are around it
    opacity: NDArray[np.float64]
    blend: NDArray[np.int64]
    mask: NDArray[np.int64]
    masked: NDArray[np.int64]  # of each group: how many masks it has
    shades: Shades


def gradients_of(drawing: Drawing) -> tuple[Gradient, ...]:
    """The different gradients of a drawing's paints, numbered as in `Layers.shade`."""
    found = (path.paint.gradient for path in drawing.paths)
    return tuple(dict.fromkeys(gradient for gradient in found if gradient is not None))


def layers_of(drawing: Drawing, restyle: bool = False) -> Layers:
    """The arrays of a drawing; with `restyle` faces are alike by their elements, not by their colours."""
    paints = [path.paint for path in drawing.paths]
    rgba = np.array([(*paint.color, paint.opacity) for paint in paints]).reshape(-1, 4)
    group = np.array([path.group for path in drawing.paths], np.int64)
    opaque = np.array([paint.is_opaque for paint in paints], np.bool_)
    numbers = {gradient: k for k, gradient in enumerate(gradients_of(drawing))}
    return solid_layers(rgba, group, drawing.groups)._replace(
        rules=np.array([int(path.fill_rule) for path in drawing.paths], np.int64),
        opaque=opaque,
        covers=opaque & (group < 0),
        shade=np.array([-1 if paint.gradient is None else numbers[paint.gradient] for paint in paints], np.int64),
        look=_looks(drawing) if restyle else np.zeros(len(paints), np.int64),
        shades=shades_of(tuple(numbers)),
    )


def solid_layers(rgba: NDArray[np.float64], group: NDArray[np.int64], groups: tuple[Group, ...]) -> Layers:
    """The arrays of flat colours, (n, 4), not premultiplied, and the groups that they are in."""
    zeros, false = np.zeros(len(rgba), np.int64), np.zeros(len(rgba), np.bool_)
    return Layers(
        zeros,
        np.hstack([rgba[:, :3] * rgba[:, 3:], rgba[:, 3:]]),
        false,
        false,
        np.zeros(len(rgba), np.bool_),
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
        shades_of(()),
    )


def _looks(drawing: Drawing) -> NDArray[np.int64]:
    """A key for each path, one for those of one element."""
    elements, number = elements_of(drawing)
    return _keys(len(elements))[number]


def _keys(count: int) -> NDArray[np.int64]:
    """Numbers without pattern: SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators")."""
    z = np.arange(1, count + 1, dtype=np.uint64) * np.uint64(0x9E3779B97F4A7C15)
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return (z ^ (z >> np.uint64(31))).view(np.int64)
