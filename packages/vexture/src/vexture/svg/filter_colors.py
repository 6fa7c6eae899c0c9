"""Functions of colours in filters, and their effect on paints (Filter Effects 1, 9.6 and 9.7)."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial
from math import cos, sin
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing
from vexture.drawing.effect import Pixels
from vexture.drawing.paint import Color, Gradient, Paint, Stop
from vexture.svg.compositing import masking
from vexture.svg.filter_pixels import from_linear, map_colors, to_linear

Colors = NDArray[np.float64]
"""Colours (n, 4): red, green, blue, not premultiplied, and opacity, each in 0..1."""

Channel = Callable[[Colors], Colors]
"""Function of one component."""

MOST_STOPS: Final = 128
"""Most stops of a gradient whose colours are changed."""

FINEST: Final = 16
"""Most parts into which a part of a ramp is divided if the function is not affine along it."""

MATRICES: Final = {
    "saturate": (
        np.array([[0.213, 0.715, 0.072]] * 3),
        np.array([[0.787, -0.715, -0.072], [-0.213, 0.285, -0.072], [-0.213, -0.715, 0.928]]),
    ),
    "sepia": (
        np.array([[0.393, 0.769, 0.189], [0.349, 0.686, 0.168], [0.272, 0.534, 0.131]]),
        np.array([[0.607, -0.769, -0.189], [-0.349, 0.314, -0.168], [-0.272, -0.534, 0.869]]),
    ),
    "grayscale": (
        np.array([[0.2126, 0.7152, 0.0722]] * 3),
        np.array([[0.7874, -0.7152, -0.0722], [-0.2126, 0.2848, -0.0722], [-0.2126, -0.7152, 0.9278]]),
    ),
}
"""Constant and linear parts of matrices with a parameter."""

TURNED: Final = np.array([[-0.213, -0.715, 0.928], [0.143, 0.140, -0.283], [-0.787, 0.715, 0.072]])
"""Part of the matrix of a turn of hues that grows with the sine of the angle."""

LUMINANCE: Final = (0.2125, 0.7154, 0.0721)


@dataclass(frozen=True)
class ColorFunction:
    """A function of colours: an affine one, by its matrix, or of each component.

    Parameters
    ----------
    matrix : (4, 5) float64 array or None
        Factors of red, green, blue, opacity and 1 in each component.
    channels : tuple of Channel or None
        One for each component.
    is_linear : bool
        True if it changes colours in linear light.
    """

    matrix: Colors | None = None
    channels: tuple[Channel, ...] | None = None
    is_linear: bool = False

    def of(self, colors: Colors) -> Colors:
        """Return the colours after the function."""
        return np.clip(self.beyond(colors), 0.0, 1.0)

    def beyond(self, colors: Colors) -> Colors:
        """Return the colours after the function; in sRGB, some may be outside 0..1."""
        found: Colors
        given = np.clip(colors, 0.0, 1.0)
        given = np.concatenate([to_linear(given[:, :3]), given[:, 3:]], axis=1) if self.is_linear else given
        if self.matrix is not None:
            found = np.einsum("nk,jk->nj", given, self.matrix[:, :4]) + self.matrix[:, 4]
        else:
            assert self.channels is not None
            found = np.stack([channel(given[:, k]) for k, channel in enumerate(self.channels)], axis=1)
        if self.is_linear:
            found = np.clip(found, 0.0, 1.0)
            found[:, :3] = from_linear(found[:, :3])
        return found

    def color(self, color: Color, opacity: float = 1.0) -> tuple[Color, float]:
        """Return one colour and its opacity after the function."""
        red, green, blue, alpha = self.of(np.array([[*color, opacity]]))[0].tolist()
        return (red, green, blue), alpha

    @cached_property
    def constant(self) -> Color | None:
        """The only colour that it yields; None if there are several."""
        if self.matrix is None or self.matrix[:3, :4].any():
            return None
        return self.color((0.0, 0.0, 0.0))[0]

    @cached_property
    def keeps_alpha(self) -> bool:
        """True if it does not change opacities."""
        if self.matrix is not None:
            return bool((self.matrix[3] == (0.0, 0.0, 0.0, 1.0, 0.0)).all())
        assert self.channels is not None
        return self.channels[3] is pass_values

    @property
    def mixes_alpha(self) -> bool:
        """True if colours depend on opacities."""
        return self.matrix is not None and bool(self.matrix[:3, 3].any())

    @property
    def reads_colors(self) -> bool:
        """True if opacities depend on colours."""
        return self.matrix is not None and bool(self.matrix[3, :3].any())

    @property
    def of_colors(self) -> "ColorFunction":
        """The function without its change of opacities."""
        if self.matrix is None:
            assert self.channels is not None
            return replace(self, channels=(*self.channels[:3], pass_values))
        matrix = self.matrix.copy()
        matrix[3] = (0.0, 0.0, 0.0, 1.0, 0.0)
        return replace(self, matrix=matrix)

    def alpha(self, opacity: float) -> float:
        """Return the opacity that it makes of one, without a part of colours."""
        if self.matrix is None:
            assert self.channels is not None
            return float(np.clip(self.channels[3](np.array([opacity]))[0], 0.0, 1.0))
        return float(np.clip(self.matrix[3, 3] * opacity + self.matrix[3, 4], 0.0, 1.0))


def pass_values(values: Colors) -> Colors:
    """Return the values."""
    return values


def matrix_of(values: Colors) -> Colors:
    """Extend a matrix (3, 3) of colours to one that keeps opacities."""
    matrix = np.eye(4, 5)
    matrix[:3, :3] = values
    return matrix


def weighted_matrix(name: str, amount: float) -> Colors:
    """Return one of `MATRICES` for the amount of its linear part."""
    fixed, varied = MATRICES[name]
    return matrix_of(fixed + amount * varied)


def hue_matrix(turn: float) -> Colors:
    """Return the matrix of a turn of hues by radians.

    Examples
    --------
    >>> np.allclose(hue_matrix(0.0), np.eye(4, 5))
    True
    """
    fixed, varied = MATRICES["saturate"]
    return matrix_of(fixed + cos(turn) * varied + sin(turn) * TURNED)


def luminance_matrix() -> Colors:
    """Return the matrix that makes opacity of luminance."""
    matrix = np.zeros((4, 5))
    matrix[3, :3] = LUMINANCE
    return matrix


def scale_colors(factor: float, shift: float = 0.0) -> Colors:
    """Return the matrix that multiplies colours and adds to them."""
    matrix = np.eye(4, 5)
    matrix[:3, :3] *= factor
    matrix[:3, 4] = shift
    return matrix


def change_paint(paint: Paint, function: ColorFunction) -> Paint:
    """Return a paint after a function; of a blur, only colours change."""
    if paint.gradient is not None:
        return change_gradient(paint.gradient, function)
    if paint.picture is not None:
        return change_picture(paint, function)
    if paint.effect is not None:
        return replace(paint, effect=paint.effect.then(partial(map_colors, function=function.of)))
    if paint.blur is None:
        return Paint(*function.color(paint.color, paint.opacity))
    colors = function.of_colors
    if not paint.blur.has_colors:
        return replace(paint, color=colors.color(paint.color)[0])
    return replace(paint, blur=replace(paint.blur, source=change_drawing(paint.blur.source, colors)))


def change_drawing(drawing: Drawing, function: ColorFunction) -> Drawing:
    """Return a drawing with the paints of all paths outside masks changed."""
    masks = masking(drawing.groups)
    return replace(
        drawing,
        paths=tuple(
            path if path.group >= 0 and masks[path.group] else replace(path, paint=change_paint(path.paint, function))
            for path in drawing.paths
        ),
    )


def change_gradient(gradient: Gradient, function: ColorFunction) -> Paint:
    """Return a gradient after a function: exact if it is affine in sRGB without clamping, or else in fine steps."""
    stops = np.array([[*stop.color, stop.opacity] for stop in gradient.stops])
    offsets = np.array([stop.offset for stop in gradient.stops])
    beyond = function.beyond(stops)
    if function.matrix is None or function.is_linear or beyond.min() < -1e-9 or beyond.max() > 1.0 + 1e-9:
        stops, offsets = divide_ramp(stops, offsets)
    found = (
        Stop(offset, (red, green, blue), alpha)
        for offset, (red, green, blue, alpha) in zip(offsets.tolist(), function.of(stops).tolist(), strict=True)
    )
    return Paint.from_gradient(replace(gradient, stops=tuple(found)))


def divide_ramp(stops: Colors, offsets: Colors) -> tuple[Colors, Colors]:
    """Insert stops between those of a ramp, as many as a gradient may have."""
    parts = max(1, min(FINEST, (MOST_STOPS - 1) // max(len(stops) - 1, 1)))
    at = np.arange(len(stops) - 1)[:, None] + np.arange(parts) / parts
    places = np.append(at[np.diff(offsets) > 0.0].reshape(-1), np.arange(len(stops), dtype=np.float64))
    places = np.unique(places)
    index = np.arange(len(stops), dtype=np.float64)
    found = np.stack([np.interp(places, index, stops[:, k]) for k in range(4)], axis=1)
    return found, np.interp(places, index, offsets)


def change_picture(paint: Paint, function: ColorFunction) -> Paint:
    """Return a picture with the colours of its pixels changed."""
    picture = paint.picture
    assert picture is not None
    values = picture.pixels.reshape(-1, 4) / 255.0
    alpha = values[:, 3:]
    straight = np.divide(values[:, :3], alpha, out=np.zeros_like(values[:, :3]), where=alpha > 0.0)
    changed = function.of(np.concatenate([straight, alpha * picture.opacity], axis=1))
    changed[:, :3] *= changed[:, 3:]
    pixels = np.rint(changed * 255.0).astype(np.uint8).reshape(picture.pixels.shape)
    return Paint.from_picture(replace(picture, pixels=pixels, opacity=1.0))


def color_opacities(pixels: Pixels, color: Color) -> Pixels:
    """Return pixels in one colour, with the opacities of others."""
    recolored: Pixels = pixels[..., 3:] * (*color, 1.0)
    return recolored


def recolor_paint(paint: Paint, color: Color) -> Paint:
    """Return a paint in one colour, with its opacities.

    Examples
    --------
    >>> recolor_paint(Paint((1, 0, 0), 0.5), (0, 0, 1)).hex
    '#0000ff80'
    """
    if paint.blur is not None:
        return replace(paint, color=color, blur=replace(paint.blur, has_colors=False, is_linear=False))
    if paint.effect is not None:
        return replace(paint, effect=paint.effect.then(partial(color_opacities, color=color)))
    if paint.is_opaque:
        return Paint(color)
    if paint.gradient is not None:
        stops = tuple(replace(stop, color=color) for stop in paint.gradient.stops)
        return Paint.from_gradient(replace(paint.gradient, stops=stops))
    if paint.picture is not None:
        matrix = np.zeros((4, 5))
        matrix[:3, 4], matrix[3, 3] = color, 1.0
        return change_picture(paint, ColorFunction(matrix))
    return replace(paint, color=color)
