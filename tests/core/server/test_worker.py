"""The processes of a server's conversions: their time, their memory, their temporary files, and their end."""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pytest
from loops import run

from vexture.base.errors import LimitError
from vexture.server import converter as converting
from vexture.server.converter import Converter
from vexture.server.limits import Limits
from vexture.server.worker import Worker

MEGABYTE = 2**20


def write(files, megabytes, removed):
    """Write temporary files and stay, as a library that reads one of them; those that it removes stay open."""
    opened = []
    for number in range(files):
        file = open(os.path.join(tempfile.gettempdir(), f"part-{number}"), "wb")  # noqa: SIM115
        for _ in range(megabytes):
            file.write(os.urandom(MEGABYTE))
        file.flush()
        if number < removed:
            os.unlink(file.name)
        opened.append(file)
    time.sleep(1000)


def leave():
    """Forget a temporary file; the folder that it is in."""
    folder = Path(tempfile.gettempdir())
    (folder / "more").mkdir(exist_ok=True)
    (folder / "more" / "left").write_bytes(bytes(MEGABYTE))
    return str(folder)


def found():
    return [str(path) for path in Path(tempfile.gettempdir()).rglob("*") if path.is_file()]


def places():
    return [os.environ[name] for name in ("TMPDIR", "CPL_TMPDIR", "SQLITE_TMPDIR")], tempfile.gettempdir()


def converted(work, *given, **named):
    """Result of work in a converter."""

    async def all_of_it():
        converter = Converter(Limits())
        try:
            return await converter.run(work, *given, about="a.nc", **named)
        finally:
            converter.close()

    return run(all_of_it())


SECOND_LOOKS = [(4, 3, 0), (1, 12, 0), (4, 3, 4), (1, 12, 1)]


@pytest.mark.parametrize("given", [(2, 6, 1), *(pytest.param(given, marks=pytest.mark.slow) for given in SECOND_LOOKS)])
def test_temporary_files_have_a_limit_together(monkeypatch, given):
    """They had none: an upload filled the disk of the server."""
    monkeypatch.setattr(converting, "TEMPORARY_BYTES", 10 * MEGABYTE)
    if given[2] and sys.platform != "linux":
        pytest.skip("files that are removed and open are found in /proc")
    before = set(os.listdir(tempfile.gettempdir()))
    with pytest.raises(LimitError, match=r"^a\.nc: its conversion needs more temporary files than have room, or than "):
        converted(write, *given)
    assert {name for name in set(os.listdir(tempfile.gettempdir())) - before if name.startswith("vexture-")} == set()


@pytest.mark.slow
def test_a_temporary_file_has_a_limit_by_itself(monkeypatch):
    monkeypatch.setattr(converting, "TEMPORARY_BYTES", 2 * MEGABYTE)
    monkeypatch.setattr(converting, "LOOK_SECONDS", 1000.0)
    with pytest.raises(LimitError, match="needs more temporary files than have room"):
        converted(write, 1, 12, 0)


def test_libraries_have_their_temporary_files_there():
    async def told():
        worker = Worker()
        try:
            return await worker.run(places)
        finally:
            worker.kill()

    named, folder = run(told())
    assert named == [folder] * 3


def test_what_a_conversion_leaves_counts_for_no_other():
    async def both():
        worker = Worker()
        try:
            folder = await worker.run(leave)
            return folder, await worker.run(found)
        finally:
            worker.kill()

    folder, left = run(both())
    assert left == []
    assert not os.path.exists(folder)


@pytest.mark.slow
def test_a_conversion_has_its_time_without_the_start_of_its_process():
    assert converted(os.getpid, seconds=5.0) != os.getpid()
    with pytest.raises(LimitError, match=r"^a\.nc: its conversion takes longer than 0\.1 s; simplify the drawing$"):
        converted(time.sleep, 1000.0, seconds=0.1)


SERVER = """
import asyncio, signal, sys, time
from vexture.server.worker import Worker
sys.path.insert(0, sys.argv[1])
from test_worker import hold
async def main():
    await Worker().run(hold)
if __name__ == "__main__":
    asyncio.run(main())
"""


def hold():
    """Keep the interpreter's lock, as a library may, after telling which process this is and where its files are."""
    import ctypes

    Path(tempfile.gettempdir(), "held").write_bytes(b"")
    sys.stdout.write(f"{os.getpid()} {tempfile.gettempdir()}\n")
    sys.stdout.flush()
    ctypes.PyDLL(None).sleep(1000)


@pytest.mark.skipif(sys.platform != "linux", reason="looks for processes in /proc")
def test_a_process_ends_with_its_server_though_a_library_holds_it(tmp_path):
    """A thread was to end it, and waited for the interpreter's lock, with the temporary files on the disk."""
    program = tmp_path / "server.py"
    program.write_text(SERVER)
    command = [sys.executable, str(program), str(Path(__file__).parent)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        process, folder = server.stdout.readline().split()
        assert os.path.exists(folder)
        server.kill()
    while os.path.exists(folder) or alive(process):  # the limit of the test's time ends this
        time.sleep(0.01)


def alive(process):
    try:
        return "State:\tZ" not in Path(f"/proc/{process}/status").read_text()
    except OSError:
        return False
