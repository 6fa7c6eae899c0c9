"""Paint servers, simplified: a gradient becomes the mean of its colours, a pattern becomes grey."""

import re

import numpy as np
from lxml import etree

from vexture.paint import Paint
from vexture.svg.colors import Color, parse_color, parse_paint
from vexture.svg.document import local_name
from vexture.svg.report import Report
from vexture.svg.style import INITIAL, Cascade, Style

__all__ = ["PaintServers", "reference"]

HREF = ("href", "{http://www.w3.org/1999/xlink}href")
GRADIENTS = ("linearGradient", "radialGradient")
GREY = Color((0.5, 0.5, 0.5), 1.0)
FRAGMENT = re.compile(r"\s*#(.*?)\s*", re.DOTALL)


def reference(element: etree._Element) -> str | None:
    """Link to another element (`href`), or None."""
    return next((element.get(name) for name in HREF if element.get(name)), None)


class PaintServers:
    """Finds elements by their `id`, and the flat colours that replace paints."""

    def __init__(self, root: etree._Element, cascade: Cascade, report: Report) -> None:
        self.root = root
        self.cascade = cascade
        self.report = report
        self.by_id: dict[str, etree._Element] = {}
        self.means: dict[etree._Element, Color | None] = {}

    def target(self, link: str) -> etree._Element | None:
        """Element of this document that a link like "#name" refers to, or None."""
        match = FRAGMENT.fullmatch(link)
        if match is None:
            return None
        if not self.by_id:
            for element in self.root.iter("{*}*"):
                self.by_id.setdefault(element.get("id", ""), element)
        return self.by_id.get(match[1]) if match[1] else None

    def paint(self, style: Style, name: str) -> Paint | None:
        """Flat paint of `name`, "fill" or "stroke", for an element of a style; None if nothing is painted."""
        text = parse_paint(style[name])
        if text is None:
            return None
        color = text.color
        if text.reference is not None:
            color = self.server_color(text.reference, color, style)
        if isinstance(color, str):
            color = style.color
        if color is None:
            return None
        if not color.exact:
            self.report.simplified("colour of a space other than sRGB read as black")
        opacity = color.alpha * style.opacity(f"{name}-opacity")
        return Paint(color.rgb, opacity) if opacity > 0.0 else None

    def server_color(self, link: str, fallback: Color | str | None, style: Style) -> Color | str | None:
        """Flat colour for a reference to a paint server, or its fallback."""
        server = self.target(link)
        name = local_name(server) if server is not None else None
        if server is not None and name in GRADIENTS:
            self.report.simplified(f"{name} read as a solid colour")
            return self.mean_color(server)
        if name == "pattern":
            self.report.simplified("pattern read as solid")
            return fallback or GREY
        self.report.left_out(f"paint '{link[:40]}'")
        return fallback

    def mean_color(self, gradient: etree._Element) -> Color | None:
        """Mean of a gradient's stops, or of those that it inherits by reference; None if there are none."""
        if gradient not in self.means:
            source: etree._Element | None = gradient
            seen: set[etree._Element] = set()
            colors: list[Color] = []
            while source is not None and source not in seen and not colors:
                seen.add(source)
                colors = [self.stop_color(stop) for stop in source if local_name(stop) == "stop"]
                source = self.target(reference(source) or "")
            self.means[gradient] = mean(colors)
        return self.means[gradient]

    def stop_color(self, stop: etree._Element) -> Color:
        """Colour of a gradient's stop."""
        style = INITIAL
        for element in reversed([stop, *stop.iterancestors()]):
            style = self.cascade.style(element, style)
        color = parse_color(style["stop-color"])
        if not isinstance(color, Color):
            color = style.color
        return color._replace(alpha=color.alpha * style.opacity("stop-opacity"))


def mean(colors: list[Color]) -> Color | None:
    """Mean of colours, None of none."""
    if not colors:
        return None
    red, green, blue = np.mean([color.rgb for color in colors], axis=0).tolist()
    alpha = float(np.mean([color.alpha for color in colors]))
    return Color((red, green, blue), alpha, all(color.exact for color in colors))
