"""Polygons around a pole, where longitudes have no inside: closed along the antimeridian, over the pole."""

from functools import reduce
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.geo.rings import FULL_TURN, Rings, rings_of

__all__ = ["closed_over_poles"]


def closed_over_poles(rings: Rings, turn: float) -> tuple[Rings, int]:
    """Rings of which none goes around a pole, and how many polygons had one; they come last.

    The area within a ring around a pole, in longitudes of period `turn`, is all that lies between it and that pole. A
    polygon is what an odd number of its rings hold: a coast and a circle near the pole are the land between them.
    Rings along the edge of a map are as they were.

    Examples
    --------
    >>> import shapely
    >>> ice = shapely.Polygon([(longitude, -70.0) for longitude in range(-170, 180, 20)])
    >>> found, count = closed_over_poles(rings_of(np.array([ice]), str), 360.0)
    >>> count, float(shapely.area(found.shapes)[0]), found.box
    (1, 7200.0, (-180.0, -90.0, 180.0, -70.0))
    """
    if not len(rings.ends):
        return rings, 0
    longitude = rings.points[:, 0]
    step = longitude[rings.following] - longitude
    turns = np.where(np.abs(step) > turn / 2, np.rint(step / turn), 0.0)
    net = np.add.reduceat(turns, rings.starts)
    edge = np.logical_or.reduceat(np.abs(step) >= turn * FULL_TURN, rings.starts)
    polar = np.zeros(len(rings.outer), np.bool_)
    polar[rings.polygon[(net != 0.0) & ~edge]] = True
    polar[rings.polygon[edge]] = False
    if not polar.any():
        return rings, 0
    places = np.flatnonzero(polar)
    made = np.array([_closed(rings, int(place), turns, turn) for place in places], object)
    import shapely

    parts, owner = shapely.get_parts(made, return_index=True)
    whole = places[owner]
    feature = None if rings.feature is None else rings.feature[whole]
    closed = rings_of(parts, lambda index: rings.place(int(whole[index])), feature)
    return rings.taken(np.flatnonzero(~polar)).joined(closed), len(places)


def _closed(rings: Rings, polygon: int, turns: NDArray[np.float64], turn: float) -> Any:
    """A polygon with its rings closed."""
    import shapely

    areas = []
    for ring in np.flatnonzero(rings.polygon == polygon):
        here = slice(rings.starts[ring], rings.ends[ring])
        area = shapely.Polygon(_over_pole(rings.points[here], turns[here], turn))
        areas.append(area if area.is_valid else shapely.make_valid(area, method="structure", keep_collapsed=False))
    return reduce(shapely.symmetric_difference, areas)


def _over_pole(points: NDArray[np.float64], turns: NDArray[np.float64], turn: float) -> NDArray[np.float64]:
    """Points of a ring without jumps; one around a pole goes on to the antimeridian, and over the pole back."""
    jumps = np.flatnonzero(turns)
    if len(jumps):  # it begins after a jump
        points, turns = np.roll(points, -1 - jumps[-1], axis=0), np.roll(turns, -1 - jumps[-1])
    before = np.cumsum(turns) - turns
    points = points - np.stack([turn * before, np.zeros(len(points))], axis=1)
    if turns.sum() == 0.0:
        return points
    along = -turns.sum() * turn  # to the east or to the west
    first, last = points[0], points[-1]
    border = -np.sign(along) * turn / 2
    gap = along + first[0] - last[0]
    share = (border + along - last[0]) / gap if gap else 0.0
    height = last[1] + share * (first[1] - last[1])
    pole = np.copysign(turn / 4, points[:, 1].mean())
    ends = [(border + along, height), (border + along, pole), (border, pole), (border, height)]
    return np.concatenate([points, ends])
