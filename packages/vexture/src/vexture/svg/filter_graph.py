"""Evaluation of a filter element: its region, its steps and their inputs (Filter Effects 1, 9)."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from math import inf
from typing import Final, Protocol

from lxml import etree

from vexture.base.deadline import check_time
from vexture.drawing.paint import Paint
from vexture.svg.compositing import Box
from vexture.svg.document import local_name
from vexture.svg.filter_alpha import recolor
from vexture.svg.filter_composite import BLACK
from vexture.svg.filter_content import FilterContent, FilterLimitError, flood, meeting
from vexture.svg.filter_soft import Sources
from vexture.svg.images import ImageScene
from vexture.svg.masks import REGION, MeasuredScene
from vexture.svg.outline import ShapeOutline
from vexture.svg.painter import Painter
from vexture.svg.space import ElementPlace, PlacedElement
from vexture.svg.style import ElementStyle
from vexture.svg.values import Viewport, number, numbers
from vexture.svg.viewport import Rectangle

UNBOUNDED: Final[Box] = (-inf, -inf, inf, inf)
"""Region of the functions of CSS."""

SIDES: Final = ("x", "y", "width", "height")

WHOLE: Final = Viewport(1.0, 1.0)
"""Viewport for lengths in parts of the bounding box."""

OWN: Final = "/filter"
"""Suffix of the name of what a filter paints in a colour of its own."""

MOST_STEPS: Final = 500
"""Most steps of a filter that have an effect."""

STANDARD: Final = frozenset(
    {"SourceGraphic", "SourceAlpha", "BackgroundImage", "BackgroundAlpha", "FillPaint", "StrokePaint"}
)
"""Inputs that the standard names. Those of the background are transparent black, as in browsers."""

FILTERS: Final = frozenset(
    {
        *("Blend", "ColorMatrix", "ComponentTransfer", "Composite", "ConvolveMatrix", "DiffuseLighting"),
        *("DisplacementMap", "DropShadow", "Flood", "GaussianBlur", "Image", "Merge", "Morphology", "Offset"),
        *("SpecularLighting", "Tile", "Turbulence"),
    }
)
"""Names of steps, without their prefix."""


class FilterScene(MeasuredScene, ImageScene, Protocol):
    """The part of a scene that filters need."""

    sources: Sources

    def around(self, element: etree._Element, place: ElementPlace, stroked: bool = False) -> Rectangle | None:
        """Return the bounding box of an element's visible content, in the units of the place; None if there is none."""

    def walk(self, stack: list[PlacedElement], painter: Painter) -> None:
        """Paint all elements of a stack, the last first, with their content."""

    def box(self, place: ElementPlace) -> ShapeOutline:
        """Return the outline of the bounding box of the element at a place."""


@dataclass(slots=True)
class FilterSubject:
    """An element with a filter."""

    scene: FilterScene
    element: etree._Element
    place: ElementPlace  # inside the element
    content: Callable[[Callable[[ElementPlace, Painter], list[PlacedElement]]], FilterContent]
    """Paints something else at the place of the element."""
    remarks: dict[str, None] = field(default_factory=dict)  # what is not exact

    @property
    def own_name(self) -> str:
        """Name of what a filter paints in a colour of its own."""
        return self.place.name and self.place.name + OWN

    def sides(self, element: etree._Element, by_box: bool, box: Rectangle | None) -> list[float | None]:
        """Return the four sides of a region that an element gives: x, y, width and height; None are missing."""
        view = WHOLE if by_box else self.place.viewport
        wholes = (view.width, view.height)
        is_inside = element.getparent() is not None
        font_size = (self.scene.servers.style_of(element) if is_inside else self.place.style).font_size
        found: list[float | None] = []
        for k, name in enumerate(SIDES):
            text = element.get(name)
            length = None if text is None else view.length(text, wholes[k % 2], font_size)
            if text is not None and length is None:
                self.scene.report.invalid(name, text, element)
            if length is not None and by_box:
                assert box is not None
                length = length * box[2 + k % 2] + (box[k] if k < 2 else 0.0)
            found.append(length)
        return found


