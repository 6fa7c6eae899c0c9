"""Work beside the cells of a notebook: it goes on in a thread, and its result arrives between two messages."""

import asyncio
import threading
from collections.abc import Callable
from typing import Generic, TypeVar

Result = TypeVar("Result")


class Pending(Generic[Result]):
    """The result of a function that a thread of its own calls.

    Parameters
    ----------
    work : callable
    then : callable
        Called once, when the result is there: by the loop of the kernel, so that it never runs beside a cell; without a
        loop, by the thread.
    """

    def __init__(self, work: Callable[[], Result], then: Callable[[], None]) -> None:
        self._work, self._then = work, then
        self._result: Result | None = None
        self._error: BaseException | None = None
        try:
            self._loop: asyncio.AbstractEventLoop | None = asyncio.get_running_loop()
        except RuntimeError:
            self._loop = None
        self._thread = threading.Thread(target=self._run, name="vexture map", daemon=True)
        self._thread.start()

    def _run(self) -> None:
        try:
            self._result = self._work()
        except BaseException as error:  # it is raised where the result is asked for
            self._error = error
        loop = self._loop
        if loop is None:
            self._then()
        elif not loop.is_closed():
            loop.call_soon_threadsafe(self._then)

    @property
    def is_done(self) -> bool:
        """Whether there is a result, or an error."""
        return not self._thread.is_alive() or self._result is not None or self._error is not None

    @property
    def error(self) -> BaseException | None:
        """Error of finished work, if it failed."""
        return self._error

    def result(self) -> Result:
        """The result, once it is there; what the work raised is raised again."""
        while self._result is None and self._error is None:
            self._thread.join(0.05)  # so that it can be interrupted
        if self._error is not None:
            raise self._error
        assert self._result is not None
        return self._result
