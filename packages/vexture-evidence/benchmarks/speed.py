"""Time per pixel of the packed shader, the thesis's, the band algorithm's and one trilinear fetch.

    python packages/vexture-evidence/benchmarks/speed.py [--quick] [--rounds 5] [--seed 1]

All in one process, on one driver, in turns; medians of the turns. The programs are those of `packed_fidelity.py`.
Views: *whole*, the shape's box in 1024 x 1024 pixels; *zoom*, ten times that around a point of the outline; *small*,
the box in 64 x 64 pixels, 256 times at once; *tilted*, the box on a plane that leans back.
"""

import argparse
import math
from collections.abc import Iterable, Mapping, Sequence
from statistics import geometric_mean, median
from typing import Any, Final

import numpy as np

import corpora
from report import cell, table, write_json
from targets import Target, target_facts, target_table
from vexture.base.errors import LimitError
from vexture.conversion.pipeline import run_encoding
from vexture.drawing.drawing import Drawing
from vexture_evidence.measures.bands import BANDS, COASTLINE_BANDS, band_texture
from vexture_evidence.measures.machine import machine_facts, machine_line
from vexture_evidence.measures.programs import (
    Program,
    band_program,
    driver,
    fetch_program,
    framebuffer,
    packed_program,
    packed_texture,
    seconds,
    thesis_program,
)
from views import PictureView, square_view, tilted_view

SIDE: Final = 1024
SMALL: Final = 64
ZOOM: Final = 10.0
TEXT: Final = "agR&8@"
EDGES: Final = (768, 12_288, 98_304)
NAMES: Final = ("packed", "any", "thesis", "bands", "fetch")
LEAST_SECONDS: Final = 0.02
"""Of one measurement: draws are repeated until they take that long."""

FETCHES: Final = 20.0
"""A band baseline that costs more trilinear fetches is not fair."""


def programs_for(drawing: Drawing, bands: int) -> dict[str, Program]:
    """Every program that can show a drawing."""
    packed = packed_texture(drawing)
    made = {"packed": packed_program(packed, is_flat=True), "any": packed_program(packed)}
    try:
        made["thesis"] = thesis_program(run_encoding(drawing, "thesis").texture)
    except LimitError as error:
        print(f"thesis: {error}")
    return {**made, "bands": band_program(band_texture(drawing, bands)), "fetch": fetch_program(drawing)}


def views_of(drawing: Drawing, seed: int) -> dict[str, tuple[PictureView, tuple[int, int]]]:
    """Every view of a drawing, and after how many pixels it repeats."""
    rng = np.random.default_rng([seed, *drawing.name.encode()])
    cubics = np.concatenate([contour for path in drawing.paths for contour in path.contours])
    point = np.array([1, 3, 3, 1]) / 8 @ cubics[rng.integers(len(cubics))]
    whole, full = square_view(drawing, SIDE), (SIDE, SIDE)
    return {
        "whole": (whole, full),
        "zoom": (square_view(drawing, SIDE, ZOOM, (float(point[0]), float(point[1]))), full),
        "small": (square_view(drawing, SMALL), (SMALL, SMALL)),
        "tilted": (tilted_view(drawing, SIDE), full),
    }


def draws_for(once: float) -> int:
    """Number of draws, each of `once` seconds, for a measurement that the clock resolves."""
    return max(1, math.ceil(LEAST_SECONDS / once))


def times(programs: Mapping[str, tuple[Program, PictureView, tuple[int, int]]], rounds: int) -> dict[str, list[float]]:
    """Nanoseconds per pixel of each program with its view and tile, one figure for each turn."""
    drawn = framebuffer((SIDE, SIDE))
    draws = {}
    for name, (program, view, tile) in programs.items():
        draws[name] = draws_for(seconds(program, drawn, view.to_unit, tile, 1))
    found: dict[str, list[float]] = {name: [] for name in programs}
    for _ in range(rounds):
        for name, (program, view, tile) in programs.items():
            taken = seconds(program, drawn, view.to_unit, tile, draws[name])
            found[name].append(1e9 * taken / draws[name] / SIDE**2)
    return found


def for_view(programs: Mapping[str, Program], view: str) -> dict[str, Program]:
    """The programs, with that of any view for the packed one where pixels are not alike."""
    return {**programs, "packed": programs["any" if view == "tilted" else "packed"]}


def drawing_facts(drawing: Drawing, bands: int, rounds: int, seed: int) -> dict[str, Any]:
    """Times of all views of one drawing."""
    programs = programs_for(drawing, bands)
    taken = {
        name: times({one: (program, *seen) for one, program in for_view(programs, name).items()}, rounds)
        for name, seen in views_of(drawing, seed).items()
    }
    return {
        "drawing": drawing.name,
        "segments": drawing.segments,
        "bands": bands,
        "ns": {view: {name: median(turns) for name, turns in found.items()} for view, found in taken.items()},
        "turns": taken,
        "constants": {name: dict(program.constants) for name, program in programs.items()},
    }


