"""What was noticed while a source was read or a fold was made: data that travels with it, put into words at the edge.

Python's face warns of it, the command line prints it, servers and pages show it.
"""

import warnings
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Final, Literal

from vexture.errors import SourceWarning

__all__ = ["Kind", "Note", "Notes", "line_of", "warn_of"]

Kind = Literal["left out", "simplified", "invalid", "remark"]

HEADINGS: Final[dict[Kind, str]] = {
    "left out": "left out: ",
    "simplified": "simplified: ",
    "invalid": "invalid and ignored: ",
    "remark": "",
}
"""How a line begins what it says of each kind, in this order."""

MOST_NAMED: Final = 8
"""Notes of one kind that a line names; the others are counted."""


@dataclass(frozen=True, slots=True)
class Note:
    """One thing that was noticed.

    Parameters
    ----------
    kind : str
        ``"left out"``: not supported, and without a trace in the result. ``"simplified"``: there, but not as it
        should be. ``"invalid"``: against the standard, and ignored. ``"remark"``: a sentence about the whole.
    message : str
        What: ``<text>``, ``linearGradient read as a solid colour``.
    count : int
        How often.

    Examples
    --------
    >>> str(Note("left out", "<text>", 2))
    '<text> (2)'
    """

    kind: Kind
    message: str
    count: int = 1

    def __str__(self) -> str:
        return f"{self.message} ({self.count})" if self.count > 1 else self.message


class Notes:
    """Collects what is noticed, and counts what is noticed again.

    Examples
    --------
    >>> notes = Notes()
    >>> notes.left_out("Point"); notes.left_out("Point"); notes.remark("it has 3 bands, of which the first is read")
    >>> notes.listed[0]
    Note(kind='left out', message='Point', count=2)
    >>> line_of("a.gpkg", notes.listed)
    'a.gpkg: left out: Point (2); it has 3 bands, of which the first is read'
    """

    def __init__(self) -> None:
        self._counts: dict[Kind, dict[str, int]] = {kind: {} for kind in HEADINGS}

    def left_out(self, what: str) -> None:
        """Note what is not supported and paints nothing or has no effect."""
        self.count("left out", what)

    def simplified(self, what: str) -> None:
        """Note what is there, but not as it should be."""
        self.count("simplified", what)

    def remark(self, sentence: str) -> None:
        """Note something about the whole."""
        self.count("remark", sentence)

    def count(self, kind: Kind, what: str) -> None:
        """Count one more of a thing."""
        self._counts[kind][what] = self._counts[kind].get(what, 0) + 1

    @property
    def listed(self) -> tuple[Note, ...]:
        """All of it, kind by kind, in the order in which it was met."""
        return tuple(Note(kind, what, count) for kind, things in self._counts.items() for what, count in things.items())


def line_of(source: str, notes: Sequence[Note]) -> str:
    """All notes about a source in one line; empty if there are none.

    Examples
    --------
    >>> line_of("a.svg", [Note("left out", "text", 2), Note("simplified", "pattern read as solid")])
    'a.svg: left out: text (2); simplified: pattern read as solid'
    """
    parts = []
    for kind, heading in HEADINGS.items():
        named = [str(note) for note in notes if note.kind == kind]
        if named and not heading:
            parts += named
        elif named:
            parts.append(heading + ", ".join(_cut(named)))
    return f"{source}: {'; '.join(parts)}" if parts else ""


def _cut(named: list[str]) -> Iterable[str]:
    if len(named) <= MOST_NAMED:
        return named
    return [*named[:MOST_NAMED], f"and {len(named) - MOST_NAMED} more"]


def warn_of(source: str, notes: Sequence[Note], *, stacklevel: int = 2) -> None:
    """Warn Python's users of notes, once, as a `SourceWarning`.

    Parameters
    ----------
    source : str
        Names what the notes are about.
    notes : sequence of Note
    stacklevel : int
        2 is the caller of the function that calls this one.
    """
    if line := line_of(source, notes):
        warnings.warn(line, SourceWarning, stacklevel=stacklevel + 1)
