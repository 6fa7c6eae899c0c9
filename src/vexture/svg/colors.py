"""Colours and paint: `fill` and `stroke` as text become a flat colour, or a reference to a paint server."""

import re
from functools import lru_cache
from typing import NamedTuple

import tinycss2.color4

__all__ = ["Color", "PaintText", "is_color", "is_paint", "parse_color", "parse_paint"]

LONGEST = 200
"""Characters. A colour is never longer; the cache must not keep a hostile file's text."""

REFERENCE = re.compile(r"url\(\s*(['\"]?)(.*?)\1\s*\)\s*(.*)", re.IGNORECASE | re.DOTALL)
CONTEXT = ("context-fill", "context-stroke")


class Color(NamedTuple):
    """An sRGB colour with opacity, each 0..1; `exact` is False if its colour space could not be converted."""

    rgb: tuple[float, float, float]
    alpha: float
    exact: bool = True


class PaintText(NamedTuple):
    """A paint as written: what to paint with, and the reference to try first, if there is one.

    `color` is None for no paint and "currentcolor" where the element's own colour is meant.
    """

    reference: str | None
    color: Color | str | None


@lru_cache(maxsize=512)
def read_color(text: str) -> Color | str | None:
    """Colour of a short text: a `Color`, "currentcolor", or None if it is no colour."""
    try:
        parsed = tinycss2.color4.parse_color(text)
    except (ValueError, TypeError, AttributeError, KeyError):  # tinycss2 trips over some malformed functions
        return None
    if parsed is None:
        return None
    if parsed == "currentcolor":
        return "currentcolor"
    try:
        red, green, blue = (min(max(float(channel or 0), 0.0), 1.0) for channel in parsed.to("srgb").coordinates)
    except NotImplementedError:
        return Color((0.0, 0.0, 0.0), float(parsed.alpha), exact=False)
    return Color((red, green, blue), float(parsed.alpha))


def parse_color(text: str) -> Color | str | None:
    """Read a CSS colour (CSS Color 4).

    Returns
    -------
    Color, "currentcolor", or None
        None if the text is no colour.

    Examples
    --------
    >>> parse_color("#f00"), parse_color("currentColor"), parse_color("reddish")
    (Color(rgb=(1.0, 0.0, 0.0), alpha=1.0, exact=True), 'currentcolor', None)
    """
    return read_color(text.strip()) if len(text) <= LONGEST else None


def parse_paint(text: str) -> PaintText | None:
    """Read the value of `fill` or `stroke`; None if it is no paint.

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
        return PaintText(text.lower(), None)
    if match := REFERENCE.fullmatch(text):
        fallback = match[3]
        return PaintText(match[2], parse_color(fallback) if fallback and fallback.lower() != "none" else None)
    color = parse_color(text.partition(" icc-color")[0])
    return None if color is None else PaintText(None, color)


def is_color(text: str) -> bool:
    """Tell whether the text is a colour."""
    return parse_color(text) is not None


def is_paint(text: str) -> bool:
    """Tell whether the text is a paint."""
    return parse_paint(text) is not None
