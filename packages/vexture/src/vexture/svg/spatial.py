"""Spatial transforms by CSS properties, projected vertically onto the plane (CSS Transforms 1 and 2)."""

from collections.abc import Mapping
from math import cos, isfinite, sin, sqrt
from typing import Final

import numpy as np
import tinycss2
from numpy.typing import NDArray

from vexture.drawing.calculation import parse_tokens
from vexture.svg.transform import Identity, Length, Transform, angle, parse_transform, single_transform
from vexture.svg.values import number, words

TRANSFORMS: Final = ("translate", "rotate", "scale", "transform")
"""Properties that move an element, in the order of their effect (CSS Transforms 2, 6)."""

AXES: Final = {"": (0.0, 0.0, 1.0), "x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
"""Axes by name; without a name, rotation is in the plane."""

Spatial = NDArray[np.float64]
"""A map of space in homogeneous coordinates, (4, 4)."""


class Attribute(str):
    """Text of an attribute, with lengths and angles without units and the functions of SVG 1.1."""

    __slots__ = ()


def element_transform(values: Mapping[str, str], length: Length) -> tuple[Transform, list[str], bool]:
    """Return the transform by an element's properties, the invalid properties, and whether there is a perspective.

    A perspective is left out, as in browsers for the elements of a drawing.
    """
    names = [name for name in TRANSFORMS if name in values]
    invalid, product = list[str](), None
    for name in names:
        one: Transform | Spatial | None
        if isinstance(text := values[name], Attribute):
            one = parse_transform(text, length)
            if one is not None and len(names) == 1:
                return one, [], False
        else:
            one = property_transform(name, text, length)
        if one is None:
            invalid.append(name)
        else:
            matrix = to_space(one) if isinstance(one, Transform) else one
            product = matrix if product is None else np.einsum("ij,jk->ik", product, matrix)
    flat, deep = (Identity, False) if product is None else to_plane(about_depth(product, values, length))
    return flat, invalid, deep


def about_depth(matrix: Spatial, values: Mapping[str, str], length: Length) -> Spatial:
    """Apply the third part of `transform-origin` to a map; the other two can be applied in the plane."""
    parts = words(values.get("transform-origin", ""))
    depth = length(parts[2], 0) if len(parts) == 3 else None
    return (
        np.einsum("ij,jk,kl->il", translation(0.0, 0.0, depth), matrix, translation(0.0, 0.0, -depth))
        if depth
        else matrix
    )


def property_transform(name: str, text: str, length: Length) -> Spatial | None:
    """Return the transform by the property `translate`, `rotate` or `scale` (CSS Transforms 2, 5), or `transform`.

    Return None if the value is not valid.

    Examples
    --------
    >>> to_plane(property_transform("scale", "200% 3", lambda text, axis: number(text)))[0].transformPoint((1, 1))
    (2.0, 3.0)
    """
    if name == "transform":
        return css_transform(text, length)
    parts = words(text.lower())
    if parts == ["none"]:
        return np.eye(4)
    if name == "rotate":
        return parse_rotation(parts)
    if name == "translate":
        return function("translate3d" if len(parts) == 3 else name, parts, length)
    return function("scale3d" if len(parts) == 3 else name, parts, length)


def css_transform(text: str, length: Length) -> Spatial | None:
    """Multiply the functions in a value of `transform`; None if it is not valid.

    Examples
    --------
    >>> value = "translate3d(1px, 0, 7px) rotateX(180deg) scale(50%)"
    >>> to_plane(css_transform(value, lambda text, axis: number(text.removesuffix("px"))))[0].transformPoint((2, 2))
    (2.0, -1.0)
    """
    if text.strip().lower() in ("", "none"):
        return np.eye(4)
    product: Spatial = np.eye(4)
    tokens = parse_tokens(text.strip())
    if not tokens:
        return None
    for token in tokens:
        if token.type == "whitespace":
            continue
        if token.type != "function":
            return None
        arguments = "".join(map(text_of, token.arguments)).split(";")
        one = function(token.lower_name, [part.strip() for part in arguments], length)
        if one is None:
            return None
        product = np.einsum("ij,jk->ik", product, one)
    return product


def text_of(token: object) -> str:
    """Return the text of an argument; a comma becomes a semicolon."""
    return ";" if token == "," else str(tinycss2.serialize([token]))


def function(name: str, arguments: list[str], length: Length) -> Spatial | None:
    """Return the map of one function in a list; None if it is unknown or has wrong arguments."""
    bare = [number(text) for text in arguments]
    values: list[float | None] = [factor(text) for text in arguments]
    if name.startswith("translate"):
        values = [length(text, 1 if name == "translatey" else axis % 2) for axis, text in enumerate(arguments)]
    elif name.startswith(("rotate", "skew")):
        values = [*values[:-1], angle(arguments[-1])] if name == "rotate3d" else [angle(text) for text in arguments]
        bare = bare[-1:] if name == "rotate3d" else bare
    elif name == "perspective":
        values = [0.0 if text.lower() == "none" else length(text, 0) for text in arguments]
    else:
        bare = []
    if None in values or any(bare):  # nonzero lengths and angles need units
        return None
    return of_values(name, [value for value in values if value is not None])


def of_values(name: str, values: list[float]) -> Spatial | None:
    """Return the map of one function, with lengths in user units and angles in radians."""
    match name, values:
        case "translate3d", [x, y, z]:
            return translation(x, y, z)
        case "translatez", [z]:
            return translation(0.0, 0.0, z)
        case "scale3d", [x, y, z]:
            return np.diag([x, y, z, 1.0])
        case "scalez", [z]:
            return np.diag([1.0, 1.0, z, 1.0])
        case "rotatex" | "rotatey" | "rotatez", [turn]:
            return rotation(*AXES[name[-1]], turn)
        case "rotate3d", [x, y, z, turn]:
            return rotation(x, y, z, turn)
        case "matrix3d", [*parts] if len(parts) == 16:
            return np.array(parts).reshape(4, 4).T
        case "perspective", [depth]:
            matrix = np.eye(4)
            matrix[3, 2] = -1.0 / max(depth, 1.0) if depth else 0.0
            return matrix
        case "rotate", [_, _, *_]:  # form of SVG 1.1
            return None
    texts = [f"{value!r}rad" if name.startswith(("rotate", "skew")) else repr(value) for value in values]
    flat = single_transform(name, texts, lambda text, axis: number(text))
    return None if flat is None else to_space(flat)


def factor(text: str) -> float | None:
    """Parse a number or percentage; None if the text is neither."""
    value = number(text.removesuffix("%"))
    return value / 100.0 if value is not None and text.endswith("%") else value


def translation(x: float, y: float, z: float) -> Spatial:
    """Return the map of a translation."""
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def to_space(flat: Transform) -> Spatial:
    """Extend a map of the plane to space."""
    a, b, c, d, e, f = flat
    return np.array([[a, c, 0.0, e], [b, d, 0.0, f], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]])


