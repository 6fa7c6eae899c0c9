"""Filter primitives that act on each pixel by itself: colours, composition and blending."""

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np

from vexture.drawing.group import Blend
from vexture.svg.filter_frame import Numbers, PixelFrame, Pixels
from vexture.svg.filter_operations import TransferCurve

LEAST_OPACITY: Final = 1e-9
"""Opacity below which a pixel has no colour."""

NOTHING: Final = 1e-9
"""Distance from 0 or 1 within which a component counts as 0 or 1, where dodge and burn jump."""

MOST_GAMMA: Final = 1e4
"""Greatest exponent of a power, above which it is a step."""


def straighten(pixels: Pixels) -> Pixels:
    """Return colours that are not premultiplied, 0..1, with the opacities; without opacity, black."""
    alpha = pixels[..., 3:]
    colors = (pixels[..., :3] / np.maximum(alpha, LEAST_OPACITY)).clip(0.0, 1.0)
    return np.concatenate([colors, alpha], axis=2)


def premultiply_colors(straight: Pixels) -> Pixels:
    """Return premultiplied colours of components that may leave 0..1, which are limited first."""
    limited = np.nan_to_num(straight, nan=0.0).clip(0.0, 1.0)
    limited[..., :3] *= limited[..., 3:]
    return limited


def limit_colors(pixels: Pixels) -> Pixels:
    """Limit opacities to 0..1 and premultiplied colours to 0 and the opacity."""
    limited = np.nan_to_num(pixels, nan=0.0).clip(0.0, 1.0)
    limited[..., :3] = np.minimum(limited[..., :3], limited[..., 3:])
    return limited


def to_linear(encoded: Numbers) -> Numbers:
    """Return sRGB components in linear light (IEC 61966-2-1).

    Examples
    --------
    >>> to_linear(np.array([0.0, 0.5, 1.0])).round(3).tolist()
    [0.0, 0.214, 1.0]
    """
    return np.where(encoded <= 0.04045, encoded / 12.92, ((np.maximum(encoded, 0.0) + 0.055) / 1.055) ** 2.4)


def from_linear(linear: Numbers) -> Numbers:
    """Return components of linear light in sRGB."""
    return np.where(linear <= 0.0031308, linear * 12.92, 1.055 * np.maximum(linear, 0.0) ** (1.0 / 2.4) - 0.055)


def convert_colors(pixels: Pixels, convert: Callable[[Numbers], Numbers]) -> Pixels:
    """Convert premultiplied colours by a function of components that are not (color-interpolation-filters, 10)."""
    if not pixels[..., :3].any():
        return pixels
    straight = straighten(pixels)
    straight[..., :3] = convert(straight[..., :3]) * straight[..., 3:]
    return straight


def flood(frame: PixelFrame, color: Sequence[float]) -> Pixels:
    """Return pixels of one colour, given as components that are not premultiplied (feFlood, 9.13)."""
    return premultiply_colors(np.tile(np.array(color, np.float64), (frame.rows, frame.columns, 1)))


def map_colors(pixels: Pixels, function: Callable[[Numbers], Numbers]) -> Pixels:
    """Apply a function of colours (n, 4), which are not premultiplied; its results may leave 0..1."""
    straight = straighten(pixels)
    return premultiply_colors(np.reshape(function(straight.reshape(-1, 4)), straight.shape))


def color_matrix(pixels: Pixels, numbers: Sequence[float]) -> Pixels:
    """Multiply colours that are not premultiplied by a matrix of 4 rows and 5 columns (feColorMatrix, 9.6)."""
    rows = np.reshape(np.array(numbers, np.float64), (4, 5))
    straight = straighten(pixels)
    with np.errstate(over="ignore", invalid="ignore"):  # `@` would round differently on other processors
        sums = [sum(row[c] * straight[..., c] for c in range(4)) + row[4] for row in rows]
    return premultiply_colors(np.stack(sums, axis=2))


