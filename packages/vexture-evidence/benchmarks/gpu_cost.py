"""The shaders' cost on GPUs that this machine need not have: instructions, registers, waves, modelled cycles.

    python packages/vexture-evidence/benchmarks/gpu_cost.py [--quick] [--waves 256] [--seed 1]

Mesa's driver for AMD's GPUs compiles the programs of `speed.py`; the mirror says how often their loops turn for glyphs
of DejaVu Sans in the views of `speed.py`; a model of the GPU multiplies the two (README.md says what it leaves out).
"""

import argparse
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from math import isqrt
from statistics import mean
from typing import Final

import corpora
from report import cell, table, write_json
from speed import TEXT, views_of
from targets import Target, target_facts, target_table
from vexture.drawing.drawing import Drawing
from vexture.thesis.shader_text import FOLD_HEIGHT, TextureSizes
from vexture_evidence.measures.bands import BANDS, band_texture
from vexture_evidence.measures.gpu_compiler import CompiledShader, Toolchain, ToolchainError, toolchain
from vexture_evidence.measures.gpu_model import (
    FAMILIES,
    ONCE,
    Cycles,
    ScopedProgram,
    ScopeShape,
    per_pixel,
    read_program,
)
from vexture_evidence.measures.gpu_turns import SIDE, Turns, band_lane, packed_lane, run_waves
from vexture_evidence.measures.machine import machine_facts, machine_line
from vexture_evidence.measures.programs import (
    band_source,
    fetch_source,
    packed_source,
    packed_texture,
    thesis_source,
)

THESIS_LEVELS: Final = 10
"""Quads on the longest path of the example shapes."""

SOURCES: Final = {
    "flat": packed_source(is_flat=True),
    "any": packed_source(),
    "thesis": thesis_source(TextureSizes(THESIS_LEVELS, FOLD_HEIGHT)),
    "bands": band_source(BANDS),
    "fetch": fetch_source(),
}

SHAPES: Final = {
    "flat": ScopeShape("cells*(descend(quads*?) quad? leaf?(pieces* close*(steps)))"),
    "any": ScopeShape("cells*(descend(quads*?) cut? quad? leaf?(pieces*(edge?) close*(steps parts)) more?)"),
    "bands": ScopeShape("inside*?(level*(level_ahead?(level_crossed?)) upright*(upright_ahead?(upright_crossed?)))"),
}
"""Loops of the programs that are modelled."""

PACKED: Final = tuple(SHAPES["any"].parents)
"""Columns of the tables: the scopes of `any`, which has all of those of `flat`."""

JUDGED: Final = "RDNA2"
STATISTICS: Final = {"flat": ((450, 300), (56, 40)), "any": ((700, 500), (72, 56))}
"""Instructions and registers there: at least and aim."""

TIMES: Final = {
    "whole": ("flat", 1.3, 1.0),
    "zoom": ("flat", 1.3, 1.0),
    "small": ("flat", 2.2, 1.5),
    "tilted": ("any", 1.5, 1.2),
}
"""Time over that of the bands there, by views: the program that draws the view, at least and aim."""

ShadersByFamily = Mapping[str, Mapping[str, CompiledShader]]
TurnsByView = Mapping[str, Mapping[str, Turns]]


@dataclass(frozen=True, slots=True)
class Cost:
    """Cycles of a compute unit for a pixel, by what they are spent on, and those of a wave by scopes."""

    gpu: str
    view: str
    program: str
    cycles: Mapping[str, float]
    parts: Mapping[str, Cycles]

    @property
    def most(self) -> float:
        """Cycles if all else is hidden behind the largest part."""
        return max(self.cycles.values())

    @property
    def sum(self) -> float:
        """Cycles if nothing is hidden."""
        return sum(self.cycles.values())


def compile_programs(tools: Toolchain) -> dict[str, dict[str, CompiledShader]]:
    """Compile every program for every family."""
    return {
        kind: {name: tools.compile_shader(name, source, family.name) for name, source in SOURCES.items()}
        for kind, family in FAMILIES.items()
    }


