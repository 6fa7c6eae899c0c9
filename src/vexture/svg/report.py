"""Notes about an SVG: what was left out, simplified or invalid, and at which element."""

from collections.abc import Callable
from dataclasses import replace

from lxml import etree

from vexture.errors import printable, shortened
from vexture.notes import MOST_SUBJECTS, Kind, Note, Notes, Subject

__all__ = ["Report", "described"]


def described(element: etree._Element) -> str:
    """Element as a message names it.

    Examples
    --------
    >>> described(etree.fromstring('<svg><path id="a"/></svg>')[0])
    '<path id="a"> in line 1'
    """
    name = str(element.tag).rpartition("}")[2]
    label = f' id="{element.get("id", "")[:40]}"' if element.get("id") else ""
    line = f" in line {element.sourceline}" if element.sourceline else ""
    return f"<{name[:40]}{label}>{line}"


class Report(Notes):
    """Notes about one document.

    Examples
    --------
    >>> report = Report()
    >>> report.invalid("r", "x", etree.fromstring("<rect/>"))
    >>> [str(note) for note in report.listed]
    ["r='x' of <rect> in line 1"]
    """

    def __init__(self) -> None:
        super().__init__()
        self._about: dict[tuple[Kind, str], dict[etree._Element, None]] = {}

    def left_out(self, what: str, element: etree._Element | None = None) -> None:
        """Note something that is not supported, and so paints nothing or has no effect."""
        self.count("left out", what, element)

    def simplified(self, what: str, element: etree._Element | None = None) -> None:
        """Note something that is in the result, but not as it should be."""
        self.count("simplified", what, element)

    def invalid(self, name: str, value: str, element: etree._Element) -> None:
        """Note a value that the standard does not allow."""
        self.count("invalid", f"{name}='{' '.join(shortened(value, 40).split())}' of {described(element)}", element)

    def count(self, kind: Kind, what: str, element: etree._Element | None = None) -> None:
        """Note something once more, of an element if it is about one."""
        super().count(kind, what)
        if element is not None:
            about = self._about.setdefault((kind, printable(what)), {})
            if len(about) < MOST_SUBJECTS:
                about[element] = None

    @property
    def elements(self) -> set[etree._Element]:
        """Elements that any note is about."""
        return {element for about in self._about.values() for element in about}

    def about(self, subject: Callable[[etree._Element], Subject]) -> tuple[Note, ...]:
        """All notes, as `listed`, with what their elements are."""
        found = ((note, self._about.get((note.kind, note.message), {})) for note in self.listed)
        return tuple(replace(note, elements=tuple(map(subject, about))) for note, about in found)
