"""Bands of a gradient: the parts of its ramp between two jumps of colour, each a gradient without a jump.

A hard stop is an edge, and so is the place where a ramp repeats. A path with such a gradient is cut along these edges
when the map is built. They are stored like outlines, and are exact at every scale. Between them the ramp is smooth.
"""

from enum import IntEnum
from itertools import groupby, pairwise
from math import ceil, floor
from operator import itemgetter
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.convert import ellipse_cubics, line_cubics, turn_steps
from vexture.drawing.paint import Affine, Gradient, Spread, Stop
from vexture.drawing.unit_square import clip_contours

MOST_BANDS: Final = 1024
"""Most bands. More are finer than the pixels of most pictures, and a shader averages the ramp across its jumps
instead."""

STEEP: Final = 1 / 64
"""Unit-square units. A ramp that changes within a shorter length is cut at its stops, because a pixel may hold the
whole change, and only edges are exact there."""

ROUND: Final = 1e-8
"""Largest distance of a cubic from its arc, in unit-square units."""

CLOSE: Final = 1e-9
"""Radii. Focal circles within this distance of touching the outer circle touch it, and places on a ramp within this
distance are one."""

Box = NDArray[np.float64]
"""Least and greatest coordinates, (2, 2)."""


class Bands(NamedTuple):
    """The bands of a gradient in a box. Band k applies where k of the regions contain the point."""

    gradients: tuple[Gradient, ...]
    regions: tuple[NDArray[np.float64], ...]  # closed contours, each with the next one inside


class Knot(NamedTuple):
    """A place on an unrolled ramp, the stop that ends the part before it and the stop that begins the part after."""

    place: float
    before: Stop
    after: Stop


def bands_of(gradient: Gradient, box: Box, at_all_stops: bool = False) -> Bands:
    """Bands of a gradient in a box; one band without regions if the ramp does not jump there, or jumps too often.

    With `at_all_stops` soft stops separate bands, too, because the blended ramp may jump there.

    Examples
    --------
    >>> black, white = Stop(0.5, (0, 0, 0)), Stop(0.5, (1, 1, 1))
    >>> halves = Gradient(((1, 0, 0), (0, 1, 0)), (black, white))
    >>> [len(part.stops) for part in bands_of(halves, np.array([[0, 0], [1, 1]])).gradients]
    [1, 1]
    """
    kind = _kind(gradient)
    if kind is RampShape.FLAT:
        return Bands((gradient,), ())
    if kind is RampShape.NESTED:
        gradient = _outwards(gradient)
    nothing = Gradient(gradient.to_ramp, (Stop(0.0, (0.0, 0.0, 0.0), 0.0),))
    around = Bands((nothing,), (_cone(gradient, box),)) if kind >= RampShape.TOUCHING else Bands((), ())
    grows = gradient.focus is None or gradient.focus[1] < 1.0
    found = _within(gradient, kind, box, at_all_stops) if grows else Bands((gradient,), ())
    return Bands(around.gradients + found.gradients, around.regions + found.regions)


class RampShape(IntEnum):
    """Shape of the lines of equal colour: a point, lines, nested circles, touching circles, or circles of a cone."""

    FLAT = 0
    LINES = 1
    NESTED = 2
    TOUCHING = 3
    CONE = 4


def _kind(gradient: Gradient) -> RampShape:
    (a, b, _), (d, e, _) = gradient.to_ramp
    if gradient.focus is None:
        return RampShape.LINES if a != 0.0 or b != 0.0 else RampShape.FLAT
    if a * e - b * d == 0.0:
        return RampShape.FLAT
    focus, radius = gradient.focus
    beyond = focus - abs(1.0 - radius)
    return (
        RampShape.NESTED
        if beyond < -CLOSE
        else RampShape.TOUCHING
        if beyond <= CLOSE and radius != 1.0
        else RampShape.CONE
    )


def _outwards(gradient: Gradient) -> Gradient:
    """Rewrite a gradient of nested circles so that its last circle is the largest."""
    if gradient.focus is None or gradient.focus[1] < 1.0:
        return gradient
    (a, b, c), (d, e, f), (focus, radius) = *gradient.to_ramp, gradient.focus
    rows = (-a / radius, -b / radius, (focus - c) / radius), (d / radius, e / radius, f / radius)
    stops = tuple(Stop(1.0 - stop.offset, stop.color, stop.opacity) for stop in gradient.stops[::-1])
    return Gradient(rows, stops, gradient.spread, (focus / radius, 1.0 / radius))


