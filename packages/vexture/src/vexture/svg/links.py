"""Links between elements of a document."""

import re
import sys
from urllib.parse import unquote

from lxml import etree

HREF = ("href", "{http://www.w3.org/1999/xlink}href", "xlink:href")
"""Attributes with links; the last one is for files that do not declare its prefix, which HTML allows."""

FRAGMENT = re.compile(r"\s*#(.*?)\s*", re.DOTALL)


ESCAPE = re.compile(r"\\(?:([0-9a-fA-F]{1,6})\s?|(.))", re.DOTALL)


def reference(element: etree._Element) -> str | None:
    """Return the link of an element (`href`), or None."""
    return next((element.get(name) for name in HREF if element.get(name)), None)


class Links:
    """Index of a document's elements by their `id`."""

    def __init__(self, root: etree._Element) -> None:
        self.root = root
        self.by_id: dict[str, etree._Element] = {}

    def target(self, link: str) -> etree._Element | None:
        r"""Return the element of this document that a link such as "#name" refers to, or None.

        If no element has the literal name, it is decoded, as from a URL or a style sheet.

        Examples
        --------
        >>> links = Links(etree.fromstring('<svg><g id="a b"/></svg>'))
        >>> links.target("#a%20b") is links.target("#a\\ b") is links.root[0]
        True
        """
        match = FRAGMENT.fullmatch(link)
        if match is None or not match[1]:
            return None
        if not self.by_id:
            for element in self.root.iter("{*}*"):
                self.by_id.setdefault(element.get("id", ""), element)
        decoded = (match[1], unquote(match[1]), ESCAPE.sub(unescape, match[1]))
        return next((self.by_id[name] for name in decoded if name in self.by_id), None)


def unescape(match: re.Match[str]) -> str:
    """Return the character of a CSS escape (CSS Syntax 3, 4.3.7)."""
    if not match[1]:
        return match[2]
    code = int(match[1], 16)
    return chr(code) if 0 < code <= sys.maxunicode else "\ufffd"
