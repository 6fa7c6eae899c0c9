"""Clips by basic shapes of CSS, converted to equivalent SVG elements (CSS Masking 1, 5.1; CSS Shapes 1, 3)."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, TypeAlias

from lxml import etree

from vexture.svg.transform import parse_origin
from vexture.svg.values import Viewport, words
from vexture.svg.viewport import Rectangle

FILLED, STROKED, VIEWED = "fill-box", "stroke-box", "view-box"

BOXES: Final = {
    **dict.fromkeys(("content-box", "padding-box", FILLED), FILLED),
    **dict.fromkeys(("border-box", "margin-box", STROKED), STROKED),
    VIEWED: VIEWED,
}
"""Reference boxes, with the box that each one means for SVG elements."""

RULE = r"\s*(?:(nonzero|evenodd)\s*,)?\s*"
POLYGON = re.compile(RULE + r"(.*)", re.IGNORECASE | re.DOTALL)
PATH = re.compile(RULE + r"(['\"])(.*)\2\s*", re.IGNORECASE | re.DOTALL)
SPACES, COMMA, SLASH = re.compile(r"\s+"), re.compile(","), re.compile("/")
ROUND = re.compile(r"\bround\b(?!\()")
SIDES_OF: Final = {1: (0, 0, 0), 2: (1, 0, 1), 3: (1, 2, 1), 4: (1, 2, 3)}
"""Indices of the second to fourth of four values, by the number of given values."""

AT = re.compile(r"\bat\b")
FAR = frozenset({"right", "bottom"})

Element: TypeAlias = tuple[str, dict[str, str]]
"""Name and attributes of an SVG shape."""


@dataclass(frozen=True, slots=True)
class ReferenceBox:
    """A reference box, with the context of lengths in it."""

    left: float
    top: float
    view: Viewport  # sides of the box
    font_size: float

    def along(self, text: str, axis: int) -> float | None:
        """Return a length across (0) or down (1); None if it is not valid."""
        return self.view.length(text, (self.view.width, self.view.height)[axis], self.font_size)

    def four(self, text: str, axes: tuple[int, int, int, int]) -> list[float] | None:
        """Expand one to four lengths to four, as for margins, each along its axis; None if they are not valid."""
        parts = words(text, SPACES)
        if not 1 <= len(parts) <= 4:
            return None
        parts = [parts[0], *(parts[k] for k in SIDES_OF[len(parts)])]
        return known([self.along(part, axis) for part, axis in zip(parts, axes, strict=True)])


def known(values: list[float | None]) -> list[float] | None:
    """Return the values if all are known, else None."""
    found = [value for value in values if value is not None]
    return found if len(found) == len(values) else None


def clip_element(
    value: str, box_of: Callable[[str], Rectangle | None], root_font_size: float, font_size: float
) -> etree._Element | None:
    """Return a `clipPath` in user units for a value of `clip-path`; None if its shape is not supported.

    `box_of` returns the reference box of a name, or None if nothing is to be clipped.

    Examples
    --------
    >>> clip = clip_element("circle(25% at left 10px) view-box", lambda name: (0.0, 0.0, 40.0, 40.0), 16.0, 16.0)
    >>> etree.tostring(clip)
    b'<clipPath><circle cx="0.0" cy="10.0" r="10.0"/></clipPath>'
    """
    head, opened, rest = value.partition("(")
    arguments, closed, tail = rest.rpartition(")")
    name = head.lower().split()[-1] if opened and head and not head[-1].isspace() else ""
    names = f"{head[: len(head) - len(name)]} {tail}".lower().split()
    make = MAKERS.get(name if closed else "", unknown) if opened else whole
    if make is unknown or len(names) > 1 or not {*names} <= BOXES.keys() or not (names or opened):
        return None  # saves measuring the element for its box
    left, top, width, height = box_of(BOXES[names[0]] if names else STROKED) or (0.0, 0.0, 0.0, 0.0)
    box = ReferenceBox(left, top, Viewport(width, height, root_font_size), font_size)
    found = make(arguments, box)
    if found is None:
        return None
    clip = etree.Element("clipPath")
    etree.SubElement(clip, found[0], found[1])
    return clip


def numeric_element(name: str, **values: float) -> Element:
    """Return an element with numeric attributes."""
    return name, {key: repr(float(value)) for key, value in values.items()}


def unknown(_: str, __: ReferenceBox) -> None:
    """Return None, for shapes that are not supported."""


def whole(_: str, box: ReferenceBox) -> Element | None:
    """Return the whole reference box."""
    return numeric_element("rect", x=box.left, y=box.top, width=box.view.width, height=box.view.height)


def position(text: str, box: ReferenceBox) -> tuple[float, float] | None:
    """Parse a position relative to a box's corner: one or two lengths or keywords, or two edges with distances."""
    parts = words(text, SPACES) or ["center"]
    if len(parts) != 4:
        return parse_origin(text or "center", box.along) if len(parts) < 3 else None
    found: list[float | None] = [None, None]
    for edge, distance in (parts[:2], parts[2:]):
        axis = 1 if edge in ("top", "bottom") else 0
        length = box.along(distance, axis)
        if length is None or edge not in ("top", "bottom", "left", "right"):
            return None
        found[axis] = (box.view.width, box.view.height)[axis] - length if edge in FAR else length
    x, y = found
    return None if x is None or y is None else (x, y)


