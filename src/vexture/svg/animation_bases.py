"""Values that elements have without an animation by elements: it may begin at them, or be added to them."""

from functools import cached_property
from typing import Final

from lxml import etree

from vexture.svg.document import local_name
from vexture.svg.page import Page
from vexture.svg.properties import CSS_ONLY, PROPERTIES
from vexture.svg.report import Report
from vexture.svg.style import LISTING, Cascade, Style

__all__ = ["SIZES", "STYLED", "Bases"]

SIZES: Final = frozenset({"cx", "cy", "height", "r", "rx", "ry", "width", "x", "y"})
"""Attributes that are properties of some elements only."""

STYLED: Final = PROPERTIES.keys() - CSS_ONLY - {"d", "transform", *SIZES}
"""Attributes that are properties: their animated values override style sheets."""

SHAPES: Final = frozenset({"circle", "ellipse", "rect"})
"""Elements whose sizes are zero where they are not said."""

AUTO: Final = "auto"

BOX: Final = {"x": "-10%", "y": "-10%", "width": "120%", "height": "120%"}
DEFAULTS: Final[dict[str, dict[str, str]]] = {
    "filter": BOX,
    "mask": BOX,
    "line": dict.fromkeys(("x1", "y1", "x2", "y2"), "0"),
    "linearGradient": {"x1": "0%", "y1": "0%", "x2": "100%", "y2": "0%"},
    "pattern": dict.fromkeys(("x", "y", "width", "height"), "0"),
    "radialGradient": dict.fromkeys(("cx", "cy", "r"), "50%"),
    "stop": {"offset": "0"},
    "textPath": {"startOffset": "0"},
}
"""Values of attributes that elements do not have."""


class Bases:
    """Finds the values of a document's elements without animations by elements."""

    def __init__(self, root: etree._Element, page: Page) -> None:
        self.root = root
        self.page = page

    @cached_property
    def cascade(self) -> Cascade:
        """The styles of the elements, which are asked for seldom."""
        return Cascade(self.root, Report(), self.page)

    def value(self, element: etree._Element, name: str) -> str | None:
        """Value of an attribute, or of the property that it is; None if it is not known."""
        kind = local_name(element) or ""
        if name in STYLED:
            return self.style(element).computed(name)
        own = element.get(name)
        if own is None and name in SIZES and kind not in (*LISTING, *DEFAULTS):
            size = PROPERTIES[name].initial  # whatever style sheets say, as browsers have it
            return size if size != AUTO else "0" if kind in SHAPES else None
        return DEFAULTS.get(kind, {}).get(name) if own is None else own

    def inherited(self, element: etree._Element, name: str) -> str | None:
        """Value of a property that an element inherits; None if it is not known."""
        around = element.getparent()
        return None if around is None or name not in STYLED else self.style(around).computed(name)

    def style(self, element: etree._Element) -> Style:
        """Style of an element where it stands in the document."""
        style = self.cascade.initial
        for around in reversed([element, *element.iterancestors()]):
            style = self.cascade.style(around, style)
        return style
