"""Features in the reference system of a map. Web Mercator has no poles and continues beyond the antimeridian."""

from collections.abc import Callable
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture_geo.base.crs import (
    are_degrees,
    format_bounds,
    format_system,
    period,
    refuse_metres,
    same_system,
    system,
    transform_points,
)
from vexture_geo.base.extent import Bounds
from vexture_geo.base.longitudes import jumping, note_short_ways, unwrap_rings
from vexture_geo.base.rings import Rings, map_rings, refuse_far, repair_rings
from vexture_geo.maps.caps import WORLD, Cap
from vexture_geo.maps.domain import (
    EVER,
    TURN,
    Domain,
    cut_open,
    domain_of,
    in_box,
    is_far,
    is_strained,
    is_wide,
    torn_sides,
    within_turn,
    without,
)
from vexture_geo.maps.lines import change_lines, densify, lines_along, lines_in_box, rings_along, unwrap_lines
from vexture_geo.vector.features import Features, Lines, Points

MERCATOR: Final = "EPSG:3857"
RADIUS: Final = 6378137.0
"""Radius of the sphere of Web Mercator, in metres."""

MOST_LATITUDE: Final = 85.0511287798066
"""Latitude, in degrees, at which the world in Web Mercator is a square."""

DEGREES: Final = np.array([TURN, TURN / 2])
"""Sides of the world in longitude and latitude, in degrees."""

EVERYWHERE: Final = (-np.inf, -np.inf, np.inf, np.inf)
"""Box of all places, because a side may bulge out of the box of its points."""

LONGEST: Final = 5.0
"""Longest side, in degrees, whose ends and middle show how a map bends it."""

MOST_LETTERS: Final = 60
"""Longest name of an area in a message."""

BEYOND_POINT: Final = "point beyond the map"

DEGREE: Final = 111_320.0
"""Metres in a degree of latitude, exact enough for widths of strokes."""

Move = Callable[[NDArray[np.float64]], NDArray[np.float64]]


def place_features(features: Features, crs: str, notes: Notes) -> Features:
    """Transform features to another system; parts without a place there are cut off or left out, with a note."""
    rings, turn = features.rings, period(features.crs)
    if turn:
        for marks in (features.lines, features.points):
            _refuse_metres_of_marks(marks, features, notes)
    if turn and len(rings.ends):
        what = f"the coordinates {format_bounds(rings.box, features.crs)}"
        refuse_metres(rings.points, features.crs, what, name="source_crs")
        jumps = jumping(rings, turn).any()
        note_short_ways(rings.steps, turn, notes)
        rings = unwrap_rings(rings, turn)
        rings = repair_rings(rings, notes) if jumps else rings
    if turn:
        note_short_ways(features.lines.steps, turn, notes)
        features = replace(features, rings=rings, lines=unwrap_lines(features.lines, turn))
    if same_system(crs, features.crs):
        wide = turn is not None and len(rings.ends) > 0 and rings.box[2] - rings.box[0] > turn
        return (
            _within(features, Domain((-turn / 2, -turn / 4, turn / 2, turn / 4)), notes) if turn and wide else features
        )
    if same_system(crs, MERCATOR):
        return _on_mercator(features, notes)
    return _project(features, crs, notes)


def _refuse_metres_of_marks(marks: Lines | Points, features: Features, notes: Notes) -> None:
    """Raise an error if most points of lines or points cannot be in degrees; note a minority, which has no place."""
    points = marks.points
    wrong = ~are_degrees(points, features.crs)
    if not wrong.any():
        return
    first = points[wrong][:1]
    if wrong.sum() > len(points) / 2:
        box = (*points.min(axis=0).tolist(), *points.max(axis=0).tolist())
        refuse_metres(first, features.crs, f"the coordinates {format_bounds(box, features.crs)}", name="source_crs")
    owner = marks.feature
    if isinstance(marks, Lines):
        owner = owner[np.searchsorted(marks.ends, np.arange(len(points)), side="right")]
    said = f"a place such as {first[0, 0]:.10g},{first[0, 1]:.10g} is no longitude and latitude"
    remedy = "correct it, or name the system that all are in by `source_crs`"
    notes.features("remark", f"{said}; {remedy}", features.ids[np.unique(owner[wrong])])


def _mover(start: str, end: str, before: Move = lambda points: points) -> Move:
    return lambda points: transform_points(before(points), start, end)


def _project(features: Features, crs: str, notes: Notes) -> Features:
    """Transform features to another map, cut where it is torn."""
    domain = domain_of(crs)
    if domain is not None and period(features.crs) is None and is_wide(crs):
        features = _in_degrees(features)
    if period(features.crs) == TURN:
        features = features if domain is None else _within(features, domain, notes)
        lines = lines_along(densify(rings_along(features.lines), LONGEST))
        features = replace(features, rings=densify(features.rings, LONGEST), lines=lines)
        if is_wide(crs):
            _note_torn(features, crs, notes)
    move, rings = _mover(features.crs, crs), features.rings
    is_around = domain is not None and domain.pole != 0.0 and period(features.crs) == TURN
    if is_around:  # makes both sides of the antimeridian byte-identical
        move = _mover(features.crs, crs, within_turn)
    if len(rings.ends):
        rings = _usable(rings, features.crs, crs, move, notes)
        rings = repair_rings(rings, notes) if is_around else rings
    else:
        _note_far(np.concatenate([features.lines.points, features.points.points]), features.crs, crs, notes)
    lines, points = _marks(features, move, notes)
    return replace(features, rings=rings, crs=crs, lines=lines, points=points)


