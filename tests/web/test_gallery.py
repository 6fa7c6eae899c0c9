"""The gallery, opened from the disk: each example runs, shows what it should, and can be changed."""

import io
import json
import runpy
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

import vexture
from chromium import ROOT, WEB
from vexture.base.errors import VextureError

sys.path.append(str(ROOT / "tools"))

import gallery_data
import gallery_pages

EXAMPLES = {one.name: one for one in gallery_pages.examples()}
RUNNING = [name for name, one in EXAMPLES.items() if one.libraries]
SIZE = (640, 400)
RAN = "document.documentElement.dataset.state !== 'starting'"

FLAT = """
import * as THREE from 'three';
import { VectorMaterial, VectorTextureLoader } from 'vexture';
const renderer = new THREE.WebGLRenderer({ antialias: false });
renderer.setSize(200, 200);
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color('white');
const texture = await new VectorTextureLoader().loadAsync('logo.ktx2');
const material = new VectorMaterial({ texture, mode: 'paint' });
scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material));
renderer.render(scene, new THREE.OrthographicCamera(-1, 1, 1, -1, -1, 1));
"""

IMPORTED = "import { VectorMaterial } from 'vexture';"
NO_OPTION = 'VextureError: VectorMaterial has no option "colour"; correct its name'


@pytest.fixture(scope="session")
def gallery(made_once: Callable[..., Path]) -> Path:
    """The site, quickly built: few icons, one state, no pictures; the flood's page has tests of its own."""
    if not (WEB / "node_modules" / "three").is_dir():
        pytest.skip("the packages of web/ are not installed (npm ci --prefix web)")
    tool = runpy.run_path(str(ROOT / "tools" / "make_gallery.py"))

    def fill(folder: Path) -> None:
        try:
            tool["build"](folder, quick=True, only=tuple(RUNNING), pictures=False)
        except VextureError as error:
            pytest.skip(str(error))

    return made_once("gallery", fill)


@pytest.fixture
def run(gallery: Path, open_page: Callable[..., Any]) -> Callable[..., Any]:
    """Open the page of an example, and wait until it has run."""

    def opened(name: str, size: tuple[int, int] = SIZE, **options: Any) -> Any:
        options = {"reduced_motion": "reduce"} | options
        page = open_page((gallery / name / "index.html").as_uri(), size, **options)
        page.wait_for_function(RAN)
        return page

    return opened


def edit(page: Any, source: str) -> None:
    """Run another source, as a user does."""
    if page.locator("#code[open]").count() == 0:
        page.click("summary")
    page.fill("#editor", source)
    page.click("#run")
    page.wait_for_function(RAN)


def pixels(page: Any) -> NDArray[np.float64]:
    """The picture of an example, 0..255."""
    return np.array(Image.open(io.BytesIO(page.locator("#stage").screenshot())).convert("RGB"), np.float64)


def share(picture: NDArray[np.float64], colour: tuple[int, int, int], within: float) -> float:
    """The part of a picture that has a colour, or nearly."""
    return float((np.abs(picture - colour).max(axis=2) <= within).mean())


# each part of a picture that an example must show: colour, how near, least share
SEEN: dict[str, tuple[tuple[int, int, int], float, float]] = {
    "logo": ((0x12, 0x3A, 0x5C), 45, 0.01),
    "icons": ((0x14, 0x1D, 0x27), 10, 0.1),
    "decals": ((0xE8, 0xB1, 0x00), 70, 0.01),
    "road": ((250, 250, 240), 20, 0.01),
    "chat": ((0xFF, 0xFF, 0xFF), 25, 0.004),
    "hud": ((0xFF, 0xD7, 0x5E), 6, 0.004),
    "labels": ((0xFF, 0xD1, 0x66), 90, 0.001),
    "sign": ((0xE4, 0xDC, 0xC7), 20, 0.006),
    "choropleth": ((0xFE, 0x99, 0x29), 4, 0.003),
    "time": ((0xDB, 0xE5, 0xEA), 4, 0.3),
    "globe": ((0x1F, 0x4A, 0x6B), 4, 0.1),
    "water": ((0x20, 0x60, 0x80), 50, 0.1),
    "sphere": ((0x1D, 0x5C, 0x86), 60, 0.05),
    "live": ((0xE8, 0xA2, 0x00), 50, 0.01),
    "zoom": ((0x2B, 0x7F, 0xB8), 4, 0.01),
    "react": ((0x12, 0x3A, 0x5C), 10, 0.003),
    "gltf": ((0x6F, 0x8A, 0x3C), 60, 0.0005),
}


QUICK = ("logo", "react", "gltf")
"""Whose pages show most of what can go wrong; the others draw for seconds without a graphics card."""


