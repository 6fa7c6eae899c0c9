"""Paints: flat colours, gradients as in SVG, pictures and blurs."""

from dataclasses import dataclass, replace
from enum import IntEnum
from math import isfinite

from vexture.base.errors import SourceError
from vexture.drawing.affine import Affine, compose_affine
from vexture.drawing.blur import Blur
from vexture.drawing.effect import Effect
from vexture.drawing.picture import Picture

Color = tuple[float, float, float]
"""Red, green and blue, sRGB, each in 0..1."""


class Spread(IntEnum):
    """Continuation of a gradient beyond its first and last stop: constant, mirrored or repeated."""

    PAD = 0
    REFLECT = 1
    REPEAT = 2


@dataclass(frozen=True, slots=True)
class Stop:
    """A colour at an offset of a gradient's ramp; unpremultiplied sRGB is interpolated linearly between stops."""

    offset: float
    color: Color
    opacity: float = 1.0

    def __post_init__(self) -> None:
        if not all(0.0 <= part <= 1.0 for part in (self.offset, *self.color, self.opacity)):
            raise SourceError(f"a stop is at {self.offset}, {self.color} with opacity {self.opacity}; all are in 0..1")


@dataclass(frozen=True, slots=True)
class Gradient:
    """Colours along a ramp, by its parameter t, as in SVG 2, 14.2.

    Parameters
    ----------
    to_ramp : Affine
        Map from the drawing's coordinates to those of the ramp. There, t = x for a linear gradient. The outer circle
        of a radial one is the unit circle, and its focal point lies on the x axis.
    stops : tuple of Stop
        One or more, with offsets that do not decrease.
    spread : Spread
    focus : (float, float) or None
        For a radial gradient: x of the focal point, at least 0, and the focal radius. Its circle at t has the centre
        (x (1 - t), 0) and the radius (1 - t) times the focal radius plus t. None for a linear gradient.
    """

    to_ramp: Affine
    stops: tuple[Stop, ...]
    spread: Spread = Spread.PAD
    focus: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        offsets = [stop.offset for stop in self.stops]
        if not offsets or offsets != sorted(offsets):
            raise SourceError(f"a gradient has stops at {offsets}; it needs one or more, in order")
        numbers = [*self.to_ramp[0], *self.to_ramp[1], *(self.focus or ())]
        if not all(map(isfinite, numbers)) or min(self.focus or (0.0,)) < 0.0:
            raise SourceError(f"a gradient has the map {self.to_ramp} and the focus {self.focus}; all must be finite")

    def after(self, matrix: Affine) -> "Gradient":
        """Return the gradient in new coordinates; `matrix` maps the new ones to the old ones."""
        return replace(self, to_ramp=compose_affine(self.to_ramp, matrix))


@dataclass(frozen=True, slots=True)
class Paint:
    """A flat colour, as sRGB components and opacity in 0..1, or a gradient or picture with its mean as the flat colour.

    Renderers without gradients show the flat colour. A paint has only one of a gradient, a picture, a blur and an
    effect. A blur uses the flat colour, or only its opacity (see `Blur`), and an effect only its opacity.
    """

    color: Color = (0.0, 0.0, 0.0)
    opacity: float = 1.0
    gradient: Gradient | None = None
    picture: Picture | None = None
    blur: Blur | None = None
    effect: Effect | None = None

    def __post_init__(self) -> None:
        if not all(0.0 <= part <= 1.0 for part in (*self.color, self.opacity)):
            raise SourceError(f"a paint is {self.color} with opacity {self.opacity}; all must be in 0..1")

    @classmethod
    def from_gradient(cls, gradient: Gradient) -> "Paint":
        """Make the paint of a gradient; its flat colour is the mean of the stops.

        Examples
        --------
        >>> Paint.from_gradient(Gradient(((1, 0, 0), (0, 1, 0)), (Stop(0, (1, 0, 0)), Stop(1, (0, 0, 1), 0.5)))).hex
        '#800080bf'
        """
        stops = gradient.stops
        red, green, blue = (sum(stop.color[k] for stop in stops) / len(stops) for k in range(3))
        return cls((red, green, blue), sum(stop.opacity for stop in stops) / len(stops), gradient)

    @classmethod
    def from_picture(cls, picture: Picture) -> "Paint":
        """Make the paint of a picture; its flat colour is the picture's mean."""
        *color, opacity = picture.mean
        return cls((color[0], color[1], color[2]), opacity, picture=picture)

    def fade(self, opacity: float) -> "Paint":
        """Return the paint with its opacity, and those of all stops, multiplied."""
        if opacity == 1.0:
            return self
        gradient, picture = self.gradient, self.picture
        if picture is not None:
            picture = picture.fade(opacity)
        if gradient is not None:
            stops = tuple(replace(stop, opacity=opacity * stop.opacity) for stop in gradient.stops)
            gradient = replace(gradient, stops=stops)
        return Paint(self.color, opacity * self.opacity, gradient, picture, self.blur, self.effect)

    def after(self, matrix: Affine) -> "Paint":
        """Return the paint in new coordinates; `matrix` maps the new ones to the old ones."""
        if self.picture is not None:
            return replace(self, picture=self.picture.after(matrix))
        if self.blur is not None:
            return replace(self, blur=self.blur.after(matrix))
        if self.effect is not None:
            return replace(self, effect=self.effect.after(matrix))
        return self if self.gradient is None else replace(self, gradient=self.gradient.after(matrix))

    @property
    def is_varied(self) -> bool:
        """True if the colour differs from point to point: a gradient, a picture or a blur."""
        return self.gradient is not None or self.picture is not None or self.is_soft

    @property
    def is_soft(self) -> bool:
        """True for a blur or an effect, which depend on other drawings."""
        return self.blur is not None or self.effect is not None

    @property
    def is_opaque(self) -> bool:
        """True if nothing below shows through any part of the paint."""
        if self.picture is not None:
            return self.picture.is_opaque
        if self.is_soft:
            return False
        if self.gradient is None:
            return self.opacity >= 1.0
        focus = self.gradient.focus
        inside = focus is None or focus[0] + focus[1] < 1.0  # otherwise it is a cone with nothing beside it
        return inside and all(stop.opacity >= 1.0 for stop in self.gradient.stops)

    @property
    def hex(self) -> str:
        """Flat colour in CSS notation, rounded to 8 bits: ``#rrggbb``, or ``#rrggbbaa`` if it is translucent.

        Examples
        --------
        >>> Paint((1.0, 0.5, 0.0)).hex, Paint(opacity=0.5).hex
        ('#ff8000', '#00000080')
        """
        channels = (*self.color, self.opacity) if self.opacity < 1.0 else self.color
        return "#" + "".join(f"{round(255.0 * channel):02x}" for channel in channels)


BLACK = Paint()
