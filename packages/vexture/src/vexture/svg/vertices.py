"""Vertices of a shape, and the direction of its outline at each, for markers (SVG 2, 9.4 and 13.7)."""

from cmath import isclose
from math import inf
from typing import NamedTuple

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from vexture.svg.path_data import PathPen, Point
from vexture.svg.shapes import ShapeElement, check, path_data, shape_outlines

RIGHT = (1.0, 0.0)
"""Direction where nothing has a length."""


class Vertices(NamedTuple):
    """All vertices, in order."""

    points: NDArray[np.float64]  # (n, 2)
    angles: NDArray[np.float64]  # (n,), radians from the x axis to the y axis


def vertices(shape: ShapeElement) -> Vertices:
    """Vertices of a path, a line, a polyline or a polygon; a closed part has its first one again as its last one."""
    if etree.QName(shape.element).localname == "path":
        pen = Segments(inf)
        pen.follow(path_data(shape))
        parts = pen.parts
    else:
        parts = [
            Subpath((x, y), o.cubics, o.closed) for o in shape_outlines(shape) for x, y in o.cubics[:1, 0].tolist()
        ]
    if not parts:
        return Vertices(np.empty((0, 2)), np.empty(0))
    points = np.concatenate([part.points for part in parts])
    check(points)
    return Vertices(points, np.concatenate([part.angles for part in parts]))


class Subpath(NamedTuple):
    """A subpath, of one curve for each segment."""

    start: Point
    cubics: NDArray[np.float64]  # (n, 4, 2)
    closed: bool
    joined: bool = False  # whether its first vertex is the last one of the part before it

    @property
    def points(self) -> NDArray[np.float64]:
        """Its own vertices, (n + 1, 2) or (n, 2)."""
        ends: NDArray[np.float64] = self.cubics[:, 3]
        return ends if self.joined else np.concatenate([np.array([self.start]), ends])

    @property
    def angles(self) -> NDArray[np.float64]:
        """Direction at each of them: halfway between those of the segments there."""
        if not len(self.cubics):
            return np.zeros(1)
        leaving, arriving = (np.arctan2(found[:, 1], found[:, 0]) for found in directions(self.cubics))
        before = np.concatenate([arriving[-1:] if self.closed else leaving[:1], arriving])
        after = np.concatenate([leaving, leaving[:1] if self.closed else arriving[-1:]])
        turn = after - before
        before = before + 2.0 * np.pi * ((turn > np.pi).astype(np.float64) - (turn < -np.pi))
        halfway: NDArray[np.float64] = (before + after) / 2.0
        return halfway[1:] if self.joined else halfway


class Segments(PathPen):
    """Keeps each segment as one curve with its directions at both ends, and what paints nothing, too."""

    def __init__(self, tolerance: float) -> None:
        super().__init__(tolerance)
        self.parts: list[Subpath] = []
        self.joined: bool = False

    def draw(self, letter: str, text: str) -> None:
        """Draw a command; all but a move continue from where the part before was closed."""
        super().draw(letter, text)
        self.joined = self.joined and letter not in "Mm"

    def arc_to(self, rx: float, ry: float, rotation: float, large: bool, sweep: bool, end: Point) -> None:
        """Draw an arc as one curve that begins and ends like it."""
        first = len(self.cubics)
        super().arc_to(rx, ry, rotation, large, sweep, end)
        if len(self.cubics) > first:
            self.cubics[first:] = [self.cubics[first][:4] + self.cubics[-1][4:]]

    def close(self) -> None:
        """Close the part by a segment, which has no length if the pen is back already."""
        if self.down and isclose(complex(*self.at), complex(*self.start), rel_tol=1e-15, abs_tol=1e-15):
            self.cubics.append(self.start * 4)
        super().close()

    def finish(self, closed: bool) -> None:
        """Store the part, if there is one; it may be a point."""
        if self.down:
            self.parts.append(Subpath(self.start, np.array(self.cubics).reshape(-1, 4, 2), closed, self.joined))
            self.cubics, self.joined = [], closed


def directions(cubics: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Vectors along the start and along the end of each segment of a part, both (n, 2).

    A segment without length starts as the one before it ends, and ends as the next one starts (SVG 2, 9.4).
    """
    leaving = first_step(cubics[:, 1:] - cubics[:, :1])
    arriving = first_step(cubics[:, 3:] - cubics[:, 2::-1])
    real: NDArray[np.bool_] = (leaving != 0.0).any(axis=1)
    if real.all():
        return leaving, arriving
    if not real.any():
        return np.tile(RIGHT, (len(cubics), 1)), np.tile(RIGHT, (len(cubics), 1))
    place = np.arange(len(cubics))
    before = np.maximum.accumulate(np.where(real, place, -1))
    after = np.minimum.accumulate(np.where(real, place, len(cubics))[::-1])[::-1]
    from_before, from_after = arriving[before], leaving[np.minimum(after, len(cubics) - 1)]
    has_before, has_after = (before >= 0)[:, None], (after < len(cubics))[:, None]
    starts = np.where(has_before, from_before, from_after)
    ends = np.where(has_after, from_after, from_before)
    return np.where(real[:, None], leaving, starts), np.where(real[:, None], arriving, ends)


def first_step(steps: NDArray[np.float64]) -> NDArray[np.float64]:
    """The first of three vectors (n, 3, 2) that has a length, or zero."""
    first = np.argmax((steps != 0.0).any(axis=2), axis=1)
    step: NDArray[np.float64] = steps[np.arange(len(steps)), first]
    return step