@pytest.mark.parametrize(
    "name", [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow) for name in SEEN]
)
def test_an_example_runs_from_the_disk(name: str, run: Callable[..., Any]) -> None:
    page = run(name)
    assert page.locator("#note").text_content() == ""
    assert page.evaluate("document.documentElement.dataset.state") == "ran"
    colour, within, least = SEEN[name]
    for _ in range(20):  # React draws when it has loaded, WebGPU when its programs are compiled
        picture = pixels(page)
        if share(picture, colour, within) >= least:
            break
        page.wait_for_timeout(100)
    assert share(picture, colour, within) >= least
    assert picture.std(axis=(0, 1)).max() > 5
    assert page.locator("#note").text_content() == ""
    wide = page.evaluate("document.documentElement.scrollWidth")
    assert wide <= SIZE[0]


@pytest.mark.slow
def test_webgpu_says_what_it_runs_on(run: Callable[..., Any]) -> None:
    page = run("webgpu")
    assert page.locator("#note").text_content() == ""
    assert page.evaluate("document.documentElement.dataset.state") == "ran"
    said = page.frames[1].get_by_role("status").text_content()
    assert said in ("This is WebGPU.", "There is no WebGPU here: this is WebGL 2.")


@pytest.mark.slow
def test_an_edited_source_is_run_and_is_the_truth(run: Callable[..., Any], gallery: Path) -> None:
    page = run("logo", (1280, 800))
    edit(page, FLAT)
    page.wait_for_timeout(100)
    seen = pixels(page)[1:201, :200]  # below the border of the header
    drawing = vexture.read(gallery_pages.GALLERY / "drawings" / "logo.svg")
    exact = vexture.render(drawing, size=200, renderer="exact")
    white = 255 * (exact[..., :3] + 1 - exact[..., 3:])
    assert np.abs(seen - white).mean() < 0.5
    assert np.abs(seen - white).max() < 12
    page.click("#reset")
    page.wait_for_function(RAN)
    assert page.input_value("#editor") == EXAMPLES["logo"].source
    assert page.is_disabled("#reset")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "source", "said"),
    [
        ("logo", "const a = 1;\nnothing.here();", "line 2: ReferenceError: nothing is not defined"),
        ("logo", "const a = 1;\nconst a = 2;", "line 2: SyntaxError: Identifier 'a' has already been declared"),
        ("logo", "\nawait Promise.reject(new Error('none'));", "line 2: Error: none"),
        ("logo", f"{IMPORTED}\nnew VectorMaterial({{ texture: null, colour: 'red' }});", f"line 2: {NO_OPTION}"),
        (
            "logo",
            f"{IMPORTED}\nsetTimeout(() => new VectorMaterial({{ texture: null, colour: 1 }}));",
            f"line 2: {NO_OPTION}",
        ),
        ("react", "const a = (\n  <b><i></b>\n);", "line 2: SyntaxError: <i> ends as </b>"),
    ],
)
def test_an_error_is_shown_in_one_line(run: Callable[..., Any], name: str, source: str, said: str) -> None:
    page = run(name, errors=True)
    edit(page, source)
    page.wait_for_selector("#note:not([hidden])")
    assert page.locator("#note").text_content() == said


def test_controls_are_labelled_and_reached_by_the_keyboard(run: Callable[..., Any]) -> None:
    page = run("logo", (390, 844))
    frame = page.frames[1]
    size = frame.get_by_role("slider", name="Size", exact=True)
    before, shown = pixels(page), size.get_attribute("aria-valuetext")
    size.focus()
    size.press("Home")
    assert size.input_value() == "0.3"
    assert size.get_attribute("aria-valuetext") == frame.locator(".value").first.text_content() != shown
    page.wait_for_timeout(200)
    assert (np.abs(pixels(page) - before).max(axis=2) > 20).mean() > 0.01
    for kind, label in (("checkbox", "All around"), ("checkbox", "Turn")):
        assert frame.get_by_role(kind, name=label, exact=True).count() == 1
    heights = frame.eval_on_selector_all(".controls label", "all => all.map((one) => one.offsetHeight)")
    assert min(heights) >= 36  # a finger's
    panel, stage = frame.locator(".controls").bounding_box(), page.locator("#stage").bounding_box()
    assert panel["height"] < 0.4 * stage["height"]
    assert panel["x"] >= 0
    assert panel["x"] + panel["width"] <= 390


def test_counties_have_figures(gallery: Path) -> None:
    table = json.loads((gallery / "choropleth" / "figures.json").read_text(encoding="utf-8"))
    assert table["figures"] == ["Unemployment, 2009", *gallery_data.SPECIES]
    assert len(table["counties"]) == 58  # those of California
    assert table["counties"]["Imperial, California"][0] == 30.1  # the highest of 2009
    assert all(0 <= value <= 100 for values in table["counties"].values() for value in values)


