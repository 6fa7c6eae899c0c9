"""The layers of a drawing, as arrays: what its faces are composited of."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import Drawing
from vexture.paint import Gradient
from vexture.tree.planar.shades import Shades, shades_of

__all__ = ["Layers", "gradients_of", "layers_of"]


class Layers(NamedTuple):
    """What faces are composited of. The first arrays have a row for each path, in painting order."""

    rules: NDArray[np.int64]
    rgba: NDArray[np.float64]  # (paths, 4), premultiplied; of a gradient its mean
    opaque: NDArray[np.bool_]
    shade: NDArray[np.int64]  # number of each path's gradient, or -1
    keys: NDArray[np.int64]
    group: NDArray[np.int64]  # innermost group of each path, or -1
    outer: NDArray[np.int64]  # of each group: the group around it, or -1
    depth: NDArray[np.int64]  # of each group: how many there are around it
    opacity: NDArray[np.float64]
    blend: NDArray[np.int64]
    shades: Shades


def gradients_of(drawing: Drawing) -> tuple[Gradient, ...]:
    """The different gradients of a drawing's paints, numbered as in `Layers.shade`."""
    found = (path.paint.gradient for path in drawing.paths)
    return tuple(dict.fromkeys(gradient for gradient in found if gradient is not None))


def layers_of(drawing: Drawing) -> Layers:
    """The arrays of a drawing."""
    paints = [path.paint for path in drawing.paths]
    opacity = np.array([paint.opacity for paint in paints]).reshape(-1, 1)
    colour = np.array([paint.color for paint in paints]).reshape(-1, 3)
    groups, numbers = drawing.groups, {gradient: k for k, gradient in enumerate(gradients_of(drawing))}
    return Layers(
        np.array([int(path.fill_rule) for path in drawing.paths], np.int64),
        np.hstack([colour * opacity, opacity]),
        np.array([paint.is_opaque for paint in paints], np.bool_),
        np.array([-1 if paint.gradient is None else numbers[paint.gradient] for paint in paints], np.int64),
        _keys(len(paints)),
        np.array([path.group for path in drawing.paths], np.int64),
        np.array([group.outer for group in groups], np.int64),
        np.array([len(drawing.around(place)) - 1 for place in range(len(groups))], np.int64),
        np.array([group.opacity for group in groups], np.float64),
        np.array([int(group.blend) for group in groups], np.int64),
        shades_of(tuple(numbers)),
    )


def _keys(count: int) -> NDArray[np.int64]:
    """Numbers without pattern: SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators")."""
    z = np.arange(1, count + 1, dtype=np.uint64) * np.uint64(0x9E3779B97F4A7C15)
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return (z ^ (z >> np.uint64(31))).view(np.int64)
