"""Time limit of a conversion, in any thread and on any platform.

Long loops check the clock themselves. They return to Python often enough that Ctrl-C ends them too. The clock stops
while kernels are compiled, because no source causes that work.
"""

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from vexture.base.errors import LimitError, ParameterError

ALONE = "vexture-alone"
"""Name of a worker process that works alone, so that its threads may use all processors."""

DEFAULT_SECONDS = 300.0
"""Time limit of one source, in seconds."""


class Clock:
    """A clock that any thread can stop; limits do not count the time while it stands."""

    def __init__(self) -> None:
        self.start()

    def start(self, on_change: Callable[[bool], None] = lambda is_stopped: None) -> None:
        """Restart, as after a fork; `on_change` is called with True when the clock stops, False when it resumes."""
        self._lock, self._on_change = threading.Lock(), on_change
        self._stops, self._stopped_at, self._stood = 0, 0.0, 0.0

    def seconds(self) -> float:
        """Return the seconds since an arbitrary start.

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
        """Stop the clock until there have been as many calls of `go_on` as of `stop`."""
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
"""Time limit of the current work in seconds, and the time at which it expires."""


@contextmanager
def within(seconds: float) -> Iterator[None]:
    """Limit the time of the enclosed work, in which `check_time` raises an error; an outer limit still applies."""
    check_seconds(seconds)
    around, limit = _LIMIT.get(), (seconds, CLOCK.seconds() + seconds)
    before = _LIMIT.set(limit if around is None or limit[1] < around[1] else around)
    try:
        yield
    finally:
        _LIMIT.reset(before)


def check_seconds(seconds: float) -> None:
    """Raise a `ParameterError` unless a time limit is a number above 0."""
    if isinstance(seconds, bool) or not (isinstance(seconds, int | float) and seconds > 0.0):
        raise ParameterError(
            f"`max_seconds` {seconds!r} is no number above 0; the default is {DEFAULT_SECONDS:g}, and inf sets no limit"
        )


def allowed_seconds() -> float:
    """Time limit in seconds for a part of the current work: its own limit, or else `DEFAULT_SECONDS`.

    Examples
    --------
    >>> with within(900.0):
    ...     allowed_seconds()
    900.0
    """
    limit = _LIMIT.get()
    return DEFAULT_SECONDS if limit is None else limit[0]


def check_time(name: str = "", work: str = "converting", remedy: str = "simplify the drawing") -> None:
    """Raise a `LimitError` about the drawing `name` if the work has exceeded its time limit.

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
    """Error about the drawing `name`, which exceeded its time limit."""
    about = f"{name}: " if name else ""
    return LimitError(f"{about}{work} takes longer than {seconds:g} s; {remedy} or raise `max_seconds`")
