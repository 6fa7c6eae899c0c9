"""SVG gradients: their elements, and their position on the painted shapes (SVG 2, 14.2)."""

from dataclasses import dataclass, replace
from math import hypot
from typing import Final

import numpy as np
from lxml import etree

from vexture.bezier.bounds import bounds
from vexture.drawing.affine import Affine
from vexture.drawing.paint import Gradient, Paint, Spread, Stop
from vexture.svg.document import local_name
from vexture.svg.outline import ShapeOutline
from vexture.svg.report import Report
from vexture.svg.space import SMALLEST, ElementPlace
from vexture.svg.spatial import Attribute, css_transform, to_plane
from vexture.svg.style import ElementStyle
from vexture.svg.transform import Identity, Transform, about_origin, parse_transform
from vexture.svg.values import LARGEST, Viewport, fraction, number

LENGTHS: Final = {
    "linearGradient": {"x1": "0%", "y1": "0%", "x2": "100%", "y2": "0%"},
    "radialGradient": {"cx": "50%", "cy": "50%", "r": "50%", "fx": "", "fy": "", "fr": "0%"},
}
"""Attributes of the geometry, with their initial values; fx and fy default to cx and cy."""

GRADIENTS: Final = frozenset(LENGTHS)
SPREADS = {spread.name.lower(): spread for spread in Spread}
BOXED = {"objectBoundingBox": True, "userSpaceOnUse": False}
WHOLE = Viewport(1.0, 1.0)
"""Viewport for percentages in `objectBoundingBox` units."""

SHORTEST: Final = 1 / LARGEST
"""Shortest ramp and tile, in user units or parts of a bounding box: shorter ones have one colour and no area."""

TOUCHING: Final = 1 / 4096
"""Distance, relative to the outer radius, at which circles count as touching, as in Skia, which browsers use. If
circles touch from inside, half of the plane has colours; if they just cross, the colours there differ."""


def touching(focal: float) -> tuple[float, float]:
    """Return centre distance and radius of a focal circle that touches the end circle of radius 1, exactly in float32.

    Examples
    --------
    >>> away, focal = touching(0.6)
    >>> float(np.float32(away)) == away, float(np.float32(focal)) == focal, away == 1.0 - focal
    (True, True, True)
    """
    if focal < 0.5:  # round the larger of the radius and its difference to 1, so that the other one is exact
        away = float(np.float32(1.0 - focal))
        return away, 1.0 - away
    focal = float(np.float32(focal))
    return abs(1.0 - focal), focal


def gradient_space(place: ElementPlace, boxed: list[ShapeOutline], moved: Transform) -> Transform | None:
    """Return the map from the units of a gradient, moved, to the drawing; None if it has no area there.

    The units are the bounding box of the outlines `boxed`, or those of the place if there are none.
    """
    whole = place.space.whole
    if boxed:
        left, top, right, bottom = bounds(np.concatenate([outline.cubics for outline in boxed]))
        whole = whole.transform(Transform(right - left, 0.0, 0.0, bottom - top, left, top))
    whole = whole.transform(moved)
    a, b, c, d = whole[:4]
    return whole if SMALLEST <= abs(a * d - b * c) <= 1.0 / SMALLEST else None


