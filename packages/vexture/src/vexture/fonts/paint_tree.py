"""The tree of clips, fills and groups by which HarfBuzz paints a colour glyph (OpenType COLR, versions 0 and 1).

Its gradients are more general than those of SVG: stops outside 0..1, slanted linear gradients, any two circles.
Equations and rules are from the OpenType specification, 1.9.1, "COLR", section "Gradients".
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cache
from itertools import pairwise
from math import hypot, pi
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from vexture.base.notes import Notes
from vexture.bezier.convert import line_cubics
from vexture.drawing.affine import Affine
from vexture.drawing.paint import Color, Gradient, Paint, Spread, Stop
from vexture.fonts.engine import harfbuzz
from vexture.fonts.sweeps import SweepFill, sweep_courses

Contours: TypeAlias = tuple[NDArray[np.float64], ...]

IDENTITY: Affine = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))

SPREADS: Final = {"PAD": Spread.PAD, "REPEAT": Spread.REPEAT, "REFLECT": Spread.REFLECT}

TIP: Final = 1.0 / 512.0
"""Part of a ramp that is cut off at radius 0: `Gradient` needs a circle there, and no 8-bit colour changes."""

Circle: TypeAlias = tuple[float, ...]
"""Centre and radius."""

Line: TypeAlias = tuple[float, float, tuple[Stop, ...]]
"""Positions of the first and last stop on the paint's own ramp, and the stops, rescaled to 0..1."""


@dataclass(frozen=True, slots=True)
class Fill:
    """A paint that fills the clips around it."""

    paint: Paint


@dataclass(slots=True)
class Clip:
    """Content clipped to an outline in font units, or to a box that states bounds."""

    contours: Contours
    is_box: bool = False
    children: list["Node"] = field(default_factory=list)


@dataclass(slots=True)
class Composite:
    """Content that is composited by itself and then with what is below, by a mode named as in HarfBuzz."""

    mode: str = "SRC_OVER"
    children: list["Node"] = field(default_factory=list)


Node: TypeAlias = Fill | SweepFill | Clip | Composite


def paint_tree(font: Any, glyph: int, outline: Callable[[int], Contours], foreground: Color, notes: Notes) -> Composite:
    """Return the tree of nodes that paint a glyph; note all differences from the font's description."""
    painter = GlyphPainter(outline, foreground, notes)
    red, green, blue = (round(255.0 * part) for part in foreground)
    font.paint_glyph(glyph, paint_funcs(), painter, 0, harfbuzz().Color(red, green, blue, 255))
    return painter.root


class GlyphPainter:
    """Painter that builds the tree; HarfBuzz opens and closes transforms, clips and groups in turn."""

    def __init__(self, outline: Callable[[int], Contours], foreground: Color, notes: Notes) -> None:
        self.outline = outline
        self.foreground = foreground
        self.notes = notes
        self.root = Composite()
        self.open: list[Clip | Composite] = [self.root]
        self.matrices = [IDENTITY]

    def transform(self, matrix: Affine) -> None:
        """Open a transform, which is applied before the open ones."""
        (a, b, c), (d, e, f) = self.matrices[-1]
        (p, q, r), (s, t, u) = matrix
        rows = (a * p + b * s, a * q + b * t, a * r + b * u + c), (d * p + e * s, d * q + e * t, d * r + e * u + f)
        self.matrices.append(rows)

    def clip(self, contours: Contours, is_box: bool = False) -> None:
        """Open a clip to an outline in the current coordinates."""
        upright = is_box and self.matrices[-1][0][1] == self.matrices[-1][1][0] == 0.0
        self.begin(Clip(tuple(transform_contour(contour, self.matrices[-1]) for contour in contours), upright))

    def begin(self, node: Clip | Composite) -> None:
        """Open a clip or group."""
        self.open[-1].children.append(node)
        self.open.append(node)

    def end(self, mode: str | None = None) -> None:
        """Close the last open clip or group."""
        node = self.open.pop()
        if mode is not None and isinstance(node, Composite):
            node.mode = mode

    def fill(self, paint: Paint | None) -> None:
        """Add a paint, unless it or the current transform makes it invisible."""
        (a, b, c), (d, e, f) = self.matrices[-1]
        determinant = a * e - b * d
        if paint is None or determinant == 0.0:
            return
        p, q, r, s = (part / determinant for part in (e, -b, -d, a))
        self.open[-1].children.append(Fill(paint.after(((p, q, -p * c - q * f), (r, s, -r * c - s * f)))))

    def sweep(self, line: Any, numbers: tuple[float, ...]) -> None:
        """Add a sweep gradient, unless it or the current transform makes it invisible."""
        (a, b, _), (d, e, _) = self.matrices[-1]
        found = swept(line, numbers, self.foreground, self.matrices[-1], self.notes) if a * e - b * d != 0.0 else None
        if found is not None:
            self.open[-1].children.append(found)


