"""The playground, opened from the disk: what it shows, refuses, gives away, and that it asks no network."""

import io
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from waiting import drawn

import vexture
from chromium import ROOT, WEB

SHAPES = '<path fill="#f00" d="M1 1h5v5z"/><path fill="#00f" d="M4 4h4v4z"/>'
STAR = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">{SHAPES}</svg>'
ISLAND = '{"type": "Polygon", "coordinates": [[[8, 47], [9, 47], [9, 48], [8, 47]]]}'
FONT = WEB / "node_modules" / "@fontsource" / "pacifico" / "files" / "pacifico-latin-400-normal.woff"

DROP = """([content, name]) => {
  const data = new DataTransfer();
  data.items.add(new File([content], name));
  document.body.dispatchEvent(new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer: data }));
}"""


@pytest.fixture(scope="module")
def playground(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page as the gallery has it, in one file."""
    file = tmp_path_factory.mktemp("playground") / "a b" / "playground.html"
    command = [sys.executable, str(ROOT / "tools" / "make_playground.py"), str(file)]
    outcome = subprocess.run(command, capture_output=True, text=True, check=False)
    if "make wasm" in outcome.stderr or "npm" in outcome.stderr:
        pytest.skip(outcome.stderr.strip().splitlines()[-1])
    assert outcome.returncode == 0, outcome.stderr
    return file


def settle(page: Any) -> dict[str, Any]:
    """Wait until the page has shown what it was given, or has refused it."""
    page.wait_for_function("document.documentElement.dataset.state !== 'busy'")
    drawn(page)
    found: dict[str, Any] = page.evaluate(
        "() => ({ state: document.documentElement.dataset.state, error: document.querySelector('#error').textContent,"
        " facts: document.querySelector('#facts').innerText, code: document.querySelector('#code').textContent })"
    )
    return found


def picture(page: Any) -> np.ndarray:
    """Pixels of the stage."""
    content = page.locator("#canvas").screenshot()
    return np.asarray(Image.open(io.BytesIO(content)).convert("RGB")).astype(int)


def change(one: np.ndarray, other: np.ndarray) -> float:
    """Share of the pixels that differ."""
    return float((np.abs(one - other).max(axis=2) > 8).mean())


def downloaded(page: Any) -> tuple[str, vexture.Texture]:
    """Name and texture of the file that the page gives away."""
    with page.expect_download() as waiting:
        page.click("#download")
    file = waiting.value
    texture = vexture.load(file.path())
    texture.check()
    return file.suggested_filename, texture


@pytest.mark.parametrize(
    "size", [pytest.param((1280, 900), id="screen", marks=pytest.mark.slow), pytest.param((390, 844), id="phone")]
)
def test_the_playground_works_from_the_disk(
    playground: Path, open_page: Callable[..., Any], screenshot: Callable[..., Path], size: tuple[int, int]
) -> None:
    page = open_page("about:blank", size, reduced_motion="reduce")
    urls: list[str] = []
    page.on("request", lambda request: urls.append(request.url))
    page.goto(playground.as_uri())
    first = settle(page)
    assert (first["state"], first["error"]) == ("shown", "")
    assert "the vector texture, .ktx2" in first["facts"]
    assert "Balloon.ktx2" in first["code"]
    assert page.evaluate("document.documentElement.scrollWidth") <= size[0]
    screenshot(page, f"{size[0]}")
    balloon = picture(page)
    assert len(np.unique(balloon.reshape(-1, 3), axis=0)) > 20
    sees_keys(page)
    if size[0] > 1000:
        sees_drawings(page, balloon)
        sees_code(page)
    sees_wrong_texts(page)
    assert [url for url in urls if not url.startswith(("file:", "blob:", "data:"))] == []
    assert [url for url in urls if url.startswith("file:")] == [playground.as_uri()]


def sees_keys(page: Any) -> None:
    """Keys zoom and move the magnifier, and back."""
    before = picture(page)
    page.focus("#canvas")
    for key, back in (("+", "-"), ("ArrowLeft", "ArrowRight"), ("ArrowUp", "ArrowDown")):
        page.keyboard.press(key)
        drawn(page)
        assert change(before, picture(page)) > 0.002, key
        page.keyboard.press(back)
        drawn(page)
        assert change(before, picture(page)) < 0.002, back


def sees_drawings(page: Any, before: np.ndarray) -> None:
    """A dropped SVG, a word, a font, and a map are shown, and given away as textures."""
    page.evaluate(DROP, [STAR, "a star.svg"])
    found = settle(page)
    assert found["state"] == "shown", found
    assert change(before, picture(page)) > 0.1
    name, texture = downloaded(page)
    assert name == "a star.ktx2"
    assert [(root.name, root.is_map) for root in texture.roots] == [("a star", True)]
    page.fill("#word", "Sea")
    assert settle(page)["state"] == "shown"
    name, texture = downloaded(page)
    assert (name, [root.is_map for root in texture.roots]) == ("Sea.ktx2", [False])
    page.set_input_files("#file", FONT)
    assert settle(page)["state"] == "shown"
    page.evaluate("document.querySelector('details').open = true")
    page.fill("#text", ISLAND)
    found = settle(page)
    assert found["state"] == "shown", found
    name, texture = downloaded(page)
    assert (name, len(texture.roots)) == ("pasted.ktx2", 1)
    for sample in page.locator("#samples button").all():
        sample.click()
        found = settle(page)
        assert found["state"] == "shown", found


def sees_wrong_texts(page: Any) -> None:
    """Each wrong text is one line; what was shown stays, and the next drawing is shown."""
    page.evaluate("document.querySelector('details').open = true")
    facts = settle(page)["facts"]
    for text in ("nothing", "<svg", "{", '{"type": "Polygon", "coordinates": []}', "<p>text</p>"):
        page.fill("#text", text)
        found = settle(page)
        assert (found["state"], page.is_visible("#error")) == ("error", True), text
        assert found["error"].strip(), text
        assert "\n" not in found["error"], text
    page.evaluate(DROP, ["no font", "no.ttf"])
    assert settle(page)["error"].startswith("no.ttf: it cannot be read as a font")
    page.fill("#word", "\u200b\u200b")
    assert settle(page)["error"].startswith("the font has no outlines for")
    assert settle(page)["facts"] == facts
    page.fill("#text", STAR)
    found = settle(page)
    assert (found["state"], page.is_visible("#error")) == ("shown", False), found


def sees_code(page: Any) -> None:
    """Each tab has its own code, for the file that is shown."""
    texts = []
    for tab in range(page.locator("#tabs [role=tab]").count()):
        page.locator("#tabs [role=tab]").nth(tab).click()
        assert page.locator("#tabs [role=tab][aria-selected=true]").count() == 1
        assert page.locator("#tabs [role=tab]").nth(tab).get_attribute("aria-selected") == "true"
        texts.append(page.text_content("#code"))
    assert len({*texts}) == len(texts) == 4
    assert all("/World.ktx2" in text for text in texts[:3])
