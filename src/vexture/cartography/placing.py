"""Features on the plane of a map: unwrapped, repaired, cut to where the plane is defined, transformed, snapped."""

from dataclasses import replace
from typing import Any, Final

import numpy as np
import shapely
from numpy.typing import NDArray

from vexture.deadline import check_time
from vexture.errors import SourceError
from vexture.geo.crs import (
    period,
    refuse_metres,
    same_system,
    shown_bounds,
    shown_system,
    system,
    transformed,
    transformed_bounds,
)
from vexture.geo.extent import Bounds
from vexture.geo.features import Features
from vexture.geo.geojson import WORLD
from vexture.geo.rings import Rings, cut, moved, refuse_far, repaired, rings_of, shared, unwrapped
from vexture.notes import Notes

__all__ = ["MERCATOR", "placed"]

MERCATOR: Final = "EPSG:3857"
BEYOND: Final = 5.0
"""Degrees around the area of a reference system, in which it still serves."""

POLAR: Final = 80.0
"""Degrees of latitude from which the end of an area is one of the plane, too, as of Web Mercator."""

FINE: Final = 1e-3
"""Share of a map's size, at which lines are halved where a transform bends them."""


def placed(features: Features, crs: str, snap: float | None, gaps: float, notes: Notes) -> Features:
    """The features in the plane of a map; polygons come first, and each is valid.

    Parameters
    ----------
    features : Features
    crs : str
        Reference system of the map.
    snap : float or None
        As in `vexture.read_geojson`: borders that differ by so little, in parts of the map's size, become one.
    gaps : float
        Gaps between neighbours that are narrower than this, in units of `crs`, are closed, and overlaps given to the
        neighbour with the longest border; 0 leaves both, and tells of them.
    notes : Notes
        Gets what was repaired, cut or left out.

    Raises
    ------
    SourceError
        If nothing of them is in the plane.
    """
    areal = shapely.get_type_id(features.parts) == shapely.GeometryType.POLYGON
    polygons, owner = features.parts[areal], features.feature[areal]
    found: list[NDArray[Any]] = []
    feature: list[NDArray[np.intp]] = []
    if len(polygons):
        polygons, kept = _areas(rings_of(polygons, str), features.crs, crs, snap, notes)
        owner = owner[kept]
        polygons = _covering(polygons, gaps, notes)
        found.append(polygons)
        feature.append(owner)
    others = features.parts[~areal]
    if len(others):
        others, kept = _others(others, features.crs, crs)
        found.append(others)
        feature.append(features.feature[~areal][kept])
    parts = np.concatenate(found) if found else np.empty(0, object)
    if not len(parts):
        x0, y0, x1, y1 = shapely.total_bounds(features.parts)
        where = shown_bounds((x0, y0, x1, y1), features.crs)
        raise SourceError(f"its extent {where} has no place in {shown_system(crs)}; choose another reference system")
    return replace(features, parts=parts, feature=np.concatenate(feature), crs=crs)


def _areas(rings: Rings, own: str, crs: str, snap: float | None, notes: Notes) -> tuple[NDArray[Any], NDArray[np.intp]]:
    """Polygons in the plane, and which of the given ones each is of; their places are their numbers."""
    refuse_far(rings, "correct it")
    rings = _within_world(rings, own)
    broken = int((~shapely.is_valid(rings.shapes)).sum())
    if broken:
        notes.count("simplified", "polygon whose rings cross, repaired")
        rings = repaired(rings, notes)
    rings = _cut_to(rings, own, crs, notes)
    if not same_system(own, crs) and len(rings.ends):
        box = transformed(_outline(rings.box), own, crs)
        low, high = box.min(axis=0), box.max(axis=0)
        whole: Bounds = (float(low[0]), float(low[1]), float(high[0]), float(high[1]))
        rings = moved(rings, lambda points: transformed(points, own, crs), whole, high - low)
        refuse_far(rings, f"it has no place in {shown_system(crs)}; choose another reference system")
    if len(rings.ends):
        x0, y0, x1, y1 = rings.box
        rings = shared(rings, max(x1 - x0, y1 - y0), snap, notes)
    count = len(rings.outer)
    return rings.shapes, np.array([int(rings.place(k)) for k in range(count)], np.intp)