def transform_contour(contour: NDArray[np.float64], matrix: Affine) -> NDArray[np.float64]:
    """Transform a contour by an affine map."""
    (a, b, c), (d, e, f) = matrix
    x, y = contour[..., 0], contour[..., 1]
    return np.stack([a * x + b * y + c, d * x + e * y + f], axis=-1)


def rectangle(left: float, bottom: float, right: float, top: float) -> Contours:
    """Return the outline of a rectangle."""
    corners = np.array([(left, bottom), (right, bottom), (right, top), (left, top)])
    return (line_cubics(corners, np.roll(corners, -1, axis=0)),)


@cache
def paint_funcs() -> Any:
    """Return the callbacks by which HarfBuzz paints with a `GlyphPainter`."""
    funcs = harfbuzz().PaintFuncs()
    funcs.set_push_transform_func(lambda a, d, b, e, c, f, painter: painter.transform(((a, b, c), (d, e, f))))
    funcs.set_pop_transform_func(lambda painter: painter.matrices.pop())
    funcs.set_push_clip_glyph_func(lambda glyph, painter: painter.clip(painter.outline(glyph)))
    funcs.set_push_clip_rectangle_func(lambda a, b, c, d, painter: painter.clip(rectangle(a, b, c, d), True))
    funcs.set_pop_clip_func(lambda painter: painter.end())
    funcs.set_push_group_func(lambda painter: painter.begin(Composite()))
    funcs.set_pop_group_func(lambda mode, painter: painter.end(mode.name))
    funcs.set_color_func(lambda color, own, painter: painter.fill(solid(color, own, painter.foreground)))
    funcs.set_linear_gradient_func(lambda line, *args: args[-1].fill(linear(line, args[:-1], args[-1].foreground)))
    funcs.set_radial_gradient_func(
        lambda line, *args: args[-1].fill(radial(line, args[:-1], args[-1].foreground, args[-1].notes))
    )
    funcs.set_sweep_gradient_func(lambda line, *args: args[-1].sweep(line, args[:-1]))
    return funcs


def solid(color: Any, is_foreground: bool, foreground: Color) -> Paint:
    """Return a flat paint; with `is_foreground` it is the text's own colour, which stays unrounded."""
    plain = (color.red / 255.0, color.green / 255.0, color.blue / 255.0)
    return Paint(foreground if is_foreground else plain, color.alpha / 255.0)


def line_of(line: Any, foreground: Color) -> Line | None:
    """Return the stops of a colour line in order; None if there are none."""
    found = []
    for stop in sorted(line.color_stops, key=lambda stop: stop.offset):
        paint = solid(stop.color, stop.is_foreground, foreground)
        found.append((stop.offset, paint))
    if not found:
        return None
    first, last = found[0][0], found[-1][0]
    length = last - first or 1.0
    return first, last, tuple(Stop((at - first) / length, paint.color, paint.opacity) for at, paint in found)


def spread_of(line: Any) -> Spread:
    """Return the spread of a colour line."""
    return SPREADS[line.extend.name]


def flat(stop: Stop) -> Paint:
    """Return the flat paint of a stop."""
    return Paint(stop.color, stop.opacity)


def linear(line: Any, points: tuple[float, ...], foreground: Color) -> Paint | None:
    """Return the linear gradient from p0 to p1 with isolines parallel to p0 p2; None if it is invisible."""
    x0, y0, x1, y1, x2, y2 = points
    found = line_of(line, foreground)
    across = hypot(x2 - x0, y2 - y0)
    if found is None or across == 0.0:
        return None
    nx, ny = (y2 - y0) / across, (x0 - x2) / across
    length = (x1 - x0) * nx + (y1 - y0) * ny
    if length == 0.0:
        return None
    first, last, stops = found
    if first == last and spread_of(line) is not Spread.PAD:
        return flat(stops[-1])
    scale = 1.0 / (length * (last - first or 1.0))
    origin = first / (last - first or 1.0)
    u, v = nx * scale, ny * scale
    rows: Affine = ((u, v, -u * x0 - v * y0 - origin), (-v, u, v * x0 - u * y0))
    return Paint.from_gradient(Gradient(rows, stops, spread_of(line)))


