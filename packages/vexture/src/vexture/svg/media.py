"""Media queries, evaluated for a picture in a page on a screen (Media Queries 4)."""

import operator
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import tinycss2

from vexture.drawing.calculation import split_arguments
from vexture.svg.values import INITIAL_SIZE, TooLargeError, Viewport, number

TYPES: Final = {"all": True, "screen": True, "print": False, "speech": False}

WORDS: Final = {
    "any-hover": "none",
    "any-pointer": "none",
    "color-gamut": "srgb",
    "display-mode": "browser",
    "dynamic-range": "standard",
    "forced-colors": "none",
    "hover": "none",
    "inverted-colors": "none",
    "overflow-block": "scroll",
    "overflow-inline": "scroll",
    "pointer": "none",
    "prefers-color-scheme": "light",
    "prefers-contrast": "no-preference",
    "prefers-reduced-data": "no-preference",
    "prefers-reduced-motion": "no-preference",
    "prefers-reduced-transparency": "no-preference",
    "scripting": "none",
    "update": "fast",
}
"""Features with keywords, as browsers report them for an image on a screen: no pointer, no scripts."""

NUMBERS: Final = {"color": 8.0, "color-index": 0.0, "grid": 0.0, "monochrome": 0.0}
"""Features with whole numbers."""

NOTHING: Final = ("none", "no-preference")
"""Keywords with which a feature without a value does not hold."""

ALIASES: Final = {"-webkit-device-pixel-ratio": "resolution", "device-width": "width", "device-height": "height"}

PER_PIXEL: Final = {"": 1.0, "x": 1.0, "dppx": 1.0, "dpi": 1 / 96, "dpcm": 2.54 / 96}
"""Dots per pixel of each unit of a resolution."""

COMPARED: Final[dict[str, Callable[[float, float], bool]]] = {
    "<": operator.lt,
    "<=": operator.le,
    "=": operator.eq,
    ">": operator.gt,
    ">=": operator.ge,
}
RANGE = re.compile(r"([^<>=]+)([<>]=?|=)([^<>=]+)(?:([<>]=?)([^<>=]+))?")
RESOLUTION = re.compile(r"(.*?\d)\s*([a-z]*)")
PREFIX = re.compile(r"(-webkit-)?(min-|max-)?(.*)")

DIGITS: Final = 9
"""Decimals to which ratios are compared."""

Answer = bool | None
"""Value of a condition; None is unknown, which counts as false and stays unknown if negated."""


def condition(tokens: list[Any], atom: Callable[[Any], Answer], alternatives: bool = True) -> Answer:
    """Evaluate conditions joined by "not", "and" or "or"; None if they are not valid.

    `atom` evaluates a single condition, a bracket or a function. Without `alternatives`, "or" is not allowed.
    """
    if tokens and word(tokens[0]) == "not":
        answer = atom(tokens[1]) if len(tokens) == 2 else None
        return None if answer is None else not answer
    joints = {word(token) for token in tokens[1::2]}
    if len(tokens) % 2 == 0 or len(joints) > 1 or not joints <= ({"and", "or"} if alternatives else {"and"}):
        return None
    answers = [atom(token) for token in tokens[::2]]
    decisive = joints == {"or"}
    if decisive in answers:
        return decisive
    return None if None in answers else not decisive


def word(token: Any) -> str | None:
    """Return the keyword that a token is, if any."""
    return token.lower_value if token.type == "ident" else None


def significant_tokens(tokens: list[Any]) -> list[Any]:
    """Return the tokens without spaces and comments."""
    return [token for token in tokens if token.type not in ("whitespace", "comment")]


