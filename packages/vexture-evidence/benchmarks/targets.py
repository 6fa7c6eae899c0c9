"""Targets of measurements: the limit, the aim, and both printed beside the figure."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from report import cell, table


@dataclass(frozen=True, slots=True)
class Target:
    """A figure and its limits; smaller is better unless said otherwise.

    Parameters
    ----------
    measure : str
        Name of the figure, with its unit.
    figure : float or None
        The measured value; None if it could not be measured.
    least, aim : float
        The limit that it must reach, and the aim.
    larger : bool
        Whether larger is better.
    """

    measure: str
    figure: float | None
    least: float
    aim: float
    larger: bool = False

    def reaches(self, limit: float) -> bool:
        """Whether the figure is as good as a limit.

        Examples
        --------
        >>> Target("ms", 0.5, 1.0, 0.1).reaches(1.0), Target("edges/s", 2.0, 3.0, 9.0, larger=True).reaches(3.0)
        (True, False)
        """
        if self.figure is None:
            return False
        return self.figure >= limit if self.larger else self.figure <= limit


def target_facts(targets: Sequence[Target]) -> list[dict[str, Any]]:
    """Targets as a benchmark's JSON, with whether each is met."""
    return [{**asdict(t), "met": t.reaches(t.least), "aim_met": t.reaches(t.aim)} for t in targets]


def target_table(targets: Sequence[Target]) -> str:
    """Table of all targets, the missed ones too.

    Examples
    --------
    >>> print(target_table([Target("ms", 0.5, 1.0, 0.1)]))
    target  figure  at least  so it is  aim  so it is
    -------------------------------------------------
    ms       0.500         1       met  0.1    missed
    """
    rows = []
    for t in targets:
        verdicts = ["met" if t.reaches(limit) else "missed" for limit in (t.least, t.aim)]
        rows.append([t.measure, cell(t.figure, 3), f"{t.least:g}", verdicts[0], f"{t.aim:g}", verdicts[1]])
    return table(("target", "figure", "at least", "so it is", "aim", "so it is"), rows)
