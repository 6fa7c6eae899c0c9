"""Pick the paint or the element of the drawing at a point of a planar map (FORMAT.md, D.7)."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vexture.base.errors import ParameterError
from vexture.base.kernels import kernel
from vexture.base.layout import (
    CELL_BITS,
    COORDINATE_BITS,
    COUNT_SHIFT,
    IS_MEAN,
    LATTICE,
    MOST_CURVES,
    MOST_DEPTH,
    QUAD_FLAG,
)
from vexture.renderers.gradient import VextureRegion, program
from vexture.texture.contains import checked_points
from vexture.texture.curves import read_leaf_curve, texels_of_cell
from vexture.texture.numbers import means_place, read_base, read_sides
from vexture.texture.planar import head_of
from vexture.texture.root import Root
from vexture.tree.crossings import x_at
from vexture.tree.planar.style import PlanarStyle

BYTE = (1 << CELL_BITS) - 1

LEAST_OPACITY = 1e-6
"""Steps of 1/65535. A picture's mean over a tiny box may be less than this where it is transparent, by rounding."""


class Elements(NamedTuple):
    """The topmost element at each of some points."""

    name: NDArray[np.str_]  # (n,): empty at points without an element, and for an element without a name
    element: NDArray[np.int64]  # (n,): its index in the `names` of its shape's style; -1 without an element
    root: NDArray[np.int64]  # (n,): index of its shape; -1 without an element


@kernel
def _tally(ids: NDArray[np.int64], counts: NDArray[np.int64], n: int, paint: int, by: int) -> int:
    """Add `by` to the count of a paint; return the number of distinct paints."""
    for k in range(n):
        if ids[k] == paint:
            counts[k] += by
            return n
    ids[n], counts[n] = paint, by
    return n + 1


@kernel
def _times(curve: NDArray[np.float64], x: float, y: float) -> int:
    """Number that a leaf's curve adds to the count of its left paint at a point and subtracts from its right one's."""
    start, end = curve[0, 1], curve[3, 1]
    times = 0
    if curve[0, 0] == 0.0 and start <= y:
        times += 1
    if curve[3, 0] == 0.0 and end <= y:
        times -= 1
    if start <= y < end:
        low, high = min(curve[0, 0], curve[3, 0]), max(curve[0, 0], curve[3, 0])
        if high <= x or (low <= x and x_at(curve, y) <= x):
            times -= 1
    return times


@kernel
def _paint_at(
    flat: NDArray[np.uint32],
    root: int,
    x: float,
    y: float,
    curve: NDArray[np.float64],
    tally: NDArray[np.int64],
) -> int:
    """Paint at a point of the unit square; in a leaf with only a mean, -2 minus the index of its word in the cells."""
    quad = root
    for _ in range(MOST_DEPTH):
        right, upper = 1 if x >= 0.5 else 0, 1 if y >= 0.5 else 0
        x, y = 2.0 * x - right, 2.0 * y - upper
        quads, curves, texels, cell, place = 0, 0, 0, 0, right + 2 * upper
        for k in range(place + 1):
            quads += cell // QUAD_FLAG
            curves += cell >> COUNT_SHIFT & MOST_CURVES
            texels += texels_of_cell(cell)
            cell = int(flat[quad, 2]) >> CELL_BITS * k & BYTE
        if cell >= QUAD_FLAG:
            quad = int(flat[quad, 0]) + quads
            continue
        if cell == IS_MEAN:
            return -2 - (4 * means_place(flat, root, quad) + place)
        first, number, n = int(flat[quad, 1]) + texels, int(flat[quad, 3]) + curves, 1
        tally[0, 0], tally[1, 0] = read_base(flat, root, quad, place), 1
        for i in range(cell >> COUNT_SHIFT):
            read_leaf_curve(flat, first, cell, i, curve)
            times = _times(curve, LATTICE * x, LATTICE * y)
            if times != 0:
                left, right = read_sides(flat, root, number + i)
                n = _tally(tally[0], tally[1], n, left, times)
                n = _tally(tally[0], tally[1], n, right, -times)
        for k in range(n):
            if tally[1, k] > 0:
                return int(tally[0, k])
        return -1
    return -1


