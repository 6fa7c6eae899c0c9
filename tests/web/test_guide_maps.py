"""The guide to maps in web pages, read to its end in a real browser: it does what it says, as it stands there."""

import contextlib
import io
import runpy
import shutil
import socket
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from chromium import ROOT, WEB
from guides import Block, Reader, blocks_of, free_port
from vexture.base.errors import VextureError

PORTS = ("5174", "5175")
SIZE = (480, 720)
BALL = 240
FRANCE, SPAIN, ANTARCTICA = (2.0, 46.5), (-4.0, 40.0), (40.0, -72.0)
PALETTE = ("#f2d7a6", "#c9dba6", "#e3b8a8", "#b9cfb0", "#e6cf8f")
SEA, RED = "#cfe3ee", "#d1495b"
IDS = {FRANCE: 250, SPAIN: 724, ANTARCTICA: 10}


def _bytes(colour: str) -> list[int]:
    return [int(colour[k : k + 2], 16) for k in (1, 3, 5)]


def _own(place: tuple[float, float]) -> str:
    return PALETTE[IDS[place] % len(PALETTE)]


def _linked(folder: Path, names: list[str]) -> None:
    """What the guide installs, from the packages of web/ and those of the benchmarks."""
    if not (WEB / "node_modules" / "maplibre-gl").is_dir():
        pytest.skip("the packages of web/ are not installed (npm ci --prefix web)")
    corpora = runpy.run_path(str(ROOT / "packages" / "vexture-evidence" / "benchmarks" / "corpora.py"))
    modules = folder / "node_modules"
    (modules / ".bin").mkdir(parents=True)
    (modules / ".bin" / "esbuild").symlink_to(WEB / "node_modules" / ".bin" / "esbuild")
    for name in names:
        try:
            elsewhere = {"vexture": lambda: WEB, "world-atlas": corpora["Package"](name, "2.0.2", "").installed_folder}
            found = elsewhere.get(name, lambda name=name: WEB / "node_modules" / name)()
        except VextureError as error:
            pytest.skip(str(error))
        (modules / name).symlink_to(found)


def _take(reader: Reader, block: Block) -> None:
    if block.text.startswith("npm install "):
        _linked(reader.folder, block.text.split()[2:])
    elif block.language == "js" and not block.title:
        with (reader.folder / "map.js").open("a", encoding="utf-8") as file:
            file.write(block.text)
    else:
        reader.take(block)


def _answered(port: int) -> str:
    for _ in range(300):
        with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port), timeout=1):
            return f"http://127.0.0.1:{port}"
        time.sleep(0.1)
    raise AssertionError(f"nothing answers on port {port}")


def _pixels(page: Any) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB")).astype(int)


def _at(page: Any, pixel: tuple[float, float]) -> list[int]:
    clip = {"x": int(pixel[0]), "y": int(pixel[1]), "width": 1, "height": 1}
    with Image.open(io.BytesIO(page.screenshot(clip=clip))) as image:
        found: list[int] = np.asarray(image.convert("RGB"))[0, 0].tolist()
    return found


def _await(page: Any, pixel: tuple[float, float], colour: str) -> None:
    """Look until a pixel has a colour: files and shaders take their time."""
    wanted = np.array(_bytes(colour))
    for _ in range(100):
        if np.abs(_at(page, pixel) - wanted).max() <= 2:
            return
        page.wait_for_timeout(100)
    assert _at(page, pixel) == wanted.tolist()


def _on_map(place: tuple[float, float]) -> tuple[float, float]:
    """Where a place is seen in the first view of the flat map."""

    def world(lng: float, lat: float) -> np.ndarray:
        return np.array([lng, -np.degrees(np.arcsinh(np.tan(np.radians(lat))))]) * 512 * 2 / 360

    x, y = world(*place) - world(10, 15) + np.array(SIZE) / 2
    return float(x), float(y)


def _used_map(page: Any) -> None:
    france, spain, ice = (_on_map(place) for place in (FRANCE, SPAIN, ANTARCTICA))
    _await(page, france, _own(FRANCE))
    page.get_by_text("Natural Earth").wait_for(state="attached")
    page.mouse.move(*france)
    page.wait_for_function("document.querySelector('#name').value === 'France'")
    page.mouse.click(*france)
    _await(page, france, RED)
    page.mouse.click(*spain)
    _await(page, spain, RED)
    _await(page, france, _own(FRANCE))
    page.mouse.move(*_on_map((-30, 40)))
    page.wait_for_function("document.querySelector('#name').value === 'Point at a country'")
    _await(page, ice, _own(ANTARCTICA))
    page.locator("#south").uncheck()
    _await(page, ice, SEA)
    page.locator("#year").fill("5")
    page.wait_for_timeout(100)
    assert np.abs(np.subtract(_at(page, france), _bytes(_own(FRANCE)))).max() > 20
    _await(page, spain, RED)  # it is picked
    page.locator("#year").fill("0")
    _await(page, france, _own(FRANCE))


def _flat_then_globe(page: Any, screenshot: Callable[..., Path]) -> None:
    screenshot(page, "flat")
    dark = (_pixels(page).max(axis=2) < 100).mean()
    assert 0.0005 < dark < 0.05, "no names, or more than names"
    page.locator("#globe").check()
    _await(page, (3, SIZE[1] - 3), "#ffffff")
    screenshot(page, "globe")


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.usefixtures("chromium")
def test_the_guide_to_maps_in_web_pages_does_what_it_says(
    tmp_path: Path, open_page: Callable[..., Any], screenshot: Callable[..., Path]
) -> None:
    pytest.importorskip("pmtiles", reason="pmtiles is not installed (pip install 'vexture[map]')")
    if shutil.which("npx") is None:
        pytest.skip("no npm")
    folder = tmp_path / "run"
    folder.mkdir()
    with Reader(folder, {port: free_port() for port in PORTS}) as reader:
        for block in blocks_of("web-maps"):
            _take(reader, block)
        page = open_page(_answered(reader.ports["5174"]), SIZE)
        _used_map(page)
        _flat_then_globe(page, screenshot)
        page.locator("#globe").uncheck()
        page.locator("input[type=file]").set_input_files(reader.folder / "public" / "countries.pmtiles")
        _await(page, _on_map(FRANCE), _own(FRANCE))
        ball = open_page(f"{_answered(reader.ports['5175'])}/globe.html", (BALL, BALL))
        middle = (BALL / 2, BALL / 2)
        _await(ball, (BALL / 2 - 10, BALL / 2 + 7), PALETTE[12 % len(PALETTE)])  # Algeria
        screenshot(ball, "ball")
        ball.mouse.move(*middle)
        _await(ball, middle, RED)
