"""The flood's page against its targets: its edge, its motion, its bytes, its times.

    python packages/vexture-evidence/benchmarks/flood.py [--quick] [--seed 1] [--only edges,raster,reading,live,page]

The page is that of the example of Santa Cruz, exported, in Chromium at 960 x 540 pixels. *Edges*: water white and all
else black, relief 0; what is compared with exact coverage are the pixels of its canvas that the shore passes, from
five views, at rest and in ten seconds of motion. *Raster*: the same page, the same shader, its one lookup in a picture
of 1024 x 1024 pixels instead: for its edge by 16 anisotropic samples, the best that three.js offers, for its time by
one, the fastest. *Reading*: an extent of 20,000 vertices from file to texture. *Live*: from the push of
such an extent to the pixels of 50 viewers. *Page*: bytes of all steps and of the exported page, its first picture.
"""

import argparse
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from statistics import median
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from chromium import chromium
from editing import percentile
from flood_edges import edge_errors, exact_shore, inside, water_to_unit
from flood_live import VIEWERS, time_pushes
from flood_reading import VERTICES, island_files, reading_times
from report import RESULTS, cell, table, write_json
from santa_cruz_page import (
    PRESETS,
    SIZE,
    ExportedFlood,
    capture_view,
    export_page,
    first_picture,
    frame_times,
    mask_of,
    open_page,
    show_raster,
)
from targets import Target, target_facts, target_table
from vexture_evidence.measures.machine import machine_facts, machine_line

SECONDS: Final = 10.0
PARTS: Final = ("edges", "raster", "reading", "live", "page")
STEP: Final = 0
"""Of the flood: the one that the fold was made for, and whose shore the views stand on."""

MOST_SAMPLES: Final = 16

Facts = dict[str, Any]


def errors_of(
    page: Any, flood: ExportedFlood, step: int, preset: str, seconds: float, fold: Any
) -> NDArray[np.float64]:
    """Errors at the pixels of the edge."""
    picture, camera = capture_view(page, preset, seconds)
    to_unit = water_to_unit(camera, flood.box, SIZE)
    truth = exact_shore(flood.drawings[step], SIZE, to_unit, fold, seconds)
    return edge_errors(picture, truth, inside(to_unit, flood.box, SIZE))


def edges(page: Any, flood: ExportedFlood, step: int) -> dict[str, float | None]:
    """Mean error at the edge by view, at the time 0."""
    found = {preset: errors_of(page, flood, step, preset, 0.0, flood.fold) for preset in PRESETS}
    return {preset: float(values.mean()) if len(values) else None for preset, values in found.items()}


def motion(page: Any, flood: ExportedFlood, step: int, presets: Sequence[str], frames: int) -> Facts:
    """Errors in ten seconds of motion by view: mean, 99th percentile and most over frames and edge pixels."""
    found = {}
    for preset in presets:
        times = np.linspace(0.0, SECONDS, frames)
        values = np.concatenate([errors_of(page, flood, step, preset, float(t), flood.fold) for t in times])
        shares = {"mean": values.mean(), "p99": np.percentile(values, 99), "most": values.max(), "pixels": len(values)}
        found[preset] = {name: float(value) for name, value in shares.items()} if len(values) else None
    return found


def edge_part(browser: Any, flood: ExportedFlood, quick: bool) -> tuple[list[Target], Facts, list[list[str]]]:
    presets, frames = (PRESETS[::2], 4) if quick else (PRESETS, 40)
    with open_page(browser, flood, STEP, flat=True) as page:
        rest = edges(page, flood, STEP)
        moving = motion(page, flood, STEP, presets, frames)
    known = [one for one in moving.values() if one]
    reached = [Target(f"edge at rest, MAE of {preset}, 1/255", value, 1.0, 0.3) for preset, value in rest.items()]
    reached += [
        Target(f"edge in motion, p99 of {preset}, 1/255", one and one["p99"], 5.0, 3.0)
        for preset, one in moving.items()
    ]
    rows = [
        [preset, cell(rest[preset], 3)]
        + [cell((moving.get(preset) or {}).get(name), 3) for name in ("mean", "p99", "most")]
        for preset in PRESETS
    ]
    return reached, {"rest": rest, "motion": moving, "frames": frames, "known": len(known)}, rows


def save_side_by_side(kind: str, *pages: Any) -> None:
    """Save what pages show, beside one another, from each view."""
    for preset in PRESETS:
        pictures = [capture_view(page, preset, 0.0)[0] for page in pages]
        Image.fromarray(np.hstack(pictures)).save(RESULTS / f"flood-{preset.lower()}{kind}.png")


