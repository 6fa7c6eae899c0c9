"""A limit on how long a conversion may take, in whatever thread and on whatever platform it runs.

Loops that can be long look at the clock themselves. They return to Python often enough that Ctrl-C ends them too. The
clock is stopped while kernels are compiled: that is not the work of any source.
"""

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from vexture.base.errors import LimitError, ParameterError

ALONE = "vexture-alone"
"""Name of a process beside which no other one works, so that its threads may use all processors."""

DEFAULT_SECONDS = 300.0
"""Seconds for one source."""


class Clock:
    """A clock that any thread can stop, so that no limit counts the time meanwhile."""

    def __init__(self) -> None:
        self.start()

    def start(self, on_change: Callable[[bool], None] = lambda is_stopped: None) -> None:
        """Restart, as a forked process must; `on_change` is called when the clock stops (True) or resumes (False)."""
        self._lock, self._on_change = threading.Lock(), on_change
        self._stops, self._stopped_at, self._stood = 0, 0.0, 0.0

    def seconds(self) -> float:
        """Return the seconds since an arbitrary time.

        Examples
        --------
        >>> clock = Clock()
        >>> clock.stop()
        >>> clock.seconds() == clock.seconds()
        True
        """
        with self._lock:
            return (self._stopped_at if self._stops else time.monotonic()) - self._stood

    def stop(self) -> None:
        """Stop the clock until `go_on` has been called as often as `stop`."""
        with self._lock:
            self._stops += 1
            if self._stops == 1:
                self._stopped_at = time.monotonic()
                self._on_change(True)

    def go_on(self) -> None:
        """Undo one call of `stop`."""
        with self._lock:
            self._stops -= 1
            if self._stops == 0:
                self._stood += time.monotonic() - self._stopped_at
                self._on_change(False)


CLOCK = Clock()
"""The clock of all limits."""

_LIMIT: ContextVar[tuple[float, float] | None] = ContextVar("_LIMIT", default=None)
"""Seconds that the work may take, and the time at which they are over."""


@contextmanager
def within(seconds: float) -> Iterator[None]:
    """Let `check_time` raise an error when the work inside has taken longer, or what is around it than it may."""
    check_seconds(seconds)
    around, limit = _LIMIT.get(), (seconds, CLOCK.seconds() + seconds)
    before = _LIMIT.set(limit if around is None or limit[1] < around[1] else around)
    try:
        yield
    finally:
        _LIMIT.reset(before)


def check_seconds(seconds: float) -> None:
    """Raise a `ParameterError` unless a limit is a number above 0."""
    if isinstance(seconds, bool) or not (isinstance(seconds, int | float) and seconds > 0.0):
        raise ParameterError(
            f"`max_seconds` {seconds!r} is no number above 0; the default is {DEFAULT_SECONDS:g}, and inf sets no limit"
        )


def allowed_seconds() -> float:
    """Seconds that the work around may take, or else `DEFAULT_SECONDS`: the limit for a part of it.

    Examples
    --------
    >>> with within(900.0):
    ...     allowed_seconds()
    900.0
    """
    limit = _LIMIT.get()
    return DEFAULT_SECONDS if limit is None else limit[0]


def check_time(name: str = "", work: str = "converting", remedy: str = "simplify the drawing") -> None:
    """Raise a `LimitError` about the drawing of a name if the work has taken too long.

    Examples
    --------
    >>> with within(1e-9):
    ...     check_time("duck")
    Traceback (most recent call last):
    vexture.base.errors.LimitError: duck: converting takes longer than 1e-09 s; simplify the drawing or
    raise `max_seconds`
    """
    limit = _LIMIT.get()
    if limit is not None and CLOCK.seconds() > limit[1]:
        raise too_long(name, limit[0], work, remedy)


def too_long(name: str, seconds: float, work: str = "converting", remedy: str = "simplify the drawing") -> LimitError:
    """Error about the drawing of a name that takes longer than it may."""
    about = f"{name}: " if name else ""
    return LimitError(f"{about}{work} takes longer than {seconds:g} s; {remedy} or raise `max_seconds`")
