"""Work that is shared: by this process alone, by several on this machine, or by the workers of a Dask cluster.

Results come in the order of the work, and are the same wherever it was done. What a worker had in hand when it died is
done again.
"""

import logging
import multiprocessing
import os
import signal
import sys
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError, Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from typing import Any, Final, Protocol, TypeVar

from vexture.base.errors import DeviceError

Shared = TypeVar("Shared")
Item = TypeVar("Item")
Result = TypeVar("Result")

WORTH: Final = 3.0
"""Seconds of work from which other processes are started: what they need to start."""

AHEAD: Final = 2
"""Pieces of work at each worker: one is done while the next one arrives."""

MOST_DEATHS: Final = 3
"""Of workers, at one piece of work: after that it is the work that kills them."""

PATIENCE: Final = "5s"
"""For a scheduler's first answer."""

NO_WORKERS: Final = "No valid workers"
"""Part of Dask's message about a scheduler without workers."""

TALKATIVE: Final = ("distributed.client", "distributed.batched", "distributed.core")
"""Loggers of Dask that print tracebacks of lost connections, about which an error says one line."""

FRESH: Final = 2.0
"""Seconds for which the number of a cluster's workers is believed: each question costs an answer's time."""


class Workers(Protocol):
    """A way to do pieces of work: in this process, in several, or on a cluster."""

    def map(
        self, work: Callable[[Shared, Item], Result], shared: Shared, items: Iterable[Item], count: int
    ) -> Iterator[Result]:
        """Results of ``work(shared, item)``, in order, of `count` items; few of them are in memory at a time.

        Elsewhere `work` is found by its name, and `shared` and the items are copies.
        """
        ...


class InProcess:
    """Does one piece of work after the other, in the calling process.

    Examples
    --------
    >>> list(InProcess().map(max, 2, [1, 3], 2))
    [2, 3]
    """

    def map(
        self, work: Callable[[Shared, Item], Result], shared: Shared, items: Iterable[Item], count: int
    ) -> Iterator[Result]:
        """Results, each when it is wanted."""
        return (work(shared, item) for item in items)


class Processes:
    """Several processes on this machine, if the work is long enough that starting them pays."""

    def __init__(self, processes: int) -> None:
        self._processes = processes

    def map(
        self, work: Callable[[Shared, Item], Result], shared: Shared, items: Iterable[Item], count: int
    ) -> Iterator[Result]:
        """Results; the first is made here, to see how long the work takes."""
        rest = iter(items)
        for item in rest:
            start = time.perf_counter()
            yield work(shared, item)
            if self._processes > 1 and (time.perf_counter() - start) * (count - 1) >= WORTH:
                break
        else:
            return
        yield from self._elsewhere(work, shared, rest)

    def _elsewhere(
        self, work: Callable[[Shared, Item], Result], shared: Shared, items: Iterator[Item]
    ) -> Iterator[Result]:
        waiting: deque[tuple[Item, Future[Result]]] = deque()
        deaths = 0
        pool = self._pool(work, shared)
        try:
            while True:
                while len(waiting) < AHEAD * self._processes:
                    try:
                        item = next(items)
                    except StopIteration:
                        break
                    waiting.append((item, _submit_to_pool(pool, item)))
                if not waiting:
                    return
                try:
                    result = waiting[0][1].result()
                except BrokenProcessPool:
                    deaths += 1
                    if deaths == MOST_DEATHS:
                        raise DeviceError(
                            f"{deaths} processes died at the same work, as they do without memory; "
                            "let fewer share the work"
                        ) from None
                    pool.shutdown(wait=False)
                    pool = self._pool(work, shared)
                    waiting = deque((item, _submit_to_pool(pool, item)) for item, _ in waiting)
                    continue
                deaths = 0
                waiting.popleft()
                yield result
        finally:
            pool.shutdown(wait=False, cancel_futures=True)

    def _pool(self, work: Callable[..., Any], shared: Any) -> ProcessPoolExecutor:
        # a fork shares memory, so that nothing is copied; elsewhere it is not safe
        context = multiprocessing.get_context("fork" if sys.platform == "linux" else "spawn")
        return ProcessPoolExecutor(self._processes, context, _share, (work, shared))


def _submit_to_pool(pool: ProcessPoolExecutor, item: Any) -> "Future[Any]":
    """Submit a piece of work; its future is broken if the pool is."""
    try:
        return pool.submit(_work, item)
    except BrokenProcessPool as error:
        broken: Future[Any] = Future()
        broken.set_exception(error)
        return broken