def _within(gradient: Gradient, kind: RampShape, box: Box, at_all_stops: bool) -> Bands:
    """Bands of a gradient in the part of a box that it paints."""
    whole = Bands((gradient,), ())
    low, high = _reach(gradient, kind, box)
    if gradient.spread is not Spread.PAD and high - low > MOST_BANDS:
        return whole
    knots = _between(_going_on(gradient, low, high), low, high)
    steep = np.inf if at_all_stops else _places_in(gradient, kind, STEEP)
    parts = [k for k, knot in enumerate(knots) if _jumps(knot) or _is_beside_ramp(knots, k, steep)]
    parts = [k for k in parts if low < knots[k].place < high]
    at_side = [knot for knot in knots if 0.0 <= max(low - knot.place, knot.place - high) < CLOSE]
    is_cut = len(parts) > 0 or (gradient.spread is Spread.PAD and any(map(_jumps, at_side)))
    if not is_cut or len(parts) >= MOST_BANDS:
        return whole
    bands = [
        _band(gradient, knots[a : b + 1], k > 0 or knots[a].place <= low, k < len(parts) or knots[b].place >= high)
        for k, (a, b) in enumerate(pairwise([0, *parts, len(knots) - 1]))
    ]
    regions = [_region(gradient, kind, knots[k].place, box) for k in parts]
    if kind is not RampShape.LINES:  # each lies in the next one
        bands, regions = bands[::-1], regions[::-1]
        regions = regions[: next((k for k, one in enumerate(regions) if len(one) == 0), len(regions))]
    return Bands(tuple(bands[: len(regions) + 1]), tuple(regions))


def _differ(one: Stop, other: Stop) -> bool:
    """Whether two stops differ visibly."""
    return (one.color, one.opacity) != (other.color, other.opacity) and max(one.opacity, other.opacity) > 0.0


def _jumps(knot: Knot) -> bool:
    """Whether the colour jumps at a knot."""
    return _differ(knot.before, knot.after)


def _is_beside_ramp(knots: list[Knot], k: int, most: float) -> bool:
    """Whether the colour changes between a knot and the one before or after, less than `most` places away."""
    beside = pairwise(knots[max(k - 1, 0) : k + 2])
    return any(_differ(one.after, other.before) and other.place - one.place < most for one, other in beside)


def _places_in(gradient: Gradient, kind: RampShape, length: float) -> float:
    """Length of a ramp that a length of the unit square spans; approximate for circles with several centres."""
    rows = np.array(gradient.to_ramp)[: 1 if kind is RampShape.LINES else 2, :2]
    grows = 1.0 if gradient.focus is None else 1.0 - gradient.focus[1]
    return length * float(np.linalg.norm(rows, 2)) / grows


def _reach(gradient: Gradient, kind: RampShape, box: Box) -> tuple[float, float]:
    """Lower and upper bound of the places on the ramp in a box; for circles, the lower is where the radius is 0."""
    corners = np.array([(x, y, 1.0) for x in box[:, 0] for y in box[:, 1]]) @ np.array(gradient.to_ramp).T
    if gradient.focus is None:
        return float(corners[:, 0].min()), float(corners[:, 0].max())
    focus, radius = gradient.focus
    grows = 1.0 - radius
    if kind is RampShape.TOUCHING:
        return -np.inf, np.inf
    if kind is RampShape.NESTED:
        return -radius / grows, max(_place(focus, radius, x, y) for x, y in corners.tolist())
    # the distance of a circle of radius r from the tip is r (focus / grows - 1)
    away = float(np.linalg.norm(corners - (focus / grows, 0.0), axis=1).max())
    return -radius / grows, (away / (focus / grows - 1.0) - radius) / grows


def _place(focus: float, radius: float, x: float, y: float) -> float:
    """Place of a point on the ramp of nested circles: the greatest root, as in FORMAT.md, D.6."""
    grows = 1.0 - radius
    a = focus * focus - grows * grows
    b = radius * grows - (x - focus) * focus
    c = (x - focus) ** 2 + y * y - radius * radius
    return float((b - np.sqrt(max(b * b - a * c, 0.0))) / a)


