"""Coordinate reference systems: their names and units, and transforms between them.

Coordinates are always in the order x, y: longitude before latitude, whatever order the system itself defines.
"""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from math import pi
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import DeviceError, LimitError, ParameterError, SourceError
from vexture.base.tolerance import CLOSED
from vexture_geo.base.extent import Bounds, Frame
from vexture_geo.base.file_references import refuse_files_of_system

if TYPE_CHECKING:
    from pyproj import CRS, Transformer

UNPLACED: Final = (
    'ENGCRS["coordinates as they are",EDATUM[""],CS[Cartesian,2],AXIS["x",east],AXIS["y",north],UNIT["m",1]]'
)
"""Reference system of a plane without a known place in the world."""

OF_MAP: Final = ("cmap", "duckdb", "pmtiles", "pyarrow", "shapely")
"""Packages of the extra ``map``; all others are of ``gis``."""

MANY: Final = 10_000
"""Number of points from which duplicates are searched before a transform."""

SAMPLES: Final = 21
"""Points on each side of a rectangle whose bounds are transformed."""

LATITUDE: Final = pi / 2 * (1.0 + 1e-6)
"""Radians. The largest valid latitude, with a margin for rounding."""

LONGITUDE: Final = 4.0 * pi
"""Radians. The largest valid longitude: files that cross the antimeridian exceed half a turn, but never this."""

METRE_DEGREES: Final = 1e-3
"""Degrees over which the length of a degree is measured on the ellipsoid."""


class MissingReferenceError(SourceError):
    """The file does not name the reference system of its coordinates."""


@contextmanager
def gis_packages() -> Iterator[None]:
    """Turn a `ModuleNotFoundError` into a `DeviceError` that says how to install the package; also a decorator.

    Examples
    --------
    >>> with gis_packages():
    ...     raise ModuleNotFoundError(name="pyogrio")
    Traceback (most recent call last):
        ...
    vexture.base.errors.DeviceError: geographic data needs the package pyogrio: pip install 'vexture[gis]'
    """
    try:
        yield
    except ModuleNotFoundError as error:
        if error.name is None or error.name.split(".")[0] == "vexture":
            raise
        extra = "map" if error.name.split(".")[0] in OF_MAP else "gis"
        raise DeviceError(f"geographic data needs the package {error.name}: pip install 'vexture[{extra}]'") from None


def choose_crs(crs_option: str | None, found: str | None) -> str:
    """Choose the reference system of coordinates: the user's, or else the file's.

    The result is ``EPSG:32610`` or the like if an authority knows the system, else WKT. An invalid text of the user
    raises `ParameterError`, one of the file `SourceError`.
    """
    if crs_option:
        return _shortest(_text_of(crs_option))
    if not found:
        raise MissingReferenceError("it names no reference system of its coordinates; give `crs` EPSG:...")
    refuse_files_of_system(found)
    with _of_the_file():
        refuse_files_of_system(json.dumps(system(found).to_json_dict()) if found != UNPLACED else "")
        return _shortest(found)


def _text_of(value: Any) -> str:
    """Text of a system, which may also be an EPSG number or an object of pyproj."""
    if isinstance(value, str):
        return value
    return f"EPSG:{value}" if isinstance(value, int) or not hasattr(value, "to_wkt") else str(value.to_wkt())


@contextmanager
def _of_the_file() -> Iterator[None]:
    """Turn errors about a parameter into errors about the file that contains the value."""
    try:
        yield
    except ParameterError as error:
        raise SourceError(f"of the file, {error}") from None


