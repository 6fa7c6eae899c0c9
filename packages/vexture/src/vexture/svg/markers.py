"""Markers on the vertices of a shape, turned along its outline (SVG 2, 9.4 and 13.7)."""

from cmath import isclose
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from math import inf, pi
from typing import NamedTuple, Protocol

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from vexture.base.tolerance import ROUND
from vexture.svg.compositing import veil_of
from vexture.svg.declarations import MARKERS
from vexture.svg.filtering import note_effects
from vexture.svg.filters import HIDING
from vexture.svg.masks import MeasuredScene, add_masks
from vexture.svg.path_data import PathPen, Point
from vexture.svg.shapes import ShapeElement, check, path_data, shape_outlines
from vexture.svg.space import ContentWindow, Context, ElementPlace, PlacedElement
from vexture.svg.style import ElementStyle
from vexture.svg.transform import KEYWORDS, Identity, angle
from vexture.svg.values import Viewport
from vexture.svg.viewport import Rectangle

MARKED = frozenset({"line", "path", "polygon", "polyline"})
DEFAULT_SIZE = "3"
REVERSED = "auto-start-reverse"

RIGHT = (1.0, 0.0)
"""Direction at a point where all segments have zero length."""


class MarkerScene(MeasuredScene, Protocol):
    """The part of a scene that markers need."""

    def check_used(self, more: int, masks: int) -> None:
        """Raise a `SourceError` if `more` further elements are too many; `masks` as in `ElementPlace`."""

    def window(self, element: etree._Element, style: ElementStyle, sides: Rectangle) -> ContentWindow | None:
        """Return the viewport of an element with sides; None if it shows nothing."""


@dataclass(frozen=True, slots=True, eq=False)
class Marker:
    """A marker, resolved for a shape."""

    element: etree._Element
    style: ElementStyle
    window: ContentWindow
    anchor: tuple[float, float]  # the point that lies on the vertex, in the units around the window
    scale: float  # size of those units
    angle: float  # radians
    follows: bool  # True if the angle is relative to the outline


def has_markers(name: str, style: ElementStyle) -> bool:
    """Return whether an element of a name can have markers."""
    return name in MARKED and any(style[end].lower() != "none" for end in MARKERS)


def markers(scene: MarkerScene, element: etree._Element, place: ElementPlace) -> Iterator[list[PlacedElement]]:
    """Yield the content of each marker of a shape, in painting order; within a marker, the last is painted first."""
    shape = ShapeElement(element, place.style, place.viewport, ROUND * place.viewport.diagonal, scene.report)
    found = [read_marker(scene, name, shape, place) for name in MARKERS]
    if not any(found):
        return
    context = Context(place, cache(lambda: shape_outlines(shape)))
    points, angles = (array.tolist() for array in vertices(shape))
    ends = slice(0, 1), slice(1, -1), slice(-1, None)
    drawn = [(marker, where) for marker, where in zip(found, ends, strict=True) if marker and len(marker.element)]
    masks = place.deeper()
    scene.check_used(masks * sum(len(marker.element) * len(points[where]) for marker, where in drawn), masks)
    for marker, where in drawn:
        for point, direction in zip(points[where], angles[where], strict=True):
            yield marker_content(scene, marker, point, direction, place, context)


def marker_content(
    scene: MarkerScene,
    marker: Marker,
    point: tuple[float, float],
    direction: float,
    place: ElementPlace,
    context: Context,
) -> list[PlacedElement]:
    """Return the content of a marker on one vertex of a shape at a place."""
    (x, y), turn = marker.anchor, marker.angle + (direction if marker.follows else 0.0)
    matrix = Identity.translate(*point).rotate(turn).scale(marker.scale).translate(-x, -y)
    inner = ElementPlace(
        place.viewport,
        place.space.with_transform(matrix),
        marker.style,
        marker.element,
        place,
        place.depth + 1,
        used=True,
        veil=veil_of(marker.style, place.veil),
        masks=place.deeper(),
        name=place.name,
        is_instance=True,
        context=context,
    )
    inner, masking = add_masks(scene, marker.element, marker.window.within(inner))
    return [*((child, inner) for child in reversed(marker.element)), *reversed(masking)]


