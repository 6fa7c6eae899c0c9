"""Colours, and what can be restyled, as JSON (FORMAT.md, B.5 and D.10)."""

import math
import reprlib
import sys
from itertools import chain, pairwise
from typing import Any, Final

import numpy as np

from vexture.base.errors import FormatError, LimitError, SourceError, format_count
from vexture.drawing.group import Blend, Group, Mask
from vexture.drawing.paint import Paint
from vexture.texture.walk import REMEDY
from vexture.tree.planar.style import PlanarStyle, round_colours

BLENDS: Final = {blend.name.lower().replace("_", "-"): blend for blend in Blend}
"""Blend modes by their names in CSS."""

MASKS: Final = {mask.name.lower(): mask for mask in Mask}
"""Kinds of masks; the first is none."""

NAMES: Final = {blend: name for name, blend in BLENDS.items()}


def short(number: float) -> float:
    """A number as JSON writes it shortest: integers without a point, except -0.0, which keeps its sign."""
    value = float(number)
    whole = value.is_integer() and abs(value) < 2.0**53 and (value != 0.0 or math.copysign(1.0, value) > 0.0)
    return int(value) if whole else value


def paint_as_json(paint: Paint) -> dict[str, Any]:
    """A flat colour."""
    return {"color": [*map(short, paint.color)], "opacity": short(paint.opacity)}


def style_as_json(style: PlanarStyle) -> dict[str, Any]:
    """Describe in JSON what can be restyled in a planar map."""
    listed = zip(style.names, style.rgba.tolist(), style.group.tolist(), style.hides.tolist(), strict=True)
    elements = [
        {"name": name, "color": [*map(short, rgba[:3])]}
        | ({"opacity": short(rgba[3])} if rgba[3] != 1.0 else {})
        | ({"group": group} if group >= 0 else {})
        | ({"hides": True} if hides else {})
        for name, rgba, group, hides in listed
    ]
    groups = [
        {"outer": group.outer, "opacity": short(group.opacity), "blend": NAMES[group.blend]}
        | ({"mask": group.mask.name.lower()} if group.mask else {})
        for group in style.groups
    ]
    members, ends = style.members.tolist(), style.starts.tolist()
    stacks = [members[start:end] for start, end in pairwise(ends)]
    return {"elements": elements, "groups": groups, "stacks": stacks}


def read_style(value: Any, label: str) -> PlanarStyle:
    """A style from JSON; a `FormatError` if it contradicts FORMAT.md."""
    if not isinstance(value, dict):
        raise FormatError(f"{label}: style is {line(value)}; it must be an object; {REMEDY}")
    elements = [_read_element(entry, label) for entry in _list(value.get("elements"), f"{label}: elements")]
    groups = [_read_group(entry, label) for entry in _list(value.get("groups"), f"{label}: groups")]
    stacks = [_list(entry, f"{label}: a stack") for entry in _list(value.get("stacks"), f"{label}: stacks")]
    members = list(chain.from_iterable(stacks))
    if not all(type(number) is int and 0 <= number < len(elements) for number in members):
        raise FormatError(f"{label}: a stack names none of {format_count(len(elements), 'element')}; {REMEDY}")
    names, rgba, group, hides = zip(*elements, strict=True) if elements else ((), (), (), ())
    style = PlanarStyle(
        names,
        round_colours(rgba),
        np.array(group, np.int64),
        np.array(hides, np.bool_),
        tuple(groups),
        np.append(0, np.cumsum([len(stack) for stack in stacks], dtype=np.int64)),
        np.array(members, np.int32),
    )
    try:
        style.check_groups()
    except (LimitError, SourceError) as error:
        raise FormatError(f"{label}: {line(error)}; {REMEDY}") from None
    return style


def _read_element(entry: Any, label: str) -> tuple[str, tuple[float, ...], int, bool]:
    """Name, colour and opacity, group, and whether it hides something."""
    if not isinstance(entry, dict) or not isinstance(entry.get("name"), str):
        raise FormatError(f"{label}: an element is {line(entry)}; it must be an object with a name; {REMEDY}")
    group, hides = entry.get("group", -1), entry.get("hides", False)
    if type(group) is not int or not -1 <= group < 1 << 31 or type(hides) is not bool:
        raise FormatError(f"{label}: an element is {line(entry)}; its group is a number, hides is a truth; {REMEDY}")
    paint = read_paint(entry, label)
    return entry["name"], (*paint.color, paint.opacity), group, hides


def _read_group(entry: Any, label: str) -> Group:
    if not isinstance(entry, dict) or type(entry.get("outer")) is not int or entry.get("blend") not in NAMES.values():
        raise FormatError(f"{label}: a group is {line(entry)}; it must be an object with outer and blend; {REMEDY}")
    (opacity,) = numbers([entry.get("opacity")], 1, f"{label}: opacity")
    if not 0.0 <= opacity <= 1.0:
        raise FormatError(f"{label}: a group has opacity {opacity:g}; it must be in 0..1; {REMEDY}")
    kind = entry.get("mask", Mask.NONE.name.lower())
    if kind not in [*MASKS] or (MASKS[kind] and entry["outer"] < 0):
        raise FormatError(f"{label}: a group is {line(entry)}; its mask is not one of {', '.join(MASKS)}; {REMEDY}")
    return Group(entry["outer"], opacity, BLENDS[entry["blend"]], MASKS[kind])


def _list(value: Any, label: str) -> list[Any]:
    if not isinstance(value, list):
        raise FormatError(f"{label} is {line(value)}; it must be a list; {REMEDY}")
    return value


def read_paint(paint: Any, label: str) -> Paint:
    """A flat colour from JSON; a `FormatError` if it is none."""
    if not isinstance(paint, dict):
        raise FormatError(f"{label}: paint is {line(paint)}; it must be an object; {REMEDY}")
    red, green, blue = numbers(paint.get("color"), 3, f"{label}: color")
    (opacity,) = numbers([paint.get("opacity", 1)], 1, f"{label}: opacity")
    if not all(0.0 <= part <= 1.0 for part in (red, green, blue, opacity)):
        raise FormatError(f"{label}: paint is {line(paint)}; its numbers must be in 0..1; {REMEDY}")
    return Paint((red, green, blue), opacity)


def numbers(values: Any, count: int, label: str) -> list[float]:
    """The finite numbers of a list of `count`."""
    fits = isinstance(values, list) and len(values) == count
    if fits and all(type(value) in (int, float) and abs(value) <= sys.float_info.max for value in values):
        return [float(value) for value in values]
    kind = "finite number" + ("s" if count > 1 else "")
    raise FormatError(f"{label} is {line(values)}; it must be {count} {kind}; {REMEDY}")


def line(value: Any) -> str:
    """An untrusted value, or an error, as one short line."""
    text = str(value) if isinstance(value, Exception) else reprlib.repr(value)
    return " ".join(text.split())[:60].encode(errors="backslashreplace").decode()
