"""Random drawings in random views: the texture's picture against the exact renderer's (`comparison`).

    export PYTHONPATH=tests:packages/vexture-evidence/benchmarks
    .venv/bin/python tests/fuzz/pictures.py --views 500 --seed 1 --gradients both
    .venv/bin/python tests/fuzz/pictures.py fuzz-findings/pictures/NAME.svg

The first prints a line for each view with a pixel beyond 2/255, writes it minimised to fuzz-findings/pictures/ and ends
with the figures; it exits with 1 if there is a finding. The second compares such files again.
"""

import argparse
import json
import re
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict, dataclass, field
from itertools import pairwise
from pathlib import Path
from time import time
from typing import Any

from comparison import MOST, SHARE, Case, SlowError, case_of, compare
from crew import answers
from minimise import minimise_svg

from vexture.base.errors import EXPECTED

FOLDER = Path("fuzz-findings") / "pictures"
BOUNDS = (0.25, 0.5, 1.0, 2.0, 5.0, 20.0, 100.0)
"""Of 255: classes of the histogram."""

FAR = 20.0
SAME = 0.5
"""Part of a difference that a smaller drawing must keep."""

FEATURES = {
    "linear": r"<linearGradient",
    "radial": r"<radialGradient",
    "repeat": r'spreadMethod="repeat"',
    "reflect": r'spreadMethod="reflect"',
    "focal": r'\bf[xyr]="',
    "hard stop": r'offset="([\d.]+)"[^>]*/><stop offset="\1"',
    "blend": r"mix-blend-mode",
    "mask": r"<mask",
    "clip": r"<clipPath",
    "dashes": r"stroke-dasharray",
    "stroke": r"stroke=",
    "text": r"<text",
}


