"""A worker process that does one piece of work at a time, starts on demand and ends with the server.

Its temporary files, and those of its libraries, are in a folder of its own. A second, tiny process ends the worker
when the server has ended, and removes the folder when the worker has ended. A thread could not do this while a library
holds the interpreter's lock.
"""

import asyncio
import multiprocessing
import os
import resource
import secrets
import shutil
import signal
import stat
import tempfile
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from multiprocessing.connection import wait
from pathlib import Path
from typing import Any, Final, TypeVar

T = TypeVar("T")


ENDING_SECONDS: Final = 1.0
"""Time for a killed process to disappear, with its open files."""

PLACES: Final = ("TMPDIR", "CPL_TMPDIR", "SQLITE_TMPDIR")
"""Environment variables for the place of temporary files: general, GDAL, SQLite."""


class Worker:
    """A process that starts on demand and can be killed by itself.

    `memory_bytes` limits its address space, `file_bytes` each file that it writes.
    """

    def __init__(self, memory_bytes: int | None = None, file_bytes: int | None = None) -> None:
        self._limits = {resource.RLIMIT_AS: memory_bytes, resource.RLIMIT_FSIZE: file_bytes}
        self._pool: ProcessPoolExecutor | None = None
        self._folder = os.path.join(tempfile.gettempdir(), f"vexture-{secrets.token_hex(8)}")

    @property
    def is_running(self) -> bool:
        """True if the process has been started."""
        return self._pool is not None

    @property
    def temporary_bytes(self) -> int:
        """Bytes of its temporary files on the disk, including removed files that are still open."""
        return sum(512 * size for size in dict(self._temporary_blocks()).values())

    def run(self, work: Callable[..., T], *given: Any) -> asyncio.Future[T]:
        """Run one piece of work; its temporary files are removed afterwards."""
        if self._pool is None:
            clean = multiprocessing.get_context("spawn")  # inherits nothing from the server, in particular no sockets
            self._pool = ProcessPoolExecutor(1, clean, _prepare, (self._folder, self._limits))
        return asyncio.get_running_loop().run_in_executor(self._pool, _work, work, given)

    def kill(self) -> None:
        """Kill the process, whatever it is doing."""
        pool, self._pool = self._pool, None
        if pool is not None:
            for process in list(pool._processes.values()):  # kill_workers exists from Python 3.14 on
                process.kill()
                process.join(ENDING_SECONDS)
            pool.shutdown(wait=False, cancel_futures=True)
            shutil.rmtree(self._folder, ignore_errors=True)

    def _temporary_blocks(self) -> Iterator[tuple[tuple[int, int], int]]:
        """Yield the identity and the number of blocks of each temporary file, without files that vanish meanwhile."""
        processes = [] if self._pool is None else list(self._pool._processes)
        open_files = (file for process in processes for file in _entries(f"/proc/{process}/fd"))
        for file in (*_entries(self._folder), *open_files):
            with suppress(OSError):
                found = os.stat(file)
                if stat.S_ISREG(found.st_mode) and (file.is_relative_to(self._folder) or not found.st_nlink):
                    yield (found.st_dev, found.st_ino), found.st_blocks


def _entries(folder: str) -> list[Path]:
    """Return all files in a folder and its subfolders; none if it does not exist."""
    return [Path(place, name) for place, _, names in os.walk(folder) for name in names]


def _work(work: Callable[..., T], arguments: tuple[Any, ...]) -> T:
    """Run a piece of work in the process, and remove its leftovers."""
    try:
        return work(*arguments)
    finally:
        for file in _entries(tempfile.gettempdir()):
            with suppress(OSError):
                file.unlink()


def _prepare(folder: str, limits: dict[int, int | None]) -> None:
    """Set up the process: it ends with the server, ignores Ctrl-C, and limits memory and files."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    os.makedirs(folder, mode=0o700, exist_ok=True)
    tempfile.tempdir = folder
    os.environ.update(dict.fromkeys(PLACES, folder))
    _guard(folder)
    for kind, most in limits.items():
        if most is not None:
            resource.setrlimit(kind, (most, resource.getrlimit(kind)[1]))


def _guard(folder: str) -> None:
    """Start the process that ends this one when the server has ended, and then removes its folder."""
    parent = multiprocessing.parent_process()
    assert parent is not None
    guarded = os.getpid()
    ends_with_this, writer = os.pipe()
    if os.fork():
        os.close(ends_with_this)  # the other end stays open as long as this process runs
        return
    os.close(writer)
    wait([parent.sentinel, ends_with_this])
    if os.getppid() == guarded:
        os.kill(guarded, signal.SIGKILL)
        wait([ends_with_this])
    shutil.rmtree(folder, ignore_errors=True)
    os._exit(0)