def _in_degrees(features: Features) -> Features:
    """Transform features to longitude and latitude; sides stay straight in their own system."""
    move = _mover(features.crs, WORLD)
    rings, lines = features.rings, features.lines
    if len(rings.ends):
        rings = _map_finely(rings, move, DEGREES)
        refuse_far(rings, f"it has no longitude and latitude; correct it, or the `source_crs` {features.crs[:40]}")
        rings = unwrap_rings(rings, TURN)
    if len(lines.ends):
        lines = unwrap_lines(lines_along(_map_finely(rings_along(lines), move, DEGREES)), TURN)
    points = Points(move(features.points.points), features.points.feature)
    return replace(features, rings=rings, crs=WORLD, lines=lines, points=points)


def _within(features: Features, domain: Domain, notes: Notes) -> Features:
    """Clip features, in longitude and latitude, to the part of the world that a map can show."""
    if domain.cap is not None:
        return _within_cap(features, domain.cap, notes)
    rings = in_box(features.rings, domain.box, domain.turn)
    lines, points = lines_in_box(features.lines, domain.box, domain.turn), features.points
    if domain.pole:
        points = _select_points(points, points.points[:, 1] * domain.pole >= 0.0, notes)
        if rings is not features.rings or lines is not features.lines:
            notes.remark("the map shows the hemisphere around its pole: it is cut off at the equator")
    if domain.slits and len(rings.ends):
        rings = cut_open(rings, domain.slits)
    if domain.slits and len(lines.ends):
        lines = change_lines(lines, without(domain.slits))
    return replace(features, rings=rings, lines=lines, points=points)


def _within_cap(features: Features, cap: Cap, notes: Notes) -> Features:
    """Clip features to the cap that a perspective map shows."""
    rings, lines = cap.of_rings(features.rings), cap.of_lines(features.lines)
    points = _select_points(features.points, cap.distance(features.points.points) <= cap.radius, notes)
    if rings is not features.rings or lines is not features.lines:
        middle = f"latitude {cap.latitude:.4g}, longitude {cap.longitude:.4g}"
        notes.remark(f"the map shows one side of the globe: it is cut off {cap.radius:.3g} degrees from {middle}")
    return replace(features, rings=rings, lines=lines, points=points)


def _select_points(points: Points, is_shown: NDArray[np.bool_], notes: Notes) -> Points:
    """Select the points that a map shows."""
    for _ in range(int((~is_shown).sum())):
        notes.left_out(BEYOND_POINT)
    return Points(points.points[is_shown], points.feature[is_shown])


def _note_torn(features: Features, crs: str, notes: Notes) -> None:
    """Note which features, in longitude and latitude, cross a tear that follows no meridian."""
    parts = [features.rings] if len(features.rings.ends) else []
    parts += [rings_along(features.lines)] if len(features.lines.ends) else []
    for rings in parts:
        assert rings.feature is not None
        ring = np.searchsorted(rings.ends, np.flatnonzero(torn_sides(rings, crs)), side="right")
        wrong = np.unique(rings.feature[rings.polygon[ring]])
        said = f"a feature lies where {_system_name(crs)} is torn, and is smeared over the map; choose another `crs`"
        notes.features("remark", said, features.ids[wrong])


def _on_mercator(features: Features, notes: Notes) -> Features:
    """Transform features to Web Mercator, which has no poles and continues beyond the antimeridian."""
    if period(features.crs) is None:
        features = _in_degrees(features)
    rings, lines = features.rings, features.lines
    low, high = _reach(rings.points, lines.points)
    whole = bool(high[0] - low[0] > TURN)
    clipped = bool(low[1] < -MOST_LATITUDE or high[1] > MOST_LATITUDE)
    if whole or clipped:
        turn = TURN if whole else None
        side = TURN / 2 if whole else EVER
        box = (-side, -MOST_LATITUDE, side, MOST_LATITUDE)
        before = len(rings.outer)
        rings, lines = in_box(rings, box, turn), lines_in_box(lines, box, turn)
        gone = before - len(np.unique(rings.polygon)) if not whole else 0
        lost = f", and {gone} polygons are beyond it" if gone > 0 else ""
        if clipped:
            notes.remark(f"Web Mercator ends at {MOST_LATITUDE:.2f} degrees of latitude: it is cut off there{lost}")
    rings = replace(rings, points=_mercator(rings.points))

    def move(points: NDArray[np.float64]) -> NDArray[np.float64]:
        far = np.abs(points[:, 1]) > MOST_LATITUDE * (1.0 + 1e-12)
        return _mercator(np.where(far[:, None], np.inf, points))

    lines, points = _marks(replace(features, lines=lines), move, notes, is_bent=False)
    return replace(features, rings=rings, crs=MERCATOR, lines=lines, points=points)