def radii_and_centre(text: str, box: ReferenceBox, most: int) -> tuple[list[str], tuple[float, float]] | None:
    """Parse at most `most` radii of a circle or ellipse, and its centre relative to the corner of the box."""
    radii, *places = AT.split(text.lower())
    lengths = words(radii, SPACES)
    centre = position(places[0].strip(), box) if len(places) == 1 else position("", box)
    if centre is None or len(places) > 1 or len(lengths) not in (0, most) or (places and not places[0].strip()):
        return None
    return lengths or ["closest-side"] * most, centre


def radius(word: str, distances: tuple[float, ...], length: float | None) -> float | None:
    """Return a radius: the least or largest distance to a side, or a length, which must not be negative."""
    if word in ("closest-side", "farthest-side"):
        return (min if word == "closest-side" else max)(map(abs, distances))
    return None if length is None or length < 0.0 else length


def circle(text: str, box: ReferenceBox) -> Element | None:
    """Convert `circle()`."""
    found = radii_and_centre(text, box, 1)
    if found is None:
        return None
    (word,), (x, y) = found
    distances = (x, box.view.width - x, y, box.view.height - y)
    r = radius(word, distances, box.view.length(word, box.view.diagonal, box.font_size))
    return None if r is None else numeric_element("circle", cx=box.left + x, cy=box.top + y, r=r)


def ellipse(text: str, box: ReferenceBox) -> Element | None:
    """Convert `ellipse()`."""
    found = radii_and_centre(text, box, 2)
    if found is None:
        return None
    (across, down), (x, y) = found
    rx = radius(across, (x, box.view.width - x), box.along(across, 0))
    ry = radius(down, (y, box.view.height - y), box.along(down, 1))
    if rx is None or ry is None:
        return None
    return numeric_element("ellipse", cx=box.left + x, cy=box.top + y, rx=rx, ry=ry)


def inset(text: str, box: ReferenceBox) -> Element | None:
    """Convert `inset()`, which has distances from the sides."""
    sides, corners = split_at_round(text)
    found = box.four(sides, (1, 0, 1, 0))
    if found is None:
        return None
    top, right, bottom, left = found
    return rounded_rectangle((left, top, box.view.width - right, box.view.height - bottom), corners, box)


def rect(text: str, box: ReferenceBox) -> Element | None:
    """Convert `rect()`, which has positions of the sides from the top and the left."""
    sides, corners = split_at_round(text)
    parts = words(sides, SPACES)
    if len(parts) != 4:
        return None
    edges = ("0%", "100%", "100%", "0%")
    parts = [edge if part == "auto" else part for part, edge in zip(parts, edges, strict=True)]
    found = box.four(" ".join(parts), (1, 0, 1, 0))
    if found is None:
        return None
    top, right, bottom, left = found
    return rounded_rectangle((left, top, max(left, right), max(top, bottom)), corners, box)


