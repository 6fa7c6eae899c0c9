"""The area under water in a grid of depths, with a shoreline that is more precise than the grid."""

import warnings
from collections.abc import Callable, Iterable
from itertools import pairwise
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.tolerance import HMIN
from vexture.bezier.points import points_along
from vexture.drawing.drawing import Drawing, FillRule, Path

TOLERANCE: Final = 0.55
"""Cells. Largest distance of the fitted shoreline from the contour; steps of a raster are half a cell high."""

THIN: Final = 0.1
"""Fraction of the least depth below which depths are unknown, because models leave thin films on dry ground."""

RETRY: Final = (1.0, 0.3, 0.05)
"""Fractions of the tolerance, tried in turn until the fitted rings of a polygon do not intersect."""

REACH, STRIP = 2, 256
"""Cells on each side that affect a value at the shore; rows processed at once."""

STRAIGHT: Final = ((0, 1), (0, -1), (1, 0), (-1, 0))
DIAGONAL: Final = ((1, 1), (1, -1), (-1, 1), (-1, -1))


class Ring(NamedTuple):
    """A closed ring in the unit square: points, (n, 2), of which the first is not repeated at the end.

    `cell` is the size of the cells that the ring passes; tolerances are multiples of it. Fitting keeps the points that
    are `fixed`, as corners.
    """

    points: NDArray[np.float64]
    cell: float
    fixed: NDArray[np.bool_]


Map = Callable[[NDArray[np.float64]], NDArray[np.float64]]


def shore_values(
    depth: NDArray[np.float64], hmin: float = HMIN, bed: NDArray[np.float64] | None = None
) -> NDArray[np.float64]:
    """Depths less `hmin`, negative on land, so that linear interpolation gives 0 at the shore.

    A raster of depths holds 0 or NaN on land. Interpolation between its samples would put the shore nearly at the
    middle of the first dry cell, too far inland. Each dry cell beside a wet one gets a negative depth instead:

    - where the bed's height is known: the water level of its wet neighbours minus its own bed;
    - otherwise: the depth extrapolated from the two nearest wet cells;
    - at a wall, where neither shows that the ground rises: the value that puts the shore halfway between the cells.

    All values are in metres. NaN is unknown; it counts as dry, as do depths below `hmin`.

    Examples
    --------
    >>> shore_values(np.array([[2.0, 1.0, 0.0], [2.0, 1.0, 0.0]]), 0.4)[0]  # a beach that falls by 1 in a cell
    array([ 1.6,  0.6, -0.4])
    """
    strips = []
    for first in range(0, max(1, len(depth)), STRIP):  # in strips, for little memory
        part = slice(max(0, first - REACH), first + STRIP + REACH)
        strip = _strip_values(depth[part], hmin, None if bed is None else bed[part])
        strips.append(strip[first - part.start :][:STRIP])
    return np.concatenate(strips)


def _strip_values(depth: NDArray[np.float64], hmin: float, bed: NDArray[np.float64] | None) -> NDArray[np.float64]:
    """Compute `shore_values`, each of which depends on cells at most `REACH` rows away."""
    known, above = above_dry(depth, hmin)
    wet = known & (above >= 0.0)
    rows, columns = depth.shape
    wet_padded, above_padded = np.pad(wet, REACH, mode="edge"), np.pad(above, REACH, mode="edge")
    bed_padded = None if bed is None else np.pad(bed, REACH, mode="edge")

    def beside(grid: NDArray[Any], down: int, across: int) -> NDArray[Any]:
        return grid[REACH + down : REACH + down + rows, REACH + across : REACH + across + columns]

    total, count = np.zeros(depth.shape), np.zeros(depth.shape)
    for neighbours in (STRAIGHT, DIAGONAL):  # diagonal neighbours only if there are no others
        found, times = np.zeros(depth.shape), np.zeros(depth.shape)
        for down, across in neighbours:
            first = beside(above_padded, down, across)
            if bed is not None and bed_padded is not None:
                reached = first + beside(bed_padded, down, across) - bed
                estimate = np.where(reached < 0.0, reached, -first)  # -first: a wall, halfway
            else:
                far = 2 * down, 2 * across
                estimate = _sloping(first, np.where(beside(wet_padded, *far), beside(above_padded, *far), first))
            shore = beside(wet_padded, down, across) & ~known
            found += np.where(shore, estimate, 0.0)
            times += shore
        fresh = count == 0.0
        total, count = np.where(fresh, found, total), np.where(fresh, times, count)
    filled = np.where(count > 0.0, total / np.maximum(count, 1.0), -1.0)
    return np.where(known, above, np.minimum(filled, -1e-6))


