"""The context of an element: its user units, the viewports that clip it, and its inherited style."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from vexture.base.errors import SourceError
from vexture.bezier.clip import clip_contour
from vexture.svg.compositing import Veil
from vexture.svg.outline import ShapeOutline
from vexture.svg.style import INITIAL, ElementStyle
from vexture.svg.transform import Identity, Transform, map_points
from vexture.svg.values import LARGEST, TooLargeError, Viewport
from vexture.svg.viewport import Rectangle

MOST_MASKS = 32
"""Deepest nesting of clips, markers, masks and patterns."""

SMALLEST = 1 / LARGEST**4
"""Smallest determinant; below it, floating point cannot compute sizes in user units."""


@dataclass(frozen=True, slots=True, eq=False)
class Space:
    """A coordinate system inside nested viewports."""

    matrix: Transform = Identity  # map to the coordinates of `outer`, or of the drawing if there is none
    clip: Rectangle | None = None  # visible part, in those coordinates
    outer: "Space | None" = None  # coordinate system around the nearest clipping viewport
    whole: Transform = Identity  # map to the coordinates of the drawing

    @property
    def flat(self) -> bool:
        """True if shapes in it have no area in the drawing, or too little for floating point."""
        a, b, c, d = self.whole[:4]
        return bool(abs(a * d - b * c) < SMALLEST)

    def with_transform(self, matrix: Transform) -> "Space":
        """Return the coordinate system of an element with a transform."""
        whole = self.whole.transform(matrix)
        if not max(map(abs, whole)) <= LARGEST:
            raise TooLargeError(f"the transforms multiply to {max(map(abs, whole)):g}; the limit is {LARGEST:g}")
        return replace(self, matrix=self.matrix.transform(matrix), whole=whole)

    def window(self, visible: Rectangle, matrix: Transform) -> "Space":
        """Return the coordinate system inside a viewport that shows only `visible`, in these coordinates."""
        return replace(self.with_transform(matrix), matrix=matrix, clip=visible, outer=self)

    def to_drawing(self, contour: NDArray[np.float64]) -> NDArray[np.float64]:
        """Map a contour to the drawing's coordinates and clip it; return an empty contour if nothing is left."""
        space: Space | None = self
        while space is not None:
            if space.matrix != Identity:
                contour = map_points(contour, space.matrix)
            if space.clip is not None and len(contour):
                x, y, width, height = space.clip
                contour = clip_contour(contour, (x, y), (x + width, y + height))
            space = space.outer
        return contour


@dataclass(frozen=True, slots=True, eq=False)
class ElementPlace:
    """The context of an element in the drawing; `use` puts the same element in several places."""

    viewport: Viewport  # reference of percentages
    space: Space  # user units
    style: ElementStyle = INITIAL  # style to inherit
    element: etree._Element | None = None  # the parent, or the `use` that shows it
    outer: "ElementPlace | None" = None  # the place of `element`
    depth: int = 0  # number of elements around it
    used: bool = False  # True if one of them is a `use`
    use: ElementStyle | None = None  # style of the `use` whose target is here
    chosen: bool = True  # True if elements here are painted
    veil: Veil | None = None  # innermost veil around it
    is_clip: bool = False  # True if only the outlines of shapes count here
    masks: int = 0  # number of clips, markers, masks and patterns of which it is part
    filters: int = 0  # number of elements around it with a filter
    name: str = ""  # name of elements here: the nearest name around them, or that of the outermost `use`
    is_instance: bool = False  # True if the name is that of a `use`
    context: "Context | None" = None  # element that provides the paints of `context-fill` and `context-stroke`

    @property
    def position(self) -> tuple[float, float]:
        """Values of `x` and `y` of the element here."""
        x, y = self.style["x"], self.style["y"]
        view, font_size = self.viewport, self.style.font_size
        return view.length(x, view.width, font_size) or 0.0, view.length(y, view.height, font_size) or 0.0

    def deeper(self) -> int:
        """Return the depth inside one more clip, marker, mask or pattern; raise a `SourceError` if it is too deep."""
        if self.masks >= MOST_MASKS:
            what = "its clips, markers, masks and patterns"
            raise SourceError(f"{what} are nested more than {MOST_MASKS} deep; simplify them")
        return self.masks + 1

    def named(self, own: str, is_use: bool) -> tuple[str, bool]:
        """Return the name of an element here, and whether it is that of a `use`, whose whole content shares its name.

        `own` is the name of the element itself.
        """
        if self.is_instance or not own:
            return self.name, self.is_instance
        return own, is_use

    def inside(self, element: etree._Element) -> bool:
        """Return whether an element contains this place."""
        place: ElementPlace | None = self
        while place is not None:
            if place.element is element:
                return True
            place = place.outer
        return False


@dataclass(frozen=True, slots=True, eq=False)
class Context:
    """An element with markers, or a `use`, with the position of its paints (SVG 2, 13.2)."""

    place: ElementPlace  # inside the element, with its style
    outlines: Callable[[], list[ShapeOutline]]  # for the bounding box of gradients and patterns


@dataclass(frozen=True, slots=True)
class ContentWindow:
    """A viewport, with the position of its content."""

    visible: Rectangle | None  # None if its content may extend beyond it
    content: Transform  # from the units of its content to those around it
    size: tuple[float, float]  # reference of percentages in its content

    def within(self, place: ElementPlace) -> ElementPlace:
        """Return the place inside the viewport, if the viewport is at a place."""
        space = place.space.with_transform(self.content)
        if self.visible is not None:
            space = place.space.window(self.visible, self.content)
        width, height = self.size
        return replace(place, viewport=replace(place.viewport, width=width, height=height), space=space)


PlacedElement = tuple[etree._Element, ElementPlace]
"""An element, and the place around it."""
