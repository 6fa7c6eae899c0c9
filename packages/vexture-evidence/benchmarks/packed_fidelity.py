"""Errors of the packed shader for glyphs, shapes, icons and coastlines, against exact coverage.

    python packages/vexture-evidence/benchmarks/packed_fidelity.py [--quick] [--shifts 4] [--seed 1]

Errors are in 1/255 over the pixels that the shape touches in truth or in the picture, over all shifts; a set's figure
is the mean over its drawings, *worst* that of its worst drawing. *sd* is the ink's standard deviation over the shifts,
in percent. *gpu-cpu* is the largest difference of any pixel between the shader and its mirror on the CPU, in the first
picture of each. The programs are those of `speed.py`, with the same constants: *flat* for upright pixels, *any* for
all. A drawing that is no glyph is one em wide. The seams have a table of their own (`seams.py`).
"""

import argparse
import contextlib
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from statistics import fmean
from typing import Any, Final, NamedTuple

import numpy as np
from rich.console import Console
from rich.progress import track

import corpora
from report import cell, table, write_json
from seams import seam_facts, seam_table, seam_targets
from targets import Target, target_facts, target_table
from vexture.base.errors import LimitError, SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.renderers.cpu import render_cpu
from vexture.renderers.exact import render_exact
from vexture.svg.read import read_svg
from vexture.texture.texture import Texture
from vexture_evidence.measures.bands import BANDS, COASTLINE_BANDS, band_texture
from vexture_evidence.measures.machine import machine_facts, machine_line
from vexture_evidence.measures.metrics import LEVELS, errors, ink_sd
from vexture_evidence.measures.programs import Program, band_program, driver, packed_program, packed_texture
from views import views_with_shifts

SHAPES = Path(__file__).parents[3] / "examples" / "shapes"
SIX: Final = "agR&8@"
ICONS: Final = 150
"""Of each of two sets."""

EDGES: Final = (768, 12_288, 98_304)
PROGRAMS: Final = ("flat", "any")
COAST: Final = "coastline"
"""Beginning of the names of such sets."""

Limits = tuple[float, float]


class ScaledCase(NamedTuple):
    """A view: pixels in an em, degrees of turn, and a pixel's length over its width."""

    pixels: int
    turn: float = 0.0
    stretch: float = 1.0

    def __str__(self) -> str:
        """The case as the tables name it."""
        turned = f", {self.turn:g} degrees" if self.turn else ""
        return f"{self.pixels} px{turned}" + (f", {self.stretch:g}:1" if self.stretch != 1.0 else "")

    @property
    def is_flat(self) -> bool:
        """Whether its pixels are upright in the drawing."""
        return self.turn == 0.0


CASES: Final = (
    *(ScaledCase(pixels) for pixels in (64, 32, 16, 8, 4, 2)),
    *(ScaledCase(pixels, 30.0) for pixels in (64, 16, 8)),
    *(ScaledCase(pixels, 45.0, 8.0) for pixels in (64, 32)),
)
FEW: Final = tuple(case for case in CASES if case in {(64, 0, 1), (16, 0, 1), (4, 0, 1), (16, 30, 1), (64, 45, 8)})

MAE_LIMITS: Final = (0.04, 0.01)
WORST_LIMITS: Final = (1.0, 0.25)
"""Of all drawings but coastlines, in every case: what is required and what is aimed at."""

COAST_MAE_LIMITS: Final = {
    ScaledCase(64): (0.1, 0.03),
    ScaledCase(16): (0.4, 0.1),
    ScaledCase(64, 45.0, 8.0): (0.6, 0.1),
}
COAST_WORST_LIMITS: Final = (8.0, 2.0)
"""Of coastlines, in these cases."""

INK_LIMITS: Final = (0.02, 0.02)
APART_LIMITS: Final = (1.0, 1.0)


class FidelitySet(NamedTuple):
    """Drawings that share a row."""

    name: str
    drawings: Sequence[Drawing]
    cases: Sequence[ScaledCase] = CASES
    bands: int = BANDS


