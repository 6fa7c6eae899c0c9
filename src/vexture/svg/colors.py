"""Colours and paints: the text of `fill` or `stroke` becomes a flat colour or a reference to a paint server."""

import re
from functools import lru_cache
from typing import NamedTuple

import tinycss2.color4

__all__ = ["CONTEXT", "Color", "PaintText", "parse_color", "parse_paint"]

LONGEST = 200
"""Characters. A colour is never longer, and the cache must not keep long untrusted texts."""

REFERENCE = re.compile(r"url\(\s*(['\"]?)(.*?)\1\s*\)\s*(.*)", re.IGNORECASE | re.DOTALL)
CONTEXT = {"context-fill": "fill", "context-stroke": "stroke"}
"""Paints of the context element, and the properties that give them (SVG 2, 13.2)."""


class Color(NamedTuple):
    """An sRGB colour with opacity, each 0..1; `exact` is False if its colour space could not be converted."""

    rgb: tuple[float, float, float]
    alpha: float
    exact: bool = True


class PaintText(NamedTuple):
    """A paint as written."""

    reference: str | None  # paint server to use if possible
    color: Color | str | None  # None for no paint; "currentcolor" for the element's own colour; or of `CONTEXT`


@lru_cache(maxsize=512)
def read_color(text: str) -> Color | str | None:
    """Colour of a short text, see `parse_color`."""
    try:
        parsed = tinycss2.color4.parse_color(text)
    except (ValueError, TypeError, AttributeError, KeyError):  # tinycss2 fails on some malformed functions
        return None
    if parsed is None:
        return None
    if parsed == "currentcolor":
        return "currentcolor"
    if parsed.space == "hsl":  # its saturation and lightness are clamped before they are converted, as browsers do
        hue, *parts = parsed.coordinates
        parts = [min(max(part or 0.0, 0.0), 100.0) for part in parts]
        parsed = tinycss2.color4.Color("hsl", (hue, *parts), parsed.alpha)
    try:
        red, green, blue = (min(max(float(channel or 0), 0.0), 1.0) for channel in parsed.to("srgb").coordinates)
    except NotImplementedError:
        return Color((0.0, 0.0, 0.0), float(parsed.alpha), exact=False)
    return Color((red, green, blue), float(parsed.alpha))


def parse_color(text: str) -> Color | str | None:
    """A CSS colour (CSS Color 4), or "currentcolor"; None if the text is no colour.

    Examples
    --------
    >>> parse_color("#f00"), parse_color("currentColor"), parse_color("reddish")
    (Color(rgb=(1.0, 0.0, 0.0), alpha=1.0, exact=True), 'currentcolor', None)
    """
    return read_color(text.strip()) if len(text) <= LONGEST else None


def parse_paint(text: str) -> PaintText | None:
    """Value of `fill` or `stroke`; None if the text is no paint.

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
