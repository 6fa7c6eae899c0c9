"""What is between two values of a property or an attribute, by what it means."""

import re
from collections.abc import Callable
from math import lcm
from typing import Final

from vexture.svg.between import UnclearError, Way, color_mix, mixed, mixed_amounts
from vexture.svg.between_paths import path_between
from vexture.svg.between_transforms import as_property, property_between, transforms_between
from vexture.svg.colors import Color, parse_color
from vexture.svg.font_values import TEXT_SIZES, font_weight
from vexture.svg.properties import PROPERTIES
from vexture.svg.transform import KEYWORDS as PLACES
from vexture.svg.values import fraction, number, words

__all__ = ["BY_HALF", "attribute_between", "composed", "value_between"]

SHOWN: Final = {"display": ("none", False), "visibility": ("visible", True)}
"""A word of properties that are not what they begin as for the whole way, and whether it is the one that lasts."""

MOVED: Final = frozenset({"rotate", "scale", "translate"})
FRACTIONS: Final = frozenset({"opacity", "fill-opacity", "stroke-opacity", "stop-opacity"})
SPACED: Final = frozenset({"letter-spacing", "word-spacing"})
BY_HALF: Final = frozenset({"clip-path", "d", "mask", "points", "stroke-dasharray", "transform"})
"""What jumps where two values are unlike."""

NAMES: Final = frozenset({"class", "font-family", "href", "id", "in", "in2", "result", "style"})
"""What always jumps: their numbers are none."""

REPLACED: Final = frozenset({*NAMES, *SHOWN, "d", "stroke-dasharray"})
"""What browsers do not add."""

STACKED: Final = frozenset({"box-shadow", "filter", "text-shadow"})
"""Lists of functions, of which `none` is one that changes nothing."""

WORDED: Final = re.compile(r"[^0-9(]*|[\"'].*|url\(.*", re.DOTALL | re.IGNORECASE)
MODERN: Final = re.compile(r"(?:ok)?l(?:ab|ch)\(|color(?:-mix)?\(", re.IGNORECASE)

MOST_DASHES: Final = 1_000
"""Lengths of dashes that are between two lists."""

Mix = Callable[[str, str, Way], str | None]
"""What makes a value of two; None where they have nothing in common."""


def value_between(name: str, first: str, second: str, part: float) -> str | None:
    """The value of a property at a part of the way from one to another; None if it jumps at half of it.

    Raise an `UnclearError` if it is not known.

    Examples
    --------
    >>> value_between("stroke-dasharray", "10", "20 5 10", 0.5), value_between("visibility", "hidden", "visible", 0.1)
    ('15.0 7.5 10', 'visible')
    >>> value_between("fill-rule", "nonzero", "evenodd", 0.6)
    """
    first, second = (text if name == "transform" else text.strip() for text in (first, second))
    if first == second:
        return first
    if name in SHOWN and 0.0 < part < 1.0:
        word, lasts = SHOWN[name]
        return first if (first.lower() == word) == lasts else second
    value = None if name in NAMES else MIXERS.get(name, plain)(first, second, Way(part))
    if value is None:
        jump(name, first, second)
        return None
    entry = PROPERTIES.get(name)
    if entry is None or entry.allows(value):
        return value
    if value.startswith("-") and entry.allows("0"):
        return "0"
    raise UnclearError


def attribute_between(name: str, first: str, second: str, part: float) -> str | None:
    """The value of an attribute at a part of the way from one to another, as `value_between`."""
    if first == second:
        return first
    value = None if name in NAMES else (path_between if name == "d" else mixed)(first, second, Way(part))
    if value is None:
        jump(name, first, second)
    return value


def jump(name: str, first: str, second: str) -> None:
    """Raise an `UnclearError` unless it is known that a value jumps from one to another."""
    worded = WORDED.fullmatch(first) or WORDED.fullmatch(second)
    if not (name in NAMES or name in BY_HALF or (worded and name not in STACKED)):
        raise UnclearError


