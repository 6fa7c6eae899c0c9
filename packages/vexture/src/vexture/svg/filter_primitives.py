"""The steps of filters that are drawn (Filter Effects 1, 9.5 to 9.26)."""

from collections.abc import Callable
from functools import partial
from math import radians
from typing import Final, Literal, TypeAlias, get_args

import numpy as np

from vexture.drawing.group import Blend
from vexture.drawing.paint import Paint
from vexture.svg.document import local_name
from vexture.svg.filter_alpha import SOFT, change_colors, recolor
from vexture.svg.filter_colors import (
    Channel,
    ColorFunction,
    Colors,
    hue_matrix,
    luminance_matrix,
    pass_values,
    weighted_matrix,
)
from vexture.svg.filter_composite import blend, combine, composite
from vexture.svg.filter_content import FilterContent, FilterLimitError, InexactError, flood, stack
from vexture.svg.filter_graph import FilterStep
from vexture.svg.filter_image import make_image
from vexture.svg.filter_operations import Blending, PorterDuff, TransferCurve
from vexture.svg.filter_pixels import transfer_component
from vexture.svg.filter_sampled import (
    make_convolution,
    make_displacement,
    make_lighting,
    make_morphology,
    make_turbulence,
    sample_colors,
    sample_composite,
    sample_step,
)
from vexture.svg.filter_soft import blur_content
from vexture.svg.properties import BLENDS
from vexture.svg.transform import Identity

MOST_TILES: Final = 2_000
"""Most tiles of one step."""

MIXED: Final = "translucent colours are mixed in sRGB, not in linear light"

Operator: TypeAlias = Literal["over", "in", "out", "atop", "xor", "lighter"]

OPERATORS: Final[dict[str, Operator]] = {name: name for name in get_args(Operator)}


def make_offset(step: FilterStep) -> FilterContent:
    """Move the input."""
    dx, dy = (step.number(name, 0.0) * step.along(axis) for axis, name in enumerate(("dx", "dy")))
    return step.input().move(Identity.translate(dx, dy))


def make_flood(step: FilterStep) -> FilterContent:
    """Fill the region of a step."""
    return flood(step.region, flood_paint(step), step.subject.own_name)


def flood_paint(step: FilterStep) -> Paint:
    """Return the paint of a flood or a shadow."""
    color = step.style.solid(step.style["flood-color"]) or step.style.color
    return Paint(color.rgb, color.alpha * step.style.opacity("flood-opacity"))


def make_merge(step: FilterStep) -> FilterContent:
    """Stack the inputs."""
    contents = [step.input(key) for key in step.links]
    for place, content in enumerate(contents[1:], 1):
        note_linear(step, content, *contents[:place])
    return stack(contents)


def note_linear(step: FilterStep, upper: FilterContent, *lower: FilterContent) -> None:
    """Note that colours are not mixed in linear light, if that differs."""
    if mixes_light(step, upper, *lower):
        step.remarks[MIXED] = None


def mixes_light(step: FilterStep, upper: FilterContent, *lower: FilterContent) -> bool:
    """Return whether a step mixes translucent colours in linear light."""
    if not step.is_linear or not upper.visible or upper.is_opaque:
        return False
    return any(below.visible and (below.color is None or below.color != upper.color) for below in lower)


def make_blend(step: FilterStep) -> FilterContent:
    """Blend an input onto the other one."""
    text = step.element.get("mode", "normal").strip().lower()
    mode = BLENDS.get(text)
    if mode is None or mode is Blend.PLUS_LIGHTER:
        step.subject.scene.report.invalid("mode", text, step.element)
        mode = Blend.NORMAL
    upper, lower = step.input(), step.input("in2")
    if step.is_linear and upper.visible and lower.visible:
        if mode is not Blend.NORMAL:
            return sample_step(step, Blending(mode))
        note_linear(step, upper, lower)
    return blend(upper, lower, mode)


