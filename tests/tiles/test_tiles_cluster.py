"""Tiles by several processes and a cluster: the same bytes, also where they are killed."""

import hashlib
import os
import signal
import subprocess
import sys
import time
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest
from tile_sources import write_many

from vexture.tiles.build import make_tiles
from vexture.tiles.options import TileOptions
from vexture.tiles.store import SUFFIX

SECONDS = 60
ZOOM = 8


@contextmanager
def running(*words, says):
    """A part of Dask in a process of its own, once it says something."""
    command = [sys.executable, "-m", "distributed.cli." + words[0], *words[1:]]
    with subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True) as process:
        try:
            for line in process.stderr:
                if says in line:
                    yield process, line
                    break
            else:
                pytest.fail(f"{words} ended with {process.wait(SECONDS)}")
        finally:
            process.kill()


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    """Of several parts."""
    return write_many(tmp_path_factory.mktemp("source") / "parcels.geojson")


@pytest.fixture(scope="module")
def made_here(source, tmp_path_factory):
    output = tmp_path_factory.mktemp("made") / "parcels.pmtiles"
    make_tiles(source, output, TileOptions(max_zoom=ZOOM))
    return hashlib.sha256(output.read_bytes()).digest()


def run(*words):
    command = [sys.executable, "-m", "vexture", "tiles", *map(str, words)]
    return subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)


def test_a_killed_run_goes_on_and_ends_with_the_same_bytes(source, made_here, tmp_path):
    """Killed four times, each time when a few more pieces of work are done."""
    output = tmp_path / "parcels.pmtiles"
    words = (source, "-o", output, "--max-zoom", ZOOM, "--processes", "1")
    journal = Path(f"{output}{SUFFIX}") / "journal"
    for pieces in (1, 3, 6, 8):
        with run(*words) as process:
            while process.poll() is None and not (journal.exists() and journal.read_text().count("\n") >= pieces):
                time.sleep(0.002)
            assert process.returncode is None
            process.send_signal(signal.SIGKILL)
    assert not output.exists()
    with run(*words) as process:
        errors = process.stderr.read()
    assert process.returncode == 0, errors
    assert hashlib.sha256(output.read_bytes()).digest() == made_here
    assert not journal.parent.exists()


@pytest.mark.long
def test_a_cluster_makes_the_same_bytes_though_a_worker_is_killed(source, made_here, tmp_path):
    here = ("--host", "127.0.0.1")
    with ExitStack() as opened:
        scheduler = running("dask_scheduler", *here, "--port", "0", "--no-dashboard", says="Scheduler at:")
        address = opened.enter_context(scheduler)[1].split()[-1]
        more = ("--nthreads", "1", "--no-dashboard", "--no-nanny")
        workers = [
            opened.enter_context(running("dask_worker", address, *here, *more, says="Registered to:"))[0]
            for _ in range(2)
        ]
        killed = []

        def told(what, number, count):
            if what == "parts" and count > 1 and number == 1 and not killed:
                killed.append(count)
                os.kill(workers[0].pid, signal.SIGKILL)

        output = tmp_path / "parcels.pmtiles"
        make_tiles(source, output, TileOptions(max_zoom=ZOOM, scheduler=address), told)
    assert killed
    assert hashlib.sha256(output.read_bytes()).digest() == made_here