@dataclass(eq=False)
class StepResult:
    """The content that a step yields, with its region."""

    content: FilterContent
    region: Box
    is_standard: bool = False  # True for the inputs that the standard names


class FilterGraph:
    """The steps of one filter element, for one subject and what is drawn of it."""

    def __init__(self, element: etree._Element, subject: FilterSubject, source: FilterContent) -> None:
        self.element = element
        self.subject = subject
        self.by_box = element.get("primitiveUnits") == "objectBoundingBox"
        self.source = source
        self.region: Box = UNBOUNDED
        self.results: dict[int, StepResult] = {}

    @cached_property
    def box(self) -> Rectangle | None:
        """Bounding box of the subject, in its user units."""
        return self.subject.scene.around(self.subject.element, self.subject.place)

    def run(self, primitives: "dict[str, Callable[[FilterStep], FilterContent]]") -> FilterContent:
        """Return the result of the last step, for steps by their names."""
        by_box = self.element.get("filterUnits") != "userSpaceOnUse"
        is_bounded = self.element.getparent() is not None
        if (by_box or self.by_box) and is_bounded and (self.box is None or min(self.box[2:]) <= 0.0):
            return FilterContent()  # as in browsers
        if is_bounded:
            self.region = self.region_of(by_box)
        if not (self.region[0] < self.region[2] and self.region[1] < self.region[3]):
            return FilterContent()
        self.source = self.source.cut(self.region)
        steps = [FilterStep(self, child, k) for k, child in enumerate(filter(is_step, self.element))]
        last = len(steps) - 1
        for step in needed_steps(steps):
            primitive = primitives.get(step.name)
            if primitive is None:
                raise FilterLimitError("")
            check_time()
            region = step.region
            seen = meeting(region, self.region)
            content = FilterContent() if seen is None else primitive(step).cut(seen)
            self.subject.scene.sources.spend(1 + len(content.paths))
            self.results[step.index] = StepResult(content, region)
        return self.results[last].content

    def region_of(self, by_box: bool) -> Box:
        """Return the region of the filter."""
        defaults = etree.Element("filter", dict(REGION))
        given = self.subject.sides(self.element, by_box, self.box)
        initial = self.subject.sides(defaults, by_box, self.box)
        x, y, width, height = ((one if own is None else own) or 0.0 for own, one in zip(given, initial, strict=True))
        return x, y, x + width, y + height

    def standard(self, name: str) -> StepResult:
        """Return one of the inputs that the standard names."""
        match name:
            case "SourceGraphic":
                content = self.source
            case "SourceAlpha":
                content = recolor(self.source, BLACK, self.subject.own_name)
            case "FillPaint" | "StrokePaint":
                content = self.paint_of(name.lower().removesuffix("paint"))
            case _:
                self.subject.scene.report.once("left out", name, self.subject.element)
                content = FilterContent()
        return StepResult(content, self.region, is_standard=True)

    def paint_of(self, name: str) -> FilterContent:
        """Return the region in the paint of the subject, "fill" or "stroke"."""
        place = self.subject.place
        paint = self.subject.scene.servers.paint(name, place, [self.subject.scene.box(place)])
        if paint is not None and not isinstance(paint, Paint):
            self.subject.remarks["its pattern is drawn as solid"] = None
            paint = paint.solid
        return FilterContent() if paint is None else flood(self.region, paint, self.subject.own_name)


