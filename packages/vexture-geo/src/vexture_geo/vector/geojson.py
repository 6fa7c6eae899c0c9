"""Read GeoJSON: the areas of its polygons, with their simplestyle colours."""

import json
import os
import re
from collections.abc import Iterator
from dataclasses import replace
from itertools import chain
from pathlib import Path as FilePath
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.content import BYTE_ORDER_MARK, READABLE, about, decompress, read_bytes
from vexture.base.errors import SourceError
from vexture.base.notes import Notes, line_of, warn_of
from vexture.bezier.convert import line_cubics
from vexture.drawing.drawing import Drawing, FillRule, Path
from vexture.drawing.paint import BLACK, Paint
from vexture_geo.base.extent import LARGEST
from vexture_geo.base.file_references import LINK_TYPES, refuse_link
from vexture_geo.base.snap import snap_borders
from vexture_geo.vector.sequences import one_json

MOST_POSITIONS: Final = 20_000_000
MOST_NESTED: Final = 32
"""Levels of nested geometry collections."""

WORLD: Final = "OGC:CRS84"
"""Default reference system: longitude and latitude in degrees (RFC 7946, 4)."""

UNLOCATED: Final = "feature without geometry"
"""Note about a feature whose geometry is null, which RFC 7946, 3.2 allows."""

URN: Final = re.compile(r"urn:ogc:def:crs:(\w+):[^:]*:(\w+)", re.IGNORECASE)
COLOR: Final = re.compile(r"#?([0-9a-f]{3}|[0-9a-f]{6})", re.IGNORECASE)
NUMBERS: Final = (float, int)
WITHOUT_AREA: Final = ("Point", "MultiPoint", "LineString", "MultiLineString")

Ring = NDArray[np.float64]


class AreaStyle(NamedTuple):
    """Style of a feature's polygons: its paint, and its name in drawings."""

    paint: Paint = BLACK
    element: str = ""


class Area(NamedTuple):
    """A polygon: its rings in the units of the file, y up, its style, and its name in messages."""

    rings: list[Ring]
    look: AreaStyle
    where: str


def read_geojson(
    source: str | os.PathLike[str] | bytes, *, names: str | None = None, snap: float | None = None
) -> Drawing:
    """Read GeoJSON (RFC 7946) polygons with their holes, one path for each polygon.

    Their bounding box is fitted into the unit square at its own aspect ratio. The properties ``fill`` and
    ``fill-opacity`` of a feature (simplestyle) give its paint, black by default. Its ``id``, or else its property
    ``name``, names its paths (`Path.element`). Points and lines have no area; they are left out and noted. The obsolete
    member ``crs`` is read if it names a system; without it, coordinates are degrees of longitude and latitude.

    Parameters
    ----------
    source : path or bytes
        The file, plain or gzipped, or its content.
    names : str, optional
        Property whose values name the paths, in place of ``id``.
    snap : float, optional
        Largest distance, as a fraction of the box's larger side, at which borders of two polygons become one; 3e-6 by
        default, 0 leaves everything as it is, and 0.01 is the most. Details of a border without a neighbour stay.

    Returns
    -------
    Drawing
        In the unit square, y up; `to_source` maps it to the coordinates of the file, whose reference system is `crs`.
        Its `notes` list what was left out, and what was snapped.

    Raises
    ------
    SourceError
        If it cannot be read, is not GeoJSON, exceeds a limit or contains no area. Messages count features, polygons and
        rings from 1.
    ParameterError
        If `snap` is out of range.

    Warns
    -----
    SourceWarning
        One warning per file, with all notes.

    Examples
    --------
    >>> ring = [[4, 52], [6, 52], [6, 53], [4, 53], [4, 52]]
    >>> drawing = read_geojson(json.dumps({"type": "Polygon", "coordinates": [ring]}).encode())
    >>> drawing.paths[0].contours[0][:, 0]
    array([[0.  , 0.25],
           [1.  , 0.25],
           [1.  , 0.75],
           [0.  , 0.75]])
    >>> drawing.to_source @ (0, 0.25, 1), drawing.crs
    (array([ 4., 52.]), 'OGC:CRS84')
    """
    if isinstance(source, bytes):
        shown, drawing = "the GeoJSON", geojson_drawing(source, "drawing", names=names, snap=snap)
    else:
        shown = os.fspath(source)
        with about(shown):
            drawing = geojson_drawing(read_bytes(source), FilePath(source).stem, names=names, snap=snap)
    warn_of(shown, drawing.notes)
    return drawing