def read_marker(scene: MarkerScene, name: str, shape: ShapeElement, place: ElementPlace) -> Marker | None:
    """Return the marker that one of `MARKERS` gives a shape; None if it shows nothing."""
    element = scene.servers.referenced_element(name, "marker", place)
    if element is None:
        return None
    style = scene.servers.style_of(element)
    label = note_effects(scene, element, style)
    if label == HIDING:
        return None
    if label is not None:
        scene.report.left_out(label, element)
    scale = 1.0 if element.get("markerUnits") == "userSpaceOnUse" else shape.length("stroke-width") or 0.0
    own = ShapeElement(element, style, place.viewport, shape.tolerance, shape.report)
    width, height = side(own, "markerWidth", place.viewport.width), side(own, "markerHeight", place.viewport.height)
    window = scene.window(element, style, (0.0, 0.0, width, height))
    if window is None or scale == 0.0:
        return None
    content = window.content
    x, y = (anchor(own, key, whole) for key, whole in zip(("refX", "refY"), window.size, strict=True))
    on_vertex = content.xx * x + content.dx, content.yy * y + content.dy
    turn, follows = orientation(own, name)
    return Marker(element, style, window, on_vertex, scale, turn, follows)


def side(marker: ShapeElement, name: str, whole: float) -> float:
    """Return the width or height of a marker, in its units."""
    text = marker.element.get(name, DEFAULT_SIZE)
    length = marker.viewport.length(text, whole, marker.style.font_size)
    if length is None or length < 0.0:
        marker.report.invalid(name, text, marker.element)
        return float(DEFAULT_SIZE)
    return length


def anchor(marker: ShapeElement, name: str, whole: float) -> float:
    """Return a coordinate of a marker's reference point, in the units of its content.

    As in browsers, a keyword refers to the marker's own view box, and a percentage to the viewport around it.
    """
    text = marker.element.get(name, "0")
    word, view = KEYWORDS.get(text.strip()), marker.viewport
    if word is not None:
        view, text = Viewport(whole, whole), word
    length = view.length(text, view.width if name == "refX" else view.height, marker.style.font_size)
    if length is None:
        marker.report.invalid(name, text, marker.element)
    return length or 0.0


def orientation(marker: ShapeElement, name: str) -> tuple[float, bool]:
    """Return the angle of a marker in radians, and whether it is relative to the outline."""
    text = marker.element.get("orient", "0").strip()
    if text in ("auto", REVERSED):
        return (pi if text == REVERSED and name == MARKERS[0] else 0.0), True
    turn = angle(text)
    if turn is None:
        marker.report.invalid("orient", text, marker.element)
    return turn or 0.0, False


class Vertices(NamedTuple):
    """All vertices, in order."""

    points: NDArray[np.float64]  # (n, 2)
    angles: NDArray[np.float64]  # (n,), radians from the x axis to the y axis


def vertices(shape: ShapeElement) -> Vertices:
    """Return the vertices of a path, line, polyline or polygon; a closed part repeats its first one at its end."""
    if etree.QName(shape.element).localname == "path":
        pen = Segments(inf)
        pen.follow(path_data(shape))
        parts = pen.parts
    else:
        parts = [
            Subpath((x, y), o.cubics, o.closed) for o in shape_outlines(shape) for x, y in o.cubics[:1, 0].tolist()
        ]
    if not parts:
        return Vertices(np.empty((0, 2)), np.empty(0))
    points = np.concatenate([part.points for part in parts])
    check(points)
    return Vertices(points, np.concatenate([part.angles for part in parts]))


