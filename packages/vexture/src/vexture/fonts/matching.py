"""Choice among the faces of a family, as in CSS Fonts 4, 5.2."""

from dataclasses import dataclass
from math import inf
from typing import Final

STYLES: Final = {
    "normal": ("normal", "oblique", "italic"),
    "italic": ("italic", "oblique", "normal"),
    "oblique": ("oblique", "italic", "normal"),
}
"""Styles that can replace a requested style, in order."""

REGULAR, MEDIUM = 400, 500
"""Range of requested weights that prefer heavier faces, up to the upper end, over lighter ones."""

NORMAL_STRETCH: Final = 100.0


@dataclass(frozen=True, slots=True)
class Traits:
    """The traits that a face offers: least and greatest weight and stretch, and styles."""

    weights: tuple[float, float]
    stretches: tuple[float, float]
    styles: tuple[str, ...]

    def offers(self, weight: float, style: str | None, stretch: float) -> bool:
        """Return whether it offers a weight, a style (None: any) and a stretch."""
        (light, heavy), (narrow, wide) = self.weights, self.stretches
        return light <= weight <= heavy and narrow <= stretch <= wide and (style is None or style in self.styles)


def preference(traits: Traits, weight: float, style: str, stretch: float) -> tuple[float, ...]:
    """Return a sort key for the faces of a family: the face with the least key replaces the requested one.

    Examples
    --------
    >>> light, bold = (Traits((w, w), (100, 100), ("normal",)) for w in (300, 700))
    >>> preference(light, 400, "normal", 100) < preference(bold, 400, "normal", 100)
    True
    >>> preference(light, 600, "normal", 100) < preference(bold, 600, "normal", 100)
    False
    """
    order = STYLES.get(style, STYLES["normal"])
    slope = min((order.index(offered) for offered in traits.styles), default=len(order))
    narrow = stretch <= NORMAL_STRETCH
    width = distances(traits.stretches, stretch, -inf if narrow else inf)
    if REGULAR <= weight <= MEDIUM:
        return (*width, slope, *distances(traits.weights, weight, MEDIUM))
    return (*width, slope, *distances(traits.weights, weight, -inf if weight < REGULAR else inf))


def distances(offered: tuple[float, float], value: float, first: float) -> tuple[float, float]:
    """Return rank and distance of an offered range: 1 is the side towards `first` and up to it, the preferred side.

    Examples
    --------
    >>> distances((300, 300), 400, 500), distances((500, 500), 400, 500), distances((600, 600), 400, 500)
    ((2, 100), (1, 100), (3, 200))
    """
    low, high = offered
    if low <= value <= high:
        return 0, 0
    place = low if value < low else high
    if min(value, first) <= place <= max(value, first):
        return 1, abs(place - value)
    return 2 if (place < value) == (first >= value) else 3, abs(place - value)
