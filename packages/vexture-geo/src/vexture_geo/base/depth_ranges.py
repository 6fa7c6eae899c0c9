"""Classes of depth in place of depths: read their ranges from the flags of a NetCDF variable."""

import re
from collections.abc import Sequence
from itertools import pairwise
from math import inf
from typing import Any, Final, NamedTuple

import numpy as np

from vexture.base.errors import SourceError, shorten_text
from vexture_geo.base.lengths import metres_in

BOUNDS: Final = ("flag_bounds", "class_bounds")
"""Attributes that name the variable of the bounds of the classes."""

ENDLESS: Final = 1e30
"""Upper bounds above this mean no bound, such as the fill value of the format."""

DRY: Final = frozenset({"dry", "dry land", "land", "no water", "not flooded", "none"})
WET: Final = frozenset({"wet", "water", "flooded", "inundated"})
"""Meanings of flags for dry ground, and for water of unknown depth."""

NUMBER: Final = r"(-?\d*\.?\d+(?:e[+-]?\d+)?)[ _]*((?!to[ _])[a-z]*)"
BETWEEN: Final = re.compile(rf"{NUMBER}[ _]*(?:to|-|–|<|,|_)[ _]*{NUMBER}", re.IGNORECASE)
BELOW: Final = re.compile(rf"(?:below|under|less[ _]than|up[ _]to|lt|le|<=?)[ _]*{NUMBER}", re.IGNORECASE)
ABOVE: Final = re.compile(
    rf"(?:above|over|more[ _]than|greater[ _]than|at[ _]least|gt|ge|>=?)[ _]*{NUMBER}", re.IGNORECASE
)

TYPED: Final = re.compile(r"(?<=[\d.])(u?b|u?s|u?l{1,2}|[ufd])$", re.IGNORECASE)
"""Suffix of a number in CDL that gives its type."""

HOW: Final = "write each as 0.5-1m, below_0.5m or above_2m, or their bounds in a variable that flag_bounds names"

LONGEST: Final = 80
"""Longest meaning that is parsed as a range, and longest list of meanings in a message, in characters."""


TOUCHING: Final = 1e-6
"""Largest overlap of two ranges by rounding, in metres."""


MOST_RANGES: Final = 254
"""Most ranges, because a grid of them has 8 bits."""


class DepthRange(NamedTuple):
    """Limits of a class in metres; the upper one is infinite if the class has none."""

    low: float
    high: float


def has_flags(variable: Any) -> bool:
    """Return whether a variable holds classes or states, by its attributes."""
    return any(key in variable.attrs for key in ("flag_values", "flag_masks", "flag_meanings"))


def ranges_of_flags(dataset: Any, name: str, metres: float) -> dict[float, DepthRange]:
    """Return the range of depth for each value of a variable with flags; `metres` is its unit in metres.

    A state without water has a range that ends at 0. Water of unknown depth has a range from 0 without an end.
    Raises a `SourceError` if the flags are of anything else.
    """
    about = dataset[name].attrs
    values = _numbers(about.get("flag_values"))
    meanings = _texts(about.get("flag_meanings", ""))
    bounds = next((str(about[key]) for key in BOUNDS if str(about.get(key)) in dataset.variables), None)
    if bounds is not None and dataset[bounds].shape == (len(values), 2):
        lows, highs = np.asarray(dataset[bounds].values, np.float64).T
        ranges: list[DepthRange | None] = [
            DepthRange(
                float(low) * metres if abs(low) < ENDLESS else -inf,
                float(high) * metres if abs(high) < ENDLESS else inf,
            )
            for low, high in zip(lows, highs, strict=True)
        ]
    else:
        ranges = [_range_of(text, metres) for text in meanings]
    if len(ranges) > MOST_RANGES:
        raise SourceError(f"{name!r} has {len(ranges):,} classes; the limit is {MOST_RANGES}; write depths in metres")
    wrong = _wrong(values, ranges, meanings)
    if wrong:
        said = shorten_text(" ".join(meanings), LONGEST)
        raise SourceError(
            f"{name!r} holds flags ({said or 'without meanings'}) that are no ranges of depth: {wrong}; {HOW}, or name "
            "another `variable`"
        )
    known = [one for one in ranges if one is not None]
    return dict(zip(values, known, strict=True))


