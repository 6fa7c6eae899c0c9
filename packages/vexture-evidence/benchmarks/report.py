"""Output of every benchmark: one table on the terminal, one JSON file in the folder `results` beside them."""

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from vexture_evidence.measures.machine import machine_facts, machine_line
from vexture_evidence.report.page import known

RESULTS = Path(__file__).parent / "results"


def cell(value: Any, digits: int = 2) -> str:
    """Format a value for a table; an unknown value is a dash."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "-"
    return f"{value:.{digits}f}" if isinstance(value, float) else str(value)


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Text of a table: the first column to the left, the others to the right.

    Examples
    --------
    >>> print(table(("shape", "ms"), [("duck", "1.5"), ("cake", "12.0")]))
    shape    ms
    -----------
    duck    1.5
    cake   12.0
    """
    widths = [max(map(len, column)) for column in zip(head, *rows, strict=True)]
    lines = [
        "  ".join([row[0].ljust(widths[0]), *(text.rjust(w) for text, w in zip(row[1:], widths[1:], strict=True))])
        for row in (head, *rows)
    ]
    return "\n".join([lines[0], "-" * len(lines[0]), *lines[1:]])


def write_json(name: str, facts: Any) -> Path:
    """Write facts to `packages/vexture-evidence/benchmarks/results`; what is not a number becomes null."""
    RESULTS.mkdir(exist_ok=True)
    path = RESULTS / f"{name}.json"
    path.write_text(json.dumps(known(facts), indent=1, allow_nan=False) + "\n")
    return path


def write_figures(name: str, figures: Mapping[str, float], goals: Mapping[str, float]) -> None:
    """Print figures beside the most that each may be, and the machine; write them as JSON."""
    facts = machine_facts()
    rows = [
        (key, f"{value:.1f}" if isinstance(value, float) else str(value), f"{goals[key]:.0f}" if key in goals else "")
        for key, value in figures.items()
    ]
    print(table(("figure", "measured", "at most"), rows))
    print(machine_line(facts))
    print(write_json(name, {"machine": facts, "goals": goals, **figures}))
