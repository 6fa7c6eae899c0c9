"""What a reader could not honour: collected while reading, said once."""

import warnings
from collections.abc import Iterable
from typing import Final

from lxml import etree

from vexture.errors import SourceWarning

__all__ = ["UNLOCATED", "Report", "described"]

MOST_NAMED = 8
"""Kinds of things that one warning names; the others are counted."""


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


UNLOCATED: Final = "feature without geometry"
"""Of geographic data: nothing is there, and nothing is missing (RFC 7946, 3.2)."""


class Report:
    """Things left out, simplified or invalid in one file, each counted.

    Parameters
    ----------
    source : str
        Names the file.

    Examples
    --------
    >>> report = Report("a.svg")
    >>> report.left_out("text"); report.left_out("text"); report.simplified("linearGradient read as a solid colour")
    >>> report.message
    'a.svg: left out: text (2); simplified: linearGradient read as a solid colour'
    """

    def __init__(self, source: str) -> None:
        self.source = source
        self.kinds: dict[str, dict[str, int]] = {"left out": {}, "simplified": {}, "invalid and ignored": {}}

    def left_out(self, what: str) -> None:
        """Note a feature that is not supported and paints nothing or has no effect."""
        self.count("left out", what)

    def simplified(self, what: str) -> None:
        """Note a feature that is painted, but not as it should be."""
        self.count("simplified", what)

    def invalid(self, name: str, value: str, element: etree._Element) -> None:
        """Note a value that the standard does not allow."""
        shown = value if len(value) <= 40 else value[:37] + "..."
        self.count("invalid and ignored", f"{name}='{' '.join(shown.split())}' of {described(element)}")

    def count(self, kind: str, what: str) -> None:
        """Count one more of a thing."""
        self.kinds[kind][what] = self.kinds[kind].get(what, 0) + 1

    @property
    def message(self) -> str:
        """All of it in one line; empty if there is nothing to say."""
        parts = [f"{kind}: {', '.join(named(things.items()))}" for kind, things in self.kinds.items() if things]
        return f"{self.source}: {'; '.join(parts)}" if parts else ""

    def warn(self, stacklevel: int) -> None:
        """Say it once, as a `SourceWarning`."""
        if message := self.message:
            warnings.warn(message, SourceWarning, stacklevel=stacklevel + 1)


def named(things: Iterable[tuple[str, int]]) -> list[str]:
    """List of things with how often they occur; a long list is cut."""
    listed = [f"{what} ({count})" if count > 1 else what for what, count in things]
    if len(listed) > MOST_NAMED:
        listed[MOST_NAMED:] = [f"and {len(listed) - MOST_NAMED} more"]
    return listed
