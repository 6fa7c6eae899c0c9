"""Repair polygons whose rings cross or touch, in limited time."""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

MANY_HOLES: Final = 500
"""Holes above which GEOS's repair is not used: quadratic in them, it takes minutes for a continent's lakes."""

HEAVY: Final = 2e7
"""Holes times corners of the outer ring above which a polygon is split: GEOS checks each hole against each corner, also
to test whether a polygon is valid, and whether it fits its neighbours."""


def is_heavy(shapes: NDArray[Any]) -> NDArray[np.bool_]:
    """Mark polygons that must be split before any other operation."""
    import shapely

    holes = shapely.get_num_interior_rings(shapes)
    corners = shapely.get_num_points(shapely.get_exterior_ring(shapes))
    heavy: NDArray[np.bool_] = holes.astype(np.float64) * corners > HEAVY
    return heavy


def split_heavy(shape: Any) -> list[Any]:
    """Split the polygons of a valid geometry into adjacent parts until none is heavy."""
    import shapely

    waiting, done = list(shapely.get_parts(shapely.get_parts(shape))), []
    while waiting:
        part = waiting.pop()
        if not is_heavy(np.array([part]))[0]:
            done.append(part)
            continue
        west, south, east, north = part.bounds
        x, y = (west + east) / 2.0, (south + north) / 2.0
        if east - west > north - south:
            halves = [(west, south, x, north), (x, south, east, north)]
        else:
            halves = [(west, south, east, y), (west, y, east, north)]
        for half in halves:
            waiting.extend(_clip_polygon(part, half))
    return done


def _clip_polygon(shape: Any, box: tuple[float, float, float, float]) -> NDArray[Any]:
    """Clip a valid polygon to a box; holes within the box are assigned to the part that contains them, not cut.

    GEOS would compare each hole with each corner to find that part, which takes ten times as long.
    """
    import shapely

    rings = shapely.get_rings(shape)
    bounds = shapely.bounds(rings[1:]).reshape(-1, 4)
    inside = (bounds[:, :2] > box[:2]).all(axis=1) & (bounds[:, 2:] < box[2:]).all(axis=1)
    apart = (bounds[:, :2] >= box[2:]).any(axis=1) | (bounds[:, 2:] <= box[:2]).any(axis=1)
    holes = rings[1:][inside]
    shell = shapely.polygons(rings[0], rings[1:][~inside & ~apart])
    parts = shapely.get_parts(shapely.clip_by_rect(shell, *box))
    points = shapely.STRtree(shapely.point_on_surface(shapely.polygons(holes)))
    part, hole = points.query(parts, predicate="contains")
    for place in np.unique(part).tolist():
        own = [*shapely.get_rings(parts[place])[1:], *holes[hole[part == place]]]
        parts[place] = shapely.polygons(shapely.get_exterior_ring(parts[place]), own)
    return np.asarray(parts)


def make_valid(shapes: NDArray[Any]) -> NDArray[Any]:
    """Make polygons valid, with the area of their outer rings minus that of their holes.

    Valid polygons keep their area. Raises a `shapely.errors.GEOSException` for a polygon that cannot be repaired.
    repaired.

    Examples
    --------
    >>> import shapely
    >>> bow = shapely.Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
    >>> found = make_valid(np.array([bow]))[0]
    >>> found.is_valid, round(found.area, 9)
    (True, 2.0)
    """
    import shapely

    many = shapely.get_num_interior_rings(shapes) > MANY_HOLES
    made = np.empty(len(shapes), object)
    made[~many] = shapely.make_valid(shapes[~many], method="structure", keep_collapsed=False)
    for place in np.flatnonzero(many).tolist():
        made[place] = _by_rings(shapes[place])
    return made


def unite_polygons(shapes: NDArray[Any]) -> Any:
    """Unite polygons, including those that clipping has left with a corner on a side."""
    import shapely

    try:
        return shapely.union_all(shapes)
    except shapely.errors.GEOSException:
        return shapely.union_all(make_valid(np.asarray(shapes, object)))


def _by_rings(shape: Any) -> Any:
    """Repair a polygon ring by ring; holes of each part of the plane are united separately."""
    import shapely

    rings = shapely.polygons(shapely.get_rings(shape))
    wrong = ~shapely.is_valid(rings)
    rings[wrong] = shapely.make_valid(rings[wrong], method="structure", keep_collapsed=False)
    outer = rings[0]
    shapely.prepare(outer)
    reaches = shapely.intersects(outer, rings[1:])
    whole = shapely.difference(outer, shapely.disjoint_subset_union_all(rings[1:][reaches]))
    if reaches.all():
        return whole
    # a hole outside counts as land, as in GEOS's own repair
    parts = shapely.get_parts([whole, shapely.union_all(rings[1:][~reaches])])
    return shapely.multipolygons(parts[~shapely.is_empty(parts)])
