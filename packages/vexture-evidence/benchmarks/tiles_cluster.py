"""Pyramids on a Dask cluster: efficiency of two workers, of more by simulation, and runs with killed workers.

    python packages/vexture-evidence/benchmarks/tiles_cluster.py [--parcels 50000] [--zoom 14] [--kills 10] [--quick]

The parcels are those of `tiles.py`. A scheduler and workers of one thread run on this machine. The simulation takes the
scheduler's own figures of the run with one worker: how long each piece of work was computed, times the share of that in
which the worker had a core, as other programs may have run. It gives the pieces to more workers as
`vexture.base.workers.Cluster` does: in order, two for each worker at a time, while the client and the scheduler handle
one result after the other, for as long as they computed per piece; a level waits for the one before. `times` repeats
the pieces, as for a source that many times larger, except where a level has one.

Ten times in one run a random worker is killed, at random moments of which two are about as far apart as the longest
piece of work takes: Dask gives up a piece that four workers have died at. Another worker starts each time.
"""

import argparse
import hashlib
import heapq
import os
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path
from typing import Any, Final

import numpy as np
from distributed import Client

from report import write_figures
from tiles import SyntheticFeatures, parcels
from vexture.base.workers import AHEAD
from vexture_geo.tiles.build import make_tiles
from vexture_geo.tiles.options import TileOptions

GOALS = {"inefficiency_2": 15.0, "inefficiency_64": 15.0, "other_bytes": 0.0}
MOST_WORKERS: Final = 64
PATIENCE: Final = 120.0
"""Seconds for a part of Dask to start."""

IDLE: Final = 5.0
"""Seconds without work, to measure what the scheduler and its clients take then."""


@contextmanager
def start_dask(*words: str, says: str) -> Iterator[tuple[Any, str]]:
    """Start a part of Dask; yield its process, and the line of its output that contains `says`."""
    command = [sys.executable, "-m", f"distributed.cli.{words[0]}", *words[1:], "--no-dashboard"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True) as process:
        assert process.stderr is not None
        try:
            for line in process.stderr:
                if says in line:
                    threading.Thread(target=process.stderr.read, daemon=True).start()  # else it waits for a reader
                    yield process, line
                    return
            raise RuntimeError(f"{words[0]} ended")
        finally:
            process.kill()


@contextmanager
def cluster(workers: int) -> Iterator[tuple[str, Any, list[Any], ExitStack]]:
    """Start a scheduler and workers; yield its address, its process, theirs, and the stack that ends further ones."""
    with ExitStack() as opened:
        local = ("--host", "127.0.0.1")
        started = opened.enter_context(start_dask("dask_scheduler", *local, "--port", "0", says="Scheduler at:"))
        address = started[1].split()[-1]
        yield address, started[0], [start_worker(address, opened) for _ in range(workers)], opened


def start_worker(address: str, opened: ExitStack) -> Any:
    """Start one more worker; return its process."""
    more = ("--host", "127.0.0.1", "--nthreads", "1", "--no-nanny")
    return opened.enter_context(start_dask("dask_worker", address, *more, says="Registered to:"))[0]


@dataclass(frozen=True)
class ClusterRun:
    """A run on a cluster.

    Parameters
    ----------
    seconds, work_seconds : float
        Of all, with the reading of the source; and from the first piece of work's start to the last one's end.
    levels : list of list of float
        Seconds that each piece of work was computed.
    handled : float
        Seconds of a core for each piece, of the client or of the scheduler: those of the busier one, without what it
        takes when idle.
    digest : str
        Of the bytes.
    """

    seconds: float
    work_seconds: float
    levels: list[list[float]]
    handled: float
    digest: str