@dataclass(frozen=True, slots=True)
class Medium:
    """A picture in a page on a screen.

    Examples
    --------
    >>> queries = "print, (width > 9em) and (orientation: landscape)"
    >>> Medium(200.0, 100.0).holds(tinycss2.parse_component_value_list(queries))
    True
    """

    width: float  # user units
    height: float

    def holds(self, queries: list[Any]) -> Answer:
        """Return whether one of some media queries holds, or the list is empty; None if it holds too large a number."""
        if not significant_tokens(queries):
            return True
        try:
            answers = [self.query(significant_tokens(query)) for query in split_arguments(queries)]
        except TooLargeError:
            return None
        return True if True in answers else None if None in answers else False

    def query(self, tokens: list[Any]) -> Answer:
        """Evaluate one media query."""
        first = next((at for at, token in enumerate(tokens) if word(token) not in ("not", "only")), len(tokens))
        name = word(tokens[first]) if first < len(tokens) else None
        if name is None:
            return condition(tokens, self.atom)
        if first > 1 or name in ("and", "or", "layer"):
            return None
        answer: Answer = TYPES.get(name, False)
        if rest := tokens[first + 1 :]:
            more = condition(rest[1:], self.atom, alternatives=False) if word(rest[0]) == "and" else None
            answer = False if answer is False and more is not None else more
        if answer is None or first == 0 or word(tokens[0]) == "only":
            return answer
        return not answer

    def atom(self, token: Any) -> Answer:
        """Evaluate a condition in brackets."""
        if token.type != "() block":
            return None
        inside = significant_tokens(token.content)
        if inside and (inside[0].type == "() block" or word(inside[0]) == "not"):
            return condition(inside, self.atom)
        return self.feature(tinycss2.serialize(token.content).strip().lower())

    def feature(self, text: str) -> Answer:
        """Evaluate a feature, such as ``min-width: 20em``, ``width >= 20em`` or ``color``."""
        name, colon, value = (part.strip() for part in text.partition(":"))
        if colon:
            return self.plain(name, value)
        if match := RANGE.fullmatch(text):
            left, sign, middle, other, right = (part and part.strip() for part in match.groups())
            if other is None:
                a, b = self.value(left, middle), self.value(middle, left)
                return None if a is None or b is None else COMPARED[sign](a, b)
            values = self.value(left, middle), self.value(middle, left), self.value(right, middle)
            if None in values or sign[0] != other[0]:
                return None
            a, b, c = (value or 0.0 for value in values)
            return COMPARED[sign](a, b) and COMPARED[other](b, c)
        if name in WORDS:
            return WORDS[name] not in NOTHING
        if name == "orientation":
            return True
        own = self.feature_value(ALIASES.get(name, name))
        return None if own is None else own > 0.0

    def plain(self, name: str, value: str) -> Answer:
        """Evaluate a feature with its value."""
        if name == "orientation":
            upright = {"portrait": True, "landscape": False}.get(value)
            return None if upright is None else upright == (self.height >= self.width)
        if name in WORDS:
            return WORDS[name] == value
        match = PREFIX.fullmatch(name)
        webkit, limit, name = match.groups() if match else (None, None, name)
        name = f"{webkit or ''}{name}"
        own, other = self.feature_value(ALIASES.get(name, name)), self.value(value, name)
        if own is None or other is None:
            return None
        return COMPARED[{"min-": ">=", "max-": "<=", None: "="}[limit]](own, other)

    def feature_value(self, name: str) -> float | None:
        """Return the value of a numeric media feature."""
        sizes = {"width": self.width, "height": self.height, "resolution": 1.0}
        if name in ("aspect-ratio", "device-aspect-ratio"):
            return round(self.width / self.height, DIGITS) if self.height else None
        return sizes.get(name, NUMBERS.get(name))

    def value(self, text: str, name: str) -> float | None:
        """Return the value of one side of a comparison, a feature or a number; `name` is the other side."""
        text, name = ALIASES.get(text, text), ALIASES.get(name, name)
        if (own := self.feature_value(text)) is not None:
            return own
        if name in ("width", "height"):
            length = Viewport(self.width, self.height).length(text, self.width, INITIAL_SIZE)
            return None if length and number(text) is not None else length  # only zero may lack a unit
        if name == "resolution":
            match = RESOLUTION.fullmatch(text)
            amount = number(match[1]) if match else None
            return amount * PER_PIXEL[match[2]] if match and amount is not None and match[2] in PER_PIXEL else None
        if name in ("aspect-ratio", "device-aspect-ratio"):
            across, _, down = text.partition("/")
            a, b = number(across), number(down or "1")
            return None if a is None or not b else round(a / b, DIGITS)
        return number(text)
