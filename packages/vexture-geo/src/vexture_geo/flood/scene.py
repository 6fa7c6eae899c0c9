"""Data of a flood's page: everything except the water, and the names and times of its steps."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from math import isfinite
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture_geo.base.crs import UNPLACED, system, transform_points
from vexture_geo.base.extent import Frame
from vexture_geo.flood.credits import Credits
from vexture_geo.flood.depth_classes import colors_of
from vexture_geo.flood.hazard import HAZARDS
from vexture_geo.flood.open_water import openness_png
from vexture_geo.flood.relief import Relief
from vexture_geo.flood.views import FloodView

PREFIX: Final = "flood"
"""Name of a flood's shape on a server; followed by a slash, the prefix of names of several."""

GEODETIC: Final = 9
"""Places along each side with a longitude and latitude, between which the page interpolates."""

ARRIVALS: Final = 6
"""Number of classes of arrival times; the earliest is the darkest."""

MONTHS: Final = ("Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec")
"""English names of months, whatever the locale."""


class PageNote(NamedTuple):
    """A remark on the page, and a remedy for the author of the page."""

    text: str
    remedy: str


@dataclass(frozen=True, slots=True, eq=False)
class Flood:
    """Everything on a page except its water.

    `credits` are those of the data. The classes of the map of depths begin at `depths`, in metres; the last one ends at
    `end`, which may be infinite. `ground` is an encoded picture of the frame; `fold` is a file that moves the shore;
    `openness` says where waves are (`vexture_geo.flood.open_water`); `views` are views of parts of the box.
    """

    title: str
    credits: Credits
    depths: tuple[float, ...]
    end: float
    frame: Frame
    ground: bytes
    relief: Relief
    fold: bytes | None
    openness: NDArray[np.float64] | None
    views: tuple[FloodView, ...]
    notes: tuple[PageNote, ...]


def scene(flood: Flood, steps: Sequence[str | Mapping[str, Any]], ground: str, fold: str | None) -> dict[str, Any]:
    """Data of the page, ready for JSON.

    `steps` are names of shapes on a server, or manifests that contain the shapes. On a server, shapes named `PREFIX`,
    or with names that begin with it and a slash, become further steps. `ground` and `fold` are addresses of files.
    """
    frame = flood.frame
    return {
        "title": flood.title,
        "credits": flood.credits.as_json(),
        "depths": _colour_classes(flood.depths, flood.end),
        "arrivals": colors_of(ARRIVALS)[::-1],
        "hazards": [{"from": least, "color": color, "text": text} for least, color, text in HAZARDS],
        "steps": list(steps),
        "prefix": PREFIX,
        "frame": {
            "box": list(frame.box),
            "to_source": frame.to_source.ravel().tolist(),
            "metres": list(frame.metres),
            "crs": frame.crs,
            "bounds": list(frame.bounds),
            "geographic": system(frame.crs).is_geographic,
            "geodetic": _geodetic(frame),
        },
        "ground": ground,
        "relief": flood.relief.as_json(),
        "fold": fold,
        "openness": None if flood.openness is None else openness_png(flood.openness),
        "views": [view.as_json() for view in flood.views],
        "notes": [note.text for note in flood.notes],
    }


def _colour_classes(depths: tuple[float, ...], end: float) -> list[dict[str, Any]]:
    """Classes of depth with the metres at which they begin and their colours; the last also with its end, if any."""
    found: list[dict[str, Any]] = [
        {"from": depth, "color": color} for depth, color in zip(depths, colors_of(len(depths)), strict=True)
    ]
    if isfinite(end):
        found[-1]["to"] = end
    return found


def _geodetic(frame: Frame) -> dict[str, Any] | None:
    """Longitude and latitude (WGS 84) on a grid over the frame from its north-west, from corner to corner.

    None if the frame itself is in degrees, or in no known place.
    """
    if frame.crs == UNPLACED or system(frame.crs).is_geographic:
        return None
    west, south, east, north = frame.bounds
    x, y = np.meshgrid(np.linspace(west, east, GEODETIC), np.linspace(north, south, GEODETIC))
    places = transform_points(np.stack([x.ravel(), y.ravel()], axis=1), frame.crs, "EPSG:4326")
    if not np.isfinite(places).all():
        return None
    return {"columns": GEODETIC, "rows": GEODETIC, "places": np.round(places, 8).ravel().tolist()}


def step_names(count: int) -> list[str]:
    """Names of steps on a server, in alphabetical order.

    Examples
    --------
    >>> step_names(1), step_names(3)
    (['flood'], ['flood/00', 'flood/01', 'flood/02'])
    """
    digits = max(2, len(str(count - 1)))
    return [PREFIX] if count == 1 else [f"{PREFIX}/{number:0{digits}}" for number in range(count)]


def labels(times: Sequence[datetime | None]) -> list[str]:
    """Format times for people, with seconds if any time has them; empty for a step without a time.

    Examples
    --------
    >>> from datetime import UTC
    >>> labels([datetime(2026, 2, 14, 6, tzinfo=UTC), datetime(2026, 2, 14, 7, 30), None])
    ['14 Feb 2026 06:00 UTC', '14 Feb 2026 07:30', '']
    """
    exact = any(time is not None and (time.second or time.microsecond) for time in times)
    return ["" if time is None else _label(time, exact) for time in times]


def _label(time: datetime, exact: bool) -> str:
    clock = f"{time:%H:%M:%S}" if exact else f"{time:%H:%M}"
    zone = time.tzname() or ""
    return f"{time.day} {MONTHS[time.month - 1]} {time.year} {clock} {zone}".strip()
