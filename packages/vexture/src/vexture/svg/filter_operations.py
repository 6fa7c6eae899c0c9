"""Operations of filter primitives and their parameters, all in user units (Filter Effects 1, 9)."""

from collections.abc import Callable
from dataclasses import dataclass, fields, is_dataclass
from typing import Final, Literal, TypeAlias

from vexture.base.errors import SourceError
from vexture.drawing.group import Blend
from vexture.svg.filter_frame import EdgeMode, Numbers, Rectangle

Pair: TypeAlias = tuple[float, float]
Triple: TypeAlias = tuple[float, float, float]
Quadruple: TypeAlias = tuple[float, float, float, float]

MOST_NUMBER: Final = 1e15
"""Greatest number in a filter, on both sides of 0; sums and squares of such numbers are exact enough, and finite."""

IDENTITY: Final = (1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)
"""Colour matrix that changes nothing."""


@dataclass(frozen=True, slots=True)
class Turbulence:
    """Noise (feTurbulence); a negative frequency makes it transparent."""

    frequency: Pair
    octaves: int = 1
    seed: float = 0.0
    is_fractal: bool = False  # True for type="fractalNoise"
    is_stitched: bool = False


@dataclass(frozen=True, slots=True)
class DistantLight:
    """A light in a direction, with angles in degrees."""

    azimuth: float = 0.0
    elevation: float = 0.0


@dataclass(frozen=True, slots=True)
class PointLight:
    """A light at a place."""

    place: Triple = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class SpotLight:
    """A light at a place that points at another one; `cone` is the angle in degrees between its axis and its rim."""

    place: Triple = (0.0, 0.0, 0.0)
    target: Triple = (0.0, 0.0, 0.0)
    exponent: float = 1.0
    cone: float | None = None


LightSource: TypeAlias = DistantLight | PointLight | SpotLight


@dataclass(frozen=True, slots=True)
class Lighting:
    """Light on a surface whose height is the opacity (feDiffuseLighting; with an exponent, feSpecularLighting).

    `lengths` are kernelUnitLength, or the sides of a CSS pixel.
    """

    light: LightSource
    color: Triple  # sRGB
    surface_scale: float = 1.0
    constant: float = 1.0
    exponent: float | None = None
    lengths: Pair = (1.0, 1.0)


@dataclass(frozen=True, slots=True)
class Convolution:
    """A sum of weighted neighbours (feConvolveMatrix); its matrix is in rows, as the attribute lists it.

    `lengths` are kernelUnitLength, or the sides of a CSS pixel.
    """

    order: tuple[int, int]  # columns and rows of the matrix
    matrix: tuple[float, ...]
    divisor: float = 1.0
    bias: float = 0.0
    target: tuple[int, int] = (1, 1)
    edges: EdgeMode = "duplicate"
    preserves_alpha: bool = False
    lengths: Pair = (1.0, 1.0)


@dataclass(frozen=True, slots=True)
class Displacement:
    """The first input moved by channels 0..3 of the second one (feDisplacementMap)."""

    scale: float
    channels: tuple[int, int] = (3, 3)


@dataclass(frozen=True, slots=True)
class Morphology:
    """Least or greatest values in a rectangle of twice the radii (feMorphology)."""

    radii: Pair
    is_dilation: bool = False


@dataclass(frozen=True, slots=True)
class GaussianBlur:
    """A blur (feGaussianBlur), with transparent pixels beyond the edges."""

    deviations: Pair


@dataclass(frozen=True, slots=True)
class ColorMatrix:
    """A matrix of 4 rows and 5 columns on colours that are not premultiplied (feColorMatrix)."""

    numbers: tuple[float, ...] = IDENTITY


@dataclass(frozen=True, slots=True)
class ColorMapping:
    """Any other function of colours (n, 4) that are not premultiplied, in the colour space of the step."""

    function: Callable[[Numbers], Numbers]


@dataclass(frozen=True, slots=True)
class TransferCurve:
    """Function of a component: a table, steps, a line, or a power (feFuncR and its like)."""

    kind: Literal["identity", "table", "discrete", "linear", "gamma"] = "identity"
    values: tuple[float, ...] = ()
    slope: float = 1.0  # `amplitude` of a power
    intercept: float = 0.0  # `offset` of a power
    exponent: float = 1.0


@dataclass(frozen=True, slots=True)
class ComponentTransfer:
    """Curves of red, green, blue and opacity (feComponentTransfer)."""

    curves: tuple[TransferCurve, TransferCurve, TransferCurve, TransferCurve]


@dataclass(frozen=True, slots=True)
class PorterDuff:
    """Composition of two inputs, the first above the second (feComposite)."""

    operator: Literal["over", "in", "out", "atop", "xor", "lighter", "arithmetic"] = "over"
    numbers: Quadruple = (0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Blending:
    """Two inputs, the first above the second, with a blend mode (feBlend)."""

    mode: Blend = Blend.NORMAL


@dataclass(frozen=True, slots=True)
class Shift:
    """A moved input (feOffset)."""

    dx: float
    dy: float


@dataclass(frozen=True, slots=True)
class Repetition:
    """The rectangle of the input, repeated (feTile)."""


@dataclass(frozen=True, slots=True)
class SolidColor:
    """One sRGB colour, not premultiplied, with its opacity (feFlood)."""

    color: Quadruple


@dataclass(frozen=True, slots=True)
class Stack:
    """Inputs over each other, the first at the bottom (feMerge); of one input, its crop (feImage)."""


Operation: TypeAlias = (
    Turbulence | Lighting | Convolution | Displacement | Morphology | GaussianBlur | ColorMatrix | ComponentTransfer
) | (ColorMapping | PorterDuff | Blending | Shift | Repetition | SolidColor | Stack)


@dataclass(frozen=True, slots=True)
class RasterStep:
    """A filter primitive whose result is to be sampled.

    Parameters
    ----------
    operation : Operation
    inputs : tuple of str
        Names of sources and of earlier results; an empty or unknown name is the previous result (9.2).
    result : str
        Name of the result; it may be empty, or replace an earlier one.
    subregion : (left, top, right, bottom), optional
        None for the default, which is that of the inputs or the filter region (9.4).
    is_linear : bool
        True for color-interpolation-filters: linearRGB.
    """

    operation: Operation
    inputs: tuple[str, ...] = ()
    result: str = ""
    subregion: Rectangle | None = None
    is_linear: bool = True

    def __post_init__(self) -> None:
        check_numbers(self.operation)
        check_numbers(self.subregion, "subregion")


def check_numbers(operation: object, name: str = "") -> None:
    """Raise a `SourceError` if a parameter is no number from -`MOST_NUMBER` to `MOST_NUMBER`."""
    if is_dataclass(operation):
        for field in fields(operation):
            check_numbers(getattr(operation, field.name), f"{name or type(operation).__name__}.{field.name}")
    elif isinstance(operation, tuple):
        for number in operation:
            check_numbers(number, name)
    elif isinstance(operation, float) and not abs(operation) <= MOST_NUMBER:
        raise SourceError(f"{name} of a filter is {operation:g}; use a number from -{MOST_NUMBER:g} to {MOST_NUMBER:g}")
