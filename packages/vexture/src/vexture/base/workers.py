"""Run work in this process, in several processes of this machine, or on the workers of a Dask cluster.

Results come in the order of the work items, and do not depend on where the work ran. Work in progress is repeated when
its worker dies.
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
"""Seconds of remaining work from which more processes are started: about their own start time."""

AHEAD: Final = 2
"""Work items sent to each worker: one runs while the next one arrives."""

MOST_DEATHS: Final = 3
"""Deaths of workers at one work item after which the item itself counts as the cause."""

PATIENCE: Final = "5s"
"""Timeout of a scheduler's first answer."""

NO_WORKERS: Final = "No valid workers"
"""Part of Dask's message about a scheduler without workers."""

TALKATIVE: Final = ("distributed.client", "distributed.batched", "distributed.core")
"""Loggers of Dask that print tracebacks of lost connections, which our error reports in one line."""

FRESH: Final = 2.0
"""Seconds for which the number of a cluster's workers is cached, as each query costs a round trip."""


class Workers(Protocol):
    """A way to run work: in this process, in several, or on a cluster."""

    def map(
        self, work: Callable[[Shared, Item], Result], shared: Shared, items: Iterable[Item], count: int
    ) -> Iterator[Result]:
        """Yield ``work(shared, item)`` for `count` items, in their order; only a few are in memory at a time.

        Another process finds `work` by its name, and gets copies of `shared` and the items.
        """
        ...


class InProcess:
    """Runs one work item after the other, in the calling process.

    Examples
    --------
    >>> list(InProcess().map(max, 2, [1, 3], 2))
    [2, 3]
    """

    def map(
        self, work: Callable[[Shared, Item], Result], shared: Shared, items: Iterable[Item], count: int
    ) -> Iterator[Result]:
        """Compute each result when it is requested."""
        return (work(shared, item) for item in items)


class Processes:
    """Runs work in several processes of this machine, if it is long enough to be worth their start."""

    def __init__(self, processes: int) -> None:
        self._processes = processes

    def map(
        self, work: Callable[[Shared, Item], Result], shared: Shared, items: Iterable[Item], count: int
    ) -> Iterator[Result]:
        """Yield results; this process computes the first ones, to measure how long the work takes."""
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
        # a fork shares memory, so that nothing is copied; on other platforms it is not safe
        context = multiprocessing.get_context("fork" if sys.platform == "linux" else "spawn")
        return ProcessPoolExecutor(self._processes, context, _share, (work, shared))


def _submit_to_pool(pool: ProcessPoolExecutor, item: Any) -> "Future[Any]":
    """Submit a work item; if the pool is broken, so is the item's future."""
    try:
        return pool.submit(_work, item)
    except BrokenProcessPool as error:
        broken: Future[Any] = Future()
        broken.set_exception(error)
        return broken


_given: list[Any] = []
"""In a pool's process: the work function and its shared argument."""


def _share(work: Callable[..., Any], shared: Any) -> None:
    _given[:] = [work, shared]
    signal.signal(signal.SIGINT, lambda *_: os._exit(1))  # Ctrl-C reaches all processes; only the parent reports it


def _work(item: Any) -> Any:
    work, shared = _given
    return work(shared, item)


class Cluster:
    """Runs work on the workers of a Dask scheduler at an address such as ``tcp://10.0.0.7:8786``; they need vexture."""

    def __init__(self, address: str) -> None:
        self._address = address

    def map(
        self, work: Callable[[Shared, Item], Result], shared: Shared, items: Iterable[Item], count: int
    ) -> Iterator[Result]:
        """Yield results; Dask repeats the work of a worker that dies."""
        with self._client() as client:
            held = self._call_scheduler(client.scatter, shared, broadcast=True, hash=False)

            def submit(item: Item) -> Any:
                return self._call_scheduler(client.submit, work, held, item, pure=False)

            def resubmit(item: Item) -> Any:
                nonlocal held  # the shared argument may be lost with the worker
                held = self._call_scheduler(client.scatter, shared, broadcast=True, hash=False)
                return submit(item)

            def next_result() -> Any:
                item, future = waiting.popleft()
                return self._result(future, lambda: resubmit(item))

            waiting: deque[tuple[Item, Any]] = deque()
            room, updated = 0, -FRESH
            for item in items:
                waiting.append((item, submit(item)))
                if time.monotonic() - updated >= FRESH:
                    threads = sum(self._call_scheduler(client.nthreads).values())
                    room, updated = AHEAD * max(1, threads), time.monotonic()
                if len(waiting) >= room:
                    yield next_result()
            while waiting:
                yield next_result()

    def check(self) -> None:
        """Raise a `DeviceError` if the scheduler does not answer or has no workers."""
        with self._client():
            pass

    @contextmanager
    def _client(self) -> Iterator[Any]:
        """Connect a client with its loggers disabled."""
        logs = [logging.getLogger(name) for name in TALKATIVE]
        before = [log.disabled for log in logs]
        for log in logs:
            log.disabled = True  # setting their level has no effect: importing Dask sets it again
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
            parse_host_port(parse_address(self._address)[1])  # a refused client would log errors at its end
            client = Client(self._address, timeout=PATIENCE, set_as_default=False)
        except (OSError, ValueError) as error:
            raise DeviceError(
                f"`scheduler` {self._address}: no Dask scheduler answers there ({error}); start one, or correct it"
            ) from None
        dask.config.set({"distributed.admin.large-graph-warning-threshold": "1 TB"})  # items contain their data
        if not client.nthreads():
            client.close()
            raise DeviceError(
                f"`scheduler` {self._address}: it has no workers; start some: dask worker {self._address}"
            )
        return client

    def _call_scheduler(self, function: Callable[..., Any], *words: Any, **named: Any) -> Any:
        """Call the scheduler; raise a `DeviceError` if it, or all of its workers, have died."""
        try:
            return function(*words, **named)
        except OSError as error:  # includes connection errors and timeouts
            raise self._scheduler_error(error) from None

    def _scheduler_error(self, error: OSError) -> DeviceError:
        state = "has no workers left" if NO_WORKERS in str(error) else "no longer answers"
        return DeviceError(
            f"`scheduler` {self._address}: it {state}; start it again, with workers, then type the command again"
        )

    def _result(self, future: Any, resubmit: Callable[[], Any]) -> Any:
        """Fetch a result; resubmit the item if its worker died meanwhile and the scheduler has dropped the result."""
        from distributed import KilledWorker

        for _ in range(MOST_DEATHS):
            try:
                return future.result()
            except OSError as error:
                if future.status == "error":
                    raise  # the work itself raised it
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
