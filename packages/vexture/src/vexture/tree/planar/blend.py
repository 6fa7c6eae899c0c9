"""Compositing of two colours, as *Compositing and Blending Level 1* of the W3C defines it."""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import LUMINANCE_BLUE, LUMINANCE_GREEN, LUMINANCE_RED
from vexture.drawing.group import Blend, Mask

SCREEN, OVERLAY, DARKEN, LIGHTEN = int(Blend.SCREEN), int(Blend.OVERLAY), int(Blend.DARKEN), int(Blend.LIGHTEN)
DODGE, BURN, HARD, SOFT = int(Blend.COLOR_DODGE), int(Blend.COLOR_BURN), int(Blend.HARD_LIGHT), int(Blend.SOFT_LIGHT)
NORMAL, MULTIPLY, DIFFERENCE = int(Blend.NORMAL), int(Blend.MULTIPLY), int(Blend.DIFFERENCE)
EXCLUSION, HUE, SATURATION = int(Blend.EXCLUSION), int(Blend.HUE), int(Blend.SATURATION)
COLOR, LUMINOSITY, LIGHTER = int(Blend.COLOR), int(Blend.LUMINOSITY), int(Blend.PLUS_LIGHTER)
LUMINANCE = int(Mask.LUMINANCE)

NOTHING = 1e-9
"""A component within this distance of 0 or 1 counts as 0 or 1, where dodge and burn jump. A saturation below it counts
as 0, because hue and saturation would amplify its rounding error to a colour."""


@kernel(allocates=False)
def _mix_channel(mode: int, b: float, s: float) -> float:
    """B(b, s) of one channel of the backdrop and the source (section 10.1, separable blend modes)."""
    if mode == MULTIPLY:
        return b * s
    if mode == SCREEN:
        return b + s - b * s
    if mode == OVERLAY:
        return 2.0 * b * s if b <= 0.5 else 1.0 - 2.0 * (1.0 - b) * (1.0 - s)
    if mode == HARD:
        return 2.0 * b * s if s <= 0.5 else 1.0 - 2.0 * (1.0 - b) * (1.0 - s)
    if mode == DARKEN:
        return min(b, s)
    if mode == LIGHTEN:
        return max(b, s)
    if mode == DODGE:
        return 0.0 if b <= NOTHING else (1.0 if s >= 1.0 - NOTHING else min(1.0, b / (1.0 - s)))
    if mode == BURN:
        return 1.0 if b >= 1.0 - NOTHING else (0.0 if s <= NOTHING else 1.0 - min(1.0, (1.0 - b) / s))
    if mode == SOFT:
        root = ((16.0 * b - 12.0) * b + 4.0) * b if b <= 0.25 else np.sqrt(b)
        return b - (1.0 - 2.0 * s) * b * (1.0 - b) if s <= 0.5 else b + (2.0 * s - 1.0) * (root - b)
    if mode == DIFFERENCE:
        return abs(b - s)
    if mode == EXCLUSION:
        return b + s - 2.0 * b * s
    return s


@kernel(allocates=False)
def _luminosity(c: tuple[float, float, float]) -> float:
    return 0.3 * c[0] + 0.59 * c[1] + 0.11 * c[2]


@kernel(allocates=False)
def _with_luminosity(c: tuple[float, float, float], target: float) -> tuple[float, float, float]:
    """SetLum and ClipColor of section 10.2."""
    by = target - _luminosity(c)
    red, green, blue = c[0] + by, c[1] + by, c[2] + by
    low, high = min(red, green, blue), max(red, green, blue)
    share = 1.0
    if low < 0.0:
        share = target / (target - low)
    if high > 1.0:
        share = min(share, (1.0 - target) / (high - target))
    return target + (red - target) * share, target + (green - target) * share, target + (blue - target) * share


@kernel(allocates=False)
def _with_saturation(c: tuple[float, float, float], target: float) -> tuple[float, float, float]:
    """SetSat of section 10.2."""
    low, high = min(c[0], c[1], c[2]), max(c[0], c[1], c[2])
    scale = target / (high - low) if high - low > NOTHING else 0.0
    return (c[0] - low) * scale, (c[1] - low) * scale, (c[2] - low) * scale


@kernel(allocates=False)
def _mixed_whole(mode: int, b: tuple[float, float, float], s: tuple[float, float, float]) -> tuple[float, float, float]:
    """B(b, s) of whole colours (section 10.2, non-separable blend modes)."""
    if mode == HUE:
        return _with_luminosity(_with_saturation(s, max(b[0], b[1], b[2]) - min(b[0], b[1], b[2])), _luminosity(b))
    if mode == SATURATION:
        return _with_luminosity(_with_saturation(b, max(s[0], s[1], s[2]) - min(s[0], s[1], s[2])), _luminosity(b))
    if mode == COLOR:
        return _with_luminosity(s, _luminosity(b))
    return _with_luminosity(b, _luminosity(s))


@kernel(allocates=False)
def blend_over(below: NDArray[np.float64], above: NDArray[np.float64], opacity: float, mode: int) -> None:
    """Composite one colour on another, both (4,) and premultiplied; the result is written to `below`.

    `opacity` is multiplied into the colour above. Source-over with blending, with the backdrop b and the source s:
    co = cs as (1 - ab) + cb ab (1 - as) + as ab B(cb, cs).
    """
    a, b = above[3] * opacity, below[3]
    if mode == LIGHTER:
        for c in range(4):
            below[c] = min(above[c] * opacity + below[c], 1.0)
        return
    if mode == NORMAL or a == 0.0 or b == 0.0:
        for c in range(4):
            below[c] = above[c] * opacity + (1.0 - a) * below[c]
        return
    backdrop = (below[0] / b, below[1] / b, below[2] / b)
    source = (above[0] / above[3], above[1] / above[3], above[2] / above[3])
    whole = (0.0, 0.0, 0.0)
    if mode >= HUE:
        whole = _mixed_whole(mode, backdrop, source)
    for c in range(3):
        mixed = whole[c] if mode >= HUE else _mix_channel(mode, backdrop[c], source[c])
        below[c] = source[c] * a * (1.0 - b) + backdrop[c] * b * (1.0 - a) + a * b * mixed
    below[3] = a + b * (1.0 - a)


@kernel(allocates=False)
def masking(colour: NDArray[np.float64], mask: int) -> float:
    """Share that a mask of a premultiplied colour, (4,), leaves (*CSS Masking Level 1*, 7.10)."""
    if mask == LUMINANCE:
        return LUMINANCE_RED * colour[0] + LUMINANCE_GREEN * colour[1] + LUMINANCE_BLUE * colour[2]
    return colour[3]
