"""Steps of filters that have no exact form: their results are pictures that a function makes of the pixels of inputs.

The pixels of one filter form one square. So a step whose only input is such a picture reads its pixels as they are.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np
from lxml import etree

from vexture.drawing.affine import Affine
from vexture.drawing.effect import Effect, Pixels
from vexture.drawing.paint import Paint
from vexture.svg.compositing import Box
from vexture.svg.document import local_name
from vexture.svg.filter_colors import ColorFunction
from vexture.svg.filter_content import FilterContent, InexactError, flood, meeting
from vexture.svg.filter_frame import EdgeMode, PixelFrame, crop
from vexture.svg.filter_graph import FilterStep
from vexture.svg.filter_operations import (
    ColorMapping,
    Convolution,
    Displacement,
    DistantLight,
    Lighting,
    LightSource,
    Morphology,
    Operation,
    PointLight,
    PorterDuff,
    RasterStep,
    SpotLight,
    Turbulence,
)
from vexture.svg.filter_pixels import limit_colors
from vexture.svg.filter_raster import FilterValue, check_steps, evaluate_step
from vexture.svg.filter_soft import source_of

EDGES: Final[dict[str, EdgeMode]] = {"none": "none", "duplicate": "duplicate", "wrap": "wrap"}

CHANNELS: Final = "RGBA"


@dataclass(frozen=True, slots=True, eq=False)
class StepProcess:
    """A step as a function of the pixels of its inputs' sources."""

    step: RasterStep
    parts: tuple[Effect, ...]  # the inputs
    regions: tuple[Box, ...]  # of the inputs
    frame: PixelFrame
    region: Box  # of the filter

    def __call__(self, rasters: tuple[Pixels, ...]) -> Pixels:
        """Return the pixels of the result."""
        values, rest = list[FilterValue](), rasters
        for part, region in zip(self.parts, self.regions, strict=True):
            pixels, rest = part.process(rest[: len(part.sources)]), rest[len(part.sources) :]
            values.append(FilterValue(crop(limit_colors(pixels), self.frame, region), False, region))
        if not values:
            values.append(FilterValue(np.zeros((self.frame.rows, self.frame.columns, 4)), False, self.frame.bounds))
        result = evaluate_step(self.step, values, self.frame, self.region)
        return limit_colors(result.convert(is_linear=False).pixels)


def first_raster(rasters: tuple[Pixels, ...]) -> Pixels:
    """Return the pixels of the only source."""
    return rasters[0]


def sample_step(step: FilterStep, operation: Operation) -> FilterContent:
    """Return the result of a step as a picture, and note its density."""
    left, top, right, bottom = square = square_of(step)
    visible = meeting(meeting(step.region, step.graph.region) or (0.0, 0.0, 0.0, 0.0), square)
    if visible is None:
        return FilterContent()
    depth = step.subject.scene.sources.depth_of(step.graph)
    pixel = (right - left) / (1 << depth)
    frame = PixelFrame(left, top, pixel, pixel, 1 << depth, 1 << depth)
    inputs = [step.result(key) for key in step.links]
    raster_step = RasterStep(operation, tuple(step.links), "", step.region, step.is_linear)
    check_steps([raster_step], frame)
    step.remarks[f"{words_of(step.name)} as a picture of {1 << depth} x {1 << depth} pixels"] = None
    side = right - left
    to_source: Affine = (1.0 / side, 0.0, -left / side), (0.0, -1.0 / side, bottom / side)
    parts = [effect_in(square, to_source, depth, each.content, len(inputs) == 1) for each in inputs]
    sources = tuple(source for part in parts for source in part.sources)
    for source in sources:
        step.subject.scene.sources.check(source)
    regions = tuple(meeting(each.region, square) or (left, top, left, top) for each in inputs)

    region = meeting(step.graph.region, square) or square
    process = StepProcess(raster_step, tuple(parts), regions, frame, region)
    effect = Effect(sources, to_source, depth, process)
    return flood(visible, Paint(effect=effect), step.subject.own_name)


def effect_in(square: Box, to_source: Affine, depth: int, content: FilterContent, is_only: bool) -> Effect:
    """Return the pixels of an input in a square: those of an effect if it is nothing else, and the only input.

    If effects with several inputs were used, too, a chain of them would compute its first step 2^n times.
    """
    path = content.only_path
    effect = None if path is None or path.paint.opacity < 1.0 or not is_only else path.paint.effect
    if effect is not None and (effect.to_source, effect.depth) == (to_source, depth):
        return effect
    return Effect((source_of(content.cut(square), square),), to_source, depth, first_raster)


def square_of(step: FilterStep) -> Box:
    """Return the square of the pixels of a filter: its region, or the contents of the inputs if it has none."""
    left, top, right, bottom = step.graph.region
    if not right - left < float("inf") or not bottom - top < float("inf"):
        boxes = [box for key in step.links if (box := step.input(key).box) is not None]
        if not boxes:
            raise InexactError("it fills the plane")
        left, top = min(box[0] for box in boxes), min(box[1] for box in boxes)
        right, bottom = max(box[2] for box in boxes), max(box[3] for box in boxes)
    side = max(right - left, bottom - top)
    return left, top, left + side, top + side


