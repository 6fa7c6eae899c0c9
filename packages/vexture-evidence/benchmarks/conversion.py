"""Sizes and times of the conversion of the thesis's examples, beside its Table 5.1.

    python packages/vexture-evidence/benchmarks/conversion.py [--repeat 50] [--quick]

Every drawing of the table is converted by both strategies, 16 bits unless said otherwise. Sizes are in bytes: of the
SVG file, of its path data alone, and of both texture files together. Times are medians in ms, with the kernels
compiled and the file cached: *files* from the SVG file to the texture files, parsing and PNG included; *tree* of the
quad-tree and its leaves alone; *sampled* the whole way by that strategy. Every time the files get new names: to replace
a file that exists, some file systems wait for the disk (ext4, for up to 8 ms).
"""

import argparse
import tempfile
from collections.abc import Callable, Iterable, Sequence
from itertools import count
from pathlib import Path
from typing import Any, Literal, NamedTuple

from lxml import etree

from report import table, write_json
from vexture.conversion.pipeline import convert, run_encoding
from vexture.svg.read import read_svg
from vexture.thesis.build import build
from vexture.thesis.encode import quantisation_step
from vexture_evidence.measures.machine import machine_facts, machine_line
from vexture_evidence.measures.thesis_numbers import TABLE_5_1
from vexture_evidence.measures.timing import median_seconds

Strategy = Literal["direct", "sampled"]

SHAPES = Path(__file__).parents[3] / "examples" / "shapes"
REPEAT, REPEAT_SAMPLED = 50, 5


ORDER = 2.0  # sampled may differ from Table 5.1 by this factor, either way: the drawings are not the thesis's
CORNERLESS = ("ocean",)
SHARE_WITH_CORNERS = 0.5  # of sampled's curves that direct may need on the others
NO_LARGER = 9  # shapes, at least, whose 8-bit pair is no larger than the SVG
FILES_MS, TREE_MS = 10.0, 1.0


class Check(NamedTuple):
    """A limit, and the shapes beyond it."""

    limit: str
    missed: list[str]
    allowed: int = 0

    @property
    def met(self) -> bool:
        """Whether at most `allowed` shapes are beyond the limit."""
        return len(self.missed) <= self.allowed


def path_bytes(svg: Path) -> int:
    """Bytes of the path data of a drawing, each run of spaces counted as one."""
    paths = etree.parse(svg).iter("{*}path")
    return sum(len(" ".join(path.get("d", "").split())) for path in paths)


def sizes(svg: Path, strategy: Strategy, bits: int) -> dict[str, int]:
    """Curves, quads and bytes of the pair of files that a drawing becomes."""
    conversion = run_encoding(svg, "thesis", strategy=strategy, bits=bits)
    return {
        "curves": len(conversion.tree.curves),
        "quads": len(conversion.tree.kind),
        "bytes": sum(map(len, conversion.texture.to_png())),
    }


def median_ms(action: Callable[[], object], repeat: int) -> float:
    """Median time of an action, once warm."""
    return 1000.0 * median_seconds(action, repeat)


def size_facts(name: str) -> dict[str, Any]:
    """Sizes of one drawing and of its textures, and the thesis's numbers for its namesake."""
    svg = SHAPES / f"{name}.svg"
    return {
        "shape": name,
        "segments": read_svg(svg).segments,
        "svg_bytes": svg.stat().st_size,
        "path_bytes": path_bytes(svg),
        "direct": sizes(svg, "direct", 16),
        "direct_8": sizes(svg, "direct", 8),
        "sampled": sizes(svg, "sampled", 16),
        "thesis": TABLE_5_1[name]._asdict(),
    }


def time_facts(name: str, repeat: int, folder: Path) -> dict[str, float]:
    """Times of one drawing's conversion."""
    svg = SHAPES / f"{name}.svg"
    drawing, step = read_svg(svg), quantisation_step(16)
    places = (folder / f"{name}-{number}" for number in count())

    def files(strategy: Strategy) -> None:
        convert(svg, encoding="thesis", strategy=strategy).save(next(places))

    return {
        "files_ms": median_ms(lambda: files("direct"), repeat),
        "tree_ms": median_ms(lambda: build(drawing, step=step), repeat),
        "sampled_ms": median_ms(lambda: files("sampled"), min(repeat, REPEAT_SAMPLED)),
    }


def of_that_order(facts: dict[str, Any]) -> bool:
    """Whether sampled has as many curves and quads as the thesis, within a factor."""
    ratios = [facts["sampled"][what] / facts["thesis"][what] for what in ("curves", "quads")]
    return all(1.0 / ORDER <= ratio <= ORDER for ratio in ratios)


