"""The properties that decide what an SVG paints: initial value, inheritance, and which values are valid.

Geometry (`x`, `r`, `d` ...) is a property like the others in SVG 2, so one table answers for both.
"""

import re
from collections.abc import Callable
from typing import NamedTuple

from vexture.svg.colors import is_color, is_paint
from vexture.svg.path_data import NUMBER

__all__ = ["CSS_ONLY", "PROPERTIES", "Property"]


class Property(NamedTuple):
    """What the cascade must know of a property."""

    initial: str
    inherited: bool
    accepts: Callable[[str], object]


def anything(value: str) -> bool:
    """Accept every value; whoever uses it finds out."""
    return True


def one_of(*words: str) -> Callable[[str], object]:
    """Accept the words, in any case."""
    allowed = frozenset(words)
    return lambda value: value.lower() in allowed


def matching(pattern: str) -> Callable[[str], object]:
    """Accept what a regular expression matches."""
    return re.compile(rf"\s*(?:{pattern})\s*", re.IGNORECASE).fullmatch


UNIT = r"(?:px|pt|pc|in|cm|mm|q|em|ex|ch|rem|%)?"
POSITIVE = rf"(?!-){NUMBER}"
LENGTH = f"{NUMBER}{UNIT}"
SIZE = f"{POSITIVE}{UNIT}"
OPACITY = f"{NUMBER}%?"

FONT_SIZES = "(?:xx?-)?(?:small|large)|medium|smaller|larger"

PROPERTIES: dict[str, Property] = {
    "color": Property("black", True, is_color),
    "fill": Property("black", True, is_paint),
    "fill-opacity": Property("1", True, matching(OPACITY)),
    "fill-rule": Property("nonzero", True, one_of("nonzero", "evenodd")),
    "font-size": Property("medium", True, matching(rf"{SIZE}|{FONT_SIZES}")),
    "marker-end": Property("none", True, anything),
    "marker-mid": Property("none", True, anything),
    "marker-start": Property("none", True, anything),
    "paint-order": Property("normal", True, anything),
    "stroke": Property("none", True, is_paint),
    "stroke-dasharray": Property("none", True, matching(rf"none|{SIZE}(?:(?:\s*,\s*|\s+){SIZE})*+")),
    "stroke-dashoffset": Property("0", True, matching(LENGTH)),
    "stroke-linecap": Property("butt", True, one_of("butt", "round", "square")),
    "stroke-linejoin": Property("miter", True, one_of("miter", "round", "bevel", "miter-clip", "arcs")),
    "stroke-miterlimit": Property("4", True, matching(POSITIVE)),
    "stroke-opacity": Property("1", True, matching(OPACITY)),
    "stroke-width": Property("1", True, matching(SIZE)),
    "visibility": Property("visible", True, one_of("visible", "hidden", "collapse")),
    "clip-path": Property("none", False, anything),
    "cx": Property("0", False, matching(LENGTH)),
    "cy": Property("0", False, matching(LENGTH)),
    "d": Property("none", False, anything),
    "display": Property("inline", False, anything),
    "filter": Property("none", False, anything),
    "height": Property("auto", False, matching(f"auto|{SIZE}")),
    "mask": Property("none", False, anything),
    "opacity": Property("1", False, matching(OPACITY)),
    "overflow": Property("hidden", False, one_of("visible", "hidden", "scroll", "auto", "clip")),
    "r": Property("0", False, matching(SIZE)),
    "rotate": Property("none", False, anything),
    "rx": Property("auto", False, matching(f"auto|{SIZE}")),
    "ry": Property("auto", False, matching(f"auto|{SIZE}")),
    "scale": Property("none", False, anything),
    "stop-color": Property("black", False, is_color),
    "stop-opacity": Property("1", False, matching(OPACITY)),
    "transform": Property("none", False, anything),
    "transform-box": Property(
        "view-box", False, one_of("view-box", "fill-box", "stroke-box", "content-box", "border-box")
    ),
    "transform-origin": Property("0 0", False, anything),
    "translate": Property("none", False, anything),
    "vector-effect": Property("none", False, anything),
    "width": Property("auto", False, matching(f"auto|{SIZE}")),
    "x": Property("0", False, matching(LENGTH)),
    "y": Property("0", False, matching(LENGTH)),
}

CSS_ONLY = frozenset({"rotate", "scale", "translate"})
"""Attributes of these names mean something else."""