def _within_world(rings: Rings, own: str) -> Rings:
    """Rings of longitudes within half a turn on both sides of 0; those that cross the antimeridian are cut there."""
    turn = period(own)
    if not turn:
        return rings
    refuse_metres(rings.points, own, f"the coordinates {shown_bounds(rings.box, own)}")
    longitude = rings.points[:, 0]
    jumps = np.abs(longitude[rings.following] - longitude) > turn / 2
    crossing = np.unique(rings.polygon[np.searchsorted(rings.ends, np.flatnonzero(jumps), side="right")])
    beyond = np.flatnonzero((np.abs(rings.boxes[:, :, 0]) > turn / 2).any(axis=1))
    odd = np.union1d(crossing, beyond)
    if not len(odd):
        return rings
    rest = np.setdiff1d(np.arange(len(rings.outer)), odd)
    found = rings.taken(rest)
    for k in odd.tolist():  # each by itself: what is unwrapped together moves together
        check_time()
        one = unwrapped(rings.taken(np.array([k])), turn)
        for shift in (-turn, 0.0, turn):
            there = replace(one, points=one.points + np.array([shift, 0.0]))
            (west, _), (east, _) = there.boxes[0]
            if west < turn / 2 and east > -turn / 2:
                south, north = float(there.boxes[0, 0, 1]), float(there.boxes[0, 1, 1])
                found = found.joined(cut(there, (-turn / 2, south - 1.0, turn / 2, north + 1.0)))
    return found


def _reach(own: str, crs: str) -> Bounds | None:
    """Bounds in one system of where another can be used, a little beyond what its authority says; None of all."""
    area = system(crs).area_of_use
    if area is None or same_system(own, crs):
        return None
    west, south, east, north = area.bounds
    if east < west:
        return None
    wide = (max(west - BEYOND, -180.0), south - BEYOND, min(east + BEYOND, 180.0), north + BEYOND)
    high = (max(wide[1], -90.0) if abs(south) < POLAR else south, min(wide[3], 90.0) if abs(north) < POLAR else north)
    return transformed_bounds((wide[0], high[0], wide[2], high[1]), WORLD, own)


def _cut_to(rings: Rings, own: str, crs: str, notes: Notes) -> Rings:
    """Rings within the area for which a reference system is made."""
    reach = _reach(own, crs)
    if reach is None or not len(rings.ends):
        return rings
    x0, y0, x1, y1 = rings.box
    if x0 >= reach[0] and y0 >= reach[1] and x1 <= reach[2] and y1 <= reach[3]:
        return rings
    notes.remark(f"what is outside of {shown_bounds(reach, own)} is cut off, as {shown_system(crs)} is not for it")
    inside = (rings.boxes[:, 0] < reach[2:]).all(axis=1) & (rings.boxes[:, 1] > reach[:2]).all(axis=1)
    return cut(rings.taken(np.flatnonzero(inside)), reach)


def _outline(box: Bounds) -> NDArray[np.float64]:
    """Points around a box, (n, 2)."""
    x, y = np.linspace(box[0], box[2], 33), np.linspace(box[1], box[3], 33)
    grid = np.stack(np.meshgrid(x, y), axis=-1)
    return np.concatenate([grid[0], grid[-1], grid[:, 0], grid[:, -1]])


def _covering(polygons: NDArray[Any], gaps: float, notes: Notes) -> NDArray[Any]:
    """The polygons, whose gaps and overlaps are repaired or told."""
    if len(polygons) < 2:
        return polygons
    if gaps > 0.0:
        before = shapely.area(polygons)
        cleaned = shapely.coverage_clean(polygons, gap_width=gaps, merge_strategy="longest_border")
        changed = int((np.abs(shapely.area(cleaned) - before) > 1e-9 * before.max()).sum())
        if changed:
            notes.count("simplified", f"{changed} polygons with gaps or overlaps between neighbours, closed")
        return np.asarray(cleaned, object)
    overlapping = ~shapely.is_empty(shapely.coverage_invalid_edges(polygons))
    if overlapping.any():
        notes.remark(
            f"{int(overlapping.sum())} polygons overlap others, or meet them off their corners; the later is on top"
        )
    return polygons


def _others(parts: NDArray[Any], own: str, crs: str) -> tuple[NDArray[Any], NDArray[np.intp]]:
    """Lines and points in the plane, and which of the given ones each is of."""
    lines = shapely.get_type_id(parts) == shapely.GeometryType.LINESTRING
    if not same_system(own, crs):
        reach = _reach(own, crs)
        if reach is not None:
            parts = shapely.clip_by_rect(parts, *reach)
        x0, y0, x1, y1 = shapely.total_bounds(parts)
        parts = parts.copy()
        parts[lines] = shapely.segmentize(parts[lines], FINE * max(x1 - x0, y1 - y0, 1e-9))
        parts = shapely.transform(parts, lambda points: transformed(points, own, crs))
    parts, kept = shapely.get_parts(parts, return_index=True)
    whole = ~shapely.is_empty(parts) & np.isfinite(shapely.bounds(parts)).all(axis=1)
    return parts[whole], kept[whole]
