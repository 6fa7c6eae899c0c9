"""Walk through an SVG document in painting order.

The walk has its own stack, so that deep nesting cannot exhaust Python's. `use` is expanded during the walk, within
limits.
"""

from collections.abc import Sequence
from copy import copy
from dataclasses import replace
from functools import cache, partial
from math import inf
from os import PathLike

import numpy as np
from lxml import etree

from vexture.base.deadline import check_time
from vexture.base.errors import SourceError
from vexture.bezier.bounds import bounds
from vexture.drawing.drawing import FillRule, Path
from vexture.drawing.group import Group
from vexture.svg.angular import angular_fill, paint_angular
from vexture.svg.animations import ANIMATIONS
from vexture.svg.compositing import Veil, group_paths, veil_of
from vexture.svg.css_gradients import background_of
from vexture.svg.document import HTML, applies, local_name
from vexture.svg.filter_soft import Sources
from vexture.svg.filtering import note_effects, paint_filtered
from vexture.svg.filters import HIDING
from vexture.svg.gradients import rows
from vexture.svg.images import Images, image_sides, paint_image
from vexture.svg.links import reference
from vexture.svg.markers import has_markers, markers
from vexture.svg.masks import MASKING, add_masks, note_outer_units
from vexture.svg.names import ElementNames
from vexture.svg.note_elements import Boxes, boxes_of
from vexture.svg.outline import ShapeOutline
from vexture.svg.page import ENCLOSED, Page
from vexture.svg.paint_servers import PaintServers
from vexture.svg.painter import Painter, Ruler
from vexture.svg.pattern_tiles import Canvas
from vexture.svg.report import LocatedError, Report, describe_element
from vexture.svg.shapes import SHAPES, ShapeElement, shape_outlines
from vexture.svg.space import ContentWindow, Context, ElementPlace, PlacedElement, Space
from vexture.svg.spatial import TRANSFORMS, element_transform
from vexture.svg.style import Cascade, ElementStyle
from vexture.svg.text.typesetter import Typesetter
from vexture.svg.transform import Identity, Transform, parse_origin
from vexture.svg.unsupported import note_unsupported
from vexture.svg.values import TooLargeError, Viewport
from vexture.svg.viewport import CENTRED, THINNEST, Rectangle, parse_fit, view_box, view_transform

MOST_USED = 50_000
"""Most elements that `use`, clips, markers, masks and first tiles show; repeated and nested ones count each time."""

DEEPEST = 1_000
"""Deepest nesting of elements, including those that `use` adds."""

CONTAINERS = frozenset({"a", "g", "svg", "switch", "symbol"})
UNPAINTED = frozenset(
    {
        *("clipPath", "color-profile", "cursor", "defs", "desc", "filter", "font", "font-face", "hatch"),
        *("linearGradient", "marker", "mask", "meshgradient", "metadata", "pattern", "radialGradient", "script"),
        *ANIMATIONS,
        *("solidcolor", "style", "title", "view"),
    }
)
"""Elements that paint nothing by themselves."""

DRAWN = frozenset({*SHAPES, *CONTAINERS, "image", "text", "use"})
"""Elements that are drawn; a `switch` prefers them to unknown ones."""

BOXED = {"foreignObject": paint_angular, "image": paint_image}
"""Elements with sides that paint something between them."""


