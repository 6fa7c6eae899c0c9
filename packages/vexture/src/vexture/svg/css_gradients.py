"""CSS gradients, which the background of the outermost element may contain (CSS Images 3, 3)."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, cos, hypot, inf, sin, sqrt
from typing import Any, Final

import tinycss2

from vexture.drawing.affine import Affine
from vexture.drawing.calculation import keyword, parse_tokens, split_arguments
from vexture.drawing.colors import Color, parse_color
from vexture.drawing.paint import Gradient, Paint, Spread, Stop
from vexture.drawing.sectors import between
from vexture.svg.style import ElementStyle
from vexture.svg.transform import KEYWORDS, Length, angle, parse_origin
from vexture.svg.values import Viewport, words
from vexture.svg.viewport import Rectangle

REPEATING: Final = "repeating-"
FUNCTIONS: Final = frozenset({"linear-gradient", "radial-gradient"})

HARMLESS: Final = frozenset(
    {
        *("no-repeat", "repeat", "repeat-x", "repeat-y", "scroll", "fixed", "local", *KEYWORDS, "0", "0%"),
        *("/", "auto", "cover", "contain", "100%"),
    }
)
"""Words of a background that change nothing if its image fills the box."""

CORNERS: Final = {"to": (0.0, 0.0), "left": (-1.0, 0.0), "right": (1.0, 0.0), "top": (0.0, -1.0), "bottom": (0.0, 1.0)}

WHOLE: Final = frozenset({"auto", "cover", "contain", "100%", "100% 100%", "auto auto"})
"""Values of the size with which an image without its own size fills the box."""

SIDES: Final = {"closest-side": (min, False), "farthest-side": (max, False), "closest-corner": (min, True)}
FARTHEST: Final = (max, True)

SPACE: Final = re.compile(r"\s+")

MIXED: Final = 8
"""Parts into which a step between stops of different opacity is divided: CSS interpolates premultiplied colours."""

Solid = Callable[[str], Color | None]
"""Function that returns the colour of a text, which may depend on the element's own colour."""


Line = tuple[Affine, float, bool]
"""Map from a box to the ramp, the ramp's length, and True if the ramp starts at a centre."""


@dataclass(frozen=True, slots=True)
class CssGradient:
    """A gradient that fills a box: its function, its first argument, and the texts of its stops."""

    name: str
    shape: str
    stops: tuple[tuple[str, ...], ...]  # a colour and up to two positions

    @property
    def repeats(self) -> bool:
        """True if it repeats after its last stop."""
        return self.name.startswith(REPEATING)

    def paint(self, box: Rectangle, solid: Solid, length: Length) -> Paint | None:
        """Return the paint of a box; None if it is not valid. `length` knows the box's sides, for percentages."""
        is_linear = self.name.endswith("linear-gradient")
        line = linear(self.shape, box) if is_linear else radial(self.shape, box, length)
        if line is None:
            return None
        to_ramp, whole, is_radial = line
        stops = self.place_stops(solid, length, whole)
        if not stops:
            return None
        first, last = stops[0].offset, stops[-1].offset
        if is_radial and first < 0.0 < last:
            stops = self.outward(stops)
            first, last = stops[0].offset, stops[-1].offset
        if last <= first or (first < 0.0 and is_radial):
            return Paint(stops[-1].color, stops[-1].opacity)
        within = [Stop((one.offset - first) / (last - first), one.color, one.opacity) for one in stops]
        spread = Spread.REPEAT if self.repeats else Spread.PAD
        (a, c, e), (b, d, f) = to_ramp
        if is_radial:
            rows = (a / last, c / last, e / last), (b / last, d / last, f / last)
            return Paint.from_gradient(Gradient(rows, tuple(add_mixed_stops(within)), spread, (0.0, first / last)))
        long = last - first
        return Paint.from_gradient(
            Gradient(((a / long, c / long, (e - first) / long), (b, d, f)), tuple(add_mixed_stops(within)), spread)
        )

    def outward(self, stops: "list[CssStop]") -> "list[CssStop]":
        """Return the stops of a radial gradient from its centre outwards, without a part before the centre."""
        first, last = stops[0].offset, stops[-1].offset
        if self.repeats:
            turns = ceil(-first / (last - first)) * (last - first)
            return [CssStop(stop.offset + turns, stop.color, stop.opacity) for stop in stops]
        at = max(number for number, stop in enumerate(stops) if stop.offset <= 0.0)
        low, high = stops[at], stops[at + 1]
        share = -low.offset / (high.offset - low.offset)
        start = between(Stop(0.0, low.color, low.opacity), Stop(1.0, high.color, high.opacity), share)
        return [CssStop(0.0, start.color, start.opacity), *stops[at + 1 :]]

    def place_stops(self, solid: Solid, length: Length, whole: float) -> "list[CssStop]":
        """Return the stops in order, with positions as fractions of the ramp; none if one is not valid."""
        found = list[CssStop]()
        for color, *places in self.stops:
            value = solid(color)
            offsets = [part_of(place, length, whole) for place in places] or [None]
            if value is None or (places and None in offsets):
                return []
            found += [CssStop(offset, value.rgb, value.alpha) for offset in offsets]
        return even(found)


