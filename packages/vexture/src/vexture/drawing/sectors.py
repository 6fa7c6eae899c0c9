"""Colours that turn about a point, as sectors of flat colours: no paint of a texture turns (CSS Images 4, 3.3)."""

from dataclasses import replace
from itertools import pairwise
from math import ceil, cos, pi
from typing import Final, NamedTuple

import numpy as np

from vexture.drawing.paint import Stop

STEP: Final = 4 / 255
"""Largest difference of a channel between neighbouring sectors: each sector is exact to 2/255."""

MOST_SECTORS: Final = 180
WIDEST: Final = 1 / 8
"""Largest angle of a sector, in turns. Wider sectors are divided, so that their triangles reach beyond the box."""

BEYOND: Final = 1.01
"""Factor by which triangles reach beyond the necessary distance."""


class Course(NamedTuple):
    """A part of a turn, clockwise, in which one colour changes to another; the offsets of its stops are meaningless."""

    begin: float
    end: float
    first: Stop
    last: Stop

    def color(self, at: float) -> Stop:
        """Return the colour at a position in the course."""
        share = (at - self.begin) / (self.end - self.begin)
        return between(replace(self.first, offset=0.0), replace(self.last, offset=1.0), share)

    def within(self, low: float, high: float) -> "Course":
        """Return the part of the course within a range."""
        begin, end = max(self.begin, low), min(self.end, high)
        return Course(begin, end, self.color(begin), self.color(end))

    @property
    def change(self) -> float:
        """Largest change of a channel."""
        before, after = ((*stop.color, stop.opacity) for stop in (self.first, self.last))
        return max(abs(a - b) for a, b in zip(before, after, strict=True))

    def sectors(self, step: float) -> "list[Course]":
        """Divide the course into sectors, each in the colour of its middle."""
        count = max(ceil(self.change / step - 1e-9), ceil((self.end - self.begin) / WIDEST), 1)
        ends = np.linspace(self.begin, self.end, count + 1).tolist()
        middles = [self.color((begin + end) / 2.0) for begin, end in pairwise(ends)]
        return [Course(*pair, color, color) for pair, color in zip(pairwise(ends), middles, strict=True)]


def sectors_of(courses: list[Course]) -> list[Course]:
    """Return the sectors of courses, about as many as `MOST_SECTORS` at most."""
    count = sum(len(course.sectors(STEP)) for course in courses)
    step = STEP * max(count / MOST_SECTORS, 1.0)
    return [sector for course in courses for sector in course.sectors(step)]


def reach_beyond(sector: Course, far: float) -> float:
    """Return the length of the sides of a triangle that covers a sector, up to a distance from its point."""
    return BEYOND * far / cos(pi * (sector.end - sector.begin))


def overlapping(sectors: list[Course]) -> list[Course]:
    """Extend opaque sectors to the end of the next one, in painting order, so that no gaps show between them.

    Translucent sectors only touch, because overlaps would show.
    """
    if any(sector.first.opacity < 1.0 for sector in sectors):
        return sectors
    *others, before, last = sectors
    lowest = last._replace(begin=before.begin, end=last.end + sectors[0].end - sectors[0].begin)
    return [lowest, *(one._replace(end=after.end) for one, after in pairwise([*others, before])), before]


def between(before: Stop, after: Stop, share: float) -> Stop:
    """Interpolate between two stops."""
    opacity = before.opacity + (after.opacity - before.opacity) * share
    if opacity == 0.0:
        return Stop(before.offset + (after.offset - before.offset) * share, before.color, 0.0)
    ours, theirs = before.opacity * (1.0 - share) / opacity, after.opacity * share / opacity
    red, green, blue = (min(a * ours + b * theirs, 1.0) for a, b in zip(before.color, after.color, strict=True))
    return Stop(before.offset + (after.offset - before.offset) * share, (red, green, blue), opacity)