def _reach(*points: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Least and greatest coordinates of finite points."""
    every = np.concatenate(points)
    every = every[np.isfinite(every).all(axis=1)]
    return (every.min(axis=0), every.max(axis=0)) if len(every) else (np.zeros(2), np.zeros(2))


def _mercator(degrees: NDArray[np.float64]) -> NDArray[np.float64]:
    """Project longitudes and latitudes to Web Mercator."""
    longitude, latitude = np.radians(degrees).T
    with np.errstate(invalid="ignore"):
        return RADIUS * np.stack([longitude, np.arcsinh(np.tan(latitude))], axis=1)


def _usable(rings: Rings, start: str, end: str, move: Move, notes: Notes) -> Rings:
    """Transform polygons; if some have no image or a much too large one, keep only those in the area of use."""
    rings_there = _map_finely(rings, move, None)
    finite = bool(np.isfinite(rings_there.points).all())
    area = system(end).area_of_use
    if finite and (area is None or period(start) != TURN or not is_strained(rings.points, end)):
        _note_far(rings.boxes.reshape(-1, 2), start, end, notes)
        return rings_there
    if area is not None:
        box = _area(area.bounds, start)
        rings_there = _map_finely(in_box(rings, box, period(start)), move, None)
        notes.remark(f"it is cut off at the area of use of {format_system(end)}")
    if area is None or not len(rings_there.ends) or not np.isfinite(rings_there.points).all():
        raise SourceError(
            f"it has no place in {_system_name(end)}, or some of it has none; choose another `crs`, or features "
            "by `where`"
        )
    return rings_there


def _note_far(points: NDArray[np.float64], start: str, end: str, notes: Notes) -> None:
    """Note that a map is not meant for some places, unless it is one around a pole, which shows a hemisphere."""
    area, domain = system(end).area_of_use, domain_of(end)
    if area is not None and not (domain and domain.pole) and is_far(transform_points(points, start, WORLD), end):
        name = area.name.rstrip(".") if len(area.name) <= MOST_LETTERS else f"{area.name[:MOST_LETTERS]}..."
        notes.remark(
            f"some of it is far outside of the area of use of {format_system(end)} ({name}), where shapes and sizes "
            "may be wrong; choose another `crs`"
        )


def _system_name(crs: str) -> str:
    """Name of a system for a message."""
    name = format_system(crs)
    return "this system" if name == "unknown" else name


def _area(bounds: Bounds, crs: str) -> Bounds:
    """Transform an area of use to another system; it may extend beyond the antimeridian."""
    west, south, east, north = bounds
    corners = np.array([(west, south), (east + TURN * (east < west), north)], np.float64)
    (west, south), (east, north) = (corners if period(crs) == TURN else transform_points(corners, WORLD, crs)).tolist()
    return (west, south, east, north)


def _map_finely(rings: Rings, move: Move, size: NDArray[np.float64] | None) -> Rings:
    """Transform rings, with more points where a transformed side is no longer straight."""
    image = move(rings.points)
    known = image[np.isfinite(image).all(axis=1)]
    if not len(known):
        return replace(rings, points=image)
    low, high = known.min(axis=0), known.max(axis=0)
    sides = np.maximum(high - low, 1e-9) if size is None else size
    return map_rings(rings, move, EVERYWHERE, sides)


def _marks(features: Features, move: Move, notes: Notes, *, is_bent: bool = True) -> tuple[Lines, Points]:
    """Transform lines, curved where the map bends them, and points; those without an image are left out."""
    lines, spots = features.lines, features.points
    if len(lines.ends):
        there_back = rings_along(lines)
        moved_rings = (
            _map_finely(there_back, move, None) if is_bent else replace(there_back, points=move(there_back.points))
        )
        lines = lines_along(moved_rings)
    points = lines.points
    owner = np.repeat(np.arange(len(lines.ends)), np.diff(lines.ends, prepend=0))
    lost = np.zeros(len(lines.ends), np.bool_)
    lost[owner[~np.isfinite(points).all(axis=1)]] = True
    kept = ~lost[owner]
    moved_lines = Lines(points[kept], np.cumsum(np.diff(lines.ends, prepend=0)[~lost]), lines.feature[~lost])
    places = move(spots.points)
    there = np.isfinite(places).all(axis=1)
    for what, count in (("line beyond the map", int(lost.sum())), (BEYOND_POINT, int((~there).sum()))):
        for _ in range(count):
            notes.left_out(what)
    return moved_lines, Points(places[there], spots.feature[there])


def unit_of(crs: str) -> str:
    """Unit of a system's coordinates, for a message.

    Examples
    --------
    >>> unit_of("EPSG:3857"), unit_of("EPSG:4326")
    ('m', 'degree')
    """
    name = str(system(crs).axis_info[0].unit_name)
    return "m" if name == "metre" else name


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
