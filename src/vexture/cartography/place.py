"""Features in the reference system of a map; on Web Mercator, without the poles and across the antimeridian."""

from collections.abc import Callable
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.errors import SourceError
from vexture.geo.crs import period, refuse_metres, same_system, seam, shown_bounds, shown_system, system, transformed
from vexture.geo.extent import Bounds
from vexture.geo.features import Features, Lines, Points
from vexture.geo.longitudes import jumping, unwrapped
from vexture.geo.rings import Rings, cut, moved, refuse_far, repaired, within
from vexture.notes import Notes

__all__ = ["MERCATOR", "placed", "units_per_metre"]

MERCATOR: Final = "EPSG:3857"
WORLD: Final = "EPSG:4326"

RADIUS: Final = 6378137.0
"""Metres. Of the sphere of Web Mercator."""

MOST_LATITUDE: Final = 85.0511287798066
"""Degrees. At this latitude the world in Web Mercator is a square."""

DEGREE: Final = 111_320.0
"""Metres in a degree of latitude, as far as widths of strokes need it."""

BESIDE: Final = 1e-11
"""Turns. Places this far from where a map is torn apart are on the right side of it for sure."""

Move = Callable[[NDArray[np.float64]], NDArray[np.float64]]


def placed(features: Features, crs: str, notes: Notes) -> Features:
    """Features in another reference system; what has no place there is cut off or left out, with a note."""
    rings, turn = features.rings, period(features.crs)
    if turn and len(rings.ends):
        refuse_metres(rings.points, features.crs, f"the coordinates {shown_bounds(rings.box, features.crs)}")
        jumps = jumping(rings, turn).any()
        rings = unwrapped(rings, turn)
        rings = repaired(rings, notes) if jumps else rings
    if same_system(crs, features.crs):
        return replace(features, rings=rings)
    if same_system(crs, MERCATOR):
        return _on_mercator(replace(features, rings=rings), notes)
    move = _mover(features.crs, crs)
    if turn and len(rings.ends):
        rings = _torn(rings, turn, crs)
    if len(rings.ends):
        rings = _usable(rings, features.crs, crs, move, notes)
    lines, points = _marks(features, move, notes)
    return replace(features, rings=rings, crs=crs, lines=lines, points=points)


def _torn(rings: Rings, turn: float, crs: str) -> Rings:
    """Polygons in longitudes of period `turn`, cut where a map of the world is torn apart."""
    longitude = seam(crs)
    if longitude is None:
        return rings
    west, pole = (longitude - 360.0 * (longitude > 0.0)) / 360.0 * turn, turn / 4
    box = (west + BESIDE * turn, -pole, west + (1.0 - BESIDE) * turn, pole)
    return cut(within(rings, box, turn), box)


def _mover(start: str, end: str) -> Move:
    return lambda points: transformed(points, start, end)


def _on_mercator(features: Features, notes: Notes) -> Features:
    """Features on Web Mercator, which has no poles; beyond the antimeridian it goes on."""
    turn, rings = period(features.crs), features.rings
    to_world = _mover(features.crs, WORLD)
    if len(rings.ends):
        if turn is None:  # straight sides stay straight in their own system
            rings = _mapped(rings, to_world, np.array([360.0, 180.0]))
            refuse_far(rings, f"it has no longitude and latitude; correct it, or the `source_crs` {features.crs[:40]}")
            rings = unwrapped(rings, 360.0)
        before = len(rings.outer)
        west, south, east, north = rings.box
        clipped = (south < -MOST_LATITUDE) or (north > MOST_LATITUDE)
        if east - west > 360.0 or clipped:
            rings = _world(rings, east - west > 360.0)
        if clipped:
            gone = before - len(np.unique(rings.polygon)) if east - west <= 360.0 else 0
            lost = f", and {gone} polygons are beyond it" if gone > 0 else ""
            notes.remark(f"Web Mercator ends at {MOST_LATITUDE:.2f} degrees of latitude: it is cut off there{lost}")
        rings = replace(rings, points=_mercator(rings.points))

    def move(points: NDArray[np.float64]) -> NDArray[np.float64]:
        moved = to_world(points)
        far = np.abs(moved[:, 1]) > MOST_LATITUDE
        return _mercator(np.where(far[:, None], np.inf, moved))

    lines, points = _marks(features, move, notes)
    return replace(features, rings=rings, crs=MERCATOR, lines=lines, points=points)


