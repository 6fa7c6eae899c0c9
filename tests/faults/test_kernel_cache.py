"""Compiled kernels whose files are damaged: they are compiled again, and none ends a conversion."""

import os
import random
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

PROGRAM = "from vexture.bezier.roots import cubic_at; print(cubic_at(0.0, 0.0, 1.0, 1.0, 0.5))"


def run(cache: Path) -> str:
    """What a program prints that calls a kernel."""
    return subprocess.run(
        [sys.executable, "-c", PROGRAM],
        env=os.environ | {"VEXTURE_CACHE": str(cache)},
        capture_output=True,
        text=True,
        check=False,
    ).stdout


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("cache")
    assert run(folder) == "0.5\n"
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


@pytest.mark.parametrize("damage", DAMAGE.values(), ids=DAMAGE)
def test_a_damaged_file_is_compiled_again(whole: Path, tmp_path: Path, damage: Callable[[Path], object]) -> None:
    """Numba raised what its file led to: EOFError, UnpicklingError, IsADirectoryError; or the process ended."""
    cache = tmp_path / "cache"
    shutil.copytree(whole, cache)
    files = sorted(cache.rglob("*.code"))
    for path in files:
        damage(path)
    assert run(cache) == "0.5\n"
    assert all(path.is_file() and path.stat().st_size > 1000 for path in files), "they are replaced"


@pytest.mark.parametrize("level", ["root", "kernels", "module"])
def test_a_file_in_place_of_a_folder_ends_nothing(whole: Path, tmp_path: Path, level: str) -> None:
    kernels = next(whole.iterdir())
    place = {
        "root": Path(),
        "kernels": Path(kernels.name),
        "module": next(kernels.iterdir()).relative_to(whole),
    }[level]
    cache = tmp_path / "cache"
    (cache / place).parent.mkdir(parents=True, exist_ok=True)
    (cache / place).write_bytes(b"no folder")
    assert run(cache) == "0.5\n"
