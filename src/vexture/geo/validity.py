"""Polygons whose rings cross or touch become valid ones: one home of how, and of its cost."""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

__all__ = ["made_valid"]

MANY_HOLES: Final = 500
"""Holes above which GEOS's own repair is not used: minutes for all lakes of a continent, by the square of their number."""


def made_valid(shapes: NDArray[Any]) -> NDArray[Any]:
    """Valid geometries with the area of polygons: that of their outer rings without that of their holes.

    What is valid already comes back with the same area. Raises a `shapely.errors.GEOSException` for what cannot be
    repaired.

    Examples
    --------
    >>> import shapely
    >>> bow = shapely.Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
    >>> found = made_valid(np.array([bow]))[0]
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


def _by_rings(shape: Any) -> Any:
    """The same, ring by ring, with the holes of each part of the plane united by themselves."""
    import shapely

    rings = shapely.polygons(shapely.get_rings(shape))
    wrong = ~shapely.is_valid(rings)
    rings[wrong] = shapely.make_valid(rings[wrong], method="structure", keep_collapsed=False)
    outer = rings[0]
    shapely.prepare(outer)
    reaches = shapely.intersects(outer, rings[1:])
    whole = shapely.difference(outer, shapely.disjoint_subset_union_all(rings[1:][reaches]))
    # a hole outside is land: so GEOS's own repair has it
    return shapely.union_all([whole, *rings[1:][~reaches]]) if not reaches.all() else whole
