"""Paint servers: gradients and patterns."""

import re
from collections.abc import Callable, Hashable

from lxml import etree

from vexture.drawing.colors import CONTEXT, CURRENT, Color, PaintText, parse_paint
from vexture.drawing.paint import Paint, Stop
from vexture.svg.document import local_name
from vexture.svg.gradients import GRADIENTS, GradientRamp, read_ramp, stop_offsets
from vexture.svg.linear_light import stops_in_linear_light
from vexture.svg.links import Links, reference
from vexture.svg.meshes import MESHES, MeshGradient, read_mesh
from vexture.svg.outline import ShapeOutline
from vexture.svg.pattern_tiles import Budget, FirstTile
from vexture.svg.patterns import Pattern, Tiling, read_pattern
from vexture.svg.report import Report, describe_element
from vexture.svg.space import ElementPlace
from vexture.svg.style import Cascade, ElementStyle

UNKNOWN = {"meshgradient": "gradient mesh", "meshGradient": "gradient mesh", "hatch": "hatch"}
"""Names in notes of paint servers that cannot be read, or that are not supported. Pages support no meshes."""

GREY = Color((0.5, 0.5, 0.5), 1.0)
PATTERNS = frozenset({"pattern"})
MOST_STOPS = 128
"""Most stops of a gradient: half of the number that one paint of a pixel may go through (FORMAT.md, D.6)."""

MOST_ERROR = 1 / 255
"""Largest error of a gradient in linear light that no note tells."""

LINK = re.compile(r"\s*url\(\s*(['\"]?)(.*?)\1\s*\)\s*", re.DOTALL)


