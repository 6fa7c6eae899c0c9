"""Pages of the viewer with shapes inside, what they should show, and what they show."""

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from viewer_page import data_url, manifest, thesis_view, write_page

import vexture
from chromium import ROOT
from vexture.renderers.exact import render_exact, render_exact_colours
from vexture.renderers.picture import composite_pictures, paint_layer
from vexture.server.publish_file import VIEWER_PARAMETERS, shape_of

SIZE = (512, 512)
PRECISION = 1e-7  # for views at 10,000x
SHAPES = ROOT / "examples" / "shapes"

FLAG = b"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="10 20 300 200">
  <rect x="10" y="20" width="300" height="200" fill="#d7e3f4"/>
  <path d="M10 220C90 60 190 240 310 20V220Z" fill="#b5121b"/>
  <circle cx="150" cy="120" r="71.3" fill="#0b6e4f" fill-opacity=".6"/>
  <ellipse cx="210" cy="90" rx="60" ry="13" fill="#ffd166" fill-opacity=".85"/>
</svg>"""


class Viewed:
    """A shape, its drawing and where its page is served."""

    def __init__(self, drawing: Any, texture: Any, url: str) -> None:
        self.drawing, self.texture, self.url = drawing, texture, url

    def expected_picture(self, matrix: NDArray[np.float64], size: tuple[int, int] = SIZE) -> NDArray[np.float64]:
        """Picture on white in 0..255, from the drawing itself."""
        if self.texture.roots[0].is_map:
            exact = render_exact_colours(self.drawing, size, matrix).astype(np.float64)
            return 255.0 * (exact[..., :3] + 1.0 - exact[..., 3:])
        if self.texture.roots[0].paint is None:
            grey = 255.0 * (1.0 - vexture.coverage(self.drawing, size, matrix, renderer="exact").astype(np.float64))
            return np.repeat(grey[..., None], 3, axis=2)
        layers = (
            paint_layer(layer.paths[0].paint, render_exact(layer, size, matrix)) for layer in self.drawing.layers()
        )
        picture = composite_pictures(size, layers).astype(np.float64)  # as the page draws them: one over the other
        return 255.0 * (picture[..., :3] + 1.0 - picture[..., 3:])


def write_pages(folder: Path, url: str) -> dict[str, Viewed]:
    """The duck, all its rivals included; a drawing in colours; both in one page."""
    (folder / "flag.svg").write_bytes(FLAG)
    duck, flag = vexture.read_svg(SHAPES / "duck.svg"), vexture.read_svg(folder / "flag.svg")
    textures = vexture.convert(duck, precision=PRECISION), vexture.convert(flag, split="paint", precision=PRECISION)
    thesis = vexture.convert(duck, encoding="thesis", bits=16)
    duck_source = (SHAPES / "duck.svg").read_bytes()
    views = {
        "svg": data_url("image/svg+xml", duck_source),
        "thesis16": thesis_view(thesis, folder),
        "thesis8": {"error": "the duck is too fine for 8 bits"},
    }
    duck_facts = shape_of(duck_source, "duck.svg", "duck", VIEWER_PARAMETERS).facts
    flag_facts = shape_of(FLAG, "flag.svg", "flag", VIEWER_PARAMETERS).facts
    duck_manifest = manifest(textures[0], views=views, facts={"box": duck_facts["box"]})
    flag_views = {"svg": data_url("image/svg+xml", FLAG)}
    flag_manifest = manifest(textures[1], views=flag_views, facts={"box": flag_facts["box"]})
    write_page(folder / "duck.html", duck_manifest)
    write_page(folder / "flag.html", flag_manifest)
    faces = vexture.convert(flag, split="faces", precision=PRECISION)
    write_page(folder / "map.html", manifest(faces, views=flag_views, facts={"box": flag_facts["box"]}))
    write_page(folder / "both.html", duck_manifest, flag_manifest)
    return {
        "duck": Viewed(duck, textures[0], f"{url}/duck.html"),
        "flag": Viewed(flag, textures[1], f"{url}/flag.html"),
        "map": Viewed(flag, faces, f"{url}/map.html"),
        "thesis": Viewed(duck, thesis, f"{url}/duck.html"),
        "both": Viewed(duck, textures[0], f"{url}/both.html"),
    }


def pixels(page: Any) -> NDArray[np.float64]:
    """What is on the screen, 0..255."""
    return np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB")).astype(np.float64)


def show(page: Any, **patch: Any) -> None:
    """Set a state and wait for its picture."""
    page.evaluate(
        """async (patch) => {
          const { engine, state } = vexture.viewer;
          state.update(patch);
          engine.render();
          await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
        }""",
        patch,
    )


def value(page: Any) -> dict[str, Any]:
    """State of the page."""
    found: dict[str, Any] = page.evaluate("vexture.viewer.state.value")
    return found


def ready(open_page: Callable[..., Any], url: str, size: tuple[int, int] = SIZE, **options: Any) -> Any:
    """Open a page and wait for its first picture."""
    page = open_page(url, size, **options)
    page.evaluate("vexture.viewer.ready")
    return page


def point_on_outline(drawing: Any) -> tuple[float, float]:
    """Middle of the longest cubic: a place where something is to be seen at any zoom."""
    cubics = np.concatenate([contour for path in drawing.paths for contour in path.contours])
    bent = cubics[np.argmax(np.abs(cubics[:, 3] - cubics[:, 0]).min(axis=1))]
    middle = (bent[0] + 3 * bent[1] + 3 * bent[2] + bent[3]) / 8
    return float(middle[0]), float(middle[1])
