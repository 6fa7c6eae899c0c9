"""A limit on how long a conversion may take, in whatever thread and on whatever platform it runs.

Loops that can be long look at the clock themselves. They return to Python often enough that Ctrl-C ends them too.
"""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from vexture.errors import LimitError, ParameterError

__all__ = ["DEFAULT_SECONDS", "check_time", "within"]

DEFAULT_SECONDS = 300.0
"""Seconds for one source."""

_LIMIT: ContextVar[tuple[float, float] | None] = ContextVar("_LIMIT", default=None)
"""Seconds that the work may take, and the time at which they are over."""


@contextmanager
def within(seconds: float) -> Iterator[None]:
    """Let `check_time` raise an error when the work inside has taken longer."""
    if isinstance(seconds, bool) or not (isinstance(seconds, int | float) and seconds > 0.0):
        raise ParameterError(
            f"`max_seconds` {seconds!r} is no number above 0; the default is {DEFAULT_SECONDS:g}, and inf sets no limit"
        )
    before = _LIMIT.set((seconds, time.monotonic() + seconds))
    try:
        yield
    finally:
        _LIMIT.reset(before)


def check_time(name: str = "") -> None:
    """Raise a `LimitError` about the drawing of a name if the work has taken too long.

    Examples
    --------
    >>> with within(1e-9):
    ...     check_time("duck")
    Traceback (most recent call last):
    vexture.errors.LimitError: duck: converting takes longer than 1e-09 s; simplify the drawing or raise `max_seconds`
    """
    limit = _LIMIT.get()
    if limit is not None and time.monotonic() > limit[1]:
        about = f"{name}: " if name else ""
        raise LimitError(
            f"{about}converting takes longer than {limit[0]:g} s; simplify the drawing or raise `max_seconds`"
        )
