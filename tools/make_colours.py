"""Draw the README's picture of colours: `python tools/make_colours.py` writes docs/pictures/colours.png.

Above what vexture draws from one texture each, below what Chromium makes of the same SVG: an icon of twenty gradients,
whole and magnified, another of Tango, a coat of arms and a map of 2,000 polygons in 24 pixels. Needs Chromium, npm and
apt.
"""

import io
import sys
import tempfile
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
from PIL import Image

ROOT: Final = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "packages" / "vexture-evidence" / "benchmarks"), str(ROOT / "tools")]

import corpora  # noqa: E402
import vexture  # noqa: E402
from chromium import chromium  # noqa: E402 - the browser of the tests
from colours import choropleth  # noqa: E402
from make_pictures import PANEL, sheet  # noqa: E402
from vexture.drawing.drawing import Drawing  # noqa: E402
from vexture.drawing.paint import Paint  # noqa: E402
from vexture.renderers.view import window  # noqa: E402

TARGET: Final = ROOT / "docs" / "pictures" / "colours.png"
FIREFOX: Final = Path("computer", "icons", "firefox.svg")
"""Of openclipart."""
ICON: Final = Path("apps", "internet-web-browser.svg")
"""Of Tango."""
POLYGONS: Final = 2_000
SMALL: Final = 24
"""Pixels of the small pictures, which are enlarged."""

DARKER: Final = 0.4

ROWS: Final = ("vexture", "Chromium")


class Look(NamedTuple):
    """Part of a drawing that a column shows: so many pixels of it, its lower left corner and side in unit squares."""

    title: str
    svg: Path
    pixels: int
    x: float = 0.0
    y: float = 0.0
    side: float = 1.0


def enlarge(picture: Image.Image) -> Image.Image:
    """The picture as large as a panel, each pixel a square."""
    return picture.resize((PANEL, PANEL), Image.Resampling.NEAREST)


def draw_texture(look: Look) -> Image.Image:
    """A look, drawn from its texture, on white."""
    size = (look.pixels, look.pixels)
    view = window(look.x, look.y, look.side, look.side).matrix(size)
    colors = vexture.convert(look.svg, precision=1e-7 if look.side < 1.0 else None).render(size, view)
    return Image.fromarray(np.uint8(np.rint(255.0 * (colors[..., :3] + 1.0 - colors[..., 3:]))))


def draw_svg(look: Look, page: Any) -> Image.Image:
    """A look at the SVG itself; the drawing's longer side fills the picture."""
    whole = look.pixels / look.side
    left, top = -look.x * whole, -(1.0 - look.y - look.side) * whole
    style = f"position:absolute;width:{whole}px;height:{whole}px;left:{left}px;top:{top}px"
    page.set_viewport_size({"width": look.pixels, "height": look.pixels})
    page.goto(look.svg.parent.as_uri())
    page.set_content(f'<body style="margin:0;overflow:hidden"><img style="{style}" src="{look.svg.as_uri()}"></body>')
    page.wait_for_function("document.images[0].complete")
    return Image.open(io.BytesIO(page.screenshot())).convert("RGB")


def svg_of(drawing: Drawing) -> str:
    """A drawing of polygons as SVG, in darker colours: white that shines through is seen."""
    paths = []
    for path in drawing.paths:
        corners = path.contours[0][:, 0] * (1.0, -1.0) + (0.0, 1.0)
        fill = Paint(tuple(DARKER * part for part in path.paint.color)).hex
        paths.append(f'<path fill="{fill}" d="M{" ".join(f"{x:.9f},{y:.9f}" for x, y in corners)}z"/>')
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1 1">{"".join(paths)}</svg>'


def main() -> None:
    """Write the picture."""
    (arms,) = (path for path in corpora.FLAG_ICONS.all() if path.name == "mx.svg")
    firefox = corpora.OPENCLIPART.home / FIREFOX
    tango = corpora.TANGO.home / ICON
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        polygons = Path(folder) / "map.svg"
        polygons.write_text(svg_of(choropleth(POLYGONS, 1)))
        looks = (
            Look("twenty gradients", firefox, PANEL),
            Look("30 times", firefox, PANEL, 0.37, 0.56, 1 / 30),
            Look("a Tango icon", tango, PANEL),
            Look(f"{SMALL} pixels", arms, SMALL, 0.25, 0.25, 0.5),
            Look(f"{POLYGONS:,} polygons, {SMALL} pixels", polygons, SMALL),
        )
        page = browser.new_page()
        rows = [
            [(look.title if row == 0 else "", name, enlarge(draw(look))) for look in looks]
            for row, (name, draw) in enumerate(
                zip(ROWS, (draw_texture, lambda look: draw_svg(look, page)), strict=True)
            )
        ]
    sheet(rows).save(TARGET, optimize=True)
    print(TARGET)


if __name__ == "__main__":
    main()
