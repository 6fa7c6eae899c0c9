"""Markers on the vertices of a shape (SVG 2, 13.7)."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from math import pi
from typing import Protocol

from lxml import etree

from vexture.base.tolerance import ROUND
from vexture.svg.compositing import veil_of
from vexture.svg.declarations import MARKERS
from vexture.svg.masks import MeasuredScene, add_masks
from vexture.svg.shapes import ShapeElement, shape_outlines
from vexture.svg.space import ContentWindow, Context, ElementPlace, PlacedElement
from vexture.svg.style import ElementStyle
from vexture.svg.transform import KEYWORDS, Identity, angle
from vexture.svg.values import Viewport
from vexture.svg.vertices import vertices
from vexture.svg.viewport import Rectangle

MARKED = frozenset({"line", "path", "polygon", "polyline"})
DEFAULT_SIZE = "3"
REVERSED = "auto-start-reverse"


class MarkerScene(MeasuredScene, Protocol):
    """The part of a scene that markers need."""

    def check_used(self, more: int, masks: int) -> None:
        """Raise a `SourceError` if so many more elements are too many; `masks` as in `ElementPlace`."""

    def window(self, element: etree._Element, style: ElementStyle, sides: Rectangle) -> ContentWindow | None:
        """Viewport of an element with sides; None if it shows nothing."""

    def note_effects(self, element: etree._Element, style: ElementStyle) -> bool:
        """Note effects that are not supported; return whether anything is seen of an element with its filter."""


@dataclass(frozen=True, slots=True, eq=False)
class Marker:
    """A marker as a shape shows it."""

    element: etree._Element
    style: ElementStyle
    window: ContentWindow
    anchor: tuple[float, float]  # what of it lies on the vertex, in the units around the window
    scale: float  # of those units
    angle: float  # radians
    follows: bool  # whether the angle is from the direction of the outline


def has_markers(name: str, style: ElementStyle) -> bool:
    """Whether an element of a name may have markers."""
    return name in MARKED and any(style[end].lower() != "none" for end in MARKERS)


def markers(scene: MarkerScene, element: etree._Element, place: ElementPlace) -> Iterator[list[PlacedElement]]:
    """Content of each marker of a shape, in painting order; of each, what is painted first is last."""
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
    """Content of a marker on one vertex of a shape at a place."""
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
    """The marker that one of `MARKERS` gives a shape; None if it shows nothing."""
    element = scene.servers.referenced_element(name, "marker", place)
    if element is None:
        return None
    style = scene.servers.style_of(element)
    if not scene.note_effects(element, style):
        return None
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
    """Width or height of a marker, in its units."""
    text = marker.element.get(name, DEFAULT_SIZE)
    length = marker.viewport.length(text, whole, marker.style.font_size)
    if length is None or length < 0.0:
        marker.report.invalid(name, text, marker.element)
        return float(DEFAULT_SIZE)
    return length


def anchor(marker: ShapeElement, name: str, whole: float) -> float:
    """Coordinate of a marker's reference point, in the units of its content.

    A keyword is a part of the marker's own view box, and a percentage one of the viewport around, as in browsers.
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
    """Angle of a marker in radians, and whether it is from the direction of the outline."""
    text = marker.element.get("orient", "0").strip()
    if text in ("auto", REVERSED):
        return (pi if text == REVERSED and name == MARKERS[0] else 0.0), True
    turn = angle(text)
    if turn is None:
        marker.report.invalid("orient", text, marker.element)
    return turn or 0.0, False
