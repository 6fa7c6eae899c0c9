"""Speed of the water in a NetCDF file with depths: read it directly, or from its components east and north."""

import re
from collections.abc import Callable
from typing import Any, Final

import numpy as np

from vexture_geo.base.depth_ranges import has_flags
from vexture_geo.base.lengths import NO_UNIT, metres_in
from vexture_geo.depth.series import Values, plausible
from vexture_geo.depth.variables import known_as, reader_of, unit_of

# fmt: off
SPEEDS: Final = (
    {"ucmag", "speed", "velocity", "velocitymagnitude", "flowvelocity", "flowspeed", "currentspeed", "uvmag", "vmag"},
    {"sea_water_speed", "water_speed", "river_water_speed", "magnitude_of_sea_water_velocity"},
)
"""Names of speeds, and their standard names, in the form of `vexture_geo.depth.variables.DEPTHS`."""

EASTWARD: Final = (
    {"ucx", "u", "u1", "vx", "velx", "xvelocity", "velocityx", "uvelocity", "eastwardvelocity"},
    {"sea_water_x_velocity", "eastward_sea_water_velocity", "barotropic_eastward_sea_water_velocity",
     "barotropic_sea_water_x_velocity"},
)
NORTHWARD: Final = (
    {"ucy", "v", "v1", "vy", "vely", "yvelocity", "velocityy", "vvelocity", "northwardvelocity"},
    {"sea_water_y_velocity", "northward_sea_water_velocity", "barotropic_northward_sea_water_velocity",
     "barotropic_sea_water_y_velocity"},
)
"""Names of its components along two axes at right angles."""
# fmt: on

EACH_SECOND: Final = re.compile(r"(\w+?)\s*(/\s*s(ec(ond)?)?|[\s.]s(\*\*|\^)?-1)", re.IGNORECASE)
"""Pattern of a unit of speed, which begins with a unit of length."""


OTHER: Final = {
    **dict.fromkeys(("km/h", "km h-1", "km/hr", "kph"), 1.0 / 3.6),
    **dict.fromkeys(("knot", "knots", "kn", "kt", "kts"), 1852.0 / 3600.0),
}
"""Metres a second of other units of speed."""


def speed_of(dataset: Any, depths: str, order: tuple[str, ...], time: str | None) -> Callable[..., Values] | None:
    """Make a function that reads the speed where and when a variable holds depths; None if there is no speed.

    `order` are the dimensions of the depths' places. Speeds at other places or times, in layers, in classes or in no
    unit of speed are ignored.
    """
    allowed = {*order, time}
    here = [
        str(name)
        for name in dataset.data_vars
        if name != depths
        and dataset[name].dtype.kind in "iuf"
        and not has_flags(dataset[name])
        and _metres_a_second(unit_of(dataset[name])) is not None
        and set(order) <= set(dataset[name].dims)
        and (time is None or time in dataset[name].dims)
        and all(dim in allowed or dataset.sizes[dim] == 1 for dim in dataset[name].dims)
    ]
    whole, east, north = (known_as(dataset, here, names) for names in (SPEEDS, EASTWARD, NORTHWARD))
    if whole is not None:
        read = _reader(dataset[whole])
        return lambda places, order: np.abs(plausible(read(places, order)))
    if east is None or north is None:
        return None
    parts = _reader(dataset[east]), _reader(dataset[north])
    return lambda places, order: np.hypot(*(plausible(part(places, order)) for part in parts))


def _reader(variable: Any) -> Callable[..., Values]:
    """Make a function that reads a speed in metres a second."""
    return reader_of(variable, unit=_metres_a_second(unit_of(variable)) or 1.0)


def _metres_a_second(text: str) -> float | None:
    """Metres a second in a unit; 1 if there is no unit, and None if it is not a unit of speed."""
    if text.lower() in NO_UNIT:
        return 1.0
    unit = EACH_SECOND.fullmatch(text)
    return metres_in(unit[1]) if unit else OTHER.get(text.lower())
