"""The component of texts for React Three Fiber in a real browser."""

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import fontpkg_noto_sans
import numpy as np
import pytest
from numpy.typing import NDArray

from build_wasm import OUTPUT
from chromium import WEB, bundle, serve_folder

PAGES = Path(__file__).parent / "pages"
SANS = next(Path(fontpkg_noto_sans.__file__).parent.glob("files/NotoSans[[]*.ttf"))
SIZE = 200
WORD = {"words": "Hafen", "fontSize": 50}

Picture = NDArray[np.float64]


def prepare(folder: Path) -> None:
    bundle(PAGES / "react-text.jsx", folder / "page.js")
    bundle(WEB / "src" / "typeset" / "worker.js", folder / "worker.js")
    shutil.copy(WEB / "node_modules" / "harfbuzzjs" / "dist" / "harfbuzz.wasm", folder)
    shutil.copy(SANS, folder / "font.ttf")
    for name in ("silhouettes", "maps", "strokes"):
        shutil.copy(OUTPUT / f"{name}.wasm", folder)
    icon = '<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><body>'
    (folder / "index.html").write_text(f'{icon}<script type="module" src="page.js"></script>', encoding="utf-8")


@pytest.fixture(scope="module")
def address(chromium: Any, made_once: Callable[..., Path]) -> Iterator[str]:
    with serve_folder(made_once("react-text", prepare)) as url:
        yield url


@pytest.fixture
def page(address: str, open_page: Callable[..., Any]) -> Any:
    opened = open_page(f"{address}/index.html", (SIZE, SIZE), keep=True)
    opened.evaluate("page.ready()")
    if opened.evaluate("page.held().children") > 1:
        draw(opened, changed=False)
    return opened


def draw(page: Any, *items: dict[str, Any], changed: bool = True) -> Picture:
    """Show some texts and nothing else."""
    found = page.evaluate("([items, changed]) => page.draw(items, changed)", [list(items), changed])
    return np.array(found, float).reshape(SIZE, SIZE, 4)[..., :3] / 255


def ink(picture: Picture) -> tuple[float, float, float, float]:
    """Left, top, right and bottom of what is not white."""
    rows, columns = np.nonzero((picture < 0.5).any(2))
    return columns.min(), rows.min(), columns.max() + 1, rows.max() + 1


def test_its_middle_is_its_origin_unless_props_say_otherwise(page: Any, screenshot: Callable[..., Path]) -> None:
    left, top, right, bottom = ink(draw(page, WORD))
    screenshot(page.locator("canvas"))
    assert abs(left + right - SIZE) < 6
    assert right - left > 100
    assert bottom - top < 50
    moved = ink(draw(page, {**WORD, "anchorX": "left", "anchorY": "bottom"}))
    assert moved[0] - left == pytest.approx((right - left) / 2, abs=6)
    assert moved[1] < top
    assert ink(draw(page, WORD)) == (left, top, right, bottom), "a prop that is gone is the default again"


def test_children_are_its_text_and_every_prop_is_live(page: Any) -> None:
    black = draw(page, {**WORD, "words": ["7", 5]})
    assert page.evaluate("page.text()")["text"] == "75"
    assert page.evaluate("page.text()")["isText"] is True
    red = draw(page, {**WORD, "words": ["7", 5], "color": "#f00"}, changed=False)
    np.testing.assert_allclose(red[..., 1], black[..., 1], atol=0.005)
    assert np.all(red[..., 0] == 1)
    other = draw(page, {**WORD, "words": "7", "color": "#f00", "position": [30, 0, 0]})
    assert ink(other)[0] > ink(red)[0] + 30
    outlined = draw(page, {**WORD, "words": "7", "color": "#f00", "position": [30, 0, 0], "outlineWidth": "10%"})
    assert page.evaluate("page.text()")["outlineWidth"] == "10%"
    assert ink(outlined)[0] == pytest.approx(ink(other)[0] - 5, abs=1)


def test_an_element_of_a_material_is_its_material(page: Any) -> None:
    plain = draw(page, {**WORD, "color": None})
    assert plain.min() == 1, "white on white"
    green = draw(page, {**WORD, "color": None, "material": {"color": "#0f0"}}, changed=False)
    assert page.evaluate("page.text()")["kind"] == "MeshLambertMaterial"
    assert ink(green)[2] > 150
    assert green[..., 1].min() == 1
    programs = page.evaluate("page.held().programs")
    red = draw(page, {**WORD, "color": None, "material": {"color": "#f00"}}, changed=False)
    np.testing.assert_allclose(red[..., 1], green[..., 0], atol=0.01)
    blue = np.array(page.evaluate("page.recolour('#00f')"), float).reshape(SIZE, SIZE, 4)[..., :3] / 255
    np.testing.assert_allclose(blue[..., 0], red[..., 1], atol=0.01)
    assert page.evaluate("page.held().programs") == programs
    faint = draw(page, {**WORD, "color": None, "material": {"color": "#00f", "opacity": 0.5}}, changed=False)
    assert faint.min() == pytest.approx(0.5, abs=0.01)
    assert draw(page, {**WORD, "color": None}, changed=False).min() == 1
    assert page.evaluate("page.text()")["kind"] == "MeshBasicMaterial"


def test_it_suspends_if_wanted(page: Any) -> None:
    before = page.evaluate("page.fallbacks()")
    draw(page, {**WORD, "words": "one", "name": "plain"})
    assert page.evaluate("page.fallbacks()") == before
    picture = draw(page, {**WORD, "words": "two", "name": "waiting", "suspend": True})
    assert page.evaluate("page.fallbacks()") == before + 1
    assert ink(picture)[2] > 120
    draw(page, {**WORD, "words": "three", "name": "waiting", "suspend": True})
    assert page.evaluate("page.fallbacks()") == before + 1, "of the first text only"


def test_what_is_wrong_is_said(page: Any) -> None:
    draw(page, {**WORD, "font": "none.ttf", "name": "wrong"})
    page.errors.clear()
    (message,) = page.evaluate("page.errors.splice(0)")
    assert message


def test_it_frees_its_memory_and_meets_rays(page: Any) -> None:
    draw(page, changed=False)
    before = page.evaluate("page.held().geometries")
    draw(page, {**WORD, "name": "short-lived", "outlineWidth": "5%"})
    assert page.evaluate("page.text().isDisposed") is False, "strict mode ends and begins effects again"
    assert page.evaluate("page.held().geometries") == before + 2
    page.evaluate("page.clicks.length = 0")
    for x in (45, SIZE - 45):
        page.mouse.click(x, SIZE / 2 + 5)
    page.mouse.click(5, 5)
    assert len(page.evaluate("page.clicks")) == 2
    assert page.evaluate("page.clicks") == sorted(page.evaluate("page.clicks"))
    draw(page, changed=False)
    assert page.evaluate("page.held().geometries") == before
    assert page.evaluate("page.text().isDisposed") is True
