"""Areas of lines and points: strokes of a width, and symbols of a size, in metres or in pixels."""

import re
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import ParameterError
from vexture_geo.base.rings import Rings, rings_of
from vexture_geo.maps.edges import along_edge
from vexture_geo.maps.place import units_per_metre
from vexture_geo.vector.features import Lines

TEXT: Final = re.compile(r"\s*(\d+(?:\.\d*)?|\.\d+)\s*(px|km|m)\s*")

STEP: Final = 0.02
"""Fraction by which the width of a stroke may change along a run, which is drawn with one width."""

ARC: Final = 8
"""Number of sides in a quarter of a stroke's round end."""


@dataclass(frozen=True)
class Width:
    """A length on the ground in metres, or on the screen in pixels of a map of a stated size."""

    value: float
    is_pixels: bool


def width_of(text: str, parameter: str) -> Width:
    """Parse a width such as ``500m``, ``2km`` or ``1.5px``.

    Examples
    --------
    >>> width_of("2km", "stroke"), width_of("1.5px", "stroke")
    (Width(value=2000.0, is_pixels=False), Width(value=1.5, is_pixels=True))
    """
    match = TEXT.fullmatch(text) if isinstance(text, str) else None
    if match is None or not float(match[1]) > 0.0:
        raise ParameterError(f"`{parameter}` is {text!r}; give a width above 0 such as 500m, 2km or 1.5px")
    return Width(float(match[1]) * (1000.0 if match[2] == "km" else 1.0), match[2] == "px")


def widths_at(points: NDArray[np.float64], width: Width, crs: str, pixel: float) -> NDArray[np.float64]:
    """Width at each point in units of the map; `pixel` is the size of a pixel in these units."""
    if width.is_pixels:
        return np.full(len(points), width.value * pixel)
    return width.value * units_per_metre(points, crs)


def strokes(lines: Lines, width: Width, crs: str, pixel: float) -> Rings:
    """Areas of lines with round joins and ends, as polygons of the lines' features.

    A line is cut into runs in which its width changes by at most 2%, so that widths are right on Web Mercator, too.
    """
    import shapely

    if not len(lines.ends):
        return rings_of(np.empty(0, object), str, lines.feature)
    runs, feature = _runs(lines, width, crs, pixel)
    middles = shapely.get_coordinates(shapely.line_interpolate_point(runs, 0.5, normalized=True))
    half = widths_at(middles, width, crs, pixel) / 2
    areas = shapely.buffer(runs, half, quad_segs=ARC)
    merged: list[Any] = []
    features = np.unique(feature)
    order = np.argsort(feature, kind="stable")
    for part in np.split(areas[order], np.searchsorted(feature[order], features)[1:]):
        merged.append(shapely.union_all(part) if len(part) > 1 else part[0])
    parts, owner = shapely.get_parts(np.array(merged, object), return_index=True)
    keep = shapely.get_type_id(parts) == shapely.GeometryType.POLYGON
    of = features[owner[keep]]
    return rings_of(parts[keep], lambda index: f"line {of[index]}", of.astype(np.intp))


def outlines(rings: Rings, width: Width, crs: str, pixel: float) -> Rings:
    """Area of the borders of polygons, each drawn once, as polygons of one feature.

    Borders between two parts of one feature, as along the antimeridian, and the edge of the world are not drawn.
    """
    import shapely

    points, after = rings.points, rings.following
    length = rings.ends - rings.starts
    assert rings.feature is not None
    of = np.repeat(rings.feature[rings.polygon], length)
    one, other = points.view(np.complex128).ravel(), points[after].view(np.complex128).ravel()
    sides = np.stack([np.minimum(one, other), np.maximum(one, other)], axis=1)  # complex numbers sort by x, then y
    different = one != other
    sides, of = sides[different], of[different]
    unique, side = np.unique(sides, axis=0, return_inverse=True)
    pairs, times = np.unique(np.stack([side.ravel(), of], axis=1), axis=0, return_counts=True)
    drawn = np.zeros(len(unique), np.bool_)
    drawn[pairs[times == 1, 0]] = True
    drawn[drawn] = ~along_edge(unique[drawn].view(np.float64).reshape(-1, 2, 2), crs)
    if not drawn.any():
        return rings_of(np.empty(0, object), str, np.empty(0, np.intp))
    ends = unique[drawn].view(np.float64).reshape(-1, 2, 2)
    merged = shapely.get_parts(shapely.line_merge(shapely.multilinestrings(shapely.linestrings(ends))))
    places, owner = shapely.get_coordinates(merged, return_index=True)
    last = np.searchsorted(owner, np.arange(len(merged)), side="right")
    return strokes(Lines(places, last, np.zeros(len(merged), np.intp)), width, crs, pixel)


def _runs(lines: Lines, width: Width, crs: str, pixel: float) -> tuple[NDArray[Any], NDArray[np.intp]]:
    """Cut lines into runs of nearly one width; return these and their features."""
    import shapely

    owner = np.repeat(np.arange(len(lines.ends)), np.diff(lines.ends, prepend=0))
    whole = shapely.linestrings(lines.points, indices=owner)
    wide = np.log(widths_at(lines.points, width, crs, pixel))
    spread = np.maximum.reduceat(wide, np.append(0, lines.ends[:-1])) - np.minimum.reduceat(
        wide, np.append(0, lines.ends[:-1])
    )
    long = np.flatnonzero(spread > STEP)
    if not len(long):
        return whole, lines.feature
    runs, feature = [whole[spread <= STEP]], [lines.feature[spread <= STEP]]
    for k in long.tolist():
        fine = shapely.get_coordinates(shapely.segmentize(whole[k], shapely.length(whole[k]) * STEP / spread[k]))
        step = np.floor(np.log(widths_at(fine, width, crs, pixel)) / STEP)
        cuts = np.flatnonzero(np.diff(step)) + 1
        firsts, lasts = np.append(0, cuts), np.append(cuts, len(fine) - 1)
        own = [shapely.LineString(fine[a : b + 1]) for a, b in zip(firsts, lasts, strict=True) if b > a]
        runs.append(np.array(own, object))
        feature.append(np.full(len(own), lines.feature[k]))
    return np.concatenate(runs), np.concatenate(feature)
