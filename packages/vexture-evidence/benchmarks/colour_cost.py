"""The cost of a pixel in a planar map beside stacked layers: texels read, and time of the shader.

    python packages/vexture-evidence/benchmarks/colour_cost.py [--quick] [--seed 1]

*Layers* are the same drawings converted with `split="paint"`. Texels read are those of the shader, counted by its
mirror for pixels that are spread over a picture of 256 pixels; of layers they include the boxes of those that a pixel
does not meet. Times are of the software driver at 512 pixels: map and layers take turns, medians of the turns. Both are
means over a set. *glyphs* have one colour: as maps, which they are only to be restyled, beside their coverage. The last
table is of Mesa's compiler for AMD's GPUs, as in `gpu_cost.py`.
"""

import argparse
import warnings
from collections.abc import Iterator, Sequence
from statistics import fmean, median
from typing import Any, Final, NamedTuple

import numpy as np

import corpora
from colours import choropleth, clip_art, discs
from report import cell, table, write_json
from speed import TEXT, draws_for
from targets import Target, target_facts, target_table
from vexture.base.errors import SourceWarning
from vexture.base.tolerance import ROUND, UNSEEN
from vexture.bezier.convert import ellipse_cubics
from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import run
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.paint import Paint
from vexture.svg.read import read_svg
from vexture.tree.planar.sheets import sheets_of
from vexture_evidence.measures.colour_fetches import SheetStack, layer_boxes, pixel_fetches
from vexture_evidence.measures.colour_programs import color_target, map_source, sheets_program, silhouette_program
from vexture_evidence.measures.gpu_compiler import ToolchainError, toolchain
from vexture_evidence.measures.gpu_model import FAMILIES
from vexture_evidence.measures.machine import machine_facts, machine_line
from vexture_evidence.measures.programs import Program, driver, seconds

READ_AT: Final = 256
"""Pixels across the picture whose texels are counted."""

PIXELS: Final = 16
"""Squared, the pixels of which they are counted."""

DRAWN_AT: Final = 512
"""Pixels across the picture that is timed."""

TURNS: Final = 5
LEAST_TEXELS: Final = 65_536
"""A map or its sheets may have twice the texels of the layers, or so many."""

EMOJI, COAT, GLYPHS, CLIP_ART = "emoji", "coat of arms", "glyphs", "clip art"
LARGE_MAP: Final = "Voronoi 20,000"
DENSE: Final = ("300 discs", "800 rings", "hatching", "hairlines")


class CostSet(NamedTuple):
    """Drawings that share a row."""

    name: str
    drawings: Sequence[Drawing]
    has_layers: bool = True


def rings(count: int) -> Drawing:
    """Translucent discs about one point."""
    radii = 0.48 * (1.0 - np.arange(count) / count)
    circles = (ellipse_cubics((0.5, 0.5), (float(r), float(r)), ROUND) for r in radii)
    paints = (Paint((k / count, 0.4, 1.0 - k / count), 0.1) for k in range(count))
    return Drawing(tuple(Path((circle,), paint=paint) for circle, paint in zip(circles, paints, strict=True)))


def strokes(count: int, directions: Sequence[tuple[float, float]], width: float, paints: Sequence[Paint]) -> Drawing:
    """Rows of straight strokes from side to side, as many in each direction."""
    paths = []
    for dx, dy in directions:
        for k, at in enumerate((np.arange(count) + 0.5) / count):
            middle = np.array([0.5, 0.5]) + (0.9 * at - 0.45) * np.array([-dy, dx])
            half, across = 0.2 * np.array([dx, dy]), 0.5 * width * np.array([-dy, dx])
            corners = (middle - half - across, middle + half - across, middle + half + across, middle - half + across)
            contours = Drawing.polygon([(float(x), float(y)) for x, y in corners]).paths[0].contours
            paths.append(Path(contours, paint=paints[k % len(paints)]))
    return Drawing(tuple(paths))


def svg(files: Sequence[Any]) -> list[Drawing]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        return [read_svg(file) for file in files]


