"""Affine maps, and transforms by the attribute's grammar and by the CSS properties', read as one (CSS Transforms 2)."""

import re
from collections.abc import Callable
from math import cos, pi, radians, sin, sqrt, tan
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.svg.path_data import GAP, NUMBER, SPACE
from vexture.svg.values import number

__all__ = [
    "KEYWORDS",
    "Identity",
    "Transform",
    "about_origin",
    "angle",
    "mapped",
    "parse_origin",
    "parse_transform",
    "property_transform",
    "scale_of",
]

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
            """Apply the other map first."""

        def inverse(self) -> "Transform":
            """Inverse map."""

        def translate(self, x: float = 0.0, y: float = 0.0) -> "Transform":
            """Translate first."""

        def scale(self, x: float = 1.0, y: float | None = None) -> "Transform":
            """Scale first."""

        def rotate(self, angle: float) -> "Transform":
            """Rotate first, by radians."""

    Identity: Transform
else:
    from fontTools.misc.transform import Identity, Transform

TURN = {"": pi / 180, "deg": pi / 180, "grad": pi / 200, "rad": 1.0, "turn": 2 * pi}
"""Radians of each unit of angle; in attributes, degrees have no unit."""

KEYWORDS: Final = {"left": "0%", "top": "0%", "center": "50%", "right": "100%", "bottom": "100%"}

AXES: Final = {"": (0.0, 0.0, 1.0), "x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
"""Axes by their names; without one, things turn in the plane."""

WITH_UNIT = rf"{NUMBER}(?:[a-zA-Z]++|%)?+"
ARGUMENT = re.compile(WITH_UNIT)
FUNCTION = re.compile(rf"{GAP}([a-zA-Z]++){SPACE}\({SPACE}({WITH_UNIT}(?:{GAP}{WITH_UNIT})*+){SPACE}\){SPACE}")
ANGLE = re.compile(rf"({NUMBER})([a-zA-Z]*)")

Length = Callable[[str, int], float | None]
"""Converts the text of a length along x (0) or y (1) into user units; None if it is no length."""


def angle(text: str) -> float | None:
    """Angle in radians; None if the text is no angle."""
    match = ANGLE.fullmatch(text)
    unit = TURN.get(match[2].lower()) if match else None
    value = number(match[1]) if match else None
    return None if value is None or unit is None else value * unit


def parse_transform(text: str, length: Length) -> Transform | None:
    """Product of a list of transforms, an attribute's or a CSS property's value; None if the list is not valid.

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
    """One function of a transform list; None if it is unknown or has wrong arguments."""
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


def property_transform(name: str, text: str, length: Length) -> Transform | None:
    """Transform by the property `translate`, `rotate` or `scale` (CSS Transforms 2, 5), or `transform`.

    None if the value is not valid. What leaves the plane is seen straight from above: there is no perspective.

    Examples
    --------
    >>> property_transform("scale", "200% 3", lambda text, axis: number(text)).transformPoint((1, 1))
    (2.0, 3.0)
    """
    if name == "transform":
        return parse_transform(text, length)
    words = text.lower().split()
    if words == ["none"]:
        return Identity
    if name == "rotate":
        return turned(words)
    values = [length(word, min(axis, 1)) if name == "translate" else factor(word) for axis, word in enumerate(words)]
    match name, values[:2]:
        case "translate", [float(x)]:
            return Identity.translate(x, 0.0)
        case "translate", [float(x), float(y)] if len(words) <= 3 and None not in values:
            return Identity.translate(x, y)
        case "scale", [float(x)]:
            return Identity.scale(x, x)
        case "scale", [float(x), float(y)] if len(words) <= 3 and None not in values:
            return Identity.scale(x, y)
    return None


def factor(text: str) -> float | None:
    """Number or percentage; None if the text is neither."""
    value = number(text.removesuffix("%"))
    return value / 100.0 if value is not None and text.endswith("%") else value


def turned(words: list[str]) -> Transform | None:
    """Turn by an angle, which may be before or after its axis, by the formula of Rodrigues."""
    if not words:
        return None
    first = angle(words[0]) if ANGLE.fullmatch(words[0]) and words[0][-1].isalpha() else None
    axis, turn = (words[1:], first) if first is not None else (words[:-1], angle(words[-1]))
    numbers = AXES.get(" ".join(axis)) or [*map(number, axis)]
    match numbers:
        case [float(x), float(y), float(z)] if turn is not None:
            length = sqrt(x * x + y * y + z * z) or 1.0
            x, y, z = x / length, y / length, z / length
            rest, up = 1.0 - cos(turn), z * sin(turn)
            if not (x or y or z):
                return Identity
            return Transform(cos(turn) + rest * x * x, rest * x * y + up, rest * x * y - up, cos(turn) + rest * y * y)
    return None


def parse_origin(text: str, length: Length) -> tuple[float, float] | None:
    """Point that `transform-origin` gives (CSS Transforms 1, 5); None if it is not valid.

    Examples
    --------
    >>> parse_origin("right 3", lambda text, axis: {"100%": 10.0, "3": 3.0}[text])
    (10.0, 3.0)
    """
    words = text.lower().split()[:2]
    if len(words) == 1:
        words = ["center", words[0]] if words[0] in ("top", "bottom") else [words[0], "center"]
    if len(words) != 2:
        return None
    if words[0] in ("top", "bottom") or words[1] in ("left", "right"):
        words.reverse()
    x, y = (length(KEYWORDS.get(word, word), axis) for axis, word in enumerate(words))
    return None if x is None or y is None else (x, y)


def about_origin(matrix: Transform, text: str, length: Length) -> Transform:
    """A transform about the point that `transform-origin` gives; as it is if that is not valid.

    Examples
    --------
    >>> about_origin(Identity.scale(2.0), "3 0", lambda text, axis: float(text)).transformPoint((4, 1))
    (5.0, 2.0)
    """
    x, y = parse_origin(text, length) or (0.0, 0.0)
    return Identity.translate(x, y).transform(matrix).translate(-x, -y) if x or y else matrix


def mapped(cubics: NDArray[np.float64], matrix: Transform) -> NDArray[np.float64]:
    """Apply an affine map to points (..., 2).

    A matrix product may round the same point differently at two places of an array, hence the explicit sums.
    """
    x, y = cubics[..., 0], cubics[..., 1]
    a, b, c, d, e, f = matrix
    return np.stack([a * x + c * y + e, b * x + d * y + f], axis=-1)


def scale_of(matrix: Transform) -> float:
    """Largest factor by which a map stretches a length (its larger singular value).

    Examples
    --------
    >>> scale_of(Identity.rotate(radians(30)).scale(2, 5))
    5.0
    """
    a, b, c, d = matrix[:4]
    x, y = a * a + b * b, c * c + d * d
    return sqrt((x + y + sqrt((x - y) ** 2 + 4.0 * (a * c + b * d) ** 2)) / 2.0)
