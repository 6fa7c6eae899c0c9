"""Polygons in the world's square: projected, cut at its borders, and repeated beyond the antimeridian."""

from typing import Any, Final

import numpy as np

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture.base.tolerance import ROUND
from vexture_geo.base.crs import format_bounds, period, refuse_metres, system, transform_points
from vexture_geo.base.longitudes import note_short_ways, unwrap_rings
from vexture_geo.base.rings import Rings, cut, map_rings, refuse_far, repair_rings, within
from vexture_geo.tiles.grid import CRS, HALF, LATITUDE, MARGIN, pixel
from vexture_geo.tiles.pieces import FeaturePieces

BENT: Final = 0.02
"""Largest error of a projected side, in pixels of the largest zoom."""

BEYOND: Final = 2.0 * MARGIN
"""Turns beyond the world on each side, to the east and the west, that the single tile at zoom 0 shows."""

DEGREES: Final = "EPSG:4326"


def in_world(features: Any, first: int, most: int, notes: Notes) -> FeaturePieces:
    """Cut a batch of features, numbered from `first`, into pieces for tiles up to a zoom."""
    rings, own = features.rings, features.crs
    if not len(rings.ends):
        return FeaturePieces(np.empty(0, np.int64), np.empty(0, object), np.empty(0, object))
    refuse_far(rings, "correct it")
    rings = _in_degrees(rings, own, most, notes) if system(own).is_geographic else _in_metres(rings, own, notes)
    feature = np.asarray(rings.feature, np.int64)
    ids = np.asarray(features.ids, object)[feature]
    return FeaturePieces(feature + first, ids, rings.shapes)


def _in_degrees(rings: Rings, crs: str, most: int, notes: Notes) -> Rings:
    """Project rings from longitude and latitude to metres, with copies beyond the antimeridian."""
    turn = period(crs)
    assert turn is not None
    degree = turn / 360.0
    refuse_metres(rings.points, crs, f"the coordinates {format_bounds(rings.box, crs)}")
    note_short_ways(rings.steps, turn, notes)
    rings = repair_rings(unwrap_rings(rings, turn), notes)
    reach = turn / 2.0 * (1.0 + BEYOND)
    world = (-reach, -LATITUDE * degree, reach, LATITUDE * degree)
    boxes = rings.boxes
    if (np.abs(boxes[:, :, 0]) > turn / 2.0 * (1.0 - BEYOND)).any() or (np.abs(boxes[:, :, 1]) > world[3]).any():
        rings = cut(within(rings, world, turn), world)
    if not len(rings.ends):
        return rings
    size = np.full(2, BENT * pixel(most) / ROUND)
    wide = 2.0 * HALF
    rings = map_rings(rings, lambda points: _project(points, crs, turn), (-wide, -wide, wide, wide), size)
    refuse_far(rings, "correct it")
    return _cut_to_world(rings)


def _project(points: Any, crs: str, turn: float) -> Any:
    """Project points to metres; those beyond the antimeridian stay beyond it."""
    turns = np.rint(points[:, 0] / turn)
    image = transform_points(points - np.stack([turns * turn, np.zeros(len(turns))], axis=1), crs, CRS)
    return image + np.stack([turns * 2.0 * HALF, np.zeros(len(turns))], axis=1)


def _in_metres(rings: Rings, crs: str, notes: Notes) -> Rings:
    """Project rings from a projected system to metres of Web Mercator."""
    rings = repair_rings(rings, notes)
    if crs != CRS:
        size = np.full(2, 1.0)
        wide = 2.0 * HALF
        rings = map_rings(rings, lambda points: transform_points(points, crs, CRS), (-wide, -wide, wide, wide), size)
        if not np.isfinite(rings.points).all():
            raise SourceError("it has points without a place in the tiles' projection, EPSG:3857; correct its `crs`")
        rings = repair_rings(rings, Notes())
    rings = within(rings, _world(), 2.0 * HALF)
    return _cut_to_world(rings)


def _world() -> tuple[float, float, float, float]:
    reach = HALF * (1.0 + BEYOND)
    return (-reach, -HALF, reach, HALF)


def _cut_to_world(rings: Rings) -> Rings:
    return cut(rings, _world()) if len(rings.ends) else rings
