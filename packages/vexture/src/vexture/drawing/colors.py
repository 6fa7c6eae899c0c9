"""Colours and paints: parse `fill` and `stroke` into flat colours or references to paint servers."""

import re
from functools import lru_cache
from typing import Any, Final, NamedTuple

import tinycss2
import tinycss2.color4

LONGEST = 400
"""Longest colour in characters. Real colours are shorter, and the cache must not keep long untrusted texts."""

REFERENCE = re.compile(r"url\(\s*(['\"]?)(.*?)\1\s*\)\s*(.*)", re.IGNORECASE | re.DOTALL)
CONTEXT = {"context-fill": "fill", "context-stroke": "stroke"}
"""Paints taken from the context element, and the properties that they come from (SVG 2, 13.2)."""


class Color(NamedTuple):
    """An sRGB colour with opacity, each 0..1."""

    rgb: tuple[float, float, float]
    alpha: float


CURRENT: Final = "currentcolor"

WHITE, BLACK = Color((1.0, 1.0, 1.0), 1.0), Color((0.0, 0.0, 0.0), 1.0)
GREY = Color((239 / 255, 239 / 255, 239 / 255), 1.0)
DIMMED = Color((128 / 255, 128 / 255, 128 / 255), 1.0)

SYSTEM: Final = {
    "accentcolor": Color((0.0, 117 / 255, 1.0), 1.0),
    "activetext": Color((1.0, 0.0, 0.0), 1.0),
    "graytext": DIMMED,
    "highlight": Color((0.0, 65 / 255, 198 / 255), 0.8),
    "inactivecaptiontext": DIMMED,
    "linktext": Color((0.0, 0.0, 238 / 255), 1.0),
    "mark": Color((1.0, 1.0, 0.0), 1.0),
    "selecteditem": Color((25 / 255, 103 / 255, 210 / 255), 1.0),
    "visitedtext": Color((85 / 255, 26 / 255, 139 / 255), 1.0),
    **dict.fromkeys(("buttonface", "buttonhighlight", "buttonshadow", "threedface"), GREY),
    **dict.fromkeys(("accentcolortext", "canvas", "field", "highlighttext", "selecteditemtext"), WHITE),
    **dict.fromkeys(("activecaption", "appworkspace", "background", "inactivecaption", "infobackground"), WHITE),
    **dict.fromkeys(("menu", "scrollbar", "window"), WHITE),
    **dict.fromkeys(("buttonborder", "buttontext", "canvastext", "fieldtext", "marktext", "activeborder"), BLACK),
    **dict.fromkeys(("captiontext", "inactiveborder", "infotext", "menutext", "windowframe", "windowtext"), BLACK),
    **dict.fromkeys(("threeddarkshadow", "threedhighlight", "threedlightshadow", "threedshadow"), BLACK),
}
"""System colours (CSS Color 4, 6.2 and A), as Chromium defines them for light pages."""


class PaintText(NamedTuple):
    """The value of `fill` or `stroke`."""

    reference: str | None  # paint server to use if possible
    color: Color | str | None  # None: no paint; str: depends on the element's own colour, or a key of `CONTEXT`


@lru_cache(maxsize=512)
def read_color(text: str, current: Color | None) -> Color | str | None:
    """Parse a short text as `parse_color` does."""
    try:
        token = tinycss2.parse_one_component_value(text, skip_comments=True)
        parsed = tinycss2.color4.parse_color(token)
    except (ValueError, TypeError, AttributeError, KeyError):  # tinycss2 fails on some malformed functions
        return None
    if parsed == CURRENT:
        return CURRENT if current is None else current
    if parsed is None and token.type == "ident":
        return SYSTEM.get(token.lower_value)
    if parsed is None or parsed.space not in ("srgb", "hsl", "hwb"):
        return None if token.type != "function" else read_function(token, text, current)
    if token.type == "function" and parsed.space == "hsl" and not is_hsl(token):
        return None
    if parsed.space == "hsl":  # browsers clamp saturation and lightness before the conversion
        hue, *parts = parsed.coordinates
        parts = [min(max(part or 0.0, 0.0), 100.0) for part in parts]
        parsed = tinycss2.color4.Color("hsl", (hue, *parts), parsed.alpha)
    red, green, blue = parsed.to("srgb").coordinates
    return clip_color(red, green, blue, parsed.alpha)


def read_function(token: Any, text: str, current: Color | None) -> Color | str | None:
    """Return the colour of a function outside sRGB or with calculations; its text if `currentcolor` is unknown."""
    from vexture.drawing.color_functions import color_of_function  # late: few drawings have such colours

    own = current or Color((0.0, 0.0, 0.0), 1.0)
    found = color_of_function(token, (*own.rgb, own.alpha))
    if found is None:
        return None
    return text if current is None and CURRENT in text.lower() else clip_color(*found)


def is_hsl(token: Any) -> bool:
    """Return whether `hsl()` is valid: in the comma syntax, saturation and lightness must be percentages."""
    parts = [part for part in token.arguments if part.type not in ("whitespace", "comment")]
    return "," not in parts or all(part.type == "percentage" for part in parts[2:5:2])


def clip_color(red: float | None, green: float | None, blue: float | None, alpha: float) -> Color:
    """Return a colour whose channels are clamped to the range of sRGB, as in browsers."""
    first, second, third = (min(max(float(channel or 0.0), 0.0), 1.0) for channel in (red, green, blue))
    return Color((first, second, third), float(alpha))


def parse_color(text: str, current: Color | None = None) -> Color | str | None:
    """Parse a CSS colour (CSS Color 5) for a light page; return None if the text is not a colour.

    `current` is the element's own colour, `currentcolor`. Without it, a colour that depends on it is returned as text.

    Examples
    --------
    >>> parse_color("#f00"), parse_color("currentColor"), parse_color("reddish")
    (Color(rgb=(1.0, 0.0, 0.0), alpha=1.0), 'currentcolor', None)
    >>> [round(255 * part) for part in parse_color("oklch(70% 0.2 150)").rgb]
    [0, 191, 84]
    """
    return read_color(text.strip(), current) if len(text) <= LONGEST else None


def parse_paint(text: str) -> PaintText | None:
    """Parse the value of `fill` or `stroke`; return None if the text is not a paint.

    Examples
    --------
    >>> parse_paint("none")
    PaintText(reference=None, color=None)
    >>> parse_paint("url(#sky) currentColor")
    PaintText(reference='#sky', color='currentcolor')
    """
    text = text.strip()
    if text.lower() == "none":
        return PaintText(None, None)
    if text.lower() in CONTEXT:
        return PaintText(None, text.lower())
    if match := REFERENCE.fullmatch(text):
        fallback = match[3]
        return PaintText(match[2], parse_color(fallback) if fallback and fallback.lower() != "none" else None)
    color = parse_color(text.partition(" icc-color")[0])
    return None if color is None else PaintText(None, color)
