"""Unsupported parts of an SVG other than shapes: animations, scripts, views and cursors; notes list each one once."""

import re
from collections.abc import Callable
from copy import copy
from typing import Final

from lxml import etree

from vexture.base.errors import shorten_text
from vexture.svg.animations import ANIMATIONS
from vexture.svg.css_gradients import own_background
from vexture.svg.document import local_name
from vexture.svg.links import reference
from vexture.svg.paint_servers import PaintServers
from vexture.svg.report import Report
from vexture.svg.style import ElementStyle

ANIMATION: Final = "animation"
"""Name of animations in notes."""

REMARKS: Final = {
    "cursor": "its cursors are left out, which no picture shows",
    "view": "its views are not followed; all of it is shown",
}
"""Notes on elements that do not change the picture."""


LINED: Final = re.compile(r"\b(?:solid|dashed|dotted|double|groove|ridge|inset|outset)\b", re.IGNORECASE)
SIZED: Final = re.compile(r"[1-9]")
IMAGE: Final = re.compile(r"url\(|gradient\(|image|cross-fade\(|element\(|paint\(", re.IGNORECASE)

BOXED: Final = {
    "background-image": IMAGE,
    "border": LINED,
    "border-radius": SIZED,
    "box-shadow": SIZED,
    "outline": LINED,
    "padding": SIZED,
}
"""Properties of the outermost element as a CSS box, with the values that are visible."""

STYLESHEET: Final = re.compile(r"""<\?xml-stylesheet\s[^>]*?\bhref\s*=\s*(['"])(.*?)\1""", re.DOTALL)
"""Pattern of the link in a processing instruction (xml-stylesheet 1.0)."""


def note_unsupported(
    root: etree._Element, style: ElementStyle, servers: PaintServers, report: Report, chosen: set[etree._Element] | None
) -> None:
    """Note invisible parts of a document, or of the elements in `chosen` with all their content.

    `style` is the style of the outermost element.
    """
    if chosen is None or root in chosen:
        for boxed, shows in BOXED.items():
            is_drawn = boxed == "background-image" and own_background(style) is not None
            if shows.search(style[boxed]) and not is_drawn:
                report.left_out(f"{boxed} of the outermost <svg>", root)
    for before in root.itersiblings(etree.ProcessingInstruction, preceding=True):
        match = STYLESHEET.match(str(before))
        if match is not None:
            report.left_out(f"style sheet '{shorten_text(match[2], 40)}'", root)
    remarks = set[str]()
    moved_by_sheets = animation_test(servers)
    for top in [root] if chosen is None else chosen:
        for element in top.iter("*"):
            name = local_name(element)
            if name in ANIMATIONS:
                moved = servers.target(reference(element) or "")
                report.left_out(ANIMATION, element.getparent() if moved is None else moved)
            elif name == "script" or any(str(key).startswith("on") for key in element.attrib):
                report.left_out("script", element)
            elif name is not None and moved_by_sheets(element):
                report.left_out(ANIMATION, element)
            elif name in REMARKS:
                remarks.add(name)
    for remark in sorted(remarks):
        report.remark(REMARKS[remark])


def animation_test(servers: PaintServers) -> Callable[[etree._Element], bool]:
    """Return a predicate for elements that a style sheet animates; it adds no notes."""
    cascade = copy(servers.cascade)
    cascade.report = Report()
    if not cascade.sheets.keyframes:
        return lambda element: False
    quiet = PaintServers(servers.root, cascade, cascade.report)
    return lambda element: bool(cascade.animation_names(quiet.style_of(element).own))
