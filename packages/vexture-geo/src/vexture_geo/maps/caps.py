"""Caps of the globe around a place, which perspective maps show."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture_geo.base.crs import system, transform_points
from vexture_geo.base.rings import Rings, rings_of, within
from vexture_geo.maps.lines import change_lines
from vexture_geo.vector.features import Lines

PERSPECTIVES: Final = ("orthographic", "gnomonic", "vertical perspective", "geostationary", "proj nsper", "proj tpers")
"""Prefixes of the names of projections that show only one side of the globe."""

WORLD: Final = "EPSG:4326"

BESIDE: Final = 0.1
"""Degrees by which a map ends before its rim: 1e-6 of a globe seen from afar."""

MOST: Final = {"gnomonic": 65.0}
"""Largest radius of a cap, in degrees, where the rim would be too far away on the map."""

SAMPLES: Final = 3600
"""Corners of the rim as a polygon: its sides deviate by 4e-7 of the radius."""

TURNS: Final = 3
"""Turns to the west and to the east that features around a pole may reach."""


@dataclass(frozen=True)
class Cap:
    """Places within a distance of a middle: its longitude and latitude, and the radius, in degrees.

    Examples
    --------
    >>> one = Cap(0.0, 10.0, 65.0)
    >>> one.pole, one.distance(np.array([[0.0, -20.0]])).round(9)
    (0.0, array([30.]))
    """

    longitude: float
    latitude: float
    radius: float

    @property
    def pole(self) -> float:
        """Latitude of the pole in the cap, or 0 if it contains none."""
        return float(np.copysign(90.0, self.latitude)) if abs(self.latitude) + self.radius > 90.0 else 0.0

    def distance(self, degrees: NDArray[np.float64]) -> NDArray[np.float64]:
        """Distance on the globe, in degrees, from the middle to places in longitude and latitude."""
        east, north = np.radians(degrees - (self.longitude, 0.0)).T
        own = np.radians(self.latitude)
        cosine = np.sin(own) * np.sin(north) + np.cos(own) * np.cos(north) * np.cos(east)
        return np.asarray(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))

    def rim(self, count: int) -> NDArray[np.float64]:
        """Places on the rim, clockwise from the north, (count, 2)."""
        azimuth, own, radius = (
            np.arange(count) * 2.0 * np.pi / count,
            np.radians(self.latitude),
            np.radians(self.radius),
        )
        sine = np.sin(own) * np.cos(radius) + np.cos(own) * np.sin(radius) * np.cos(azimuth)
        east = np.arctan2(np.sin(azimuth) * np.sin(radius) * np.cos(own), np.cos(radius) - np.sin(own) * sine)
        return np.stack([self.longitude + np.degrees(east), np.degrees(np.arcsin(np.clip(sine, -1.0, 1.0)))], axis=1)

    @cached_property
    def area(self) -> Any:
        """Polygon in longitude and latitude; around a pole it spans several turns, as longitudes of features may."""
        import shapely

        rim = self.rim(SAMPLES)
        if self.pole:
            rim = rim[np.argsort(rim[:, 0])]
            turns = np.outer(np.arange(-TURNS, TURNS + 1), (360.0, 0.0))
            rim = (rim + turns[:, None]).reshape(-1, 2)
            rim = np.concatenate([rim, [(rim[-1, 0], self.pole), (rim[0, 0], self.pole)]])
        area = shapely.Polygon(rim)
        shapely.prepare(area)
        return area

    def of_rings(self, rings: Rings) -> Rings:
        """Clip polygons to the cap."""
        import shapely

        if not len(rings.ends):
            return rings
        rings = within(rings, self.area.bounds, None if self.pole else 360.0)
        shapes = rings.shapes
        beyond = ~shapely.covers(self.area, shapes)
        if not beyond.any():
            return rings
        leaving = np.flatnonzero(beyond)
        parts, owner = _polygons(shapely.intersection(shapes[leaving], self.area))
        feature = None if rings.feature is None else rings.feature[leaving[owner]]
        return rings.take(np.flatnonzero(~beyond)).concatenate(
            rings_of(parts, lambda index: rings.place(int(leaving[owner[index]])), feature)
        )

    def of_lines(self, lines: Lines) -> Lines:
        """Clip lines to the cap."""
        import shapely

        if not len(lines.ends) or shapely.covers(self.area, shapely.MultiPoint(lines.points)):
            return lines
        area = self.area
        if not self.pole:
            rims = np.array(area.exterior.coords) + np.outer((-1, 0, 1), (360.0, 0.0))[:, None]
            area = shapely.union_all(shapely.polygons(rims))
        return change_lines(lines, lambda shapes: np.asarray(shapely.intersection(shapes, area)))


def _polygons(shapes: NDArray[Any]) -> tuple[NDArray[Any], NDArray[np.intp]]:
    """Polygons among the parts of shapes, and the index of the shape of each."""
    import shapely

    parts, owner = shapely.get_parts(shapes, return_index=True)
    again, inner = shapely.get_parts(parts, return_index=True)
    keep = (shapely.get_type_id(again) == shapely.GeometryType.POLYGON) & ~shapely.is_empty(again)
    return again[keep], owner[inner][keep]


def cap_of(crs: str, longitude: float) -> Cap | None:
    """Cap that a perspective map shows, around a place on its own meridian; None for other maps.

    Examples
    --------
    >>> cap_of("+proj=ortho +lat_0=30 +lon_0=-100", -100.0)
    Cap(longitude=-100.0, latitude=30.0, radius=89.9)
    """
    operation = system(crs).coordinate_operation
    name = operation.method_name.lower() if operation is not None else ""
    if operation is None or not name.startswith(PERSPECTIVES):
        return None
    named = [param for param in operation.params if param.name.startswith("Latitude of") or param.name == "lat_0"]
    latitude = round(float(np.degrees(float(named[0].value) * named[0].unit_conversion_factor)), 9) if named else 0.0
    low, high = 0.0, 90.0 + BESIDE
    for _ in range(20):
        half = (low + high) / 2
        rim = transform_points(Cap(longitude, latitude, half).rim(36), WORLD, crs)
        low, high = (half, high) if np.isfinite(rim).all() else (low, half)
    return Cap(longitude, latitude, round(min(low - BESIDE, MOST.get(name.partition(" ")[0], 90.0)), 3))