@pytest.mark.slow
def test_a_choropleth_tells_the_county_under_the_pointer(run: Callable[..., Any], gallery: Path) -> None:
    page = run("choropleth", (1280, 800))
    frame = page.frames[1]
    box = page.locator("#stage").bounding_box()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 0.38 * box["height"])
    line = frame.get_by_role("status")
    frame.wait_for_function("document.querySelector('[role=status]').textContent.includes(', California: ')")
    page.wait_for_timeout(200)
    assert share(pixels(page), (0x2B, 0x7F, 0xFF), 8) > 0.001
    table = json.loads((gallery / "choropleth" / "figures.json").read_text(encoding="utf-8"))
    for place, figure in enumerate(table["figures"][:2]):
        frame.get_by_label("Of", exact=True).select_option(figure)
        page.mouse.move(box["x"] + 2, box["y"] + 2)
        frame.wait_for_function("document.querySelector('[role=status]').textContent === 'Point at a county'")
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 0.38 * box["height"])
        frame.wait_for_function("document.querySelector('[role=status]').textContent.includes(', California: ')")
        name, value = line.text_content().removesuffix(" %").split(": ")
        assert float(value) == table["counties"][name][place]
    assert frame.locator(".legend > span").count() == 7


def wander(page: Any, places: Iterable[tuple[float, float]], said: Callable[[], bool]) -> None:
    """Move the pointer over places of the stage, given as parts of its sides, until something is said."""
    box = page.locator("#stage").bounding_box()
    for _ in range(20):  # tiles may still be on their way
        for x, y in places:
            page.mouse.move(box["x"] + x * box["width"], box["y"] + y * box["height"])
            page.wait_for_timeout(100)
            if said():
                return
    raise AssertionError("nothing is said")


@pytest.mark.slow
@pytest.mark.long
def test_a_map_through_time_names_a_county_and_keeps_it(run: Callable[..., Any]) -> None:
    page = run("time", (1280, 800))
    frame = page.frames[1]

    def told() -> str:
        return str(frame.get_by_role("status").text_content())

    along = [(x, 0.37) for x in np.linspace(0.03, 0.2, 9).tolist()]
    wander(page, along, lambda: ", California: " in told())
    page.mouse.down()
    page.mouse.up()
    frame.wait_for_selector(".maplibregl-marker")
    wander(page, [(0.6, 0.1)], lambda: ", California: " in told())
    kept, before = told(), pixels(page)
    frame.get_by_label("Month", exact=True).evaluate(
        "(input) => { input.value = 60; input.dispatchEvent(new Event('input')); }"
    )
    frame.wait_for_function("document.querySelector('.value').textContent === 'Jan 2020'")
    page.wait_for_timeout(200)
    assert told().split(":")[0] == kept.split(":")[0] != told()
    changed = (np.abs(pixels(page) - before).max(axis=2) > 20)[: SIZE[1]]  # above the panel
    assert changed[:, : changed.shape[1] // 3].mean() > 0.005
    assert not changed[:, changed.shape[1] // 2 :].any()  # a quick build has California only
    box = page.locator("#stage").bounding_box()
    page.mouse.click(box["x"] + 0.6 * box["width"], box["y"] + 0.1 * box["height"])
    frame.wait_for_function("!document.querySelector('.maplibregl-marker')")
    assert told().startswith("Point at a county")
    assert page.locator("#note").text_content() == ""


@pytest.mark.slow
def test_a_globe_highlights_the_country_under_the_pointer(run: Callable[..., Any]) -> None:
    page = run("globe", (480, 480))
    frame = page.frames[1]
    red = ((0xFF, 0x5C, 0x4C), 4)
    nowhere = "Point at a country"
    for country, place in (("Libya", (0.5, 0.38)), (nowhere, (0.02, 0.02)), ("Libya", (0.5, 0.38))):
        wander(page, [place], lambda country=country: frame.get_by_role("status").text_content() == country)
        page.wait_for_timeout(200)
        assert (share(pixels(page), *red) > 0.002) is (country != nowhere)


def test_a_phone_shows_the_picture_first(run: Callable[..., Any]) -> None:
    page = run("logo", (390, 844))
    assert page.locator("#code[open]").count() == 0
    box = page.locator("#stage").bounding_box()
    assert box["width"] == 390
    assert box["y"] + box["height"] < 844
    assert page.evaluate("document.documentElement.scrollWidth") <= 390


def test_the_index_leads_to_all(gallery: Path, open_page: Callable[..., Any]) -> None:
    page = open_page((gallery / "index.html").as_uri(), (390, 844))
    links = page.eval_on_selector_all(".card", "cards => cards.map((card) => card.getAttribute('href'))")
    assert links == [f"{name}/index.html" for name in RUNNING]
    assert page.evaluate("[...document.images].every((one) => one.loading === 'lazy')")
    assert all((gallery / name / "thumbnail.jpg").is_file() for name in RUNNING)
    assert page.evaluate("document.documentElement.scrollWidth") <= 390


def test_icons_are_compared_with_another_projects(gallery: Path) -> None:
    text = (gallery / "icons" / "index.html").read_text(encoding="utf-8")
    count = len(vexture.load(gallery / "icons" / "lucide.ktx2").roots)
    assert f"{count:,} icons of Lucide in one texture" in text
    assert "1,594 in 3 MiB, 998 kB compressed" in text