def make_composite(step: FilterStep) -> FilterContent:
    """Composite the inputs."""
    text = step.element.get("operator", "over").strip()
    upper, lower = step.input(), step.input("in2")
    if text == "arithmetic":
        k1, k2, k3, k4 = (step.number(f"k{k}", 0.0) for k in (1, 2, 3, 4))
        if step.is_linear and k2 and k3 and not (is_even(upper) and is_even(lower)):
            return sample_composite(step, (k1, k2, k3, k4))
        try:
            return combine(upper, lower, (k1, k2, k3, k4))
        except InexactError:
            return sample_composite(step, (k1, k2, k3, k4))
    if text not in OPERATORS:
        step.subject.scene.report.invalid("operator", text, step.element)
    operator = OPERATORS.get(text, "over")
    if operator != "in" and operator != "out" and mixes_light(step, upper, lower):
        return sample_step(step, PorterDuff(operator))
    return composite(upper, lower, operator)


def is_even(content: FilterContent) -> bool:
    """Return whether a content has one colour, the same in linear light, or none."""
    color = content.color
    return not content.visible or (color is not None and all(part in (0.0, 1.0) for part in color))


def deviations_of(step: FilterStep, default: float) -> tuple[float, float]:
    """Return the deviations of a blur across and down; one that is negative counts as 0 for both."""
    values = step.numbers("stdDeviation") or [default]
    if len(values) > 2:
        step.subject.scene.report.invalid("stdDeviation", step.element.get("stdDeviation", ""), step.element)
        values = [0.0]
    across, down = values[0] * step.along(0), values[-1] * step.along(1)
    return (0.0, 0.0) if min(across, down) < 0.0 else (across, down)


def soften(step: FilterStep, content: FilterContent, deviations: tuple[float, float]) -> FilterContent:
    """Return a content blurred by a step."""
    names = {path.element for path in content.visible}
    name = names.pop() if len(names) == 1 else step.subject.place.name
    sources = step.subject.scene.sources
    return blur_content(content, deviations, step.region, name, step.is_linear, step.remarks, sources)


def make_blur(step: FilterStep) -> FilterContent:
    """Blur the input."""
    return soften(step, step.input(), deviations_of(step, 0.0))


def make_shadow(step: FilterStep) -> FilterContent:
    """Stack the input on its shadow."""
    paint, content = flood_paint(step), step.input()
    dx, dy = (step.number(name, 2.0) * step.along(axis) for axis, name in enumerate(("dx", "dy")))
    shadow = recolor(content, paint.color, step.subject.own_name).move(Identity.translate(dx, dy))
    shadow = soften(step, shadow, deviations_of(step, 2.0)).fade(paint.opacity)
    note_linear(step, content, shadow)
    return stack([shadow, content])


def make_colors(step: FilterStep) -> FilterContent:
    """Change colours by a matrix."""
    kind = step.element.get("type", "matrix").strip()
    values = step.numbers("values")
    matrix: Colors = np.eye(4, 5)
    if kind == "matrix":
        if len(values) == 20:
            matrix = np.array(values).reshape(4, 5)
        elif step.element.get("values") is not None:
            step.subject.scene.report.invalid("values", step.element.get("values", ""), step.element)
    elif kind == "saturate":
        matrix = weighted_matrix("saturate", max(values[0], 0.0) if len(values) == 1 else 1.0)
    elif kind == "hueRotate":
        matrix = hue_matrix(radians(values[0]) if len(values) == 1 else 0.0)
    elif kind == "luminanceToAlpha":
        matrix = luminance_matrix()
    else:
        step.subject.scene.report.invalid("type", kind, step.element)
    return change(step, ColorFunction(matrix, is_linear=step.is_linear))


def change(step: FilterStep, function: ColorFunction) -> FilterContent:
    """Apply a function of colours to the input of a step."""
    content = step.input()
    if function.matrix is not None and np.array_equal(function.matrix, np.eye(4, 5)):
        return content
    remarks: dict[str, None] = {}
    try:
        changed = change_colors(content, function, step.region, step.subject.own_name, remarks)
    except InexactError:
        return sample_colors(step, function)
    if SOFT in remarks:
        return sample_colors(step, function)
    step.remarks.update(remarks)
    return changed