def geojson_drawing(content: bytes, name: str, *, names: str | None = None, snap: float | None = None) -> Drawing:
    """Read GeoJSON, plain or gzipped, like `read_geojson`, but without a warning: the drawing holds all notes."""
    notes = Notes()
    value = _parse_object(one_json(decompress(content)))
    reader = _Reader(notes, names)
    areas = list(reader.areas(value))
    if not areas:
        raise SourceError(f"it holds no polygon to fill{omissions(notes)}; give Polygon or MultiPolygon geometries")
    reader.check_names()
    points = np.concatenate([ring for area in areas for ring in area.rings])
    low, high = points.min(axis=0), points.max(axis=0)
    width, height = (float(side) for side in high - low)
    rings = _snap_areas(areas, max(width, height), snap, notes)
    paths = [
        Path(tuple(map(_contour, own)), FillRule.EVENODD, area.look.paint, element=area.look.element)
        for area, own in zip(areas, rings, strict=True)
    ]
    drawing = Drawing.from_source(paths, (float(low[0]), -float(high[1]), width, height), name)
    if not drawing.paths:
        raise SourceError("its polygons enclose no area; correct their coordinates")
    turned = drawing.to_source * [[1.0], [-1.0]] + 0.0  # from_source has y down; + 0.0 removes -0.0
    return replace(drawing, to_source=turned, crs=_crs(value.get("crs")), notes=notes.in_order)


def _snap_areas(areas: list[Area], size: float, snap: float | None, notes: Notes) -> list[list[Ring]]:
    """Snap shared borders of areas, and return the rings of each area."""
    rings = [ring for area in areas for ring in area.rings]
    points, ends = snap_borders(np.concatenate(rings), np.cumsum([len(ring) for ring in rings]), size, snap, notes)
    each = iter(np.split(points, ends[:-1]))
    return [[ring for _ in area.rings if len(ring := next(each))] for area in areas]


def areas_of(content: bytes, notes: Notes) -> tuple[list[Area], str]:
    """Read the areas of a file's content, not gzipped, and the reference system of their coordinates."""
    value = _parse_object(content)
    return list(_Reader(notes).areas(value)), _crs(value.get("crs"))


def omissions(notes: Notes) -> str:
    """Summarise what was left out, in parentheses, for the message that no polygon remains."""
    line = line_of("met", notes.in_order).removeprefix("met: ")
    return f" ({line})" if line else ""


def _parse_object(content: bytes) -> dict[str, Any]:
    """Parse a JSON text as an object."""
    try:
        value = json.loads(content.removeprefix(BYTE_ORDER_MARK))
    except RecursionError:
        raise SourceError("its lists are nested too deeply; GeoJSON needs no more than a few levels") from None
    except UnicodeDecodeError as error:
        raise SourceError(f"it is no UTF-8 text (byte {error.start}); save it as UTF-8") from None
    except json.JSONDecodeError as error:
        raise SourceError(f"not JSON: {error.msg} in line {error.lineno}, column {error.colno}") from None
    except ValueError:
        raise SourceError("it holds an integer of thousands of digits; correct it") from None
    if not isinstance(value, dict):
        raise SourceError(f"its outermost value is a {type(value).__name__}, not an object; this is not GeoJSON")
    if "type" not in value:
        raise SourceError(f'its outermost object has no "type", so it is not GeoJSON; {READABLE}')
    return value


