"""Processes that work through jobs; one that takes too long is ended by the system, even in compiled code."""

import multiprocessing
import signal
from collections.abc import Iterable, Iterator
from importlib import import_module
from multiprocessing.connection import Connection, wait
from typing import Any

CONTEXT = multiprocessing.get_context("spawn")
SLOW = 10.0
"""Times the limit that a step after the first answer may take, such as to minimise a finding."""


def work(module: str, pipe: Connection, limit: float) -> None:
    """Answer job after job by `examined` of a module; a None follows the last answer to one."""
    examined = import_module(module).examined
    next(iter(examined(WARM)), None)  # kernels are compiled or loaded without a limit
    while (job := pipe.recv()) is not None:
        signal.setitimer(signal.ITIMER_PROF, limit)  # its signal ends the process
        for told in examined(job):
            pipe.send(told)
            signal.setitimer(signal.ITIMER_PROF, SLOW * limit)
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        pipe.send(None)


WARM = {"seed": "warm-1", "gradients": True, "renderer": "cpu", "minimise": 0.0}


def answers(
    module: str, jobs: Iterable[dict[str, Any]], processes: int, limit: float
) -> Iterator[tuple[dict[str, Any], dict[str, Any]]]:
    """Jobs and what is told about them; that of a process that died is that it was too slow, or how it ended."""
    pending, held = iter(jobs), dict[Connection, tuple[Any, dict[str, Any]]]()
    told_of = dict[Connection, int]()

    def start() -> tuple[Any, Connection]:
        ours, theirs = CONTEXT.Pipe()
        process = CONTEXT.Process(target=work, args=(module, theirs, limit), daemon=True)
        process.start()
        theirs.close()
        return process, ours

    def hand(process: Any, pipe: Connection) -> None:
        job = next(pending, None)
        pipe.send(job)
        if job is None:
            process.join()
        else:
            held[pipe], told_of[pipe] = (process, job), 0

    for _ in range(processes):
        hand(*start())
    while held:
        for pipe in wait(list(held)):
            assert isinstance(pipe, Connection)
            process, job = held[pipe]
            try:
                told = pipe.recv()
            except EOFError:
                process.join()
                name = "too slow" if process.exitcode == -signal.SIGPROF else f"died of {process.exitcode}"
                yield job, {f"{name} to minimise" if told_of[pipe] else name: True}
                del held[pipe]
                hand(*start())
                continue
            if told is None:
                del held[pipe]
                hand(process, pipe)
            else:
                told_of[pipe] += 1
                yield job, told
