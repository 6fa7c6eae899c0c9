"""Notes on an SVG: everything left out, simplified or invalid, with the elements concerned."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import islice
from typing import Final, TypeAlias

from lxml import etree

from vexture.base.errors import SourceError, printable, shorten_text
from vexture.base.notes import MOST_SUBJECTS, Kind, Note, Notes, Subject

Step: TypeAlias = Callable[[etree._Element], etree._Element | None]
"""Function from an element to another one."""


BOXED: Final = ""
"""Key of the note on characters that no font has."""

NEAR: Final = 100
"""Most elements before and after an element among which it is numbered."""


class LocatedError(SourceError):
    """An error that names an element."""


def describe_element(element: etree._Element) -> str:
    """Describe an element for a message: by `id`, or by its line and, in the line, its number among similar elements.

    Examples
    --------
    >>> root = etree.fromstring('<svg><path id="a"/><g><rect/></g><rect/><circle/></svg>')
    >>> [describe_element(element) for element in root.iter("path", "rect", "circle")]
    ['<path id="a"> in line 1', 'the 1st <rect> in line 1', 'the 2nd <rect> in line 1', '<circle> in line 1']
    """
    name = str(element.tag).rpartition("}")[2]
    label = f' id="{element.get("id", "")[:40]}"' if element.get("id") else ""
    line = f" in line {element.sourceline}" if element.sourceline else ""
    which = "" if label else placed_in_line(element)
    return f"{which}<{name[:40]}{label}>{line}"


def placed_in_line(element: etree._Element) -> str:
    """Return the position of an element among its kind in a line; empty if it is alone, or there are many."""
    before = list(islice(beside(element, previous), NEAR))
    after = any(other.tag == element.tag for other in islice(beside(element, following), NEAR))
    count = 1 + sum(other.tag == element.tag for other in before)
    if len(before) == NEAR or (count == 1 and not after):
        return ""
    ending = "th" if count % 100 in (11, 12, 13) else {1: "st", 2: "nd", 3: "rd"}.get(count % 10, "th")
    return f"the {count}{ending} "


def beside(element: etree._Element, step: Step) -> Iterator[etree._Element]:
    """Yield the elements before or after one in its line, the nearest first."""
    other = step(element)
    while other is not None and other.sourceline == element.sourceline:
        yield other
        other = step(other)


def previous(element: etree._Element) -> etree._Element | None:
    """Return the element that starts before another one."""
    before = element.getprevious()
    if before is None:
        return element.getparent()
    while len(before):
        before = before[-1]
    return before


def following(element: etree._Element) -> etree._Element | None:
    """Return the element that starts after another one."""
    if len(element):
        return element[0]
    around: etree._Element | None = element
    while around is not None:
        after = around.getnext()
        if after is not None:
            return after
        around = around.getparent()
    return None


class Report(Notes):
    """Notes on one document.

    Examples
    --------
    >>> report = Report()
    >>> report.invalid("r", "x", etree.fromstring("<rect/>"))
    >>> [str(note) for note in report.in_order]
    ["r='x' of <rect> in line 1"]
    """

    def __init__(self) -> None:
        super().__init__()
        self._about: dict[tuple[Kind, str], dict[etree._Element, None]] = {}
        self._once = set[tuple[Kind, str, etree._Element]]()

    def left_out(self, message: str, element: etree._Element | None = None) -> None:
        """Note an unsupported feature, which paints nothing or has no effect."""
        self.count("left out", message, element)

    def simplification(self, message: str, element: etree._Element | None = None) -> None:
        """Note a part of the result that differs from the standard."""
        self.count("simplified", message, element)

    def invalid(self, name: str, value: str, element: etree._Element) -> None:
        """Note a value that the standard does not allow."""
        self.count(
            "invalid", f"{name}='{' '.join(shorten_text(value, 40).split())}' of {describe_element(element)}", element
        )

    def missing_character(self, character: str, element: etree._Element | None = None) -> None:
        """Note a character of an element that no font has."""
        super().missing_character(character)
        self.add_about("simplified", BOXED, element)

    def count(self, kind: Kind, message: str, element: etree._Element | None = None) -> None:
        """Count a note once more, with the element concerned, if any."""
        super().count(kind, message)
        self.add_about(kind, printable(message), element)

    def once(self, kind: Kind, message: str, element: etree._Element) -> None:
        """Add a note on an element only once, even if the element is shown several times."""
        if (kind, message, element) not in self._once:
            self._once.add((kind, message, element))
            self.count(kind, message, element)

    def add_about(self, kind: Kind, message: str, element: etree._Element | None) -> None:
        """Add an element to those that a note concerns."""
        if element is not None:
            about = self._about.setdefault((kind, message), {})
            if len(about) < MOST_SUBJECTS:
                about[element] = None

    @property
    def elements(self) -> set[etree._Element]:
        """Elements that any note concerns."""
        return {element for about in self._about.values() for element in about}

    def about(self, subject: Callable[[etree._Element], Subject]) -> tuple[Note, ...]:
        """Return all notes, as `in_order`, with descriptions of their elements."""
        boxes = {note.message: BOXED for note in self.of_boxes}
        keys = ((note, boxes.get(note.message, note.message)) for note in self.in_order)
        found = ((note, self._about.get((note.kind, key), {})) for note, key in keys)
        return tuple(replace(note, elements=tuple(map(subject, about))) for note, about in found)