def cores(pid: int) -> float:
    """Seconds of processor time that a process has used."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _mark(folder: Path) -> Path:
    """Write a file that stands for the parcels."""
    path = folder / "parcels.txt"
    path.write_text("parcels")
    return path


def measure_run(count: int, zoom: int, workers: int, folder: Path) -> ClusterRun:
    """Make the pyramid with `workers` workers, and measure it."""
    output = folder / f"cluster-{workers}.pmtiles"
    handling: list[Any] = []
    counts: list[int] = []

    def note_handling(stage: str, number: int, total: int) -> None:
        if stage != "reading features":
            handling.append((time.perf_counter(), np.array([cores(pid) for pid in pids[:2]])))
        if total and number == 1:
            counts.append(total)

    with cluster(workers) as (address, scheduler, alive, _), Client(address, set_as_default=False) as client:
        client.get_task_stream()  # from now on the scheduler remembers
        pids = [os.getpid(), scheduler.pid, *(process.pid for process in alive)]
        before = np.array([cores(pid) for pid in pids])
        time.sleep(IDLE)
        idle = (np.array([cores(pid) for pid in pids]) - before)[:2] / IDLE
        start = time.perf_counter()
        options = TileOptions(max_zoom=zoom, scheduler=address, name="parcels")
        make_tiles(_mark(folder), output, options, note_handling, batches=SyntheticFeatures(lambda: parcels(count)))
        seconds = time.perf_counter() - start
        stream = client.get_task_stream()
        busy = np.array([cores(pid) for pid in pids]) - before
    levels = _levels(stream, counts)
    pieces = sum(counts)
    share = min(float(busy[2:].sum()) / sum(map(sum, levels)), 1.0)
    levels = [[piece * share for piece in level] for level in levels]
    (first, had), (last, has) = handling[0], handling[-1]
    handled = max(float((has - had - idle * (last - first)).max()), 0.0) / max(pieces - 1, 1)
    ends = [(one["start"], one["stop"]) for task in stream for one in task["startstops"]]
    work_seconds = max(stop for _, stop in ends) - min(begin for begin, _ in ends)
    digest = hashlib.sha256(output.read_bytes()).hexdigest()
    return ClusterRun(seconds, work_seconds, levels, handled, digest)


def _levels(stream: Sequence[Any], counts: Sequence[int]) -> list[list[float]]:
    """Seconds of pieces of work by level, in the order of their ends; `counts` are the pieces of each level."""
    found: list[float] = []
    for task in sorted(stream, key=lambda task: max(one["stop"] for one in task["startstops"])):
        found.append(sum(one["stop"] - one["start"] for one in task["startstops"]))
    assert len(found) == sum(counts), "a piece was done twice"
    ends = list(accumulate(counts))
    return [found[end - count : end] for end, count in zip(ends, counts, strict=True)]


def simulate_seconds(pieces: Sequence[float], workers: int, handled: float) -> float:
    """Seconds in which workers do pieces of work, if the client takes `handled` seconds for each of them."""
    free, ends = [0.0] * workers, [0.0] * len(pieces)
    now, window = 0.0, AHEAD * workers
    for number, piece in enumerate(pieces):
        if number >= window:
            now = max(now, ends[number - window])
        now += handled
        ends[number] = max(now, heapq.heappop(free)) + piece
        heapq.heappush(free, ends[number])
    return max(now, *ends)


def scaled_efficiency(run: ClusterRun, times: int, workers: int) -> float:
    """Efficiency, 0..1, of `workers` workers for a source that is `times` times larger."""

    def seconds(count: int) -> float:
        levels = [level * (times if len(level) > 1 else 1) for level in run.levels]
        return sum(simulate_seconds(sorted(level, reverse=True), count, run.handled) for level in levels)

    return seconds(1) / seconds(workers) / workers


def run_with_kills(count: int, zoom: int, kills: int, pause: float, folder: Path) -> tuple[str, int]:
    """Kill random workers during a run, `pause` seconds apart; return its digest, and the number of killed workers."""
    output = folder / "killed.pmtiles"
    chance, done = random.Random(20), threading.Event()
    deaths = 0
    with cluster(2) as (address, _, alive, opened):

        def kill() -> None:
            nonlocal deaths
            while deaths < kills and not done.wait(pause * chance.uniform(0.7, 1.2)):
                victim = alive.pop(chance.randrange(len(alive)))
                alive.append(start_worker(address, opened))
                os.kill(victim.pid, signal.SIGKILL)
                deaths += 1

        killer = threading.Thread(target=kill, daemon=True)

        def start_killer(stage: str, *_: int) -> None:
            if stage == "parts" and killer.ident is None:
                killer.start()

        options = TileOptions(max_zoom=zoom, scheduler=address, name="parcels")
        make_tiles(_mark(folder), output, options, start_killer, batches=SyntheticFeatures(lambda: parcels(count)))
        done.set()
        killer.join()
    return hashlib.sha256(output.read_bytes()).hexdigest(), deaths


def main() -> None:
    """Measure, print and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--parcels", type=int, default=50_000)
    parser.add_argument("--zoom", type=int, default=14)
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--quick", action="store_true", help="few parcels, two kills")
    chosen = parser.parse_args()
    count, kills = (3_000, 2) if chosen.quick else (chosen.parcels, chosen.kills)
    figures: dict[str, float] = {}
    digests = set()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        make_tiles(
            _mark(folder), folder / "first.pmtiles", TileOptions(), batches=SyntheticFeatures(lambda: parcels(100))
        )  # compiles
        run = measure_run(count, chosen.zoom, 1, folder)
        worked = [piece for level in run.levels for piece in level]
        figures |= {"pieces": len(worked), "levels": len(run.levels)}
        figures |= {"seconds_1": run.seconds, "asked_1": run.work_seconds}
        figures |= {"computed": sum(worked), "longest": max(worked), "handled_each": run.handled}
        two = measure_run(count, chosen.zoom, 2, folder)
        digests |= {run.digest, two.digest}
        figures |= {"seconds_2": two.seconds, "asked_2": two.work_seconds}
        figures["inefficiency_2"] = 100.0 * (1.0 - run.work_seconds / two.work_seconds / 2.0)
        for times in (1, 8, 64):
            for workers in (2, 8, MOST_WORKERS):
                figures[f"simulated_{workers}_of_{times}_times"] = 100.0 * scaled_efficiency(run, times, workers)
        figures["inefficiency_64"] = 100.0 * (1.0 - scaled_efficiency(run, 64, MOST_WORKERS))
        print(figures, flush=True)
        digest, deaths = run_with_kills(count, chosen.zoom, kills, figures["longest"], folder)
        digests.add(digest)
        figures |= {"killed": deaths, "other_bytes": len(digests) - 1}
    write_figures("tiles_cluster", figures, GOALS)


if __name__ == "__main__":
    main()