def words_of(name: str) -> str:
    """Return the name of a step in words.

    Examples
    --------
    >>> words_of("DisplacementMap")
    'displacement map'
    """
    return "".join(f" {letter.lower()}" if letter.isupper() else letter for letter in name).strip()


def make_turbulence(step: FilterStep) -> FilterContent:
    """Make noise."""
    frequencies = step.numbers("baseFrequency") or [0.0]
    operation = Turbulence(
        (frequencies[0], frequencies[-1]),
        int(min(max(step.number("numOctaves", 1.0), 0.0), 100.0)),
        step.number("seed", 0.0),
        step.element.get("type", "").strip() == "fractalNoise",
        step.element.get("stitchTiles", "").strip() == "stitch",
    )
    return sample_step(step, operation)


def make_lighting(step: FilterStep) -> FilterContent:
    """Light the surface whose height is the opacity of the input."""
    source = next((light for child in step.element if (light := light_of(step, child)) is not None), None)
    if source is None:
        return FilterContent()
    color = step.style.solid(step.style["lighting-color"]) or step.style.color
    is_shiny = step.name == "SpecularLighting"
    constant = step.number("specularConstant" if is_shiny else "diffuseConstant", 1.0)
    exponent = min(max(step.number("specularExponent", 1.0), 1.0), 128.0) if is_shiny else None
    scale, lengths = step.number("surfaceScale", 1.0), lengths_of(step)
    return sample_step(step, Lighting(source, color.rgb, scale, constant, exponent, lengths))


def light_of(step: FilterStep, element: etree._Element) -> LightSource | None:
    """Return the light that an element describes; None if it is no light."""
    light = FilterStep(step.graph, element, step.index)
    number = light.number
    match local_name(light.element):
        case "feDistantLight":
            return DistantLight(number("azimuth", 0.0), number("elevation", 0.0))
        case "fePointLight":
            return PointLight((number("x", 0.0), number("y", 0.0), number("z", 0.0)))
        case "feSpotLight":
            place = number("x", 0.0), number("y", 0.0), number("z", 0.0)
            target = number("pointsAtX", 0.0), number("pointsAtY", 0.0), number("pointsAtZ", 0.0)
            cone = number("limitingConeAngle", 0.0) if light.element.get("limitingConeAngle") is not None else None
            return SpotLight(place, target, number("specularExponent", 1.0), cone)
    return None


def lengths_of(step: FilterStep) -> tuple[float, float]:
    """Return the sides of the pixels of a kernel; a user unit each if they are not given."""
    values = [value for value in step.numbers("kernelUnitLength")[:2] if value > 0.0]
    return (values[0] * step.along(0), values[-1] * step.along(1)) if values else (1.0, 1.0)


def make_convolution(step: FilterStep) -> FilterContent:
    """Sum weighted neighbours; as in browsers, a matrix that is not valid makes the result transparent."""
    orders = [int(value) for value in step.numbers("order")[:2] if value == int(value) and value > 0] or [3]
    columns, rows = orders[0], orders[-1]
    matrix = tuple(step.numbers("kernelMatrix"))
    x, y = step.number("targetX", columns // 2), step.number("targetY", rows // 2)
    if len(matrix) != columns * rows or not (0 <= x < columns and 0 <= y < rows):
        return FilterContent()
    divisor = step.number("divisor", 0.0) or sum(matrix) or 1.0
    operation = Convolution(
        (columns, rows),
        matrix,
        divisor,
        step.number("bias", 0.0),
        (int(x), int(y)),
        EDGES.get(step.element.get("edgeMode", "").strip(), "duplicate"),
        step.element.get("preserveAlpha", "").strip() == "true",
        lengths_of(step),
    )
    return sample_step(step, operation)


def make_displacement(step: FilterStep) -> FilterContent:
    """Move the first input by the second one."""
    x, y = (CHANNELS.find(step.element.get(name, "A").strip()) for name in ("xChannelSelector", "yChannelSelector"))
    scale = step.number("scale", 0.0) * step.along(0)
    return sample_step(step, Displacement(scale, (x if x >= 0 else 3, y if y >= 0 else 3)))


def make_morphology(step: FilterStep) -> FilterContent:
    """Thin or thicken the input; as in browsers, radii that are not positive change nothing."""
    radii = step.numbers("radius") or [0.0]
    across, down = radii[0] * step.along(0), radii[-1] * step.along(1)
    if min(across, down) < 0.0 or max(across, down) == 0.0:
        return step.input()
    return sample_step(step, Morphology((across, down), step.element.get("operator", "").strip() == "dilate"))


def sample_composite(step: FilterStep, factors: tuple[float, float, float, float]) -> FilterContent:
    """Return an arithmetic composite as a picture."""
    return sample_step(step, PorterDuff("arithmetic", factors))


def sample_colors(step: FilterStep, function: ColorFunction) -> FilterContent:
    """Return the input of a step with its colours changed, as a picture."""
    return sample_step(step, ColorMapping(function.of))
