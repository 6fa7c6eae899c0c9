"""The layer for MapLibre: its pixels, what it loads and keeps, colours, picking."""

import base64
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tile_pyramid
from browser import WEB, bundle
from numpy.typing import NDArray

from vexture.renderers.exact import render_exact_colours

PAGE = Path(__file__).parent / "pages" / "maplibre.js"
SIZE = (256, 256)
CENTRE = (0.47, 0.44)
"""Of most views, in Web Mercator of 0..1."""

HTML = """<!doctype html><link rel="icon" href="data:,"><link rel="stylesheet" href="maplibre-gl.css">
<style>html, body, #map { margin: 0; width: 100%; height: 100% }</style><div id="map"></div>
<script type="module">import * as maplibregl from './maplibre-gl.mjs'; import './page.js';
window.start = (...given) => open_(maplibregl, ...given); window.loaded = true;</script>"""


@pytest.fixture(scope="module")
def address(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    library = WEB / "node_modules" / "maplibre-gl" / "dist"
    if not library.is_dir():
        pytest.skip("the packages of web/ are not installed (npm ci --prefix web)")
    folder = tmp_path_factory.mktemp("maplibre")
    tile_pyramid.write(folder)
    bundle(PAGE, folder / "page.js")
    for file in library.iterdir():
        (folder / file.name).symlink_to(file)
    (folder / "page.html").write_text(HTML, encoding="utf-8")
    with tile_pyramid.served(folder) as url:
        yield url


@pytest.fixture
def opened(address: str, open_page: Callable[..., Any]) -> Callable[..., Any]:
    def opener(view: dict[str, Any], layer: dict[str, Any] | None = None, size: Any = SIZE, **options: Any) -> Any:
        page = open_page(f"{address}/page.html", size, **options)
        page.wait_for_function("window.loaded")
        view = {"center": tile_pyramid.lng_lat(*CENTRE), **view}
        page.evaluate("async ([view, layer]) => { await start(view, layer) }", [view, layer or {}])
        return page

    return opener


def _pixels(page: Any) -> NDArray[np.float64]:
    shot = page.evaluate("pixels()")
    data = np.frombuffer(base64.b64decode(shot["data"]), np.uint8).reshape(shot["height"], shot["width"], 4)
    return data[::-1, :, :3] / 255.0


def _exact(zoom: float, colours: Any = tile_pyramid.colour) -> NDArray[np.float64]:
    """The exact picture of a view from above, on white."""
    side = SIZE[0] / (512 * 2**zoom)
    seen = tile_pyramid.drawing((CENTRE[0] - side / 2, CENTRE[1] - side / 2), side, colours)
    picture = render_exact_colours(seen, size=SIZE[0])
    return np.asarray(picture[..., :3] + 1 - picture[..., 3:])


def _edges(one: NDArray[np.float64], other: NDArray[np.float64], truth: NDArray[np.float64]) -> float:
    """Mean difference along edges, in steps of a byte."""
    flat = (np.abs(truth[..., None, :] - np.array([*tile_pyramid.COLOURS, (1, 1, 1)])).max(axis=-1) < 1e-6).any(axis=-1)
    return float(255 * np.abs(one - other)[~flat].mean())


@pytest.mark.parametrize("zoom", [2.0, 4.0, 6.3, 8.0])
def test_a_flat_map_is_the_exact_one(zoom: float, opened: Callable[..., Any]) -> None:
    page = opened({"zoom": zoom})
    truth = _exact(zoom)
    assert _edges(_pixels(page), truth, truth) < 0.5
    assert {one["tile"]["z"] for one in page.evaluate("tiles.stats.shown")} == {min(4, int(zoom) // 2 * 2)}
