"""Commands that are killed at any moment: each file is whole or absent, and what is left behind does not pile up."""

import json
import os
import random
import subprocess
import sys
import time

import pytest
from examples_of import DRAWINGS
from floods import BOUNDS, flooding, sea, series
from server import COMMAND, TOKEN, serving, square

import vexture
from vexture.texture.files import LEFT_SECONDS, TEMPORARY, replace_files

MANY = pytest.param(200, marks=[pytest.mark.slow, pytest.mark.timeout(3600)])

SAVING = """
import dataclasses, json, os, random, signal, sys, time
import vexture
folder, drawing, rounds = sys.argv[1], sys.argv[2], int(sys.argv[3])
whole = vexture.convert(drawing)
both = [dataclasses.replace(whole, source=letter * 1_000_000) for letter in "ab"]
contents = {texture.to_ktx2() for texture in both}
place = os.path.join(folder, "drawing.ktx2")
chance, parts, absent, seen, longest = random.Random(1), 0, 0, set(), 0.01
for _ in range(rounds):
    child = os.fork()
    if not child:
        while True:
            for texture in both:
                texture.save(place)
    time.sleep(chance.uniform(0.0, longest))
    longest *= 1.05 if len(seen) < len(both) else 1.0  # a busy machine may not come to the second one so soon
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    if os.path.exists(place):
        content = open(place, "rb").read()
        parts += content not in contents
        seen.add(content)
    else:
        absent += 1
print(json.dumps({"parts": parts, "seen": len(seen), "absent": absent}))
"""


def age(folder):
    """Let what is in a folder be old; the files that were left in parts."""
    left = list(folder.rglob(f"*{TEMPORARY}"))
    for path in left:
        long_ago = time.time() - 2 * LEFT_SECONDS
        os.utime(path, (long_ago, long_ago))
    return left


@pytest.mark.slow
def test_a_texture_that_is_saved_is_whole(tmp_path):
    command = [sys.executable, "-c", SAVING, str(tmp_path), str(DRAWINGS[0]), "200"]
    told = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    assert told["parts"] == 0
    assert told["seen"] == 2
    assert age(tmp_path), "no process was killed while it wrote"
    vexture.convert(DRAWINGS[0]).save(tmp_path / "drawing.ktx2")
    assert [path.name for path in tmp_path.iterdir()] == ["drawing.ktx2"]


def test_a_file_that_another_process_writes_is_left_to_it(tmp_path):
    other = tmp_path / f".a.0{TEMPORARY}"
    other.write_bytes(b"of another process")
    replace_files({tmp_path / "a": b"ours"})
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == {
        "a": b"ours",
        other.name: b"of another process",
    }


@pytest.mark.slow
@pytest.mark.parametrize("rounds", [1, MANY])
def test_a_command_that_is_killed_leaves_whole_files(tmp_path, rounds):
    chance = random.Random(2)
    command = [*COMMAND, "convert", *map(str, DRAWINGS), "-q", "-o"]
    started = time.monotonic()
    subprocess.run([*command, tmp_path / "whole"], check=True)
    took = time.monotonic() - started
    whole = {path.name: path.read_bytes() for path in (tmp_path / "whole").iterdir()}
    folder = tmp_path / "killed"
    for _ in range(rounds):
        process = subprocess.Popen([*command, folder])
        time.sleep(chance.uniform(0.5, 1.1) * took)
        process.kill()
        process.wait()
        found = {path.name: path.read_bytes() for path in folder.glob("*.ktx2")}
        assert found.items() <= whole.items()
    age(folder)
    subprocess.run([*command, folder], check=True)
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == whole


def emptied(folder):
    """Wait until processes that end with their server have removed what was theirs."""
    for _ in range(600):
        if not any(folder.iterdir()):
            return True
        time.sleep(0.1)
    return False


@pytest.fixture
def scratch(tmp_path, monkeypatch):
    """Folder of the temporary files of all processes."""
    folder = tmp_path / "scratch"
    folder.mkdir()
    monkeypatch.setenv("TMPDIR", str(folder))
    return folder


@pytest.mark.slow
@pytest.mark.parametrize("rounds", [1, MANY])
def test_a_server_that_is_killed_while_it_starts_has_all_it_had(tmp_path, scratch, rounds):
    chance, folder, token = random.Random(3), tmp_path / "shapes", tmp_path / "token"
    bodies = {name: square(2 + number) for number, name in enumerate(("a", "b", "c"))}
    with serving(folder) as server:
        assert [server.put(name, body)[0] for name, body in bodies.items()] == [201] * 3
        assert any(scratch.iterdir())
        server.stop()
    assert not any(scratch.iterdir()), "a server that stops ends its conversions"
    (folder / "beside.svg").write_bytes(square(9))
    kept = {path.name: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    for _ in range(rounds):
        process = subprocess.Popen([*COMMAND, "serve", folder, "--port", "0", "--token-file", token])
        time.sleep(chance.uniform(0.2, 1.5))  # it can be asked after half a second, and converts then
        process.kill()
        process.wait()
        assert {path.name: path.read_bytes() for path in folder.rglob("*") if path.is_file()} == kept
    with serving(folder) as server:
        for name, body in bodies.items():
            assert server.ask("GET", server.manifest(name)["views"]["svg"][2:])[2] == body
        assert server.wait_for("beside")
    assert emptied(scratch)


@pytest.mark.parametrize("rounds", [1, pytest.param(100, marks=[pytest.mark.slow, pytest.mark.timeout(3600)])])
@pytest.mark.usefixtures("page_is_built")
def test_a_flood_that_is_killed_leaves_nothing_behind(tmp_path, scratch, rounds):
    """While it starts, and while it converts: NetCDF is read from a temporary file. Uploads it keeps until it stops."""
    chance = random.Random(4)
    upload = series(tmp_path / "depths.nc", [0.5, 0.7]).read_bytes()
    extent = sea(tmp_path / "sea.geojson", 0.5)
    shown = ["--extent", extent, "--bounds", ",".join(map(str, BOUNDS))]
    for _ in range(rounds):
        process = subprocess.Popen([*COMMAND, "flood", *shown, "--serve", "--port", "0"], stderr=subprocess.DEVNULL)
        time.sleep(chance.uniform(0.2, 2.0))
        process.kill()
        process.wait()
        assert emptied(scratch)
        with flooding(tmp_path, *shown) as server:
            connection = server.connect()
            connection.request("PUT", "/shapes/flood", upload, {"Authorization": f"Bearer {TOKEN}"})
            time.sleep(chance.uniform(0.0, 2.0))
            server.process.kill()
            connection.close()
        assert emptied(scratch)
    assert {path.name for path in tmp_path.iterdir()} == {"depths.nc", "sea.geojson", "token", "scratch"}
