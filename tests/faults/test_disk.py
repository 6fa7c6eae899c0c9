"""A disk that is full or cannot be written: one line, what was there before is there still, and nothing is in parts."""

import os
import resource
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from examples_of import DRAWINGS
from server import COMMAND, TOKEN, Server, serving, square
from small_disk import Disk

import vexture
from vexture.server.folder import STATE, Folder
from vexture.server.limits import Limits

FULL = "No space left on device"


def lines_of(outcome, code=1):
    """What a command has said, each a line of its own about a file."""
    assert outcome.returncode == code, outcome.stderr
    lines = outcome.stderr.splitlines()
    assert all(line.startswith("vexture: ") for line in lines)
    return lines


def test_textures_that_do_not_fit_are_named_and_the_others_are_whole(tmp_path):
    disk = Disk(tmp_path)
    outcome = disk.run(*COMMAND, "convert", *DRAWINGS, "-o", disk.path, "-q")
    left = disk.left()
    assert 0 < len(left) < len(DRAWINGS)
    assert left.keys() <= {f"{drawing.stem}.ktx2" for drawing in DRAWINGS}, "no file in parts"
    assert all(vexture.load(path).to_ktx2() == path.read_bytes() for path in left.values())
    *refused, total = lines_of(outcome)
    assert len(refused) == len(DRAWINGS) - len(left)
    assert all(f"cannot be written ({FULL}); choose another place" in line for line in refused)
    assert total.startswith(f"vexture: {len(refused)} of {len(DRAWINGS)} files failed")


@pytest.mark.parametrize("option", ["--output", "--atlas"])
def test_what_was_there_stays_if_the_new_one_does_not_fit(tmp_path, option):
    disk = Disk(tmp_path, "4k")  # one page, which the old file has
    place = disk.path / "all.ktx2"
    command = [*COMMAND, "convert", DRAWINGS[0], option, place, "-q"]
    (line,) = lines_of(disk.run("sh", "-c", f'echo old > "{place}" && exec "$@"', "sh", *command))
    assert f"all.ktx2: cannot be written ({FULL})" in line
    assert {name: path.read_text() for name, path in disk.left().items()} == {"all.ktx2": "old\n"}


@pytest.mark.parametrize("arguments", [("convert", DRAWINGS[0], "-o"), ("serve", "--port", "0")])
def test_a_disk_that_cannot_be_written_is_one_line(tmp_path, arguments):
    """As root, too, to whom permissions do not apply."""
    disk = Disk(tmp_path, read_only=True)
    (line,) = lines_of(disk.run(*COMMAND, *arguments, disk.path))
    assert str(disk.path) in line
    assert "; choose another" in line


def test_standard_output_that_is_full_is_one_line():
    with open("/dev/full", "wb") as full:
        command = [*COMMAND, "convert", str(DRAWINGS[0]), "-o", "-", "-q"]
        outcome = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True)
    assert lines_of(outcome) == [f"vexture: the output: {FULL}; make room, or choose another place"]


def test_kernels_that_cannot_be_kept_are_used(tmp_path):
    """A limit of the size of files, which a cache meets as it meets a full disk."""
    outcome = subprocess.run(
        [sys.executable, "-c", "from vexture.bezier.roots import cubic_at; print(cubic_at(0.0, 0.0, 1.0, 1.0, 0.5))"],
        env=os.environ | {"VEXTURE_CACHE": str(tmp_path)},
        capture_output=True,
        text=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (16, 16)),
    )
    assert outcome.stdout == "0.5\n", outcome.stderr
    assert not list(tmp_path.rglob("*.code"))


def test_kernels_run_where_nothing_can_be_written(tmp_path):
    disk = Disk(tmp_path, read_only=True)
    disk.ready += "".join(f" && mount --bind {d} {d} && mount -o remount,bind,ro {d}" for d in ("/tmp", "/var/tmp"))
    disk.ready += ' && cd "$DISK"'
    disk.environment |= {"VEXTURE_CACHE": str(disk.path), "TMPDIR": str(disk.path)}
    program = "from vexture.base.kernels import kernel_cache; from vexture.bezier.roots import cubic_at; "
    outcome = disk.run(sys.executable, "-c", program + "print(kernel_cache(), cubic_at(0.0, 0.0, 1.0, 1.0, 0.5))")
    assert outcome.stdout == "None 0.5\n", outcome.stderr


class ServerOnDisk(Server):
    """`vexture serve` on a small disk."""

    def __init__(self, disk, *options, token=True):
        secret = disk.path.parent / "token"
        secret.write_text(TOKEN)
        self.start(disk.starting([*COMMAND, "serve", disk.path, "--port", "0", "--token-file", secret, *options]))

    def start(self, arguments):
        super().start(list(map(str, arguments)))


def kept_by(disk, server):
    """The folder of a server as its disk holds it now: its names, with the drawing of each, and its files."""
    copy = disk.kept / str(len(list(disk.kept.iterdir())) if disk.kept.exists() else 0)
    shutil.copytree(f"/proc/{server.process.pid}/root{disk.path}", copy)
    files = {path.name for path in (copy / STATE / "files").iterdir()}
    folder = Folder(copy, Limits(), pytest.fail)
    folder.release()
    assert files == {file.name for name in folder.names for file in folder.shape(name).files}
    return {name: folder.shape(name).views["svg"].data for name in folder.names}


def test_a_server_whose_disk_is_full_keeps_what_it_has_acknowledged(tmp_path):
    disk = Disk(tmp_path, "60k")  # the manifest of the last shape does not fit, and its files do
    acknowledged, refused = {}, 0
    with serving(disk, "--rate", "1000", kind=ServerOnDisk) as server:
        for round_ in range(12):
            name, body = f"shape{round_ % 9}", square(1 + round_ % 7) + b" " * (6000 + round_)
            status, told = server.put(name, body)
            if status in (200, 201):
                acknowledged[name] = body
            else:
                refused += 1
                assert status == 507
                assert told["error"] == f"{name}: cannot be kept ({FULL}); make room on the disk"
        assert acknowledged
        assert refused > 1
        assert kept_by(disk, server) == acknowledged, "on the disk, with nothing of what was refused"
        for name, body in acknowledged.items():
            assert server.ask("GET", server.manifest(name)["views"]["svg"][2:])[2] == body


@pytest.mark.slow
def test_a_full_folder_of_temporary_files_is_named(tmp_path):
    """It said that the output has no room, and to choose another file."""
    disk = Disk(tmp_path, "4k")
    netcdf = Path(__file__).parents[1] / "fuzz" / "corpus" / "netcdf" / "four.nc"
    command = ["sh", "-c", 'TMPDIR="$DISK"; export TMPDIR; name=$1; shift; cat "$name" | "$@"', "sh", netcdf, *COMMAND]
    outcome = disk.run(*command, "convert", "-", "-o", tmp_path / "out.ktx2")
    (line,) = lines_of(outcome)
    place = f"temporary files in {disk.path} (TMPDIR)"
    assert line == f"vexture: {place}: {FULL}; make room, or choose another place"
    assert not (tmp_path / "out.ktx2").exists()
    assert disk.left() == {}
