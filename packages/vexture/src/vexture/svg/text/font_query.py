"""The font query of a span, derived from its style (CSS Fonts 4)."""

import re
from dataclasses import dataclass
from typing import Final

from lxml import etree

from vexture.svg.document import language
from vexture.svg.font_values import font_weight
from vexture.svg.style import ElementStyle
from vexture.svg.values import number

GENERIC: Final = frozenset(
    {
        *("serif", "sans-serif", "monospace", "cursive", "fantasy", "system-ui", "emoji", "math", "fangsong"),
        *("ui-serif", "ui-sans-serif", "ui-monospace", "ui-rounded"),
    }
)
"""Family names that are not fonts."""

STRETCHES: Final = {
    "ultra-condensed": 50.0,
    "extra-condensed": 62.5,
    "condensed": 75.0,
    "semi-condensed": 87.5,
    "normal": 100.0,
    "semi-expanded": 112.5,
    "expanded": 125.0,
    "extra-expanded": 150.0,
    "ultra-expanded": 200.0,
}

VARIANTS: Final = {
    "small-caps": ("smcp",),
    "all-small-caps": ("smcp", "c2sc"),
    "petite-caps": ("pcap",),
    "all-petite-caps": ("pcap", "c2pc"),
    "unicase": ("unic",),
    "titling-caps": ("titl",),
    "sub": ("subs",),
    "super": ("sups",),
    "lining-nums": ("lnum",),
    "oldstyle-nums": ("onum",),
    "proportional-nums": ("pnum",),
    "tabular-nums": ("tnum",),
    "diagonal-fractions": ("frac",),
    "stacked-fractions": ("afrc",),
    "ordinal": ("ordn",),
    "slashed-zero": ("zero",),
    "common-ligatures": ("liga", "clig"),
    "no-common-ligatures": ("-liga", "-clig"),
    "discretionary-ligatures": ("dlig",),
    "historical-ligatures": ("hlig",),
    "no-contextual": ("-calt",),
    "none": ("-liga", "-clig", "-calt"),
}
"""OpenType features of each keyword of `font-variant` (CSS Fonts 4, 6)."""

SMALL: Final = "smcp"

SETTING = re.compile(r"\s*(['\"])([ -~]{4})\1\s*(on|off|[-+]?\d{0,6}(?:\.\d{1,6})?)\s*", re.IGNORECASE)
FAMILY = re.compile(r"\s*(?:\"([^\"]*)\"|'([^']*)'|([^,\"']+))\s*(?:,|$)")

LONGEST: Final = 2_000
"""Longest list that is read, in characters."""


@dataclass(frozen=True, slots=True)
class FontQuery:
    """The font that characters request; characters with equal queries are shaped together."""

    families: tuple[str, ...]
    weight: float
    style: str  # "normal", "italic" or "oblique"
    stretch: float  # percent
    size: float  # user units
    adjust: float | None  # x-height as a fraction of the font size
    features: tuple[str, ...]
    variations: tuple[tuple[str, float], ...]
    language: str | None
    synthesis: frozenset[str]  # of "weight", "style" and "small-caps"


def query_of(style: ElementStyle, element: etree._Element) -> FontQuery:
    """Return the font query of the characters of an element with a style."""
    return FontQuery(
        families(style["font-family"]),
        font_weight(style["font-weight"]),
        style["font-style"].split()[0].lower(),
        stretch(style["font-stretch"].lower()),
        style.font_size,
        None if style["font-size-adjust"].lower() == "none" else number(style["font-size-adjust"].split()[-1]),
        features(style),
        variations(style["font-variation-settings"]),
        language(element),
        frozenset(style["font-synthesis"].lower().split()),
    )


def families(text: str) -> tuple[str, ...]:
    """Return the family names in a list, with generic ones in lower case.

    Examples
    --------
    >>> families("'Noto Sans', Open  Sans, Serif")
    ('Noto Sans', 'Open Sans', 'serif')
    """
    found = []
    for double, single, plain in FAMILY.findall(text[:LONGEST]):
        name = double or single or " ".join(plain.split())
        if name:
            found.append(name.lower() if plain and name.lower() in GENERIC else name)
    return tuple(found)


def stretch(text: str) -> float:
    """Return the width in percent."""
    return STRETCHES.get(text) or number(text.rstrip("%")) or STRETCHES["normal"]


def features(style: ElementStyle) -> tuple[str, ...]:
    """Return the OpenType features that a style turns on, or, with a leading minus, off."""
    found: list[str] = []
    for name in ("", "-caps", "-ligatures", "-numeric", "-position"):
        for word in style[f"font-variant{name}"].lower().split():
            found += VARIANTS.get(word, ())
    if style["font-kerning"].lower() == "none":
        found.append("-kern")
    if float(style["letter-spacing"] if style["letter-spacing"] != "normal" else 0.0) != 0.0:
        found += VARIANTS["no-common-ligatures"]  # CSS Text 3, 8.2
    for _, tag, value in SETTING.findall(style["font-feature-settings"][:LONGEST]):
        count = {"on": "1", "": "1", "off": "0"}.get(value.lower(), value)
        if tag.isalnum() and count.isdecimal():
            found.append(f"{tag}={count}")
    return tuple(found)


def variations(text: str) -> tuple[tuple[str, float], ...]:
    """Return the values on the axes of a variable font."""
    found = {tag: number(value) for _, tag, value in SETTING.findall(text[:LONGEST])}
    return tuple(sorted((tag, value) for tag, value in found.items() if value is not None))