def xywh(text: str, box: ReferenceBox) -> Element | None:
    """Convert `xywh()`, which has a corner and two sides."""
    sides, corners = split_at_round(text)
    found = box.four(sides, (0, 1, 0, 1)) if len(words(sides, SPACES)) == 4 else None
    if found is None or min(found[2:]) < 0.0:
        return None
    x, y, width, height = found
    return rounded_rectangle((x, y, x + width, y + height), corners, box)


def split_at_round(text: str) -> tuple[str, str]:
    """Split a text into the parts before and after "round"; without it, the radii are zero."""
    sides, *corners = ROUND.split(text.lower(), maxsplit=1)
    return sides, corners[0] if corners else "0"


def rounded_rectangle(edges: Rectangle, corners: str, box: ReferenceBox) -> Element | None:
    """Return a rectangle with the radii of a `border-radius`; its edges are relative to the corner of the box."""
    left, top, right, bottom = edges
    width, height = max(right - left, 0.0), max(bottom - top, 0.0)
    parts = words(corners, SLASH)
    if not 1 <= len(parts) <= 2:
        return None
    rx, ry = box.four(parts[0], (0, 0, 0, 0)), box.four(parts[-1], (1, 1, 1, 1))
    if rx is None or ry is None or min(*rx, *ry) < 0.0:
        return None
    left, top = box.left + left, box.top + top
    pairs = (width, rx[0] + rx[1]), (width, rx[2] + rx[3]), (height, ry[0] + ry[3]), (height, ry[1] + ry[2])
    factor = min([1.0, *(side / radii for side, radii in pairs if radii > 0.0)])
    rounds = [(factor * x, factor * y) if x > 0.0 and y > 0.0 else (0.0, 0.0) for x, y in zip(rx, ry, strict=True)]
    if width == 0.0 or height == 0.0 or len({*rounds}) == 1:
        x, y = rounds[0]
        return numeric_element("rect", x=left, y=top, width=width, height=height, rx=x, ry=y)
    right, bottom = left + width, top + height
    (ax, ay), (bx, by), (cx, cy), (dx, dy) = rounds
    data = (
        f"M{left + ax!r} {top!r}H{right - bx!r}A{bx!r} {by!r} 0 0 1 {right!r} {top + by!r}"
        f"V{bottom - cy!r}A{cx!r} {cy!r} 0 0 1 {right - cx!r} {bottom!r}"
        f"H{left + dx!r}A{dx!r} {dy!r} 0 0 1 {left!r} {bottom - dy!r}"
        f"V{top + ay!r}A{ax!r} {ay!r} 0 0 1 {left + ax!r} {top!r}Z"
    )
    return "path", {"d": data}


def polygon(text: str, box: ReferenceBox) -> Element | None:
    """Convert `polygon()`."""
    match = POLYGON.fullmatch(text)
    assert match is not None  # matches any text: the rule is optional
    corners = []
    for point in words(match[2].lower(), COMMA):
        parts = words(point, SPACES)
        found = known([box.along(part, axis) for axis, part in enumerate(parts)]) if len(parts) == 2 else None
        if found is None:
            return None
        corners.append(f"{box.left + found[0]!r},{box.top + found[1]!r}")
    if not corners:
        return None
    return "polygon", {"points": " ".join(corners), "clip-rule": (match[1] or "nonzero").lower()}


def path(text: str, box: ReferenceBox) -> Element | None:
    """Convert `path()`."""
    match = PATH.fullmatch(text)
    data = " ".join(match[3].split()) if match else ""
    if match is None or not (data.isascii() and data.isprintable()):  # CSS escapes can produce any character
        return None
    moved = f"translate({box.left!r} {box.top!r})"
    return "path", {"d": data, "clip-rule": (match[1] or "nonzero").lower(), "transform": moved}


MAKERS: Final[dict[str, Callable[[str, ReferenceBox], Element | None]]] = {
    "circle": circle,
    "ellipse": ellipse,
    "inset": inset,
    "rect": rect,
    "xywh": xywh,
    "polygon": polygon,
    "path": path,
}