def _world(rings: Rings, whole: bool) -> Rings:
    """Polygons within the latitudes of Web Mercator and, of the `whole` world, within one turn."""
    west, _, east, _ = rings.box
    if whole:
        west, east = -180.0, 180.0
    box = (west, -MOST_LATITUDE, east, MOST_LATITUDE)
    return cut(within(rings, box, 360.0 if whole else None), box)


def _mercator(degrees: NDArray[np.float64]) -> NDArray[np.float64]:
    """Web Mercator of longitudes and latitudes."""
    longitude, latitude = np.radians(degrees).T
    with np.errstate(invalid="ignore"):
        return RADIUS * np.stack([longitude, np.arcsinh(np.tan(latitude))], axis=1)


def _usable(rings: Rings, start: str, end: str, move: Move, notes: Notes) -> Rings:
    """Polygons moved; if some have no image, only what lies in the area of use of the new system."""
    rings_there = _mapped(rings, move, None)
    if np.isfinite(rings_there.points).all():
        return rings_there
    area = system(end).area_of_use
    if area is not None:
        box = _area(area.bounds, start)
        rings_there = _mapped(cut(within(rings, box, period(start)), box), move, None)
        notes.remark(f"it is cut off at the area of use of {shown_system(end)}")
    if area is None or not len(rings_there.ends) or not np.isfinite(rings_there.points).all():
        raise SourceError(f"it has no place in {shown_system(end)}; choose another `crs`")
    return rings_there


def _area(bounds: Bounds, crs: str) -> Bounds:
    """An area of use in another system."""
    corners = transformed(np.array([bounds[:2], bounds[2:]], np.float64), WORLD, crs)
    (west, south), (east, north) = corners.tolist()
    return (west, south, east, north)


def _mapped(rings: Rings, move: Move, size: NDArray[np.float64] | None) -> Rings:
    """Rings with more points where a mapped side is no longer straight."""
    image = move(rings.points)
    known = image[np.isfinite(image).all(axis=1)]
    if not len(known):
        return replace(rings, points=image)
    low, high = known.min(axis=0), known.max(axis=0)
    sides = np.maximum(high - low, 1e-9) if size is None else size
    return moved(rings, move, (-np.inf, -np.inf, np.inf, np.inf), sides)  # images of sides may leave that of corners


def _marks(features: Features, move: Move, notes: Notes) -> tuple[Lines, Points]:
    """Lines and points, moved; those without an image are left out."""
    lines, spots = features.lines, features.points
    points = move(lines.points)
    owner = np.repeat(np.arange(len(lines.ends)), np.diff(lines.ends, prepend=0))
    lost = np.zeros(len(lines.ends), np.bool_)
    lost[owner[~np.isfinite(points).all(axis=1)]] = True
    kept = ~lost[owner]
    moved_lines = Lines(points[kept], np.cumsum(np.diff(lines.ends, prepend=0)[~lost]), lines.feature[~lost])
    places = move(spots.points)
    there = np.isfinite(places).all(axis=1)
    for what, count in (("line beyond the map", int(lost.sum())), ("point beyond the map", int((~there).sum()))):
        for _ in range(count):
            notes.left_out(what)
    return moved_lines, Points(places[there], spots.feature[there])


def units_per_metre(points: NDArray[np.float64], crs: str) -> NDArray[np.float64]:
    """Units of a map in a metre on the ground at each point; on Web Mercator they grow towards the poles.

    Examples
    --------
    >>> units_per_metre(np.array([[0.0, 0.0], [0.0, 8399737.9]]), "EPSG:3857").round(3).tolist()
    [1.0, 2.0]
    """
    if same_system(crs, MERCATOR):
        return np.cosh(points[:, 1] / RADIUS)
    if period(crs) is not None:
        return np.full(len(points), 1.0 / DEGREE)
    return np.full(len(points), 1.0 / system(crs).axis_info[0].unit_conversion_factor)
