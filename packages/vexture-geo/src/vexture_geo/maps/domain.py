"""The part of the world that a map can show as a whole: up to its tear, or around a pole or a place."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from math import pi
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture_geo.base.crs import system, transform_points
from vexture_geo.base.extent import Bounds
from vexture_geo.base.rings import Rings, cut, rings_of, within
from vexture_geo.maps.caps import WORLD, Cap, cap_of

TURN: Final = 360.0
POLE: Final = 90.0

EVER: Final = 4.0 * TURN
"""Longitude that no feature reaches, to the west or the east, in degrees."""

BESIDE: Final = 1e-5
"""Degrees by which a map ends before the meridian where it is torn, because datums differ by that much."""

NEAR: Final = 1e-3
"""Distance of places on both sides of a meridian, as a fraction of the map, below which it is not torn there."""

TORN: Final = 1e-6
"""Distance of places beside a meridian, as a fraction of the map, above which a known tear separates them."""

JUMP: Final = 0.02
"""A side whose image remains longer than this fraction of the map after `HALVINGS` halvings crosses a tear."""

HALVINGS: Final = 20

WIDE: Final = 0.9
"""Fraction of a turn that the area of use of a system covers if its maps show the world."""

MOST_STRAIN: Final = 100.0
"""Ratio of areas on the map to areas on the ground above which only a system's area of use is shown."""

LEAST_SIDE: Final = 2.0
"""Degrees. Places closer to an area of use than its own sides, or than this, are not far outside it."""

MOST_SAMPLES: Final = 10_000


@dataclass(frozen=True)
class Domain:
    """Part of the world, in degrees of longitude and latitude.

    Parameters
    ----------
    box : tuple of float
        West, south, east and north; all longitudes for a hemisphere, whose meridians meet.
    pole : float
        Latitude of the pole in a hemisphere or a cap; 0 for other maps.
    cap : Cap, optional
        Cap that a perspective map shows.
    slits : tuple of tuple of float
        Narrow boxes where an interrupted map is torn, each from a pole towards the equator.
    """

    box: Bounds
    pole: float = 0.0
    cap: Cap | None = None
    slits: tuple[Bounds, ...] = ()

    @property
    def turn(self) -> float | None:
        """Period of the longitudes, if a place may also lie on the other side of the map."""
        return None if self.pole else TURN


@lru_cache(maxsize=64)
def domain_of(crs: str) -> Domain | None:
    """Part of the world that a system can show as a whole; None if its maps are not torn at a meridian.

    Examples
    --------
    >>> domain_of("EPSG:3031").pole, domain_of("EPSG:3035"), [round(side) for side in domain_of("EPSG:8857").box]
    (-90.0, None, [-180, -90, 180, 90])
    """
    found = system(crs)
    if found.is_geographic:
        return Domain((-TURN / 2, -POLE, TURN / 2, POLE))
    if not found.is_projected:
        return None
    middle = _middle(crs)
    if (cap := cap_of(crs, middle)) is not None:
        return Domain((-EVER, -POLE, EVER, POLE), cap.pole, cap)
    for pole in (POLE, -POLE):
        around = np.array([(longitude, 8 / 9 * pole) for longitude in (0.0, 90.0, 180.0, 270.0)])
        center, *ring = transform_points(np.concatenate([[(0.0, pole)], around]), WORLD, crs)
        with np.errstate(invalid="ignore"):
            radii = np.hypot(*(np.array(ring) - center).T)
            opposite = np.abs((ring[0] + ring[2]) / 2 - center).max()
        if np.isfinite(radii).all() and radii.max() - radii.min() + opposite < NEAR * radii.max():
            return Domain((-EVER, min(pole, 0.0), EVER, max(pole, 0.0)), pole)
    half = TURN / 2 - BESIDE
    sides = np.array([(middle + side * half, latitude) for latitude in (-40.0, 0.0, 40.0) for side in (-1.0, 1.0)])
    places = transform_points(sides, WORLD, crs)
    with np.errstate(invalid="ignore"):  # NaN where there is no image
        gaps = np.hypot(*(places[1::2] - places[::2]).T)
    if gaps.max() < NEAR * np.abs(places).max():
        return None
    return Domain((middle - half, -POLE, middle + half, POLE), slits=_slits(crs, middle) if is_wide(crs) else ())


def _slits(crs: str, middle: float) -> tuple[Bounds, ...]:
    """Slits of an interrupted map: at whole degrees from its own meridian, from a pole to where its lobes meet."""
    meridians = middle + np.arange(1.0 - TURN / 2, TURN / 2)
    found = list[Bounds]()
    for pole in (POLE, -POLE):
        torn = _gaps(crs, meridians, np.full(len(meridians), pole / 2)) > NEAR
        low, high = np.zeros(len(meridians)), np.full(len(meridians), pole / 2)
        for _ in range(30 if torn.any() else 0):
            half = (low + high) / 2
            is_torn = _gaps(crs, meridians, half) > TORN
            low, high = np.where(is_torn, low, half), np.where(is_torn, half, high)
        for x, y in zip(meridians[torn].tolist(), low[torn].tolist(), strict=True):
            found.append((x - BESIDE, min(y, pole), x + BESIDE, max(y, pole)))
    return tuple(found)


def _gaps(crs: str, meridians: NDArray[np.float64], latitudes: NDArray[np.float64]) -> NDArray[np.float64]:
    """Distances on a map between the two sides of meridians, as fractions of its size; 0 without an image."""
    both = [np.stack([meridians + side, latitudes], axis=1) for side in (-BESIDE, BESIDE)]
    ends = np.array([(meridians[0], 0.0), (meridians[-1], 0.0)])
    west, east, corners = np.split(transform_points(np.concatenate([*both, ends]), WORLD, crs), [len(meridians), -2])
    with np.errstate(invalid="ignore"):
        gaps = np.hypot(*(east - west).T) / np.hypot(*(corners[1] - corners[0]))
    return np.where(np.isfinite(gaps), gaps, 0.0)


