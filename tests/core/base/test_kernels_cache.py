"""Compiled kernels whose files are damaged: they are compiled again, and none ends a conversion."""

import random
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

PROGRAM = """
import os, sys
import numba
numba.njit(lambda x: x + 1.0)(1.0)  # once, for all
for folder in sys.argv[1:]:
    process = os.fork()
    if process == 0:
        os.environ["VEXTURE_CACHE"] = folder
        from vexture.bezier.roots import cubic_at
        print(cubic_at(0.0, 0.0, 1.0, 1.0, 0.5), flush=True)
        os._exit(0)
    if status := os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]):
        print(status, flush=True)
"""
"""Call a kernel in a process for each cache."""


def run(*caches: Path) -> list[str]:
    """What programs print that call a kernel, or how they ended."""
    command = [sys.executable, "-c", PROGRAM, *map(str, caches)]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout.splitlines()


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("cache")
    assert run(folder) == ["0.5"]
    assert list(folder.rglob("*.code"))
    return folder


def flip(path: Path) -> None:
    content = bytearray(path.read_bytes())
    chance = random.Random(1)
    for _ in range(100):
        content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
    path.write_bytes(content)


def make_folder(path: Path) -> None:
    path.unlink()
    path.mkdir()
    (path / "more").write_bytes(b"")


def make_link_to_itself(path: Path) -> None:
    path.unlink()
    path.symlink_to(path.name)


DAMAGE: dict[str, Callable[[Path], object]] = {
    "empty": lambda path: path.write_bytes(b""),
    "short": lambda path: path.write_bytes(path.read_bytes()[:20]),
    "cut off": lambda path: path.write_bytes(path.read_bytes()[:-1]),
    "random": lambda path: path.write_bytes(random.Random(1).randbytes(5000)),
    "flipped bits": flip,
    "zeros": lambda path: path.write_bytes(bytes(len(path.read_bytes()))),
    "a folder": make_folder,
    "no permission": lambda path: path.chmod(0),
    "a link to itself": make_link_to_itself,
}


def test_damaged_files_are_compiled_again(whole: Path, tmp_path: Path) -> None:
    """Numba raised what its file led to: EOFError, UnpicklingError, IsADirectoryError; or the process ended."""
    caches = {name: tmp_path / name for name in DAMAGE}
    for name, cache in caches.items():
        shutil.copytree(whole, cache)
        for path in sorted(cache.rglob("*.code")):
            DAMAGE[name](path)
    assert dict(zip(DAMAGE, run(*caches.values()), strict=True)) == dict.fromkeys(DAMAGE, "0.5")
    for cache in caches.values():
        for file in whole.rglob("*.code"):
            path = cache / file.relative_to(whole)
            assert path.is_file(), f"{path} is replaced"
            assert path.stat().st_size > 1000


def test_files_in_place_of_folders_end_nothing(whole: Path, tmp_path: Path) -> None:
    kernels = next(whole.iterdir())
    places = {"root": Path(), "kernels": Path(kernels.name), "module": next(kernels.iterdir()).relative_to(whole)}
    for name, place in places.items():
        path = tmp_path / name / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(b"no folder")
    assert run(*(tmp_path / name for name in places)) == ["0.5"] * len(places)
