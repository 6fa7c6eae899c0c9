"""The viewer with a shape, as tests of its overlays look at it and handle it."""

import io
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from viewer_page import manifest, thesis_view, view_matrix, write_page

import vexture
from cells import Cells, finest_level
from chromium import ROOT
from vexture.base.notes import Note, Subject
from vexture.texture.texture import Texture

SHAPES = ROOT / "examples" / "shapes"
WINDOW = (800, 480)

NOTES = [
    Note(
        "left out", "filter of blur", 2, (Subject("bill", (0.1, 0.5, 0.3, 0.7)), Subject("eye", (0.25, 0.6, 0.3, 0.7)))
    ),
    Note("simplified", "gradient mesh", 1, (Subject("water", None),)),
    Note("remark", "it swims"),
]
FACTS = {"segments": 31, "bytes": 12345, "milliseconds": 8.25, "distance": 1e-5}
FACTS |= {"notes": [note.facts() for note in NOTES]}

BOAT = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><rect width="100" height="100" fill="#bfe3ff"/>
<circle cx="72" cy="28" r="15" fill="#ffd23f"/>
<path d="M0 80 C 20 50 40 50 60 75 S 90 70 100 60 V 100 H 0 Z" fill="#3a7d44"/>
<path d="M18 72 H 62 L 54 86 H 26 Z" fill="#b5322e"/></svg>"""


class Shown(NamedTuple):
    """A page with a shape, and what stands on it."""

    page: Any
    texture: Texture

    def press(self, name: str) -> None:
        self.page.get_by_role("button", name=name, exact=True).click()

    def look(self, center: tuple[float, float], zoom: float) -> None:
        self.page.evaluate("view => vexture.viewer.state.update(view)", {"center": center, "zoom": zoom})

    @property
    def box(self) -> dict[str, float]:
        return self.page.locator(".stage").bounding_box()

    def picture(self) -> NDArray[np.float64]:
        """The canvas alone, sRGB bytes, once what is switched on can be drawn."""
        self.page.evaluate("""async () => {
          const { engine } = vexture.viewer;
          await engine.flat.overlaid.compile(engine.renderer);
          engine.render();
          await new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next)));
        }""")
        png = self.page.screenshot(
            style=".tools, .fold, .notes, .differences, .svg-layer { display: none !important; }"
        )
        box = self.box
        left, top = int(box["x"]), int(box["y"])
        image = Image.open(io.BytesIO(png)).convert("RGB")
        crop = image.crop((left, top, left + int(box["width"]), top + int(box["height"])))
        return np.asarray(crop, np.float64)

    def matrix(self) -> NDArray[np.float64]:
        view = self.page.evaluate("vexture.viewer.state.value")
        matrix = view_matrix(tuple(view["center"]), view["zoom"], self.size)
        return np.vstack([matrix, [0.0, 0.0, 1.0]])

    @property
    def size(self) -> tuple[int, int]:
        return int(self.box["width"]), int(self.box["height"])

    def cells(self, cutoff: float = 0.0, root: int = 0) -> Cells:
        matrix = self.matrix()
        return Cells(self.texture, matrix, self.size, finest_level(matrix, cutoff), root)

    def point(self, u: float, v: float) -> tuple[float, float]:
        """Where a point of the unit square is on the page."""
        matrix = self.matrix()
        x, y = (np.array([u, v]) - matrix[:2, 2]) / np.diag(matrix)[:2]
        return self.box["x"] + x, self.box["y"] + y


def write_pages(folder: Path) -> dict[str, Texture]:
    """Write NAME.html for some textures; they are returned."""
    (folder / "boat.svg").write_text(BOAT)
    (folder / "favicon.ico").write_bytes(b"")  # which browsers ask servers for
    textures = {
        name: vexture.convert(SHAPES / f"{name}.svg", capacity=4, tolerance=0) for name in ("duck", "ocean", "font")
    }
    textures["boat"] = vexture.convert(folder / "boat.svg", split="paint")
    textures["map"] = replace(vexture.convert(folder / "boat.svg", split="faces", capacity=2), name="map")
    thesis = vexture.convert(SHAPES / "duck.svg", encoding="thesis")
    for name, texture in textures.items():
        more = {"facts": FACTS, "views": {"thesis16": thesis_view(thesis, folder)}} if name == "duck" else {}
        write_page(folder / f"{name}.html", manifest(texture, **more))
    return textures


def open_shape(open_page: Callable[..., Any], address: str, texture: Texture) -> Shown:
    """Open a page, and wait until its shape is there."""
    page = open_page(f"{address}/{texture.name}.html", WINDOW)
    page.wait_for_function("window.vexture?.viewer?.ready")
    page.evaluate("vexture.viewer.ready")
    return Shown(page, texture)


def colors(text: str) -> NDArray[np.float64]:
    """Colours in a CSS value, as bytes."""
    return np.array(
        [[float(part) for part in re.findall(r"[\d.]+", color)[:3]] for color in re.findall(r"rgb\([^)]*\)", text)]
    )


def ramp(page: Any) -> NDArray[np.float64]:
    """Colours of 0 and 1 in the legend."""
    return colors(page.locator(".ramp").evaluate("bar => getComputedStyle(bar).backgroundImage"))


def depth_colors(page: Any) -> NDArray[np.float64]:
    """Colours of depths 0 (which no leaf has), 1, ... in the legend."""
    swatches = page.get_by_role("list", name="Colours of depths").locator(".swatch")
    shown = [colors(swatch.evaluate("one => getComputedStyle(one).backgroundColor"))[0] for swatch in swatches.all()]
    return np.array([[0.0, 0.0, 0.0], *shown])


def over(picture: NDArray[np.float64], paint: NDArray[np.float64], opacity: Any) -> NDArray[np.float64]:
    return picture + (paint - picture) * opacity
