"""Work on strangers' data in processes of their own: libraries hear neither the clock nor Ctrl-C, and some crash.

A process is ended, with all that it has started, when its work takes too long, when it is not waited for any longer,
and when the process that started it ends. It writes no files and prints nothing: only whole results come back.
"""

import ctypes
import math
import multiprocessing
import os
import signal
import sys
import threading
import time
import traceback
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from multiprocessing.connection import Connection, wait
from typing import Any, Final, NamedTuple, TypeVar

from vexture.base.deadline import ALONE, CLOCK, check_seconds, too_long
from vexture.base.errors import EXPECTED, ParameterError, SourceError, VextureError

T = TypeVar("T")

GRACE: Final = 2.0
"""Seconds after which work is ended that has not ended itself at its limit, as all does that looks at the clock."""

IS_LINUX: Final = sys.platform == "linux"
SIGNAL_OF_PARENT: Final = 1
"""PR_SET_PDEATHSIG of Linux."""


def apart(work: Callable[..., T], *given: Any, name: str = "", seconds: float = math.inf) -> T:
    """Result of ``work(*given)``, done in another process; raises what it raises.

    Parameters
    ----------
    work : function
        It is found by its name where processes cannot be forked, and its result is copied.
    *given
        What it is called with.
    name : str
        Of the source, in errors.
    seconds : float
        For the work, which should keep to them by itself: it is ended `GRACE` seconds later.

    Raises
    ------
    LimitError
        If it takes too long.
    SourceError
        If the process dies.

    Examples
    --------
    >>> apart(max, 1, 2)
    2
    """
    (result,) = each_apart(work, [given], [name], seconds)
    if isinstance(result, EXPECTED):
        raise result
    return result


def each_apart(
    work: Callable[..., T], items: Sequence[tuple[Any, ...]], names: Sequence[str], seconds: float, processes: int = 1
) -> Iterator[T | VextureError | ParameterError]:
    """Results of ``work(*item)`` in the order of the items, or in place of one why there is none; see `apart`.

    Each process does one piece of work after the other.

    Examples
    --------
    >>> [*each_apart(max, [(1, 2), (4, 3)], ["a", "b"], 60.0, 2)]
    [2, 4]
    """
    check_seconds(seconds)
    waiting = deque(range(len(items)))
    done: dict[int, Any] = {}
    count = min(processes, len(items))
    workers = [_Worker(work, None if count > 1 else ALONE) for _ in range(count)]
    try:
        for place in range(len(items)):
            while place not in done:
                for worker in workers:
                    if worker.place is None and waiting:
                        worker.give(waiting[0], items[waiting.popleft()], seconds)
                for worker in _ready(workers):
                    done[worker.place] = worker.result(names[worker.place], seconds)  # type: ignore[index]
                    worker.place = None
            result = done.pop(place)
            if not isinstance(result, _Raised):
                yield result
            elif isinstance(result.error, EXPECTED):
                yield result.error
            else:
                raise result.error
    finally:
        for worker in workers:
            worker.end()


class _Raised:
    """An error that work has raised."""

    def __init__(self, error: Exception) -> None:
        self.error = error


class _ClockChange(NamedTuple):
    """Message of a process that the clock of its limits has stopped or resumed."""

    is_stopped: bool


class _Worker:
    """A process that is started when there is work, and again after its end."""

    def __init__(self, work: Callable[..., Any], name: str | None) -> None:
        self._work, self._name = work, name
        self.process: Any = None
        self.place: int | None = None  # of what it works at
        self.until = math.inf
        self.left = 0.0  # seconds of its limit, while the clock of the process is stopped
        self.answer: list[Any] = []  # the result, once it is there
        self.has_died = False

    def give(self, place: int, item: tuple[Any, ...], seconds: float) -> None:
        """Start a piece of work."""
        if self.process is None:
            # a fork costs nothing and holds what is imported already; elsewhere it is not safe
            context: Any = multiprocessing.get_context("fork" if IS_LINUX else "spawn")
            self.pipe, theirs = context.Pipe()
            self.process = context.Process(target=_serve, args=(self._work, theirs), name=self._name)
            self.process.start()
            theirs.close()
        self.place, self.until = place, time.monotonic() + seconds + GRACE
        self.answer, self.has_died = [], False
        with suppress(OSError):  # it has died: seen where its result is asked for
            self.pipe.send(item)

    def hear(self) -> None:
        """Take what the process has sent."""
        try:
            said = self.pipe.recv()
        except (EOFError, OSError):
            self.has_died = True
            return
        if not isinstance(said, _ClockChange):
            self.answer = [said]
        elif said.is_stopped:
            self.left, self.until = self.until - time.monotonic(), math.inf
        else:
            self.until = time.monotonic() + self.left

    def result(self, name: str, seconds: float) -> Any:
        """Return the result of its work, or a `_Raised`."""
        about = f"{name}: " if name else ""
        if self.answer:
            return self.answer[0]
        if self.has_died:
            self.process.join()
            code = self.process.exitcode
            self.end()
            how = signal.strsignal(-code) if code < 0 else f"exit code {code}"
            remedy = "give it less, or more memory" if code == -signal.SIGKILL else "the file is damaged, or too much"
            return _Raised(SourceError(f"{about}a library ended the process that read it ({how}); {remedy}"))
        self.end()
        return _Raised(too_long(name, seconds))

    def end(self) -> None:
        """End the process, whatever it does, and all that it has started."""
        if self.process is not None:
            with suppress(ProcessLookupError):
                if hasattr(os, "killpg") and os.getpgid(self.process.pid) == self.process.pid:
                    os.killpg(self.process.pid, signal.SIGKILL)
            self.process.kill()
            self.process.join()
            self.pipe.close()
            self.process = None


def _ready(workers: Sequence[_Worker]) -> list[_Worker]:
    """Wait for workers that have a result, have died, or have no time left."""
    busy = [worker for worker in workers if worker.place is not None]
    left = min(worker.until for worker in busy) - time.monotonic()
    heard = wait([worker.pipe for worker in busy], None if left == math.inf else max(left, 0.0))
    for worker in busy:
        if worker.pipe in heard:
            worker.hear()
    return [worker for worker in busy if worker.answer or worker.has_died or worker.until <= time.monotonic()]


def _serve(work: Callable[..., Any], pipe: Connection) -> None:
    """Do one piece of work after the other, in the process."""
    _end_with_the_parent()
    CLOCK.start(lambda is_stopped: pipe.send(_ClockChange(is_stopped)))
    sys.stdout, sys.stderr = sys.__stdout__, sys.__stderr__  # what stands in for them shares locks with other threads
    while True:
        try:
            item = pipe.recv()
        except EOFError:
            return
        try:
            result = work(*item)
        except Exception as error:  # which goes back, as if it had been raised there
            error.add_note(traceback.format_exc())
            # some libraries have causes copied too, and those of GDAL cannot be
            error.__cause__ = error.__context__ = error.__traceback__ = None
            result = _Raised(error)
        pipe.send(result)


def _end_with_the_parent() -> None:
    """Lead a group of processes that Ctrl-C does not reach, and end when the parent does, also within a library."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    if hasattr(os, "setpgid"):
        os.setpgid(0, 0)
    parent = multiprocessing.parent_process()
    assert parent is not None
    if IS_LINUX:
        ctypes.CDLL(None).prctl(SIGNAL_OF_PARENT, signal.SIGKILL)
        if os.getppid() != parent.pid:  # it has ended already
            os._exit(1)
        return

    def watch() -> None:
        wait([parent.sentinel])
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