def transfer(pixels: Pixels, curves: Sequence[TransferCurve]) -> Pixels:
    """Apply functions to red, green, blue and opacity, which are not premultiplied (feComponentTransfer, 9.7)."""
    straight = straighten(pixels)
    for channel, curve in enumerate(curves):
        straight[..., channel] = transfer_component(straight[..., channel], curve)
    return premultiply_colors(straight)


def transfer_component(values: Numbers, curve: TransferCurve) -> Numbers:
    """Return the function of a component.

    Examples
    --------
    >>> transfer_component(np.array([0.0, 0.25, 1.0]), TransferCurve("table", (0.0, 1.0, 0.5))).tolist()
    [0.0, 0.5, 0.5]
    >>> transfer_component(np.array([0.0, 0.5, 1.0]), TransferCurve("discrete", (0.0, 1.0))).tolist()
    [0.0, 1.0, 1.0]
    """
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        if curve.kind == "linear":
            return np.asarray(curve.slope * values + curve.intercept)
        if curve.kind == "gamma":
            exponent = float(np.clip(curve.exponent, -MOST_GAMMA, MOST_GAMMA))
            found = curve.slope * values**exponent + curve.intercept
            return np.asarray(np.nan_to_num(found, nan=0.0, posinf=1.0, neginf=0.0))
    if curve.kind == "identity" or not curve.values:
        return values
    table: Numbers = np.array(curve.values)
    if curve.kind == "discrete":
        return np.asarray(table[np.floor(values * len(table)).astype(np.intp).clip(0, len(table) - 1)])
    return np.asarray(np.interp(values * (len(table) - 1), np.arange(len(table)), table))


def merge(layers: Sequence[Pixels]) -> Pixels:
    """Composite layers, the first at the bottom (feMerge, 9.16)."""
    merged = layers[0]
    for layer in layers[1:]:
        merged = layer + (1.0 - layer[..., 3:]) * merged
    return merged


def composite(above: Pixels, below: Pixels, operator: str, numbers: Sequence[float] = (0.0,) * 4) -> Pixels:
    """Compose two pictures by an operator of Porter and Duff, or by arithmetic (feComposite, 9.8).

    Parameters
    ----------
    above, below : (rows, columns, 4) arrays
        The inputs `in` and `in2`.
    operator : str
        ``over``, ``in``, ``out``, ``atop``, ``xor``, ``lighter`` or ``arithmetic``.
    numbers : (4,) sequence
        k1 to k4 of ``arithmetic``. Colours above the opacity are limited to it, as browsers do.

    Returns
    -------
    (rows, columns, 4) array
    """
    a, b = above[..., 3:], below[..., 3:]
    if operator == "arithmetic":
        k1, k2, k3, k4 = numbers
        with np.errstate(over="ignore", invalid="ignore"):
            return limit_colors(k1 * above * below + k2 * above + k3 * below + k4)
    if operator == "in":
        return above * b
    if operator == "out":
        return above * (1.0 - b)
    if operator == "atop":
        return above * b + below * (1.0 - a)
    if operator == "xor":
        return above * (1.0 - b) + below * (1.0 - a)
    if operator == "lighter":
        return limit_colors(above + below)
    return above + below * (1.0 - a)


def blend(above: Pixels, below: Pixels, mode: Blend) -> Pixels:
    """Composite a picture on another one with a blend mode (feBlend, 9.5; Compositing and Blending 1, 10).

    With the source s above the backdrop b: co = cs as (1 - ab) + cb ab (1 - as) + as ab B(cb, cs).
    """
    if mode is Blend.PLUS_LIGHTER:
        return composite(above, below, "lighter")
    if mode is Blend.NORMAL:
        return composite(above, below, "over")
    a, b = above[..., 3:], below[..., 3:]
    source, backdrop = straighten(above)[..., :3], straighten(below)[..., :3]
    mixed = _mix_colors(mode, backdrop, source) if mode >= Blend.HUE else _mix_components(mode, backdrop, source)
    blended = above * (1.0 - b) + below * (1.0 - a)
    blended[..., :3] += a * b * mixed
    blended[..., 3:] += a * b
    return limit_colors(blended)


