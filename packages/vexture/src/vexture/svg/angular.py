"""Angular gradients, which SVG lacks: Figma exports each as an HTML box with a `conic-gradient()`.

No paint turns about a point, so such a gradient becomes sectors of flat colours (CSS Images 4, 3.3).
"""

from dataclasses import replace
from itertools import pairwise
from math import ceil, cos, floor, hypot, pi, sin
from typing import Final, NamedTuple, Protocol

import numpy as np
from lxml import etree

from vexture.drawing.calculation import parse_tokens
from vexture.drawing.drawing import FillRule
from vexture.drawing.paint import Paint, Stop
from vexture.drawing.sectors import MOST_SECTORS, Course, overlapping, reach_beyond, sectors_of
from vexture.svg.css_gradients import CssGradient, read_function
from vexture.svg.declarations import read_style
from vexture.svg.document import HTML
from vexture.svg.images import image_sides
from vexture.svg.outline import ShapeOutline
from vexture.svg.painter import Painter
from vexture.svg.report import Report
from vexture.svg.space import ElementPlace
from vexture.svg.transform import Identity, angle, parse_origin
from vexture.svg.values import fraction, number
from vexture.svg.viewport import Rectangle

CONIC: Final = frozenset({"conic-gradient", "repeating-conic-gradient"})
FILLING: Final = {"width": ("100%", "auto"), "height": ("100%",)}
"""Sizes with which an HTML box fills the element around it."""


MOST_COURSES: Final = 2 * MOST_SECTORS
"""Most courses around a turn; each takes at least one sector."""


class AngularFill(NamedTuple):
    """A gradient that fills an HTML box, and its opacity."""

    gradient: CssGradient
    opacity: float


class AngularScene(Protocol):
    """The part of a scene that angular gradients need."""

    report: Report


def angular_fill(element: etree._Element) -> AngularFill | None:
    """Return the angular gradient that fills a `foreignObject`; None for any other content."""
    boxes = list(element.iterchildren("*"))
    if len(boxes) != 1 or boxes[0].tag != f"{HTML}div" or len(boxes[0]) or (boxes[0].text or "").strip():
        return None
    said = {name: value.strip().lower() for name, value, _ in read_style(boxes[0].get("style", ""))}
    if said.get("width", "auto") not in FILLING["width"] or said.get("height", "auto") not in FILLING["height"]:
        return None
    opacity = fraction(said.get("opacity", "1"))
    tokens = [token for token in parse_tokens(said.get("background-image", "")) if token.type != "whitespace"]
    if opacity is None or len(tokens) != 1 or tokens[0].type != "function" or tokens[0].lower_name not in CONIC:
        return None
    gradient = read_function(tokens[0])
    return None if gradient is None else AngularFill(gradient, opacity)


def paint_angular(scene: AngularScene, element: etree._Element, place: ElementPlace, painter: Painter) -> None:
    """Paint the angular gradient that fills a `foreignObject`, at a place with the element's style."""
    fill, box = angular_fill(element), image_sides(place, (0.0, 0.0))
    if fill is None or min(box[2:]) <= 0.0 or place.style["visibility"].lower() != "visible" or place.space.flat:
        return
    found, courses = center_of(fill.gradient.shape, box, place), courses_of(fill.gradient, place)
    if found is None or not courses:
        scene.report.left_out("angular gradient", element)
        return
    sectors = sectors_of(courses)
    if any(course.change for course in courses):
        scene.report.simplification(f"angular gradient drawn in {len(sectors)} sectors", element)
    inner = replace(place, space=place.space.window(box, Identity))
    for sector in sectors if fill.opacity < 1.0 else overlapping(sectors):
        paint = Paint(sector.first.color, sector.first.opacity * fill.opacity)
        if paint.opacity > 0.0:
            loop = triangle(sector, box, *found)
            painter.add([loop.loop], inner, FillRule.NONZERO, paint, place.name)


def center_of(shape: str, box: Rectangle, place: ElementPlace) -> tuple[float, float, float] | None:
    """Return the centre of a gradient in a box and its start, in turns from the top; None if `shape` is not valid."""
    left, top, width, height = box
    turn, _, where = f" {shape.lower()} ".partition(" at ")
    start = angle(turn.strip().removeprefix("from").strip()) if turn.strip() else 0.0
    view = replace(place.viewport, width=width, height=height)
    middle = parse_origin(where.strip() or "center", view.along(place.style.font_size))
    return None if start is None or middle is None else (left + middle[0], top + middle[1], start / (2.0 * pi))


def triangle(sector: Course, box: Rectangle, x: float, y: float, start: float) -> ShapeOutline:
    """Return a sector about a point as a triangle that reaches beyond a box."""
    left, top, width, height = box
    far = hypot(max(abs(x - left), abs(left + width - x)), max(abs(y - top), abs(top + height - y)))
    reach = reach_beyond(sector, far)
    turns = [2.0 * pi * (start + at) for at in (sector.begin, sector.end)]
    corners = [(x, y), *((x + reach * sin(turn), y - reach * cos(turn)) for turn in turns)]
    return ShapeOutline.polygon(np.array(corners), closed=True)


def courses_of(gradient: CssGradient, place: ElementPlace) -> list[Course]:
    """Return the courses of a gradient around a whole turn; none if it is not valid or has too many."""
    stops = gradient.place_stops(place.style.solid, turns_of, 1.0)
    if not 0 < len(stops) <= MOST_COURSES:
        return []
    ends = [(stop.offset, Stop(0.0, stop.color, stop.opacity)) for stop in stops]
    first, last = ends[0], ends[-1]
    long = last[0] - first[0]
    if not gradient.repeats:
        ends = [(min(first[0], 0.0), first[1]), *ends, (max(last[0], 1.0), last[1])]
    elif long * MOST_SECTORS < 1.0:
        return []
    else:
        rounds = range(floor(-last[0] / long), ceil((1.0 - first[0]) / long) + 1)
        ends = [(at + long * turn, color) for turn in rounds for at, color in ends]
    courses = [Course(low, high, before, after) for (low, before), (high, after) in pairwise(ends) if high > low]
    inside = [course.within(0.0, 1.0) for course in courses if course.begin < 1.0 and course.end > 0.0]
    return inside if len(inside) <= MOST_COURSES else []


def turns_of(text: str, axis: int) -> float | None:
    """Return the position of a stop in turns; a percentage comes without its sign, as a number."""
    plain = number(text)
    turn = angle(text) if plain is None else None
    return plain if turn is None else turn / (2.0 * pi)
