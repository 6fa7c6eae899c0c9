"""The way of a coloured drawing from outlines to texels in one kernel, for callers without Python.

In Python, `build_map` and `map_texels` call the same kernels one by one, and look at the clock between them.
"""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import MOST_PAINTS
from vexture.base.tolerance import CLOSED
from vexture.drawing.unit_square import FARTHEST
from vexture.texture.map_texels import encode_map
from vexture.tree.bounds import Bounds
from vexture.tree.cubics import are_finite
from vexture.tree.growth import CURVES, QUADS, UNRESOLVED, WAITING
from vexture.tree.planar.build import grow_map, plant_map
from vexture.tree.planar.map import arrange_map, texels_of
from vexture.tree.planar.source import MapSource

MapAnswer = tuple[
    NDArray[np.uint32], NDArray[np.int64], NDArray[np.int32], NDArray[np.int64],
    float, float, float, int, int, int, int, int,
]  # fmt: skip
"""Texels; where the stack of each paint begins; paths in all stacks; 1 for each path that hides something, else 0; how
far the outline leaves the unit square; largest coordinate of a band of a gradient; deviation; unresolved leaves; quads;
curves; paints; flattened paints."""


@kernel
def coloured_texels(
    source: MapSource, bounds: Bounds, restyle: int, first: int, most_texels: int, most_work: int
) -> MapAnswer:
    """Texels of a planar map from the arrays of a drawing, its stacks for restyling, and numbers about it.

    `first` is the index of the first texel. There are no texels if the outline leaves the square by more than `CLOSED`,
    which is NaN if a coordinate is not finite, if a band of a gradient goes beyond `FARTHEST`, or if there would be
    more than `bounds.most_quads` quads, `most_texels` texels of quads and curves, or `MOST_PAINTS` paints. The numbers
    tell which. There are none either if the map takes more than `most_work`, in units of `grow_map`, which leaves 0
    paints, or if its programs do not fit.
    """
    growth, layers, faces, outside, reach = plant_map(source, bounds.max_depth, restyle)
    outside = outside if are_finite(source.cubics) else np.nan
    texels, starts, members = np.zeros((0, 4), np.uint32), np.zeros(1, np.int64), np.zeros(0, np.int32)
    paints, flattened = 0, 0
    if outside <= CLOSED and reach <= FARTHEST:
        growth, faces = grow_map(growth, layers, faces, bounds, most_texels, most_work, 0)
        quads, curves = growth.tree.counts[QUADS], growth.tree.counts[CURVES]
        is_within = quads <= bounds.most_quads and texels_of(quads, curves) <= most_texels  # or the last cell was large
        if growth.tree.counts[WAITING] == 0 and is_within:
            arrays, starts, members, flattened = arrange_map(growth, layers, faces)
            paints = len(arrays.paints)
            if paints <= MOST_PAINTS:
                texels = encode_map(arrays, first)
    hides = np.zeros(len(layers.hides), np.int64)
    for k in range(len(hides)):
        hides[k] = 1 if layers.hides[k] else 0
    counts, deviation = growth.tree.counts, growth.tree.deviation[0]
    numbers = (outside, reach, deviation, counts[UNRESOLVED], counts[QUADS], counts[CURVES], paints, flattened)
    return texels, starts, members, hides, *numbers