@dataclass(frozen=True, slots=True, eq=False)
class GradientRamp:
    """A gradient as defined by its element and those it refers to, without a position yet."""

    radial: bool
    lengths: dict[str, str]  # one for each of `LENGTHS`
    boxed: bool  # True for parts of the bounding box
    moved: Transform  # `gradientTransform`
    origin: str  # origin of the transform
    spread: Spread
    stops: tuple[Stop, ...]  # at least one
    font_size: float  # font size of the element

    def paint(self, place: ElementPlace, outlines: list[ShapeOutline]) -> Paint | None:
        """Return the paint of outlines at a place, in the drawing's coordinates; None if it has no area there."""
        view = WHOLE if self.boxed else place.viewport
        moved = about_origin(self.moved, self.origin, view.along(self.font_size))
        whole = gradient_space(place, outlines if self.boxed else [], moved)
        if whole is None:
            return None
        gradient = self.along(view)
        if gradient is None:
            last = self.stops[-1]
            return Paint(last.color, last.opacity)
        return Paint.from_gradient(gradient.after(rows(whole.inverse())))

    def along(self, view: Viewport) -> Gradient | None:
        """Return the gradient in its own coordinates; None if only the last stop's colour shows (SVG 2, 14.2)."""
        if len(self.stops) == 1:
            return None
        return self.radial_along(view) if self.radial else self.linear_along(view)

    def linear_along(self, view: Viewport) -> Gradient | None:
        """Return `along` for a linear gradient."""
        x1, y1 = self.length("x1", view), self.length("y1", view)
        x, y = self.length("x2", view) - x1, self.length("y2", view) - y1
        if hypot(x, y) < SHORTEST:
            return None
        square = x * x + y * y
        to_ramp = Transform(x / square, -y / square, y / square, x / square, 0.0, 0.0).translate(-x1, -y1)
        return Gradient(rows(to_ramp), self.stops, self.spread)

    def radial_along(self, view: Viewport) -> Gradient | None:
        """Return `along` for a radial gradient.

        A focal circle that is not inside the outer one spans a cone with it, as in SVG 2 and all browsers. SVG 1.1
        moved the focal point onto the circle.
        """
        cx, cy, r = self.length("cx", view), self.length("cy", view), self.length("r", view)
        if r < SHORTEST:
            return None
        x = (self.length("fx", view) - cx if self.lengths["fx"] else 0.0) / r
        y = (self.length("fy", view) - cy if self.lengths["fy"] else 0.0) / r
        away, focal = hypot(x, y), self.length("fr", view) / r
        cos, sin = (x / away, y / away) if away else (1.0, 0.0)
        to_ramp = rows(Transform(cos / r, -sin / r, sin / r, cos / r, 0.0, 0.0).translate(-cx, -cy))
        if max(away, abs(1.0 - focal)) <= TOUCHING:  # a single circle: the first colour inside, the last one outside
            first, last = (replace(stop, offset=1.0) for stop in (self.stops[0], self.stops[-1]))
            return Gradient(to_ramp, (first, last), focus=(0.0, 0.0))
        if abs(away - abs(1.0 - focal)) <= TOUCHING:
            away, focal = touching(focal)
        return Gradient(to_ramp, self.stops, self.spread, (away, focal))

    def length(self, name: str, view: Viewport) -> float:
        """Return the value of an attribute of the geometry."""
        whole = {"x": view.width, "y": view.height}.get(name.strip("cf12"), view.diagonal)
        return view.length(self.lengths[name], whole, self.font_size) or 0.0


def rows(matrix: Transform) -> Affine:
    """Convert an affine map to the form that paints use."""
    a, b, c, d, e, f = matrix
    return (a, c, e), (b, d, f)


def read_ramp(
    chain: list[etree._Element], stops: tuple[Stop, ...], style: ElementStyle, report: Report
) -> GradientRamp:
    """Return the ramp of the first of some gradient elements, each of which refers to the next."""
    name = local_name(chain[0]) or ""
    lengths = dict(LENGTHS[name])
    words = dict.fromkeys(("gradientUnits", "spreadMethod", "gradientTransform"), "")
    for element in reversed(chain):
        if local_name(element) == name:  # from the other kind, only common attributes count (SVG 2, 14.1.1)
            lengths.update(own_lengths(element, name, report))
        words.update({key: text for key in words if (text := element.get(key)) is not None})
    words["gradientTransform"], moved = transform_of(words["gradientTransform"], chain[0], style)
    found = BOXED.get(words["gradientUnits"].strip()), SPREADS.get(words["spreadMethod"].strip()), moved
    for (key, text), value in zip(words.items(), found, strict=True):
        if text and value is None:
            report.invalid(key, text, chain[0])
    boxed, spread, _ = found
    radial = name == "radialGradient"
    moved, spread = moved or Identity, spread or Spread.PAD
    origin = style["transform-origin"]
    return GradientRamp(radial, lengths, boxed is not False, moved, origin, spread, stops, style.font_size)


def transform_of(text: str, element: etree._Element, style: ElementStyle) -> tuple[str, Transform | None]:
    """Return the transform of a paint server as text and value: the CSS property, or else the attribute's text.

    An attribute `transform` has no meaning here, although the cascade maps it to the property.
    """
    css = style["transform"]
    if css.lower() != "none" and not isinstance(css, Attribute):
        matrix = css_transform(css, WHOLE.along(style.font_size))
        return css, None if matrix is None else to_plane(matrix)[0]
    return text, parse_transform(text, lambda part, axis: number(part))


def own_lengths(element: etree._Element, name: str, report: Report) -> dict[str, str]:
    """Return the valid geometry attributes of an element; a negative radius counts as zero, as in browsers."""
    found = {}
    for key in LENGTHS[name]:
        text = element.get(key)
        if text is None:
            continue
        value = WHOLE.length(text, 1.0, 1.0)
        negative = key in ("r", "fr") and value is not None and value < 0.0
        if value is None or negative:
            report.invalid(key, text, element)
        if value is not None:
            found[key] = "0" if negative else text
    return found


def stop_offsets(stops: list[etree._Element], report: Report) -> list[float]:
    """Return the offsets of stops, in 0..1 and not decreasing; 0 for a stop without a number."""
    offsets, least = [], 0.0
    for stop in stops:
        text = stop.get("offset", "0")
        value = fraction(text)
        if value is None:
            report.invalid("offset", text, stop)
        least = max(least, value or 0.0)
        offsets.append(least)
    return offsets
