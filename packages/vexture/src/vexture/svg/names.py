"""Names of an SVG's elements, for picking and restyling."""

from lxml import etree

from vexture.base.errors import SourceError
from vexture.svg.document import local_name

TITLE = "title"
"""Element whose text names the element around it (SVG 2, 5.7)."""


class ElementNames:
    """Names of elements, from an attribute, with a prefix of the document, or from `TITLE`.

    Raise a `SourceError` if no element has it.

    Examples
    --------
    >>> root = etree.fromstring('<svg xmlns:i="i"><g id="a" i:label="sun"/><g id="b"><title> hill </title></g></svg>')
    >>> [[ElementNames(root, by).of(element) for element in root] for by in ("id", "i:label", "title")]
    [['a', 'b'], ['sun', ''], ['', 'hill']]
    """

    def __init__(self, root: etree._Element, by: str = "id") -> None:
        prefix, _, name = by.rpartition(":")
        spaces = {element.nsmap[prefix] for element in root.iter("*") if prefix in element.nsmap} if prefix else set()
        self.by = by
        self.attributes = [f"{{{space}}}{name}" for space in sorted(spaces)] if prefix else [name]
        if by != "id" and not any(map(self.of, root.iter("*"))):
            raise SourceError(f"no element has the name {by!r} of `names`; give {TITLE}, id or another attribute")

    def of(self, element: etree._Element) -> str:
        """Return the name of an element, or an empty text."""
        if self.by != TITLE:
            return next((str(value) for name, value in element.items() if name in self.attributes and value), "")
        titles = (child for child in element if local_name(child) == TITLE)
        return next((" ".join("".join(map(str, title.itertext())).split()) for title in titles), "")
