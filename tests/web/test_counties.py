"""The example `examples/counties`: its page is built, coloured anew, pointed at and clicked."""

import io
import json
import os
import runpy
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from PIL import Image

from chromium import ROOT, WEB, serve_folder
from vexture.base.errors import VextureError

EXAMPLE = ROOT / "examples" / "counties"
PAINTED = (255, 255, 255), (255, 92, 76)  # pointed at, picked
SIZE = (640, 480)

corpora = SimpleNamespace(**runpy.run_path(str(ROOT / "packages" / "vexture-evidence" / "benchmarks" / "corpora.py")))


def four_counties() -> dict[str, Any]:
    """Two states of two counties each, quarters of a rectangle, and a county without area, as us-atlas has some."""
    corners = {"10001": (0, 0), "10003": (0, 60), "20001": (100, 0), "20003": (100, 60)}
    arcs = [[[x, y], [x + 100, y], [x + 100, y + 60], [x, y + 60], [x, y]] for x, y in corners.values()]
    arcs += [[[x, 0], [x + 100, 0], [x + 100, 120], [x, 120], [x, 0]] for x in (0, 100)]
    arcs += [[[50, 50]] * 4]

    def area(place: int, one: str, name: str) -> dict[str, Any]:
        return {"type": "Polygon", "id": one, "arcs": [[place]], "properties": {"name": name}}

    counties = [area(place, one, f"County {place}") for place, one in enumerate(corners)]
    states = [area(4, "10", "West"), area(5, "20", "East")]
    objects = {"counties": [*counties, area(6, "10005", "Nowhere")], "states": states}
    collections = {key: {"type": "GeometryCollection", "geometries": some} for key, some in objects.items()}
    return {"type": "Topology", "bbox": [0, 0, 200, 120], "objects": collections, "arcs": arcs}


def package(name: str) -> Path:
    """Where a package lies that the example uses and web/ does not, in the version of the example."""
    version = json.loads((EXAMPLE / "package.json").read_text(encoding="utf-8"))["devDependencies"][name]
    try:
        return Path(corpora.Package(name, version, "").installed_folder())
    except VextureError as error:
        pytest.skip(str(error))


def built(folder: Path, *arguments: Path, packages: tuple[str, ...] = ("topojson-client",)) -> Path:
    """Build the page in a copy of the example, with the packages of web/."""
    if not (WEB / "node_modules" / "three").is_dir():
        pytest.skip("the packages of web/ are not installed (npm ci --prefix web)")
    copy = folder / "examples" / "counties"
    shutil.copytree(EXAMPLE, copy, ignore=shutil.ignore_patterns("node_modules"))
    (folder / "web").symlink_to(WEB)
    (copy / "node_modules").mkdir()
    found = {name: WEB / "node_modules" / name for name in ("three", "esbuild")}
    for name, path in (found | {name: package(name) for name in packages}).items():
        (copy / "node_modules" / name).symlink_to(path)
    page = folder / "page"
    environment = os.environ | {"PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
    command = ["node", str(copy / "build.mjs"), str(page), *map(str, arguments)]
    outcome = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert outcome.returncode == 0, outcome.stderr
    assert outcome.stdout.endswith(f"open {page / 'index.html'}\n")
    return page


def pixel(page: Any, place: tuple[int, int]) -> tuple[int, ...]:
    """Colour of a screenshot."""
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    colour = Image.open(io.BytesIO(page.screenshot())).convert("RGB").getpixel(place)
    assert isinstance(colour, tuple)
    return colour


@pytest.mark.slow
def test_counties_are_coloured_anew_hovered_and_picked(
    tmp_path: Path, chromium: Any, open_page: Callable[..., Any], screenshot: Callable[..., Path]
) -> None:
    topology = tmp_path / "topology.json"
    topology.write_text(json.dumps(four_counties()), encoding="utf-8")
    west, east = (240, 300), (400, 180)
    with serve_folder(built(tmp_path, topology)) as address:
        page = open_page(f"{address}/index.html", SIZE, reduced_motion="reduce")
        page.wait_for_function("window.counties")
        assert page.locator("#play").text_content() == "Play"
        before = [pixel(page, place) for place in (west, east)]
        page.evaluate("counties.state.seconds = 2; counties.recolor()")
        after = [pixel(page, place) for place in (west, east)]
        assert np.abs(np.subtract(before, after)).max(axis=1).min() > 8
        page.mouse.move(*west)
        assert np.abs(np.subtract(pixel(page, west), PAINTED[0])).max() <= 1
        assert page.locator("#label").text_content().startswith("County 1, West: ")
        page.mouse.click(*east)
        page.mouse.move(5, 240)
        assert np.abs(np.subtract([pixel(page, west), pixel(page, east)], [after[0], PAINTED[1]])).max() <= 1
        assert page.locator("#label").is_hidden()
        assert page.locator("#picked strong").text_content() == "County 2, East"
        screenshot(page)
        page.locator("#play").click()
        page.wait_for_function("counties.state.seconds > 2")


@pytest.mark.slow  # converts all counties of us-atlas
def test_all_counties(tmp_path: Path, chromium: Any, open_page: Callable[..., Any]) -> None:
    with serve_folder(built(tmp_path, packages=("topojson-client", "us-atlas"))) as address:
        page = open_page(f"{address}/index.html", SIZE, reduced_motion="reduce")
        page.wait_for_function("window.counties")
        assert page.evaluate("counties.texture.roots[0].style.elements.length") == 3139
        page.mouse.move(320, 232)
        page.wait_for_function("document.querySelector('#label').textContent.includes(', Kansas: ')")
