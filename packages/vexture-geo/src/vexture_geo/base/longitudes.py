"""Rings in longitudes, which repeat after a turn: unwrap them at the antimeridian, and close them over the poles."""

from dataclasses import dataclass, replace
from functools import reduce
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture_geo.base.rings import Rings, rings_of
from vexture_geo.base.validity import make_valid

FULL_TURN: Final = 1.0 - 1e-9
"""Turns. A side this long is meant to go around the world, along a pole or the edge of a map."""

CLEAR_JUMP: Final = 5.0 / 6.0
"""Turns. A shorter jump may also be a long side: borders that cross the antimeridian jump much farther."""

LEAST_CORNERS: Final = 3
"""Fewest corners of a ring that encloses an area."""


@dataclass(frozen=True, eq=False)
class _Jumps:
    """Jumps of longitude in rings.

    `turns`, (n,), are the turns jumped by the side from each point. `net`, (r,), is their sum in each ring, which is
    not 0 if the ring goes around a pole. A side around the whole world, along a pole or the edge of a map, is no jump.
    """

    turns: NDArray[np.float64]
    net: NDArray[np.float64]


def _jumps(rings: Rings, turn: float) -> _Jumps:
    """Find jumps of longitudes of period `turn` in at least one ring: sides longer than half a turn."""
    step = rings.steps
    turns = np.where(np.abs(step) > turn / 2, np.rint(step / turn), 0.0)
    full = np.abs(step) >= turn * FULL_TURN
    for ring in np.flatnonzero(np.logical_or.reduceat(full, rings.starts)):
        here = slice(rings.starts[ring], rings.ends[ring])
        turns[here] = np.where(_around(rings.points[here], turns[here], full[here], turn), 0.0, turns[here])
    return _Jumps(turns, np.add.reduceat(turns, rings.starts))


def _around(
    points: NDArray[np.float64], turns: NDArray[np.float64], full: NDArray[np.bool_], turn: float
) -> NDArray[np.bool_]:
    """Find sides of a ring that go around the whole world; other sides as long as a turn are jumps.

    If the ring goes around a pole by jumps only, such a side lies on the pole or between two along the antimeridian;
    otherwise it closes a coast whose cut was lost. If it goes around no pole, long sides to the east and to the west
    are either all long or all jumps, and the right choice is the one whose ring does not cross itself.
    """
    import shapely

    step = np.roll(points[:, 0], -1) - points[:, 0]
    along = full | (step == 0.0)
    polar = np.abs(points[:, 1]) >= turn / 4 * FULL_TURN
    edges = full & (polar | (np.roll(along, 1) & np.roll(along, -1)))
    none = np.zeros(len(full), np.bool_)
    if turns.sum() != 0.0 or len(full) < LEAST_CORNERS:
        return edges if turns[~edges].sum() == 0.0 else none
    if turns[~full].sum() != 0.0:
        return none
    readings = [_continuous(points, np.where(long, 0.0, turns), turn) for long in (full, none)]
    is_long, is_jump = shapely.is_valid(shapely.polygons(readings))
    return full if is_long or (not is_jump and edges[full].all()) else none


def _continuous(points: NDArray[np.float64], turns: NDArray[np.float64], turn: float) -> NDArray[np.float64]:
    """Remove the jumps from the points of a ring."""
    before = np.cumsum(turns) - turns  # a jump belongs to the side that leaves the point
    return points - np.stack([turn * before, np.zeros(len(points))], axis=1)


def unwrap_rings(rings: Rings, turn: float) -> Rings:
    """Remove jumps from rings of longitudes, which then exceed half a turn where they cross the antimeridian.

    A side of more than half a turn is taken to go the other way around the world; a side of a whole turn follows the
    edge of a map, or a pole, where it can. Holes stay in their polygon, and all polygons move to the side of the
    antimeridian where they span less. A ring around a pole is refused, unless it follows the edge of a map.
    """
    if not len(rings.ends):
        return rings
    jumps = _jumps(rings, turn)
    if jumps.turns.any():
        rings = _without_jumps(rings, jumps, turn)
    boxes = rings.boxes
    if boxes[:, 1, 0].max() - boxes[:, 0, 0].min() <= turn / 2:
        return rings
    middle = boxes[:, :, 0].mean(axis=1)
    shift = np.where(middle < 0.0, turn, 0.0)
    lows, highs = boxes[:, 0, 0] + shift, boxes[:, 1, 0] + shift
    if highs.max() - lows.min() >= min(turn / 2, boxes[:, 1, 0].max() - boxes[:, 0, 0].min()):
        return rings
    return rings.shift_east(shift[rings.polygon])


def note_short_ways(steps: NDArray[np.float64], turn: float, notes: Notes) -> None:
    """Note sides that are taken to go the other way around the world, but might really be that long.

    Examples
    --------
    >>> notes = Notes()
    >>> note_short_ways(np.array([200.0, 90.0, -359.0]), 360.0, notes)
    >>> [note.count for note in notes.in_order]
    [1]
    """
    length = np.abs(steps)
    wide = length[(length > turn / 2) & (length < turn * CLEAR_JUMP)]
    if wide.size:
        notes.remark(
            f"sides longer than half the world, such as one of {wide[0]:.6g} of {turn:.6g}, go the other way around; "
            "give a side that is meant to be so long another corner in its middle",
            len(wide),
        )