def _mix_components(mode: Blend, b: Numbers, s: Numbers) -> Numbers:
    """B(b, s) of the separable blend modes (Compositing 1, 10.1)."""
    if mode is Blend.OVERLAY:
        return _mix_components(Blend.HARD_LIGHT, s, b)
    if mode is Blend.HARD_LIGHT:
        return np.where(s <= 0.5, 2.0 * b * s, 1.0 - 2.0 * (1.0 - b) * (1.0 - s))
    if mode is Blend.COLOR_DODGE:
        dodged = np.where(s >= 1.0 - NOTHING, 1.0, np.minimum(1.0, b / np.maximum(1.0 - s, NOTHING)))
        return np.where(b <= NOTHING, 0.0, dodged)
    if mode is Blend.COLOR_BURN:
        burnt = np.where(s <= NOTHING, 0.0, 1.0 - np.minimum(1.0, (1.0 - b) / np.maximum(s, NOTHING)))
        return np.where(b >= 1.0 - NOTHING, 1.0, burnt)
    if mode is Blend.SOFT_LIGHT:
        root = np.where(b <= 0.25, ((16.0 * b - 12.0) * b + 4.0) * b, np.sqrt(b))
        return np.where(s <= 0.5, b - (1.0 - 2.0 * s) * b * (1.0 - b), b + (2.0 * s - 1.0) * (root - b))
    simple: dict[Blend, Callable[[], Numbers]] = {
        Blend.MULTIPLY: lambda: b * s,
        Blend.SCREEN: lambda: b + s - b * s,
        Blend.DARKEN: lambda: np.minimum(b, s),
        Blend.LIGHTEN: lambda: np.maximum(b, s),
        Blend.DIFFERENCE: lambda: np.abs(b - s),
        Blend.EXCLUSION: lambda: b + s - 2.0 * b * s,
    }
    return simple[mode]()


def _mix_colors(mode: Blend, b: Numbers, s: Numbers) -> Numbers:
    """B(b, s) of the blend modes of whole colours (Compositing 1, 10.2)."""
    if mode is Blend.HUE:
        return _with_luminosity(_with_saturation(s, np.ptp(b, axis=2, keepdims=True)), _luminosity(b))
    if mode is Blend.SATURATION:
        return _with_luminosity(_with_saturation(b, np.ptp(s, axis=2, keepdims=True)), _luminosity(b))
    if mode is Blend.COLOR:
        return _with_luminosity(s, _luminosity(b))
    return _with_luminosity(b, _luminosity(s))


def _luminosity(colors: Numbers) -> Numbers:
    return 0.3 * colors[..., :1] + 0.59 * colors[..., 1:2] + 0.11 * colors[..., 2:3]


def _with_luminosity(colors: Numbers, target: Numbers) -> Numbers:
    """SetLum and ClipColor."""
    moved = colors + target - _luminosity(colors)
    low, high = moved.min(axis=2, keepdims=True), moved.max(axis=2, keepdims=True)
    below = np.where(low < 0.0, target / np.maximum(target - low, NOTHING), 1.0)
    beyond = np.where(high > 1.0, (1.0 - target) / np.maximum(high - target, NOTHING), 1.0)
    return target + (moved - target) * np.minimum(below, beyond)


def _with_saturation(colors: Numbers, target: Numbers) -> Numbers:
    """SetSat."""
    low, extent = colors.min(axis=2, keepdims=True), np.ptp(colors, axis=2, keepdims=True)
    scale = np.where(extent > NOTHING, target / np.maximum(extent, NOTHING), 0.0)
    return np.asarray((colors - low) * scale)