def _going_on(gradient: Gradient, low: float, high: float) -> list[Knot]:
    """Knots of a ramp in order, including those of all repetitions that meet an interval."""
    own = list(gradient.stops)
    if gradient.spread is Spread.PAD:
        return _knots([(stop.offset, stop) for stop in own])
    own = [Stop(0.0, own[0].color, own[0].opacity), *own, Stop(1.0, own[-1].color, own[-1].opacity)]
    placed: list[tuple[float, Stop]] = []
    for period in range(floor(low), ceil(high) + 1):
        if gradient.spread is Spread.REFLECT and period % 2 == 1:
            placed += [(period + 1.0 - stop.offset, stop) for stop in own[::-1]]
        else:
            placed += [(period + stop.offset, stop) for stop in own]
    return _knots(placed)


def _between(knots: list[Knot], low: float, high: float) -> list[Knot]:
    """The knots in an interval, and the next one on each side."""
    first = max((k for k, knot in enumerate(knots) if knot.place <= low), default=0)
    last = min((k for k, knot in enumerate(knots) if knot.place >= high), default=len(knots) - 1)
    return knots[first : last + 1]


def _knots(placed: list[tuple[float, Stop]]) -> list[Knot]:
    """The knots of stops at their places, in order."""
    alike = [[*group] for _, group in groupby(placed, key=itemgetter(0))]
    return [Knot(group[0][0], group[0][1], group[-1][1]) for group in alike]


def _band(gradient: Gradient, knots: list[Knot], is_begun: bool, is_ended: bool) -> Gradient:
    """Gradient of the part of a ramp between two knots, padded, with places from 0 to 1.

    If `is_begun`, only the later side of the first knot belongs to the part; if `is_ended`, only the earlier side of
    the last knot does.
    """
    placed = [(knot.place, stop) for knot in knots for stop in (knot.before, knot.after)]
    placed = placed[1 if is_begun else 0 : -1 if is_ended else len(placed)]
    stops = [stop for _, stop in placed]
    if all(not _differ(stops[0], stop) for stop in stops):
        return Gradient(gradient.to_ramp, (Stop(0.0, stops[0].color, stops[0].opacity),), focus=gradient.focus)
    placed = [one for k, one in enumerate(placed) if k == 0 or one != placed[k - 1]]
    if gradient.spread is Spread.PAD and _kind(gradient) is RampShape.TOUCHING:  # float32 would part circles that touch
        return Gradient(gradient.to_ramp, tuple(stop for _, stop in placed), focus=gradient.focus)
    if gradient.focus is not None:
        placed = _from(placed, -gradient.focus[1] / (1.0 - gradient.focus[1]))
    start, end = placed[0][0], placed[-1][0]
    to_ramp, focus = _stretch_ramp(gradient, start, end)
    shares = [min(max((place - start) / (end - start), 0.0), 1.0) for place, _ in placed]
    moved = tuple(Stop(at, stop.color, stop.opacity) for at, (_, stop) in zip(shares, placed, strict=True))
    return Gradient(to_ramp, moved, focus=focus)


def _from(placed: list[tuple[float, Stop]], start: float) -> list[tuple[float, Stop]]:
    """Stops of a ramp from a place on, at which the radius of the circle is 0."""
    first = next(k for k, (place, _) in enumerate(placed) if place > start)
    if first == 0:
        return placed
    (low, one), (high, other) = placed[first - 1 : first + 1]
    share = (start - low) / (high - low)
    red, green, blue = ((1.0 - share) * a + share * b for a, b in zip(one.color, other.color, strict=True))
    opacity = (1.0 - share) * one.opacity + share * other.opacity
    return [(start, Stop(0.0, (red, green, blue), opacity)), *placed[first:]]


def _stretch_ramp(gradient: Gradient, start: float, end: float) -> tuple[Affine, tuple[float, float] | None]:
    """Compute the map and focus of a gradient that spans the part from `start` to `end` of another gradient."""
    (a, b, c), (d, e, f) = gradient.to_ramp
    size = end - start
    if gradient.focus is None:
        return ((a / size, b / size, (c - start) / size), (d, e, f)), None
    focus, radius = gradient.focus
    inner, outer = radius + (1.0 - radius) * start, radius + (1.0 - radius) * end
    move = focus * (1.0 - end)  # middle of the outer circle
    rows = (a / outer, b / outer, (c - move) / outer), (d / outer, e / outer, f / outer)
    return rows, (focus * size / outer, max(inner / outer, 0.0))