def raster_part(browser: Any, flood: ExportedFlood, quick: bool) -> tuple[list[Target], Facts]:
    frames, turns = (3, 1) if quick else (6, 3)
    mask, mask_bytes = mask_of(flood.drawings[STEP])
    ours_bytes = len(flood.textures[STEP])
    facts: Facts = {"bytes": {"ours": ours_bytes, "raster": mask_bytes}, "ms": {}, "edge": {}}
    RESULTS.mkdir(exist_ok=True)
    with open_page(browser, flood, STEP, flat=False) as ours, open_page(browser, flood, STEP, flat=False) as theirs:
        show_raster(theirs, mask, 1)
        for preset in PRESETS:
            times: tuple[list[float], list[float]] = ([], [])
            for _ in range(turns):  # alternately, so that other work on the machine affects both
                for taken, page in zip(times, (ours, theirs), strict=True):
                    taken += frame_times(page, preset, frames)[1:]
            facts["ms"][preset] = {"ours": median(times[0]), "raster": median(times[1])}
    with open_page(browser, flood, STEP, flat=True) as ours, open_page(browser, flood, STEP, flat=True) as theirs:
        show_raster(theirs, mask, MOST_SAMPLES)
        save_side_by_side("-flat", ours, theirs)
        facts["edge"] = {"ours": edges(ours, flood, STEP), "raster": edges(theirs, flood, STEP)}
    with open_page(browser, flood, STEP, flat=False) as ours, open_page(browser, flood, STEP, flat=False) as theirs:
        show_raster(theirs, mask, MOST_SAMPLES)
        save_side_by_side("", ours, theirs)
    ratio = max(one["ours"] / one["raster"] for one in facts["ms"].values())
    return [
        Target("frame time over the raster's, worst view", ratio, 1.25, 1.1),
        Target("bytes over the raster's PNG", ours_bytes / mask_bytes, 1.0, 0.5),
    ], facts


def reading_part(folder: Path, quick: bool, seed: int) -> tuple[list[Target], Facts]:
    reached, facts, rows = [], {}, []
    for kind, path in island_files(folder, seed).items():
        taken = reading_times(path, 5 if quick else 20)
        ways = (taken.drawing, taken.texture, taken.file)
        rows.append([kind, str(path.stat().st_size), *(cell(median(way), 1) for way in ways), str(taken.size)])
        facts[kind] = taken._asdict()
        reached.append(
            Target(f"{VERTICES} vertices, {kind} to texture, median (ms)", median(taken.texture), 60.0, 30.0)
        )
    print(table(("from", "bytes", "to drawing, ms", "to texture", "to its file", "bytes"), rows), end="\n\n")
    return reached, facts


def live_part(browser: Any, folder: Path, quick: bool, seed: int) -> tuple[list[Target], Facts]:
    raw, pixels = time_pushes(browser, folder, 6 if quick else 30, seed)
    return [
        Target(f"push to pixels, 95% of {VIEWERS} viewers (ms)", percentile(raw + pixels, 0.95), 400.0, 200.0),
        Target("push to pixels, 95% of the one real page (ms)", percentile(pixels, 0.95), 400.0, 200.0),
    ], {"raw": raw, "page": pixels}


def page_part(browser: Any, flood: ExportedFlood, quick: bool) -> tuple[list[Target], Facts]:
    times = first_picture(browser, flood.page, 2 if quick else 8)
    textures, depths = (sum(map(len, files)) for files in (flood.textures, flood.depths))
    size = flood.page.stat().st_size
    return [
        Target(f"{len(flood.textures)} steps, textures and depths (kB)", (textures + depths) / 1000, 600.0, 300.0),
        Target("exported page with its ground (kB)", size / 1000, 2500.0, 1800.0),
        Target("exported page to its picture, median (ms)", median(times), 5000.0, 2000.0),
    ], {"textures": textures, "depths": depths, "page": size, "opened": times}


def main() -> None:
    parser = argparse.ArgumentParser(description="The flood's page against what it must reach.")
    parser.add_argument("--quick", action="store_true", help="fewer views, frames and turns")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default=",".join(PARTS), help="parts to measure, between commas")
    arguments = parser.parse_args()
    parts, quick, seed = arguments.only.split(","), arguments.quick, arguments.seed
    facts: Facts = {}
    reached: list[Target] = []
    with tempfile.TemporaryDirectory() as scratch, chromium() as browser:
        folder = Path(scratch)
        exported = export_page(folder) if {"edges", "raster", "page"} & set(parts) else None
        if "edges" in parts and exported:
            found, facts["edges"], rows = edge_part(browser, exported, quick)
            reached += found
            print(table(("edge, 1/255", "at rest", "in motion", "99%", "most"), rows), end="\n\n")
        if "raster" in parts and exported:
            found, facts["raster"] = raster_part(browser, exported, quick)
            reached += found
            print_raster(facts["raster"])
        measures: dict[str, Callable[[], tuple[list[Target], Facts]]] = {
            "reading": lambda: reading_part(folder, quick, seed),
            "live": lambda: live_part(browser, folder, quick, seed),
            "page": lambda: page_part(browser, exported, quick) if exported else ([], {}),
        }
        for name, measure in measures.items():
            if name in parts:
                found, facts[name] = measure()
                reached += found
    machine = machine_facts()
    print("\n".join([target_table(reached), "", machine_line(machine)]))
    print(write_json("flood", {"machine": machine, **vars(arguments), **facts, "targets": target_facts(reached)}))


def print_raster(facts: Facts) -> None:
    """Print ours beside the raster's."""
    rows = [
        [preset]
        + [cell(facts["ms"][preset][who], 1) for who in ("ours", "raster")]
        + [cell(facts["edge"][who][preset], 2) for who in ("ours", "raster")]
        for preset in PRESETS
    ]
    print(table(("view", "ms", "raster ms", "edge, 1/255", "raster's"), rows))
    sizes = facts["bytes"]
    print(f"one step: {sizes['ours']} bytes, the raster's PNG {sizes['raster']}; pictures: {RESULTS}/flood-*.png\n")


if __name__ == "__main__":
    main()
