"""Names of steps on a server, and what people read of their times."""

from collections.abc import Sequence
from datetime import datetime
from typing import Final

__all__ = ["PREFIX", "labels", "step_names"]

PREFIX: Final = "flood"
"""The shapes of a flood's server are called so, or begin with it and a slash."""

MONTHS: Final = ("Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec")
"""In English, whatever the language of the machine is."""


def step_names(count: int) -> list[str]:
    """Name each step: in this order they are sorted, too.

    Examples
    --------
    >>> step_names(1), step_names(3)
    (['flood'], ['flood/00', 'flood/01', 'flood/02'])
    """
    digits = max(2, len(str(count - 1)))
    return [PREFIX] if count == 1 else [f"{PREFIX}/{number:0{digits}}" for number in range(count)]


def labels(times: Sequence[datetime | None]) -> list[str]:
    """Times as people read them: seconds where there are any; nothing for a step without a time.

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