class PaintServers(Links):
    """Index of elements by `id`, and of the paints that shapes refer to."""

    def __init__(self, root: etree._Element, cascade: Cascade, report: Report) -> None:
        super().__init__(root)
        self.cascade = cascade
        self.report = report
        self.ramps: dict[etree._Element, GradientRamp | None] = {}
        self.patterns: dict[etree._Element, Pattern | None] = {}
        self.meshes: dict[etree._Element, MeshGradient | None] = {}
        self.styles: dict[etree._Element, ElementStyle] = {}
        self.budget: Budget = Budget(report)
        self.tiles: dict[tuple[Hashable, ...], FirstTile] = {}  # of patterns, as painted so far
        self.lacks_color = False  # True if something is painted in `currentcolor` without a value

    def referenced_element(self, name: str, kind: str, place: ElementPlace) -> etree._Element | None:
        """Return the element of a kind that a property refers to; None, with a note, if missing or an ancestor."""
        value = place.style[name]
        if value.lower() == "none":
            return None
        link = LINK.fullmatch(value)
        target = self.target(link[2]) if link is not None else None
        if target is None or local_name(target) != kind:
            self.report.left_out(f"{name} '{value[:40]}'", place.element)
        elif place.inside(target):
            self.report.left_out(f"{name} that refers to itself, of {describe_element(target)}", place.element)
        else:
            return target
        return None

    def paint(self, name: str, place: ElementPlace, outlines: list[ShapeOutline]) -> Paint | Tiling | None:
        """Return the paint of `name`, "fill" or "stroke", for outlines at a place; None if nothing is painted."""
        paint = self.found(name, place, lambda: outlines)
        paint = paint and paint.fade(place.style.opacity(f"{name}-opacity"))
        return paint if paint is not None and paint.opacity > 0.0 else None

    def found(
        self, name: str, place: ElementPlace, outlines: Callable[[], list[ShapeOutline]]
    ) -> Paint | Tiling | None:
        """Return the paint as `paint` does, without the opacity of the property."""
        text = parse_paint(place.style[name])
        if text is None:
            return None
        if text.reference is not None:
            return self.paint_of_reference(text, place, outlines())
        if text.color not in CONTEXT:
            return self.flat(text.color, place.style)
        if place.context is not None:
            return self.found(CONTEXT[text.color], place.context.place, place.context.outlines)
        color = self.cascade.page.context(text.color)
        if color is None and place.element is not None:
            self.report.once("left out", self.cascade.page.describe_missing(text.color, helps=True), place.element)
        return self.flat(color, place.style)

    def flat(self, color: Color | str | None, style: ElementStyle) -> Paint | None:
        """Return the paint of a flat colour."""
        if isinstance(color, str):
            self.lacks_color |= not style.has_color
            color = style.solid(color)
        if color is None:
            return None
        return Paint(color.rgb, color.alpha)

    def paint_of_reference(
        self, text: PaintText, place: ElementPlace, outlines: list[ShapeOutline]
    ) -> Paint | Tiling | None:
        """Return the paint of a reference to a paint server; its fallback if that is missing or has no area."""
        link = text.reference or ""
        server = self.target(link)
        name = local_name(server) if server is not None else None
        found: Paint | Tiling | None = None
        if server is not None and name in GRADIENTS:
            ramp = self.ramp(server)
            if ramp is None:
                return None
            found = ramp.paint(place, outlines)
        elif server is not None and name in PATTERNS:
            found = self.tiling(server, text.color, place, outlines)
        elif server is not None and name in MESHES and (mesh := self.mesh(server)) is not None:
            found = mesh.paint(place, outlines, self.report)
        else:
            where = "which is not in the drawing" if server is None else "which is no gradient or pattern"
            self.report.left_out(UNKNOWN.get(name or "", f"paint '{link[:40]}', {where}"), place.element)
        return self.flat(text.color, place.style) if found is None else found

    def tiling(
        self, server: etree._Element, fallback: Color | str | None, place: ElementPlace, outlines: list[ShapeOutline]
    ) -> Tiling | None:
        """Return the tiling of a pattern on outlines; None if it shows nothing."""
        pattern = self.pattern(server)
        if pattern is None:
            return None
        if place.inside(pattern.holder):
            self.report.left_out(f"pattern that refers to itself, of {describe_element(pattern.holder)}", place.element)
            return None
        solid = self.flat(fallback or GREY, place.style)
        return None if solid is None else pattern.tiling(place, outlines, solid)

    def pattern(self, element: etree._Element) -> Pattern | None:
        """Read a pattern and those that it refers to; None if they have no content."""
        if element not in self.patterns:
            chain = self.chain(element, PATTERNS)
            self.patterns[element] = read_pattern(chain, [*map(self.style_of, chain)], self.report)
        return self.patterns[element]

    def mesh(self, element: etree._Element) -> MeshGradient | None:
        """Read a gradient mesh and those that it refers to; None if it has no patches, or they are not valid."""
        if element not in self.meshes:
            chain = self.chain(element, MESHES)
            self.meshes[element] = read_mesh(chain, self.style_of(element), self.stop, self.report)
        return self.meshes[element]

    def chain(self, first: etree._Element, kinds: frozenset[str]) -> list[etree._Element]:
        """Return an element, the one it refers to, and so on, as long as they are of the given kinds."""
        chain: list[etree._Element] = []
        element: etree._Element | None = first
        while element is not None and element not in chain and local_name(element) in kinds:
            chain.append(element)
            element = self.target(reference(element) or "")
        return chain

    def ramp(self, gradient: etree._Element) -> GradientRamp | None:
        """Read a gradient and those that it refers to; None if they have no stops."""
        if gradient not in self.ramps:
            chain = self.chain(gradient, GRADIENTS)
            stops = next(filter(None, map(self.stops, chain)), None)
            style = self.style_of(gradient)
            if stops is not None and style["color-interpolation"].lower() == "linearrgb":
                stops, error = stops_in_linear_light(stops, MOST_STOPS)
                if error > MOST_ERROR:
                    self.report.simplification(
                        f"gradient in linear light (color-interpolation) of many stops, up to {255 * error:g}/255",
                        gradient,
                    )
            self.ramps[gradient] = None if stops is None else read_ramp(chain, stops, style, self.report)
        return self.ramps[gradient]

    def stops(self, gradient: etree._Element) -> tuple[Stop, ...]:
        """Return the stops that a gradient itself contains."""
        elements = [child for child in gradient if local_name(child) == "stop"]
        offsets = stop_offsets(elements, self.report)
        stops = tuple(self.stop(element, offset) for element, offset in zip(elements, offsets, strict=True))
        if len(stops) <= MOST_STOPS:
            return stops
        self.report.simplification(f"gradient of more than {MOST_STOPS} stops, of which as many are kept", gradient)
        return tuple(stops[(len(stops) - 1) * k // (MOST_STOPS - 1)] for k in range(MOST_STOPS))

    def stop(self, element: etree._Element, offset: float) -> Stop:
        """Return a stop at an offset."""
        style = self.style_of(element)
        self.lacks_color |= not style.has_color and CURRENT in style["stop-color"].lower()
        color = style.solid(style["stop-color"]) or style.color
        return Stop(offset, color.rgb, color.alpha * style.opacity("stop-opacity"))

    def style_of(self, element: etree._Element) -> ElementStyle:
        """Return the style of an element at its own position in the document."""
        style = self.cascade.initial
        for around in reversed([element, *element.iterancestors()]):
            if around not in self.styles:
                self.styles[around] = self.cascade.style(around, style)
            style = self.styles[around]
        return style
