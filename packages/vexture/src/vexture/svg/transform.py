"""Affine maps, and transforms in the syntax of attributes (CSS Transforms 1, 8)."""

import re
from collections.abc import Callable
from math import pi, radians, sqrt, tan
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.calculation import ANGLE, calculate
from vexture.svg.path_data import GAP, NUMBER, SPACE
from vexture.svg.values import number, words

if TYPE_CHECKING:

    class Transform(NamedTuple):
        """FontTools' map (x, y) -> (xx x + yx y + dx, xy x + yy y + dy), with the types that fontTools lacks."""

        xx: float = 1.0
        xy: float = 0.0
        yx: float = 0.0
        yy: float = 1.0
        dx: float = 0.0
        dy: float = 0.0

        def transform(self, other: "Transform") -> "Transform":
            """Return the map that applies the other map first."""

        def inverse(self) -> "Transform":
            """Return the inverse map."""

        def translate(self, x: float = 0.0, y: float = 0.0) -> "Transform":
            """Return the map that translates first."""

        def scale(self, x: float = 1.0, y: float | None = None) -> "Transform":
            """Return the map that scales first."""

        def rotate(self, angle: float) -> "Transform":
            """Return the map that rotates first, by radians."""

    Identity: Transform
else:
    from fontTools.misc.transform import Identity, Transform

TURN = {"": pi / 180, "deg": pi / 180, "grad": pi / 200, "rad": 1.0, "turn": 2 * pi}
"""Radians of each unit of angle; in attributes, degrees have no unit."""

KEYWORDS: Final = {"left": "0%", "top": "0%", "center": "50%", "right": "100%", "bottom": "100%"}

ARGUMENT = re.compile(NUMBER)
FUNCTION = re.compile(rf"{GAP}([a-zA-Z]++){SPACE}\({SPACE}({NUMBER}(?:{GAP}{NUMBER})*+){SPACE}\){SPACE}")
"""Pattern of a function in an attribute, where arguments have no units."""
WRITTEN_ANGLE = re.compile(rf"({NUMBER})([a-zA-Z]*)")

Length = Callable[[str, int], float | None]
"""Function that converts a length along x (0) or y (1) to user units; it returns None if the text is not a length."""


def angle(text: str) -> float | None:
    """Parse an angle into radians; None if the text is not an angle."""
    match = WRITTEN_ANGLE.fullmatch(text)
    found = calculate(text, lambda value, unit: None) if match is None else None
    if found is not None:
        return radians(found.value) if found.kind == ANGLE else None
    unit = TURN.get(match[2].lower()) if match else None
    value = number(match[1]) if match else None
    return None if value is None or unit is None else value * unit


def parse_transform(text: str, length: Length) -> Transform | None:
    """Multiply a list of transforms, the value of an attribute; None if the list is not valid.

    Examples
    --------
    >>> move = parse_transform("translate(10) scale(2, 3)", lambda text, axis: number(text))
    >>> move.transformPoint((1, 1))
    (12.0, 3.0)
    """
    if text.strip().lower() in ("", "none"):
        return Identity
    product, at = Identity, 0
    while at < len(text):
        match = FUNCTION.match(text, at)
        if match is None:
            return None
        one = single_transform(match[1].lower(), ARGUMENT.findall(match[2]), length)
        if one is None:
            return None
        product = product.transform(one)
        at = match.end()
    return product


def single_transform(name: str, arguments: list[str], length: Length) -> Transform | None:
    """Return the map of one function in a transform list; None if it is unknown or has wrong arguments."""
    values: list[float | None]
    if name.startswith("translate"):
        values = [length(text, 1 if name == "translatey" else min(axis, 1)) for axis, text in enumerate(arguments)]
    elif name.startswith("skew") or (name == "rotate" and len(arguments) == 1):
        values = [angle(text) for text in arguments]
    else:
        values = [number(text) for text in arguments]
    match name, values:
        case "matrix", [float(a), float(b), float(c), float(d), float(e), float(f)]:
            return Transform(a, b, c, d, e, f)
        case "translate" | "translatex", [float(x)]:
            return Identity.translate(x, 0.0)
        case "translate", [float(x), float(y)]:
            return Identity.translate(x, y)
        case "translatey", [float(y)]:
            return Identity.translate(0.0, y)
        case "scale", [float(x)]:
            return Identity.scale(x, x)
        case "scale", [float(x), float(y)]:
            return Identity.scale(x, y)
        case "scalex", [float(x)]:
            return Identity.scale(x, 1.0)
        case "scaley", [float(y)]:
            return Identity.scale(1.0, y)
        case "rotate", [float(turn)]:
            return Identity.rotate(turn)
        case "rotate", [float(degrees), float(x), float(y)]:
            return Identity.translate(x, y).rotate(radians(degrees)).translate(-x, -y)
        case "skew" | "skewx", [float(x)]:
            return Transform(1.0, 0.0, tan(x), 1.0, 0.0, 0.0)
        case "skew", [float(x), float(y)]:
            return Transform(1.0, tan(y), tan(x), 1.0, 0.0, 0.0)
        case "skewy", [float(y)]:
            return Transform(1.0, tan(y), 0.0, 1.0, 0.0, 0.0)
    return None


def parse_origin(text: str, length: Length) -> tuple[float, float] | None:
    """Parse `transform-origin` into a point (CSS Transforms 1, 5); None if it is not valid.

    Examples
    --------
    >>> parse_origin("right 3", lambda text, axis: {"100%": 10.0, "3": 3.0}[text])
    (10.0, 3.0)
    """
    parts = words(text.lower())[:2]
    if len(parts) == 1:
        parts = ["center", parts[0]] if parts[0] in ("top", "bottom") else [parts[0], "center"]
    if len(parts) != 2:
        return None
    if parts[0] in ("top", "bottom") or parts[1] in ("left", "right"):
        parts.reverse()
    x, y = (length(KEYWORDS.get(part, part), axis) for axis, part in enumerate(parts))
    return None if x is None or y is None else (x, y)


def about_origin(matrix: Transform, text: str, length: Length) -> Transform:
    """Apply a transform about the point in `transform-origin`; ignore a value that is not valid.

    Examples
    --------
    >>> about_origin(Identity.scale(2.0), "3 0", lambda text, axis: float(text)).transformPoint((4, 1))
    (5.0, 2.0)
    """
    x, y = parse_origin(text, length) or (0.0, 0.0)
    return Identity.translate(x, y).transform(matrix).translate(-x, -y) if x or y else matrix


def map_points(cubics: NDArray[np.float64], matrix: Transform) -> NDArray[np.float64]:
    """Apply an affine map to points (..., 2).

    A matrix product may round equal points at different positions of an array differently, hence the explicit sums.
    """
    x, y = cubics[..., 0], cubics[..., 1]
    a, b, c, d, e, f = matrix
    return np.stack([a * x + c * y + e, b * x + d * y + f], axis=-1)


def scale_of(matrix: Transform) -> float:
    """Return the largest factor by which a map stretches a length (its larger singular value).

    Examples
    --------
    >>> scale_of(Identity.rotate(radians(30)).scale(2, 5))
    5.0
    """
    a, b, c, d = matrix[:4]
    x, y = a * a + b * b, c * c + d * d
    return sqrt((x + y + sqrt((x - y) ** 2 + 4.0 * (a * c + b * d) ** 2)) / 2.0)
