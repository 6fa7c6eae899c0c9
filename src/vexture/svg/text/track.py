"""The path that a `textPath` follows (SVG 2, 11.8)."""

from dataclasses import dataclass
from math import atan2
from typing import Final, NamedTuple

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from vexture.bezier.points import points_along
from vexture.svg.document import local_name
from vexture.svg.masks import Measured
from vexture.svg.outline import Outline
from vexture.svg.paint_servers import reference
from vexture.svg.path_data import path_outlines
from vexture.svg.report import described
from vexture.svg.shapes import SHAPES, Shape, shape_outlines
from vexture.svg.space import Place
from vexture.svg.transform import mapped
from vexture.svg.values import number
from vexture.tolerance import ROUND

__all__ = ["Point", "Track", "read_track"]

STEPS: Final = 64
"""Chords for each cubic: they are shorter than their arc by less than 1 / (24 STEPS^2) of it times its turn squared."""

MOST_CUBICS: Final = 20_000
"""Of a path that a text follows."""


class Point(NamedTuple):
    """A place on a path, and its direction in radians."""

    x: float
    y: float
    turn: float


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """A path as a text follows it."""

    points: NDArray[np.float64]  # (n, 2), corners of a fine polygon
    distances: NDArray[np.float64]  # (n,) along it; a jump to the next part has no length
    start: float  # where the text starts along it

    @property
    def length(self) -> float:
        """Length of all its parts."""
        return float(self.distances[-1])

    def at(self, distance: float) -> Point | None:
        """The place at a distance; None beyond its ends."""
        if not 0.0 <= distance <= self.length:
            return None
        last = min(max(int(np.searchsorted(self.distances, distance)), 1), len(self.distances) - 1)
        while last < len(self.distances) - 1 and self.distances[last] == self.distances[last - 1]:
            last += 1
        first, step = last - 1, self.distances[last] - self.distances[last - 1]
        dx, dy = (self.points[last] - self.points[first]).tolist()
        part = (distance - float(self.distances[first])) / float(step) if step else 0.0
        x, y = self.points[first].tolist()
        return Point(x + part * dx, y + part * dy, atan2(dy, dx))


def read_track(scene: Measured, element: etree._Element, place: Place) -> Track | None:
    """The path of a `textPath`; None, with a note, if it has none."""
    outlines, whole = outlines_of(scene, element, place)
    if not outlines:
        scene.report.left_out(f"{described(element)} without a path")
        return None
    count = sum(len(outline.cubics) for outline in outlines)
    if count > MOST_CUBICS:
        scene.report.left_out(f"{described(element)}, of a path of {count:,} cubics; the limit is {MOST_CUBICS:,}")
        return None
    for name, usual in (("method", "align"), ("spacing", "exact")):
        value = element.get(name, usual).strip()
        if value not in (usual, "auto"):
            scene.report.simplified(f"textPath with {name} {value[:40]} drawn with {usual}")
    points, distances = polygon(outlines)
    if element.get("side", "left").strip() == "right":
        points, distances = points[::-1], (distances[-1] - distances)[::-1]
    length = float(distances[-1])
    if not length > 0.0:
        return None
    return Track(points, distances, offset(scene, element, place, length, whole))


def outlines_of(scene: Measured, element: etree._Element, place: Place) -> tuple[list[Outline], float | None]:
    """Outlines that a `textPath` follows, in the units of its text, and the `pathLength` of their element."""
    data = element.get("path")
    if data is not None:
        outlines, valid = path_outlines(data, ROUND * place.viewport.diagonal)
        if valid < len(data):
            scene.report.invalid("path", f"...{data[valid:]}", element)
        if outlines:
            return outlines, None
    target = scene.servers.target(reference(element) or "")
    if target is None or local_name(target) not in SHAPES:
        return [], None
    style = scene.servers.style_of(target)
    shape = Shape(target, style, place.viewport, ROUND * place.viewport.diagonal, scene.report)
    outlines = shape_outlines(shape)
    matrix = scene.transform(target, style, place)
    whole = number(target.get("pathLength", ""))
    return [Outline(mapped(outline.cubics, matrix), outline.closed) for outline in outlines], whole


def polygon(outlines: list[Outline]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Corners of a polygon along outlines, and their distances from its start."""
    parts, distances, at = [], [], 0.0
    for outline in outlines:
        cubics = outline.loop if outline.closed else outline.cubics
        inner = points_along(cubics, np.linspace(0.0, 1.0, STEPS + 1)[1:]).reshape(-1, 2)
        part = np.concatenate([cubics[0, :1], inner])
        steps = np.hypot(*np.diff(part, axis=0).T)
        distance = at + np.concatenate([[0.0], np.cumsum(steps)])
        at = float(distance[-1])
        parts.append(part)
        distances.append(distance)
    return np.concatenate(parts), np.concatenate(distances)


def offset(scene: Measured, element: etree._Element, place: Place, length: float, whole: float | None) -> float:
    """Where a text starts along a path of a length, by `startOffset`; `whole` is its `pathLength`."""
    text = element.get("startOffset")
    if text is None:
        return 0.0
    start = place.viewport.length(text, length, place.style.font_size)
    if start is None:
        scene.report.invalid("startOffset", text, element)
        return 0.0
    if whole is not None and whole > 0.0 and not text.strip().endswith("%"):
        start *= length / whole
    return start
