"""Filter functions of CSS, converted to equivalent filter elements (Filter Effects 1, 13)."""

from math import degrees
from typing import Any, Final

import tinycss2
from lxml import etree

from vexture.drawing.colors import parse_color
from vexture.svg.filter_colors import Colors, weighted_matrix
from vexture.svg.space import ElementPlace
from vexture.svg.transform import angle
from vexture.svg.values import number

SRGB: Final = {"color-interpolation-filters": "sRGB"}

LIMITED: Final = frozenset({"grayscale", "invert", "opacity", "sepia"})
"""Functions whose amount is at most 1."""

AMOUNTS: Final = LIMITED | {"brightness", "contrast", "saturate"}


def function_element(token: Any, place: ElementPlace) -> etree._Element | None:
    """Return the filter element of a function at a place, without a parent; None if it is not valid."""
    if token.type != "function":
        return None
    parts = [part for part in token.arguments if part.type not in ("whitespace", "comment")]
    texts = [tinycss2.serialize([part]) for part in parts]
    name = token.lower_name
    element = etree.Element("filter", SRGB)
    if name == "blur":
        deviation = length_of(texts[0], place) if texts else 0.0
        if deviation is None or deviation < 0.0 or len(texts) > 1:
            return None
        etree.SubElement(element, "feGaussianBlur", {"stdDeviation": repr(deviation)})
        return element
    if name == "drop-shadow":
        return shadow_element(element, texts, place)
    if name == "hue-rotate":
        turn = 0.0 if not texts or texts == ["0"] else angle_of(texts)
        if turn is None:
            return None
        etree.SubElement(element, "feColorMatrix", {"type": "hueRotate", "values": repr(degrees(turn))})
        return element
    if name not in AMOUNTS or len(texts) > 1:
        return None
    amount = amount_of(texts[0]) if texts else 1.0
    if amount is None or amount < 0.0:
        return None
    add_amount(element, name, min(amount, 1.0) if name in LIMITED else amount)
    return element


def shadow_element(element: etree._Element, texts: list[str], place: ElementPlace) -> etree._Element | None:
    """Return the filter element of a drop shadow; None if it is not valid."""
    colors = [text for text in texts if parse_color(text) is not None]
    lengths = [length_of(text, place) for text in texts if text not in colors]
    if len(colors) > 1 or not 2 <= len(lengths) <= 3 or (colors and texts.index(colors[0]) not in (0, len(lengths))):
        return None
    known = [length for length in lengths if length is not None]
    if len(known) < len(lengths) or (len(known) == 3 and known[2] < 0.0):
        return None
    dx, dy, deviation = [*known, 0.0][:3]
    element.set("color", place.style["color"])
    etree.SubElement(
        element,
        "feDropShadow",
        {
            "dx": repr(dx),
            "dy": repr(dy),
            "stdDeviation": repr(deviation),
            "flood-color": colors[0] if colors else "currentcolor",
        },
    )
    return element


def add_amount(element: etree._Element, name: str, amount: float) -> None:
    """Add the step of a function with an amount."""
    if name in ("grayscale", "sepia"):
        add_matrix(element, weighted_matrix(name, 1.0 - amount))
    elif name == "saturate":
        etree.SubElement(element, "feColorMatrix", {"type": "saturate", "values": repr(amount)})
    else:
        transfer = etree.SubElement(element, "feComponentTransfer")
        for channel in "A" if name == "opacity" else "RGB":
            slope, intercept = {
                "brightness": (amount, 0.0),
                "contrast": (amount, 0.5 - 0.5 * amount),
                "invert": (1.0 - 2.0 * amount, amount),
                "opacity": (amount, 0.0),
            }[name]
            values = {"type": "linear", "slope": repr(slope), "intercept": repr(intercept)}
            etree.SubElement(transfer, f"feFunc{channel}", values)


def add_matrix(element: etree._Element, matrix: Colors) -> None:
    """Add a step with a matrix of colours."""
    etree.SubElement(element, "feColorMatrix", {"values": " ".join(map(repr, matrix.ravel().tolist()))})


def length_of(text: str, place: ElementPlace) -> float | None:
    """Return a length in user units; None if it is not valid. Percentages are not, and only 0 has no unit."""
    if text.endswith("%") or number(text):
        return None
    return place.viewport.length(text, 0.0, place.style.font_size)


def angle_of(texts: list[str]) -> float | None:
    """Return an angle in radians; None if it is not valid."""
    return angle(texts[0]) if len(texts) == 1 and number(texts[0]) is None else None


def amount_of(text: str) -> float | None:
    """Return a number or percentage; None if it is not valid."""
    value = number(text.removesuffix("%"))
    return value / 100.0 if value is not None and text.endswith("%") else value
