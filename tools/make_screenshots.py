"""Take the README's picture of the viewer: `python tools/make_screenshots.py` writes docs/pictures/viewer.png.

Needs Chromium and the built viewer (`make viewer`): the page is exported and looked at as a person would.
"""

import io
import sys
import tempfile
from pathlib import Path
from typing import Any, Final

from PIL import Image

ROOT: Final = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "benchmarks"))

from chromium import chromium  # noqa: E402 - the browser of the tests
from vexture.live.documents import VIEWER_SETTINGS  # noqa: E402
from vexture.live.viewing import export  # noqa: E402

__all__ = ["main"]

SHAPES: Final = ROOT / "examples" / "shapes"
TARGET: Final = ROOT / "docs" / "pictures" / "viewer.png"
SIZE: Final = (1080, 700)
SHOWN: Final = 700
"""Pixels that a screenshot is wide in the picture."""

GAP: Final = 12

LOOKS: Final[tuple[dict[str, Any], ...]] = (
    {"shape": "duck", "overlays": {"cells": True, "coverage": True, "depth": False, "cutoff": 0}},
    {"shape": "duck", "compare": "raster", "center": [0.886, 0.668], "zoom": 14, "split": 0.5},
    {"shape": "cake", "mode": "sphere", "theme": "dark", "yaw": -0.5, "pitch": 0.35},
    {"shape": "ocean", "mode": "plane", "yaw": 0.0, "pitch": -1.0, "distance": 1.2},
)


def looks(page: Any) -> list[Image.Image]:
    """One screenshot of each view."""
    taken = []
    for look in LOOKS:
        page.evaluate(
            """async ({overlays, ...look}) => {
                const {state, engine} = window.vexture.viewer;
                const start = {compare: null, mode: 'flat', theme: 'light', center: [0.5, 0.5], zoom: 1, distance: 1};
                state.updateOverlays({cells: false, coverage: false, ...overlays});
                state.update({...start, ...look});
                engine.requestFrame();
            }""",
            {"overlays": {}, **look},
        )
        page.wait_for_timeout(3000)
        picture = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
        taken.append(picture.resize((SHOWN, SHOWN * SIZE[1] // SIZE[0]), Image.Resampling.LANCZOS))
    return taken


def main() -> None:
    """Export a page of some example drawings, and put the screenshots of it side by side."""
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        target = Path(folder) / "page.html"
        export([SHAPES / f"{name}.svg" for name in ("duck", "cake", "ocean")], target, None, VIEWER_SETTINGS, print)
        page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]}, color_scheme="light")
        page.goto(target.as_uri())
        page.wait_for_function("() => window.vexture?.viewer?.engine?.drawing")
        taken = looks(page)
    width, height = taken[0].size
    sheet = Image.new("RGB", (2 * width + GAP, 2 * height + GAP), "#ffffff")
    for place, picture in enumerate(taken):
        sheet.paste(picture, (place % 2 * (width + GAP), place // 2 * (height + GAP)))
    sheet.save(TARGET, optimize=True)
    print(TARGET)


if __name__ == "__main__":
    main()
