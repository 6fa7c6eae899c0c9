"""The edge of the world on a map: move features to one side of it, and find borders that only follow it."""

from collections.abc import Callable
from dataclasses import replace
from math import pi
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture_geo.base.crs import period, same_system, transform_points
from vexture_geo.maps.caps import WORLD
from vexture_geo.maps.domain import POLE, TURN, domain_of, is_wide, within_turn
from vexture_geo.maps.place import MERCATOR, RADIUS
from vexture_geo.vector.features import Features, Lines, Points

NEAR: Final = 1e-4
"""Degrees from the edge within which a place lies on it; maps end slightly before the meridian of a tear."""

AT_RIM: Final = 0.02
"""Degrees from the rim of one side of the globe within which a place lies on it."""

ROUNDED: Final = 1e-9
"""Fraction of the world by which rounding moves its edge."""


def move_together(layers: list[Features], crs: str) -> list[Features]:
    """Move features that all lie near the antimeridian to one side of it: the side with most corners."""
    turn = _turn(crs)
    if turn is None:
        return layers
    reach = np.concatenate([_reach(features) for features in layers])
    shift = _shift(reach, turn)
    if len(reach) and turn / 2 < np.ptp(reach) > np.ptp(reach + shift[:, None]) < turn / 2:
        layers = [_shift_features(features, lambda own: _shift(own, turn)) for features in layers]
    x = np.concatenate([part[:, 0] for f in layers for part in (f.rings.points, f.lines.points, f.points.points)])
    away = turn * np.rint(np.median(x) / turn) if len(x) else 0.0
    return [_shift_features(features, lambda own: np.full(len(own), -away)) for features in layers] if away else layers


def _turn(crs: str) -> float | None:
    """Width of the world on a map whose longitudes repeat; None for other maps."""
    return 2.0 * pi * RADIUS if same_system(crs, MERCATOR) else period(crs)


def _shift(reach: NDArray[np.float64], turn: float) -> NDArray[np.float64]:
    """Eastward shifts of parts: a turn for those whose middle lies in the west."""
    return np.where(reach.mean(axis=1) < 0.0, turn, 0.0)


def _reach(features: Features) -> NDArray[np.float64]:
    """West and east of every polygon, line and point, (n, 2)."""
    spots = features.points.points[:, :1]
    parts = [features.rings.boxes[:, :, 0], _of_lines(features.lines), np.concatenate([spots, spots], axis=1)]
    return np.concatenate(parts)


def _of_lines(lines: Lines) -> NDArray[np.float64]:
    if not len(lines.ends):
        return np.empty((0, 2))
    starts, x = np.append(0, lines.ends[:-1]), lines.points[:, 0]
    return np.stack([np.minimum.reduceat(x, starts), np.maximum.reduceat(x, starts)], axis=1)


def _shift_features(features: Features, shift: Callable[[NDArray[np.float64]], NDArray[np.float64]]) -> Features:
    """Move features along x, each part by `shift` of its west and east."""
    rings, lines, points = features.rings, features.lines, features.points
    if len(rings.ends):
        rings = rings.shift_east(shift(rings.boxes[:, :, 0])[rings.polygon])
    if len(lines.ends):
        own = np.repeat(shift(_of_lines(lines)), np.diff(lines.ends, prepend=0))
        lines = Lines(lines.points + np.stack([own, np.zeros(len(own))], axis=1), lines.ends, lines.feature)
    own = shift(points.points[:, :1])
    points = Points(points.points + np.stack([own, np.zeros(len(own))], axis=1), points.feature)
    return replace(features, rings=rings, lines=lines, points=points)


def along_edge(sides: NDArray[np.float64], crs: str) -> NDArray[np.bool_]:
    """Find sides, (n, 2, 2), that follow the edge of a world map, a pole, or the equator around a hemisphere."""
    turn, points = _turn(crs), sides.reshape(-1, 2)
    if turn is not None:
        high, widest, places = turn / 2 if same_system(crs, MERCATOR) else turn / 4, turn / 2, points
        on = np.abs(np.abs(points) - (turn / 2, high)) <= ROUNDED * turn
    elif is_wide(crs) and (domain := domain_of(crs)) is not None:
        middle, degrees = (domain.box[0] + domain.box[2]) / 2, transform_points(points, crs, WORLD)
        # a point on the map that rounding leaves without a place lies at the edge
        degrees[~np.isfinite(degrees).all(axis=1)] = (middle + TURN / 2, 0.0)
        longitude = within_turn(degrees - (middle, 0.0))[:, 0]
        latitude, places = np.abs(degrees[:, 1]), degrees
        high, widest = POLE, np.inf  # a place at the edge may have been found on either side
        torn = np.abs(longitude) >= (TURN / 2 - NEAR if domain.pole == 0.0 else np.inf)
        cut_at = POLE if domain.pole == 0.0 else 0.0
        for west, south, east, north in domain.slits:
            beside = np.abs(within_turn(degrees - ((west + east) / 2, 0.0))[:, 0]) <= NEAR
            torn |= beside & (south - NEAR <= degrees[:, 1]) & (degrees[:, 1] <= north + NEAR)
        on = np.stack([torn, np.abs(latitude - cut_at) <= NEAR], axis=1)
        if domain.cap is not None:
            on = np.stack([domain.cap.distance(degrees) >= domain.cap.radius - AT_RIM, np.zeros_like(torn)], axis=1)
    else:
        return np.zeros(len(sides), np.bool_)
    both: NDArray[np.bool_] = np.all(on.reshape(-1, 2, 2), axis=1)
    step = np.abs(np.diff(places.reshape(-1, 2, 2), axis=1))[:, 0]
    both &= step < np.array([widest, high])  # a side from one edge to the other crosses the map
    return both[:, 0] | both[:, 1]