def make_transfer(step: FilterStep) -> FilterContent:
    """Change components by functions."""
    found: list[Channel] = [pass_values] * 4
    slopes: list[tuple[float, float] | None] = [(1.0, 0.0)] * 4
    for child in step.element:
        name = local_name(child) or ""
        if name[:-1] == "feFunc" and name[-1] in "RGBA":
            place = "RGBA".index(name[-1])
            found[place], slopes[place] = channel_of(FilterStep(step.graph, child, step.index))
    lines = [slope for slope in slopes if slope is not None]
    if len(lines) < 4:
        return change(step, ColorFunction(channels=tuple(found), is_linear=step.is_linear))
    matrix = np.zeros((4, 5))
    for place, (slope, intercept) in enumerate(lines):
        matrix[place, place], matrix[place, 4] = slope, intercept
    return change(step, ColorFunction(matrix, is_linear=step.is_linear))


def channel_of(function: FilterStep) -> tuple[Channel, tuple[float, float] | None]:
    """Return the function of a component, and its slope and intercept if it is affine."""
    kind, values = function.element.get("type", "").strip(), tuple(function.numbers("tableValues"))
    match kind:
        case "table" if len(values) == 1:
            return partial(transfer_component, curve=TransferCurve("table", values)), (0.0, values[0])
        case "table" if values:
            line = (values[1] - values[0], values[0]) if len(values) == 2 else None
            return partial(transfer_component, curve=TransferCurve("table", values)), line
        case "discrete" if values:
            return partial(transfer_component, curve=TransferCurve("discrete", values)), None
        case "linear":
            slope, intercept = function.number("slope", 1.0), function.number("intercept", 0.0)
            curve = TransferCurve("linear", slope=slope, intercept=intercept)
            return partial(transfer_component, curve=curve), (slope, intercept)
        case "gamma":
            amplitude, exponent = function.number("amplitude", 1.0), function.number("exponent", 1.0)
            curve = TransferCurve("gamma", (), amplitude, function.number("offset", 0.0), exponent)
            return partial(transfer_component, curve=curve), None
        case "identity" | "table" | "discrete":
            return pass_values, (1.0, 0.0)
    function.subject.scene.report.invalid("type", kind, function.element)
    return pass_values, (1.0, 0.0)


def make_tile(step: FilterStep) -> FilterContent:
    """Repeat the part of the input in its region."""
    result = step.result()
    left, top, right, bottom = result.region
    width, height = right - left, bottom - top
    content = result.content.cut(result.region)
    box = content.box
    if box is None or not (width > 0.0 and height > 0.0):
        return FilterContent()
    x, y, end, low = step.region
    columns = range(*whole_between((x - box[2]) / width, (end - box[0]) / width))
    rows = range(*whole_between((y - box[3]) / height, (low - box[1]) / height))
    if len(columns) * len(rows) > MOST_TILES:
        raise FilterLimitError(f"it has {len(columns) * len(rows):,} tiles; the limit is {MOST_TILES:,}")
    return stack(content.move(Identity.translate(i * width, j * height)) for j in rows for i in columns)


def whole_between(low: float, high: float) -> tuple[int, int]:
    """Return the first whole number above a number, and the first one that is not below another one."""
    return int(np.floor(low)) + 1, int(np.ceil(high))


PRIMITIVES: Final[dict[str, Callable[[FilterStep], FilterContent]]] = {
    "Blend": make_blend,
    "ColorMatrix": make_colors,
    "ComponentTransfer": make_transfer,
    "Composite": make_composite,
    "ConvolveMatrix": make_convolution,
    "DiffuseLighting": make_lighting,
    "DisplacementMap": make_displacement,
    "DropShadow": make_shadow,
    "Flood": make_flood,
    "GaussianBlur": make_blur,
    "Image": make_image,
    "Merge": make_merge,
    "Morphology": make_morphology,
    "Offset": make_offset,
    "SpecularLighting": make_lighting,
    "Tile": make_tile,
    "Turbulence": make_turbulence,
}
