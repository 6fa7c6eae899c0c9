"""A process that does one piece of work at a time, is started when it is needed and ends with the server."""

import asyncio
import multiprocessing
import os
import resource
import secrets
import shutil
import signal
import tempfile
import threading
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing.connection import wait
from typing import Any, TypeVar

__all__ = ["Worker"]

T = TypeVar("T")


class Worker:
    """A process, which is started when it is needed and can be killed alone.

    `memory_bytes` limits its address space.
    """

    def __init__(self, memory_bytes: int | None = None) -> None:
        self._memory_bytes = memory_bytes
        self._pool: ProcessPoolExecutor | None = None
        self._folder = os.path.join(tempfile.gettempdir(), f"vexture-{secrets.token_hex(8)}")

    def run(self, work: Callable[..., T], *given: Any) -> asyncio.Future[T]:
        """Do one piece of work."""
        if self._pool is None:
            clean = multiprocessing.get_context("spawn")  # inherits nothing of the server, above all no sockets
            self._pool = ProcessPoolExecutor(1, clean, _prepare, (self._folder, self._memory_bytes))
        return asyncio.get_running_loop().run_in_executor(self._pool, work, *given)

    def kill(self) -> None:
        """End the process, whatever it does."""
        pool, self._pool = self._pool, None
        if pool is not None:
            for process in list(pool._processes.values()):  # before Python 3.14 there is no kill_workers
                process.kill()
            pool.shutdown(wait=False, cancel_futures=True)
            shutil.rmtree(self._folder, ignore_errors=True)


def _prepare(folder: str, memory_bytes: int | None) -> None:
    """Set up the process: it ends with the server, ignores Ctrl-C, and may have limited memory.

    Its temporary files are in a folder of its own, which is removed whichever of the two is killed.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    if memory_bytes is not None:
        resource.setrlimit(resource.RLIMIT_AS, (memory_bytes, resource.getrlimit(resource.RLIMIT_AS)[1]))
    parent = multiprocessing.parent_process()
    assert parent is not None
    sentinel = parent.sentinel
    os.makedirs(folder, mode=0o700, exist_ok=True)
    tempfile.tempdir = folder

    def end_with_the_server() -> None:
        wait([sentinel])
        shutil.rmtree(folder, ignore_errors=True)
        os._exit(1)

    threading.Thread(target=end_with_the_server, daemon=True).start()
