"""Frame times in Chromium: VectorMaterial, for flat views and for any, and the band algorithm, in one page.

    python packages/vexture-evidence/benchmarks/web_speed.py [--quick] [--rounds 5] [--seed 1]

A frame is what three.js draws of a scene until its pixels can be read; the methods take turns on the same meshes.
Views: *whole*, all shapes side by side in 1024 x 1024 pixels; *zoom*, ten times that around a point of an outline;
*small*, 256 squares of 64 x 64 pixels; *tilted*, the whole on a plane that leans back by 60 degrees.
*packed* is the material for flat views, but for the tilted one.
"""

import argparse
import base64
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from statistics import geometric_mean, median
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

import corpora
from chromium import bundle, chromium, serve_folder
from report import cell, table, write_json
from speed import TEXT, ZOOM
from targets import Target, target_facts, target_table
from vexture.conversion.pipeline import convert
from vexture.drawing.drawing import Drawing
from vexture_evidence.measures.bands import BANDS, COASTLINE_BANDS, ROW_BITS, band_shader, band_texture
from vexture_evidence.measures.machine import machine_facts, machine_line
from vexture_evidence.measures.programs import rows_of
from views import box_of

SIDE: Final = 1024
LEAST: Final = 100.0
"""Milliseconds of one measurement."""

TILT: Final = 60.0
SMALL: Final = 256
METHODS: Final = ("packed", "any", "bands")
EDGES: Final = 12_288


def text_of(values: NDArray[Any]) -> str:
    return base64.b64encode(np.ascontiguousarray(values).tobytes()).decode()


def square_of(drawing: Drawing) -> NDArray[np.float64]:
    """Lower left and upper right corner of the square that a drawing's box is in the middle of, (2, 2)."""
    low, high = box_of(drawing)
    half = 0.5 * (high - low).max()
    return np.stack([0.5 * (low + high) - half, 0.5 * (low + high) + half])


def shape_of(drawing: Drawing, bands: int) -> dict[str, Any]:
    """Data of one drawing for the page."""
    lists = band_texture(drawing, bands)
    width = 1 << ROW_BITS
    return {
        "box": square_of(drawing).ravel().tolist(),
        "packed": base64.b64encode(convert(drawing, split=None).to_ktx2()).decode(),
        "bands": {
            "lists": text_of(rows_of(lists.lists[:, None], width)),
            "outlines": text_of(rows_of(lists.outlines, width)),
            "width": width,
            "box": lists.box.tolist(),
            "shader": "precision highp usampler2D;\n" + band_shader(bands),
        },
    }


def views_of(drawings: Sequence[Drawing], seed: int) -> dict[str, dict[str, Any]]:
    """Every view of a sheet of shapes: where the page's camera stands."""
    rng = np.random.default_rng(seed)
    place = int(rng.integers(len(drawings)))
    cubics = np.concatenate([contour for path in drawings[place].paths for contour in path.contours])
    point = np.array([1, 3, 3, 1]) / 8 @ cubics[rng.integers(len(cubics))]
    low, high = square_of(drawings[place])
    columns = int(np.ceil(np.sqrt(len(drawings))))
    x, y = (point - low) / (high - low)
    at = [place % columns + float(x), columns - 1 - place // columns + float(y)]
    return {
        "whole": {},
        "zoom": {"zoom": ZOOM, "at": at},
        "small": {"repeat": SMALL},
        "tilted": {"tilt": TILT},
    }


def frame_times(drawings: Sequence[Drawing], bands: int, rounds: int, seed: int, pictures: Path | None = None) -> Any:
    """Milliseconds of a frame by view and method, one figure for each turn; the driver's and three.js's names."""
    order = {
        "shapes": [shape_of(drawing, bands) for drawing in drawings],
        "views": views_of(drawings, seed),
        "side": SIDE,
        "rounds": rounds,
        "least": LEAST,
    }
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        bundle(Path(__file__).parent / "pages" / "scene.js", Path(folder) / "scene.js")
        (Path(folder) / "index.html").write_text('<!doctype html><script type="module" src="scene.js"></script>')
        with serve_folder(Path(folder)) as address:
            page = browser.new_page()
            page.goto(address)
            page.wait_for_function("() => window.measure !== undefined")
            found = page.evaluate("order => measure(order)", order)
    for view, times in found["times"].items():
        for method, picture in zip(METHODS, times.pop("pictures"), strict=True):
            if pictures is not None:
                (pictures / f"{view}-{method}.png").write_bytes(base64.b64decode(picture.partition(",")[2]))
    return found


def ratio(times: Mapping[str, Mapping[str, Sequence[float]]], one: str, other: str) -> float:
    """Geometric mean, over the views, of one method's median time over another's."""
    return geometric_mean([median(found[one]) / median(found[other]) for found in times.values()])


def main() -> None:
    parser = argparse.ArgumentParser(description="Frame times in Chromium, beside the band algorithm.")
    parser.add_argument("--quick", action="store_true", help="three glyphs, fewer turns")
    parser.add_argument("--rounds", type=int, default=5, help="turns that a median is taken of")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--pictures", type=Path, help="folder for a picture of each scene")
    arguments = parser.parse_args()
    text, rounds = (TEXT[:3], 3) if arguments.quick else (TEXT, arguments.rounds)
    glyphs = [*corpora.glyphs(corpora.dejavu_sans(), text), *corpora.glyphs(corpora.stix(), text)]
    sets = {
        "glyphs": (glyphs, BANDS),
        "coastline": ([corpora.fractal_coastline(EDGES, arguments.seed)], COASTLINE_BANDS),
    }
    rows, facts = [], {}
    for name, (drawings, bands) in sets.items():
        folder = arguments.pictures / name if arguments.pictures else None
        if folder:
            folder.mkdir(parents=True, exist_ok=True)
        facts[name] = found = frame_times(drawings, bands, rounds, arguments.seed, folder)
        for view, times in found["times"].items():
            shown = [median(times[method]) for method in METHODS]
            rows.append([name, view, *(cell(ms, 1) for ms in shown), *(cell(ms / shown[-1]) for ms in shown[:-1])])
    print(table(("scene", "view", *(f"{method} ms" for method in METHODS), "packed/bands", "any/bands"), rows))
    limits = {"glyphs": (1.2, 2.0), "coastline": (1.0, 1.0)}
    reached = [
        Target(f"{method} against bands, {name}", ratio(facts[name]["times"], method, "bands"), limit, limit)
        for name, both in limits.items()
        for method, limit in zip(METHODS, both, strict=False)
    ]
    machine = machine_facts()
    driver = f"{facts['glyphs']['driver']}, three.js r{facts['glyphs']['three']}"
    print("\n".join(["", target_table(reached), "", driver, machine_line(machine)]))
    facts |= {"machine": machine, "rounds": rounds, "seed": arguments.seed}
    print(write_json("web_speed", {**facts, "targets": target_facts(reached)}))


if __name__ == "__main__":
    main()
