"""Notes about an SVG: what was left out, simplified or invalid, and at which element."""

from lxml import etree

from vexture.notes import Notes

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

    def invalid(self, name: str, value: str, element: etree._Element) -> None:
        """Note a value that the standard does not allow."""
        shown = value if len(value) <= 40 else value[:37] + "..."
        self.count("invalid", f"{name}='{' '.join(shown.split())}' of {described(element)}")
