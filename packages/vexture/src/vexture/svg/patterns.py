"""SVG patterns: their elements, and the position of their tiles on the painted shapes (SVG 2, 14.3)."""

from collections.abc import Callable, Hashable
from dataclasses import dataclass, replace
from typing import Final, TypeVar

import numpy as np
from lxml import etree

from vexture.bezier.bounds import bounds
from vexture.drawing.paint import Paint
from vexture.svg.compositing import Veil
from vexture.svg.document import local_name
from vexture.svg.gradients import BOXED, SHORTEST, WHOLE, transform_of
from vexture.svg.outline import ShapeOutline
from vexture.svg.report import Report
from vexture.svg.space import SMALLEST, ElementPlace, PlacedElement, Space
from vexture.svg.style import ElementStyle
from vexture.svg.transform import Identity, Transform, about_origin
from vexture.svg.values import Viewport
from vexture.svg.viewport import CENTRED, THINNEST, Rectangle, ViewBoxFit, parse_fit, view_box, view_transform

SIZES: Final = ("width", "height")
LENGTHS: Final = ("x", "y", *SIZES)
Value = TypeVar("Value")


@dataclass(frozen=True, slots=True, eq=False)
class Pattern:
    """A pattern as defined by its element and those it refers to, without a position yet."""

    element: etree._Element
    holder: etree._Element  # its children are painted
    style: ElementStyle  # style that the children inherit
    lengths: tuple[str, ...]  # one for each of `LENGTHS`
    font_size: float  # font size of the element
    boxed: bool  # True if the lengths are parts of the bounding box
    box_is_unit: bool  # True if the content is in parts of the bounding box
    moved: Transform  # `patternTransform`
    origin: str  # origin of the transform
    view: Rectangle | None
    fit: ViewBoxFit

    def tiling(self, place: ElementPlace, outlines: list[ShapeOutline], solid: Paint) -> "Tiling | None":
        """Return the tiles on outlines at a place; None if they have no area there."""
        left, top, right, bottom = bounds(np.concatenate([outline.cubics for outline in outlines]))
        width, height = right - left, bottom - top
        view = WHOLE if self.boxed else place.viewport
        whole = place.space.whole.transform(about_origin(self.moved, self.origin, place.viewport.along(self.font_size)))
        a, b, c, d = whole[:4]
        if not SMALLEST <= abs(a * d - b * c) <= 1.0 / SMALLEST:
            return None
        tile = self.in_view(view)
        if self.boxed:
            tile = left + tile[0] * width, top + tile[1] * height, tile[2] * width, tile[3] * height
        if min(tile[2:]) < SHORTEST or (self.view is not None and min(self.view[2:]) < THINNEST):
            return None
        content, viewport = Identity.translate(*tile[:2]), place.viewport
        if self.view is not None:
            content = content.transform(view_transform(self.view, self.fit, *tile[2:]))
            viewport = replace(viewport, width=self.view[2], height=self.view[3])
        elif self.box_is_unit:
            content = content.scale(width, height)
        return Tiling(self, tile, Space(whole=whole), content, viewport, solid)

    def in_view(self, view: Viewport) -> Rectangle:
        """Return the first tile; percentages refer to a viewport."""
        wholes = (view.width, view.height) * 2
        pairs = zip(self.lengths, wholes, strict=True)
        x, y, width, height = (view.length(text, whole, self.font_size) or 0.0 for text, whole in pairs)
        return x, y, width, height


@dataclass(frozen=True, slots=True, eq=False)
class Tiling:
    """A pattern with its position on a painted shape."""

    pattern: Pattern
    tile: Rectangle  # the first tile, in the units of `space`
    space: Space  # coordinate system in which the tiles are upright
    content: Transform  # from the units of the pattern's content to those of `space`
    viewport: Viewport  # reference of percentages in the content
    solid: Paint  # fallback where tiles are not possible
    opacity: float = 1.0

    @property
    def key(self) -> tuple[Hashable, ...]:
        """Everything that the first tile depends on."""
        return self.pattern, self.tile, self.space.whole, self.content, self.viewport

    def fade(self, opacity: float) -> "Tiling":
        """Return the tiling with its opacity multiplied."""
        return replace(self, solid=self.solid.fade(opacity), opacity=opacity * self.opacity)

    def first_tile_content(self, place: ElementPlace, veil: Veil) -> list[PlacedElement]:
        """Return the elements to paint as the first tile, for a shape at a place."""
        pattern = self.pattern
        inner = ElementPlace(
            self.viewport,
            self.space.window(self.tile, self.content),
            pattern.style,
            pattern.holder,
            place,
            place.depth + 1,
            used=True,
            veil=veil,
            masks=place.deeper(),
            is_instance=True,
        )
        return [(child, inner) for child in reversed(pattern.holder)]


def read_pattern(chain: list[etree._Element], styles: list[ElementStyle], report: Report) -> Pattern | None:
    """Read the first of some pattern elements, each of which refers to the next; None if they have no content."""

    def read_attribute(name: str, parse: Callable[[str], Value | None], default: Value) -> Value:
        element = next((element for element in chain if element.get(name) is not None), None)
        text = "" if element is None else element.get(name, "")
        value = default if element is None else parse(text)
        if value is None and element is not None:
            report.invalid(name, text, element)
        return default if value is None else value

    holders = (k for k, element in enumerate(chain) if any(local_name(child) for child in element))
    holder = next(holders, None)
    if holder is None:
        return None
    words = (text for element in chain if (text := element.get("patternTransform")) is not None)
    text, moved = transform_of(next(words, ""), chain[0], styles[0])
    if moved is None:
        report.invalid("patternTransform", text, chain[0])
    return Pattern(
        chain[0],
        chain[holder],
        styles[holder],
        tuple(read_attribute(name, size_text if name in SIZES else length_text, "0") for name in LENGTHS),
        styles[0].font_size,
        read_attribute("patternUnits", lambda text: BOXED.get(text.strip()), True),
        read_attribute("patternContentUnits", lambda text: BOXED.get(text.strip()), False),
        moved or Identity,
        styles[0]["transform-origin"],
        read_attribute("viewBox", view_box, None),
        read_attribute("preserveAspectRatio", parse_fit, CENTRED),
    )


def length_text(text: str) -> str | None:
    """Return a length unchanged; None if it is not valid."""
    return None if WHOLE.length(text, 1.0, 1.0) is None else text


def size_text(text: str) -> str | None:
    """Return a length unchanged; None if it is not valid or negative."""
    return text if (WHOLE.length(text, 1.0, 1.0) or 0.0) >= 0.0 and length_text(text) else None