class SvgScene:
    """A document to paint: all of it, or the elements in `chosen` with all their content."""

    def __init__(
        self,
        root: etree._Element,
        report: Report,
        images: Images,
        chosen: set[etree._Element] | None = None,
        names: str = "id",
        fonts: Sequence[str | PathLike[str]] = (),
        page: Page = ENCLOSED,
    ) -> None:
        self.root = root
        self.chosen = chosen
        self.names = ElementNames(root, names)
        self.report = report
        self.images = images
        self.cascade: Cascade = Cascade(root, report, page)
        self.servers: PaintServers = PaintServers(root, self.cascade, report)
        self.style: ElementStyle = self.cascade.style(root, self.cascade.initial)
        self.used: int = 0
        self.typesetter: Typesetter = Typesetter(fonts, self.cascade.sheets.font_faces, report)
        self.sources: Sources = Sources()  # of blurs
        self.boxes: Boxes = {}  # boxes of the elements in notes, after painting

    def paint(
        self,
        viewport: Viewport,
        matrix: Transform,
        frame: Rectangle | None,
        size: tuple[float, float] | None = None,
    ) -> tuple[list[Path], tuple[Group, ...]]:
        """Paint everything, and determine the groups.

        Percentages at the root refer to `viewport`, and `matrix` maps user units to the drawing. `frame` is the visible
        part of the drawing, or None while it is unknown; `size` is that of the outermost viewport, if it has one. Raise
        a `SourceError` if a limit is exceeded.
        """
        canvas = Canvas(frame, inf if frame is None else max(frame[2:]))
        painter = Painter(self.servers, self.report, canvas, self.walk)
        chosen = self.chosen is None or self.root in self.chosen
        called = self.names.of(self.root)
        place = ElementPlace(viewport, Space(), self.style, self.root, chosen=chosen, name=called)
        self.walk(self.inside_root(place, painter, matrix, frame, size), painter)
        plain = zip(painter.paths, painter.places, strict=True)
        self.boxes = boxes_of(self.report.elements, [*plain, *painter.filtered])
        return group_paths(painter.paths, painter.veils)

    def inside_root(
        self,
        place: ElementPlace,
        painter: Painter,
        content: Transform,
        frame: Rectangle | None,
        size: tuple[float, float] | None,
    ) -> list[PlacedElement]:
        """Return the content of the outermost element at a place whose background fills `frame`.

        `content` maps the user units inside the element to those of the place; `size` is the size of its viewport
        there.
        """
        note_unsupported(self.root, self.style, self.servers, self.report, self.chosen)
        opacity = self.style.opacity("opacity")
        label = note_effects(self, self.root, self.style)
        if self.style["display"].lower() == "none" or opacity == 0.0 or label == HIDING:
            return []
        around = place.space
        place = replace(place, space=self.space_inside(around, content, size, is_cut=frame is not None))
        if opacity < 1.0 or place.outer is not None or not MASKING.keys().isdisjoint(self.style.own):
            place = replace(place, veil=Veil(place.veil, opacity))  # there is nothing to blend with
        note_outer_units(self, self.root, self.style, size)
        place, stack = add_masks(self, self.root, place)

        def paint(place: ElementPlace, painter: Painter) -> list[PlacedElement]:
            if place.chosen and frame is not None:
                whole, into = [ShapeOutline.rectangle(*frame).loop], rows(around.whole.inverse())
                for paint in background_of(self.style, frame):
                    painter.add(whole, replace(place, space=around), FillRule.NONZERO, paint.after(into), place.name)
            return [(child, place) for child in self.root]

        if label is None:
            return [*stack, *reversed(paint(place, painter))]
        return [*stack, *reversed(paint_filtered(self, self.root, place, painter, label, paint))]

    def space_inside(
        self, around: Space, content: Transform, size: tuple[float, float] | None, *, is_cut: bool
    ) -> Space:
        """Return the space inside the outermost element, with the parameters of `inside_root`.

        The element is a CSS box, which its transform moves as a whole, by default about its centre (CSS Transforms 1,
        5).
        """
        if size is not None and not self.style.own.keys().isdisjoint(TRANSFORMS):
            own = {"transform-origin": "center", **self.style.own, "transform-box": "view-box"}
            box = ElementPlace(Viewport(*size, self.style.font_size), around)
            try:
                matrix = self.transform(self.root, replace(self.style, own=own), box)
                inner = around.with_transform(matrix)
                return inner.window((0.0, 0.0, *size), content) if is_cut else inner.with_transform(content)
            except TooLargeError as error:
                self.report.left_out(f"transform of the outermost <svg>: {error}", self.root)
        return around.with_transform(content)

    def paint_embedded(self, root: etree._Element, place: ElementPlace, painter: Painter) -> None:
        """Paint another document at a place inside its viewport; nothing of this document applies to it."""
        scene = SvgScene(root, self.report, self.images.inside, fonts=self.typesetter.files)
        scene.used, scene.sources = self.used, self.sources
        size, content = (place.viewport.width, place.viewport.height), Identity
        box = scene.view(root)
        if box is not None and min(box[2:]) < THINNEST:
            return
        if box is not None:
            content = scene.fit(root, box, *size)
        width, height = size if box is None else box[2:]
        viewport = Viewport(width, height, scene.style.font_size, size)
        place = replace(place, viewport=viewport, style=scene.style, element=root, outer=place, depth=place.depth + 1)
        own = painter.for_document(scene.servers, scene.walk)
        place = replace(place, chosen=True, is_instance=True, context=None)
        scene.walk(scene.inside_root(place, own, content, (0.0, 0.0, *size), size), own)
        painter.segments, self.used = own.segments, scene.used

    def walk(self, stack: list[PlacedElement], painter: Painter) -> None:
        """Paint all elements of a stack, the last first, with their content."""
        while stack:
            check_time()
            element, place = stack.pop()
            count = place.masks or int(place.used)
            self.check_used(count, place.masks)
            self.used += count
            try:
                stack.extend(reversed(self.visit(element, place, painter)))
            except LocatedError:
                raise
            except TooLargeError as error:
                self.report.left_out(f"{describe_element(element)}: {error}", element)
            except SourceError as error:
                raise LocatedError(f"{describe_element(element)}: {error}") from None

    def check_used(self, more: int, masks: int) -> None:
        """Raise a `SourceError` if `more` further elements are too many; `masks` as in `ElementPlace`."""
        if self.used + more > MOST_USED:
            what = "<use>, clips, markers, masks and patterns show" if masks else "<use> shows"
            raise SourceError(f"{what} more than {MOST_USED:,} elements (a use bomb?); draw fewer copies")

    def visit(self, element: etree._Element, place: ElementPlace, painter: Painter) -> list[PlacedElement]:
        """Paint an element, or return the elements that it shows."""
        name = local_name(element)
        if name is None and (str(element.tag).rpartition("}")[2] in DRAWN or str(element.tag).startswith(HTML)):
            self.report.left_out(f"{describe_element(element)}, of another namespace", element)
        if name is None or name in UNPAINTED or (name == "symbol" and place.use is None) or not applies(element):
            return []
        chosen = place.chosen or (self.chosen is not None and element in self.chosen)
        style = self.cascade.style(element, place.style)
        is_measured = isinstance(painter, Ruler)  # visible or not (SVG 2, 8.10)
        is_seen = place.is_clip or is_measured or style.opacity("opacity") > 0.0
        if style["display"].lower() == "none" or not is_seen or (place.is_clip and name in CONTAINERS):
            return []  # a clip contains only shapes, and uses of shapes
        if name not in DRAWN and not (name == "foreignObject" and angular_fill(element)):
            if chosen:
                self.report.left_out(f"<{name[:40]}>", element)
            return []
        if (name in SHAPES or name in BOXED) and not chosen:
            return []
        label = None if place.is_clip or is_measured else note_effects(self, element, style)
        if label == HIDING:
            return []
        matrix = self.transform(element, style, place)
        if place.depth >= DEEPEST:
            raise SourceError(f"it stands inside {DEEPEST:,} others; flatten the groups or the uses")
        space, depth = place.space.with_transform(matrix), place.depth + 1
        veil = veil_of(style, place.veil, place.is_clip)
        inner = replace(place, space=space, style=style, element=element, outer=place, depth=depth)
        called, is_instance = place.named(self.names.of(element), name == "use")
        inner = replace(inner, use=None, chosen=chosen, veil=veil, name=called, is_instance=is_instance)
        shown = list[PlacedElement]()
        if name == "use":  # its clips and masks move with it
            inner = replace(inner, space=space.with_transform(Identity.translate(*inner.position)))
        if name in ("svg", "symbol"):  # as in browsers, its clips and masks are in the units of its content
            window = self.window(element, style, self.sides(inner, place.use))
            if window is None:
                return []
            inner = window.within(inner)
        if not is_measured:
            inner, shown = add_masks(self, element, inner, ("clip-path",) if inner.is_clip else tuple(MASKING))
        if label is None:
            return [*shown, *self.content(element, inner, painter)]
        return [*shown, *paint_filtered(self, element, inner, painter, label, partial(self.content, element))]

    def content(self, element: etree._Element, inner: ElementPlace, painter: Painter) -> list[PlacedElement]:
        """Paint a shape, or return the elements that another element shows; `inner` is the place inside."""
        name = local_name(element) or ""
        if name in SHAPES:
            marked = not inner.is_clip and has_markers(name, inner.style)
            painter.paint(element, inner, markers(self, element, inner) if marked else ())
            return []
        if name == "text":
            painter.paint_text(self.typesetter.text(self, element, inner), inner)
            return []
        if name in BOXED:
            if isinstance(painter, Ruler):
                painter.measure(inner, ShapeOutline.rectangle(*image_sides(inner, (0.0, 0.0))))
            elif not inner.is_clip:
                BOXED[name](self, element, inner, painter)
            return []
        if name == "use":
            return self.use_target(element, inner)
        return [(child, inner) for child in (switch_children(element) if name == "switch" else element)]

    def extent(self, element: etree._Element, place: ElementPlace) -> Rectangle | None:
        """Return the box as `around` does, without strokes; None if it has no area."""
        box = self.around(element, place)
        return box if box is not None and min(box[2:]) > 0.0 else None

    def around(self, element: etree._Element, place: ElementPlace, stroked: bool = False) -> Rectangle | None:
        """Return the bounding box of an element's content, without masks, in the units of the place; None if empty."""
        silent = copy(self)
        silent.report = Report()
        silent.cascade = copy(self.cascade)
        silent.cascade.report = silent.report
        ruler = Ruler(self.servers, silent.report, self.walk, stroked)
        stack = silent.content(element, replace(place, space=Space(), chosen=True), ruler)
        silent.walk(stack, ruler)
        if not ruler.corners:
            return None
        left, top, right, bottom = bounds(np.concatenate(ruler.corners))
        return left, top, right - left, bottom - top

    def box(self, place: ElementPlace) -> ShapeOutline:
        """Return the outline of the bounding box of the element at a place; a point if the box has no area."""
        assert place.element is not None
        return ShapeOutline.rectangle(*(self.extent(place.element, place) or (0.0, 0.0, 0.0, 0.0)))

    def use_target(self, element: etree._Element, place: ElementPlace) -> list[PlacedElement]:
        """Return the element that a `use` shows."""
        link = reference(element) or ""
        target = self.servers.target(link)
        if target is None:
            self.report.left_out(f"<use> of '{link[:40]}', which is not in the drawing", element)
            return []
        if place.inside(target):
            self.report.left_out(f"{describe_element(element)} that shows itself", element)
            return []
        context = Context(place, cache(lambda: [self.box(place)]))
        return [(target, replace(place, used=True, use=place.style, context=context))]

    def sides(self, place: ElementPlace, use: ElementStyle | None) -> Rectangle:
        """Return the viewport of a nested `<svg>` or a `<symbol>`; a `use` may override its size."""
        style = place.style
        sides = []
        for name, whole in (("width", place.viewport.width), ("height", place.viewport.height)):
            text = style[name] if use is None or use[name].lower() == "auto" else use[name]
            auto = text.lower() == "auto"
            sides.append(whole if auto else place.viewport.length(text, whole, style.font_size) or 0.0)
        return *place.position, sides[0], sides[1]

    def window(self, element: etree._Element, style: ElementStyle, sides: Rectangle) -> ContentWindow | None:
        """Return the viewport of an element with sides; None if it shows nothing."""
        x, y, width, height = sides
        if width <= 0.0 or height <= 0.0:
            return None
        box = self.view(element) or (0.0, 0.0, width, height)
        if min(box[2:]) < THINNEST:
            return None
        content = Identity.translate(x, y).transform(self.fit(element, box, width, height))
        return ContentWindow(None if style["overflow"].lower() in ("visible", "auto") else sides, content, box[2:])

    def view(self, element: etree._Element) -> Rectangle | None:
        """Return the `viewBox` of an element; None without a valid one."""
        text = element.get("viewBox")
        box = None if text is None else view_box(text)
        if text is not None and box is None:
            self.report.invalid("viewBox", text, element)
        return box

    def fit(self, element: etree._Element, box: Rectangle, width: float, height: float) -> Transform:
        """Return the map from a view box to a viewport, according to the element's `preserveAspectRatio`."""
        fit = CENTRED
        text = element.get("preserveAspectRatio")
        if text is not None:
            parsed = parse_fit(text)
            if parsed is None:
                self.report.invalid("preserveAspectRatio", text, element)
            fit = parsed or CENTRED
        return view_transform(box, fit, width, height)

    def transform(self, element: etree._Element, style: ElementStyle, place: ElementPlace) -> Transform:
        """Return the transform of an element by its properties, about its origin."""
        if style.own.keys().isdisjoint(TRANSFORMS):
            return Identity
        left, top, width, height = 0.0, 0.0, place.viewport.width, place.viewport.height
        if style["transform-box"].lower() != "view-box":
            shape = ShapeElement(element, style, place.viewport, inf, self.report)
            outlines = shape_outlines(shape) if local_name(element) in SHAPES else []
            if outlines:
                left, top, right, bottom = bounds(np.concatenate([outline.cubics for outline in outlines]))
                width, height = right - left, bottom - top
            else:
                self.report.simplification("transform-box of a group read as view-box", element)

        def length(value: str, axis: int) -> float | None:
            return place.viewport.length(value, (width, height)[axis], style.font_size)

        matrix, invalid, deep = element_transform(style.own, length)
        for name in invalid:
            self.report.invalid(name, style[name], element)
        if deep:
            self.report.left_out("perspective", element)
        origin = parse_origin(style["transform-origin"], length)
        if origin is None:
            self.report.invalid("transform-origin", style["transform-origin"], element)
            return matrix
        if matrix == Identity:
            return matrix
        x, y = left + origin[0], top + origin[1]
        return Identity.translate(x, y).transform(matrix).translate(-x, -y) if x or y else matrix


def switch_children(switch: etree._Element) -> list[etree._Element]:
    """Return the child that a `switch` shows, the first suitable one; without one, all of them, for their notes."""
    children = [child for child in switch if local_name(child) is not None and applies(child)]
    return [child for child in children if local_name(child) in DRAWN][:1] or children
