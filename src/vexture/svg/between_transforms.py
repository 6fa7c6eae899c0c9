"""Lists of transforms between two others (CSS Transforms 1, 11 to 13; CSS Transforms 2, 7)."""

from dataclasses import dataclass
from itertools import zip_longest
from math import atan2, cos, hypot, sin, tau
from typing import Final

import numpy as np
import tinycss2

from vexture.svg.between import UnclearError, Way, mixed_amounts
from vexture.svg.calculation import parsed
from vexture.svg.spatial import Attribute, css_transform, lifted, seen
from vexture.svg.transform import Transform
from vexture.svg.values import Viewport, is_relative, number, words

__all__ = ["as_property", "property_between", "transforms_between"]

Function = tuple[str, tuple[str, ...]]
"""Name of a function, in lower case, and its arguments."""

ALIKE: Final = {
    **dict.fromkeys(("translate", "translatex", "translatey"), "translate"),
    **dict.fromkeys(("translatez", "translate3d"), "translate3d"),
    **dict.fromkeys(("scale", "scalex", "scaley"), "scale"),
    **dict.fromkeys(("scalez", "scale3d"), "scale3d"),
    **dict.fromkeys(("rotate", "rotatez"), "rotate"),
}
"""What functions of one kind are written as; others as they are."""

DEEPER: Final = {"translate": "translate3d", "scale": "scale3d"}
AXES: Final = "xyz"
MATRIX: Final = "matrix"
SAME: Final = ("1", "0", "0", "1", "0", "0")
"""Arguments of a matrix that changes nothing."""

DEEP: Final = frozenset({"matrix3d", "perspective"})
"""Functions of space that are not mixed."""

HALF_TURN: Final = tau / 2.0


def transforms_between(first: str, second: str, part: float) -> str | None:
    """The list of transforms at a part of the way from one to another; None if there is nothing between them.

    Raise an `UnclearError` where that is not known: in space, or where lists are unlike and refer to boxes and fonts.

    Examples
    --------
    >>> transforms_between("none", "rotate(1turn) translateX(50%)", 0.25)
    'rotate(90.0deg) translate(12.5%, 0)'
    >>> transforms_between("translate(10px)", "scale(2)", 0.5)
    'matrix(1.5, 0.0, 0.0, 1.5, 5.0, 0.0)'
    """
    mine, theirs = functions(first), functions(second)
    if mine is None or theirs is None:
        raise UnclearError
    made, rest = list[str | None](), (list[Function](), list[Function]())
    for one, other in zip_longest(mine, theirs):
        pair = None if rest[0] or rest[1] else same_kind(one, other)
        if pair is None:
            for found, place in zip((one, other), rest, strict=True):
                place.extend([found] if found else [])
        elif pair[0][0] == MATRIX:
            made.append(matrices_between([pair[0]], [pair[1]], part))
        else:
            made.append(written((pair[0][0], mixed_arguments(*pair, Way(part)))))
    if rest[0] or rest[1]:
        made.append(matrices_between(*rest, part))
    return None if None in made else " ".join(filter(None, made)) or "none"


def as_property(text: str) -> str:
    """A list of transforms as the property has it, where it may be that of an attribute.

    Examples
    --------
    >>> as_property(Attribute("translate(20 3)rotate(45,5,6)"))
    'translate(20px, 3px) translate(5px, 6px) rotate(45deg) translate(-5px, -6px)'
    """
    if not isinstance(text, Attribute):
        return text
    found = functions(text)
    if found is None:
        raise UnclearError
    return " ".join(map(written, found)) or "none"


def functions(text: str) -> list[Function] | None:
    """Functions of a list; None if there is anything else in it."""
    found = list[Function]()
    if text.strip().lower() in ("", "none"):
        return found
    attribute = isinstance(text, Attribute)
    for token in parsed(text.strip()):
        if token.type == "function":
            inside = "".join("," if part == "," else tinycss2.serialize([part]) for part in token.arguments)
            found += of_attribute(token.lower_name, words(inside)) if attribute else [(token.lower_name, parts(inside))]
        elif token.type != "whitespace" and not (attribute and token == ","):
            return None
    return found or None


