"""Take the pictures of the pages: `python tools/make_screenshots.py` writes those of MAKERS, or some by their names.

Needs Chromium and the built pages (`make viewer counties`): they are exported and looked at as a person would. Those of
two guides are what their tests saw last (`pytest tests/web/test_guide_three.py tests/web/test_guide_text.py`). The
pictures go into docs/pictures/.
"""

import io
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

from PIL import Image

ROOT: Final = Path(__file__).resolve().parents[1]
NEEDED: Final = ("packages/vexture-evidence/benchmarks", "examples", "tests", "tests/web")
sys.path[:0] = [str(ROOT / folder) for folder in NEEDED]

from four_floods.make_floods import SCENES, write  # noqa: E402
from jupyter_lab import OpenNotebook, jupyter_lab, write_notebook  # noqa: E402
from santa_cruz.make_flood import make_flood  # noqa: E402

from chromium import chromium  # noqa: E402 - the browser of the tests
from guides import blocks_of  # noqa: E402 - as the tests read them
from vexture.pages.view import export  # noqa: E402
from vexture.server.publish_file import VIEWER_PARAMETERS  # noqa: E402
from vexture_geo.flood.options import FloodOptions  # noqa: E402
from vexture_geo.flood.server import export as export_flood  # noqa: E402

SHAPES: Final = ROOT / "examples" / "shapes"
PICTURES: Final = ROOT / "docs" / "pictures"
SIZE: Final = (1080, 700)
SHOWN: Final = 700
"""Pixels that a screenshot is wide in the picture."""

GAP: Final = 12
NOTEBOOK_SIZE: Final = {"width": 860, "height": 950}
SETTLED: Final = 1000
"""Milliseconds until a notebook's messages have gone and the last frame is drawn."""

LOOKS: Final[tuple[dict[str, Any], ...]] = (
    {"shape": "duck", "overlays": {"cells": True, "coverage": True, "depth": False, "cutoff": 0}},
    {"shape": "duck", "compare": "raster", "center": [0.886, 0.668], "zoom": 14, "split": 0.5},
    {"shape": "cake", "mode": "sphere", "theme": "dark", "background": "theme", "yaw": -0.5, "pitch": 0.35},
    {"shape": "ocean", "mode": "plane", "yaw": 0.0, "pitch": -1.0, "distance": 1.2},
)


