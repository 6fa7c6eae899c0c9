"""A map: features in the colours of an attribute, as one texture that can be recoloured and asked."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Final

import numpy as np
import shapely
from numpy.typing import NDArray

from vexture.bezier.convert import line_cubics
from vexture.cartography.marks import Length, strokes, symbols
from vexture.cartography.placing import MERCATOR, placed
from vexture.cartography.scales import MARK, PLAIN, Legend, Scale, colours_of, values_of
from vexture.drawing import Drawing, Path
from vexture.errors import ParameterError, SourceError
from vexture.geo.features import Features, joined
from vexture.geo.rings import rings_of
from vexture.layout import MOST_PAINTS
from vexture.notes import Notes
from vexture.paint import Paint
from vexture.tolerance import CLOSED
from vexture.unit_square import clipped, tidied

if TYPE_CHECKING:
    from pyarrow import Table

__all__ = ["Layout", "MapDrawing", "drawn"]

PIXELS: Final = 1000.0
STROKE, SYMBOL = Length(1.5, "px"), Length(8.0, "px")


@dataclass(frozen=True, slots=True)
class Layout:
    """How features become a map.

    Parameters
    ----------
    crs : str
        Reference system of its plane.
    color : str or None
        Column whose values are the colours.
    scale : Scale
    order : str or None
        Column by which features lie over one another, the greatest on top, or ``area``: the smallest on top; by
        default as they are in the source.
    snap : float or None
        As in `vexture.read_geojson`.
    gaps : float
        Gaps between neighbours up to this width, in units of `crs`, and all overlaps, are closed; 0 leaves both.
    stroke, symbol_size : Length
        Width of lines, and of the symbols of points.
    symbol : Drawing or None
        What stands at points; None is a disc.
    pixels : float
        Pixels of the map's longer side, for lengths in pixels.
    """

    crs: str = MERCATOR
    color: str | None = None
    scale: Scale = field(default_factory=Scale)
    order: str | None = None
    snap: float | None = None
    gaps: float = 0.0
    stroke: Length = STROKE
    symbol: Drawing | None = None
    symbol_size: Length = SYMBOL
    pixels: float = PIXELS


@dataclass(frozen=True, slots=True, eq=False)
class MapDrawing:
    """The drawing of a map, whose elements are the features by their names; its table, and its legend if it has one."""

    drawing: Drawing
    table: "Table"
    legend: Legend | None


def drawn(several: Sequence[Features], layout: Layout, name: str, notes: Notes) -> MapDrawing:
    """Draw features, those of later sources over those of earlier ones.

    Raises
    ------
    ParameterError
        If a column or an option does not fit.
    SourceError
        If nothing of the features is in the map's plane.
    LimitError
        If sources name two features alike.
    """
    features = joined([placed(one, layout.crs, layout.snap, layout.gaps, notes) for one in several])
    if len(features.ids) >= MOST_PAINTS:
        raise SourceError(f"it has {len(features.ids):,} features; the limit of one texture is {MOST_PAINTS - 1:,}")
    rgba, legend = _colours(features, layout)
    box = shapely.total_bounds(features.parts)
    size = float(max(box[2] - box[0], box[3] - box[1]))
    if not size > 0.0:
        raise SourceError("all of it is at one place; give features that are apart, or areas")
    areas, feature, marked = _areas(features, layout, size)
    outer = shapely.total_bounds([*areas, *(shapely.box(*mark) for mark in marked.boxes)])
    to_source = _square(outer)
    paths = _paths(areas, feature, features, rgba, to_source)
    paths += _symbol_paths(marked, features, rgba, layout.color is not None, to_source)
    if not paths:
        raise SourceError("none of its features has an area at this size; give `stroke` or `symbol-size`")
    ordered = [path for _, path in sorted(paths, key=_key(features, layout))]
    sides = outer[2:] - outer[:2]
    drawing = Drawing(
        tuple(ordered), to_source, name, features.crs, notes.listed, sides=tuple((sides / sides.max()).tolist())
    )
    return MapDrawing(drawing, features.table, legend)


def _colours(features: Features, layout: Layout) -> tuple[NDArray[np.float64], Legend | None]:
    """Colours of all features, and what they mean; lines and points without a value stand out from areas."""
    areal = shapely.get_type_id(features.parts) == shapely.GeometryType.POLYGON
    marks = np.ones(len(features.ids), np.bool_)
    marks[features.feature[areal]] = False
    if layout.color is None:
        return np.where(marks[:, None], np.array(MARK), np.array(PLAIN)), None
    values = values_of(features.table, layout.color)
    known = np.isfinite(values) if values.dtype.kind == "f" else np.array([value is not None for value in values])
    shown = known | ~marks
    rgba = np.tile(np.array(MARK), (len(values), 1))
    rgba[shown], legend = colours_of(values[shown], layout.color, layout.scale)
    return rgba, legend


@dataclass(frozen=True, slots=True, eq=False)
class _Marked:
    """Symbols at points: their drawing, where they stand, and their features."""

    symbol: Drawing | None
    corners: NDArray[np.float64]
    sides: NDArray[np.float64]
    feature: NDArray[np.intp]

    @property
    def boxes(self) -> NDArray[np.float64]:
        return np.concatenate([self.corners, self.corners + self.sides[:, None]], axis=1)


def _areas(features: Features, layout: Layout, size: float) -> tuple[NDArray[Any], NDArray[np.intp], _Marked]:
    """Polygons of all features but those with symbols, and which feature each is of."""
    kinds = shapely.get_type_id(features.parts)
    point, areal = kinds == shapely.GeometryType.POINT, kinds == shapely.GeometryType.POLYGON
    line = ~point & ~areal
    found, feature = [features.parts[areal]], [features.feature[areal]]
    if line.any():
        found.append(strokes(features.parts[line], layout.stroke, features.crs, size, layout.pixels))
        feature.append(features.feature[line])
    places, owner = shapely.get_coordinates(features.parts[point]), features.feature[point]
    if layout.symbol is not None and len(places):
        corners, sides = symbols(places, layout.symbol, layout.symbol_size, features.crs, size, layout.pixels)
        marked = _Marked(layout.symbol, corners, sides, owner)
    else:
        marked = _Marked(None, np.empty((0, 2)), np.empty(0), np.empty(0, np.intp))
        if len(places):
            half = layout.symbol_size.at(places, features.crs, size, layout.pixels) / 2.0
            found.append(np.asarray(shapely.buffer(features.parts[point], half), object))
            feature.append(owner)
    areas, part = shapely.get_parts(np.concatenate(found), return_index=True)
    whole = ~shapely.is_empty(areas)
    return areas[whole], np.concatenate(feature)[part][whole], marked


def _square(box: NDArray[np.float64]) -> NDArray[np.float64]:
    """Map from the unit square to the plane: a box in the middle of it, as large as fits."""
    size, middle = float((box[2:] - box[:2]).max()), (box[2:] + box[:2]) / 2.0
    return np.array([[size, 0.0, middle[0] - size / 2.0], [0.0, size, middle[1] - size / 2.0]])


def _paths(
    areas: NDArray[Any],
    feature: NDArray[np.intp],
    features: Features,
    rgba: NDArray[np.float64],
    to_source: NDArray[np.float64],
) -> list[tuple[int, Path]]:
    """A path for each feature, in the unit square, with the feature's number."""
    if not len(areas):
        return []
    order = np.argsort(feature, kind="stable")
    rings = rings_of(areas[order], lambda index: str(features.ids[feature[order][index]]))
    owner = feature[order][np.flatnonzero(~shapely.is_empty(areas[order]))[rings.polygon]]
    start = np.clip((rings.points - to_source[:, 2]) / to_source[0, 0], 0.0, 1.0)
    end = start[rings.following]
    sides = line_cubics(start, end)
    if (np.abs(end - start) > CLOSED).any(axis=1).all():
        contours = dict(enumerate(np.split(sides, rings.ends[:-1])))
    else:
        contours = tidied(*clipped(sides, rings.ends, np.zeros(2), np.ones(2)))
    held: dict[int, list[NDArray[np.float64]]] = {}
    for ring, contour in contours.items():
        held.setdefault(int(owner[ring]), []).append(contour)
    return [
        (k, Path.closed(tuple(several), _paint(rgba[k]), str(features.ids[k]))) for k, several in sorted(held.items())
    ]