class FilterStep:
    """A step of a filter."""

    def __init__(self, graph: FilterGraph, element: etree._Element, index: int) -> None:
        self.graph = graph
        self.subject = graph.subject
        self.element = element
        self.index = index
        self.name = str(local_name(element))[2:]
        self.links: dict[str, int | str] = {}  # inputs by attribute: indices of steps, or names of the standard

    @cached_property
    def style(self) -> ElementStyle:
        """Style of the step."""
        return self.subject.scene.servers.style_of(self.element)

    @property
    def is_linear(self) -> bool:
        """True if colours are in linear light."""
        return self.style["color-interpolation-filters"].lower() == "linearrgb"

    @property
    def remarks(self) -> dict[str, None]:
        """Things that are not exact."""
        return self.subject.remarks

    def result(self, key: str = "in") -> StepResult:
        """Return an input."""
        link = self.links[key]
        if isinstance(link, int):
            return self.graph.results[link]
        return self.graph.standard(link)

    def input(self, key: str = "in") -> FilterContent:
        """Return the content of an input."""
        return self.result(key).content

    @cached_property
    def region(self) -> Box:
        """Part of the plane that the step fills (Filter Effects 1, 9.4)."""
        inputs = [self.result(key) for key in self.links]
        whole = self.graph.region
        left, top, right, bottom = whole
        if inputs and self.name != "Tile" and not any(each.is_standard for each in inputs):
            boxes = [each.region for each in inputs]
            left, top = min(box[0] for box in boxes), min(box[1] for box in boxes)
            right, bottom = max(box[2] for box in boxes), max(box[3] for box in boxes)
        if self.graph.element.getparent() is None:
            return left, top, right, bottom
        x, y, width, height = self.subject.sides(self.element, self.graph.by_box, self.graph.box)
        width, height = right - left if width is None else width, bottom - top if height is None else height
        left, top = left if x is None else x, top if y is None else y
        return left, top, left + width, top + height

    def number(self, name: str, default: float) -> float:
        """Return a number."""
        text = self.element.get(name)
        value = None if text is None else number(text)
        if text is not None and value is None:
            self.subject.scene.report.invalid(name, text, self.element)
        return default if value is None else value

    def numbers(self, name: str) -> list[float]:
        """Return numbers; none if they are missing or not valid."""
        text = self.element.get(name)
        if text is None or not text.strip():
            return []
        values = numbers(text)
        if values is None:
            self.subject.scene.report.invalid(name, text, self.element)
        return values or []

    def along(self, axis: int) -> float:
        """Return the size of a unit across (0) or down (1)."""
        box = self.graph.box
        return box[2 + axis] if self.graph.by_box and box is not None else 1.0


def is_step(element: etree._Element) -> bool:
    """Return whether an element is a step of a filter."""
    name = local_name(element)
    return name is not None and name[:2] == "fe" and name[2:] in FILTERS


def needed_steps(steps: list[FilterStep]) -> list[FilterStep]:
    """Link steps to their inputs; return those on which the last one depends, in order."""
    names: dict[str, int] = {}
    for k, step in enumerate(steps):
        for key, text in inputs_of(step):
            default: int | str = k - 1 if k else "SourceGraphic"
            text = (text or "").strip()
            step.links[key] = names.get(text, text if text in STANDARD else default)
        names[step.element.get("result", "").strip()] = k
        names.pop("", None)
    needed, open_steps = set[int](), [len(steps) - 1]
    while open_steps:
        k = open_steps.pop()
        if k not in needed:
            needed.add(k)
            open_steps += [link for link in steps[k].links.values() if isinstance(link, int)]
    if len(needed) > MOST_STEPS:
        raise FilterLimitError(f"it has {len(needed):,} steps; the limit is {MOST_STEPS:,}")
    return [steps[k] for k in sorted(needed)]


def inputs_of(step: FilterStep) -> list[tuple[str, str | None]]:
    """Return the keys and names of the inputs of a step."""
    if step.name in ("Flood", "Image", "Turbulence"):
        return []
    if step.name == "Merge":
        nodes = [child for child in step.element if local_name(child) == "feMergeNode"]
        return [(str(k), node.get("in")) for k, node in enumerate(nodes)]
    both = ("in", "in2") if step.name in ("Blend", "Composite", "DisplacementMap") else ("in",)
    return [(key, step.element.get(key)) for key in both]
