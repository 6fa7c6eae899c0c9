"""Correct reading, conversion and drawing of real files: tests of the W3C, clip art, icons, glyphs, coastlines.

    python packages/vexture-evidence/benchmarks/sweep.py [CORPUS ...] [--count N] [--seed 1] [--quick]

Each file is read, converted and saved, its texture compared with exact coverage, and its reading with resvg's and
Skia's (`judge.py`). `sweep_known.toml` explains every file that is wrong without a note of the drawing. The sweep fails
for one that is not listed, and for one that is listed and right.
"""

import argparse
import os
import sys
import tempfile
import tomllib
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from importlib.metadata import version
from pathlib import Path
from queue import SimpleQueue
from typing import Final

from rich.console import Console
from rich.progress import track

from judge import READING_LIMIT, TEXTURE_LIMIT, Case, Child, Facts, stages
from report import table, write_json
from same_fonts import gather, only_these
from sweep_corpora import CORPORA
from vexture.base.errors import VextureError
from vexture_evidence.measures.machine import machine_facts, machine_line

KNOWN: Final = Path(__file__).with_name("sweep_known.toml")
REFERENCES: Final = ("resvg", "skia-python")
PROCESSES: Final = 2
QUICK: Final = 20
"""Files of each corpus."""

SLOW: Final = 3.0
"""Seconds of the processor from file to file."""

OUTCOMES: Final = ("right", "warned", "silent", "refused", "died", "unjudged")
"""The same as the references; wrong with a note of the drawing; wrong without; a one-line error; a crash, no memory, no
answer or an exception that is a bug; no reference draws it."""

FAULTS: Final = ("silent", "died")
"""Outcomes that must be known."""


def outcome_of(facts: Facts) -> str:
    """Outcome of a case, one of `OUTCOMES`."""
    if facts.get("texture", 0.0) > TEXTURE_LIMIT:
        return "silent"
    if "refused" in facts:
        return "refused"
    if "broken" in facts or ("died" in facts and "texture" not in facts):
        return "died"
    if "resvg" not in facts:
        return "unjudged"
    if min(facts["resvg"], facts.get("skia", 1.0)) <= READING_LIMIT:
        return "right"
    return "warned" if facts["notes"] else "silent"


def judge_cases(cases: Sequence[Case], find: Callable[[Case], Iterator[Facts]] = stages) -> Iterator[Facts]:
    """Judge cases in child processes; a new process replaces one that died."""
    spare: SimpleQueue[Child] = SimpleQueue()

    def judge(case: Case) -> Facts:
        child = spare.get()
        facts = child.judge(case)
        spare.put(Child(find) if "died" in facts else child)
        return facts

    try:
        for _ in range(PROCESSES):
            spare.put(Child(find))
        with ThreadPoolExecutor(PROCESSES) as pool:
            yield from pool.map(judge, cases)
    finally:
        while not spare.empty():
            spare.get().close()


def known_issues(path: Path = KNOWN) -> dict[tuple[str, str], str]:
    """Reason of each file that is known to be wrong in silence, by its corpus and name."""
    listed = tomllib.loads(path.read_text())["issue"]
    return {(issue["corpus"], name): issue["reason"] for issue in listed for name in issue["files"]}


def faults(found: Iterable[tuple[str, str, str]], known: Iterable[tuple[str, str]]) -> list[str]:
    """Lines that fail the sweep, of corpus, name and outcome of each file.

    Examples
    --------
    >>> faults([("w3c", "a.svg", "silent"), ("w3c", "b.svg", "right")], [("w3c", "b.svg"), ("w3c", "c.svg")])
    ['w3c a.svg: silent, and not listed in sweep_known.toml', 'w3c b.svg: right now; take it out of sweep_known.toml']
    """
    listed, lines = set(known), []
    for corpus, name, outcome in found:
        if outcome in FAULTS and (corpus, name) not in listed:
            lines.append(f"{corpus} {name}: {outcome}, and not listed in {KNOWN.name}")
        if outcome not in FAULTS and (corpus, name) in listed:
            lines.append(f"{corpus} {name}: {outcome} now; take it out of {KNOWN.name}")
    return lines


def row(corpus: str, found: Sequence[Facts]) -> list[str]:
    """Row of the table: how many files have each outcome, and the slowest."""
    counts = Counter(facts["outcome"] for facts in found)
    slowest = max(found, key=lambda facts: facts.get("seconds", 0.0))
    seconds = slowest.get("seconds", 0.0)
    slow = sum(facts.get("seconds", 0.0) > SLOW for facts in found)
    counted = [str(counts[outcome]) for outcome in OUTCOMES]
    return [corpus, str(len(found)), *counted, str(slow), f"{seconds:.2f}", Path(slowest["name"]).name]


def sweep_corpus(corpus: str, cases: Sequence[Case]) -> list[Facts]:
    shown = track(judge_cases(cases), corpus, total=len(cases), console=Console(stderr=True), transient=True)
    return [
        {"name": case.name, "outcome": outcome_of(facts), **facts} for case, facts in zip(cases, shown, strict=True)
    ]


def parse_options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Whether real drawings are read, converted and drawn right.")
    parser.add_argument("corpus", nargs="*", choices=[*CORPORA, []], help="by default all")
    parser.add_argument("--count", type=int, help="files of each corpus")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--quick", action="store_true", help=f"{QUICK} files of each corpus")
    arguments = parser.parse_args()
    if arguments.quick:
        arguments.count = QUICK
    return arguments


def main() -> None:
    arguments, sets, missing = parse_options(), {}, []
    with tempfile.TemporaryDirectory() as folder:
        os.environ["FONTCONFIG_FILE"] = str(only_these(gather(Path(folder))))  # the fonts of ours and of resvg
        for corpus in arguments.corpus or CORPORA:
            try:
                sets[corpus] = sweep_corpus(corpus, CORPORA[corpus](arguments.seed, arguments.count))
            except VextureError as error:
                missing.append(f"{corpus} is missing: {error}")
    head = ("corpus", "files", *OUTCOMES, f"over {SLOW:g} s", "slowest, s", "its name")
    print(table(head, [row(corpus, found) for corpus, found in sets.items()]))
    wrong = faults(
        [(corpus, facts["name"], facts["outcome"]) for corpus, found in sets.items() for facts in found],
        known_issues(),
    )
    machine = {**machine_facts(), **{name: version(name) for name in REFERENCES}}
    print(*missing, *wrong, f"{machine_line(machine)}, {', '.join(f'{n} {machine[n]}' for n in REFERENCES)}", sep="\n")
    print(write_json("sweep", {**vars(arguments), "machine": machine, "missing": missing, "sets": sets}))
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
