"""Sweep gradients of colour glyphs, as sectors of flat colours (OpenType 1.9.1, "COLR", section "Sweep gradients")."""

from dataclasses import dataclass
from itertools import pairwise
from math import ceil, cos, floor, hypot, pi, sin
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.convert import line_cubics
from vexture.drawing.affine import Affine
from vexture.drawing.paint import Paint, Spread, Stop
from vexture.drawing.sectors import Course, overlapping, reach_beyond, sectors_of

MOST_TURNS: Final = 180
"""Most repetitions of a ramp in a turn."""

Box = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True, eq=False)
class SweepFill:
    """A sweep gradient that fills the clips around it.

    Parameters
    ----------
    courses : list of Course
        Of a turn, counter-clockwise from the x axis.
    center : (float, float)
    matrix : Affine
        Map from the coordinates of the centre to font units.
    """

    courses: list[Course]
    center: tuple[float, float]
    matrix: Affine

    @property
    def sectors(self) -> list[Course]:
        """The sectors of flat colours."""
        return sectors_of(self.courses)

    def triangles(self, box: Box) -> list[tuple[NDArray[np.float64], Paint]]:
        """Return a contour and a paint for each sector; together, they cover a box (left, bottom, right, top)."""
        (a, b, c), (d, e, f) = self.matrix
        x, y = self.center
        left, bottom, right, top = box
        to_center = np.linalg.inv(np.array([[a, b, c], [d, e, f], [0.0, 0.0, 1.0]]))
        corners = to_center @ np.array([[left, right, left, right], [bottom, bottom, top, top], [1.0, 1.0, 1.0, 1.0]])
        far = max(hypot(u - x, v - y) for u, v in corners[:2].T.tolist())
        found = []
        for sector in overlapping(self.sectors):
            reach = reach_beyond(sector, far)
            turns = [2.0 * pi * at for at in (sector.begin, sector.end)]
            points = np.array([(x, y), *((x + reach * cos(turn), y + reach * sin(turn)) for turn in turns)])
            moved = points @ np.array([[a, d], [b, e]]) + (c, f)
            paint = Paint(sector.first.color, sector.first.opacity)
            found.append((line_cubics(moved, np.roll(moved, -1, axis=0)), paint))
        return found


def sweep_courses(stops: list[Stop], places: list[float], turns: tuple[float, float], spread: Spread) -> list[Course]:
    """Return the courses of a turn, for stops at places of a ramp from one angle to another one, in turns.

    The list is empty if nothing is painted, or the ramp repeats too often.

    Examples
    --------
    >>> ends = [Stop(0.0, (0.0, 0.0, 0.0)), Stop(0.0, (1.0, 1.0, 1.0))]
    >>> found = sweep_courses(ends, [0, 1], (0.5, 0.25), Spread.PAD)
    >>> [(course.begin, course.end, course.first.color[0], course.last.color[0]) for course in found]
    [(0.0, 0.25, 1.0, 1.0), (0.25, 0.5, 1.0, 0.0), (0.5, 1.0, 0.0, 0.0)]
    """
    start, end = turns
    ends = [(start + place * (end - start), stop) for place, stop in zip(places, stops, strict=True)]
    ends = ends[::-1] if end < start else ends
    first, last = ends[0], ends[-1]
    span = last[0] - first[0]
    if spread is Spread.PAD:
        ends = [(min(first[0], 0.0), first[1]), *ends, (max(last[0], 1.0), last[1])]
    elif span * MOST_TURNS < 1.0:
        return []
    else:
        rounds = range(floor(-last[0] / span) - 1, ceil((1.0 - first[0]) / span) + 2)
        mirrored = [(first[0] + last[0] - at, stop) for at, stop in reversed(ends)]
        ends = [
            (at + span * turn, stop)
            for turn in rounds
            for at, stop in (mirrored if spread is Spread.REFLECT and turn % 2 else ends)
        ]
    courses = [Course(low, high, before, after) for (low, before), (high, after) in pairwise(ends) if high > low]
    return [course.within(0.0, 1.0) for course in courses if course.begin < 1.0 and course.end > 0.0]