def looks(page: Any) -> list[Image.Image]:
    """One screenshot of each view."""
    taken = []
    for look in LOOKS:
        page.evaluate(
            """async ({overlays, ...look}) => {
                const {state, engine} = window.vexture.viewer;
                const start = {compare: null, mode: 'flat', theme: 'light', background: 'white'};
                const home = {center: [0.5, 0.5], zoom: 1, distance: 1};
                state.updateOverlays({cells: false, coverage: false, ...overlays});
                state.update({...start, ...home, ...look});
                engine.requestFrame();
            }""",
            {"overlays": {}, **look},
        )
        page.wait_for_timeout(3000)
        picture = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
        taken.append(picture.resize((SHOWN, SHOWN * SIZE[1] // SIZE[0]), Image.Resampling.LANCZOS))
    return taken


FLOOD_LOOKS: Final = (("Overview", 4, ""), ("Coast", 16, "?bare"), ("Shore", 16, "?bare"), ("Beach", 0, "?bare"))
"""View, step, and what stands behind the address: the panels are seen once."""


def flood_looks(browser: Any, address: str) -> list[Image.Image]:
    """One screenshot of each view of a flood."""
    taken = []
    for preset, step, bare in FLOOD_LOOKS:
        page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]}, color_scheme="light")
        page.goto(address + bare)
        page.evaluate("window.vexture.flood.ready")
        page.evaluate(
            "async ([preset, step]) => { const {view, freeze, step: go} = window.vexture.flood;"
            " await go(step); view(preset, {fly: false}); freeze(3); }",
            [preset, step],
        )
        page.wait_for_timeout(1500)
        picture = Image.open(io.BytesIO(page.screenshot(timeout=120_000))).convert("RGB")
        taken.append(picture.resize((SHOWN, SHOWN * SIZE[1] // SIZE[0]), Image.Resampling.LANCZOS))
        page.close()
    return taken


FOUR_LOOKS: Final = {
    "coast": ("Flooded land", 6, "water"),
    "river": ("Riverside", 6, "water"),
    "polder": ("Overview", 6, "arrival"),
    "streets": ("Town", 5, "depth"),
}
"""Of each synthetic flood: the view, the step and the colours."""


def flood_kinds(browser: Any, folder: Path) -> list[Image.Image]:
    """One picture of each kind of flood, as the page itself writes it."""
    taken = []
    for make in SCENES:
        depths = write(make(), folder)
        target = depths.with_suffix(".html")
        export_flood(FloodOptions(depths, time_dim="time"), target, None, print, iter)
        view, step, colours = FOUR_LOOKS[depths.stem]
        page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]}, color_scheme="light")
        page.goto(f"{target.as_uri()}#step={step + 1}&view={view}&colours={colours}")
        page.evaluate("window.vexture.flood.ready")
        page.evaluate("window.vexture.flood.freeze(3)")
        page.wait_for_timeout(2500)
        with page.expect_download(timeout=120_000) as download:
            page.get_by_role("button", name="Picture").click()
        with Image.open(download.value.path()) as picture:
            taken.append(picture.convert("RGB").resize((SHOWN, SHOWN * SIZE[1] // SIZE[0]), Image.Resampling.LANCZOS))
        page.close()
    return taken


def sheet_of(pictures: list[Image.Image]) -> Image.Image:
    """Pictures, two in a row."""
    width, height = pictures[0].size
    sheet = Image.new("RGB", (2 * width + GAP, len(pictures) // 2 * (height + GAP) - GAP), "#ffffff")
    for place, picture in enumerate(pictures):
        sheet.paste(picture, (place % 2 * (width + GAP), place // 2 * (height + GAP)))
    return sheet


GUIDE: Final = ROOT / "tests" / "web" / "screenshots"
GUIDE_LOOKS: Final = ("colours-1", "lit-materials-masks-1", "lit-materials-masks-2", "atlas-and-instances-1")
"""How the names of its screenshots end."""


def row_of_guide() -> Image.Image:
    """The guide's pages, side by side."""
    taken = []
    for look in GUIDE_LOOKS:
        (path,) = GUIDE.glob(f"test_the_guide_to_three_js*{look}.png")
        with Image.open(path) as picture:
            taken.append(picture.convert("RGB").resize((SHOWN // 2, SHOWN // 2), Image.Resampling.LANCZOS))
    row = Image.new("RGB", (len(taken) * (SHOWN // 2 + GAP) - GAP, SHOWN // 2), "#ffffff")
    for place, picture in enumerate(taken):
        row.paste(picture, (place * (SHOWN // 2 + GAP), 0))
    return row


COUNTIES: Final = ROOT / "demo" / "counties" / "index.html"


def county_looks(browser: Any) -> list[Image.Image]:
    """All counties with one picked, and some from nearby with one under the pointer."""
    page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]}, reduced_motion="reduce")
    page.goto(COUNTIES.as_uri())
    page.wait_for_function("window.counties")
    page.evaluate("counties.state.seconds = 2; counties.recolor()")
    page.mouse.click(430, 360)
    page.mouse.move(520, 300)
    taken = []
    for distance in (None, 0.5):
        if distance:
            page.evaluate(
                "distance => { const {camera, controls} = counties; controls.target.set(0.35, 0.02, -0.03);"
                " camera.position.set(0.35, 0.02 - 0.5 * distance, 0.87 * distance); controls.update(); }",
                distance,
            )
        page.wait_for_timeout(2000)
        picture = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
        taken.append(picture.resize((SHOWN, SHOWN * SIZE[1] // SIZE[0]), Image.Resampling.LANCZOS))
    page.close()
    return taken


def viewer(browser: Any, folder: Path) -> Image.Image:
    """The page of `vexture view`."""
    target = folder / "page.html"
    export([SHAPES / f"{name}.svg" for name in ("duck", "cake", "ocean")], target, None, VIEWER_PARAMETERS, print)
    page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]}, color_scheme="light")
    page.goto(target.as_uri())
    page.wait_for_function("() => window.vexture?.viewer?.engine?.drawing")
    taken = looks(page)
    page.close()
    return sheet_of(taken)


def flood(browser: Any, folder: Path) -> Image.Image:
    """The page of `vexture flood`."""
    depths, ground = make_flood(folder)
    target = folder / "flood.html"
    export_flood(FloodOptions(depths, time_dim="time", ground=ground, title="Santa Cruz"), target, None, print, iter)
    return sheet_of(flood_looks(browser, target.as_uri()))


def notebook(browser: Any, folder: Path) -> Image.Image:
    """Cells of the guide in JupyterLab, with a click on the pier."""
    (drawing,) = (block for block in blocks_of("notebooks") if block.title)
    (folder / str(drawing.title)).write_text(drawing.text)
    texts = {block.section: block.text.strip() for block in blocks_of("notebooks") if block.language == "python"}
    first, linked = texts["Show"], texts["Linked views"]
    write_notebook(folder / "harbour.ipynb", (first, linked, "chart.picked"))
    page = browser.new_context(viewport=NOTEBOOK_SIZE).new_page()
    with jupyter_lab(folder, "harbour.ipynb") as address:
        opened = OpenNotebook(page, address)
        page.evaluate("jupyterapp.shell.collapseLeft()")
        chart = opened.run(0).locator(".vexture-stage canvas")
        opened.run(1).locator(".vexture-stage canvas").wait_for()
        opened.value("setattr(chart, 'view', (0.25, 0.25, 0.5, 0.4))")
        chart.click(position={"x": 350, "y": 110})
        opened.until("chart.picked")
        opened.run(2)
        page.wait_for_timeout(SETTLED)
        picture = page.screenshot()
        page.context.close()
    return Image.open(io.BytesIO(picture)).convert("RGB").quantize(256)


MAKERS: Final[dict[str, Callable[[Any, Path], Image.Image]]] = {
    "guide.png": lambda browser, folder: row_of_guide(),
    "text.png": lambda browser, folder: Image.open(GUIDE / "test_the_guide_to_texts_does_what_it_says.png"),
    "viewer.png": viewer,
    "flood.jpg": flood,
    "floods.jpg": lambda browser, folder: sheet_of(flood_kinds(browser, folder)),
    "notebook.png": notebook,
    "counties.jpg": lambda browser, folder: sheet_of(county_looks(browser)),
}


def main() -> None:
    """Take the pictures that are asked for."""
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        for name in sys.argv[1:] or MAKERS:
            MAKERS[name](browser, Path(folder)).save(PICTURES / name, quality=86, optimize=True)


if __name__ == "__main__":
    main()
