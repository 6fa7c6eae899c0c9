"""Notes of a reader: what it left out, simplified or found invalid, as data of the drawing or fold.

Public functions turn notes into a `SourceWarning`, commands print them, servers and pages show them. All notes but
remarks are losses: the result differs from the source.
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
"""Text of a line before the notes of each kind, in this order."""

MOST_NAMED: Final = 8
"""Notes of one kind that a line names; the others are counted."""

MOST_IDS: Final = 5
"""Ids of features that a line names of each note."""

MOST_SUBJECTS: Final = 32
"""Elements that a note names; the others are counted."""

MOST_LETTERS: Final = 40
"""Of an id in a line."""

Box = tuple[float, float, float, float]
"""Least x and y, largest x and y, in the unit square, y up."""


class Subject(NamedTuple):
    """An element of the source that a note is about."""

    name: str  # as `Path.element`; of an element without a name, what it is and in which line
    box: Box | None  # of what is drawn of it; None if nothing is


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
    elements : tuple of Subject
        The first 32 elements that it is about, where the reader knows them.
    is_named : bool
        Whether a line names the first elements: they are features, and their names are the user's ids.
    has_remedy : bool
        Whether the message says what to do, where nothing else is in the source.

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
        """Whether the result differs from the source."""
        return self.kind != "remark"

    def facts(self) -> dict[str, Any]:
        """The note ready for JSON.

        Examples
        --------
        >>> Note("left out", "filter", 1, (Subject("sun", None),)).facts()["elements"]
        [{'name': 'sun', 'box': None}]
        """
        elements = [subject._asdict() for subject in self.elements]
        return {"kind": self.kind, "message": self.message, "count": self.count, "elements": elements}


class Notes:
    """Collects notes, and counts repeated ones.

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
        """Note something that is not supported, and so paints nothing or has no effect."""
        self.count("left out", message)

    def features(self, kind: Kind, message: str, ids: Iterable[object]) -> None:
        """Note something about the feature of each id, of several equal ones once.

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
        """Note something that is in the result, but not as it should be."""
        self.count("simplified", message)

    def remark(self, sentence: str, times: int = 1) -> None:
        """Note a sentence about the whole, or about so many of its parts."""
        self._add("remark", sentence, times)

    def missing_character(self, character: str) -> None:
        """Note a character that no font has; all of them become one note."""
        self._boxed[character] = self._boxed.get(character, 0) + 1

    def count(self, kind: Kind, message: str) -> None:
        """Note something once more."""
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
        shown = [format_character(character) for character in islice(self._boxed, MOST_NAMED)]
        if len(self._boxed) > MOST_NAMED:
            shown.append(f"and {len(self._boxed) - MOST_NAMED} more")
        if not shown:
            return ()
        if len(self._boxed) == 1:
            said = f"character {shown[0]}, which no font has, drawn as a box"
            return (Note("simplified", said, sum(self._boxed.values())),)
        return (Note("simplified", f"{len(self._boxed)} characters that no font has, as boxes: {' '.join(shown)}"),)

    @property
    def in_order(self) -> tuple[Note, ...]:
        """All notes by kind, each kind in the order of their first occurrence."""
        found = list[Note]()
        for kind, things in self._counts.items():
            for what, count in things.items():
                about = tuple(Subject(name, None) for name in self._named.get((kind, what), ()))
                found.append(Note(kind, what, count, about, is_named=bool(about)))
        at = next((k for k, note in enumerate(found) if note.kind in ("invalid", "remark")), len(found))
        return (*found[:at], *self.of_boxes, *found[at:])


def format_character(character: str) -> str:
    r"""Write a character as messages name it.

    Examples
    --------
    >>> format_character("é"), format_character("\ue000")
    ("'é' (U+00E9)", '(U+E000)')
    """
    shown = f"'{character}' " if character.isprintable() else ""
    return f"{shown}(U+{ord(character):04X})"


def line_of(source: str, notes: Sequence[Note]) -> str:
    """Write all notes about a source in one line; empty if there are none."""
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


def place_of_caller(depth: int) -> tuple[str, int]:
    """File and line where the function that calls this was called; `depth` 1 is its own caller."""
    frame = sys._getframe(depth + 1)
    return frame.f_code.co_filename, frame.f_lineno


def warn_at(place: tuple[str, int], source: str, notes: Sequence[Note]) -> None:
    """Issue the warning of `warn_of` for a line of long ago: what it asked for is done beside it."""
    if line := line_of(source, notes):
        warnings.warn_explicit(line, SourceWarning, *place)


def check_losses(source: str, notes: Sequence[Note], *, is_empty: bool, strict: bool = False) -> None:
    """Raise a `SourceError` if notes lose anything of a drawing and it is empty, or `strict` is set.

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