def above_dry(depth: NDArray[np.float64], hmin: float) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Return which depths are known and more than a film, and the depths minus `hmin`."""
    with np.errstate(invalid="ignore"):
        known = np.isfinite(depth) & ((depth > THIN * hmin) | (depth < 0.0))
    return known, np.where(known, depth, 0.0) - hmin


def _sloping(first: NDArray[np.float64], behind: NDArray[np.float64]) -> NDArray[np.float64]:
    """Extrapolate the depth beyond the first cell from the cell behind it; all depths are minus the least depth.

    Where a flat bottom would put the shore more than one cell away, it moves towards halfway, as at a wall.
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
    """Draw the area where a grid of `shore_values` is above 0, with its outline fitted by cubics.

    `to_unit` maps positions in the grid, (n, 2) columns and rows, to the unit square. The border values extend `beyond`
    the grid's left, first, right and last edge by these numbers of cells. The tolerance is in cells.
    """
    left, first, right, last = beyond
    border = (-0.5 - left, -0.5 - first, above.shape[1] - 0.5 + right, above.shape[0] - 0.5 + last)
    polygons = [
        [Ring(to_unit(ring), _cell(ring, to_unit), _ends(ring, border)) for ring in polygon]
        for polygon in _polygons(above, border)
    ]
    return fit_drawing(polygons, tolerance)


def fit_drawing(polygons: Iterable[list[Ring]], tolerance: float = TOLERANCE) -> Drawing:
    """Draw polygons, clipped to the unit square, with their rings fitted by cubics within `tolerance` cells.

    The rings of a polygon do not intersect; its outer ring comes first, and holes have the opposite orientation.
    """
    contours = [contour for polygon in polygons for contour in _fit_polygon(polygon, tolerance)]
    if not contours:
        return Drawing(())
    turned = tuple(contour * (1.0, -1.0) + (0.0, 1.0) for contour in contours)
    return Drawing.from_source([Path(turned, FillRule.NONZERO)], (0.0, 0.0, 1.0, 1.0))


def _polygons(above: NDArray[np.float64], border: tuple[float, float, float, float]) -> list[list[NDArray[np.float64]]]:
    """Rings of each wet area in positions of the grid, the outer ring first; no ring repeats its first point."""
    import contourpy

    left, first, right, last = border
    x = np.concatenate([[left], np.arange(above.shape[1]), [right]])
    y = np.concatenate([[first], np.arange(above.shape[0]), [last]])
    generator = contourpy.contour_generator(x=x, y=y, z=np.pad(above, 1, mode="edge"), fill_type="OuterOffset")
    points: list[NDArray[np.float64]]
    offsets: list[NDArray[np.uint32]]
    points, offsets = generator.filled(0.0, np.inf)  # type: ignore[misc,assignment]
    return [[ring[a : b - 1] for a, b in pairwise(cut.tolist())] for ring, cut in zip(points, offsets, strict=True)]


def _fit_polygon(polygon: list[Ring], tolerance: float) -> list[NDArray[np.float64]]:
    """Fit a polygon's rings by cubics that intersect neither themselves nor one another."""
    from vexture.bezier.fit_closed import fit_closed

    for share in RETRY:
        fitted = [fit_closed(ring.points, share * tolerance * ring.cell, fixed=ring.fixed) for ring in polygon]
        fitted = [contour for contour in fitted if len(contour)]
        if _apart(fitted):
            break
    return fitted


def _ends(ring: NDArray[np.float64], border: tuple[float, float, float, float]) -> NDArray[np.bool_]:
    """Find points where a ring reaches the border of the grid, or a corner of it."""
    sides = np.concatenate([ring == border[:2], ring == border[2:]], axis=1)
    passing = sides & np.roll(sides, 1, axis=0) & np.roll(sides, -1, axis=0)  # between points on the same side
    found: NDArray[np.bool_] = sides.any(axis=1) & ~(passing.any(axis=1) & (sides.sum(axis=1) == 1))
    return found


def _cell(ring: NDArray[np.float64], to_unit: Map) -> float:
    """Smaller side of the smallest cell that a ring passes, in the unit square."""
    some = ring[:: max(1, len(ring) // 64)]
    sides = [np.hypot(*(to_unit(some + step) - to_unit(some - step)).T) for step in ([0.5, 0.0], [0.0, 0.5])]
    return float(np.min(sides))


def _apart(contours: list[NDArray[np.float64]]) -> bool:
    """Return whether the first contour, with the others as holes, is a valid polygon."""
    import shapely

    if not contours:
        return True
    shares = np.arange(16) / 16.0
    rings = [points_along(contour, shares).reshape(-1, 2) for contour in contours]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return bool(shapely.is_valid(shapely.Polygon(rings[0], rings[1:])))
