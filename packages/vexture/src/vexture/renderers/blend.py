"""Lay one colour over another: source-over and the other blend modes, in sRGB.

The formulas and names are those of the W3C's *Compositing and Blending Level 1*: c is a colour, b the backdrop, s the
source, which is laid over it. `Blend.PLUS_LIGHTER` is defined in Level 2.
"""

from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.drawing.group import Blend

Colour: TypeAlias = tuple[float, float, float]

ROUNDING: Final = 1e-9
"""Rounding error of a component from earlier compositing. It must not decide at 0 and 1, where dodge and burn jump, nor
give a grey a hue."""


@kernel(allocates=False)
def lay(source: NDArray[np.float64], opacity: float, blend: int, below: NDArray[np.float64]) -> None:
    """Lay a premultiplied colour (4,), times an opacity, over another colour, in place.

    All modes but two use co = cs αs (1 - αb) + cb αb (1 - αs) + αs αb B(cb, cs).
    """
    over, under = source[3] * opacity, below[3]
    if blend == Blend.NORMAL:
        for k in range(4):
            below[k] = source[k] * opacity + (1.0 - over) * below[k]
    elif blend == Blend.PLUS_LIGHTER:
        for k in range(4):
            below[k] = min(source[k] * opacity + below[k], 1.0)
    else:
        mixed = mixture(blend, straight(below), straight(source))
        # alpha uses the formula of the colours, so that white stays white to the last bit, as dodge and burn require
        for k in range(4):
            both = mixed[k] if k < 3 else 1.0
            below[k] = source[k] * opacity * (1.0 - under) + below[k] * (1.0 - over) + over * under * both


@kernel(allocates=False)
def straight(colour: NDArray[np.float64]) -> Colour:
    """Divide a premultiplied colour by its opacity; black if the opacity is 0."""
    if colour[3] == 0.0:
        return 0.0, 0.0, 0.0
    return min(colour[0] / colour[3], 1.0), min(colour[1] / colour[3], 1.0), min(colour[2] / colour[3], 1.0)


@kernel(allocates=False)
def mixture(blend: int, b: Colour, s: Colour) -> Colour:
    """Blend function B(cb, cs) of straight colours."""
    if blend == Blend.HUE:
        return with_luminosity(with_saturation(s, saturation(b)), luminosity(b))
    if blend == Blend.SATURATION:
        return with_luminosity(with_saturation(b, saturation(s)), luminosity(b))
    if blend == Blend.COLOR:
        return with_luminosity(s, luminosity(b))
    if blend == Blend.LUMINOSITY:
        return with_luminosity(b, luminosity(s))
    return separable(blend, b[0], s[0]), separable(blend, b[1], s[1]), separable(blend, b[2], s[2])


@kernel(allocates=False)
def separable(blend: int, b: float, s: float) -> float:
    """Blend function B(cb, cs) of a mode that treats each component separately."""
    if blend == Blend.MULTIPLY:
        return b * s
    if blend == Blend.SCREEN:
        return b + s - b * s
    if blend == Blend.OVERLAY:
        return hard_light(s, b)
    if blend == Blend.DARKEN:
        return min(b, s)
    if blend == Blend.LIGHTEN:
        return max(b, s)
    if blend == Blend.COLOR_DODGE:
        return 0.0 if b <= ROUNDING else 1.0 if s >= 1.0 - ROUNDING else min(b / (1.0 - s), 1.0)
    if blend == Blend.COLOR_BURN:
        return 1.0 if b >= 1.0 - ROUNDING else 0.0 if s <= ROUNDING else 1.0 - min((1.0 - b) / s, 1.0)
    if blend == Blend.HARD_LIGHT:
        return hard_light(b, s)
    if blend == Blend.SOFT_LIGHT:
        return soft_light(b, s)
    if blend == Blend.DIFFERENCE:
        return abs(b - s)
    return b + s - 2.0 * b * s  # Blend.EXCLUSION


@kernel(allocates=False)
def hard_light(b: float, s: float) -> float:
    """Multiply where the source is dark, screen where it is light."""
    if s <= 0.5:
        return b * (2.0 * s)
    return b + (2.0 * s - 1.0) - b * (2.0 * s - 1.0)


@kernel(allocates=False)
def soft_light(b: float, s: float) -> float:
    """Darken or lighten, like a diffused light."""
    if s <= 0.5:
        return b - (1.0 - 2.0 * s) * b * (1.0 - b)
    lightest = ((16.0 * b - 12.0) * b + 4.0) * b if b <= 0.25 else float(np.sqrt(b))
    return b + (2.0 * s - 1.0) * (lightest - b)


@kernel(allocates=False)
def luminosity(c: Colour) -> float:
    """The W3C's Lum."""
    return 0.3 * c[0] + 0.59 * c[1] + 0.11 * c[2]


@kernel(allocates=False)
def saturation(c: Colour) -> float:
    """The W3C's Sat."""
    return max(c[0], c[1], c[2]) - min(c[0], c[1], c[2])


@kernel(allocates=False)
def with_saturation(c: Colour, wanted: float) -> Colour:
    """The W3C's SetSat: the least component becomes 0, the greatest `wanted`."""
    least, range_ = min(c[0], c[1], c[2]), saturation(c)
    if range_ <= ROUNDING:
        return 0.0, 0.0, 0.0
    factor = wanted / range_
    return (c[0] - least) * factor, (c[1] - least) * factor, (c[2] - least) * factor


@kernel(allocates=False)
def with_luminosity(c: Colour, wanted: float) -> Colour:
    """The W3C's SetLum and ClipColor: shift all components equally, then move them towards grey, into 0..1."""
    shift = wanted - luminosity(c)
    r, g, b = c[0] + shift, c[1] + shift, c[2] + shift
    light, least, greatest = luminosity((r, g, b)), min(r, g, b), max(r, g, b)
    factor = 1.0
    if least < 0.0:
        factor = light / (light - least)
    elif greatest > 1.0:
        factor = (1.0 - light) / (greatest - light)
    return light + (r - light) * factor, light + (g - light) * factor, light + (b - light) * factor