class _Reader:
    """Reader of one file, which collects notes and counts positions; a property or the `id` names features."""

    def __init__(self, notes: Notes, names: str | None = None) -> None:
        self._notes = notes
        self._names = names
        self._known: set[str] = set()
        self._positions = 0

    def areas(self, value: dict[str, Any]) -> Iterator[Area]:
        """Yield the areas of the outermost object."""
        kind = value.get("type")
        if kind != "FeatureCollection":
            yield from (
                self._feature(value, "the feature") if kind == "Feature" else self._geometry(value, "", AreaStyle())
            )
            return
        features = value.get("features")
        if not isinstance(features, list):
            raise SourceError("the FeatureCollection has no list of features; correct it")
        for number, feature in enumerate(features, 1):
            yield from self._feature(feature, f"feature {number}")

    def _feature(self, value: Any, place: str) -> Iterator[Area]:
        if not isinstance(value, dict) or value.get("type") != "Feature":
            raise SourceError(f"{place} is not of the type Feature; correct it")
        if value.get("geometry") is None:  # RFC 7946, 3.2: an unlocated feature
            self._notes.left_out(UNLOCATED)
        else:
            properties = value.get("properties")
            look = AreaStyle(self._paint(properties), self._element(value.get("id"), properties))
            yield from self._geometry(value["geometry"], place, look)

    def _geometry(self, value: Any, place: str, look: AreaStyle, depth: int = 0) -> Iterator[Area]:
        """Yield the areas of a geometry; `place` names the place in messages."""
        if not isinstance(value, dict):
            raise SourceError(f"{_at(place, 'the geometry')} is a {type(value).__name__}, not an object; correct it")
        kind = value.get("type")
        content = value.get("geometries" if kind == "GeometryCollection" else "coordinates")
        if kind in WITHOUT_AREA:
            self._notes.left_out(kind)
            return
        if kind not in ("Polygon", "MultiPolygon", "GeometryCollection"):
            hint = "convert TopoJSON to GeoJSON" if kind == "Topology" else "see RFC 7946, 1.4"
            raise SourceError(f"{_at(place, 'type')} {_format_value(kind)} is none that GeoJSON knows; {hint}")
        if not isinstance(content, list):
            raise SourceError(f"{_at(place, kind)} has no list of its parts; correct it")
        if kind == "Polygon":
            yield from self._polygon(content, place, look)
        elif kind == "MultiPolygon":
            for number, rings in enumerate(content, 1):
                yield from self._polygon(rings, _at(place, f"polygon {number}"), look)
        elif depth == MOST_NESTED:
            raise SourceError(f"{_at(place, kind)} is nested more than {MOST_NESTED} deep; flatten it")
        else:
            for number, part in enumerate(content, 1):
                yield from self._geometry(part, _at(place, f"geometry {number}"), look, depth + 1)

    def _polygon(self, rings: Any, place: str, look: AreaStyle) -> Iterator[Area]:
        if not isinstance(rings, list):
            raise SourceError(f"{_at(place, 'the polygon')} is a {type(rings).__name__}, not a list of rings")
        read = [self._ring(ring, _at(place, f"ring {number}")) for number, ring in enumerate(rings, 1)]
        kept = [ring for ring in read if ring is not None]
        if kept:
            yield Area(kept, look, place)

    def _ring(self, ring: Any, place: str) -> Ring | None:
        """Return the positions of a ring, the first not repeated at the end; None if there are fewer than three."""
        if not isinstance(ring, list):
            raise SourceError(f"{place} is a {type(ring).__name__}, not a list of positions; correct it")
        self._positions += len(ring)
        if self._positions > MOST_POSITIONS:
            raise SourceError(f"{place} is beyond the limit of {MOST_POSITIONS:,} positions; simplify or split it")
        points = _usual(ring)
        if points is None:
            points = _position_by_position(ring, place)
        if len(points) > 1 and (points[0] == points[-1]).all():
            points = points[:-1]
        if len(points) < 3:
            self._notes.left_out("ring of fewer than three positions")
            return None
        return points

    def check_names(self) -> None:
        """Raise a `SourceError` if no feature has the property that should name features."""
        if self._names is not None and self._names not in self._known:
            known = ", ".join(sorted(map(repr, self._known))[:10]) or "none"
            raise SourceError(f"no feature has the property {self._names!r} of `names`; there are {known}")

    def _element(self, identity: Any, properties: Any) -> str:
        """Choose the name of a feature, from a text or a number."""
        held = properties if isinstance(properties, dict) else {}
        self._known.update(held.keys())
        chosen = (identity, held.get("name")) if self._names is None else (held.get(self._names), identity)
        return next((str(value) for value in chosen if type(value) in (str, *NUMBERS)), "")

    def _paint(self, properties: Any) -> Paint:
        """Choose the paint of a feature."""
        if not isinstance(properties, dict):
            return Paint()
        fill, opacity = properties.get("fill", "#000"), properties.get("fill-opacity", 1)
        match = COLOR.fullmatch(fill) if isinstance(fill, str) else None
        if match is None:
            self._notes.left_out(f"fill {_format_value(fill)} (colours are #rgb or #rrggbb)")
        if "stroke" in properties:
            self._notes.left_out("stroke of a feature")
        if type(opacity) not in NUMBERS or not 0 <= opacity <= 1:
            self._notes.left_out(f"fill-opacity {_format_value(opacity)}")
            opacity = 1
        digits = match[1] if match else "000"
        step = len(digits) // 3
        red, green, blue = (int(digits[k : k + step] * (3 - step), 16) / 255 for k in range(0, 3 * step, step))
        return Paint((red, green, blue), float(opacity))


