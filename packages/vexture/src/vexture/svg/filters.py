"""Filters of elements (Filter Effects 1): values of the property, and the names of filters in notes."""

import re
from collections import ChainMap
from typing import Final

import tinycss2
from lxml import etree

from vexture.svg.document import local_name
from vexture.svg.filter_functions import function_element
from vexture.svg.paint_servers import LINK, PaintServers
from vexture.svg.space import ElementPlace
from vexture.svg.values import number

HIDING: Final = ""
"""Name of a filter without steps, which hides its element."""

STEP: Final = re.compile(
    "fe(Blend|ColorMatrix|ComponentTransfer|Composite|ConvolveMatrix|DiffuseLighting|DisplacementMap|DropShadow|Flood"
    "|GaussianBlur|Image|Merge|Morphology|Offset|SpecularLighting|Tile|Turbulence)"
)
CAPITAL: Final = re.compile("(?<=[a-z])(?=[A-Z])")

MOST_STEPS: Final = 4
"""Most steps in the name of a filter."""


def filter_label(value: str, servers: PaintServers) -> str | None:
    """Return the name of a filter for a note: the value of the property, `HIDING`, or None if there is no filter.

    One missing filter makes the whole list of filters void (Filter Effects 1, 5).
    """
    lists: list[dict[str, None]] = []
    for token in tinycss2.parse_component_value_list(value, skip_comments=True):
        link = LINK.fullmatch(tinycss2.serialize([token]))
        if link is not None:
            target = servers.target(link[2])
            if target is None or local_name(target) != "filter":
                return None
            lists.append(steps_of(target))
        elif token.type == "function":
            lists.append({token.lower_name.replace("-", " "): None})
        elif token.type != "whitespace":
            return None
    return f"filter of {join_names([*ChainMap(*reversed(lists))])}" if all(lists) else HIDING


def filter_elements(value: str, servers: PaintServers, place: ElementPlace) -> list[etree._Element] | None:
    """Return the filter elements of a list of filters; functions become equivalent elements without a parent.

    Return None if a function is not valid.
    """
    found: list[etree._Element] = []
    for token in tinycss2.parse_component_value_list(value, skip_comments=True):
        if token.type == "whitespace":
            continue
        link = LINK.fullmatch(tinycss2.serialize([token]))
        element = servers.target(link[2]) if link is not None else function_element(token, place)
        if element is None:
            return None
        found.append(element)
    return found


def steps_of(element: etree._Element) -> dict[str, None]:
    """Return the distinct names of a filter's steps; none if its region is empty."""
    sides = (number(element.get(name, "1").strip().removesuffix("%")) for name in ("width", "height"))
    if any(side is not None and side <= 0.0 for side in sides):
        return {}
    names = [name for child in element if (name := local_name(child)) is not None and STEP.fullmatch(name)]
    return {CAPITAL.sub(" ", name[2:]).lower().removeprefix("gaussian "): None for name in names}


def join_names(names: list[str]) -> str:
    """Join names as in a sentence.

    Examples
    --------
    >>> join_names(["flood", "offset", "blend"])
    'flood, offset and blend'
    """
    names = [*names[:MOST_STEPS], "more"] if len(names) > MOST_STEPS else names
    return " and ".join(filter(None, [", ".join(names[:-1]), names[-1]]))
