"""Results of whole filters as pixels: a graph of primitives, evaluated step by step (Filter Effects 1, 9)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from vexture.base.deadline import check_time
from vexture.base.errors import LimitError, SourceError
from vexture.svg.filter_frame import (
    PixelFrame,
    Pixels,
    Rectangle,
    crop,
    fill_border,
    intersect_rectangles,
    shift,
    tile,
)
from vexture.svg.filter_lighting import light
from vexture.svg.filter_noise import MOST_OCTAVES, turbulence
from vexture.svg.filter_operations import (
    Blending,
    ColorMapping,
    ColorMatrix,
    ComponentTransfer,
    Convolution,
    Displacement,
    GaussianBlur,
    Lighting,
    Morphology,
    Operation,
    PorterDuff,
    RasterStep,
    Repetition,
    Shift,
    SolidColor,
    Stack,
    Turbulence,
    check_numbers,
)
from vexture.svg.filter_pixels import (
    blend,
    color_matrix,
    composite,
    convert_colors,
    flood,
    from_linear,
    limit_colors,
    map_colors,
    merge,
    to_linear,
    transfer,
)
from vexture.svg.filter_windows import check_work, convolve, displace, gaussian_blur, morphology

MOST_NUMBERS: Final = 1 << 26
"""Most numbers of the results that are needed at a time: 512 MiB, or 64 results of 512 x 512 pixels."""

SOURCE: Final = "SourceGraphic"
OPACITY_SOURCE: Final = "SourceAlpha"


@dataclass(frozen=True, slots=True, eq=False)
class FilterValue:
    """A picture within a filter: its pixels, their colour space, and the rectangle to which they are cropped."""

    pixels: Pixels
    is_linear: bool
    subregion: Rectangle

    def convert(self, is_linear: bool) -> "FilterValue":
        """Return the picture in linear light, or in sRGB."""
        if is_linear == self.is_linear:
            return self
        return FilterValue(
            convert_colors(self.pixels, to_linear if is_linear else from_linear), is_linear, self.subregion
        )


def evaluate(
    steps: Sequence[RasterStep], sources: Mapping[str, Pixels], frame: PixelFrame, region: Rectangle | None = None
) -> Pixels:
    """Return the result of a filter.

    Parameters
    ----------
    steps : sequence of RasterStep
        In order; the result of the last one is the result of the filter. None: a transparent picture (7).
    sources : mapping
        Pixels of SourceGraphic and of other inputs by name. Without SourceAlpha, it is that of SourceGraphic.
    frame : PixelFrame
        Its rows and columns are those of all pixels.
    region : (left, top, right, bottom), optional
        Filter region, to which inputs and results are cropped; without it, all pixels.

    Returns
    -------
    (rows, columns, 4) array

    Raises
    ------
    LimitError
        If the filter takes too much memory or time.
    SourceError
        If the region has a number beyond 10^15, or pixels have another shape.

    Examples
    --------
    A shadow of one pixel, moved to the right, under the pixel.

    >>> frame, dot = PixelFrame(0.0, 0.0, 1.0, 1.0, 1, 3), np.zeros((1, 3, 4))
    >>> dot[0, 0] = 1.0
    >>> steps = [
    ...     RasterStep(Shift(1.0, 0.0), ("SourceAlpha",), "shadow"),
    ...     RasterStep(Stack(), ("shadow", "SourceGraphic")),
    ... ]
    >>> evaluate(steps, {"SourceGraphic": dot}, frame).round(6).tolist()
    [[[1.0, 1.0, 1.0, 1.0], [0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, 0.0]]]
    """
    shape = (frame.rows, frame.columns, 4)
    region = frame.bounds if region is None else region
    check_numbers(region, "region")
    values = _source_values(sources, frame, region)
    previous = values.get(SOURCE, FilterValue(np.zeros(shape), False, region))
    if not steps:
        return np.zeros(shape)
    check_steps(steps, frame)
    last_uses = _last_uses(steps)
    for number, step in enumerate(steps):
        check_time()
        inputs = [values.get(name, previous) if name else previous for name in step.inputs]
        previous = evaluate_step(step, inputs or [previous], frame, region)
        values = {name: value for name, value in values.items() if last_uses.get(name, -1) > number}
        if last_uses.get(step.result, -1) > number:
            values[step.result] = previous
    return limit_colors(previous.convert(is_linear=False).pixels)


def _source_values(sources: Mapping[str, Pixels], frame: PixelFrame, region: Rectangle) -> dict[str, FilterValue]:
    values = {}
    for name, pixels in sources.items():
        if pixels.shape != (frame.rows, frame.columns, 4):
            raise SourceError(f"{name} of a filter has the shape {pixels.shape}; the frame has others")
        values[name] = FilterValue(crop(limit_colors(pixels), frame, region), False, region)
    if SOURCE in values and OPACITY_SOURCE not in values:
        pixels = values[SOURCE].pixels * (0.0, 0.0, 0.0, 1.0)
        values[OPACITY_SOURCE] = FilterValue(pixels, False, region)
    return values


def _last_uses(steps: Sequence[RasterStep]) -> dict[str, int]:
    """Return the number of the last step that uses a name."""
    return {name: number for number, step in enumerate(steps) for name in step.inputs if name}


def check_steps(steps: Sequence[RasterStep], frame: PixelFrame) -> None:
    """Raise a `LimitError` if a filter takes too much memory, or a convolution in it too much work.

    `evaluate` does so first, too.
    """
    last_uses, live, most = _last_uses(steps), set[str](), 0
    for number, step in enumerate(steps):
        if isinstance(step.operation, Convolution):
            check_work(step.operation, frame)
        live = {name for name in {*live, *step.inputs, step.result} if last_uses.get(name, -1) > number}
        most = max(most, len(live))
    if 4 * frame.rows * frame.columns * most > MOST_NUMBERS:
        raise LimitError(
            f"a filter needs {most:,} results of {frame.columns} x {frame.rows} pixels at a time; the limit is "
            f"{MOST_NUMBERS // (4 * frame.rows * frame.columns):,}; use fewer results or fewer pixels"
        )


def evaluate_step(step: RasterStep, inputs: Sequence[FilterValue], frame: PixelFrame, region: Rectangle) -> FilterValue:
    """Return the result of one primitive, cropped to its subregion and to the filter region (9.4).

    Parameters
    ----------
    step : RasterStep
    inputs : sequence of FilterValue
        Of a primitive with two inputs, the last one counts for both if there is only one.
    frame : PixelFrame
    region : (left, top, right, bottom)

    Returns
    -------
    FilterValue
    """
    subregion = intersect_rectangles(region, step.subregion or default_subregion(step.operation, inputs, region))
    pixels, is_linear = _apply(step, [*inputs, inputs[-1]], frame, subregion)
    return FilterValue(crop(pixels, frame, subregion), is_linear, subregion)


def default_subregion(operation: Operation, inputs: Sequence[FilterValue], region: Rectangle) -> Rectangle:
    """Return the subregion of a primitive that has none: the union of its inputs', or the filter region (9.4)."""
    if isinstance(operation, Turbulence | SolidColor | Repetition):
        return region
    sides = list(zip(*(value.subregion for value in inputs), strict=True))
    return min(sides[0]), min(sides[1]), max(sides[2]), max(sides[3])


