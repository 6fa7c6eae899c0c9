"""The plain arrays of a drawing from which its planar map is built, in Python as in a browser."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing
from vexture.drawing.group import Group
from vexture.tree.cubics import outlines_of
from vexture.tree.planar.shades import Shade, shades_of
from vexture.tree.planar.style import elements_of

GROUP, GRADIENT, ELEMENT, HIDES = range(4)
"""Columns of a path: innermost group, or -1; gradient or picture, or -1; number of its element; 1 if it hides something
that the drawing leaves out, else 0."""

OUTER, BLEND, MASK = range(3)
"""Columns of a group: group around it, or -1; blend mode; property by which it masks the group around it, or 0."""

PATH_COLUMNS: Final = 4
GROUP_COLUMNS: Final = 3


class MapSource(NamedTuple):
    """A drawing as arrays. Rows of paths and groups are in the order of the drawing."""

    cubics: NDArray[np.float64]  # (n, 4, 2), as in `Outlines`
    lengths: NDArray[np.int64]  # (contours,)
    path: NDArray[np.int64]  # (contours,)
    rules: NDArray[np.int64]  # (paths,)
    paths: NDArray[np.int64]  # (paths, 4): `GROUP` to `HIDES`
    rgba: NDArray[np.float64]  # (paths, 4), not premultiplied; the mean of a gradient or picture
    groups: NDArray[np.int64]  # (groups, 3): `OUTER` to `MASK`
    opacities: NDArray[np.float64]  # (groups,)
    gradients: NDArray[np.float64]  # (gradients and pictures, 11): the rows of `Shades`
    stops: NDArray[np.float64]  # (stops, 5): the stops of `Shades`
    pixels: NDArray[np.uint32]  # those of `Shades`


def source_of(drawing: Drawing, restyle: bool = False) -> MapSource:
    """Plain arrays of a drawing; its elements have numbers only if its map is to be restyled."""
    number: dict[int, int] = {}  # by identity: equal gradients become one later, and hashing them takes long
    listed: list[Shade] = []
    rows: list[tuple[int, int, int, int]] = []
    colours: list[tuple[float, float, float, float]] = []
    for one in drawing.paths:
        paint = one.paint
        colours.append((*paint.color, paint.opacity))
        place = -1
        assert not paint.is_soft, "a blur is a picture here; see `vexture.tree.planar.blurs`"
        shade = paint.gradient or paint.picture
        if shade is not None:
            place = number.setdefault(id(shade), len(listed))
            if place == len(listed):
                listed.append(shade)
        rows.append((one.group, place, 0, one.hides))
    paths = np.array(rows, np.int64).reshape(-1, PATH_COLUMNS)
    if restyle:
        paths[:, ELEMENT] = elements_of(drawing)[1]
    rgba = np.array(colours, np.float64).reshape(-1, 4)
    shades = shades_of(listed)
    outlines, groups = outlines_of(drawing), group_arrays(drawing.groups)
    return MapSource(*outlines, paths, rgba, *groups, shades.rows, shades.stops, shades.pixels)


def group_arrays(groups: tuple[Group, ...]) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Columns (n, 3) and opacities (n,) of groups."""
    rows = np.array([(group.outer, group.blend, group.mask) for group in groups], np.int64)
    return rows.reshape(-1, GROUP_COLUMNS), np.array([group.opacity for group in groups], np.float64)