def icons(choose: Callable[[int, int], list[Path]], count: int, seed: int) -> list[Drawing]:
    """Drawings of icons."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        return [read_svg(path) for path in choose(count, seed)]


def sets(quick: bool, seed: int) -> Iterator[FidelitySet]:
    """All sets that are measured."""
    for name, font in (("DejaVu Sans", corpora.dejavu_sans()), ("STIX", corpora.stix())):
        yield FidelitySet(f"{name} {SIX}", corpora.glyphs(font, SIX))
        if not quick:
            yield FidelitySet(f"{name} a-zA-Z0-9", corpora.glyphs(font, corpora.ALPHANUMERICS), FEW)
    yield FidelitySet("circles, S-curves", corpora.round_shapes())
    yield FidelitySet("example shapes", [read_svg(path) for path in sorted(SHAPES.glob("*.svg"))], FEW)
    count = 10 if quick else ICONS
    yield FidelitySet(f"mdi, {count}", icons(corpora.mdi, count, seed), FEW)
    yield FidelitySet(f"simple-icons, {count}", icons(corpora.simple_icons, count, seed), FEW)
    edges = EDGES[:2] if quick else EDGES
    for island in (corpora.fractal_coastline(count, seed) for count in edges):
        yield FidelitySet(island.name, [island], CASES, COASTLINE_BANDS)


def programs_for(drawing: Drawing, packed: Texture, bands: int) -> dict[str, Program]:
    """Both programs of the packed shader, and the bands where they can show the drawing."""
    made = {name: packed_program(packed, is_flat=name == "flat") for name in PROGRAMS}
    with contextlib.suppress(LimitError):  # an even-odd fill
        made["bands"] = band_program(band_texture(drawing, bands))
    return made


def case_facts(
    drawing: Drawing, packed: Texture, programs: Mapping[str, Program], case: ScaledCase, shifts: int, seed: int
) -> dict[str, dict[str, float]]:
    """Errors and ink of one drawing's pictures in one case, by program; for one also its distance from its mirror."""
    views = list(views_with_shifts(drawing, case.pixels, shifts, seed, turn=case.turn, stretch=case.stretch))
    truths = [render_exact(drawing, *view) for view in views]
    facts = {}
    for name, program in programs.items():
        if program.is_flat and not case.is_flat:
            continue
        images = [program.image(*view) for view in views]
        facts[name] = {**errors(np.stack(images), np.stack(truths))._asdict(), "sd": ink_sd(images, truths)}
        if name == PROGRAMS[not case.is_flat]:
            mirrored = render_cpu(packed, *views[0])
            facts[name]["apart"] = LEVELS * float(np.abs(images[0] - mirrored).max())
    return facts


def set_facts(measured: FidelitySet, shifts: int, seed: int) -> dict[str, Any]:
    """All measurements of one set: by case, by drawing."""
    shown = track(measured.drawings, measured.name, console=Console(stderr=True), transient=True)
    drawings = []
    for drawing in shown:
        packed = packed_texture(drawing)
        programs = programs_for(drawing, packed, measured.bands)
        facts = {str(case): case_facts(drawing, packed, programs, case, shifts, seed) for case in measured.cases}
        drawings.append({"drawing": drawing.name, "cases": facts})
    return {"set": measured.name, "drawings": drawings}


def mean_of(facts: Mapping[str, Any], case: ScaledCase, program: str, figure: str) -> float | None:
    """Mean of a figure over a set's drawings; None where nothing was measured."""
    found = list(values(facts, case, program, figure))
    return fmean(found) if found else None


def values(facts: Mapping[str, Any], case: ScaledCase, program: str, figure: str) -> Iterator[float]:
    """A figure of each drawing of a set, where it was measured."""
    for drawing in facts["drawings"]:
        found = drawing["cases"].get(str(case), {}).get(program, {})
        if figure in found:
            yield found[figure]


HEAD = ("set", "case", "flat", "worst", "rmse", "max", "sd", "any", "worst", "rmse", "max", "sd", "bands", "sd")
HEAD += ("gpu-cpu",)


