"""Notes about an SVG: what was left out, simplified or invalid, and at which element."""

from collections.abc import Iterator
from contextlib import contextmanager

from lxml import etree

from vexture.notes import Kind, Notes

__all__ = ["Report", "described"]


def described(element: etree._Element) -> str:
    """Element as a message names it.

    Examples
    --------
    >>> described(etree.fromstring('<svg><path id="a"/></svg>')[0])
    '<path id="a"> in line 1'
    """
    name = etree.QName(element).localname
    label = f' id="{element.get("id", "")[:40]}"' if element.get("id") else ""
    line = f" in line {element.sourceline}" if element.sourceline else ""
    return f"<{name[:40]}{label}>{line}"


class Report(Notes):
    """Notes about one document.

    Examples
    --------
    >>> report = Report()
    >>> report.invalid("r", "x", etree.fromstring("<rect/>"))
    >>> with report.silent():
    ...     report.left_out("text")
    >>> [str(note) for note in report.listed]
    ["r='x' of <rect> in line 1"]
    """

    def __init__(self) -> None:
        super().__init__()
        self._silent = False

    def invalid(self, name: str, value: str, element: etree._Element) -> None:
        """Note a value that the standard does not allow."""
        shown = value if len(value) <= 40 else value[:37] + "..."
        self.count("invalid", f"{name}='{' '.join(shown.split())}' of {described(element)}")

    def count(self, kind: Kind, what: str) -> None:
        """Count one more of a thing, unless nothing is to be noted."""
        if not self._silent:
            super().count(kind, what)

    @contextmanager
    def silent(self) -> Iterator[None]:
        """Suspend notes, because the same elements will be visited again."""
        self._silent = True
        try:
            yield
        finally:
            self._silent = False