def is_wide(crs: str) -> bool:
    """Return whether maps in a system are of the world or of a hemisphere."""
    area = system(crs).area_of_use
    return area is None or area.east - area.west > WIDE * TURN


def within_turn(degrees: NDArray[np.float64]) -> NDArray[np.float64]:
    """Normalise longitudes to above -180 and up to 180."""
    turns = np.ceil(degrees[:, 0] / TURN - 0.5)
    return degrees - np.stack([TURN * turns, np.zeros(len(turns))], axis=1)


def is_far(degrees: NDArray[np.float64], crs: str) -> bool:
    """Return whether some of the places, in longitude and latitude, are far outside of a system's area of use.

    Examples
    --------
    >>> is_far(np.array([[12.0, 55.0]]), "EPSG:28992"), is_far(np.array([[8.0, 54.0]]), "EPSG:28992")
    (True, False)
    """
    area = system(crs).area_of_use
    if area is None or not len(degrees):
        return False
    east = area.east + TURN * (area.east < area.west)
    middle = np.array([(area.west + east) / 2, (area.south + area.north) / 2])
    sides = np.array([east - area.west, area.north - area.south])
    known = degrees[np.isfinite(degrees).all(axis=1)]
    beyond = np.abs(within_turn(known - (middle[0], 0.0)) - (0.0, middle[1])) - sides / 2
    return bool((beyond > np.maximum(sides, LEAST_SIDE)).any())


def _middle(crs: str) -> float:
    """Longitude of a map's own meridian, in degrees."""
    operation = system(crs).coordinate_operation
    if operation is None:
        return 0.0
    named = [param for param in operation.params if param.name.startswith("Longitude of") or param.name == "lon_0"]
    return float(named[0].value) * named[0].unit_conversion_factor * 180.0 / pi if named else 0.0


def in_box(rings: Rings, box: Bounds, turn: float | None) -> Rings:
    """Clip polygons to a box, including parts that lie in it a turn away."""
    if not len(rings.ends):
        return rings
    west, south, east, north = rings.box
    if box[0] <= west and box[1] <= south and east <= box[2] and north <= box[3]:
        return rings
    return cut(within(rings, box, turn), box)


def cut_open(rings: Rings, slits: tuple[Bounds, ...]) -> Rings:
    """Cut slits out of polygons."""
    import shapely

    low, high = rings.boxes[:, None, 0], rings.boxes[:, None, 1]
    narrow = np.array(slits)
    crossing = np.any(np.all((low < narrow[:, 2:]) & (high > narrow[:, :2]), axis=2), axis=1)
    if not crossing.any():
        return rings
    leaving = np.flatnonzero(crossing)
    parts, owner = shapely.get_parts(without(slits)(rings.take(leaving).shapes), return_index=True)
    feature = None if rings.feature is None else rings.feature[leaving[owner]]
    return rings.take(np.flatnonzero(~crossing)).concatenate(
        rings_of(parts, lambda index: rings.place(int(leaving[owner[index]])), feature)
    )


def without(slits: tuple[Bounds, ...]) -> Callable[[NDArray[Any]], NDArray[Any]]:
    """Return a function that cuts slits out of polygons or lines."""
    import shapely

    whole = shapely.union_all(shapely.box(*np.array(slits).T))
    return lambda shapes: np.asarray(shapely.difference(shapes, whole))


def torn_sides(rings: Rings, crs: str) -> NDArray[np.bool_]:
    """Return whether a map is torn across the side after each point, in longitude and latitude."""
    first, last = rings.points.copy(), rings.points[rings.following]
    places = transform_points(rings.points, WORLD, crs)
    known = places[np.isfinite(places).all(axis=1)]
    least = JUMP * float(np.ptp(known, axis=0).max()) if len(known) else np.inf
    with np.errstate(invalid="ignore"):
        torn: NDArray[np.bool_] = np.hypot(*(places[rings.following] - places).T) > least
        for _ in range(HALVINGS if torn.any() else 0):
            west, east = first[torn], last[torn]
            half = (west + east) / 2
            there = np.split(transform_points(np.concatenate([west, half, east]), WORLD, crs), 3)
            gaps = np.hypot(*(there[1] - there[0]).T), np.hypot(*(there[2] - there[1]).T)
            is_first = gaps[0] >= gaps[1]
            first[torn] = np.where(is_first[:, None], west, half)
            last[torn] = np.where(is_first[:, None], half, east)
            torn[torn] = np.maximum(*gaps) > least
    return torn


def is_strained(degrees: NDArray[np.float64], crs: str) -> bool:
    """Return whether some places in longitude and latitude are shown much larger than others, or not at all."""
    from pyproj import Proj
    from pyproj.exceptions import ProjError

    found = system(crs)
    domain = domain_of(crs)
    if not found.is_projected or not len(degrees) or (domain and domain.slits):  # all seems large beside a tear
        return False
    longitude, latitude = degrees[:: 1 + len(degrees) // MOST_SAMPLES].T
    try:
        scale = Proj(found).get_factors(longitude, latitude, errcheck=False).areal_scale
    except ProjError:
        return False
    there = np.abs(latitude) < POLE * (1.0 - 1e-9)
    return bool((np.asarray(scale)[there] > MOST_STRAIN).any())
