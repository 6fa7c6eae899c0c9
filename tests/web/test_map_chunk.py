"""A page of several files loads what planar maps need with the first texture that holds one."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import vexture
from chromium import bundle, serve_folder
from vexture.drawing.drawing import Drawing

PAGE = Path(__file__).parent / "pages" / "map_chunk.js"
CHUNK = "**/map-parts-*.js"
MAP = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">
  <rect id="sea" width="10" height="10" fill="#0000ff"/>
  <circle id="island" cx="5" cy="5" r="3" fill="#00ff00"/>
</svg>"""


@pytest.fixture(scope="module")
def address(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("chunks")
    vexture.convert(Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)])).save(folder / "plain.ktx2")
    (folder / "map.svg").write_text(MAP, encoding="utf-8")
    vexture.convert(folder / "map.svg", split="faces", restyle=True).save(folder / "map.ktx2")
    bundle(PAGE, folder / "page.js", is_split=True)
    text = '<!doctype html><link rel="icon" href="data:,"><body><script type="module" src="page.js"></script>'
    (folder / "page.html").write_text(text, encoding="utf-8")
    with serve_folder(folder) as url:
        yield url


def _show(page: Any, *arguments: Any) -> Any:
    return page.evaluate("async (given) => show(...given)", arguments)


def test_a_map_brings_its_module_before_it_is_handed_out(address: str, open_page: Callable[..., Any]) -> None:
    page = open_page(f"{address}/page.html")
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url.rsplit("/", 1)[1].split("-")[0]))
    shown = _show(page, "plain.ktx2")
    assert asked == ["plain.ktx2"]
    assert shown == {"pixel": [0, 0, 0, 255], "contains": True, "color": [0, 0, 0], "element": None}
    shown = _show(page, "map.ktx2", {"island": "#ff0000"})
    assert asked == ["plain.ktx2", "map.ktx2", "map", "planar"]
    assert shown == {"pixel": [255, 0, 0, 255], "contains": True, "color": [1, 0, 0], "element": "island"}


def test_a_module_that_cannot_be_had_is_an_error_of_one_line(address: str, open_page: Callable[..., Any]) -> None:
    page = open_page(f"{address}/page.html", errors=True)
    page.route(CHUNK, lambda route: route.abort())
    refused = _show(page, "map.ktx2")
    assert refused.startswith("VextureError map.ktx2: the module for planar maps cannot be loaded (")
    assert "\n" not in refused
    assert _show(page, "plain.ktx2")["contains"]
    page.unroute(CHUNK)
    assert _show(page, "map.ktx2")["pixel"] == [0, 255, 0, 255]
