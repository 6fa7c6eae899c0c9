"""The page of the layer for MapLibre, and what its tests look at."""

import base64
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tile_pyramid
from numpy.typing import NDArray

from chromium import WEB, bundle

PAGE = Path(__file__).parent / "pages" / "maplibre.js"
SIZE = (256, 256)
CENTRE = tile_pyramid.meeting()
"""Of most views, in Web Mercator of 0..1."""

MIDDLE = (CENTRE[0] + 0.01, CENTRE[1] + 0.02)
"""A place in a cell."""

HTML = """<!doctype html><link rel="icon" href="data:,"><link rel="stylesheet" href="maplibre-gl.css">
<style>html, body, #map { margin: 0; width: 100%; height: 100% }</style><div id="map"></div>
<script type="module">import * as maplibregl from './maplibre-gl.mjs'; import './page.js';
window.start = (...given) => open_(maplibregl, ...given); window.loaded = true;</script>"""

FLOOR = """<!doctype html><link rel="icon" href="data:,"><link rel="stylesheet" href="floor/maplibre-gl.css">
<style>html, body, #map { margin: 0; width: 100%; height: 100% }</style><div id="map"></div>
<script src="floor/maplibre-gl.js"></script><script type="module">import './page.js';
window.start = (...given) => open_(maplibregl, ...given); window.loaded = true;</script>"""
"""The oldest MapLibre that the package promises to work with."""

MAGENTA = {"version": 8, "sources": {}, "layers": [
    {"id": "ground", "type": "background", "paint": {"background-color": "#ff00ff"}},
]}  # fmt: skip
"""A style whose ground shows in no cell's colour."""

MARKED = {
    "version": 8,
    "sources": {"middle": {"type": "geojson", "data": {"type": "Point", "coordinates": tile_pyramid.lng_lat(*MIDDLE)}}},
    "layers": [
        *MAGENTA["layers"],
        {"id": "mark", "type": "circle", "source": "middle", "paint": {"circle-radius": 20, "circle-color": "#000000"}},
    ],
}


def write_page(folder: Path, tiles: Path) -> None:
    """Write the page, for the newest MapLibre and for the oldest, beside the tiles."""
    library = WEB / "node_modules" / "maplibre-gl" / "dist"
    if not library.is_dir():
        pytest.skip("the packages of web/ are not installed (npm ci --prefix web)")
    for name in ("tiles.json", "map.pmtiles", *map(str, tile_pyramid.ZOOMS)):
        (folder / name).symlink_to(tiles / name)
    tile_pyramid.write_land(folder / "land")
    tile_pyramid.write_land(folder / "band", 85.0)
    bundle(PAGE, folder / "page.js")
    for file in library.iterdir():
        (folder / file.name).symlink_to(file)
    (folder / "floor").symlink_to(WEB / "node_modules" / "maplibre-gl-floor" / "dist")
    (folder / "page.html").write_text(HTML, encoding="utf-8")
    (folder / "floor.html").write_text(FLOOR, encoding="utf-8")


def pixels(page: Any) -> NDArray[np.float64]:
    """RGB of a map, 0..1, top row first."""
    shot = page.evaluate("pixels()")
    data = np.frombuffer(base64.b64decode(shot["data"]), np.uint8).reshape(shot["height"], shot["width"], 4)
    return data[::-1, :, :3] / 255.0