def _apply(
    step: RasterStep, inputs: Sequence[FilterValue], frame: PixelFrame, subregion: Rectangle
) -> tuple[Pixels, bool]:
    """Return the pixels of a primitive before its crop, and whether they are in linear light."""
    operation = step.operation
    if isinstance(operation, SolidColor):
        return flood(frame, operation.color), False
    if isinstance(operation, Stack) and not step.inputs:
        return np.zeros((frame.rows, frame.columns, 4)), False
    first = inputs[0]
    if isinstance(operation, Shift):
        return shift(first.pixels, frame, operation.dx, operation.dy), first.is_linear
    if isinstance(operation, Repetition):
        whole = fill_border(first.pixels, frame, first.subregion, first.subregion)
        return tile(whole, frame, first.subregion), first.is_linear
    if isinstance(operation, Displacement):
        places = inputs[1].convert(step.is_linear).pixels
        return displace(first.pixels, frame, places, operation.scale, operation.channels), first.is_linear
    if isinstance(operation, Stack) and len(inputs) == 2:
        return fill_border(first.pixels, frame, first.subregion, subregion), first.is_linear
    converted = [value.convert(step.is_linear) for value in inputs]
    if isinstance(operation, GaussianBlur):
        return gaussian_blur(converted[0].pixels, frame, operation.deviations), step.is_linear
    if isinstance(operation, Morphology):
        widened = morphology(converted[0].pixels, frame, operation.radii, operation.is_dilation)
        return widened, step.is_linear
    whole_inputs = [fill_border(value.pixels, frame, value.subregion, subregion) for value in converted]
    return _apply_colors(step, whole_inputs, frame, subregion), step.is_linear


def _apply_colors(step: RasterStep, inputs: Sequence[Pixels], frame: PixelFrame, subregion: Rectangle) -> Pixels:
    """Return the pixels of a primitive whose inputs are in its colour space; the last of them is there twice."""
    operation = step.operation
    match operation:
        case Turbulence():
            return turbulence(operation, frame, subregion, noise_samples(operation, frame))
        case Lighting():
            color = np.array(operation.color).clip(0.0, 1.0)
            red, green, blue = (to_linear(color) if step.is_linear else color).tolist()
            bounds = intersect_rectangles(subregion, frame.bounds)
            return light(inputs[0], frame, operation, (red, green, blue), bounds)
        case Convolution():
            return convolve(inputs[0], frame, operation, intersect_rectangles(subregion, frame.bounds))
        case ColorMapping():
            return map_colors(inputs[0], operation.function)
        case ColorMatrix():
            return color_matrix(inputs[0], operation.numbers)
        case ComponentTransfer():
            return transfer(inputs[0], operation.curves)
        case PorterDuff():
            return composite(inputs[0], inputs[1], operation.operator, operation.numbers)
        case Blending():
            return blend(inputs[0], inputs[1], operation.mode)
    return merge(inputs[:-1])


def noise_samples(noise: Turbulence, frame: PixelFrame) -> int:
    """Return the places along a pixel's side at which noise is averaged: 2 if its detail is finer than 2 pixels."""
    steps = max(noise.frequency[0] * frame.width, noise.frequency[1] * frame.height)
    return 2 if steps * 2.0 ** (max(min(noise.octaves, MOST_OCTAVES), 1) - 1) > 0.5 else 1
