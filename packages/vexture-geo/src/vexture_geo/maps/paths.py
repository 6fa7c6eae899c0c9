"""Paths of a map: the polygons of each feature as one path in the unit square, without an object per vertex."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.contours import ring_contours
from vexture.drawing.drawing import FillRule, Path
from vexture.drawing.paint import Paint
from vexture_geo.base.extent import Bounds
from vexture_geo.base.rings import Rings, orient_rings


class MapFit:
    """Transform of a map's box to the middle of the unit square, at its own aspect ratio."""

    def __init__(self, box: Bounds) -> None:
        west, south, east, north = box
        self.scale = max(east - west, north - south)
        self.low = np.array([(west + east) / 2, (south + north) / 2]) - self.scale / 2
        self.sides = ((east - west) / self.scale, (north - south) / self.scale)

    @property
    def to_source(self) -> NDArray[np.float64]:
        """Return the matrix from the unit square to the units of the map."""
        return np.array([[self.scale, 0.0, self.low[0]], [0.0, self.scale, self.low[1]]])

    def inward(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Transform points to the unit square."""
        return np.clip((points - self.low) / self.scale, 0.0, 1.0)


def area_paths(
    rings: Rings, names: NDArray[Any], rgba: NDArray[np.float64], rank: NDArray[np.int64], fit: MapFit
) -> Iterator[Path]:
    """Make a path of each feature's polygons, in the order of the ranks."""
    if not len(rings.ends):
        return
    rings = orient_rings(rings)
    assert rings.feature is not None
    contours = ring_contours(fit.inward(rings.points), rings.ends)
    owner = rings.feature[rings.polygon]
    order = np.argsort(rank[owner], kind="stable")
    ends = np.append(np.flatnonzero(np.diff(rank[owner][order])) + 1, len(order))
    first, places = 0, order.tolist()
    features = owner[order[np.append(0, ends[:-1]).astype(np.intp)]]
    paints: dict[tuple[float, ...], Paint] = {}
    named = zip(ends.tolist(), names[features].tolist(), map(tuple, rgba[features].tolist()), strict=True)
    for end, name, colour in named:
        paint = paints.get(colour) or paints.setdefault(colour, Paint(colour[:3], colour[3]))
        own = tuple(contours[place] for place in places[first:end])
        yield Path.unchecked(own, FillRule.NONZERO, paint, element=str(name))
        first = end
