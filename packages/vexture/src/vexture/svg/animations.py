"""Animations, which are not run: a drawing shows its static state.

Content that stays hidden until an animation shows it, such as a logo that fades in, is drawn as the animation shows it.
Animations are elements (SVG Animations 2) or keyframes of style sheets (CSS Animations 1).
"""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, Final, TypeAlias

import tinycss2
from lxml import etree

from vexture.drawing.colors import Color, parse_color
from vexture.svg.document import applies, local_name
from vexture.svg.links import Links, reference
from vexture.svg.path_data import NUMBER

ANIMATIONS: Final = frozenset({"animate", "animateColor", "animateMotion", "animateTransform", "discard", "set"})
"""Elements that animate another one."""

KEYFRAMES: Final = frozenset({"keyframes", "-webkit-keyframes"})
"""Names of the at-rule that defines an animation."""

Values: TypeAlias = dict[str, list[str]]
"""Values that an animation gives to each property, in order."""

FIRST_NUMBER: Final = re.compile(NUMBER)
STARTS_BY_ITSELF: Final = re.compile(rf"\s*(?:{NUMBER}|[^;]+\.(?:begin|end|repeat)\b)")
"""Begin of an animation at a time or at an event of another animation; events of a user never happen in a picture."""

OFFSET: Final = re.compile(r"from|to|(\d+(?:\.\d*)?|\.\d+)%", re.ASCII)
"""Offset of a keyframe, a percentage of the duration."""

NO_SIZE: Final = re.compile(r"scale[xy3d]*\(\s*[+-]?0*\.?0*\s*[,)]", re.IGNORECASE)
"""Transform that reduces everything to a point or a line."""


def first_number(text: str) -> float:
    """Return the size of the first number in a value; 0 if there is none."""
    match = FIRST_NUMBER.search(text)
    return abs(float(match[0])) if match else 0.0


def is_zero(text: str) -> bool:
    """Return whether a value is a number or a length of zero."""
    return FIRST_NUMBER.match(text) is not None and first_number(text) == 0.0


def is_clear(text: str) -> bool:
    """Return whether a paint shows nothing."""
    color = parse_color(text)
    return text.lower() == "none" or (isinstance(color, Color) and color.alpha == 0.0)


HIDES: Final[dict[str, Callable[[str], bool]]] = {
    **dict.fromkeys(("opacity", "fill-opacity", "stroke-opacity", "stop-opacity"), is_zero),
    **dict.fromkeys(("r", "rx", "ry", "width", "height", "stroke-width", "font-size", "scale"), is_zero),
    **dict.fromkeys(("fill", "stroke"), is_clear),
    "display": lambda text: text.lower() == "none",
    "visibility": lambda text: text.lower() in ("hidden", "collapse"),
    "stroke-dasharray": is_zero,
    "transform": lambda text: NO_SIZE.search(text) is not None,
}
"""Predicate for each property: True if its value hides an element."""


def visible_value(name: str, base: str, values: Iterable[str], dashes: str = "none") -> str | None:
    """Return the value of an animation that shows an element which the base value hides, or None if there is none.

    It is the largest number, or else the last value. `dashes` is the ``stroke-dasharray`` to which an offset refers.

    Examples
    --------
    >>> visible_value("opacity", "0", ["0", "0.8", "0.5"]), visible_value("opacity", "0.1", ["1"])
    ('0.8', None)
    >>> visible_value("stroke-dashoffset", "100", ["100", "0"], dashes="100")
    '0'
    """
    if name == "stroke-dashoffset":
        shift = first_number(base)
        is_hidden = dashes.lower() != "none" and 0.0 < first_number(dashes) <= shift
        nearest = min(values, key=first_number, default=base)
        return nearest if is_hidden and first_number(nearest) < shift else None
    hides = HIDES.get(name)
    if hides is None or not hides(base):
        return None
    visible = [value for value in values if not hides(value)]
    return max(reversed(visible), key=first_number, default=None) if hides is is_zero else next(reversed(visible), None)


def values_by_element(root: etree._Element) -> dict[etree._Element, Values]:
    """Collect the values that animation elements give to the properties of each element of a document."""
    links, found = Links(root), dict[etree._Element, Values]()
    for element in root.iter("{*}animate", "{*}animateColor", "{*}set"):
        begins = element.get("begin", "0").split(";")
        if not applies(element) or not any(STARTS_BY_ITSELF.match(begin) for begin in begins):
            continue
        link = reference(element)
        target = element.getparent() if link is None else links.target(link)
        if target is not None:
            name = element.get("attributeName", "").strip()
            found.setdefault(target, {}).setdefault(name, []).extend(values_of(element))
    return found


def values_of(element: etree._Element) -> Iterator[str]:
    """Yield the values of an animation element."""
    listed = element.get("values") if local_name(element) != "set" else None
    texts = [element.get("from", ""), element.get("to", "")] if listed is None else listed.split(";")
    yield from filter(None, map(str.strip, texts))


def read_keyframes(rule: Any, read: Callable[[Any], Iterable[tuple[str, str, bool]]]) -> tuple[str, Values]:
    """Read the name of a rule and its values; `read` yields the declarations of a block."""
    found: Values = {}
    for frame in tinycss2.parse_rule_list(rule.content or [], skip_comments=True, skip_whitespace=True):
        if frame.type == "qualified-rule" and is_offset(tinycss2.serialize(frame.prelude)):
            for name, value, important in read(frame.content):
                if not important:  # keyframes ignore important declarations
                    found.setdefault(name, []).append(value)
    return tinycss2.serialize(rule.prelude).strip().strip("\"'"), found


def is_offset(selector: str) -> bool:
    """Return whether the selector of a frame names a time of the animation."""
    for word in map(str.strip, selector.lower().split(",")):
        match = OFFSET.fullmatch(word)
        if match is not None and (match[1] is None or float(match[1]) <= 100.0):
            return True
    return False


def names_in(text: str, known: Mapping[str, Values]) -> list[str]:
    """List the animations that a value of ``animation`` or ``animation-name`` refers to.

    Examples
    --------
    >>> names_in("2s spin infinite, 'fade' 1s both", {"fade": {}, "spin": {}})
    ['spin', 'fade']
    """
    return list(dict.fromkeys(word for each in re.split(r"[\s,]+", text) if (word := each.strip("\"'")) in known))
