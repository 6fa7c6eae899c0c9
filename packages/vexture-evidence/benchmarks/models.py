"""Runs of flood models of a million faces, from file to page: by one process, by several, by workers of a Dask cluster.

    python packages/vexture-evidence/benchmarks/models.py [--faces 1000000] [--steps 12] [--turns 3] [--seed 1]

The runs are those of `model_runs.py`, an estuary in a mesh of triangles with depths and a bed. Each page is made by the
command `vexture flood` in a process of its own, all ways in turn. *Peak* is the resident memory of the largest one.
The workers of the cluster have one thread each, and are all on this machine. All pages must be the same bytes.
"""

import argparse
import hashlib
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from statistics import median
from typing import Final, NamedTuple

from model_runs import estuary, write_run
from report import cell, table, write_json
from vexture_evidence.measures.machine import machine_facts, machine_line

CLUSTERS: Final = (1, 2, 4)
COMMAND: Final = [sys.executable, "-c", "from vexture.cli.main import main; main()"]


class PageCost(NamedTuple):
    """Cost of one conversion, and its page."""

    seconds: float
    peak: int  # MB
    page: str
    size: int  # bytes


def make_page(run: Path, page: Path, *options: str) -> PageCost:
    """Make the page of a run."""
    command = [*COMMAND, "flood", "--extent", str(run), "-o", str(page), *options]
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - start
    if status:
        raise SystemExit(f"{' '.join(command[3:])} ended with {status}")
    content = page.read_bytes()
    return PageCost(seconds, used.ru_maxrss // 1024, hashlib.sha256(content).hexdigest(), len(content))


@contextmanager
def start_dask(part: str, *words: str, says: str) -> Iterator[str]:
    """Start a part of Dask; yield the line of its output that contains `says`."""
    command = [sys.executable, "-m", f"distributed.cli.{part}", *words, "--no-dashboard"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True) as process:
        assert process.stderr is not None
        try:
            yield next(line for line in process.stderr if says in line)
        finally:
            process.kill()


@contextmanager
def cluster(workers: int) -> Iterator[str]:
    """Start a scheduler with workers, and yield its address."""
    with ExitStack() as held:
        line = held.enter_context(
            start_dask("dask_scheduler", "--host", "127.0.0.1", "--port", "0", says="Scheduler at:")
        )
        address = line.split()[-1]
        for _ in range(workers):
            words = (address, "--host", "127.0.0.1", "--nthreads", "1", "--no-nanny")
            held.enter_context(start_dask("dask_worker", *words, says="Registered to:"))
        yield address


def main() -> None:
    parser = argparse.ArgumentParser(description="Runs of flood models of a million faces, from file to page.")
    parser.add_argument("--faces", type=int, default=1_000_000)
    parser.add_argument("--steps", type=int, default=12)
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    taken: dict[str, list[PageCost]] = {}
    with tempfile.TemporaryDirectory() as scratch, ExitStack() as held:
        folder = Path(scratch)
        run = write_run(folder / "run_map.nc", estuary(arguments.faces, arguments.seed), arguments.steps)
        ways = {"1 process": ("--workers", "1"), "2 processes": ("--workers", "2")}
        for count in CLUSTERS:
            address = held.enter_context(cluster(count))
            ways[f"Dask, {count} workers"] = ("--scheduler", address)
        for _ in range(arguments.turns):
            for way, options in ways.items():
                taken.setdefault(way, []).append(make_page(run, folder / "page.html", *options))
    pages = {one.page for each in taken.values() for one in each}
    rows = [
        [way, cell(median(one.seconds for one in each), 1), str(max(one.peak for one in each))]
        for way, each in taken.items()
    ]
    first = next(iter(taken.values()))[0]
    print(f"{arguments.faces} faces, {arguments.steps} steps: a page of {first.size / 1e6:.2f} MB, ", end="")
    print("the same bytes in all ways" if len(pages) == 1 else f"{len(pages)} different pages", end="\n\n")
    print(table(("by", "seconds", "peak, MB"), rows), end="\n\n")
    print(machine_line(machine_facts()))
    write_json("models", {"taken": {way: [one._asdict() for one in each] for way, each in taken.items()}})
    if len(pages) != 1:
        raise SystemExit(1)


if __name__ == "__main__":
    main()
