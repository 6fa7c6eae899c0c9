"""The path that a `textPath` follows (SVG 2, 11.8)."""

from dataclasses import dataclass, replace
from math import hypot, pi
from typing import Final, NamedTuple

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from vexture.base.deadline import check_time
from vexture.base.tolerance import ROUND
from vexture.bezier.points import points_along
from vexture.svg.document import local_name
from vexture.svg.links import reference
from vexture.svg.masks import MeasuredScene
from vexture.svg.outline import ShapeOutline
from vexture.svg.path_data import path_outlines
from vexture.svg.report import describe_element
from vexture.svg.shapes import SHAPES, ShapeElement, shape_outlines
from vexture.svg.space import ElementPlace
from vexture.svg.transform import map_points
from vexture.svg.values import number

STEPS: Final = 64
"""Chords per cubic: each is shorter than its arc by less than 1 / (24 STEPS^2) times the arc and its turn squared."""

PLACES: Final = np.linspace(0.0, 1.0, STEPS + 1)
VELOCITIES: Final = np.stack([(1.0 - PLACES) ** 2, 2.0 * PLACES * (1.0 - PLACES), PLACES**2])
"""Parameters at the ends of chords, and weights of the steps between control points in a third of the velocity."""

MOST_CUBICS: Final = 5_000
"""Most cubics of a path that a text follows."""


class TrackPoint(NamedTuple):
    """A position on a path, and its direction in radians."""

    x: float
    y: float
    turn: float


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """A path that a text follows, as the chords of its cubics."""

    chords: NDArray[np.float64]  # (n, 2, 2), start and end of each
    turns: NDArray[np.float64]  # (n, 2), direction of the cubic at both ends, radians, less than half a turn apart
    distances: NDArray[np.float64]  # (n,), of each end along the path; a jump to the next part has zero length
    start: float = 0.0  # distance at which the text starts

    @property
    def length(self) -> float:
        """Length of all parts."""
        return float(self.distances[-1])

    @property
    def end(self) -> tuple[float, float]:
        """Last point."""
        x, y = self.chords[-1, 1].tolist()
        return x, y

    def reversed(self) -> "Track":
        """Return the path in the opposite direction."""
        before = np.concatenate([[0.0], self.distances[:-1]])
        return Track(self.chords[::-1, ::-1], self.turns[::-1, ::-1] + pi, (self.length - before)[::-1])

    def at(self, distance: float) -> TrackPoint | None:
        """Return the position at a distance; None beyond the ends."""
        if not 0.0 <= distance <= self.length:
            return None
        k = min(int(np.searchsorted(self.distances, distance)), len(self.distances) - 1)
        (x0, y0), (x1, y1) = self.chords[k].tolist()
        first, second = self.turns[k].tolist()
        part = 1.0 - (float(self.distances[k]) - distance) / hypot(x1 - x0, y1 - y0)
        return TrackPoint(x0 + part * (x1 - x0), y0 + part * (y1 - y0), first + part * (second - first))


def read_track(scene: MeasuredScene, element: etree._Element, place: ElementPlace) -> Track | None:
    """Return the path of a `textPath`; None, with a note, if it has none."""
    check_time()
    outlines, whole = outlines_of(scene, element, place)
    if not outlines:
        scene.report.left_out(f"{describe_element(element)} without a path", element)
        return None
    count = sum(len(outline.cubics) for outline in outlines)
    if count > MOST_CUBICS:
        scene.report.left_out(
            f"{describe_element(element)}, of a path of {count:,} cubics; the limit is {MOST_CUBICS:,}", element
        )
        return None
    for name, usual in (("method", "align"), ("spacing", "exact")):
        value = element.get(name, usual).strip()
        if value not in (usual, "auto"):
            scene.report.simplification(f"textPath with {name} {value[:40]} drawn with {usual}", element)
    track = track_of(outlines)
    if track is None:
        return None
    if element.get("side", "left").strip() == "right":
        track = track.reversed()
    return replace(track, start=offset(scene, element, place, track.length, whole))


def outlines_of(
    scene: MeasuredScene, element: etree._Element, place: ElementPlace
) -> tuple[list[ShapeOutline], float | None]:
    """Return the outlines that a `textPath` follows, in the text's units, and the `pathLength` of their element."""
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
    shape = ShapeElement(target, style, place.viewport, ROUND * place.viewport.diagonal, scene.report)
    outlines = shape_outlines(shape)
    matrix = scene.transform(target, style, place)
    whole = number(target.get("pathLength", ""))
    return [ShapeOutline(map_points(outline.cubics, matrix), outline.closed) for outline in outlines], whole


def track_of(outlines: list[ShapeOutline]) -> Track | None:
    """Return outlines as a path that a text can follow; None if it has zero length."""
    cubics = np.concatenate([outline.loop if outline.closed else outline.cubics for outline in outlines])
    points = points_along(cubics, PLACES)
    chords = np.stack([points[:, :-1], points[:, 1:]], axis=2).reshape(-1, 2, 2)
    steps = chords[:, 1] - chords[:, 0]
    lengths = np.hypot(*steps.T)
    velocities = np.einsum("kt,mkc->mtc", VELOCITIES, np.diff(cubics, axis=1))
    both = np.stack([velocities[:, :-1], velocities[:, 1:]], axis=2).reshape(-1, 2, 2)
    real = lengths > 0.0
    if not real.any():
        return None
    straight = np.arctan2(steps[:, 1], steps[:, 0])[:, None]
    away = np.arctan2(both[..., 1], both[..., 0]) - straight
    away = np.where((both == 0.0).all(axis=2), 0.0, (away + pi) % (2.0 * pi) - pi)
    return Track(chords[real], (straight + away)[real], np.cumsum(lengths[real]))


def offset(
    scene: MeasuredScene, element: etree._Element, place: ElementPlace, length: float, whole: float | None
) -> float:
    """Return the distance at which a text starts on a path, by `startOffset`; `whole` is its `pathLength`."""
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
