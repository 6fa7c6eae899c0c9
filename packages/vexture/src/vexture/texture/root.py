"""A shape of a packed texture, and the JSON of all shapes in the texture's file (FORMAT.md, B.5 and D.10)."""

import json
import math
import reprlib
import sys
import zlib
from dataclasses import dataclass, field, replace
from itertools import chain, pairwise
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import FormatError, LimitError, SourceError, format_count
from vexture.base.layout import MOST_STYLE_BYTES, TEXT_ROOTS, TEXT_STYLES
from vexture.drawing.drawing import IDENTITY
from vexture.drawing.group import Blend, Group, Mask
from vexture.drawing.paint import Paint
from vexture.texture.ktx2 import inflate
from vexture.texture.walk import REMEDY
from vexture.tree.planar.style import PlanarStyle, round_colours

WORTH: Final = 200
"""Bytes of styles from which they are deflated: shorter styles would grow."""

LENGTH_BYTES: Final = 4
"""Size of the length of the text, which precedes deflated styles."""


@dataclass(frozen=True, slots=True, eq=False)
class Root:
    """One shape of a packed texture.

    Parameters
    ----------
    name : str
        Name of the shape within its texture.
    quad : int
        Index of the texel of its root quad; a shader needs nothing else to draw a silhouette.
    to_source : (2, 3) float64 array
        Affine map from the unit square to the units of the source.
    tolerance : float
        Largest distance between the drawing's outline and the texture's before quantisation, in unit-square units.
    crs : str or None
        Coordinate reference system of the source units, if any.
    paint : Paint or None
        The colour, if the shape is one layer of a drawing; None for a silhouette.
    is_map : bool
        True if the shape is a planar map: a whole drawing in its colours.
    style : Style or None
        The elements of a planar map that can be recoloured and picked by a point.

    Examples
    --------
    >>> root = Root("lake", to_source=np.array([[200.0, 0.0, 5000.0], [0.0, 200.0, 7000.0]]), crs="EPSG:28992")
    >>> root.to_source @ (0.5, 0.5, 1.0)
    array([5100., 7100.])
    """

    name: str
    quad: int = 0
    to_source: NDArray[np.float64] = field(default_factory=IDENTITY.copy)
    tolerance: float = 0.0
    crs: str | None = None
    paint: Paint | None = None
    is_map: bool = False
    style: PlanarStyle | None = None


def roots_text(roots: tuple[Root, ...]) -> str:
    """Write a texture's roots as JSON (FORMAT.md, B.5): compact, and byte-identical for equal roots.

    Raises a `LimitError` if a number is not finite.
    """
    try:
        return _compact([_as_json(root) for root in roots])
    except ValueError:
        raise LimitError("a root's transform, tolerance or paint is not finite; scale the drawing down") from None


def deflated_texts(roots: tuple[Root, ...]) -> dict[str, str | bytes]:
    """Key/value texts of a texture's roots; long styles are deflated under a key of their own.

    Raises a `LimitError` if a number is not finite, or the styles are too long.
    """
    if any(root.style is not None for root in roots):
        styles = _compact([None if root.style is None else style_as_json(root.style) for root in roots]).encode()
        if len(styles) > MOST_STYLE_BYTES:
            raise LimitError(
                f"{len(styles)} bytes say what can be restyled; the limit is {MOST_STYLE_BYTES}; use several textures"
            )
        if len(styles) >= WORTH:
            packed = len(styles).to_bytes(LENGTH_BYTES, "little") + zlib.compress(styles)
            return {TEXT_ROOTS: roots_text(tuple(replace(root, style=None) for root in roots)), TEXT_STYLES: packed}
    return {TEXT_ROOTS: roots_text(roots)}