def parts(inside: str) -> tuple[str, ...]:
    """Arguments between commas."""
    return tuple(word for word in words(inside) if word)


def of_attribute(name: str, arguments: list[str]) -> list[Function]:
    """A function of an attribute, with units."""
    unit = {"t": "px", "r": "deg", "s": "deg"}.get(name[:1], "") if not name.startswith("scale") else ""
    texts = tuple(text if not number_only(text) else text + unit for text in arguments)
    if name == "rotate" and len(texts) == 3:
        x, y = (number(text) or 0.0 for text in arguments[1:])
        back = (f"{-x:g}px", f"{-y:g}px")
        return [("translate", (f"{x:g}px", f"{y:g}px")), ("rotate", texts[:1]), ("translate", back)]
    return [(name, texts)]


def number_only(text: str) -> bool:
    """Whether a text is a number without a unit."""
    return number(text) is not None


def same_kind(one: Function | None, other: Function | None) -> tuple[Function, Function] | None:
    """Two functions as those of one kind; None if they are not of one. One that is missing changes nothing."""
    first, second = (None if function is None else plain(function) for function in (one, other))
    if first is None or second is None:
        known = first or second
        assert known is not None
        still = unchanged(known)
        return None if still is None else (still, known) if first is None else (known, still)
    for flat, deep in DEEPER.items():
        if {first[0], second[0]} == {flat, deep}:
            first, second = deepened(first), deepened(second)
    if first[0] == "rotate3d" == second[0] and first[1][:3] != second[1][:3]:
        raise UnclearError
    if first[0] != second[0] or first[0] in DEEP or len(first[1]) != len(second[1]):
        return None
    return first, second


def plain(function: Function) -> Function:
    """A function with all arguments, by the name of its kind."""
    name, arguments = function
    kind = ALIKE.get(name, name)
    zero = blank(kind)
    if kind in DEEPER and name in DEEPER:
        second = arguments[0] if name == "scale" and arguments else zero
        return kind, arguments if len(arguments) == 2 else (*arguments, second)
    if kind in (*DEEPER, *DEEPER.values()) and name[-1] in AXES and len(arguments) == 1:
        count = 3 if kind in DEEPER.values() else 2
        return kind, tuple(arguments[0] if axis == name[-1] else zero for axis in AXES[:count])
    if kind == "skew" and len(arguments) == 1:
        return kind, (*arguments, zero)
    return kind, arguments


def deepened(function: Function) -> Function:
    """A function of space for one of the plane."""
    name, arguments = function
    return (DEEPER[name], (*arguments, blank(name))) if name in DEEPER else function


def unchanged(function: Function) -> Function | None:
    """A function of the same kind that changes nothing; None if there is none of its kind."""
    name, arguments = function
    if name in DEEP:
        return None
    if name == MATRIX:
        return name, SAME
    if name == "rotate3d":
        return (name, (*arguments[:3], "0")) if len(arguments) == len(AXES) + 1 else None
    return name, (blank(name),) * len(arguments)


def blank(name: str) -> str:
    """Argument of a function that changes nothing."""
    return "1" if name.startswith("scale") else "0"


def mixed_arguments(one: Function, other: Function, way: Way) -> tuple[str, ...]:
    """Arguments of a function made of two of its kind."""
    made = list[str]()
    for first, second in zip(one[1], other[1], strict=True):
        ends = (share(first), share(second)) if one[0].startswith("scale") else (first, second)
        amount = scaled(*ends) if one[0].startswith("scale") and way.adds else mixed_amounts(*ends, way)
        if amount is None:
            raise UnclearError
        made.append(amount)
    return tuple(made)


def scaled(first: str, second: str) -> str | None:
    """What two scales make, one after another; None if they are calculations."""
    factors = number(first), number(second)
    return None if factors[0] is None or factors[1] is None else repr(factors[0] * factors[1])


