"""Tiles by several processes and a cluster: the same bytes, also where they are killed."""

import hashlib
import re
import shlex
import signal
import subprocess
import sys
import time
import tomllib
from contextlib import ExitStack
from pathlib import Path

import pytest
import yaml
from tile_sources import write_many

from clusters import HERE, cluster_of, line_of, start_dask
from guides import GUIDES, ROOT, free_port
from vexture_geo.tiles.build import make_tiles
from vexture_geo.tiles.options import TileOptions
from vexture_geo.tiles.store import SUFFIX

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


@pytest.mark.slow
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


@pytest.mark.slow
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


@pytest.fixture(scope="module")
def composed():
    """The services of the file for Docker."""
    return yaml.safe_load((ROOT / "examples" / "cluster" / "compose.yaml").read_text(encoding="utf-8"))["services"]


@pytest.fixture(scope="module")
def guide():
    """Commands of the guide's part about clusters, each by its first two words."""
    text = (GUIDES / "tiles.md").read_text(encoding="utf-8").partition("## A cluster")[2]
    lines = [line.partition("#")[0].strip() for line in text.splitlines() if line.startswith("    ")]
    return {" ".join(line.split()[:2]): line for line in lines}


def test_the_file_for_docker_agrees_with_itself_and_with_the_guide(composed, guide):
    scheduler, worker = composed["scheduler"], composed["worker"]
    assert scheduler["image"] == worker["image"]
    project = (ROOT / "packages" / "vexture" / "pyproject.toml").read_text(encoding="utf-8")
    extras = tomllib.loads(project)["project"]["optional-dependencies"]
    wanted = re.findall(r"'vexture\[([a-z,]+)\]'", scheduler["build"]["dockerfile_inline"])
    assert wanted == re.findall(r"'vexture\[([a-z,]+)\]'", guide["pip install"])
    assert {name for one in wanted for name in one.split(",")} <= set(extras)
    (published,) = scheduler["ports"]
    host, _, port = published.split(":")
    assert host == "127.0.0.1"
    assert scheduler["command"] == guide["dask scheduler"] == f"dask scheduler --port {port}"
    assert worker["depends_on"] == ["scheduler"]
    assert f" tcp://scheduler:{port} " in worker["command"]
    file, scaled = re.fullmatch(r"docker compose -f (\S+) up --scale (\w+)=\d+", guide["docker compose"]).groups()
    assert (ROOT / file).is_file()
    assert scaled in composed


@pytest.mark.slow
@pytest.mark.long
def test_the_commands_of_the_guide_and_of_docker_make_the_same_bytes(source, made_here, composed, guide, tmp_path):
    """As they stand there, but for the addresses, the number of workers, and what is made of what."""
    address = f"127.0.0.1:{free_port()}"
    output = tmp_path / "parcels.pmtiles"
    places = {
        "scheduler:8786": address,
        "10.0.0.7:8786": address,
        "--port 8786": f"--port {address.partition(':')[2]}",
        "--nworkers 8": "--nworkers 2",
        "parcels.fgb": str(source),
        "parcels.pmtiles": str(output),
        "--max-zoom 14": f"--max-zoom {ZOOM} --table none",
    }

    def words(line):
        for given, here in places.items():
            line = line.replace(given, here)
        return shlex.split(line)

    with ExitStack() as opened:
        for line, says, times in (
            (composed["scheduler"]["command"], f"Scheduler at: +tcp://{address}", 1),
            (composed["worker"]["command"], f"Registered to: +tcp://{address}", 1),
            (guide["dask worker"], f"Registered to: +tcp://{address}", 2),
        ):
            dask, *given = words(line)
            assert dask == "dask"
            process = opened.enter_context(start_dask(*given, *HERE))
            for _ in range(times):
                assert re.search(says, line_of(process, says.partition(":")[0]))
        vexture, command, *given = words(guide["vexture tiles"])
        assert (vexture, command) == ("vexture", "tiles")
        with run(*given) as process:
            errors = process.stderr.read()
    assert process.returncode == 0, errors
    assert hashlib.sha256(output.read_bytes()).digest() == made_here
