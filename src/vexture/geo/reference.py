"""Coordinate reference systems: what they are called, how large their units are, and the way from one to another.

Coordinates are always in the order x, y: longitude before latitude, whatever a system's own axes say.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from math import pi
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from vexture.errors import DeviceError, LimitError, SourceError, VextureError
from vexture.geo.frame import Frame
from vexture.tolerance import CLOSED

if TYPE_CHECKING:
    from pyproj import CRS, Transformer

__all__ = [
    "UNPLACED",
    "Bounds",
    "MissingReferenceError",
    "frame_around",
    "gis_packages",
    "period",
    "reference",
    "refuse_metres",
    "same_system",
    "shown_bounds",
    "shown_system",
    "system",
    "transformed",
    "transformed_bounds",
]

Bounds = tuple[float, float, float, float]
"""West, south, east, north."""

UNPLACED: Final = (
    'ENGCRS["coordinates as they are",EDATUM[""],CS[Cartesian,2],AXIS["x",east],AXIS["y",north],UNIT["m",1]]'
)
"""Reference system of a plane without a place in the world."""

SAMPLES: Final = 21
"""Points for each side of a rectangle whose image in another system is looked for."""

LATITUDE: Final = pi / 2 * (1.0 + 1e-6)
"""Radians. A latitude beyond it is none, rounding aside."""

LONGITUDE: Final = 4.0 * pi
"""Radians. Longitudes go on beyond half a turn where a file crosses the antimeridian, but never this far."""

METRE_DEGREES: Final = 1e-3
"""Degrees over which the length of a degree is measured on the ellipsoid."""


class MissingReferenceError(SourceError):
    """A file does not say in which reference system its coordinates are."""


@contextmanager
def gis_packages() -> Iterator[None]:
    """Say how to install what reads geographic data, where it is missing; also a decorator.

    Raises
    ------
    DeviceError
        In place of `ModuleNotFoundError`.

    Examples
    --------
    >>> with gis_packages():
    ...     raise ModuleNotFoundError(name="pyogrio")
    Traceback (most recent call last):
        ...
    vexture.errors.DeviceError: geographic data needs the package pyogrio: pip install 'vexture[gis]'
    """
    try:
        yield
    except ModuleNotFoundError as error:
        if (error.name or "vexture").split(".")[0] == "vexture":
            raise
        raise DeviceError(f"geographic data needs the package {error.name}: pip install 'vexture[gis]'") from None


def reference(given: str | None, found: str | None) -> str:
    """Settle in which reference system coordinates are: the user's word stands above the file's.

    Parameters
    ----------
    given : str or None
        What the user says (``--crs``).
    found : str or None
        What the file says.

    Returns
    -------
    str
        A text that `system` understands: ``EPSG:32610``, else WKT.

    Raises
    ------
    MissingReferenceError
        If neither says anything.
    SourceError, LimitError
        If the text of the file or of the user means nothing, or a system without a plane.

    Examples
    --------
    >>> reference(None, "epsg:28992"), reference("EPSG:32610", "EPSG:28992")
    ('EPSG:28992', 'EPSG:32610')
    """
    if given:
        return _settled(given)
    if not found:
        raise MissingReferenceError("it names no reference system of its coordinates; give `crs` EPSG:...")
    try:
        return _settled(found)
    except LimitError as error:
        raise SourceError(f"of the file, {error}") from None


@gis_packages()
def system(text: str) -> "CRS":
    """Reference system of a text: an authority's code, WKT or PROJ.

    Raises
    ------
    LimitError
        If it is none, or none of a plane.

    Examples
    --------
    >>> system("EPSG:28992").name
    'Amersfoort / RD New'
    """
    return _system(text)


@lru_cache(maxsize=64)
def _system(text: str) -> "CRS":
    from pyproj import CRS
    from pyproj.exceptions import CRSError

    short = " ".join(text.split())
    named = short if len(short) <= 60 else short[:57] + "..."
    try:
        crs = CRS.from_user_input(text).to_2d()
    except (CRSError, ValueError):
        raise LimitError(f"the reference system {named!r} is unknown; name it as `crs` EPSG:...") from None
    if not (crs.is_geographic or crs.is_projected or crs.is_engineering) or len(crs.axis_info) != 2:
        raise LimitError(
            f"the reference system {named!r} ({crs.type_name}) has no plane; transform the data or give `crs` EPSG:..."
        )
    return crs


@lru_cache(maxsize=64)
def _settled(text: str) -> str:
    """Shortest text of a system."""
    if text == UNPLACED:
        return text
    crs = system(text)
    authority = crs.to_authority(min_confidence=100)
    return ":".join(authority) if authority else crs.to_wkt()


def period(crs: str) -> float | None:
    """Units to a turn around the world, in a geographic system; None in others.

    Examples
    --------
    >>> period("EPSG:4326"), period("EPSG:28992")
    (360.0, None)
    """
    found = system(crs)
    return round(2.0 * pi / found.axis_info[0].unit_conversion_factor, 9) if found.is_geographic else None


def shown_bounds(bounds: Bounds, crs: str) -> str:
    """Bounds as a message names them.

    Examples
    --------
    >>> shown_bounds((4.0, 52.0, 4.123456789, 53.0), "EPSG:4326")
    '4,52,4.12346,53 (EPSG:4326)'
    """
    numbers = ",".join(f"{value:.6g}" if abs(value) < 1e5 else f"{value:.0f}" for value in bounds)
    return f"{numbers} ({shown_system(crs)})"


def shown_system(crs: str) -> str:
    """System as a message names it.

    Examples
    --------
    >>> shown_system("EPSG:4326"), shown_system(UNPLACED)
    ('EPSG:4326', 'coordinates as they are')
    """
    return crs if len(crs) <= 40 else system(crs).name


def refuse_metres(points: NDArray[np.float64], crs: str, what: str, error: type[VextureError] = SourceError) -> None:
    """Refuse coordinates that cannot be degrees, where degrees are expected."""
    found = system(crs)
    if not found.is_geographic or not len(points):
        return
    far = np.abs(points).max(axis=0) * found.axis_info[0].unit_conversion_factor
    if far[0] > LONGITUDE or far[1] > LATITUDE:
        raise error(f"{what} cannot be longitudes and latitudes; name the system that they are in by `crs` EPSG:...")


@gis_packages()
def frame_around(bounds: Bounds, crs: str) -> Frame:
    """Frame of a rectangle of the world.

    Its size on the ground is measured in the middle of the rectangle where the system is geographic.

    Parameters
    ----------
    bounds : tuple of float
        West, south, east, north in the units of the system. West may be above east in a geographic system: such a
        rectangle crosses the antimeridian, and the frame's east is a turn further.
    crs : str
        Text that pyproj understands.

    Raises
    ------
    LimitError
        If the rectangle is none, or the text is none of a system.

    Examples
    --------
    >>> frame_around((0.0, 0.0, 2000.0, 1000.0), "EPSG:28992").metres
    (2000.0, 1000.0)
    >>> [round(side) for side in frame_around((179.5, 60.0, -179.5, 61.0), "EPSG:4326").metres]
    [54956, 111421]
    >>> frame_around((179.5, 60.0, -179.5, 61.0), "EPSG:4326").bounds
    (179.5, 60.0, 180.5, 61.0)
    """
    crs = _settled(crs)
    west, south, east, north = map(float, bounds)
    turn = period(crs)
    shown = shown_bounds((west, south, east, north), crs)
    if not np.isfinite([west, south, east, north]).all():
        raise LimitError(f"the bounds {shown} hold a number that is not finite; give west,south,east,north")
    refuse_metres(np.array([[west, south], [east, north]]), crs, f"the bounds {shown}", LimitError)
    if turn and west > east:
        east += turn
    if not (west < east and south < north):
        raise LimitError(f"the bounds {shown} hold nothing; the order is west,south,east,north")
    across, up = _metres((west + east) / 2, (south + north) / 2, crs)
    metres = ((east - west) * across, (north - south) * up)
    if not CLOSED * max(metres) < min(metres) < np.inf:
        raise LimitError(f"the bounds {shown} are {metres[0]:g} x {metres[1]:g} m; give some that are less narrow")
    return Frame((west, south, east, north), crs, metres)


def _metres(x: float, y: float, crs: str) -> tuple[float, float]:
    """Metres to a unit along x and y, at a place."""
    found = system(crs)
    if not found.is_geographic:
        return found.axis_info[0].unit_conversion_factor, found.axis_info[1].unit_conversion_factor
    geod = found.get_geod()
    assert geod is not None  # only a system without an ellipsoid has none
    degree = found.axis_info[0].unit_conversion_factor * 180.0 / pi
    x, y, half = x * degree, y * degree, METRE_DEGREES / 2
    y = min(max(y, half - 90.0), 90.0 - half)
    _, _, across = geod.inv(x - half, y, x + half, y)
    _, _, up = geod.inv(x, y - half, x, y + half)
    return float(across) / METRE_DEGREES * degree, float(up) / METRE_DEGREES * degree


@lru_cache(maxsize=64)
def same_system(one: str, other: str) -> bool:
    """Whether coordinates x, y of one system are those of another.

    Examples
    --------
    >>> same_system("OGC:CRS84", "EPSG:4326"), same_system("EPSG:4258", "EPSG:4326")
    (True, False)
    """
    return one == other or system(one).equals(system(other), ignore_axis_order=True)


def transformed(points: NDArray[np.float64], start: str, end: str) -> NDArray[np.float64]:
    """Points, (n, 2), of one system in another; infinite where they have no image.

    Examples
    --------
    >>> transformed(np.array([[5.387206, 52.155174]]), "EPSG:4326", "EPSG:28992").round(0)
    array([[155000., 463000.]])
    """
    if not len(points) or same_system(start, end):
        return points
    x, y = _transformer(start, end).transform(points[:, 0], points[:, 1])
    return np.stack([x, y], axis=1)


def transformed_bounds(bounds: Bounds, start: str, end: str) -> Bounds | None:
    """Bounds of a rectangle's image in another system; None where it has none.

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
