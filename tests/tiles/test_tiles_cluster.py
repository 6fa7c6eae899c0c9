"""Tiles by several processes and a cluster: the same bytes, also where they are killed."""

import hashlib
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from tile_sources import write_many

from clusters import cluster_of
from vexture.tiles.build import make_tiles
from vexture.tiles.options import TileOptions
from vexture.tiles.store import SUFFIX

ZOOM = 8


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
    """Stopped four times, each time when a few more pieces of work are done; by Ctrl-C at last, which says so."""
    output = tmp_path / "parcels.pmtiles"
    words = (source, "-o", output, "--max-zoom", ZOOM, "--processes", "1", "--table", "none")
    journal = Path(f"{output}{SUFFIX}") / "journal"
    for pieces in (1, 3, 6, 8):
        with run(*words) as process:
            while process.poll() is None and not (journal.exists() and journal.read_text().count("\n") >= pieces):
                time.sleep(0.002)
            assert process.returncode is None
            process.send_signal(signal.SIGINT if pieces == 8 else signal.SIGKILL)
            said = process.stderr.read()
    assert process.returncode == 130
    assert (
        said
        == f"vexture: interrupted; what is finished is in {journal.parent}, and the same command goes on from there\n"
    )
    assert not output.exists()
    with run(*words) as process:
        errors = process.stderr.read()
    assert process.returncode == 0, errors
    assert hashlib.sha256(output.read_bytes()).digest() == made_here
    assert not journal.parent.exists()


@pytest.mark.long
def test_a_cluster_makes_the_same_bytes_though_a_worker_is_killed(source, made_here, tmp_path):
    killed = []
    with cluster_of(2) as (address, workers):

        def told(what, number, count):
            if what == "parts" and count > 1 and number == 1 and not killed:
                killed.append(count)
                workers[0].kill()

        output = tmp_path / "parcels.pmtiles"
        make_tiles(source, output, TileOptions(max_zoom=ZOOM, scheduler=address), told)
    assert killed
    assert hashlib.sha256(output.read_bytes()).digest() == made_here