def _paint(rgba: NDArray[np.float64]) -> Paint:
    red, green, blue, opacity = rgba.tolist()
    return Paint((red, green, blue), opacity)


def _symbol_paths(
    marked: _Marked, features: Features, rgba: NDArray[np.float64], coloured: bool, to_source: NDArray[np.float64]
) -> list[tuple[int, Path]]:
    """Copies of a symbol, in its own colours or in those of the features."""
    if marked.symbol is None:
        return []
    shown = marked.symbol.flat()
    corners = (marked.corners - to_source[:, 2]) / to_source[0, 0]
    sides = marked.sides / to_source[0, 0]
    return [
        (
            int(k),
            replace(
                path,
                contours=tuple(np.clip(corner + side * contour, 0.0, 1.0) for contour in path.contours),
                paint=_paint(rgba[k]) if coloured else path.paint,
                element=str(features.ids[k]),
            ),
        )
        for k, corner, side in zip(marked.feature.tolist(), corners, sides, strict=True)
        for path in shown.paths
    ]


AREA: Final = "area"


def _key(features: Features, layout: Layout) -> Any:
    """What paths are ordered by, from below."""
    if layout.order is None:
        return lambda pair: pair[0]
    if layout.order == AREA and AREA not in features.table.column_names:
        values = -np.bincount(features.feature, shapely.area(features.parts), len(features.ids))
    else:
        values = values_of(features.table, layout.order)
        if values.dtype.kind != "f":
            raise ParameterError(f"`order` {layout.order!r}: the column holds texts; choose one of numbers, or area")
        values = np.nan_to_num(values, nan=-np.inf)
    return lambda pair: (values[pair[0]], pair[0])
