"""Draw the documentation's picture of filters: `python tools/make_filters.py` writes docs/pictures/filters.png.

Above emoji with shadows and blurs from their textures, below what Chromium makes of the same SVG.
Needs Chromium and npm.
"""

import sys
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "packages" / "vexture-evidence" / "benchmarks"), str(ROOT / "tools")]

import corpora  # noqa: E402
from chromium import chromium  # noqa: E402 - the browser of the tests
from make_colours import ROWS, Look, draw_svg, draw_texture  # noqa: E402
from make_pictures import PANEL, sheet  # noqa: E402

TARGET: Final = ROOT / "docs" / "pictures" / "filters.png"
EMOJI: Final = ("mx-claus-medium", "loudspeaker", "snowflake", "test-tube")
"""Of Fluent Emoji; the last one is furthest from its source."""


def main() -> None:
    """Write the picture."""
    folder = corpora.FLUENT_MODERN.installed_folder() / corpora.FLUENT_MODERN.folder
    looks = [Look(name.replace("-", " "), folder / f"{name}.svg", PANEL) for name in EMOJI]
    with chromium() as browser:
        page = browser.new_page()
        rows = [
            [(look.title if row == 0 else "", name, draw(look)) for look in looks]
            for row, (name, draw) in enumerate(
                zip(ROWS, (draw_texture, lambda look: draw_svg(look, page)), strict=True)
            )
        ]
    sheet(rows).save(TARGET, optimize=True)
    print(TARGET)


if __name__ == "__main__":
    main()