@kernel
def paints_at(
    flat: NDArray[np.uint32],
    root: int,
    points: NDArray[np.float64],
    paints: NDArray[np.int64],
) -> None:
    """Write to `paints` the paint at each point (m, 2), in unit-square units, of a valid planar map.

    The paint is -1 outside 0 <= x < 1, 0 <= y < 1. In a leaf with only a mean, it is -2 minus the index of the mean's
    word in the cells.
    """
    curve, tally = np.empty((4, 2)), np.empty((2, 2 * MOST_CURVES + 1), np.int64)
    for i in range(len(points)):
        x, y = points[i, 0], points[i, 1]
        known = 0.0 <= x < 1.0 and 0.0 <= y < 1.0
        paints[i] = _paint_at(flat, root, x, y, curve, tally) if known else -1


@kernel
def programs_paint(
    texels: NDArray[np.uint32], words: NDArray[np.uint32], points: NDArray[np.float64], painted: NDArray[np.bool_]
) -> None:
    """Write to `painted` (n,) whether program k, of a paint with `words[k]`, paints anything at point k."""
    for k in range(len(points)):
        point = VextureRegion((points[k, 0], points[k, 1]), (0.0, 0.0), (0.0, 0.0))
        painted[k] = program(texels, int(words[k, 0]), int(words[k, 1]), point, 1.0)[3] > LEAST_OPACITY


def painted_at(texels: NDArray[np.uint32], root: Root, points: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return whether the planar map of a root paints anything at points (n, 2); texels are (rows, columns, 4)."""
    flat = texels.reshape(-1, 4)
    head, found = head_of(flat, root.quad), np.empty(len(points), np.int64)
    paints_at(flat, root.quad, points, found)
    words = flat[head.paint_texels].reshape(-1, 2)[np.maximum(found, 0)]
    opacity = words[:, 1] >> COORDINATE_BITS
    painted: NDArray[np.bool_] = (found >= 0) & (opacity > 0)
    of_means = found < -1
    painted[of_means] = flat[head.cells :].ravel()[-2 - found[of_means]] >> 3 * CELL_BITS > 0
    of_programs = (found >= 0) & (opacity == 0) & (words[:, 0] != 0)
    if of_programs.any():
        results = np.empty(np.count_nonzero(of_programs), np.bool_)
        programs_paint(texels, words[of_programs], points[of_programs], results)
        painted[of_programs] = results
    return painted


def style_of_root(root: Root) -> PlanarStyle:
    """Style of a shape; raises a `ParameterError` if it has none."""
    if root.style is None:
        raise ParameterError(f"`root` {root.name!r} has no elements; convert the drawing with `restyle`")
    return root.style


def elements_at(flat: NDArray[np.uint32], roots: Sequence[Root], places: Sequence[int], points: ArrayLike) -> Elements:
    """Topmost element at points (n, 2) of a drawing's sheets, which are listed from below."""
    locations = checked_points(points)
    element, owner = np.full(len(locations), -1), np.full(len(locations), -1)
    name = np.full(len(locations), "", dtype=np.object_)
    for place in reversed(places):
        root = roots[place]
        style = style_of_root(root)
        paints, bare = np.empty(len(locations), np.int64), element < 0
        paints_at(flat, root.quad, locations, paints)
        paints, top = np.maximum(paints, -1), np.append(style.top, -1)  # the last entry is for paint -1
        here = bare & (top[paints] >= 0)
        element[here], owner[here] = top[paints[here]], place
        name[here] = np.array([*style.names, ""], dtype=np.object_)[element[here]]
    return Elements(name.astype(np.str_), element, owner)