_given: list[Any] = []
"""In a process of a pool: what is done, and what all of it shares."""


def _share(work: Callable[..., Any], shared: Any) -> None:
    _given[:] = [work, shared]
    signal.signal(signal.SIGINT, lambda *_: os._exit(1))  # Ctrl-C in a terminal reaches all: one says so


def _work(item: Any) -> Any:
    work, shared = _given
    return work(shared, item)


class Cluster:
    """The workers of a Dask scheduler, at an address such as ``tcp://10.0.0.7:8786``; they need vexture, too."""

    def __init__(self, address: str) -> None:
        self._address = address

    def map(
        self, work: Callable[[Shared, Item], Result], shared: Shared, items: Iterable[Item], count: int
    ) -> Iterator[Result]:
        """Results; Dask does the work of a worker that dies again."""
        with self._client() as client:
            held = self._call_scheduler(client.scatter, shared, broadcast=True, hash=False)

            def submit(item: Item) -> Any:
                return self._call_scheduler(client.submit, work, held, item, pure=False)

            def resubmit(item: Item) -> Any:
                nonlocal held  # what all share may be lost with the worker, too
                held = self._call_scheduler(client.scatter, shared, broadcast=True, hash=False)
                return submit(item)

            def next_result() -> Any:
                item, future = waiting.popleft()
                return self._result(future, lambda: resubmit(item))

            waiting: deque[tuple[Item, Any]] = deque()
            room, asked = 0, -FRESH
            for item in items:
                waiting.append((item, submit(item)))
                if time.monotonic() - asked >= FRESH:
                    room, asked = AHEAD * max(1, sum(self._call_scheduler(client.nthreads).values())), time.monotonic()
                if len(waiting) >= room:
                    yield next_result()
            while waiting:
                yield next_result()

    def check(self) -> None:
        """Raise a `DeviceError` if it does not answer, or has no workers."""
        with self._client():
            pass

    @contextmanager
    def _client(self) -> Iterator[Any]:
        """Connect a client that logs nothing."""
        logs = [logging.getLogger(name) for name in TALKATIVE]
        before = [log.disabled for log in logs]
        for log in logs:
            log.disabled = True  # their level is set when Dask is imported
        try:
            with self._connect() as client:
                yield client
        finally:
            for log, disabled in zip(logs, before, strict=True):
                log.disabled = disabled

    def _connect(self) -> Any:
        try:
            import dask
            from distributed import Client
            from distributed.comm.addressing import parse_address, parse_host_port
        except ImportError:
            raise DeviceError("`scheduler` needs Dask; type: pip install 'vexture[scale]'") from None
        try:
            parse_host_port(parse_address(self._address)[1])  # a client that was refused would complain at its end
            client = Client(self._address, timeout=PATIENCE, set_as_default=False)
        except (OSError, ValueError) as error:
            raise DeviceError(
                f"`scheduler` {self._address}: no Dask scheduler answers there ({error}); start one, or correct it"
            ) from None
        dask.config.set({"distributed.admin.large-graph-warning-threshold": "1 TB"})  # items bring their data with them
        if not client.nthreads():
            client.close()
            raise DeviceError(
                f"`scheduler` {self._address}: it has no workers; start some: dask worker {self._address}"
            )
        return client

    def _call_scheduler(self, function: Callable[..., Any], *words: Any, **named: Any) -> Any:
        """Call the scheduler; raise a `DeviceError` if it has died, or all of its workers."""
        try:
            return function(*words, **named)
        except OSError as error:  # so are those of connections, and of time
            raise self._scheduler_error(error) from None

    def _scheduler_error(self, error: OSError) -> DeviceError:
        state = "has no workers left" if NO_WORKERS in str(error) else "no longer answers"
        return DeviceError(
            f"`scheduler` {self._address}: it {state}; start it again, with workers, then type the command again"
        )

    def _result(self, future: Any, resubmit: Callable[[], Any]) -> Any:
        """Result of work; a scheduler may forget that of a worker that dies as it is fetched: then it is done again."""
        from distributed import KilledWorker

        for _ in range(MOST_DEATHS):
            try:
                return future.result()
            except OSError as error:
                if future.status == "error":
                    raise  # the work's own
                raise self._scheduler_error(error) from None
            except CancelledError as error:
                why: Exception = error
                future = resubmit()
            except KilledWorker as error:
                why = error
                break
        raise DeviceError(
            f"`scheduler` {self._address}: workers died at the same work, as they do without memory ({why}); "
            "start workers with more"
        )
