"""The guide from an SVG to three.js, read to its end in a real browser: it does what it says, as it stands there."""

import contextlib
import io
import re
import shutil
import socket
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from chromium import ROOT
from guides import Reader, blocks_of, free_port
from viewing import PATIENCE

BUILT = shutil.ignore_patterns("node_modules", "__pycache__", "*.egg-info", "built", "types", "*.tgz")
SLOWLY = """{
    const next = window.requestAnimationFrame.bind(window);
    window.requestAnimationFrame = (draw) => setTimeout(() => next(draw), 150);
}"""
"""The guide's programs draw as often as the screen asks; without a GPU that takes the processor from all else."""

PAPER, DUCK, BLUE, RED, SUN = (0xF4F1E8, 0xE8B100, 0x0066CC, 0xB71C1C, 0xFFD633)


def _checkout(folder: Path) -> Path:
    """The repository without what is built in it."""
    folder.mkdir()
    for name in ("packages", "web", "tools", "examples/shapes"):
        shutil.copytree(ROOT / name, folder / name, ignore=BUILT)
    for name in ("Makefile", "pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, folder)
    return folder


def _pixels(page: Any) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB")).astype(int)


def _share(pixels: np.ndarray, color: int) -> float:
    wanted = np.array([color >> 16, color >> 8 & 255, color & 255])
    return float(np.mean(np.abs(pixels - wanted).max(axis=2) <= 2))


def _await(page: Any, check: Callable[[np.ndarray], None]) -> None:
    """Look until the page shows what it must: files and shaders take their time."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        with contextlib.suppress(AssertionError):
            return check(_pixels(page))
        page.wait_for_timeout(100)
    return check(_pixels(page))


def _of_a_duck(pixels: np.ndarray) -> None:
    assert _share(pixels, DUCK) > 0.1
    assert _share(pixels, DUCK) + _share(pixels, PAPER) > 0.95


def _in_colours(pixels: np.ndarray) -> None:
    assert _share(pixels, BLUE) > 0.15
    assert _share(pixels, SUN) > 0.01
    assert _share(pixels, 0xFFFFFF) > 0.03


def _in_red(pixels: np.ndarray) -> None:
    assert _share(pixels, RED) > 0.15
    assert _share(pixels, BLUE) == 0.0


def _lit(pixels: np.ndarray) -> None:
    """A ball with red ducks, or a duck before a wall with a shadow of its shape."""
    red, green, blue = np.moveaxis(pixels, 2, 0)
    if _share(pixels, PAPER) > 0.1:
        assert np.mean((red > 1.5 * green) & (red > 100)) > 0.05, "no red ducks"
        assert np.mean((np.ptp(pixels, axis=2) <= 3) & (red > 100)) > 0.1, "no white ball"
        return
    wall = np.ptp(pixels, axis=2) <= 3
    duck = (red > 1.5 * blue) & ~wall
    shade = wall & (red < 0.8 * np.median(red[wall]))
    assert 0.08 < np.mean(duck) < 0.3
    assert 0.01 < np.mean(shade) < 0.2, "the duck throws no shadow, or its whole plane does"


def _of_tiles(pixels: np.ndarray) -> None:
    blue = np.abs(pixels - [0x1D, 0x4E, 0xD8]).max(axis=2) <= 2
    unit = len(pixels) / (2 * 3.5 * np.tan(np.radians(40 / 2)))
    middles = 256 + np.rint(unit * (0.6 * np.arange(4) - 0.9)).astype(int)
    columns = np.array([[blue[y - 55 : y + 55, x - 55 : x + 55].mean() for x in middles] for y in middles])
    assert columns.min() > 0.1
    assert np.ptp(columns, axis=0).max() < 0.02, "a column shows one shape"
    assert np.ptp(columns.mean(axis=0)) > 0.02, "columns show different shapes"


def _answered(port: int) -> None:
    """Wait for a server that has said its first line, which it may do before it listens."""
    for _ in range(300):
        with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port), timeout=1):
            return
        time.sleep(0.1)
    raise AssertionError(f"nothing answers on port {port}")


SEEN = {
    "Put it on a mesh": _of_a_duck,
    "In its own colours": _in_colours,
    "On lit materials: masks": _lit,
    "Whole models": _in_colours,
    "Many shapes: atlas and instances": _of_tiles,
    "A shape that changes": _in_colours,
    "Speed, size and precision": _of_a_duck,
}
"""What the page shows once a program of a section runs."""


@pytest.mark.slow  # masks, instances, live textures and the package have tests of their own
@pytest.mark.usefixtures("page_is_built")
def test_the_guide_to_three_js_does_what_it_says(
    tmp_path: Path, open_page: Callable[..., Any], screenshot: Callable[..., Path]
) -> None:
    if shutil.which("npx") is None:
        pytest.skip("no npm")
    blocks = blocks_of("from-svg-to-three")
    (main,) = (block.text for block in blocks if block.title == "main.js")
    shown: list[str] = []
    page: Any = None
    with Reader(_checkout(tmp_path / "vexture"), {"8000": free_port(), "5173": free_port()}) as reader:
        address = f"http://127.0.0.1:{reader.ports['5173']}/"

        def show(section: str) -> Any:
            if page is not None:
                page.close()  # it would go on drawing
            _answered(reader.ports["5173"])
            opened = open_page("about:blank")
            opened.add_init_script(SLOWLY)
            opened.goto(address)
            _await(opened, SEEN[section])
            shown.append(section)
            screenshot(opened, f"{re.sub('[^a-z]+', '-', section.lower())}-{shown.count(section)}")
            return opened

        for block in blocks:
            if block.language == "js" and block.title is None:
                (reader.folder / "main.js").write_text(main + reader.replace_ports(block.text), encoding="utf-8")
                page = show(block.section)
                continue
            reader.take(block)
            if "--servedir" in block.text:
                page = show(block.section)
            elif "red.svg" in block.text:  # the page is still that of the program before, never loaded again
                _await(page, _in_red)
                screenshot(page, "pushed")
        page.close()  # its script is not for other tests
    assert set(shown) == set(SEEN)
