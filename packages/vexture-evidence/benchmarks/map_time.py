"""A map of counties through 120 months in a browser: the cost of a step for the page, of its frame of 16.7 ms.

    python packages/vexture-evidence/benchmarks/map_time.py [--quick]

3,231 counties of the npm package us-atlas, as a pyramid in MapLibre. A step is `setTime` and the layer's part of the
frame after it: colours mixed between two months, tables of paints and means written and sent, and all drawn. Drawing
itself is done in software here, and not counted: the cost of a frame without a change is printed beside it.
"""

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import corpora
from chromium import WEB, bundle, chromium, serve_folder
from report import write_figures

GOALS = {"states_step_ms": 4.0, "country_step_ms": 4.0}
ATLAS = corpora.Package("us-atlas", "3.0.1", "")
MONTHS = 120
VIEWS = {"country": {"center": [-96, 38], "zoom": 2.5}, "states": {"center": [-90, 41], "zoom": 5}}
HTML = """<!doctype html><link rel="icon" href="data:,"><style>html, body, #map { margin: 0; height: 100% }</style>
<div id="map"></div><script type="module" src="page.js"></script>"""


def prepare(folder: Path) -> list[str]:
    """Write the page and its tiles, and return the ids of all counties."""
    source = ATLAS.installed_folder() / "counties-10m.json"
    words = [sys.executable, "-m", "vexture", "tiles", str(source), "--layer", "counties", "--max-zoom", "8"]
    subprocess.run([*words, "-o", str(folder / "counties"), "-q"], check=True)
    shutil.copy(WEB / "node_modules" / "maplibre-gl" / "dist" / "maplibre-gl-worker.mjs", folder)
    bundle(Path(__file__).parent / "pages" / "map_time.js", folder / "page.js")
    (folder / "page.html").write_text(HTML, encoding="utf-8")
    found = json.loads(source.read_text(encoding="utf-8"))["objects"]["counties"]["geometries"]
    return [one["id"] for one in found]


def measure_view(page: Any, name: str, ids: list[str], months: int) -> dict[str, float]:
    """Measure the milliseconds and rows of a view."""
    found = page.evaluate("given => measured(...given)", [VIEWS[name], ids, months])
    return {
        f"{name}_tiles": found["shown"],
        f"{name}_times_ms": found["given"],
        f"{name}_first_ms": found["first"],
        f"{name}_step_ms": found["step"],
        f"{name}_slowest_ms": found["slowest"],
        f"{name}_still_ms": found["still"],
        f"{name}_rows_sent": found["rows"],
    }


def main() -> None:
    """Measure, print and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="few months")
    chosen = parser.parse_args()
    figures: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as name, chromium() as browser:
        ids = prepare(Path(name))
        with serve_folder(Path(name)) as address:
            for view in VIEWS:
                page = browser.new_page(viewport={"width": 512, "height": 384})
                page.goto(f"{address}/page.html")
                page.wait_for_function("!!window.measured")
                figures |= measure_view(page, view, ids, 12 if chosen.quick else MONTHS)
                page.close()
    write_figures("map_time", figures, GOALS)


if __name__ == "__main__":
    main()