def _compact(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return text.encode(errors="backslashreplace").decode()  # a lone surrogate becomes its JSON escape


def _as_json(root: Root) -> dict[str, Any]:
    entry = {
        "name": root.name,
        "quad": int(root.quad),
        "transform": [short(number) for number in root.to_source.flat],
        "tolerance": short(root.tolerance),
    }
    if root.is_map:
        entry["map"] = True
    if root.style is not None:
        entry["style"] = style_as_json(root.style)
    if root.crs is not None:
        entry["crs"] = root.crs
    if root.paint is not None:
        entry["paint"] = paint_as_json(root.paint)
    return entry


def read_roots(text: str, styles: bytes | None = None) -> tuple[Root, ...]:
    """Parse roots from their JSON text, and their styles if these are deflated; ignore unknown members.

    Raises a `FormatError` if the text contradicts FORMAT.md.
    """
    entries = _json(text, TEXT_ROOTS)
    if not isinstance(entries, list) or not entries:
        raise FormatError(f"{TEXT_ROOTS} is {line(text)}; it must be a list of at least one root; {REMEDY}")
    if styles is not None:
        listed = _json(_text(styles), TEXT_STYLES)
        if not isinstance(listed, list) or len(listed) != len(entries):
            raise FormatError(f"{TEXT_STYLES} is no list of one style for each of {len(entries)} roots; {REMEDY}")
        entries = [
            entry | {"style": style} if isinstance(entry, dict) else entry
            for entry, style in zip(entries, listed, strict=True)
        ]
    return tuple(_read_root(entry, place) for place, entry in enumerate(entries))


def _text(styles: bytes) -> str:
    """Inflate the text of styles."""
    length = int.from_bytes(styles[:LENGTH_BYTES], "little")
    if not 0 < length <= MOST_STYLE_BYTES or len(styles) <= LENGTH_BYTES:
        raise FormatError(f"{TEXT_STYLES} says that it has {length} bytes; the limit is {MOST_STYLE_BYTES}; {REMEDY}")
    raw = inflate(styles[LENGTH_BYTES:], length, "styles")
    if len(raw) != length:
        raise FormatError(f"{TEXT_STYLES} has {len(raw)} bytes and says {length}; {REMEDY}")
    return raw.decode(errors="replace")


def _json(text: str, label: str) -> Any:
    try:
        return json.loads(text, parse_constant=_refuse_constant)
    except (ValueError, RecursionError) as error:
        raise FormatError(f"{label} is not JSON ({line(error)}); {REMEDY}") from None


def _read_root(entry: Any, place: int) -> Root:
    if not isinstance(entry, dict):
        raise FormatError(f"root {place} is {line(entry)}; it must be an object; {REMEDY}")
    name, quad, crs, is_map = entry.get("name"), entry.get("quad"), entry.get("crs"), entry.get("map", False)
    if not isinstance(name, str):
        raise FormatError(f"root {place} has the name {line(name)}; it must be a text; {REMEDY}")
    if type(quad) is not int or not 0 <= quad < 1 << 32:
        raise FormatError(f"root {place} has the quad {line(quad)}; it must be an index of a texel; {REMEDY}")
    if type(is_map) is not bool:
        raise FormatError(f"root {place}: map is {line(is_map)}; it must be true or false; {REMEDY}")
    if crs is not None and not isinstance(crs, str):
        raise FormatError(f"root {place} has the crs {line(crs)}; it must be a text; {REMEDY}")
    transform = numbers(entry.get("transform"), 6, f"root {place}: transform")
    (tolerance,) = numbers([entry.get("tolerance", 0)], 1, f"root {place}: tolerance")
    if tolerance < 0.0:
        raise FormatError(f"root {place}: tolerance is {tolerance:g}; it must be at least 0; {REMEDY}")
    paint = None if entry.get("paint") is None else read_paint(entry["paint"], f"root {place}")
    style = None if entry.get("style") is None else read_style(entry["style"], f"root {place}")
    if style is not None and not is_map:
        raise FormatError(f"root {place} has a style and is no map; {REMEDY}")
    return Root(name, quad, np.array(transform).reshape(2, 3), tolerance, crs, paint, is_map, style)


def _refuse_constant(name: str) -> float:
    raise ValueError(f"{name} is no number of JSON")


BLENDS: Final = {blend.name.lower().replace("_", "-"): blend for blend in Blend}
"""Blend modes by their names in CSS."""

MASKS: Final = {mask.name.lower(): mask for mask in Mask}
"""Kinds of masks by their names; the first is no mask."""

NAMES: Final = {blend: name for name, blend in BLENDS.items()}


def short(number: float) -> float:
    """Convert a number to the shortest in JSON: integers without a point, except -0.0, which keeps its sign."""
    value = float(number)
    whole = value.is_integer() and abs(value) < 2.0**53 and (value != 0.0 or math.copysign(1.0, value) > 0.0)
    return int(value) if whole else value


def paint_as_json(paint: Paint) -> dict[str, Any]:
    """Describe a flat colour in JSON."""
    return {"color": [*map(short, paint.color)], "opacity": short(paint.opacity)}


def style_as_json(style: PlanarStyle) -> dict[str, Any]:
    """Describe in JSON the style of a planar map: its elements, groups and stacks."""
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
    """Parse a style from JSON; raise a `FormatError` if it contradicts FORMAT.md."""
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
    """Parse an element: name, colour and opacity, group, and whether it hides something."""
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
    """Parse a flat colour from JSON; raise a `FormatError` if it is not one."""
    if not isinstance(paint, dict):
        raise FormatError(f"{label}: paint is {line(paint)}; it must be an object; {REMEDY}")
    red, green, blue = numbers(paint.get("color"), 3, f"{label}: color")
    (opacity,) = numbers([paint.get("opacity", 1)], 1, f"{label}: opacity")
    if not all(0.0 <= part <= 1.0 for part in (red, green, blue, opacity)):
        raise FormatError(f"{label}: paint is {line(paint)}; its numbers must be in 0..1; {REMEDY}")
    return Paint((red, green, blue), opacity)


def numbers(values: Any, count: int, label: str) -> list[float]:
    """Return a list of `count` finite numbers as floats; raise a `FormatError` if it is not one."""
    fits = isinstance(values, list) and len(values) == count
    if fits and all(type(value) in (int, float) and abs(value) <= sys.float_info.max for value in values):
        return [float(value) for value in values]
    kind = "finite number" + ("s" if count > 1 else "")
    raise FormatError(f"{label} is {line(values)}; it must be {count} {kind}; {REMEDY}")


def line(value: Any) -> str:
    """Format an untrusted value, or an error, as one short line."""
    text = str(value) if isinstance(value, Exception) else reprlib.repr(value)
    return " ".join(text.split())[:60].encode(errors="backslashreplace").decode()