def _region(gradient: Gradient, kind: RampShape, place: float, box: Box) -> NDArray[np.float64]:
    """Contour of the part of a box that is beyond a place on a linear ramp, or before a place on a radial one."""
    (a, b, c), (d, e, _) = gradient.to_ramp
    if gradient.focus is None:
        return _beyond(np.array([a, b]), place - c, box)
    focus, radius = gradient.focus
    middle, size = focus * (1.0 - place), radius + (1.0 - radius) * place
    if size <= 0.0:
        return np.zeros((0, 4, 2))
    tolerance = ROUND * float(np.linalg.norm([[a, b], [d, e]], -2))
    if kind is not RampShape.CONE:
        return _from_ramp(gradient, ellipse_cubics((middle, 0.0), (size, size), tolerance), box)
    # in a cone, the places before one lie between its tip and the arc of the circle that faces it
    tip, turn = focus / (1.0 - radius), np.arccos((1.0 - radius) / focus)
    steps = turn_steps(2.0 * turn, size, tolerance)
    angles = np.linspace(-turn, turn, steps + 1)
    ends = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    handles = 4.0 / 3.0 * np.tan(turn / (2.0 * steps)) * np.stack([-ends[:, 1], ends[:, 0]], axis=1)
    arc = np.stack([ends[:-1], ends[:-1] + handles[:-1], ends[1:] - handles[1:], ends[1:]], axis=1)
    arc = size * arc + (middle, 0.0)
    corner = np.array([[tip, 0.0]])
    sides = line_cubics(np.stack([arc[-1, 3], corner[0]]), np.stack([corner[0], arc[0, 0]]))
    return _from_ramp(gradient, np.concatenate([arc, sides]), box)


def _cone(gradient: Gradient, box: Box) -> NDArray[np.float64]:
    """Part of a box that the circles sweep: a half-plane if they touch, a strip if they are equal, else a cone."""
    assert gradient.focus is not None
    focus, radius = gradient.focus
    grows = 1.0 - radius
    sine = min(abs(grows) / focus, 1.0)
    corners = np.array([(x, y, 1.0) for x in box[:, 0] for y in box[:, 1]]) @ np.array(gradient.to_ramp).T
    tip = np.array([focus / grows if grows != 0.0 else 0.0, 0.0])
    far = 4.0 * float(np.abs(corners - tip).max())
    away = np.array([-far if grows > 0.0 else far, 0.0])  # the circles are larger there
    if grows == 0.0:
        points = np.array([(-far, 1.0), (far, 1.0), (far, -1.0), (-far, -1.0)])
    else:
        up = (1.0 - sine * sine) ** 0.5 * away + (0.0, sine * far)
        down = up * (1.0, -1.0)
        points = tip + np.array([0.0 * up, up, up + away, down + away, down])
    return _from_ramp(gradient, line_cubics(points, np.roll(points, -1, axis=0)), box)


def _from_ramp(gradient: Gradient, contour: NDArray[np.float64], box: Box) -> NDArray[np.float64]:
    """Map a contour from the ramp's plane to the unit square and clip it to a box; empty if it lies outside."""
    (a, b, c), (d, e, f) = gradient.to_ramp
    contour = (contour - (c, f)) @ np.linalg.inv([[a, b], [d, e]]).T
    if (contour.min(axis=(0, 1)) >= box[1]).any() or (contour.max(axis=(0, 1)) <= box[0]).any():
        return contour[:0]
    contour, _ = clip_contours(contour, np.array([len(contour)]), box[0], box[1])
    contour[:, 3] = np.roll(contour[:, 0], -1, axis=0)
    return contour


def _beyond(normal: NDArray[np.float64], level: float, box: Box) -> NDArray[np.float64]:
    """Contour of the part of a box in which a linear function is at least `level` (Sutherland and Hodgman, 1974)."""
    (x0, y0), (x1, y1) = box.tolist()
    corners = [np.array(corner) for corner in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]
    found: list[NDArray[np.float64]] = []
    for one, other in pairwise([*corners, corners[0]]):
        p, q = float(normal @ one) - level, float(normal @ other) - level
        found += [one] if p >= 0.0 else []
        found += [np.clip(one + (other - one) * (p / (p - q)), box[0], box[1])] if (p >= 0.0) != (q >= 0.0) else []
    points = np.array(found).reshape(-1, 2)
    return line_cubics(points, np.roll(points, -1, axis=0))