@lru_cache(maxsize=64)
def system(text: str) -> "CRS":
    """Parse a system of the plane from an authority's code, WKT or a PROJ text; `ParameterError` for other texts."""
    from pyproj import CRS
    from pyproj.exceptions import CRSError

    short = " ".join(text.split())
    named = short if len(short) <= 60 else short[:57] + "..."
    try:
        crs = CRS.from_user_input(text).to_2d()
    except (CRSError, ValueError):
        raise ParameterError(f"the reference system {named!r} is unknown; name it as `crs` EPSG:...") from None
    if not (crs.is_geographic or crs.is_projected or crs.is_engineering) or len(crs.axis_info) != 2:
        raise ParameterError(
            f"the reference system {named!r} ({crs.type_name}) has no plane; transform the data or give `crs` EPSG:..."
        )
    return crs


@lru_cache(maxsize=64)
def _shortest(text: str) -> str:
    """Shortest text that names a system."""
    if text == UNPLACED:
        return text
    crs = system(text)
    authority = crs.to_authority(min_confidence=100)
    return ":".join(authority) if authority else crs.to_wkt()


def period(crs: str) -> float | None:
    """Units in a full turn of longitude, in a geographic system; None in others.

    Examples
    --------
    >>> period("EPSG:4326"), period("EPSG:28992")
    (360.0, None)
    """
    found = system(crs)
    return round(2.0 * pi / found.axis_info[0].unit_conversion_factor, 9) if found.is_geographic else None


def format_bounds(bounds: Bounds, crs: str) -> str:
    """Format bounds for a message: ``4,52,4.12346,53 (EPSG:4326)``."""
    numbers = ",".join(f"{value:.0f}" if 1e5 <= abs(value) < 1e12 else f"{value:.6g}" for value in bounds)
    return f"{numbers} ({format_system(crs)})"


def format_system(crs: str) -> str:
    """Format the name of a system for a message."""
    return crs if len(crs) <= 40 else system(crs).name


def are_degrees(points: NDArray[np.float64], crs: str) -> NDArray[np.bool_]:
    """Return which points, (n, 2), can be longitudes and latitudes; all of them if the system is projected.

    Examples
    --------
    >>> are_degrees(np.array([[190.0, 52.0], [84000.0, 447000.0]]), "EPSG:4326").tolist()
    [True, False]
    """
    found = system(crs)
    if not found.is_geographic:
        return np.ones(len(points), np.bool_)
    far = np.abs(points) * found.axis_info[0].unit_conversion_factor > (LONGITUDE, LATITUDE)
    return np.asarray(~far.any(axis=1))


def refuse_metres(
    points: NDArray[np.float64], crs: str, subject: str, error: type[Exception] = SourceError, *, name: str = "crs"
) -> None:
    """Raise `error` if coordinates of a geographic system cannot be degrees; `name` is the parameter of the system."""
    if not are_degrees(points, crs).all():
        raise error(
            f"{subject} cannot be longitudes and latitudes; name the system that they are in by `{name}` EPSG:..."
        )


def like_degrees(bounds: Bounds) -> bool:
    """Return whether bounds can be longitudes and latitudes."""
    return max(abs(bounds[0]), abs(bounds[2])) <= 360.0 and max(abs(bounds[1]), abs(bounds[3])) <= 90.0


def frame_of(bounds: Bounds | None, extent: Bounds, crs: str) -> Frame:
    """Make a frame around the user's bounds, or else around the extent of the file."""
    if bounds is not None:
        return frame_around(bounds, crs)
    with _of_the_file():
        return frame_around(extent, crs)


