"""A Dask cluster on this machine, for as long as a test needs it."""

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest

SECONDS = 60
HERE = ("--host", "127.0.0.1", "--no-dashboard")
"""Options of a scheduler and of workers that nobody else sees."""


@contextmanager
def start_dask(*words: str) -> "Iterator[subprocess.Popen[str]]":
    """Run `dask` with these words, in a process of its own that finds the modules in this folder."""
    command = [sys.executable, "-m", "dask", *words]
    folders = filter(None, (str(Path(__file__).parent), os.environ.get("PYTHONPATH")))
    found = {**os.environ, "PYTHONPATH": os.pathsep.join(folders)}
    with subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True, env=found) as process:
        try:
            yield process
        finally:
            process.kill()


def line_of(process: "subprocess.Popen[str]", says: str) -> str:
    """Wait until a part of Dask says something."""
    assert process.stderr is not None
    for line in process.stderr:
        if says in line:
            return line
    pytest.fail(f"{process.args} ended with {process.wait(SECONDS)}")


@contextmanager
def scheduler_alone() -> "Iterator[tuple[subprocess.Popen[str], str]]":
    """A scheduler's process, and its address."""
    with start_dask("scheduler", *HERE, "--port", "0") as scheduler:
        yield scheduler, line_of(scheduler, "Scheduler at:").split()[-1]


@contextmanager
def workers_of(address: str, count: int) -> "Iterator[list[subprocess.Popen[str]]]":
    """Processes of workers of a scheduler, which start side by side."""
    with ExitStack() as opened:
        words = ("worker", address, *HERE, "--nthreads", "1", "--no-nanny")
        found = [opened.enter_context(start_dask(*words)) for _ in range(count)]
        for worker in found:
            line_of(worker, "Registered to:")
        yield found


@contextmanager
def cluster_of(workers: int) -> "Iterator[tuple[str, list[subprocess.Popen[str]]]]":
    """Address of a scheduler, and the processes of its workers."""
    with scheduler_alone() as (_, address), workers_of(address, workers) as found:
        yield address, found
