"""Numbers and lengths of SVG: syntax, units, and limits."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from math import hypot, isnan
from typing import Final

from vexture.base.errors import SourceError
from vexture.drawing.calculation import LENGTH, NUMBER, PERCENT, Quantity, calculate
from vexture.svg.path_data import NUMBER as DIGITS

LARGEST: Final = 1e12
"""Largest number in user units. Elements beyond are dropped: products of two numbers and a matrix must stay finite."""


class TooLargeError(SourceError):
    """A number of an element exceeds `LARGEST`; inside the drawing, only that element is dropped."""


INITIAL_SIZE: Final = 16.0
"""Font size that the outermost element inherits, in user units."""

PIXELS: Final = {
    "": 1.0,
    "px": 1.0,
    "pt": 4 / 3,
    "pc": 16.0,
    "in": 96.0,
    "cm": 96 / 2.54,
    "mm": 96 / 25.4,
    "q": 96 / 101.6,
}
"""CSS pixels of each absolute unit (CSS Values 4, 6.2)."""

FONT_UNITS: Final = {"em": 1.0, "ex": 0.5, "ch": 0.5}
"""Font sizes per unit that depends on the font; ex and ch as for fonts without such data."""

VIEW_UNITS: Final = {"w": (1.0, 0.0), "h": (0.0, 1.0), "i": (1.0, 0.0), "b": (0.0, 1.0)}
"""Fractions of width and height of the outermost viewport for its units, by their last letter."""

RELATIVE = re.compile(r"%|\d\.?[sld]?v[whibm]", re.IGNORECASE)
VIEW_UNIT = re.compile(r"[sld]?v(?:([whib])|(min|max))")
WRITTEN = re.compile(rf"\s*({DIGITS})\s*([a-zA-Z]*|%)\s*")
SEPARATOR = re.compile(r"\s*,\s*|\s+")
IN_BRACKETS = re.compile(r"[()]|[^()]+")


def number(text: str) -> float | None:
    """Parse a finite number; None if the text is not one; raise a `TooLargeError` if it exceeds `LARGEST`.

    Examples
    --------
    >>> number(" -1.5e2 "), number("1 2"), number("nan")
    (-150.0, None, None)
    """
    match = WRITTEN.fullmatch(text)
    if match is None:
        found = calculate(text, lambda value, unit: None)
        return bounded_number(found.value) if found is not None and found.kind == NUMBER else None
    return None if match[2] else bounded_number(match[1])


def numbers(text: str) -> list[float] | None:
    """Parse numbers between commas or spaces; None if there is anything else."""
    found = [number(part) for part in SEPARATOR.split(text.strip())]
    return None if None in found else [value for value in found if value is not None]


def words(text: str, between: re.Pattern[str] = SEPARATOR) -> list[str]:
    """Split a value at commas or spaces, or at `between`, but not inside brackets.

    Examples
    --------
    >>> words("1px, calc(2px + min(3px, 4%))  5")
    ['1px', 'calc(2px + min(3px, 4%))', '5']
    """
    text = text.strip()
    if "(" not in text:
        return between.split(text) if text else []
    found, depth = [""], 0
    for part in IN_BRACKETS.findall(text):
        depth += (part == "(") - (part == ")")
        first, *others = [part] if depth or part == ")" else between.split(part)
        found[-1] += first
        found += others
    return found


def is_relative(text: str) -> bool:
    """Return whether a length, as a side of the outermost viewport, is relative to the surroundings."""
    return RELATIVE.search(text) is not None


def bounded_number(number: str | float) -> float:
    """Return the value of a number; raise a `TooLargeError` if it is too large."""
    value = float(number)
    if isnan(value):  # a result of a calculation
        return 0.0
    if not abs(value) <= LARGEST:
        raise TooLargeError(f"the number {str(number)[:40]} is too large; the limit is {LARGEST:g}")
    return value


def fraction(text: str) -> float | None:
    """Parse a number or percentage, clamped to 0..1; None if the text is neither.

    Examples
    --------
    >>> fraction("25%"), fraction("7"), fraction("?")
    (0.25, 1.0, None)
    """
    match = WRITTEN.fullmatch(text)
    if match is None:
        found = calculate(text, lambda value, unit: Quantity(value, PERCENT) if unit == "%" else None)
        if found is None or found.kind not in (NUMBER, PERCENT):
            return None
        value, is_percentage = bounded_number(found.value), found.kind == PERCENT
    elif match[2] not in ("", "%"):
        return None
    else:
        value, is_percentage = bounded_number(match[1]), bool(match[2])
    return min(max(value / (100.0 if is_percentage else 1.0), 0.0), 1.0)


@dataclass(frozen=True, slots=True)
class Viewport:
    """Reference sizes of relative lengths, in user units."""

    width: float  # width of the nearest viewport
    height: float
    root_font_size: float = INITIAL_SIZE  # font size of the outermost element
    outermost: tuple[float, float] | None = None  # width and height of the outermost viewport, if that is another

    @property
    def diagonal(self) -> float:
        """Reference of percentages of neither width nor height (SVG 2, 8.9)."""
        return hypot(self.width, self.height) / 2**0.5

    def along(self, font_size: float) -> Callable[[str, int], float | None]:
        """Return a function of a text and an axis, 0 across and 1 down, that applies `length` along the axis."""
        return lambda text, axis: self.length(text, (self.width, self.height)[axis], font_size)

    def length(self, text: str, whole: float, font_size: float) -> float | None:
        """Convert a length to user units; None if the text is not a length. `whole` is 100%, `font_size` is 1em.

        Examples
        --------
        >>> Viewport(200, 100).length("25.4mm", 200, 16), Viewport(200, 100).length("50%", 200, 16)
        (96.0, 100.0)
        """
        match = WRITTEN.fullmatch(text)
        if match is None:
            found = calculate(text, lambda value, unit: self.quantity(value, unit, whole, font_size))
            return bounded_number(found.value) if found is not None and found.kind in (NUMBER, LENGTH) else None
        factor = self.factor(match[2].lower(), whole, font_size)
        return None if factor is None else bounded_number(match[1]) * factor

    def quantity(self, value: float, unit: str, whole: float, font_size: float) -> Quantity | None:
        """Convert a number with a unit to a length, for a calculation."""
        factor = self.factor(unit, whole, font_size)
        return None if factor is None else Quantity(value * factor, LENGTH)

    def factor(self, unit: str, whole: float, font_size: float) -> float | None:
        """Return the number of user units of a unit; None if the unit is unknown."""
        if unit in PIXELS:
            return PIXELS[unit]
        if unit == "%":
            return whole / 100.0
        if unit in FONT_UNITS:
            return FONT_UNITS[unit] * font_size
        if unit == "rem":
            return self.root_font_size
        match = VIEW_UNIT.fullmatch(unit)
        if match is None:
            return None
        width, height = self.outermost or (self.width, self.height)
        if match[2]:
            return (min if match[2] == "min" else max)(width, height) / 100.0
        across, down = VIEW_UNITS[match[1]]
        return (across * width + down * height) / 100.0
