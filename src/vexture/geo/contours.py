"""The area under water in a grid of depths, with a shoreline that is finer than the grid."""

import warnings
from collections.abc import Callable, Iterable
from itertools import pairwise
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.points import points_along
from vexture.drawing import Drawing, FillRule, Path
from vexture.tolerance import HMIN

__all__ = ["THIN", "TOLERANCE", "Ring", "fitted_drawing", "shored", "wet_drawing"]

TOLERANCE: Final = 0.55
"""Cells. Most that the fitted shoreline may leave the contour: the staircase of a raster is half a cell high."""

THIN: Final = 0.1
"""Share of the least depth below which a depth is none: models leave films on what is dry."""

RETRY: Final = (1.0, 0.3, 0.05)
"""Shares of the tolerance, tried until the rings of a polygon stay apart."""


class Ring(NamedTuple):
    """A closed ring in the unit square.

    Attributes
    ----------
    points : (n, 2) float64 array
        The first is not repeated at the end.
    cell : float
        Size of the cells that it passes: tolerances are shares of it.
    fixed : (n,) bool array
        Points that stay where they are, as corners.
    """

    points: NDArray[np.float64]
    cell: float
    fixed: NDArray[np.bool_]


Map = Callable[[NDArray[np.float64]], NDArray[np.float64]]


def shored(
    depth: NDArray[np.float64], hmin: float = HMIN, bed: NDArray[np.float64] | None = None
) -> NDArray[np.float64]:
    """Depths less `hmin` that go on below 0 where land begins, so that they pass 0 at the shore.

    A raster of depths says 0, or nothing, on land: straight lines between its samples put the shore too far out,
    nearly at the middle of the first dry cell. Each dry cell beside a wet one gets a depth below 0 instead:

    - where the bed's height is known: the water level of its wet neighbours less its own bed;
    - else as the depth falls from the second wet cell to the first;
    - halfway between the two cells where neither says that the ground is higher: at a wall.

    Parameters
    ----------
    depth : (rows, columns) array
        Metres; NaN where nothing is known, which counts as dry.
    hmin : float
        Metres; what is under less is dry.
    bed : array, optional
        Height of the bed.

    Examples
    --------
    >>> shored(np.array([[2.0, 1.0, 0.0], [2.0, 1.0, 0.0]]), 0.4)[0]  # a beach that falls by 1 in a cell
    array([ 1.6,  0.6, -0.4])
    """
    with np.errstate(invalid="ignore"):
        known = np.isfinite(depth) & ((depth > THIN * hmin) | (depth < 0.0))
    above = np.where(known, depth, 0.0) - hmin
    wet = known & (above >= 0.0)
    rows, columns = depth.shape
    total, count = np.zeros(depth.shape), np.zeros(depth.shape)
    for straight in (True, False):  # diagonal neighbours only where there are no others
        found, times = np.zeros(depth.shape), np.zeros(depth.shape)
        for down, across in ((0, 1), (0, -1), (1, 0), (-1, 0)) if straight else ((1, 1), (1, -1), (-1, 1), (-1, -1)):
            r0, r1 = max(0, -down), min(rows, rows - down)
            c0, c1 = max(0, -across), min(columns, columns - across)
            here = (slice(r0, r1), slice(c0, c1))
            there = (slice(r0 + down, r1 + down), slice(c0 + across, c1 + across))
            shore = wet[there] & ~known[here]
            first = above[there]
            estimate = -first  # a wall, halfway
            if bed is not None:
                reached = first + bed[there] - bed[here]
                estimate = np.where(reached < 0.0, reached, estimate)
            else:
                behind_rows = np.clip(np.arange(r0, r1) + 2 * down, 0, rows - 1)[:, None]
                behind_columns = np.clip(np.arange(c0, c1) + 2 * across, 0, columns - 1)[None]
                behind = np.where(wet[behind_rows, behind_columns], above[behind_rows, behind_columns], first)
                estimate = _sloping(first, behind)
            found[here] += np.where(shore, estimate, 0.0)
            times[here] += shore
        fresh = count == 0.0
        total, count = np.where(fresh, found, total), np.where(fresh, times, count)
    filled = np.where(count > 0.0, total / np.maximum(count, 1.0), -1.0)
    return np.where(known, above, np.minimum(filled, -1e-6))


def _sloping(first: NDArray[np.float64], behind: NDArray[np.float64]) -> NDArray[np.float64]:
    """Depth of the dry neighbour of a cell from its own and that of the cell behind it, both less the least depth.

    The depth goes on as it falls there. Where it would reach farther than one cell, the flatter the bottom is, the
    more that is a wall, which is halfway.
    """
    slope = behind - first
    beach = slope >= first
    share = 0.5 + 0.5 * np.maximum(slope, 0.0) / np.where(first > 0.0, first, 1.0)
    return np.where(beach, -slope + first, first - first / np.where(beach, 1.0, share))