def growth(coarse: Drawing, fine: Drawing, rounds: int, seed: int) -> float:
    """Time on a fine drawing over a coarse one, taken in turns: geometric mean over the views."""
    textures, quotients = [packed_texture(drawing) for drawing in (coarse, fine)], []
    for name, view in views_of(coarse, seed).items():
        programs = [packed_program(texture, is_flat=name != "tilted") for texture in textures]
        turns = times({str(k): (program, *view) for k, program in enumerate(programs)}, rounds)
        quotients.append(median(turns["1"]) / median(turns["0"]))
    return geometric_mean(quotients)


def ratio(facts: Iterable[Mapping[str, Any]], one: str, other: str, view: str | None = None) -> float:
    """Geometric mean, over drawings and views, of one program's time over another's.

    Examples
    --------
    >>> ratio([{"ns": {"whole": {"any": 2.0, "bands": 1.0}, "zoom": {"any": 8.0, "bands": 1.0}}}], "any", "bands")
    4.0
    """
    return geometric_mean(
        [ns[one] / ns[other] for found in facts for name, ns in found["ns"].items() if view in (None, name)]
    )


HEAD = ("drawings", "view", *NAMES, "packed/bands", "any/bands", "bands/fetch")


def lines(name: str, facts: Sequence[Mapping[str, Any]]) -> list[list[str]]:
    """Rows of some drawings, one for each view: geometric means."""
    rows = []
    for view in facts[0]["ns"]:
        shown = [
            geometric_mean([found["ns"][view][one] for found in facts]) if one in facts[0]["ns"][view] else None
            for one in NAMES
        ]
        ratios = [ratio(facts, *pair, view) for pair in (("packed", "bands"), ("any", "bands"), ("bands", "fetch"))]
        rows.append([name, view, *(cell(ns, 1) for ns in shown), *map(cell, ratios)])
    return rows


def targets(glyphs: Sequence[dict[str, Any]], coastlines: Sequence[dict[str, Any]], grown: float) -> list[Target]:
    """Targets for the times."""
    by_edges = {one["segments"]: one for one in coastlines}
    coast = ratio([by_edges[12_288]], "packed", "bands")
    least, most = min(by_edges), max(by_edges)
    return [
        Target("bands: trilinear fetches, glyphs", ratio(glyphs, "bands", "fetch"), FETCHES, FETCHES),
        Target("packed against bands, glyphs", ratio(glyphs, "packed", "bands"), 1.2, 0.9),
        Target("packed against bands, 12,288 edges", coast, 0.22, 0.12),
        Target(f"packed, {most:,} edges against {least}", grown, 1.2, 1.1),
    ]


def constants_line(facts: Mapping[str, Any]) -> str:
    """The constants that were compiled in, of every program."""
    return "\n".join(
        f"{name}: {' '.join(f'{key}={value:g}' for key, value in values.items())}"
        for name, values in facts["constants"].items()
    )


def main() -> None:
    parser = argparse.ArgumentParser(description="Time per pixel of the packed shader and of others.")
    parser.add_argument("--quick", action="store_true", help="three glyphs, two coastlines, fewer turns")
    parser.add_argument("--rounds", type=int, default=5, help="turns that a median is taken of")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    text, edges, rounds = (TEXT[:3], EDGES[:2], 3) if arguments.quick else (TEXT, EDGES, arguments.rounds)
    sets = {"DejaVu Sans": corpora.glyphs(corpora.dejavu_sans(), text), "STIX": corpora.glyphs(corpora.stix(), text)}
    sets["round"] = corpora.round_shapes()[::2]
    found = {name: [drawing_facts(d, BANDS, rounds, arguments.seed) for d in drawn] for name, drawn in sets.items()}
    islands = [corpora.fractal_coastline(count, arguments.seed) for count in edges]
    coastlines = [drawing_facts(d, COASTLINE_BANDS, min(rounds, 3), arguments.seed) for d in islands]
    rows = [row for name, facts in found.items() for row in lines(name, facts)]
    print(table(HEAD, rows + [row for facts in coastlines for row in lines(facts["drawing"], [facts])]))
    glyphs = found["DejaVu Sans"] + found["STIX"]
    grown = growth(islands[0], islands[-1], rounds, arguments.seed)
    reached = targets(glyphs, coastlines, grown)
    machine = machine_facts()
    print("\n".join(["", target_table(reached), "", constants_line(glyphs[0]), driver(), machine_line(machine)]))
    facts = {
        "machine": machine,
        "driver": driver(),
        **vars(arguments),
        "sets": found,
        "coastlines": coastlines,
        "growth": grown,
    }
    print(write_json("speed", {**facts, "targets": target_facts(reached)}))


if __name__ == "__main__":
    main()