def sets(quick: bool, seed: int) -> Iterator[CostSet]:
    """All sets that are measured."""
    red, green, blue = (Paint(tuple(row)) for row in np.eye(3).tolist())
    part = 5 if quick else 1
    yield CostSet(EMOJI, svg(corpora.emoji(30 // part, seed)))
    yield CostSet(COAT, svg([corpora.coat_of_arms()]))
    yield CostSet(GLYPHS, corpora.glyphs(corpora.dejavu_sans(), TEXT))
    yield CostSet(CLIP_ART, clip_art(30 // part, seed))
    yield CostSet(DENSE[0], [discs(300 // part, seed)])
    yield CostSet(DENSE[1], [rings(800 // part)])
    crossing = [(np.cos(a), np.sin(a)) for a in (0.5, 2.1)]
    yield CostSet(DENSE[2], [strokes(100 // part, crossing, 0.002, [Paint((0.0, 0.0, 0.0), 0.5)])])
    yield CostSet(DENSE[3], [strokes(1000 // part, [(1.0, 0.0)], 0.0003, [red, green, blue])])
    yield CostSet(LARGE_MAP, [choropleth(20_000 // part, seed)], has_layers=False)


def convert_both(drawing: Drawing, one: CostSet) -> dict[str, SheetStack]:
    """Convert a drawing to its map or sheets, and to layers."""
    made = run(drawing, Parameters("faces", restyle=one.name == GLYPHS))
    parts = [drawing] if len(made.trees) == 1 else [sheet.drawing for sheet in sheets_of(drawing, tolerance=UNSEEN)]
    found = {"map": SheetStack(made.texture, layer_boxes(parts))}
    if one.name == GLYPHS:
        found["layers"] = SheetStack(run(drawing, Parameters(None)).texture, layer_boxes([drawing]))
    elif one.has_layers:
        layers = run(drawing, Parameters("paint"))
        found["layers"] = SheetStack(layers.texture, layer_boxes(layers.drawing.layers()))
    return found


def times(programs: dict[str, Program], turns: int) -> dict[str, float]:
    """Nanoseconds for a pixel of each program: medians of turns."""
    drawn, tile = color_target((DRAWN_AT, DRAWN_AT)), (DRAWN_AT, DRAWN_AT)
    to_unit = np.array([[1.0 / DRAWN_AT, 0.0, 0.0], [0.0, -1.0 / DRAWN_AT, 1.0], [0.0, 0.0, 1.0]])
    once = {}
    for name, program in programs.items():
        seconds(program, drawn, to_unit, tile, 1)  # compiles
        once[name] = draws_for(seconds(program, drawn, to_unit, tile, 1))
    found: dict[str, list[float]] = {name: [] for name in programs}
    for _ in range(turns):
        for name, program in programs.items():
            taken = seconds(program, drawn, to_unit, tile, once[name])
            found[name].append(1e9 * taken / once[name] / DRAWN_AT**2)
    return {name: median(taken) for name, taken in found.items()}


def programs_of(one: CostSet, sheets: dict[str, SheetStack]) -> dict[str, Program]:
    """The programs that draw these sheets."""
    found = {"map": sheets_program(sheets["map"], is_flat=True)}
    if one.name == GLYPHS:
        found["layers"] = silhouette_program(sheets["layers"].texture, is_flat=True)
    elif one.has_layers:
        found["layers"] = sheets_program(sheets["layers"], is_flat=True)
    return found


def set_facts(one: CostSet, turns: int, seed: int) -> dict[str, Any]:
    """All figures of a set, of maps and of layers."""
    made = [convert_both(drawing, one) for drawing in one.drawings]
    kinds = list(made[0])
    timed = [times(programs_of(one, pair), turns) for pair in made]
    return {
        "name": one.name,
        "drawings": len(made),
        "sheets": sum(len(pair["map"].texture.roots) for pair in made),
        "texels": {kind: sum(pair[kind].texture.info()["texels"] for pair in made) for kind in kinds},
        "fetches": {
            kind: fmean(pixel_fetches(pair[kind], READ_AT, None, PIXELS, seed) for pair in made) for kind in kinds
        },
        "ns": {kind: sum(pair[kind] for pair in timed) / len(timed) for kind in kinds},
    }


def map_over_layers(one: dict[str, Any], figure: str) -> float | None:
    """Ratio of the map's figure to the layers'; None without layers."""
    return one[figure]["map"] / one[figure]["layers"] if "layers" in one[figure] else None


def cost_table(facts: Sequence[dict[str, Any]]) -> str:
    rows = []
    for one in facts:
        row = [one["name"], str(one["drawings"]), str(one["sheets"])]
        for what, digits in (("texels", 0), ("fetches", 1), ("ns", 1)):
            layers = one[what].get("layers")
            row += [cell(float(one[what]["map"]), digits), cell(None if layers is None else float(layers), digits)]
            row.append(cell(map_over_layers(one, what), 3))
        rows.append(row)
    head = ("set", "drawings", "maps", "texels", "layers", "ratio", "read", "layers", "ratio", "ns", "layers", "ratio")
    return table(head, rows)


def targets(facts: Sequence[dict[str, Any]]) -> list[Target]:
    """Targets for a pixel in colours."""
    by_name = {one["name"]: one for one in facts}
    emoji, coat, art, large = (by_name[name] for name in (EMOJI, COAT, CLIP_ART, LARGE_MAP))
    found = [
        Target("texels read at 256 px, Voronoi 20,000", large["fetches"]["map"], 25.0, 15.0),
        Target("texels read at 256 px, coat of arms", coat["fetches"]["map"], 25.0, 10.0),
        Target("texels read at 256 px, gradients", art["fetches"]["map"], 20.0, 12.0),
        Target("texels over layers, emoji", map_over_layers(emoji, "texels"), 1.3, 0.9),
        Target("time over layers, emoji", map_over_layers(emoji, "ns"), 0.9, 0.5),
        Target("time over layers, coat of arms", map_over_layers(coat, "ns"), 0.1, 0.05),
        Target("time of one colour over its coverage", map_over_layers(by_name[GLYPHS], "ns"), 1.15, 1.0),
    ]
    for name in DENSE:
        one = by_name[name]
        budget = max(2 * one["texels"]["layers"], LEAST_TEXELS)
        found.append(Target(f"texels read over layers, {name}", map_over_layers(one, "fetches"), 0.5, 0.25))
        found.append(Target(f"texels of their budget, {name}", one["texels"]["map"] / budget, 1.0, 1.0))
    return found


def compiled_table() -> tuple[str, dict[str, Any]]:
    """Instructions and registers of the map's shader, on GPUs that this machine need not have."""
    rows, facts = [], {}
    try:
        with toolchain() as tools:
            for kind, family in FAMILIES.items():
                for is_flat in (True, False):
                    for shaded in (False, True):
                        name = f"{'flat' if is_flat else 'any'}{', gradients' if shaded else ''}"
                        text = map_source(is_flat=is_flat, gradients=int(shaded))
                        made = tools.compile_shader(name.replace(", ", "-"), text, family.name).statistics
                        facts[f"{kind}, {name}"] = dict(made)
                        shown = (made["Instructions"], made["VGPRs"], family.waves(made["VGPRs"]))
                        rows.append([kind, name, *map(str, shown)])
    except ToolchainError as error:
        return f"skipped: {error}", {}
    return table(("GPU", "program", "instructions", "VGPRs", "waves"), rows), facts


def main() -> None:
    """Measure everything and print it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="fewer and smaller drawings, one turn")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    turns = 1 if arguments.quick else TURNS
    facts = [set_facts(one, turns, arguments.seed) for one in sets(arguments.quick, arguments.seed)]
    reached, machine, (compiled, statistics) = targets(facts), machine_facts(), compiled_table()
    print("\n\n".join([cost_table(facts), target_table(reached), compiled, driver() + "\n" + machine_line(machine)]))
    found = {"machine": machine, "driver": driver(), **vars(arguments), "sets": facts, "compiled": statistics}
    print(write_json("colour_cost", {**found, "targets": target_facts(reached)}))


if __name__ == "__main__":
    main()
