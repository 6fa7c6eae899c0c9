"""What of the world a map can show as a whole: up to the meridian where it is torn, or the half of it around a pole."""

from dataclasses import dataclass
from functools import lru_cache
from math import pi
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.geo.crs import system, transformed
from vexture.geo.extent import Bounds
from vexture.geo.rings import Rings, cut, within

__all__ = [
    "EVER",
    "POLE",
    "TURN",
    "WORLD",
    "Domain",
    "domain_of",
    "in_box",
    "is_far",
    "is_strained",
    "is_wide",
    "within_turn",
]

WORLD: Final = "EPSG:4326"
TURN: Final = 360.0
POLE: Final = 90.0

EVER: Final = 4.0 * TURN
"""Degrees to the west or the east that no longitude reaches."""

BESIDE: Final = 1e-5
"""Degrees that a map ends before the meridian where it is torn: datums differ by that."""

NEAR: Final = 1e-3
"""Parts of a map: the distance of two places beside the meridian opposite to its own, if it is not torn there."""

WIDE: Final = 0.9
"""Parts of a turn. What a system covers if it is one of the world."""

MOST_STRAIN: Final = 100.0
"""Times by which areas may be larger than on the ground, before only the area of use of a system is shown."""

LEAST_SIDE: Final = 2.0
"""Degrees. As far as its own sides from an area of use, and from a small one so far, is not far outside of it."""

MOST_SAMPLES: Final = 10_000


@dataclass(frozen=True)
class Domain:
    """Longitudes and latitudes in degrees.

    Parameters
    ----------
    box : tuple of float
        West, south, east, north; of a hemisphere, whose meridians meet, all longitudes.
    pole : float
        Latitude of the pole in the middle of a hemisphere; 0 of another map.
    """

    box: Bounds
    pole: float = 0.0

    @property
    def turn(self) -> float | None:
        """Period of the longitudes, where the same place may lie on the other side of the map."""
        return None if self.pole else TURN


@lru_cache(maxsize=64)
def domain_of(crs: str) -> Domain | None:
    """What a system can show as a whole; None if its maps are not torn at a meridian.

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
    for pole in (POLE, -POLE):
        around = np.array([(longitude, 8 / 9 * pole) for longitude in (0.0, 90.0, 180.0, 270.0)])
        center, *ring = transformed(np.concatenate([[(0.0, pole)], around]), WORLD, crs)
        with np.errstate(invalid="ignore"):
            radii = np.hypot(*(np.array(ring) - center).T)
            opposite = np.abs((ring[0] + ring[2]) / 2 - center).max()
        if np.isfinite(radii).all() and radii.max() - radii.min() + opposite < NEAR * radii.max():
            return Domain((-EVER, min(pole, 0.0), EVER, max(pole, 0.0)), pole)
    half = TURN / 2 - BESIDE
    sides = np.array([(middle + side * half, latitude) for latitude in (-40.0, 0.0, 40.0) for side in (-1.0, 1.0)])
    places = transformed(sides, WORLD, crs)
    with np.errstate(invalid="ignore"):  # not a number where there is no image
        gaps = np.hypot(*(places[1::2] - places[::2]).T)
    if gaps.max() < NEAR * np.abs(places).max():
        return None
    return Domain((middle - half, -POLE, middle + half, POLE))


def is_wide(crs: str) -> bool:
    """Whether maps in a system are of the world or of a hemisphere."""
    area = system(crs).area_of_use
    return area is None or area.east - area.west > WIDE * TURN


def within_turn(degrees: NDArray[np.float64]) -> NDArray[np.float64]:
    """Places with their longitudes above -180 and up to 180."""
    turns = np.ceil(degrees[:, 0] / TURN - 0.5)
    return degrees - np.stack([TURN * turns, np.zeros(len(turns))], axis=1)


def is_far(degrees: NDArray[np.float64], crs: str) -> bool:
    """Whether some of the places, in longitude and latitude, are far outside of a system's area of use.

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
    named = [param for param in operation.params if param.name.startswith("Longitude of")]
    return float(named[0].value) * named[0].unit_conversion_factor * 180.0 / pi if named else 0.0


def in_box(rings: Rings, box: Bounds, turn: float | None) -> Rings:
    """Polygons within a box, also those that are in it a turn away."""
    if not len(rings.ends):
        return rings
    west, south, east, north = rings.box
    if box[0] <= west and box[1] <= south and east <= box[2] and north <= box[3]:
        return rings
    return cut(within(rings, box, turn), box)


def is_strained(degrees: NDArray[np.float64], crs: str) -> bool:
    """Whether some of the places, in longitude and latitude, are shown much larger than others, or not at all."""
    from pyproj import Proj
    from pyproj.exceptions import ProjError

    found = system(crs)
    if not found.is_projected or not len(degrees):
        return False
    longitude, latitude = degrees[:: 1 + len(degrees) // MOST_SAMPLES].T
    try:
        scale = Proj(found).get_factors(longitude, latitude, errcheck=False).areal_scale
    except ProjError:
        return False
    there = np.abs(latitude) < POLE * (1.0 - 1e-9)
    return bool((np.asarray(scale)[there] > MOST_STRAIN).any())
