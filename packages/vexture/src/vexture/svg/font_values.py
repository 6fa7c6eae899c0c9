"""Values of font properties that depend on the parent's, or that the shorthand sets (CSS Fonts 4, 2)."""

import re
from collections.abc import Iterator
from typing import Final

from vexture.svg.properties import KEYWORDS, PROPERTIES
from vexture.svg.values import Viewport, number

TEXT_SIZES: Final = {
    "xx-small": 9.0,
    "x-small": 10.0,
    "small": 13.0,
    "medium": 16.0,
    "large": 18.0,
    "x-large": 24.0,
    "xx-large": 32.0,
}
"""Size of each font-size keyword, in user units (CSS Fonts 4, 2.5)."""

SPACINGS: Final = ("letter-spacing", "word-spacing")
"""Inherited lengths that are relative to the font size of the element that sets them."""

SYSTEM_FONTS: Final = frozenset({"caption", "icon", "menu", "message-box", "small-caption", "status-bar"})
BEFORE_SIZE: Final = ("font-style", "font-variant", "font-weight", "font-stretch")
"""Parts of the shorthand before the size, in any order."""

FONT_LONGHANDS: Final = (*BEFORE_SIZE, "font-size", "font-family")
"""Properties that the shorthand sets."""

MOST_BEFORE: Final = 6
"""Most words before the size: four parts, of which the style may have an angle."""

PART = re.compile(r"\s*(\"[^\"]*\"|'[^']*'|[^\s/]+|/)")
LIGHTER_AND_BOLDER: Final = ((350.0, 100.0, 400.0), (550.0, 100.0, 700.0), (750.0, 400.0, 900.0), (900.0, 700.0, 900.0))
"""Values of lighter and bolder for weights below each limit (CSS Fonts 4, 2.2.1)."""


def text_size(text: str, parent: float, view: Viewport) -> float:
    """Return the font size in user units, from its value, the parent's size and the outermost viewport."""
    word = text.lower()
    if word in TEXT_SIZES:
        return TEXT_SIZES[word]
    if word in ("smaller", "larger"):
        return parent * (1.2 if word == "larger" else 1 / 1.2)
    return max(view.length(text, parent, parent) or 0.0, 0.0)


def font_weight(text: str, parent: str = "normal") -> float:
    """Return the weight, 1 to 1000, from its value and the parent's.

    Examples
    --------
    >>> font_weight("bolder", "normal"), font_weight("lighter", "650"), font_weight("bold")
    (700.0, 400.0, 700.0)
    """
    word = text.lower()
    if word in ("bolder", "lighter"):
        around = font_weight(parent)
        for limit, lighter, bolder in LIGHTER_AND_BOLDER:
            if around < limit or limit == LIGHTER_AND_BOLDER[-1][0]:
                found = bolder if word == "bolder" else lighter
                return max(around, found) if word == "bolder" else min(around, found)
    if word in ("normal", "bold"):
        return 400.0 if word == "normal" else 700.0
    return min(max(number(text) or 400.0, 1.0), 1000.0)


def in_pixels(spacing: str, font_size: float, view: Viewport) -> str:
    """Return a spacing as a length that does not depend on a font."""
    length = view.length(spacing, font_size, font_size)
    return "0" if length is None else repr(length)


def font_longhands(value: str) -> Iterator[tuple[str, str]]:
    """Yield the properties that the shorthand `font` sets; none if its value is not valid, or is a system font.

    Examples
    --------
    >>> [pair for pair in font_longhands("italic 12px/1.5 'Noto Sans', serif") if "normal" not in pair]
    [('font-style', 'italic'), ('font-size', '12px'), ('font-family', "'Noto Sans', serif")]
    """
    found = dict.fromkeys(BEFORE_SIZE, "normal")
    at = 0
    for _ in range(MOST_BEFORE):
        match = PART.match(value, at)
        if match is None or value.strip().lower() in SYSTEM_FONTS:
            return
        at = match.end()
        word = match[1]
        name = next((name for name in BEFORE_SIZE if word.lower() != "normal" and is_of(name, word)), None)
        if PROPERTIES["font-size"].accepts(word) and name is None:
            family = re.sub(r"^\s*/\s*\S+", "", value[at:]).strip()
            if family and {*KEYWORDS}.isdisjoint(part.strip().lower() for part in family.split(",")):
                yield from (*found.items(), ("font-size", word), ("font-family", family))
            return
        if name is not None:
            found[name] = word


def is_of(name: str, word: str) -> bool:
    """Return whether a word is a value of a property before the size."""
    if name == "font-variant":
        return word.lower() == "small-caps"
    if name == "font-stretch" and word.endswith("%"):
        return False
    if name == "font-weight" and word[:1].isdigit() and number(word) is None:
        return False
    return bool(PROPERTIES[name].accepts(word))
