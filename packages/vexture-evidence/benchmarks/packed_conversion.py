"""Time and memory to convert drawings to packed textures.

    python packages/vexture-evidence/benchmarks/packed_conversion.py [--quick] [--repeat 15] [--seed 1]

One thread. *Glyphs* and *coastlines* go from outlines in memory to one texture in memory (tree, coverage, texels: all
of it), *icons* from their SVG files to the bytes of a file. Times are medians of a warm process but for the last table,
which starts a process for each figure: with the compiled kernels in their cache, and without. Memory is the peak of
resident memory (Linux's VmHWM, set back before) while a coastline is converted, above what it was before, in a process
of its own that has converted another one.
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
import warnings
from collections.abc import Sequence
from pathlib import Path
from statistics import median
from typing import Any, Final

import corpora
from report import cell, table, write_json
from targets import Target, target_facts, target_table
from vexture.base.errors import SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.svg.read import read_svg
from vexture.texture.encode import encode
from vexture.texture.texture import Root, Texture
from vexture.tree.build import build_tree
from vexture.tree.tree import Tree
from vexture_evidence.measures.machine import machine_facts, machine_line
from vexture_evidence.measures.timing import median_seconds

EDGES: Final = (768, 12_288, 98_304)
ICONS: Final = 150
"""Of each of two sets."""

GLYPH: Final = """
import corpora, packed_conversion
packed_conversion.atlas(corpora.glyphs(corpora.dejavu_sans(), "g"))
"""

COASTLINE: Final = """
import corpora, packed_conversion
packed_conversion.atlas([corpora.fractal_coastline(768, 1)])
island = corpora.fractal_coastline({edges}, 1)
before = packed_conversion.peak_memory(reset=True)
packed_conversion.atlas([island])
print(packed_conversion.peak_memory() - before)
"""


def atlas(drawings: Sequence[Drawing], **parameters: Any) -> Texture:
    """One packed texture of some drawings; parameters of `build_tree`."""
    trees = [build_tree(drawing, **parameters) for drawing in drawings]
    return join_trees(trees, drawings)


def join_trees(trees: Sequence[Tree], drawings: Sequence[Drawing]) -> Texture:
    """Join trees in one packed texture."""
    return encode(trees, [Root(drawing.name) for drawing in drawings], name="atlas")


def batch_facts(name: str, drawings: Sequence[Drawing], repeat: int) -> dict[str, Any]:
    """Times of a batch, and of the tree alone."""
    whole = median_seconds(lambda: atlas(drawings), repeat)
    trees = median_seconds(lambda: [build_tree(drawing) for drawing in drawings], repeat)
    edges = sum(drawing.segments for drawing in drawings)
    return {
        "batch": name,
        "drawings": len(drawings),
        "edges": edges,
        "ms": 1e3 * whole / len(drawings),
        "tree_ms": 1e3 * trees / len(drawings),
        "edges_per_second": edges / whole,
    }


def icon_facts(name: str, paths: Sequence[Path], repeat: int) -> dict[str, Any]:
    """Times of a batch of SVG files, each to the bytes of its own file; and of their trees and texels alone."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        drawings = [read_svg(path) for path in paths]
        whole = median_seconds(lambda: [atlas([read_svg(path)]).to_ktx2() for path in paths], repeat)
    return {**batch_facts(name, drawings, repeat), "file_ms": 1e3 * whole / len(paths)}


def run_fresh(code: str, cache: str | None = None) -> str:
    """Run code in a fresh process, with a folder for compiled kernels if one is given; return its output."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, [Path(__file__).parent, *sys.path[1:]]))}
    if cache is not None:
        environment["VEXTURE_CACHE"] = cache
    outcome = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    return outcome.stdout


def fresh_seconds(code: str, cache: str | None = None) -> float:
    """Seconds of a fresh process, from its start to its end."""
    start = time.perf_counter()
    run_fresh(code, cache)
    return time.perf_counter() - start


def peak_memory(reset: bool = False) -> int:
    """Most resident memory of this process, in kilobytes, since its start or the last reset."""
    if reset:
        Path("/proc/self/clear_refs").write_text("5")
    status = Path("/proc/self/status").read_text()
    return int(re.findall(r"VmHWM:\s+(\d+) kB", status)[0])


def peak_of(edges: int) -> float | None:
    """Megabytes by which resident memory grows while a coastline is converted; None if that is unknown."""
    if not Path("/proc/self/clear_refs").exists():
        return None
    return float(run_fresh(COASTLINE.format(edges=edges))) / 1024.0


def start_facts(repeat: int) -> dict[str, float]:
    """Seconds of whole processes that convert one glyph; *imports* converts none."""
    with tempfile.TemporaryDirectory() as empty:
        compiled = fresh_seconds(GLYPH, empty)
    return {
        "imports": median(fresh_seconds("import corpora, packed_conversion") for _ in range(repeat)),
        "cached": median(fresh_seconds(GLYPH) for _ in range(repeat)),
        "compiled": compiled,
    }


HEAD = ("batch", "drawings", "edges", "ms each", "tree alone", "file to file", "edges/s", "peak MB")


def line(facts: dict[str, Any]) -> list[str]:
    """Row of a batch."""
    return [
        facts["batch"],
        str(facts["drawings"]),
        str(facts["edges"]),
        cell(facts["ms"], 3),
        cell(facts["tree_ms"], 3),
        cell(facts.get("file_ms"), 3),
        f"{facts['edges_per_second']:,.0f}",
        cell(facts.get("peak_mb"), 1),
    ]


def targets(batches: Sequence[dict[str, Any]]) -> list[Target]:
    """Targets for times and memory."""
    glyphs = [facts["ms"] for facts in batches if "a-zA-Z0-9" in facts["batch"]]
    largest = max((facts for facts in batches if "peak_mb" in facts), key=lambda facts: facts["edges"])
    millions = largest["edges_per_second"] / 1e6
    return [
        Target("ms for a glyph in a batch", max(glyphs), 0.1, 0.03),
        Target(f"million edges/s, {largest['edges']:,} edges", millions, 0.3, 2.0, larger=True),
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description="Times and memory of the conversion to packed textures.")
    parser.add_argument("--quick", action="store_true", help="fewer icons and repetitions")
    parser.add_argument("--repeat", type=int, default=15, help="conversions that a median is taken of")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    repeat, count = (3, 10) if arguments.quick else (arguments.repeat, ICONS)
    batches = []
    for name, font in (("DejaVu Sans", corpora.dejavu_sans()), ("STIX", corpora.stix())):
        batches.append(batch_facts(f"{name} a-zA-Z0-9", corpora.glyphs(font, corpora.ALPHANUMERICS), repeat))
    for edges in EDGES:
        island = corpora.fractal_coastline(edges, arguments.seed)
        batches.append({**batch_facts(island.name, [island], repeat), "peak_mb": peak_of(edges)})
    for name, choose in (("mdi", corpora.mdi), ("simple-icons", corpora.simple_icons)):
        batches.append(icon_facts(name, choose(count, arguments.seed), min(repeat, 3)))
    starts = start_facts(min(repeat, 5))
    reached, machine = targets(batches), machine_facts()
    print(table(HEAD, [line(facts) for facts in batches]))
    print()
    print(table(("a process that converts one glyph", "seconds"), [[name, cell(s)] for name, s in starts.items()]))
    print("\n".join(["", target_table(reached), "", machine_line(machine)]))
    facts = {"machine": machine, **vars(arguments), "batches": batches, "starts": starts}
    print(write_json("packed_conversion", {**facts, "targets": target_facts(reached)}))


if __name__ == "__main__":
    main()