def plain(first: str, second: str, way: Way) -> str | None:
    """A colour, or a value with numbers."""
    colors = parse_color(first), parse_color(second)
    if colors[0] is None or colors[1] is None:
        return mixed(first, second, way)
    if way.adds and (MODERN.match(first) or MODERN.match(second) or not all(isinstance(one, Color) for one in colors)):
        raise UnclearError
    if MODERN.match(first) or MODERN.match(second):
        return color_mix("oklab", first, second, way.part)
    if not (isinstance(colors[0], Color) and isinstance(colors[1], Color)):
        return color_mix("srgb", first, second, way.part)
    alpha = min(max(way.number(colors[0].alpha, colors[1].alpha), 0.0), 1.0)
    pairs = zip(colors[0].rgb, colors[1].rgb, strict=True)
    rgb = [way.number(a * colors[0].alpha, b * colors[1].alpha) / (alpha or 1.0) for a, b in pairs]
    return f"rgb({' '.join(f'{100.0 * min(max(value, 0.0), 1.0)!r}%' for value in rgb)} / {alpha!r})"


def dashes(first: str, second: str, way: Way) -> str | None:
    """Lengths of dashes: the shorter list is repeated."""
    lists = words(first), words(second)
    if "none" in (first.lower(), second.lower()) or not all(lists):
        return None
    count = lcm(*map(len, lists))
    if count > MOST_DASHES:
        raise UnclearError
    pairs = zip(*(listed * (count // len(listed)) for listed in lists), strict=True)
    made = [mixed_amounts(one, other, way) for one, other in pairs]
    if None in made:
        raise UnclearError
    return " ".join("0" if (text or "").startswith("-") else text or "" for text in made)


def fractions(first: str, second: str, way: Way) -> str | None:
    """Numbers, which may be percentages."""
    ends = fraction(first), fraction(second)
    return None if ends[0] is None or ends[1] is None else f"{min(max(way.number(ends[0], ends[1]), 0.0), 1.0)!r}"


def weights(first: str, second: str, way: Way) -> str | None:
    """Weights of fonts."""
    if {first.lower(), second.lower()} & {"bolder", "lighter"}:
        raise UnclearError
    return f"{min(max(way.number(font_weight(first), font_weight(second)), 1.0), 1000.0)!r}"


def sizes(first: str, second: str, way: Way) -> str | None:
    """Sizes of fonts."""
    if {first.lower(), second.lower()} & {"smaller", "larger"}:
        raise UnclearError
    ends = [f"{TEXT_SIZES[text.lower()]!r}px" if text.lower() in TEXT_SIZES else text for text in (first, second)]
    return mixed(ends[0], ends[1], way)


def spaces(first: str, second: str, way: Way) -> str | None:
    """Spaces between letters or words."""
    ends = ["0" if text.lower() == "normal" else text for text in (first, second)]
    return mixed(ends[0], ends[1], way)


def places(first: str, second: str, way: Way) -> str | None:
    """Points of a box."""
    return mixed(placed(first), placed(second), way)


def placed(text: str) -> str:
    """A point of a box as two lengths."""
    listed = words(text.lower())[:2]
    if not listed:
        raise UnclearError
    if len(listed) == 1:
        listed = ["center", *listed] if listed[0] in ("top", "bottom") else [*listed, "center"]
    if listed[0] in ("top", "bottom") or listed[1] in ("left", "right"):
        listed.reverse()
    return " ".join(PLACES.get(word, "0px" if number(word) == 0.0 else word) for word in listed)


def lists(first: str, second: str, way: Way) -> str | None:
    """Lists of transforms."""
    if not way.adds:
        return transforms_between(as_property(first), as_property(second), way.part)
    return " ".join(text for text in (as_property(first), second) if text != "none") or "none"


def moves(name: str) -> Mix:
    """Return the function of two values of a property that moves things."""
    return lambda first, second, way: property_between(name, first, second, way)


MIXERS: Final[dict[str, Mix]] = {
    **dict.fromkeys(FRACTIONS, fractions),
    **dict.fromkeys(SPACED, spaces),
    **{name: moves(name) for name in MOVED},
    "d": path_between,
    "font-size": sizes,
    "font-weight": weights,
    "stroke-dasharray": dashes,
    "transform": lists,
    "transform-origin": places,
}


def composed(name: str, under: str, value: str, how: str) -> str:
    """What a value of a property makes with the one under it; raises an `UnclearError` if it is not known.

    Examples
    --------
    >>> composed("transform", "translate(20px)", "rotate(30deg)", "add"), composed("x", "5px", "10px", "add")
    ('translate(20px) rotate(30deg)', '15.0px')
    """
    if how not in ("add", "accumulate") or name in REPLACED:
        return value
    if how == "accumulate" and name in (*MOVED, "transform"):
        raise UnclearError
    total = MIXERS.get(name, plain)(under, value, Way(1.0, adds=True))
    if total is None:
        jump(name, under, value)
    return value if total is None else total