def lines(facts: Mapping[str, Any]) -> Iterator[list[str]]:
    """Rows of one set, one for each case."""
    for case in CASES:
        if mean_of(facts, case, "any", "mae") is None:
            continue
        row = [facts["set"], str(case)]
        mean = partial(mean_of, facts, case)
        for name in PROGRAMS:
            row += [
                cell(mean(name, "mae"), 3),
                cell(max(values(facts, case, name, "mae"), default=None), 3),
                cell(mean(name, "rmse"), 3),
                cell(max(values(facts, case, name, "max"), default=None)),
                cell(mean(name, "sd"), 3),
            ]
        apart = max(value for name in PROGRAMS for value in values(facts, case, name, "apart"))
        yield [*row, cell(mean("bands", "mae")), cell(mean("bands", "sd")), cell(apart)]


def targets(found: Sequence[Mapping[str, Any]]) -> list[Target]:
    """Targets for the errors."""
    coasts = [facts for facts in found if facts["set"].startswith(COAST)]
    others = [facts for facts in found if facts not in coasts]
    made = []
    for name in PROGRAMS:
        cases = [case for case in CASES if case.is_flat or name == "any"]
        limits = {case: COAST_MAE_LIMITS[case] for case in cases if case in COAST_MAE_LIMITS}
        made += [mean_target(others, cases, name, MAE_LIMITS), worst_target(others, cases, name, WORST_LIMITS)]
        made += [mean_target(coasts, [case], name, limit) for case, limit in limits.items()]
        made.append(worst_target(coasts, list(limits), name, COAST_WORST_LIMITS))
        ink = max(mean_of(found[0], case, name, "sd") or 0.0 for case in cases)
        made.append(Target(f"{name}: ink SD, every case, six glyphs", ink, *INK_LIMITS))
    apart = [
        one for facts in found for case in CASES for name in PROGRAMS for one in values(facts, case, name, "apart")
    ]
    made.append(Target("GPU against CPU, largest difference of any pixel, 1/255", max(apart), *APART_LIMITS))
    return made


def mean_target(found: Iterable[Mapping[str, Any]], cases: Sequence[ScaledCase], name: str, limits: Limits) -> Target:
    """Target for the mean error of a set in a case, the largest of all."""
    means = [(mean_of(facts, case, name, "mae"), facts["set"], str(case)) for facts in found for case in cases]
    mean, worst, case = max((mean, *where) for mean, *where in means if mean is not None)
    return Target(f"{name}: MAE, worst: {worst}, {case}", mean, *limits)


def worst_target(found: Iterable[Mapping[str, Any]], cases: Sequence[ScaledCase], name: str, limits: Limits) -> Target:
    """Target for the error of a pixel, the largest of all."""
    errors_of = [(values(facts, case, name, "max"), facts["set"], str(case)) for facts in found for case in cases]
    most, worst, case = max((error, *where) for found_here, *where in errors_of for error in found_here)
    return Target(f"{name}: worst pixel: {worst}, {case}", most, *limits)


def main() -> None:
    parser = argparse.ArgumentParser(description="Errors of the packed shader's pictures.")
    parser.add_argument("--quick", action="store_true", help="fewer drawings")
    parser.add_argument("--shifts", type=int, default=4, help="pictures of each drawing in each case")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    found = [
        set_facts(measured, arguments.shifts, arguments.seed) for measured in sets(arguments.quick, arguments.seed)
    ]
    print(table(HEAD, [line for facts in found for line in lines(facts)]))
    seams = seam_facts(arguments.seed, arguments.quick)
    reached = [*targets(found), *seam_targets(seams)]
    machine = machine_facts()
    print("\n".join(["", seam_table(seams), "", target_table(reached), "", driver(), machine_line(machine)]))
    constants = dict(packed_program(packed_texture(corpora.round_shapes()[0])).constants)
    facts = {"machine": machine, "driver": driver(), **vars(arguments), "constants": constants, "sets": found}
    print(write_json("packed_fidelity", {**facts, "seams": seams, "targets": target_facts(reached)}))


if __name__ == "__main__":
    main()