def _wrong(values: list[float], ranges: list[DepthRange | None], meanings: list[str]) -> str:
    """Describe what is wrong with the values of flags and their ranges; an empty text if nothing is."""
    if not values:
        return "flag_values are missing, or no numbers"
    if len(ranges) != len(values):
        return f"there are {len(values)} flag_values, and {len(ranges)} ranges for them"
    for at, one in enumerate(ranges):
        said = shorten_text(meanings[at], LONGEST) if at < len(meanings) else str(at + 1)
        if one is None:
            return f"{said!r} is none"
        if not one.low < one.high:
            return f"{said!r} ends where it begins, or below"
    known = sorted(one for one in ranges if one is not None)
    for one, other in pairwise(known):
        if one.high > other.low + TOUCHING:
            return f"{format_range(one)} and {format_range(other)} overlap"
    return ""


def wet_ranges(ranges: Sequence[DepthRange], hmin: float) -> tuple[DepthRange, ...]:
    """Select ranges of water, the shallowest first; others include dry ground, or end at the least depth of water.

    Examples
    --------
    >>> wet_ranges([DepthRange(0.0, 0.5), DepthRange(2.0, inf), DepthRange(0.5, 2.0)], 0.05)
    (DepthRange(low=0.5, high=2.0), DepthRange(low=2.0, high=inf))
    """
    return tuple(sorted(one for one in ranges if (one.low > 0.0 and one.high > hmin) or one.high == inf))


def format_range(one: DepthRange) -> str:
    """Format a range for a message.

    Examples
    --------
    >>> format_range(DepthRange(0.5, 2.0)), format_range(DepthRange(4.0, inf)), format_range(DepthRange(-inf, 0.02))
    ('0.5 to 2 m', 'over 4 m', 'below 0.02 m')
    """
    if one.high == inf:
        return f"over {one.low:g} m"
    return f"below {one.high:g} m" if one.low == -inf else f"{one.low:g} to {one.high:g} m"


def _range_of(text: str, metres: float) -> DepthRange | None:
    """Parse a range from a meaning; None if it contains none."""
    plain = text.strip().lower().replace("_", " ")
    if len(text) > LONGEST:
        return None
    if plain in DRY:
        return DepthRange(-inf, 0.0)
    if plain in WET:
        return DepthRange(0.0, inf)
    if found := BETWEEN.fullmatch(text):
        low, high = _metres(found[1], found[2] or found[4], metres), _metres(found[3], found[4] or found[2], metres)
        return None if low is None or high is None else DepthRange(low, high)
    if found := BELOW.fullmatch(text):
        high = _metres(found[1], found[2], metres)
        return None if high is None else DepthRange(-inf, high)
    if found := ABOVE.fullmatch(text):
        low = _metres(found[1], found[2], metres)
        return None if low is None else DepthRange(low, inf)
    return None


def _metres(number: str, unit: str, metres: float) -> float | None:
    """Convert a number to metres from its own unit, or else from that of the variable."""
    in_unit = metres_in(unit) if unit else metres
    return None if in_unit is None else round(float(number) * in_unit, 9)


def _numbers(values: Any) -> list[float]:
    """Read values of flags: numbers, or the numbers in a text."""
    try:
        if isinstance(values, str):
            return [float(TYPED.sub("", part)) for part in values.replace(",", " ").split()]
        return [] if values is None else [float(value) for value in np.atleast_1d(values)]
    except (TypeError, ValueError):
        return []


def _texts(meanings: Any) -> list[str]:
    """Split meanings of flags: words of one text, or a list of texts."""
    return meanings.split() if isinstance(meanings, str) else [str(one) for one in np.atleast_1d(meanings)]