def radial(line: Any, circles: tuple[float, ...], foreground: Color, notes: Notes) -> Paint | None:
    """Return the radial gradient from one circle to another; None if it is invisible."""
    found = line_of(line, foreground)
    if found is None:
        return None
    first, last, stops = found
    if first == last and spread_of(line) is not Spread.PAD:
        return flat(stops[-1])
    begins, ends = (circle_at(circles[:3], circles[3:], t) for t in (first, last if last > first else first + 1.0))
    if begins[2] <= 0.0 and ends[2] <= 0.0:
        return None
    low, high = 0.0, 1.0
    if min(begins[2], ends[2]) < 0.0:
        if spread_of(line) is not Spread.PAD:
            notes.simplification("radial gradient that repeats from below radius 0, shown as its mean colour")
            return mean(stops)
        zero = begins[2] / (begins[2] - ends[2])
        low, high = (zero, 1.0) if begins[2] < 0.0 else (0.0, zero)
    if ends[2] <= 0.0:
        high *= 1.0 - TIP
    return between(circle_at(begins, ends, low), circle_at(begins, ends, high), cut(stops, low, high), spread_of(line))


def circle_at(begins: Circle, ends: Circle, t: float) -> Circle:
    """Interpolate between two circles."""
    x, y, radius = (a + (b - a) * t for a, b in zip(begins, ends, strict=True))
    return x, y, radius


def cut(stops: tuple[Stop, ...], low: float, high: float) -> tuple[Stop, ...]:
    """Cut a ramp to the part between two positions, which become 0 and 1.

    Examples
    --------
    >>> [stop.color for stop in cut((Stop(0.0, (0, 0, 0)), Stop(1.0, (1, 1, 1))), 0.5, 0.75)]
    [(0.5, 0.5, 0.5), (0.75, 0.75, 0.75)]
    """
    if low <= 0.0 and high >= 1.0:
        return stops
    inner = [replace(stop, offset=(stop.offset - low) / (high - low)) for stop in stops if low < stop.offset < high]
    return replace(stop_at(stops, low), offset=0.0), *inner, replace(stop_at(stops, high), offset=1.0)


def stop_at(stops: tuple[Stop, ...], place: float) -> Stop:
    """Return the colour of a ramp at a position between its first and last stop."""
    for one, two in pairwise(stops):
        if one.offset <= place <= two.offset and one.offset < two.offset:
            part = (place - one.offset) / (two.offset - one.offset)
            red, green, blue = (a + (b - a) * part for a, b in zip(one.color, two.color, strict=True))
            return Stop(place, (red, green, blue), one.opacity + (two.opacity - one.opacity) * part)
    return stops[-1]


def between(begins: Circle, ends: Circle, stops: tuple[Stop, ...], spread: Spread) -> Paint:
    """Return the radial gradient from one circle to another one, whose radius is above 0."""
    x, y, radius = ends
    dx, dy = begins[0] - x, begins[1] - y
    away = hypot(dx, dy)
    c, s = (dx / away / radius, dy / away / radius) if away else (1.0 / radius, 0.0)
    rows: Affine = ((c, s, -c * x - s * y), (-s, c, s * x - c * y))
    return Paint.from_gradient(Gradient(rows, stops, spread, (away / radius, max(begins[2], 0.0) / radius)))


def mean(stops: tuple[Stop, ...]) -> Paint:
    """Return the flat paint of the mean colour of stops."""
    return replace(Paint.from_gradient(Gradient(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)), stops)), gradient=None)


def swept(
    line: Any, numbers: tuple[float, ...], foreground: Color, matrix: Affine, notes: Notes
) -> SweepFill | Fill | None:
    """Return a sweep gradient about a point from one angle to another, in radians; None if it is invisible.

    `matrix` maps its coordinates to font units.
    """
    x, y, start, end = numbers
    found = line_of(line, foreground)
    if found is None:
        return None
    first, last, stops = found
    spread = spread_of(line)
    turns = start / (2.0 * pi), end / (2.0 * pi)
    if first == last and spread is not Spread.PAD:
        return Fill(flat(stops[-1]))
    if start == end and spread is not Spread.PAD:
        return None
    places = [first + stop.offset * (last - first) for stop in stops]
    plain = [replace(stop, offset=0.0) for stop in stops]
    courses = sweep_courses(plain, places, turns, spread)
    if not courses:
        notes.simplification("sweep gradient that repeats very often, shown as its mean colour")
        return Fill(mean(stops))
    sweep = SweepFill(courses, (x, y), matrix)
    notes.simplification(f"sweep gradient drawn in {len(sweep.sectors)} sectors")
    return sweep