def corners(tile: tuple[int, int], most: int) -> Iterator[tuple[int, int]]:
    """First pixels of waves that are spread evenly over a picture: as many as it has, or fewer.

    Examples
    --------
    >>> list(corners((64, 16), 4))
    [(16, 0), (48, 0), (16, 8), (48, 8)]
    """
    counts = [side // SIDE for side in tile]
    columns, rows = (
        [(2 * k + 1) * count // (2 * min(count, isqrt(most))) * SIDE for k in range(min(count, isqrt(most)))]
        for count in counts
    )
    return ((column, row) for row in rows for column in columns)


def programs_of(view: str) -> list[str]:
    """Names of the programs that can draw a view."""
    return [name for name in SHAPES if name != "flat" or TIMES[view][0] == "flat"]


def count_turns(drawings: Sequence[Drawing], waves: int, seed: int) -> dict[str, dict[str, Turns]]:
    """Count the turns of the loops of each program in each view."""
    found = {view: {name: Turns(SHAPES[name]) for name in programs_of(view)} for view in TIMES}
    for drawing in drawings:
        packed, bands = packed_texture(drawing), band_texture(drawing, BANDS)
        for view, (seen, tile) in views_of(drawing, seed).items():
            for name, turns in found[view].items():
                if name == "bands":
                    lane = band_lane(turns, bands, seen.to_unit)
                else:
                    lane = packed_lane(turns, packed, seen.to_unit, is_flat=name == "flat")
                run_waves(turns, lane, corners(tile, waves))
    return found


def read_programs(shaders: ShadersByFamily) -> dict[str, dict[str, ScopedProgram]]:
    """Read the assembly of the modelled programs, for every family."""
    return {
        kind: {name: read_program(name, of[name].assembly, shape) for name, shape in SHAPES.items()}
        for kind, of in shaders.items()
    }


def program_costs(
    shaders: ShadersByFamily, programs: Mapping[str, Mapping[str, ScopedProgram]], found: TurnsByView
) -> list[Cost]:
    """Modelled cycles of each program in each view, on each family."""
    rows = []
    for kind, family in FAMILIES.items():
        waves = {name: family.waves(shaders[kind][name].statistics["VGPRs"]) for name in SHAPES}
        for view, turns in found.items():
            for name, one in turns.items():
                parts = programs[kind][name].cycles(one.per_wave(), family)
                rows.append(Cost(kind, view, name, per_pixel(parts, waves[name], family), parts))
    return rows


def ratios(rows: Sequence[Cost]) -> dict[tuple[str, str, str], tuple[float, float]]:
    """Time over that of the bands, by family, view and program: of the most, and of the sums."""
    base = {(row.gpu, row.view): row for row in rows if row.program == "bands"}
    return {
        (row.gpu, row.view, row.program): (
            row.most / base[row.gpu, row.view].most,
            row.sum / base[row.gpu, row.view].sum,
        )
        for row in rows
    }


def targets(shaders: ShadersByFamily, rows: Sequence[Cost]) -> list[Target]:
    """Targets for sizes and times."""
    reached = []
    for name, limits in STATISTICS.items():
        for key, (least, aim) in zip(("Instructions", "VGPRs"), limits, strict=True):
            reached.append(Target(f"{JUDGED}, {name}: {key}", shaders[JUDGED][name].statistics[key], least, aim))
    over = ratios(rows)
    for view, (name, least, aim) in TIMES.items():
        reached.append(Target(f"{JUDGED}, {view}: {name} over bands", mean(over[JUDGED, view, name]), least, aim))
    return reached


def statistics_table(shaders: ShadersByFamily) -> str:
    """Table of the driver's statistics of the programs."""
    rows = []
    for kind, programs in shaders.items():
        for name, one in programs.items():
            registers = one.statistics["VGPRs"]
            shown = (one.statistics["Instructions"], one.statistics["Code size"], registers)
            rows.append([kind, name, *map(str, shown), str(FAMILIES[kind].waves(registers))])
    return table(("GPU", "program", "instructions", "bytes", "VGPRs", "waves"), rows)


def turns_table(found: TurnsByView, names: Sequence[str], columns: Sequence[str]) -> str:
    """Table of the turns of loops."""
    rows = []
    for view, turns in found.items():
        for name in (name for name in names if name in turns):
            for per, means in (("wave", turns[name].per_wave()), ("pixel", turns[name].per_pixel())):
                rows.append([view, name, per, *(cell(means.get(column)) for column in columns)])
    return table(("view", "program", "per", *columns), rows)


def times_table(rows: Sequence[Cost]) -> str:
    """Table of the modelled cycles."""
    over = ratios(rows)
    shown = []
    for row in rows:
        most, whole = over[row.gpu, row.view, row.program]
        ends = (row.most, most, row.sum, whole, mean((most, whole)))
        shown.append([row.gpu, row.view, row.program, *map(cell, row.cycles.values()), *map(cell, ends)])
    head = ("GPU", "view", "program", *rows[0].cycles, "most", "/bands", "sum", "/bands", "middle")
    return table(head, shown)


def shares_table(rows: Sequence[Cost]) -> str:
    """Table of the cycles of the packed programs by scope."""
    shown = []
    for row in (row for row in rows if row.program != "bands"):
        for kind, of in (("valu", "valu"), ("waiting", "alone")):
            spent = {name: getattr(part, of) for name, part in row.parts.items()}
            shares = (
                f"{100 * spent[name] / sum(spent.values()):.0f}" if name in spent else "-" for name in (ONCE, *PACKED)
            )
            shown.append([row.gpu, row.view, row.program, kind, *shares])
    return table(("GPU", "view", "program", "% of", ONCE, *PACKED), shown)


def main() -> None:
    parser = argparse.ArgumentParser(description="What the shaders cost on GPUs that need not be there.")
    parser.add_argument("--quick", action="store_true", help="three glyphs, fewer waves")
    parser.add_argument("--waves", type=int, default=256, help="waves of a view whose turns are counted, at most")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    try:
        with toolchain() as tools:
            made = compile_programs(tools)
    except ToolchainError as error:
        print(f"skipped: {error}")
        return
    programs = read_programs(made)
    text, waves = (TEXT[:3], arguments.waves // 4) if arguments.quick else (TEXT, arguments.waves)
    found = count_turns(corpora.glyphs(corpora.dejavu_sans(), text), waves, arguments.seed)
    rows = program_costs(made, programs, found)
    reached = targets(made, rows)
    machine, driver = machine_facts(), made[JUDGED]["any"].driver
    shown = (
        statistics_table(made),
        turns_table(found, ("flat", "any"), PACKED),
        turns_table(found, ("bands",), tuple(SHAPES["bands"].parents)),
        times_table(rows),
        shares_table(rows),
        target_table(reached),
        driver + "\n" + machine_line(machine),
    )
    print("\n\n".join(shown))
    facts = {
        "machine": machine,
        "driver": driver,
        **vars(arguments),
        "statistics": {kind: {name: one.statistics for name, one in of.items()} for kind, of in made.items()},
        "turns": {
            view: {name: {"wave": one.per_wave(), "pixel": one.per_pixel()} for name, one in turns.items()}
            for view, turns in found.items()
        },
        "costs": [asdict(row) for row in rows],
        "targets": target_facts(reached),
    }
    print(write_json("gpu_cost", facts))


if __name__ == "__main__":
    main()