def share(text: str) -> str:
    """A percentage of a scale as a number."""
    value = number(text.removesuffix("%")) if text.endswith("%") else None
    return text if value is None else repr(value / 100.0)


def written(function: Function) -> str:
    """Text of a function."""
    return f"{function[0]}({', '.join(function[1])})"


def flat_matrix(functions: list[Function]) -> Transform:
    """Product of functions; raises an `UnclearError` if it is not one of the plane, or refers to boxes or fonts."""
    text = " ".join(map(written, functions))
    matrix = None if is_relative(text) or "%" in text else css_transform(text, pixels)
    if matrix is None:
        raise UnclearError
    flat, _ = seen(matrix)
    if not np.array_equal(matrix, lifted(flat)):
        raise UnclearError
    return flat


def pixels(text: str, axis: int) -> float | None:
    """A length in user units; None if it refers to a font."""
    return None if text.lower().rstrip("0123456789").endswith(("em", "ex", "ch")) else ABSOLUTE.length(text, 0.0, 0.0)


ABSOLUTE: Final = Viewport(0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Parts:
    """A map as what its factors are: move, turn, skew and scale, the last one first."""

    x: float
    y: float
    turn: float
    skew: float
    across: float
    down: float


def matrices_between(first: list[Function], second: list[Function], part: float) -> str | None:
    """The product of a list at a part of the way from that of one to that of another, as a function."""
    matrix = matrix_between(flat_matrix(first), flat_matrix(second), part)
    return None if matrix is None else f"{MATRIX}({', '.join(map(repr, matrix))})"


def matrix_between(first: Transform, second: Transform, part: float) -> Transform | None:
    """A map at a part of the way from one to another; None if one of them has no inverse.

    Flips stay flips, as browsers have it, where the standard makes a turn of two that differ.
    """
    one, other = factors(first), factors(second)
    if one is None or other is None:
        return None
    turn, target = one.turn, other.turn
    if abs(turn - target) > HALF_TURN:  # the shorter way around
        target += tau if turn > target else -tau
    way = Way(part)
    turn, skew = way.number(turn, target), way.number(one.skew, other.skew)
    across, down = way.number(one.across, other.across), way.number(one.down, other.down)
    c, s = cos(turn), sin(turn)
    moved = way.number(one.x, other.x), way.number(one.y, other.y)
    return Transform(c * across, s * across, (c * skew - s) * down, (s * skew + c) * down, *moved)


def factors(matrix: Transform) -> Parts | None:
    """Factors of a map; None if it has no inverse."""
    a, b, c, d, x, y = matrix
    across, area = hypot(a, b), a * d - b * c
    if across == 0.0 or area == 0.0:
        return None
    if area < 0.0 and a < d:
        across = -across
    turn = atan2(b / across, a / across)
    down = area / across
    return Parts(x, y, turn, (a * c + b * d) / across / down, across, down)


def property_between(name: str, first: str, second: str, way: Way) -> str:
    """The value of the property `translate`, `rotate` or `scale` made of two.

    Examples
    --------
    >>> property_between("scale", "none", "2 4", Way(0.5))
    '1.5 2.5'
    """
    ends = [() if text.strip().lower() == "none" else tuple(words(text.lower())) for text in (first, second)]
    deep = max(map(len, ends)) > 2
    if name == "rotate" and max(map(len, ends)) > 1:
        raise UnclearError
    one, other = ((DEEPER[name], padded(name, end)) if deep else (name, end) for end in ends)
    pair = same_kind(one if one[1] else None, other if other[1] else None) if one[1] or other[1] else None
    return "none" if pair is None else " ".join(mixed_arguments(*pair, way))


def padded(name: str, arguments: tuple[str, ...]) -> tuple[str, ...]:
    """Arguments of a function of space; none if there are none."""
    if not arguments:
        return arguments
    flat = plain((name, arguments)) if len(arguments) < 3 else (name, arguments)
    return deepened(flat)[1] if len(arguments) < 3 else arguments
