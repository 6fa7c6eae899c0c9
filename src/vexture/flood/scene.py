"""The data of a flood's page: all of it but the water, and the names and times of the steps of the water."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.flood.open_water import openness_png
from vexture.flood.relief import Relief
from vexture.flood.views import View
from vexture.geo.crs import system
from vexture.geo.extent import Frame

__all__ = ["PREFIX", "Flood", "PageNote", "labels", "scene", "step_names"]

PREFIX: Final = "flood"
"""Name of a flood's shape on a server, or with a slash the start of it."""

MONTHS: Final = ("Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec")
"""In English, whatever the locale."""


class PageNote(NamedTuple):
    """A remark on the page, and what the author of the page can do about it."""

    text: str
    remedy: str


@dataclass(frozen=True, slots=True, eq=False)
class Flood:
    """All of a page but its water.

    `ground` is an encoded picture of the frame; `fold` is a file that moves the shoreline; `openness` says where
    waves are (`vexture.flood.open_water`); `views` are what to look at beside
    the whole box.
    """

    title: str
    frame: Frame
    ground: bytes
    relief: Relief
    fold: bytes | None
    openness: NDArray[np.float64] | None
    views: tuple[View, ...]
    notes: tuple[PageNote, ...]


def scene(flood: Flood, steps: Sequence[str | Mapping[str, Any]], ground: str, fold: str | None) -> dict[str, Any]:
    """Data of the page, ready for JSON.

    `steps` are names of shapes on a server, or manifests that contain the shapes. On a server, shapes named `PREFIX`,
    or with names that begin with it and a slash, become further steps. `ground` and `fold` are addresses of files.
    """
    frame = flood.frame
    return {
        "title": flood.title,
        "steps": list(steps),
        "prefix": PREFIX,
        "frame": {
            "box": list(frame.box),
            "to_source": frame.to_source.ravel().tolist(),
            "metres": list(frame.metres),
            "crs": frame.crs,
            "bounds": list(frame.bounds),
            "geographic": system(frame.crs).is_geographic,
        },
        "ground": ground,
        "relief": flood.relief.as_json(),
        "fold": fold,
        "openness": None if flood.openness is None else openness_png(flood.openness),
        "views": [view.as_json() for view in flood.views],
        "notes": [note.text for note in flood.notes],
    }


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
    """Times for people, with seconds if any time has them; empty for a step without a time.

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
