"""Coordinates that are in another unit than their reference system: degrees taken for metres, and the reverse.

Files with another system than that of their coordinates are common, and so is a system that is given for others.
"""

from functools import lru_cache
from typing import Final

from vexture.base.errors import ParameterError, SourceError
from vexture_geo.base.crs import UNPLACED, choose_crs, format_system, like_degrees, system, transform_bounds
from vexture_geo.base.extent import Bounds
from vexture_geo.base.lengths import NO_UNIT, metres_in

RADIANS: Final = frozenset({"rad", "radian", "radians"})
"""Units, in lower case, that no reference system here is in."""

DEGREES: Final = "EPSG:4326"
"""The system that messages name for degrees."""

FAR: Final = 10.0
"""Sizes of what there is, from it to where its system is used: none of metres lies there."""

ORIGIN: Final = 0.1
"""Share of its size by which a plane of its own may begin beside the origin."""

LEAST: Final = 1.0
"""Units of a projected system. No flood or map of the world has so few, wherever it is."""

LIKELY: Final = 25
"""Percent. How sure it is that a system without an area is one that is known."""


def refuse_other_units(chosen: str, found: str | None, unit: str, box: Bounds, *, is_given: bool) -> None:
    """Refuse the system of coordinates that are degrees, if it is in metres; and the reverse.

    `chosen` is the system that counts and, where that is one that the user gives, `found` the one that the file names.
    `unit` is that of the coordinates as the file writes it, and `box` are their bounds.
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
    """Refuse a projected system for coordinates that are as small as degrees.

    They must lie far from where the system is used, or be nearer to one another than those of any flood or map. Those
    around the origin, or that begin at most `near` units from it, are a plane of its own, such as the flume of a
    laboratory or a drawing.
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
    """Whether a box holds the origin, or begins so near to it."""
    west, south, east, north = box
    return west <= gap and south <= gap and east >= -gap and north >= -gap


def _is_beyond(box: Bounds, chosen: str, gap: float) -> bool:
    """Whether a box lies farther than `gap` from where a projected system is used, as far as that is known."""
    area = _area(chosen)
    if area is None:
        return False
    return max(area[0] - box[2], box[0] - area[2], area[1] - box[3], box[1] - area[3]) > gap


@lru_cache(maxsize=64)
def _area(crs: str) -> Bounds | None:
    """Bounds, in its own units, within which a system is used; None if that is unknown."""
    area = system(crs).area_of_use
    if area is None:
        code = system(crs).to_epsg(min_confidence=LIKELY)
        area = None if code is None else system(f"EPSG:{code}").area_of_use
    return None if area is None else transform_bounds(area.bounds, DEGREES, crs)


def _degrees(found: str | None) -> str | None:
    """The system that a file names, if it is in degrees."""
    try:
        is_geographic = found is not None and found != UNPLACED and system(found).is_geographic
    except ParameterError:  # which is what the user's system is given for
        return None
    return choose_crs(None, found) if is_geographic else None


def _name_system(chosen: str, is_given: bool) -> str:
    return f"{'`crs`' if is_given else 'its system'} {format_system(chosen)}"


def _format_box(box: Bounds) -> str:
    return ",".join(f"{value:.6g}" for value in box)
