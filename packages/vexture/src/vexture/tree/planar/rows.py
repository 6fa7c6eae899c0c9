"""The rows of a map: the paths of a drawing, each followed by the regions that cut its gradient into bands."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.split import copy_curve
from vexture.drawing.group import Blend
from vexture.tree.planar.bands import BANDS, CUBICS, GRADIENTS, REGIONS, STOPS, BandList, add_band, add_bands, new_bands
from vexture.tree.planar.shades import COUNT, FIRST, Shades
from vexture.tree.planar.source import BLEND, GRADIENT, MapSource

MARGIN: Final = 2.0**-10
"""Width by which the box for cutting a gradient exceeds its path, because their sides would coincide otherwise."""

ROOM: Final = 16
"""Bands for which a list has room at first."""

DODGE, BURN = int(Blend.COLOR_DODGE), int(Blend.COLOR_BURN)
HUE, LUMINOSITY = int(Blend.HUE), int(Blend.LUMINOSITY)
"""Blend modes that jump where a component of a colour is 0 or 1, or, from hue to luminosity, where the colour is grey.
This is mostly at stops."""


class Rows(NamedTuple):
    """Rows in painting order."""

    cubics: NDArray[np.float64]  # (n, 4, 2): of all rows
    owner: NDArray[np.int64]  # (n,): row of each cubic
    path: NDArray[np.int64]  # (rows,): path of each row
    cut: NDArray[np.int64]  # (rows,): row of the path that a region cuts; -1 for a path
    shade: NDArray[np.int64]  # (rows,): first of each path's `bands`, or -1
    bands: NDArray[np.int64]  # numbers of gradients and pictures; the bands of one path are consecutive
    shades: Shades
    reach: float  # largest coordinate of a region before it was clipped


@kernel
def rows_of(source: MapSource, restyle: int) -> Rows:
    """Rows of a drawing; if `restyle` is 1, they are just its paths, because colours that can be changed are flat."""
    paths = len(source.paths)
    sizes, first = np.zeros(paths, np.int64), np.full(paths, -1)
    for i in range(len(source.lengths)):
        sizes[source.path[i]] += source.lengths[i]
    found, box, regions, start = new_bands(ROOM), np.empty((2, 2)), np.zeros(paths, np.int64), 0
    at_all_stops = _jumps_at_stops(source)
    for p in range(paths):
        gradient = source.paths[p, GRADIENT]
        if gradient >= 0 and sizes[p] > 0:
            first[p] = found.counts[BANDS]
            before = found.counts[REGIONS]
            row = source.gradients[gradient].copy()
            stops = source.stops[int(row[FIRST]) : int(row[FIRST] + row[COUNT])].copy()
            if restyle == 1:
                found = add_band(found, row, stops)
            else:
                _set_box(source.cubics, start, start + sizes[p], box)
                found = add_bands(found, row, stops, box, at_all_stops)
            regions[p] = found.counts[REGIONS] - before
        start += sizes[p]
    return _in_order(source, sizes, first, regions, found)


@kernel(allocates=False)
def _jumps_at_stops(source: MapSource) -> int:
    """Return 1 if any group has a blend mode that jumps, else 0."""
    for g in range(len(source.groups)):
        blend = source.groups[g, BLEND]
        if blend in (DODGE, BURN) or HUE <= blend <= LUMINOSITY:
            return 1
    return 0


@kernel(allocates=False)
def _set_box(cubics: NDArray[np.float64], start: int, end: int, box: NDArray[np.float64]) -> None:
    """Write the box of some cubics with a margin, least and greatest coordinates, within the unit square."""
    for axis in range(2):
        low, high = np.inf, -np.inf
        for i in range(start, end):
            for k in range(4):
                low, high = min(low, cubics[i, k, axis]), max(high, cubics[i, k, axis])
        box[0, axis], box[1, axis] = min(max(low - MARGIN, 0.0), 1.0), min(max(high + MARGIN, 0.0), 1.0)


@kernel
def _in_order(
    source: MapSource,
    sizes: NDArray[np.int64],
    first: NDArray[np.int64],
    regions: NDArray[np.int64],
    found: BandList,
) -> Rows:
    """Put the regions between the paths; `sizes` to `regions` have an element for each path."""
    counts, cubics = found.counts, source.cubics
    rows, total = len(sizes) + counts[REGIONS], len(cubics) + counts[CUBICS]
    out = cubics if counts[REGIONS] == 0 else np.empty((total, 4, 2))
    owner, path, cut, shade = np.empty(total, np.int64), np.empty(rows, np.int64), np.full(rows, -1), np.full(rows, -1)
    row, end, start, region, at = 0, 0, 0, 0, 0
    for p in range(len(sizes)):
        path[row], shade[row] = p, first[p]
        for k in range(sizes[p]):
            owner[end] = row
            if counts[REGIONS] > 0:
                copy_curve(cubics[start + k], out[end])
            end += 1
        start += sizes[p]
        for k in range(regions[p]):
            path[row + 1 + k], cut[row + 1 + k] = p, row
            for _ in range(found.lengths[region]):
                owner[end] = row + 1 + k
                copy_curve(found.cubics[at], out[end])
                end, at = end + 1, at + 1
            region += 1
        row += 1 + regions[p]
    shades = Shades(found.rows[: counts[GRADIENTS]], found.stops[: counts[STOPS]], source.pixels)
    return Rows(out, owner, path, cut, shade, found.bands[: counts[BANDS]], shades, found.reach[0])