@dataclass(frozen=True, slots=True)
class CssStop:
    """A stop, with or without a position."""

    at: float | None
    color: tuple[float, float, float]
    opacity: float

    @property
    def offset(self) -> float:
        """Position of the stop."""
        return 0.0 if self.at is None else self.at


def background_gradient(text: str) -> CssGradient | None:
    """Return the only gradient with which `background` or `background-image` fills the box; None for other values.

    Examples
    --------
    >>> background_gradient("linear-gradient(to right, red, #00f 60%) no-repeat")
    CssGradient(name='linear-gradient', shape='to right', stops=(('red',), ('#00f', '60%')))
    """
    found = None
    for token in parse_tokens(text.strip()):
        word = str(tinycss2.serialize([token])).strip().lower()
        if token.type == "function" and token.lower_name.removeprefix(REPEATING) in FUNCTIONS and found is None:
            found = read_function(token)
            if found is None:
                return None
        elif word and word not in HARMLESS and not parse_color(word):
            return None
    return found


def own_background(style: ElementStyle) -> CssGradient | None:
    """Return the gradient that fills the box of the outermost element; None without one, or with several."""
    is_whole = style["background-size"].lower() in WHOLE and style["background-blend-mode"].lower() == "normal"
    return background_gradient(style["background-image"]) if is_whole else None


def background_of(style: ElementStyle, frame: Rectangle) -> list[Paint]:
    """Return the background paints of the outermost element, the lowest first; `frame` is its box."""
    found = []
    color = style.solid(style["background-color"])
    if color is not None and color.alpha > 0.0:
        found.append(Paint(color.rgb, color.alpha))
    gradient = own_background(style)
    if gradient is not None:
        view = Viewport(*frame[2:])
        paint = gradient.paint(frame, style.solid, view.along(style.font_size))
        found += [] if paint is None else [paint]
    return found


def read_function(token: Any) -> CssGradient | None:
    """Parse a gradient function; None for unsupported ones: with colour hints or colour spaces for interpolation."""
    arguments = [tinycss2.serialize(part).strip() for part in split_arguments(token.arguments)]
    shape = "" if parse_color(first_word(arguments[0])) else arguments.pop(0)
    said = words(shape.lower(), SPACE)
    if len(arguments) < 2 or "in" in said or ("at" in said and len(said) - said.index("at") > 3):
        return None  # an interpolation space, or a position relative to other sides
    stops = []
    for argument in arguments:
        parts = [str(tinycss2.serialize([part])) for part in parse_tokens(argument) if part.type != "whitespace"]
        if not 1 <= len(parts) <= 3 or not parse_color(parts[0]):
            return None
        stops.append(tuple(parts))
    return CssGradient(token.lower_name, shape, tuple(stops))


def first_word(text: str) -> str:
    """Return the first value in a text."""
    tokens = [token for token in parse_tokens(text) if token.type != "whitespace"]
    return str(tinycss2.serialize(tokens[:1])) if tokens else ""