def half_with_corners(facts: dict[str, Any]) -> bool:
    """Whether direct needs as few curves as it should where there are corners."""
    share = facts["direct"]["curves"] / facts["sampled"]["curves"]
    return facts["shape"] in CORNERLESS or share <= SHARE_WITH_CORNERS


def size_checks(shapes: Sequence[dict[str, Any]]) -> list[Check]:
    """Checks that do not depend on the machine."""

    def shapes_beyond(met: Callable[[dict[str, Any]], bool]) -> list[str]:
        return [facts["shape"] for facts in shapes if not met(facts)]

    return [
        Check("segments as in Table 5.1", shapes_beyond(lambda f: f["segments"] == f["thesis"]["segments"])),
        Check(f"sampled: curves and quads of Table 5.1, within a factor of {ORDER:g}", shapes_beyond(of_that_order)),
        Check(
            "direct: no more curves than sampled",
            shapes_beyond(lambda f: f["direct"]["curves"] <= f["sampled"]["curves"]),
        ),
        Check(
            f"direct: at most {SHARE_WITH_CORNERS:g} of sampled's curves, without {', '.join(CORNERLESS)}",
            shapes_beyond(half_with_corners),
        ),
        Check(
            f"8-bit pair no larger than the SVG, on {NO_LARGER} of {len(TABLE_5_1)}",
            shapes_beyond(lambda f: f["direct_8"]["bytes"] <= f["svg_bytes"]),
            len(TABLE_5_1) - NO_LARGER,
        ),
    ]


def time_checks(shapes: Sequence[dict[str, Any]]) -> list[Check]:
    """Checks that depend on the machine."""
    return [
        Check(f"files: at most {FILES_MS:g} ms", [f["shape"] for f in shapes if f["files_ms"] > FILES_MS]),
        Check(f"tree: at most {TREE_MS:g} ms", [f["shape"] for f in shapes if f["tree_ms"] > TREE_MS]),
    ]


HEAD = (
    "shape",
    "segments",
    "SVG",
    "path data",
    "8 bits",
    "16 bits",
    "thesis",
    "direct",
    "sampled",
    "thesis",
    "files ms",
    "tree ms",
    "sampled ms",
    "thesis ms",
)
LEGEND = "SVG to the first thesis: bytes; direct to the second thesis: curves/quads"


def line(facts: dict[str, Any]) -> list[str]:
    """The table's row of one drawing."""

    def counts(found: dict[str, Any]) -> str:
        return f"{found['curves']}/{found['quads']}"

    thesis = facts["thesis"]
    return [
        facts["shape"],
        str(facts["segments"]),
        str(facts["svg_bytes"]),
        str(facts["path_bytes"]),
        str(facts["direct_8"]["bytes"]),
        str(facts["direct"]["bytes"]),
        f"{thesis['bytes_8']}, {thesis['bytes_16']}",
        counts(facts["direct"]),
        counts(facts["sampled"]),
        counts(thesis),
        f"{facts['files_ms']:.1f}",
        f"{facts['tree_ms']:.2f}",
        f"{facts['sampled_ms']:.0f}",
        f"{thesis['ms']:.0f}",
    ]


def verdicts(found: Iterable[Check]) -> list[str]:
    """One line for each check."""
    return [
        f"{'met' if check.met else 'missed':6}  {check.limit}"
        + (f"; beyond it: {', '.join(check.missed)}" if check.missed else "")
        for check in found
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description="Sizes and times of the conversion of the thesis's examples.")
    parser.add_argument("--repeat", type=int, default=REPEAT, help="conversions that a median is taken of")
    parser.add_argument("--quick", action="store_true", help="few repetitions: whether it works, not how fast")
    arguments = parser.parse_args()
    if arguments.quick:
        arguments.repeat = min(arguments.repeat, 3)
    with tempfile.TemporaryDirectory() as folder:
        shapes = [size_facts(name) | time_facts(name, arguments.repeat, Path(folder)) for name in TABLE_5_1]
    found = [*size_checks(shapes), *time_checks(shapes)]
    machine = machine_facts()
    print(table(HEAD, [line(facts) for facts in shapes]))
    print("\n".join([LEGEND, "", *verdicts(found), "", machine_line(machine)]))
    judged = [{**check._asdict(), "met": check.met} for check in found]
    facts = {"machine": machine, "repeat": arguments.repeat, "shapes": shapes, "checks": judged}
    print(write_json("conversion", facts))


if __name__ == "__main__":
    main()
