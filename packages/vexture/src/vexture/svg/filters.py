"""Filters (Filter Effects 1), which notes list but which are not drawn.

A blur has no outline, and most filters blur: as smooth paints they would be steps or meshes of colours, not a sharp
drawing. So a shape is drawn without its filter, sharp, and a note names the steps of the filter.
"""

import re
from collections import ChainMap
from typing import Final

import tinycss2
from lxml import etree

from vexture.svg.document import local_name
from vexture.svg.paint_servers import LINK, PaintServers
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