def linear(shape: str, box: Rectangle) -> Line | None:
    """Return the map of a box to the ramp of a linear gradient, and the length of its line (CSS Images 3, 3.1)."""
    left, top, width, height = box
    said = shape.lower().split()
    if not said:
        x, y = 0.0, 1.0
    elif said[0] == "to" and all(word in CORNERS for word in said) and len(said) in (2, 3):
        sides = [CORNERS[word] for word in said]
        x, y = (sum(side[k] for side in sides) for k in (0, 1))
        if x and y:
            x, y = x * height, y * width  # the line of the middle runs through the other two corners
    else:
        turn = angle(shape)
        if turn is None:
            return None
        x, y = sin(turn), -cos(turn)
    away = hypot(x, y)
    if away == 0.0:
        return None
    x, y = x / away, y / away
    whole = abs(width * x) + abs(height * y)
    start = (left + width / 2) * x + (top + height / 2) * y - whole / 2
    return ((x / whole, y / whole, -start / whole), (-y / whole, x / whole, 0.0)), whole, False


def radial(shape: str, box: Rectangle, length: Length) -> Line | None:
    """Return the map of a box to a radial gradient's ramp, and the length of its first radius (CSS Images 3, 3.2)."""
    left, top, width, height = box
    size, _, place = f" {shape.lower()} ".partition(" at ")
    middle = parse_origin(place.strip() or "center", length)
    said = size.split()
    if middle is None:
        return None
    x, y = middle
    is_circle = "circle" in said
    said = [word for word in said if word not in ("circle", "ellipse")]
    nearest, to_corner = SIDES.get(said[0], FARTHEST) if said else FARTHEST
    radii: list[float | None]
    if said and said[0] not in SIDES and said != ["farthest-corner"]:
        radii = [length(word, axis) for axis, word in enumerate(said)]
        radii = radii * 2 if len(radii) == 1 else radii
    else:
        across, down = nearest(abs(x), abs(width - x)), nearest(abs(y), abs(height - y))
        if is_circle:
            radii = [hypot(across, down) if to_corner else nearest(across, down)] * 2
        else:
            factor = sqrt(2.0) if to_corner else 1.0
            radii = [factor * across, factor * down]
    match radii:
        case [float(a), float(b)] if a > 0.0 and b > 0.0:
            return ((1.0 / a, 0.0, -(left + x) / a), (0.0, 1.0 / b, -(top + y) / b)), a, True
    return None


def part_of(text: str, length: Length, whole: float) -> float | None:
    """Return the position of a stop as a fraction of the ramp's length; None if it is not valid."""
    if text.endswith("%"):
        value = length(text.removesuffix("%"), 0)
        return None if value is None else value / 100.0
    if keyword(list(parse_tokens(text))):
        return None
    turn = length(text, 0)
    return None if turn is None or whole <= 0.0 else turn / whole


def even(stops: list[CssStop]) -> list[CssStop]:
    """Give all stops positions that do not decrease; missing ones are spread evenly between others (3.4.3)."""
    if not stops:
        return []
    at = [stop.at for stop in stops]
    at[0] = 0.0 if at[0] is None else at[0]
    at[-1] = 1.0 if at[-1] is None else at[-1]
    known = [number for number, place in enumerate(at) if place is not None]
    least = -inf
    for number in known:
        at[number] = least = max(least, at[number] or 0.0)
    for before, after in pairwise(known):
        low, high = at[before] or 0.0, at[after] or 0.0
        for number in range(before + 1, after):
            at[number] = low + (high - low) * (number - before) / (after - before)
    return [CssStop(place, stop.color, stop.opacity) for place, stop in zip(at, stops, strict=True)]


def add_mixed_stops(stops: list[Stop]) -> list[Stop]:
    """Add stops between those of different opacity, with colours that are interpolated premultiplied."""
    found = stops[:1]
    for before, after in pairwise(stops):
        if before.opacity != after.opacity:
            found += [between(before, after, part / MIXED) for part in range(1, MIXED)]
        found.append(after)
    return found