def jumping(rings: Rings, turn: float) -> NDArray[np.bool_]:
    """Polygons, (p,), that cross the antimeridian by jumps and go around no pole, so that they can be unwrapped."""
    jumps = _jumps(rings, turn)
    if not jumps.turns.any():
        return np.zeros(len(rings.outer), np.bool_)
    jump = np.logical_or.reduceat(jumps.turns != 0.0, rings.starts)
    around: NDArray[np.bool_] = np.logical_or.reduceat(jumps.net != 0.0, rings.outer)
    return np.logical_or.reduceat(jump, rings.outer) & ~around


def narrower(longitudes: NDArray[np.float64], turn: float) -> NDArray[np.float64]:
    """Move longitudes to 0 to a turn if they then span less than half a turn, and span more now; else keep them.

    Examples
    --------
    >>> narrower(np.array([179.5, -179.5, np.nan]), 360.0)
    array([179.5, 180.5,   nan])
    """
    if _span(longitudes) <= turn / 2:
        return longitudes
    turned = np.mod(longitudes, turn)
    return turned if _span(turned) < turn / 2 else longitudes


def _span(longitudes: NDArray[np.float64]) -> float:
    known = longitudes[np.isfinite(longitudes)]
    return float(np.ptp(known)) if known.size else 0.0


def _without_jumps(rings: Rings, jumps: _Jumps, turn: float) -> Rings:
    """Remove the jumps from the sides of rings."""
    pole = jumps.net != 0.0
    if pole.any():
        where = rings.ring_name(int(rings.starts[int(pole.argmax())]))
        raise SourceError(
            f"{where} goes around a pole, where longitudes have no inside; cut it along the antimeridian or give the "
            "data in a polar reference system"
        )
    before = np.cumsum(jumps.turns) - jumps.turns
    before -= np.repeat(before[rings.starts], rings.ends - rings.starts)
    points = rings.points - np.stack([turn * before, np.zeros(len(before))], axis=1)
    unwound = replace(rings, points=points)
    middle = (np.minimum.reduceat(points[:, 0], rings.starts) + np.maximum.reduceat(points[:, 0], rings.starts)) / 2
    own = middle[rings.outer][rings.polygon]
    return unwound.shift_east(turn * np.rint((own - middle) / turn))


def close_over_poles(rings: Rings, turn: float) -> tuple[Rings, int]:
    """Close rings around a pole; return all rings and the number of polygons that had one, which come last.

    The area of a ring around a pole, in longitudes of period `turn`, is all that lies between it and that pole. A
    polygon contains the places within an odd number of its rings: a coast and a circle near the pole enclose the land
    between them. Rings along the edge of a map stay as they are.

    Examples
    --------
    >>> import shapely
    >>> ice = shapely.Polygon([(longitude, -70.0) for longitude in range(-170, 180, 20)])
    >>> found, count = close_over_poles(rings_of(np.array([ice]), str), 360.0)
    >>> count, float(shapely.area(found.shapes)[0]), found.box
    (1, 7200.0, (-180.0, -90.0, 180.0, -70.0))
    """
    if not len(rings.ends):
        return rings, 0
    jumps = _jumps(rings, turn)
    polar = np.zeros(len(rings.outer), np.bool_)
    polar[rings.polygon[jumps.net != 0.0]] = True
    if not polar.any():
        return rings, 0
    places = np.flatnonzero(polar)
    made = np.array([_close_polygon(rings, int(place), jumps.turns, turn) for place in places], object)
    import shapely

    parts, owner = shapely.get_parts(made, return_index=True)
    whole = places[owner]
    feature = None if rings.feature is None else rings.feature[whole]
    closed = rings_of(parts, lambda index: rings.place(int(whole[index])), feature)
    return rings.take(np.flatnonzero(~polar)).concatenate(closed), len(places)


def _close_polygon(rings: Rings, polygon: int, turns: NDArray[np.float64], turn: float) -> Any:
    """Close the rings of a polygon."""
    import shapely

    areas = []
    for ring in np.flatnonzero(rings.polygon == polygon):
        here = slice(rings.starts[ring], rings.ends[ring])
        area = shapely.Polygon(_over_pole(rings.points[here], turns[here], turn))
        areas.append(area if area.is_valid else make_valid(np.array([area]))[0])
    return reduce(shapely.symmetric_difference, areas)


def _over_pole(points: NDArray[np.float64], turns: NDArray[np.float64], turn: float) -> NDArray[np.float64]:
    """Remove the jumps of a ring; one around a pole continues to the antimeridian, and returns over the pole."""
    jumps = np.flatnonzero(turns)
    if len(jumps):  # start after a jump
        points, turns = np.roll(points, -1 - jumps[-1], axis=0), np.roll(turns, -1 - jumps[-1])
    points = _continuous(points, turns, turn)
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
