"""Detect coordinates whose unit is not that of their reference system: degrees taken for metres, and the reverse.

Files often name a system other than that of their coordinates, and users also give wrong systems.
"""

from functools import lru_cache
from typing import Final

from vexture.base.errors import ParameterError, SourceError
from vexture_geo.base.crs import UNPLACED, choose_crs, format_system, like_degrees, system, transform_bounds
from vexture_geo.base.extent import Bounds
from vexture_geo.base.lengths import NO_UNIT, metres_in

RADIANS: Final = frozenset({"rad", "radian", "radians"})
"""Units, in lower case, that no supported reference system uses."""

DEGREES: Final = "EPSG:4326"
"""The system that messages name for degrees."""

FAR: Final = 10.0
"""Distance from a system's area of use, in sizes of the data, beyond which no coordinates in metres lie."""

ORIGIN: Final = 0.1
"""Distance from the origin, as a fraction of its size, at which a local plane may begin."""

LEAST: Final = 1.0
"""Units of a projected system. Floods and maps of the world are larger than this everywhere."""

LIKELY: Final = 25
"""Percent. Confidence with which a system without an area of use is taken for a known one."""


def refuse_other_units(chosen: str, found: str | None, unit: str, box: Bounds, *, is_given: bool) -> None:
    """Raise an error if coordinates in degrees are given a system in metres, or the reverse.

    `chosen` is the system that is used; if the user gives it, `found` is the one that the file names. `unit` is that
    of the coordinates as the file writes it, and `box` holds their bounds.
    """
    shown = _format_box(box)
    if unit.lower() in RADIANS:
        raise SourceError(f"the coordinates {shown} are in {unit!r}; write them in degrees, or in metres of a plane")
    if system(chosen).is_geographic:
        if is_given and unit.lower() not in NO_UNIT and metres_in(unit) is not None:
            raise ParameterError(
                f"`crs` {format_system(chosen)} is in degrees, and the coordinates {shown} are in {unit!r}; name the "
                "system that they are in by `crs` EPSG:..."
            )
        return
    own = _degrees(found) if is_given else None
    if ("degree" in unit.lower() or own) and like_degrees(box):
        remedy = f"{'leave it out or ' if own or is_given else ''}give `crs` {format_system(own or DEGREES)}"
        raise (ParameterError if is_given else SourceError)(
            f"{_name_system(chosen, is_given)} is not in degrees, and the coordinates {shown} are; {remedy}"
        )
    refuse_degrees(chosen, box, is_given=is_given)


def refuse_degrees(chosen: str, box: Bounds, *, is_given: bool, near: float = 0.0) -> None:
    """Raise an error if coordinates as small as degrees are given a projected system.

    They must lie far from where the system is used, or be closer together than those of any flood or map. Coordinates
    around the origin, or at most `near` units from it, are accepted as a local plane, such as a laboratory flume or a
    drawing.
    """
    west, south, east, north = box
    size = max(east - west, north - south)
    if (
        chosen == UNPLACED
        or not system(chosen).is_projected
        or not like_degrees(box)
        or _begins_within(box, max(near, ORIGIN * size))
    ):
        return
    if _is_beyond(box, chosen, FAR * size):
        why = "it is used far from there"
    elif size <= LEAST:
        why = f"{east - west:g} x {north - south:g} of its units are no flood and no map"
    else:
        return
    raise (ParameterError if is_given else SourceError)(
        f"the coordinates {_format_box(box)} look like degrees, and {_name_system(chosen, is_given)} is not in degrees"
        f": {why}; give `crs` {DEGREES}" + (", or leave it out if the file names its own" if is_given else "")
    )


def _begins_within(box: Bounds, gap: float) -> bool:
    """Return whether a box contains the origin, or begins within a gap of it."""
    west, south, east, north = box
    return west <= gap and south <= gap and east >= -gap and north >= -gap


def _is_beyond(box: Bounds, chosen: str, gap: float) -> bool:
    """Return whether a box is known to lie farther than `gap` from where a projected system is used."""
    area = _area(chosen)
    if area is None:
        return False
    return max(area[0] - box[2], box[0] - area[2], area[1] - box[3], box[1] - area[3]) > gap


@lru_cache(maxsize=64)
def _area(crs: str) -> Bounds | None:
    """Bounds of a system's area of use in its own units; None if unknown."""
    area = system(crs).area_of_use
    if area is None:
        code = system(crs).to_epsg(min_confidence=LIKELY)
        area = None if code is None else system(f"EPSG:{code}").area_of_use
    return None if area is None else transform_bounds(area.bounds, DEGREES, crs)


def _degrees(found: str | None) -> str | None:
    """Return the system that a file names, if it is in degrees."""
    try:
        is_geographic = found is not None and found != UNPLACED and system(found).is_geographic
    except ParameterError:  # a wrong name is a reason to give another system
        return None
    return choose_crs(None, found) if is_geographic else None


def _name_system(chosen: str, is_given: bool) -> str:
    return f"{'`crs`' if is_given else 'its system'} {format_system(chosen)}"


def _format_box(box: Bounds) -> str:
    return ",".join(f"{value:.6g}" for value in box)