def wet_drawing(
    above: NDArray[np.float64],
    to_unit: Map,
    beyond: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0),
    tolerance: float = TOLERANCE,
) -> Drawing:
    """Area where a grid of values is above 0, its outline fitted by cubics.

    Parameters
    ----------
    above : (rows, columns) float64 array
        As `shored` gives it.
    to_unit : function
        From positions in the grid, (n, 2) columns and rows, to the unit square.
    beyond : tuple of float
        How many cells the outermost values go on beyond the grid's left, first, right and last edge.
    tolerance : float
        Cells.

    Examples
    --------
    >>> above = np.where(np.hypot(*np.mgrid[-8:9, -8:9]) < 5, 1.0, -1.0)
    >>> drawing = wet_drawing(above, lambda places: places / 16)
    >>> drawing.segments < 10
    True
    """
    border = _border(above.shape, beyond)
    polygons = [
        [Ring(to_unit(ring), _cell(ring, to_unit), _ends(ring, border)) for ring in polygon]
        for polygon in _polygons(above, border)
    ]
    return fitted_drawing(polygons, tolerance)


def fitted_drawing(polygons: Iterable[list[Ring]], tolerance: float = TOLERANCE) -> Drawing:
    """Polygons as a drawing, cut to the unit square, their rings fitted by cubics.

    Parameters
    ----------
    polygons : iterable of lists of Ring
        Of each, rings that are apart from one another: one outside, the others are its holes and turn the other way.
    tolerance : float
        Cells.
    """
    contours = [contour for polygon in polygons for contour in _fitted(polygon, tolerance)]
    if not contours:
        return Drawing(())
    turned = tuple(contour * (1.0, -1.0) + (0.0, 1.0) for contour in contours)
    return Drawing.from_source([Path(turned, FillRule.NONZERO)], (0.0, 0.0, 1.0, 1.0))


def _border(shape: tuple[int, ...], beyond: tuple[float, float, float, float]) -> tuple[float, float, float, float]:
    """Left, first, right and last position that values are at."""
    left, first, right, last = beyond
    return (-0.5 - left, -0.5 - first, shape[1] - 0.5 + right, shape[0] - 0.5 + last)


def _polygons(above: NDArray[np.float64], border: tuple[float, float, float, float]) -> list[list[NDArray[np.float64]]]:
    """Rings of each wet area, its outer one first, in positions of the grid, without the last point."""
    import contourpy

    left, first, right, last = border
    x = np.concatenate([[left], np.arange(above.shape[1]), [right]])
    y = np.concatenate([[first], np.arange(above.shape[0]), [last]])
    generator = contourpy.contour_generator(x=x, y=y, z=np.pad(above, 1, mode="edge"), fill_type="OuterOffset")
    points: list[NDArray[np.float64]]
    offsets: list[NDArray[np.uint32]]
    points, offsets = generator.filled(0.0, np.inf)  # type: ignore[misc,assignment]
    return [[ring[a : b - 1] for a, b in pairwise(cut.tolist())] for ring, cut in zip(points, offsets, strict=True)]


def _fitted(polygon: list[Ring], tolerance: float) -> list[NDArray[np.float64]]:
    """Cubics of a polygon's rings, which neither cross themselves nor one another."""
    from vexture.bezier.fit_closed import fit_closed

    for share in RETRY:
        fitted = [fit_closed(ring.points, share * tolerance * ring.cell, fixed=ring.fixed) for ring in polygon]
        fitted = [contour for contour in fitted if len(contour)]
        if _apart(fitted):
            break
    return fitted


def _ends(ring: NDArray[np.float64], border: tuple[float, float, float, float]) -> NDArray[np.bool_]:
    """Which points are where a ring meets the border of the grid, or a corner of it."""
    sides = np.concatenate([ring == border[:2], ring == border[2:]], axis=1)
    passing = sides & np.roll(sides, 1, axis=0) & np.roll(sides, -1, axis=0)  # amid points on the same side
    found: NDArray[np.bool_] = sides.any(axis=1) & ~(passing.any(axis=1) & (sides.sum(axis=1) == 1))
    return found


def _cell(ring: NDArray[np.float64], to_unit: Map) -> float:
    """Smaller side of the smallest cell that a ring passes, in the unit square."""
    some = ring[:: max(1, len(ring) // 64)]
    sides = [np.hypot(*(to_unit(some + step) - to_unit(some - step)).T) for step in ([0.5, 0.0], [0.0, 0.5])]
    return float(np.min(sides))


def _apart(contours: list[NDArray[np.float64]]) -> bool:
    """Whether the first contour, less the others as holes, is a valid polygon."""
    import shapely

    if not contours:
        return True
    rings = [_flattened(contour) for contour in contours]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return bool(shapely.is_valid(shapely.Polygon(rings[0], rings[1:])))


def _flattened(contour: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points along cubics, sixteen to each."""
    return points_along(contour, np.arange(16) / 16.0).reshape(-1, 2)
