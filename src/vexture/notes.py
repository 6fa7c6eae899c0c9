"""Notes of a reader: what it left out, simplified or found invalid, as data of the drawing or fold.

Public functions turn notes into a `SourceWarning`, commands print them, servers and pages show them.
"""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Literal

from vexture.errors import SourceWarning, printable

__all__ = ["Kind", "Note", "Notes", "line_of", "warn_of"]

Kind = Literal["left out", "simplified", "invalid", "remark"]

HEADINGS: Final[dict[Kind, str]] = {
    "left out": "left out: ",
    "simplified": "simplified: ",
    "invalid": "invalid and ignored: ",
    "remark": "",
}
"""What a line says before the notes of each kind, in this order."""

MOST_NAMED: Final = 8
"""Notes of one kind that a line names; the others are counted."""


@dataclass(frozen=True, slots=True)
class Note:
    """One observation about a source.

    Parameters
    ----------
    kind : str
        ``"left out"``: not supported and not in the result. ``"simplified"``: in the result, but not as it should be.
        ``"invalid"``: against the standard and ignored. ``"remark"``: a sentence about the whole.
    message : str
        Such as ``<text>`` or ``pattern shown as solid``.
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
    """Collects notes, and counts repeated ones.

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
        """Note something that is not supported, and so paints nothing or has no effect."""
        self.count("left out", what)

    def simplified(self, what: str) -> None:
        """Note something that is in the result, but not as it should be."""
        self.count("simplified", what)

    def remark(self, sentence: str) -> None:
        """Note a sentence about the whole."""
        self.count("remark", sentence)

    def count(self, kind: Kind, what: str) -> None:
        """Note something once more."""
        what = printable(what)
        self._counts[kind][what] = self._counts[kind].get(what, 0) + 1

    @property
    def listed(self) -> tuple[Note, ...]:
        """All notes by kind, each kind in the order of their first occurrence."""
        return tuple(Note(kind, what, count) for kind, things in self._counts.items() for what, count in things.items())


def line_of(source: str, notes: Sequence[Note]) -> str:
    """All notes about a source in one line; empty if there are none."""
    parts = []
    for kind, heading in HEADINGS.items():
        named = [str(note) for note in notes if note.kind == kind]
        if not heading:
            parts += named
            continue
        if len(named) > MOST_NAMED:
            named[MOST_NAMED:] = [f"and {len(named) - MOST_NAMED} more"]
        if named:
            parts.append(heading + ", ".join(named))
    return f"{source}: {'; '.join(parts)}" if parts else ""


def warn_of(source: str, notes: Sequence[Note], *, stacklevel: int = 2) -> None:
    """Issue one `SourceWarning` of all notes about a source; `stacklevel` 2 is the caller of the calling function."""
    if line := line_of(source, notes):
        warnings.warn(line, SourceWarning, stacklevel=stacklevel + 1)
