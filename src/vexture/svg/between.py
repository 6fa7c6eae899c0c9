"""Values between two others, and sums of two, as texts of attributes and properties (SMIL 3.0, 5; CSS Values 4, 3)."""

import re
from dataclasses import dataclass
from math import degrees
from typing import Any, Final

import tinycss2

from vexture.svg.calculation import MATH, parsed
from vexture.svg.colors import Color, parse_color
from vexture.svg.path_data import NUMBER
from vexture.svg.transform import TURN

__all__ = ["UnclearError", "Way", "added", "between", "color_mix", "mixed", "mixed_amounts"]

TERM: Final = re.compile(rf"(?:(?<![\w#.])|(?<=[\d.])(?=[+.-]))({NUMBER})([a-zA-Z]+|%)?")
"""A number that is not part of a name."""

AMOUNT: Final = re.compile(rf"({NUMBER})([a-zA-Z]+|%)?")

TIMES: Final = frozenset({"s", "ms"})

LONGEST: Final = 1_000_000
"""Characters of a value."""

LONGEST_CALCULATED: Final = 1_000
"""Characters of a value with calculations."""


class UnclearError(Exception):
    """The value of an animation is not known."""


@dataclass(frozen=True, slots=True)
class Way:
    """How two values make one: at a part of the way from one to another, or as a sum, of so many of the other."""

    part: float
    adds: bool = False

    def number(self, first: float, second: float) -> float:
        """What two numbers make."""
        return first + self.part * (second if self.adds else second - first)

    def calculation(self, first: str, second: str) -> str:
        """What two texts make, as a calculation."""
        share = "" if self.adds else f" * {1.0 - self.part!r}"
        return f"calc({first}{share} + {second} * {self.part!r})"


def between(first: str, second: str, part: float) -> str | None:
    """The value at a part of the way from one to another; None if there is nothing between them.

    Examples
    --------
    >>> between("rotate(0)", "rotate(90deg)", 0.5), between("1 20px", "3,40px", 0.25), between("red", "#00f", 0.5)
    ('rotate(45.0deg)', '1.5 25.0px', 'rgb(50.0% 0.0% 50.0% / 1.0)')
    >>> between("10px", "50%", 0.5), between("none", "block", 0.5)
    ('calc(10px * 0.5 + 50% * 0.5)', None)
    """
    return mixed(first, second, Way(part))


def added(first: str, second: str, times: int = 1) -> str | None:
    """The sum of a value and another one, so many times; None if they have none.

    Examples
    --------
    >>> added("10px", "5"), added("#100", "#200")
    ('15.0px', 'rgb(20.0% 0.0% 0.0% / 1.0)')
    """
    return mixed(first, second, Way(float(times), adds=True))


def mixed(first: str, second: str, way: Way) -> str | None:
    """A value made of two that are colours, or whose texts differ in numbers only."""
    if len(first) + len(second) > LONGEST:
        return None
    colors = parse_color(first), parse_color(second)
    if isinstance(colors[0], Color) and isinstance(colors[1], Color):
        rgb = (min(max(way.number(a, b), 0.0), 1.0) for a, b in zip(colors[0].rgb, colors[1].rgb, strict=True))
        alpha = min(max(way.number(colors[0].alpha, colors[1].alpha), 0.0), 1.0)
        return f"rgb({' '.join(f'{100.0 * value!r}%' for value in rgb)} / {alpha!r})"
    if colors[0] is not None and colors[1] is not None:  # one depends on the own colour
        return None if way.adds else color_mix("srgb", first, second, way.part)
    if any(f"{name}(" in text.lower() for name in MATH for text in (first, second) if "(" in text):
        if len(first) + len(second) > LONGEST_CALCULATED:
            return None
        return mixed_tokens(parsed(first.strip()), parsed(second.strip()), way)
    return mixed_terms(first, second, way)


def color_mix(space: str, first: str, second: str, part: float) -> str:
    """A colour between two, which is computed where it is used; raises an `UnclearError` beyond them."""
    if not 0.0 <= part <= 1.0:
        raise UnclearError
    return f"color-mix(in {space}, {first} {100.0 * (1.0 - part)!r}%, {second})"


def mixed_terms(first: str, second: str, way: Way) -> str | None:
    """A value made of two whose texts differ in numbers only, and hold no calculations."""
    words = [TERM.sub(" ", text).replace(",", " ").lower().split() for text in (first, second)]
    terms = list(TERM.finditer(first)), list(TERM.finditer(second))
    if words[0] != words[1] or len(terms[0]) != len(terms[1]) or not terms[1]:
        return None
    made, at = list[str](), 0
    for term, other in zip(*terms, strict=True):
        amount = mixed_amounts(term[0], other[0], way)
        if amount is None:
            return None
        made += [first[at : term.start()], amount]
        at = term.end()
    return "".join([*made, first[at:]])


def mixed_amounts(first: str, second: str, way: Way) -> str | None:
    """A number with its unit, or a calculation, made of two; None if they are of different kinds."""
    one, other = AMOUNT.fullmatch(first), AMOUNT.fullmatch(second)
    if one is None or other is None:
        pair = [text if match is None else with_unit(match) for text, match in ((first, one), (second, other))]
        return way.calculation(*pair) if all(pair) else scaled(first, second, way)
    own, unit = (one[2] or "").lower(), (other[2] or "").lower()
    mine, theirs = float(one[1]), float(other[1])
    if own != unit and own in TURN and unit in TURN and {own, unit} - {""}:
        if (own or not mine) and (unit or not theirs):
            return f"{way.number(degrees(mine * TURN[own]), degrees(theirs * TURN[unit]))!r}deg"
        return None
    if own == unit or {own, unit} == {"", "px"} or not ((own or mine) and (unit or theirs)):
        number = way.number(mine, theirs)
        return f"{one[1] if number == mine else repr(number)}{own or unit}"
    if {own, unit} & {*TURN.keys() - {""}, *TIMES}:
        return None
    return way.calculation(with_unit(one), with_unit(other))


def with_unit(amount: re.Match[str]) -> str:
    """A length or percentage as calculations have it; empty if it is zero and says neither."""
    return amount[0] if amount[2] else f"{amount[1]}px" if float(amount[1]) else ""


def scaled(first: str, second: str, way: Way) -> str:
    """What a calculation makes with zero."""
    if AMOUNT.fullmatch(first):
        return f"calc({second} * {way.part!r})"
    return first if way.adds else f"calc({first} * {1.0 - way.part!r})"


def mixed_tokens(first: tuple[Any, ...], second: tuple[Any, ...], way: Way) -> str | None:
    """A value made of the tokens of two."""
    made = [
        mixed_pair(one, other, way) if len(first) == len(second) else None
        for one, other in zip(first, second, strict=False)
    ]
    return None if None in made or not made else "".join(filter(None, made))


def mixed_pair(one: Any, other: Any, way: Way) -> str | None:
    """A value made of two tokens."""
    texts = tinycss2.serialize([one]), tinycss2.serialize([other])
    if is_amount(one) and is_amount(other):
        return mixed_amounts(*texts, way)
    if one.type == other.type == "function" and one.lower_name == other.lower_name:
        inside = mixed_tokens(tuple(one.arguments), tuple(other.arguments), way)
        return None if inside is None else f"{one.name}({inside})"
    return texts[0] if texts[0].split() == texts[1].split() else None


def is_amount(token: Any) -> bool:
    """Whether a token is a number, with or without a unit, or a calculation."""
    return token.type in ("number", "percentage", "dimension") or (
        token.type == "function" and token.lower_name in MATH
    )
