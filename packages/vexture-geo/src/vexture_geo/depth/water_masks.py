"""Numbers that mark water without its depth: classes of depth, and masks."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import isclose
from typing import Final

import numpy as np

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture_geo.base.depth_ranges import DepthRange, format_range, wet_ranges
from vexture_geo.depth.series import Meaning, Values

MARKS: Final = (0.0, 1.0, 255.0)
"""Numbers of masks: 0 is dry and 1 is wet; 255 is wet if there is no 1, and otherwise unknown."""

MOST_CLASSES: Final = 8
"""Most classes that a map shows unchanged; some of more classes are joined."""

SAME: Final = 1e-6
"""Metres by which equal limits of classes may differ."""


@dataclass(frozen=True, slots=True)
class WaterRanks:
    """Ranks of numbers: 0 where it is dry or unknown, 1 for the first of the `ranges`, or for a mask's water.

    `wet` is the first number of water, and `mark` the only number of water in a mask. `leasts` are the ranks at which
    areas begin: that of all water, and those of the `contours`.
    """

    wet: float
    mark: float | None = None
    ranges: tuple[DepthRange, ...] = ()
    contours: tuple[float, ...] = ()
    leasts: tuple[int, ...] = (1,)

    def ranks(self, values: Values) -> Values:
        """Convert the numbers of a step to ranks."""
        if self.mark is not None:
            return np.where(values == self.mark, 1.0, 0.0)
        return np.where(np.isfinite(values), np.maximum(values - self.wet + 1.0, 0.0), 0.0)


def water_ranks(
    meaning: Meaning, steps: Iterable[Values], hmin: float, depths: Sequence[float], notes: Notes
) -> WaterRanks | None:
    """Interpret numbers that are not depths; return None if they are depths.

    `steps` are the values of all times, read only as far as needed. Notes receive what was chosen. Raises a
    `SourceError` if the numbers do not describe water.
    """
    if meaning.ranges:
        return _of_classes(meaning.ranges, hmin, depths, notes)
    if meaning.has_unit and not meaning.are_colors:
        return None
    marks = _marks(steps)
    if marks:
        mark = 1.0 if 1.0 in marks else 255.0
        notes.remark(
            f"its numbers are only {_list_numbers(sorted({0.0, *marks}))}: {mark:g} is read as water of no known "
            "depth; if they are depths, write their unit into the file, such as m"
        )
        return WaterRanks(mark, mark=mark)
    if meaning.are_colors:
        raise SourceError(
            "its numbers are those of colours, and no depths; give depths in metres, or a mask of 0 and 1; a picture "
            "is shown under the water by `ground`"
        )
    if meaning.are_whole:
        notes.remark(
            "it holds whole numbers without a unit, taken as metres; if they are centimetres or classes, write their "
            "unit, or flag_values and flag_meanings, into the file"
        )
    return None


def _marks(steps: Iterable[Values]) -> set[float]:
    """Numbers of a mask except 0; empty if it is not a mask."""
    found: set[float] = set()
    for values in steps:
        known = values[np.isfinite(values)]
        if not np.isin(known, MARKS).all():
            return set()
        found |= {mark for mark in MARKS[1:] if (known == mark).any()}
    return found


def _of_classes(ranges: tuple[DepthRange, ...], hmin: float, depths: Sequence[float], notes: Notes) -> WaterRanks:
    """Make ranks of classes of water."""
    wet = wet_ranges(ranges, hmin)
    if not wet:
        told = ", ".join(map(format_range, ranges))
        raise SourceError(f"its classes ({told}) are all below `hmin`, {hmin:g} m; choose a smaller one")
    dry = len(ranges) - len(wet)
    wet_from = float(dry + 1)
    if len(wet) == 1 and wet[0].low <= 0.0:
        notes.remark("it says where it is wet, and no depths")
        return WaterRanks(wet_from)
    notes.remark(
        f"it holds classes of depth, from {format_range(wet[0])} to {format_range(wet[-1])}: depths are ranges"
    )
    if dry and ranges[dry - 1].high > hmin:
        notes.remark(f"its class {format_range(ranges[dry - 1])} holds dry ground too, and counts as dry")
    if wet[0].low < hmin:
        notes.remark(f"its class {format_range(wet[0])} counts as water, with `hmin` {hmin:g} m in it")
    lows = [one.low for one in wet]
    inner = lows[1:]
    contours = [low for low in inner if any(isclose(low, depth, abs_tol=SAME) for depth in depths)]
    if len(contours) < len(depths):
        if len(wet) <= MOST_CLASSES:
            contours = inner
        elif not contours:
            contours = [inner[len(inner) * k // MOST_CLASSES] for k in range(1, MOST_CLASSES)]
        notes.remark(f"maps of its classes have borders at {_list_numbers(contours)} m, where the file has them")
    return WaterRanks(wet_from, None, wet, tuple(contours), (1, *(1 + lows.index(contour) for contour in contours)))


def _list_numbers(numbers: Sequence[float]) -> str:
    """Format numbers for a sentence."""
    told = [f"{number:g}" for number in numbers]
    return told[0] if len(told) == 1 else f"{', '.join(told[:-1])} and {told[-1]}"