def to_plane(matrix: Spatial) -> tuple[Transform, bool]:
    """Project a map of space onto the plane; also return whether it has a perspective."""
    (a, c, _, e), (b, d, _, f), _, last = matrix.tolist()
    return Transform(a, b, c, d, e, f), (last[0], last[1], last[3]) != (0.0, 0.0, 1.0)


def parse_rotation(parts: list[str]) -> Spatial | None:
    """Parse a rotation whose angle is before or after its axis."""
    if not parts:
        return None
    is_first = len(parts) > 1 and parts[0] not in AXES and number(parts[0]) is None
    axis, text = (parts[1:], parts[0]) if is_first else (parts[:-1], parts[-1])
    turn = None if number(text) else angle(text)
    numbers = AXES.get(" ".join(axis)) or [*map(number, axis)]
    match numbers:
        case [float(x), float(y), float(z)] if turn is not None:
            return rotation(x, y, z, turn)
    return None


def rotation(x: float, y: float, z: float, turn: float) -> Spatial:
    """Return a rotation about an axis through the origin by Rodrigues' formula; the identity for a zero axis."""
    matrix = np.eye(4)
    length = sqrt(x * x + y * y + z * z)
    if length == 0.0 or not isfinite(length):
        return matrix
    x, y, z = x / length, y / length, z / length
    rest, up, c = 1.0 - cos(turn), sin(turn), cos(turn)
    matrix[:3, :3] = (
        (c + rest * x * x, rest * x * y - up * z, rest * x * z + up * y),
        (rest * x * y + up * z, c + rest * y * y, rest * y * z - up * x),
        (rest * x * z - up * y, rest * y * z + up * x, c + rest * z * z),
    )
    return matrix
