"""The guides run: those that need nothing but a folder here, the others where their browser and their data are."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from guides import GUIDES, Block, Reader, alike, blocks_of

ELSEWHERE = {"from-svg-to-three": "web/test_guide_three.py", "coastal-data": "flood/test_guide_coastal.py"}
TESTS = Path(__file__).parents[1]


def test_the_guide_for_python_does_what_it_says(tmp_path: Path) -> None:
    folder = tmp_path / "run"
    folder.mkdir()
    with Reader(folder) as reader:
        for block in blocks_of("from-python"):
            reader.take(block)
    with Image.open(folder / "logo.png") as image:
        assert image.getpixel((30, 150)) == (0, 102, 204)
        assert image.getpixel((100, 104)) == (255, 214, 51)
    with Image.open(folder / "kite.png") as image:
        assert 1 - np.asarray(image).mean() / 255 == pytest.approx(0.24, abs=0.01)


def test_every_guide_is_read_by_a_test() -> None:
    for path in GUIDES.glob("*.md"):
        test = TESTS / ELSEWHERE.get(path.stem, "docs/test_guides.py")
        assert f'blocks_of("{path.stem}")' in test.read_text(encoding="utf-8")


def test_a_guide_that_says_what_is_not_so_is_noticed(tmp_path: Path) -> None:
    def block(language: str, text: str) -> Block:
        return Block(language, None, text, "", "here")

    folder = tmp_path / "run"
    folder.mkdir()
    with Reader(folder) as reader:
        reader.take(block("sh", "echo 12.5 ms, 3 quads"))
        reader.take(block("text", "8.25 ms, 3 quads\n"))
        with pytest.raises(AssertionError, match="3 quads"):
            reader.take(block("text", "12.5 ms, 4 quads\n"))
        with pytest.raises(AssertionError, match="here"):
            reader.take(block("sh", "vexture convert missing.svg\necho done"))
        with pytest.raises(ZeroDivisionError):
            reader.take(block("python", "1 / 0"))
        with pytest.raises(AssertionError, match="nothing is done with ruby"):
            reader.take(block("ruby", "puts 1"))
    assert alike("a: 3 curves, 1120 bytes, 4.6 ms") == "a: 3 curves, -, -"


def test_what_a_guide_starts_ends_with_it(tmp_path: Path) -> None:
    folder = tmp_path / "run"
    folder.mkdir()
    with Reader(folder) as reader:
        command = f"{sys.executable} -u -m http.server 0   # until Ctrl-C"
        reader.take(Block("sh", None, command, "", "here"))
        (process,) = reader.started
        assert process.poll() is None
    assert isinstance(process, subprocess.Popen)
    assert process.poll() is not None