def examine_seed(job: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield the facts about a seed: the comparison, and then the finding, if it is one."""
    try:
        case = case_of(job["seed"], job["gradients"])
        if case is None:
            yield {"empty": True}
            return
        found = compare(case, job["renderer"])
    except SlowError:
        yield {"too slow": True}
        return
    except EXPECTED as error:
        yield {"refused": f"{type(error).__name__}: {error}"}
        return
    told = {"gap": found.gap, "sight": case.sight.name, "size": case.sight.size, "seconds": found.seconds}
    yield told | {"file": case.file().decode()} if found.gap > MOST else told
    if found.gap > MOST and job["minimise"]:
        smaller = smallest(case, found.gap, job["renderer"], job["minimise"])
        yield {"minimised": smaller.file().decode()} | finding_of(smaller, job["renderer"])


def smallest(case: Case, gap: float, renderer: str = "cpu", seconds: float = 60.0) -> Case:
    """The smallest drawing found that shows at least half of the difference, in the same view."""
    least = max(MOST, SAME * gap)

    def shows(svg: str) -> bool:
        try:
            return compare(Case(svg, case.sight), renderer).gap > least
        except (SlowError, *EXPECTED):
            return False

    return Case(minimise_svg(case.svg, shows, seconds), case.sight)


def finding_of(case: Case, renderer: str = "cpu") -> dict[str, Any]:
    """The worst pixel of a case, and what kind it is."""
    found = compare(case, renderer)
    kinds = [name for name, pattern in FEATURES.items() if re.search(pattern, case.svg)]
    if found.gap > MOST and compare(case, renderer, share=SHARE / 10).gap <= MOST:
        kinds.append("only of a coarse texture")
    return {"kinds": kinds, "view": case.sight.name, **asdict(found)}


def describe_finding(finding: dict[str, Any], size: int) -> str:
    """One line: what differs, where, and by how much."""
    return (
        f"{', '.join(finding['kinds']) or 'plain'} ({finding['view']}): {finding['gap']:.1f}/255 at {finding['place']} "
        f"of {size} px, {finding['beyond']} pixels, {finding['ours']} instead of {finding['exact']}"
    )


@dataclass
class Figures:
    """What came of the views without or with gradients."""

    gaps: list[float] = field(default_factory=list)
    worst: str = ""
    failures: Counter[str] = field(default_factory=Counter)
    seconds: Counter[str] = field(default_factory=Counter)
    kinds: Counter[str] = field(default_factory=Counter)

    def add(self, seed: str, facts: dict[str, Any]) -> None:
        """Count the facts about a seed."""
        if "sight" in facts:
            if facts["gap"] >= max(self.gaps, default=0.0):
                self.worst = f"seed {seed}, {facts['sight']}"
            self.gaps.append(facts["gap"])
            self.seconds.update(facts["seconds"])
        elif "kinds" in facts:
            self.kinds[f"{', '.join(facts['kinds']) or 'plain'} ({facts['view']})"] += 1
        else:
            self.failures[next(iter(facts))] += 1

    def text(self, name: str) -> str:
        """Lines of a summary."""
        count, bounds = len(self.gaps), (0.0, *BOUNDS, float("inf"))
        beyond = sum(gap > MOST for gap in self.gaps)
        far = sum(gap > FAR for gap in self.gaps)
        classes = [f"{sum(low <= gap < high for gap in self.gaps)} below {high:g}" for low, high in pairwise(bounds)]
        spent = ", ".join(f"{part} {seconds:.1f} s" for part, seconds in sorted(self.seconds.items()))
        lines = [
            f"{name}: {count} views, {beyond} beyond {MOST:g}/255 ({100 * beyond / max(count, 1):.1f} %), {far} beyond "
            f"{FAR:g}, the worst {max(self.gaps, default=0.0):.2f}/255 ({self.worst})",
            f"  not compared: {', '.join(f'{k} {v}' for k, v in sorted(self.failures.items())) or 'none'}",
            f"  differences of 255: {', '.join(classes)}",
            f"  processor: {spent}",
        ]
        return "\n".join(lines + [f"  {number} of {kind}" for kind, number in self.kinds.most_common()])


def keep(name: str, facts: dict[str, Any]) -> str:
    """Write a finding, or a view that ended its process; the line that tells of it."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    path = FOLDER / f"{name}.svg"
    file = facts.pop("minimised", None) or facts.pop("file")
    path.write_text(file, encoding="utf-8")
    if "kinds" not in facts:
        return f"{path}: {facts['gap']:.1f}/255 ({facts['sight']})"
    line = describe_finding(facts, Case.parsed(file.encode()).sight.size)
    path.with_suffix(".txt").write_text(f"{line}\n{json.dumps(facts)}\n", encoding="utf-8")
    return f"{path}: {line}"


def campaign(options: argparse.Namespace) -> int:
    """Compare so many views; the number of those with a finding."""
    wanted = {"both": (False, True), "none": (False,), "only": (True,)}[options.gradients]
    figures = {kind: Figures() for kind in wanted}
    jobs = (
        {"seed": f"{options.seed}-{k}", "gradients": kind, "renderer": options.renderer, "minimise": options.minimise}
        for k in range(options.views)
        for kind in wanted
    )
    start = time()
    for job, facts in answers("pictures", jobs, options.processes, options.limit):
        name, figure = f"{job['seed']}{'-gradients' if job['gradients'] else ''}", figures[job["gradients"]]
        figure.add(job["seed"], facts)
        if "file" in facts or "minimised" in facts:
            print(keep(name, facts), flush=True)
        elif "gap" not in facts and "empty" not in facts:
            print(f"{name}: {facts}", flush=True)
    took, count = time() - start, sum(len(figure.gaps) for figure in figures.values())
    for kind, figure in figures.items():
        print(figure.text("with gradients" if kind else "without gradients"))
    print(f"{count / took / options.processes:.2f} views a second and process, {took:.0f} s")
    return sum(gap > MOST for figure in figures.values() for gap in figure.gaps)


def compare_again(files: list[str], renderer: str) -> int:
    """Compare files of findings again; return the number that still are findings."""
    found = 0
    for file in files:
        case = Case.parsed(Path(file).read_bytes())
        finding = finding_of(case, renderer)
        print(f"{file}: {describe_finding(finding, case.sight.size)}", flush=True)
        found += finding["gap"] > MOST
    return found


def main() -> int:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", help="findings to be compared again")
    parser.add_argument("--views", type=int, default=100, help="of each kind")
    parser.add_argument("--seed", default="1")
    parser.add_argument("--gradients", choices=("both", "none", "only"), default="both")
    parser.add_argument("--renderer", choices=("cpu", "gpu"), default="cpu")
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--limit", type=float, default=30.0, help="seconds of the processor for a view")
    parser.add_argument("--minimise", type=float, default=60.0, help="seconds of the processor for a finding; 0: none")
    options = parser.parse_args()
    return (compare_again(options.files, options.renderer) if options.files else campaign(options)) > 0


if __name__ == "__main__":
    sys.exit(main())