def _usual(ring: list[Any]) -> Ring | None:
    """Convert a valid ring whose positions have equal lengths, as a fast path; None for any other ring."""
    lengths = set(map(len, ring)) if set(map(type, ring)) == {list} else set()
    if len(lengths) != 1 or min(lengths) < 2:
        return None
    numbers = list(chain.from_iterable(ring))
    if not set(map(type, numbers)) <= set(NUMBERS):
        return None
    try:
        points = np.array(numbers, np.float64).reshape(len(ring), -1)[:, :2]
    except OverflowError:  # an integer beyond all floats
        return None
    return points if bool((np.abs(points) <= LARGEST).all()) else None


def _position_by_position(ring: list[Any], place: str) -> Ring:
    """Convert any ring, or raise an error that names its first invalid position."""
    for number, position in enumerate(ring, 1):
        if not isinstance(position, list) or len(position) < 2 or any(type(c) not in NUMBERS for c in position[:2]):
            raise SourceError(f"{place}, position {number} is {_format_value(position)}; it must be two numbers")
    try:
        points = np.array([position[:2] for position in ring], np.float64).reshape(-1, 2)
    except OverflowError:  # an integer beyond all floats
        points = np.array([[c if abs(c) <= LARGEST else np.inf for c in position[:2]] for position in ring])
    bad = ~(np.abs(points) <= LARGEST).all(axis=1)  # NaN is bad too
    if bad.any():
        number = int(bad.argmax()) + 1
        raise SourceError(
            f"{place}, position {number} is {_format_value(ring[number - 1])}; give finite numbers up to {LARGEST:g}"
        )
    return points


def _contour(ring: Ring) -> NDArray[np.float64]:
    """Convert a ring to a closed contour of straight cubics, y down."""
    turned = ring * (1.0, -1.0)
    return line_cubics(turned, np.roll(turned, -1, axis=0))


def _at(place: str, part: str) -> str:
    return f"{place}, {part}" if place else part


def _format_value(value: Any) -> str:
    """Format a value for a message, short and in one line."""
    if isinstance(value, dict):
        return "an object"
    text = repr(value[:3] if isinstance(value, list) else value)
    return text if len(text) <= 60 else text[:57] + "..."


def _crs(member: Any) -> str:
    """Name the reference system by the member `crs` that GeoJSON had before RFC 7946; links are refused.

    Examples
    --------
    >>> _crs({"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::28992"}}), _crs(None)
    ('EPSG:28992', 'OGC:CRS84')
    """
    properties = member.get("properties") if isinstance(member, dict) else None
    if isinstance(member, dict) and str(member.get("type")).lower() in LINK_TYPES:
        named = properties if isinstance(properties, dict) else {}
        refuse_link(str(named.get("href") or named.get("url") or ""))
    name = properties.get("name") if isinstance(properties, dict) else None
    if not isinstance(name, str) or not name.isprintable() or not 0 < len(name) <= 200:
        return WORLD
    urn = URN.fullmatch(name)
    return f"{urn[1].upper()}:{urn[2]}" if urn else name
