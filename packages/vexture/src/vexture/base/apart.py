"""Run work on untrusted data in separate processes: libraries obey neither time limits nor Ctrl-C, and some crash.

A worker process is killed, with all its children, when its work takes too long, when nobody waits for it any longer,
and when its parent ends. It writes no files and prints nothing; only complete results come back.
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
"""Seconds after its time limit at which work is killed; work that checks the clock has ended itself by then."""

IS_LINUX: Final = sys.platform == "linux"
SIGNAL_OF_PARENT: Final = 1
"""Linux's PR_SET_PDEATHSIG."""


def apart(work: Callable[..., T], *given: Any, name: str = "", seconds: float = math.inf) -> T:
    """Run ``work(*given)`` in another process; return its result, or raise its error.

    Parameters
    ----------
    work : function
        Where processes cannot be forked, it is found by its name. Its result is copied.
    *given
        Its arguments.
    name : str
        Name of the source in errors.
    seconds : float
        Time limit, which the work should check itself: it is killed `GRACE` seconds later.

    Raises
    ------
    LimitError
        If the work takes too long.
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
    """Yield the result or the error of ``work(*item)`` for each item, in order; see `apart`.

    Each process runs one work item after the other.

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
    """An error that the work raised."""

    def __init__(self, error: Exception) -> None:
        self.error = error


class _ClockChange(NamedTuple):
    """Message from a process that its clock has stopped or resumed."""

    is_stopped: bool


class _Worker:
    """A process that starts when there is work, and starts again after it has ended."""

    def __init__(self, work: Callable[..., Any], name: str | None) -> None:
        self._work, self._name = work, name
        self.process: Any = None
        self.place: int | None = None  # index of its work item
        self.until = math.inf
        self.left = 0.0  # seconds left of its limit, while its clock is stopped
        self.answer: list[Any] = []  # the result, once it has arrived
        self.has_died = False

    def give(self, place: int, item: tuple[Any, ...], seconds: float) -> None:
        """Start a work item."""
        if self.process is None:
            # a fork is cheap and keeps imported modules; on other platforms it is not safe
            context: Any = multiprocessing.get_context("fork" if IS_LINUX else "spawn")
            self.pipe, theirs = context.Pipe()
            self.process = context.Process(target=_serve, args=(self._work, theirs), name=self._name)
            self.process.start()
            theirs.close()
        self.place, self.until = place, time.monotonic() + seconds + GRACE
        self.answer, self.has_died = [], False
        with suppress(OSError):  # the process has died: `result` reports it
            self.pipe.send(item)

    def hear(self) -> None:
        """Receive a message of the process."""
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
        """Return the result of the work, or a `_Raised`."""
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
        """Kill the process and all its children."""
        if self.process is not None:
            with suppress(ProcessLookupError):
                if hasattr(os, "killpg") and os.getpgid(self.process.pid) == self.process.pid:
                    os.killpg(self.process.pid, signal.SIGKILL)
            self.process.kill()
            self.process.join()
            self.pipe.close()
            self.process = None


def _ready(workers: Sequence[_Worker]) -> list[_Worker]:
    """Wait until workers have a result, have died or have no time left; return them."""
    busy = [worker for worker in workers if worker.place is not None]
    left = min(worker.until for worker in busy) - time.monotonic()
    heard = wait([worker.pipe for worker in busy], None if left == math.inf else max(left, 0.0))
    for worker in busy:
        if worker.pipe in heard:
            worker.hear()
    return [worker for worker in busy if worker.answer or worker.has_died or worker.until <= time.monotonic()]


def _serve(work: Callable[..., Any], pipe: Connection) -> None:
    """Run one work item after the other; the main loop of a worker process."""
    _end_with_the_parent()
    CLOCK.start(lambda is_stopped: pipe.send(_ClockChange(is_stopped)))
    sys.stdout, sys.stderr = sys.__stdout__, sys.__stderr__  # replacements may share locks with other threads
    while True:
        try:
            item = pipe.recv()
        except EOFError:
            return
        try:
            result = work(*item)
        except Exception as error:  # sent back, to be raised in the parent
            error.add_note(traceback.format_exc())
            # some libraries pickle the causes too, and GDAL's cannot be pickled
            error.__cause__ = error.__context__ = error.__traceback__ = None
            result = _Raised(error)
        pipe.send(result)


def _end_with_the_parent() -> None:
    """Start a process group that Ctrl-C does not reach, and end with the parent, even inside a library call."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    if hasattr(os, "setpgid"):
        os.setpgid(0, 0)
    parent = multiprocessing.parent_process()
    assert parent is not None
    if IS_LINUX:
        ctypes.CDLL(None).prctl(SIGNAL_OF_PARENT, signal.SIGKILL)
        if os.getppid() != parent.pid:  # the parent has ended already
            os._exit(1)
        return

    def watch() -> None:
        wait([parent.sentinel])
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
