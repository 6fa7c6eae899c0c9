"""Outlines of the basic shapes and paths of SVG (SVG 2, 9 and 10)."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from vexture.bezier.convert import arc_cubics, ellipse_cubics
from vexture.svg.outline import ShapeOutline
from vexture.svg.path_data import NUMBER, POINTS, path_outlines
from vexture.svg.report import Report
from vexture.svg.style import ElementStyle
from vexture.svg.values import LARGEST, TooLargeError, Viewport

CSS_PATH = re.compile(r"path\(\s*(?:(?:nonzero|evenodd)\s*,\s*)?(['\"])(.*)\1\s*\)", re.DOTALL)
HORIZONTAL = frozenset({"x", "cx", "rx", "width", "x1", "x2"})
VERTICAL = frozenset({"y", "cy", "ry", "height", "y1", "y2"})


@dataclass(frozen=True, slots=True)
class ShapeElement:
    """A shape element, with the context of its geometry."""

    element: etree._Element
    style: ElementStyle
    viewport: Viewport  # reference of percentages
    tolerance: float  # largest distance of a cubic from its arc, in user units
    report: Report

    def length(self, name: str) -> float | None:
        """Return the length that a property sets; None for "auto"."""
        return self.read_length(name, self.style[name])

    def attribute(self, name: str) -> float:
        """Return the length in an attribute; 0 without the attribute."""
        text = self.element.get(name)
        length = self.read_length(name, text) if text is not None else 0.0
        if length is None:
            self.report.invalid(name, text or "", self.element)
            return 0.0
        return length

    def read_length(self, name: str, text: str) -> float | None:
        """Convert a text to a length in user units; `name` determines the reference of percentages."""
        whole = self.viewport.diagonal
        if name in HORIZONTAL:
            whole = self.viewport.width
        elif name in VERTICAL:
            whole = self.viewport.height
        return self.viewport.length(text, whole, self.style.font_size)


def shape_outlines(shape: ShapeElement) -> list[ShapeOutline]:
    """Return the outlines of a shape in its user units; raise a `TooLargeError` if a coordinate exceeds `LARGEST`."""
    outlines = SHAPES[etree.QName(shape.element).localname](shape)
    for outline in outlines:
        check(outline.cubics)
    return outlines


def check(coordinates: NDArray[np.float64]) -> None:
    """Raise a `TooLargeError` for coordinates that are too large to compute with."""
    largest = np.abs(coordinates).max(initial=0.0)
    if not largest <= LARGEST:
        raise TooLargeError(f"it has a coordinate of {largest:g}; the limit is {LARGEST:g}; correct it")


def path_data(shape: ShapeElement) -> str:
    """Return the path data of `<path>`; empty without any."""
    data = shape.style["d"]
    if css := CSS_PATH.fullmatch(data):
        return css[2]
    return "" if data == "none" else data


def path(shape: ShapeElement) -> list[ShapeOutline]:
    """Return the outlines of `<path>`, up to the first error in its data."""
    data = path_data(shape)
    outlines, valid = path_outlines(data, shape.tolerance)
    if valid < len(data):
        shape.report.invalid("d", f"...{data[valid:]}", shape.element)
    return outlines


def rect(shape: ShapeElement) -> list[ShapeOutline]:
    """Return the outline of `<rect>`, clockwise on the screen, from the right end of its top left corner."""
    x, y = shape.length("x") or 0.0, shape.length("y") or 0.0
    width, height = shape.length("width") or 0.0, shape.length("height") or 0.0
    if width <= 0.0 or height <= 0.0:
        return []
    rx, ry = corner_radii(shape)
    rx, ry = min(rx, width / 2.0), min(ry, height / 2.0)
    right, bottom = x + width, y + height
    if rx <= 0.0 or ry <= 0.0:
        return [ShapeOutline.rectangle(x, y, width, height)]
    at = (x + rx, y)
    cubics = []
    for side, corner in (
        ((right - rx, y), (right, y + ry)),
        ((right, bottom - ry), (right - rx, bottom)),
        ((x + rx, bottom), (x, bottom - ry)),
        ((x, y + ry), (x + rx, y)),
    ):
        line = arc_cubics(at, (0.0, 0.0), 0.0, False, True, side, shape.tolerance)
        for step in line + arc_cubics(side, (rx, ry), 0.0, False, True, corner, shape.tolerance):
            cubics.append((*at, *step))
            at = step[4:]
    return [ShapeOutline(np.array(cubics).reshape(-1, 4, 2), closed=True)]


def corner_radii(shape: ShapeElement) -> tuple[float, float]:
    """Return `rx` and `ry`; "auto" takes the value of the other."""
    rx, ry = shape.length("rx"), shape.length("ry")
    return (rx if rx is not None else ry) or 0.0, (ry if ry is not None else rx) or 0.0


def circle(shape: ShapeElement) -> list[ShapeOutline]:
    """Return the outline of `<circle>`."""
    radius = shape.length("r") or 0.0
    return round_outline(shape, radius, radius)


def ellipse(shape: ShapeElement) -> list[ShapeOutline]:
    """Return the outline of `<ellipse>`."""
    return round_outline(shape, *corner_radii(shape))


def round_outline(shape: ShapeElement, rx: float, ry: float) -> list[ShapeOutline]:
    """Return a whole ellipse around `cx` and `cy`."""
    if rx <= 0.0 or ry <= 0.0:
        return []
    center = shape.length("cx") or 0.0, shape.length("cy") or 0.0
    return [ShapeOutline(ellipse_cubics(center, (rx, ry), shape.tolerance), closed=True)]


def line(shape: ShapeElement) -> list[ShapeOutline]:
    """Return the outline of `<line>`."""
    ends = [(shape.attribute(f"x{n}"), shape.attribute(f"y{n}")) for n in (1, 2)]
    return [ShapeOutline.polygon(np.array(ends), closed=False)]


def corners(shape: ShapeElement, closed: bool) -> list[ShapeOutline]:
    """Return straight sides through `points`, up to the first error in them."""
    text = shape.element.get("points", "")
    match = POINTS.match(text)
    valid = match.end() if match else 0
    if valid < len(text):
        shape.report.invalid("points", f"...{text[valid:]}", shape.element)
    coordinates = np.array(re.findall(NUMBER, text[:valid]), dtype=np.float64)
    check(coordinates)
    return [ShapeOutline.polygon(coordinates.reshape(-1, 2), closed)] if len(coordinates) > 2 else []


SHAPES: dict[str, Callable[[ShapeElement], list[ShapeOutline]]] = {
    "path": path,
    "rect": rect,
    "circle": circle,
    "ellipse": ellipse,
    "line": line,
    "polyline": partial(corners, closed=False),
    "polygon": partial(corners, closed=True),
}
