"""Notes of a reader: what it left out, simplified or found invalid, as data of the drawing or fold.

Public functions turn notes into a `SourceWarning`, commands print them, servers and pages show them. Every note except
a remark is a loss: the result differs from the source.
"""

import sys
import warnings
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Any, Final, Literal, NamedTuple

from vexture.base.errors import SourceError, SourceWarning, printable, shorten_text

Kind = Literal["left out", "simplified", "invalid", "remark"]

HEADINGS: Final[dict[Kind, str]] = {
    "left out": "left out: ",
    "simplified": "simplified: ",
    "invalid": "invalid and ignored: ",
    "remark": "",
}
"""Heading of each kind of note in a line, in the order of the line."""

MOST_NAMED: Final = 8
"""Notes of one kind that a line names; the others are counted."""

MOST_IDS: Final = 5
"""Ids of features that a line names for each note."""

MOST_SUBJECTS: Final = 32
"""Elements that a note names; the others are counted."""

MOST_LETTERS: Final = 40
"""Longest id in a line."""

Box = tuple[float, float, float, float]
"""Least x and y, largest x and y, in the unit square, y up."""


class Subject(NamedTuple):
    """An element of the source that a note is about."""

    name: str  # as in `Path.element`; without a name, the kind of element and its line in the source
    box: Box | None  # bounding box of its drawn part; None if nothing is drawn


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
        Number of occurrences.
    elements : tuple of Subject
        The first 32 elements that it is about, if the reader knows them.
    is_named : bool
        True if a line names the first elements: features, whose names are the user's ids.
    has_remedy : bool
        True if the message contains a remedy for a source that has nothing else.

    Examples
    --------
    >>> str(Note("left out", "<text>", 2))
    '<text> (2)'
    >>> str(Note("left out", "feature without geometry", 1, (Subject("07003", None),), is_named=True))
    'feature without geometry (1: 07003)'
    """

    kind: Kind
    message: str
    count: int = 1
    elements: tuple[Subject, ...] = ()
    is_named: bool = False
    has_remedy: bool = False

    def __str__(self) -> str:
        if self.is_named and self.elements:
            first = [shorten_text(printable(subject.name), MOST_LETTERS) for subject in self.elements[:MOST_IDS]]
            more = ", ..." if self.count > len(first) else ""
            return f"{self.message} ({self.count}: {', '.join(first)}{more})"
        return f"{self.message} ({self.count})" if self.count > 1 else self.message

    @property
    def is_loss(self) -> bool:
        """True if the result differs from the source."""
        return self.kind != "remark"

    def facts(self) -> dict[str, Any]:
        """Return the note as JSON-ready data.

        Examples
        --------
        >>> Note("left out", "filter", 1, (Subject("sun", None),)).facts()["elements"]
        [{'name': 'sun', 'box': None}]
        """
        elements = [subject._asdict() for subject in self.elements]
        return {"kind": self.kind, "message": self.message, "count": self.count, "elements": elements}


class Notes:
    """Collects notes and counts repeated ones.

    Examples
    --------
    >>> notes = Notes()
    >>> notes.left_out("Point"); notes.left_out("Point"); notes.remark("it has 3 bands, of which the first is read")
    >>> str(notes.in_order[0])
    'Point (2)'
    >>> line_of("a.gpkg", notes.in_order)
    'a.gpkg: left out: Point (2); it has 3 bands, of which the first is read'
    """

    def __init__(self) -> None:
        self._counts: dict[Kind, dict[str, int]] = {kind: {} for kind in HEADINGS}
        self._boxed: dict[str, int] = {}  # characters that no font has
        self._named: dict[tuple[Kind, str], dict[str, None]] = {}  # the first ids of features of each note

    def left_out(self, message: str) -> None:
        """Note an unsupported part, which paints nothing or has no effect."""
        self.count("left out", message)

    def features(self, kind: Kind, message: str, ids: Iterable[object]) -> None:
        """Note a message about features; equal ids count once.

        Examples
        --------
        >>> notes = Notes()
        >>> notes.features("remark", "a polygon is repaired", ["07", "12"])
        >>> line_of("a.gpkg", notes.in_order)
        'a.gpkg: a polygon is repaired (2: 07, 12)'
        """
        names = list(dict.fromkeys(map(str, ids)))
        self._add(kind, message, len(names))
        if names:
            known = self._named.setdefault((kind, printable(message)), {})
            known.update(dict.fromkeys(names[: MOST_SUBJECTS - len(known)]))

    def simplification(self, message: str) -> None:
        """Note a part that the result contains in a simpler form."""
        self.count("simplified", message)

    def remark(self, sentence: str, times: int = 1) -> None:
        """Note a sentence about the whole source, or about `times` parts of it."""
        self._add("remark", sentence, times)

    def missing_character(self, character: str) -> None:
        """Note a character that no font has; all such characters share one note."""
        self._boxed[character] = self._boxed.get(character, 0) + 1

    def count(self, kind: Kind, message: str) -> None:
        """Note one more occurrence of a message."""
        self._add(kind, message, 1)

    def _add(self, kind: Kind, message: str, times: int) -> None:
        if times:
            message = printable(message)
            self._counts[kind][message] = self._counts[kind].get(message, 0) + times

    @property
    def boxes(self) -> frozenset[str]:
        """Characters that no font has."""
        return frozenset(self._boxed)

    @property
    def of_boxes(self) -> tuple[Note, ...]:
        """The note about characters that no font has, if there are any."""
        listed = [format_character(character) for character in islice(self._boxed, MOST_NAMED)]
        if len(self._boxed) > MOST_NAMED:
            listed.append(f"and {len(self._boxed) - MOST_NAMED} more")
        if not listed:
            return ()
        if len(self._boxed) == 1:
            message = f"character {listed[0]}, which no font has, drawn as a box"
            return (Note("simplified", message, sum(self._boxed.values())),)
        return (Note("simplified", f"{len(self._boxed)} characters that no font has, as boxes: {' '.join(listed)}"),)

    @property
    def in_order(self) -> tuple[Note, ...]:
        """All notes by kind; within a kind, by first occurrence."""
        found = list[Note]()
        for kind, things in self._counts.items():
            for what, count in things.items():
                about = tuple(Subject(name, None) for name in self._named.get((kind, what), ()))
                found.append(Note(kind, what, count, about, is_named=bool(about)))
        at = next((k for k, note in enumerate(found) if note.kind in ("invalid", "remark")), len(found))
        return (*found[:at], *self.of_boxes, *found[at:])


def format_character(character: str) -> str:
    r"""Format a character for messages.

    Examples
    --------
    >>> format_character("é"), format_character("\ue000")
    ("'é' (U+00E9)", '(U+E000)')
    """
    quoted = f"'{character}' " if character.isprintable() else ""
    return f"{quoted}(U+{ord(character):04X})"


def line_of(source: str, notes: Sequence[Note]) -> str:
    """Format all notes about a source as one line; empty without notes."""
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
    """Issue one `SourceWarning` with all notes about a source; `stacklevel` 2 is the caller of the calling function."""
    if line := line_of(source, notes):
        warnings.warn(line, SourceWarning, stacklevel=stacklevel + 1)


def place_of_caller(depth: int) -> tuple[str, int]:
    """File and line of a call further up the stack; `depth` 1 is the call of the function that calls this one."""
    frame = sys._getframe(depth + 1)
    return frame.f_code.co_filename, frame.f_lineno


def warn_at(place: tuple[str, int], source: str, notes: Sequence[Note]) -> None:
    """Issue the warning of `warn_of` for a line that has returned, because its work runs in the background."""
    if line := line_of(source, notes):
        warnings.warn_explicit(line, SourceWarning, *place)


def check_losses(source: str, notes: Sequence[Note], *, is_empty: bool, strict: bool = False) -> None:
    """Raise a `SourceError` if there are losses and the drawing is empty or `strict` is set.

    Examples
    --------
    >>> check_losses("a.svg", [Note("left out", "<text>", 2)], is_empty=True)
    Traceback (most recent call last):
    vexture.base.errors.SourceError: a.svg: left out: <text> (2); nothing else is in it; correct it, or draw it as paths
    """
    line = line_of(source, [note for note in notes if note.is_loss])
    if line and is_empty:
        remedy = "" if any(note.has_remedy for note in notes) else "; correct it, or draw it as paths"
        raise SourceError(f"{line}; nothing else is in it{remedy}")
    if line and strict:
        raise SourceError(f"{line}; `strict` accepts no such note; correct the source, or leave it out")