class Subpath(NamedTuple):
    """A subpath, with one curve for each segment."""

    start: Point
    cubics: NDArray[np.float64]  # (n, 4, 2)
    closed: bool
    joined: bool = False  # True if its first vertex is the last one of the part before it

    @property
    def points(self) -> NDArray[np.float64]:
        """Own vertices, (n + 1, 2) or (n, 2)."""
        ends: NDArray[np.float64] = self.cubics[:, 3]
        return ends if self.joined else np.concatenate([np.array([self.start]), ends])

    @property
    def angles(self) -> NDArray[np.float64]:
        """Direction at each vertex: halfway between those of the adjacent segments."""
        if not len(self.cubics):
            return np.zeros(1)
        leaving, arriving = (np.arctan2(found[:, 1], found[:, 0]) for found in directions(self.cubics))
        before = np.concatenate([arriving[-1:] if self.closed else leaving[:1], arriving])
        after = np.concatenate([leaving, leaving[:1] if self.closed else arriving[-1:]])
        turn = after - before
        before = before + 2.0 * np.pi * ((turn > np.pi).astype(np.float64) - (turn < -np.pi))
        halfway: NDArray[np.float64] = (before + after) / 2.0
        return halfway[1:] if self.joined else halfway


class Segments(PathPen):
    """Pen that keeps each segment as one curve with its end directions, including segments that paint nothing."""

    def __init__(self, tolerance: float) -> None:
        super().__init__(tolerance)
        self.parts: list[Subpath] = []
        self.joined: bool = False

    def draw(self, letter: str, text: str) -> None:
        """Draw a command; all commands but a move continue a closed part from its start."""
        super().draw(letter, text)
        self.joined = self.joined and letter not in "Mm"

    def arc_to(self, rx: float, ry: float, rotation: float, large: bool, sweep: bool, end: Point) -> None:
        """Draw an arc as one curve with the arc's ends and end directions."""
        first = len(self.cubics)
        super().arc_to(rx, ry, rotation, large, sweep, end)
        if len(self.cubics) > first:
            self.cubics[first:] = [self.cubics[first][:4] + self.cubics[-1][4:]]

    def close(self) -> None:
        """Close the part with a segment, which has zero length if the pen is back at the start."""
        if self.down and isclose(complex(*self.at), complex(*self.start), rel_tol=1e-15, abs_tol=1e-15):
            self.cubics.append(self.start * 4)
        super().close()

    def finish(self, closed: bool) -> None:
        """Store the part, if there is one; it may be a single point."""
        if self.down:
            self.parts.append(Subpath(self.start, np.array(self.cubics).reshape(-1, 4, 2), closed, self.joined))
            self.cubics, self.joined = [], closed


def directions(cubics: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the vectors along the start and along the end of each segment of a part, both (n, 2).

    A segment of zero length takes the end direction of the one before, and the start direction of the next (SVG 2,
    9.4).
    """
    leaving = first_step(cubics[:, 1:] - cubics[:, :1])
    arriving = first_step(cubics[:, 3:] - cubics[:, 2::-1])
    real: NDArray[np.bool_] = (leaving != 0.0).any(axis=1)
    if real.all():
        return leaving, arriving
    if not real.any():
        return np.tile(RIGHT, (len(cubics), 1)), np.tile(RIGHT, (len(cubics), 1))
    place = np.arange(len(cubics))
    before = np.maximum.accumulate(np.where(real, place, -1))
    after = np.minimum.accumulate(np.where(real, place, len(cubics))[::-1])[::-1]
    from_before, from_after = arriving[before], leaving[np.minimum(after, len(cubics) - 1)]
    has_before, has_after = (before >= 0)[:, None], (after < len(cubics))[:, None]
    starts = np.where(has_before, from_before, from_after)
    ends = np.where(has_after, from_after, from_before)
    return np.where(real[:, None], leaving, starts), np.where(real[:, None], arriving, ends)


def first_step(steps: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the first nonzero vector of three, (n, 3, 2), or zero."""
    first = np.argmax((steps != 0.0).any(axis=2), axis=1)
    step: NDArray[np.float64] = steps[np.arange(len(steps)), first]
    return step
