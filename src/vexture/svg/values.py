"""Numbers and lengths of SVG: syntax, units, and limits."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from math import hypot
from typing import Final

from vexture.errors import SourceError
from vexture.svg.path_data import NUMBER

__all__ = ["INITIAL_SIZE", "LARGEST", "SEPARATOR", "TooLargeError", "Viewport", "fraction", "number", "numbers"]

LARGEST: Final = 1e12
"""User units. An element with larger numbers is lost: the product of two of them and a matrix must stay finite."""


class TooLargeError(SourceError):
    """A number of an element exceeds `LARGEST`; inside the drawing, only that element is lost."""


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
"""Font sizes of each unit that depends on the font; ex and ch as for fonts without such data."""

LENGTH = re.compile(rf"\s*({NUMBER})\s*([a-zA-Z]*|%)\s*")
SEPARATOR = re.compile(r"\s*,\s*|\s+")


def number(text: str) -> float | None:
    """Finite number; None if the text is anything else; a `TooLargeError` if it is larger than `LARGEST`.

    Examples
    --------
    >>> number(" -1.5e2 "), number("1 2"), number("nan")
    (-150.0, None, None)
    """
    match = LENGTH.fullmatch(text)
    if match is None or match[2]:
        return None
    return bounded(match[1])


def numbers(text: str) -> list[float] | None:
    """Numbers between commas or spaces; None if there is anything else."""
    found = [number(part) for part in SEPARATOR.split(text.strip())]
    return None if None in found else [value for value in found if value is not None]


def bounded(text: str) -> float:
    """Value of a number; a `TooLargeError` if it is one."""
    value = float(text)
    if not abs(value) <= LARGEST:
        raise TooLargeError(f"the number {text[:40]} is too large; the limit is {LARGEST:g}")
    return value


def fraction(text: str) -> float | None:
    """Number or percentage, clipped to 0..1; None if the text is neither.

    Examples
    --------
    >>> fraction("25%"), fraction("7"), fraction("?")
    (0.25, 1.0, None)
    """
    match = LENGTH.fullmatch(text)
    if match is None or match[2] not in ("", "%"):
        return None
    return min(max(bounded(match[1]) / (100.0 if match[2] else 1.0), 0.0), 1.0)


@dataclass(frozen=True, slots=True)
class Viewport:
    """Reference sizes of relative lengths, in user units."""

    width: float  # of the nearest viewport
    height: float
    root_font_size: float = INITIAL_SIZE  # font size of the outermost element

    @property
    def diagonal(self) -> float:
        """Reference of percentages of neither width nor height (SVG 2, 8.9)."""
        return hypot(self.width, self.height) / 2**0.5

    def along(self, font_size: float) -> Callable[[str, int], float | None]:
        """Return the function of a text and an axis, 0 across and 1 down, that is `length` along it."""
        return lambda text, axis: self.length(text, (self.width, self.height)[axis], font_size)

    def length(self, text: str, whole: float, font_size: float) -> float | None:
        """Length in user units; None if the text is no length. `whole` is 100%, `font_size` is 1em.

        Examples
        --------
        >>> Viewport(200, 100).length("25.4mm", 200, 16), Viewport(200, 100).length("50%", 200, 16)
        (96.0, 100.0)
        """
        match = LENGTH.fullmatch(text)
        if match is None:
            return None
        unit = match[2].lower()
        if unit in PIXELS:
            factor = PIXELS[unit]
        elif unit == "%":
            factor = whole / 100.0
        elif unit in FONT_UNITS:
            factor = FONT_UNITS[unit] * font_size
        elif unit == "rem":
            factor = self.root_font_size
        else:
            return None
        return bounded(match[1]) * factor