def frame_around(bounds: Bounds, crs: str) -> Frame:
    """Make the frame of a rectangle of the world.

    In a geographic system, its size on the ground is measured in the middle of the rectangle, and west may exceed
    east: such a rectangle crosses the antimeridian, and the frame's east is a turn further. Bounds that are empty or
    not finite raise `ParameterError`.

    Examples
    --------
    >>> frame_around((0.0, 0.0, 2000.0, 1000.0), "EPSG:28992").metres
    (2000.0, 1000.0)
    >>> [round(side) for side in frame_around((179.5, 60.0, -179.5, 61.0), "EPSG:4326").metres]
    [54956, 111421]
    >>> frame_around((179.5, 60.0, -179.5, 61.0), "EPSG:4326").bounds
    (179.5, 60.0, 180.5, 61.0)
    """
    crs = _shortest(crs)
    west, south, east, north = map(float, bounds)
    turn = period(crs)
    shown = format_bounds((west, south, east, north), crs)
    if not np.isfinite([west, south, east, north]).all():
        raise ParameterError(f"the bounds {shown} hold a number that is not finite; give west,south,east,north")
    refuse_metres(np.array([[west, south], [east, north]]), crs, f"the bounds {shown}", ParameterError)
    if turn and west > east:
        east += turn
    if not (west < east and south < north):
        raise ParameterError(f"the bounds {shown} hold nothing; the order is west,south,east,north")
    across, up = _metres((west + east) / 2, (south + north) / 2, crs)
    metres = ((east - west) * across, (north - south) * up)
    if not CLOSED * max(metres) < min(metres) < np.inf:
        raise ParameterError(f"the bounds {shown} are {metres[0]:g} x {metres[1]:g} m; give some that are less narrow")
    return Frame((west, south, east, north), crs, metres)


def _metres(x: float, y: float, crs: str) -> tuple[float, float]:
    """Metres per unit along x and along y at a place."""
    found = system(crs)
    if not found.is_geographic:
        return found.axis_info[0].unit_conversion_factor, found.axis_info[1].unit_conversion_factor
    geod = found.get_geod()
    assert geod is not None  # only a system without an ellipsoid has no geod
    degree = found.axis_info[0].unit_conversion_factor * 180.0 / pi
    x, y, half = x * degree, y * degree, METRE_DEGREES / 2
    y = min(max(y, half - 90.0), 90.0 - half)
    _, _, across = geod.inv(x - half, y, x + half, y)
    _, _, up = geod.inv(x, y - half, x, y + half)
    return float(across) / METRE_DEGREES * degree, float(up) / METRE_DEGREES * degree


@lru_cache(maxsize=64)
def same_system(one: str, other: str) -> bool:
    """Return whether two systems give each place the same coordinates x, y."""
    return one == other or system(one).equals(system(other), ignore_axis_order=True)


def transform_points(points: NDArray[np.float64], start: str, end: str) -> NDArray[np.float64]:
    """Transform points, (n, 2), from one system to another; points without an image become infinite."""
    if not len(points) or same_system(start, end):
        return points
    transformer = _transformer(start, end)
    if len(points) < MANY:
        return np.stack(transformer.transform(points[:, 0], points[:, 1]), axis=1)
    # corners that polygons share are transformed only once, because transforming costs more than finding them
    places = np.ascontiguousarray(points + 0.0, np.float64).view(np.complex128).ravel()
    unique, place = np.unique(places, return_inverse=True)
    return np.stack(transformer.transform(unique.real, unique.imag), axis=1)[place]


def transform_bounds(bounds: Bounds, start: str, end: str) -> Bounds | None:
    """Transform the bounds of a rectangle to another system; None if they have no image.

    In a geographic system, east may be beyond half a turn.
    """
    from pyproj.exceptions import ProjError

    if same_system(start, end):
        return bounds
    try:
        west, south, east, north = _transformer(start, end).transform_bounds(*bounds, densify_pts=SAMPLES)
    except ProjError:
        return None
    turn = period(end)
    if turn and west > east:
        east += turn
    return (west, south, east, north) if np.isfinite([west, south, east, north]).all() else None


def _transformer(start: str, end: str) -> "Transformer":
    from pyproj import Transformer
    from pyproj.exceptions import ProjError

    if UNPLACED in (start, end):
        raise SourceError("coordinates without a reference system cannot be transformed; give `crs` EPSG:...")
    try:
        return Transformer.from_crs(system(start), system(end), always_xy=True)
    except ProjError:
        raise LimitError(f"there is no way from {start[:60]!r} to {end[:60]!r}; choose another `crs`") from None
