"""Strokes as outlines to fill, computed by Skia.

Skia works in float32 and stops refining at a quarter of a unit. Its coordinates are therefore centred on the origin and
scaled so that a unit is `ROUND` of the drawing: a quarter of the error for Skia, with its rounding, and the rest for
the cubics that replace its many pieces.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np
import pathops
from numpy.typing import NDArray

from vexture.base.errors import SourceError
from vexture.base.tolerance import ROUND
from vexture.bezier.bounds import bounds
from vexture.bezier.convert import conic_cubics, straight
from vexture.bezier.reduce import reduce_contour
from vexture.svg.outline import ShapeOutline

RESOLUTION: Final = 1 / ROUND
"""Width of the drawing in Skia units."""

REFINED: Final = 0.25
"""Accuracy, in Skia units, of Skia's strokes, and of our cubics for Skia's arcs."""

SHORTEST: Final = 1 / 64
"""Shortest step in Skia units. Shorter ones have no direction in float32, so their joins would be arbitrary: such a
step is skipped, and such an arm of a control point is set to zero, so that the other one sets the direction."""

SLOWING: Final = 1 - 1 / 32
"""Parameter of a cubic with P2 = P3 from which a quadratic is within a millionth of its size."""

MOST_DASHES: Final = 100_000
"""Most dashes in one path; Skia itself silently gives up at ten times as many."""

KEPT, KEPT_CUBICS = 64, 64
"""Cached strokes for further shapes with the same outlines, and most cubics of such outlines."""

CAPS = {"butt": pathops.LineCap.BUTT_CAP, "round": pathops.LineCap.ROUND_CAP, "square": pathops.LineCap.SQUARE_CAP}
JOINS = {
    "miter": pathops.LineJoin.MITER_JOIN,
    "round": pathops.LineJoin.ROUND_JOIN,
    "bevel": pathops.LineJoin.BEVEL_JOIN,
}

NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)


@dataclass(frozen=True, slots=True)
class Stroke:
    """Style of a stroke, in the units of its path."""

    width: float
    cap: str = "butt"  # "butt", "round" or "square"
    join: str = "miter"  # "miter", "round" or "bevel"
    miter_limit: float = 4.0  # longest miter, in stroke widths
    dashes: tuple[float, ...] = ()  # alternating lengths of dashes and gaps, an even number; empty for a solid line
    dash_offset: float = 0.0  # position in the pattern at which the line starts


def arc_length(cubics: NDArray[np.float64]) -> float:
    """Return the length of cubics (n, 4, 2), by Gauss-Legendre quadrature."""
    t = (NODES + 1.0) / 2.0
    s = 1.0 - t
    blend = 3.0 * np.stack([s * s, 2.0 * s * t, t * t], axis=1)
    speed = blend @ np.diff(cubics, axis=1)
    lengths = np.sqrt((speed * speed).sum(axis=2)) @ WEIGHTS / 2.0
    return float(lengths.sum())


def stroke_contours(outlines: list[ShapeOutline], stroke: Stroke, size: float) -> list[NDArray[np.float64]]:
    """Return the contours of the stroke of outlines, to fill by the nonzero rule.

    `size` is the drawing's size in the units of the outlines, and sets the accuracy. Raise a `SourceError` if there are
    too many dashes.

    Examples
    --------
    >>> line = ShapeOutline.polygon(np.array([[0.0, 0.0], [10.0, 0.0]]), closed=False)
    >>> (contour,) = stroke_contours([line], Stroke(2.0), 10.0)
    >>> np.ptp(contour[:, 0], axis=0).round(6)
    array([10.,  2.])
    """
    if sum(len(outline.cubics) for outline in outlines) > KEPT_CUBICS:
        return compute_contours(outlines, stroke, size)
    key = tuple((outline.cubics.tobytes(), outline.closed) for outline in outlines)
    return [contour.copy() for contour in cached_contours(key, stroke, size)]


@lru_cache(KEPT)
def cached_contours(outlines: tuple[tuple[bytes, bool], ...], stroke: Stroke, size: float) -> list[NDArray[np.float64]]:
    """Return cached results of `stroke_contours`: `use` and markers often show an outline thousands of times."""
    read = [ShapeOutline(np.frombuffer(cubics).reshape(-1, 4, 2), closed) for cubics, closed in outlines]
    return compute_contours(read, stroke, size)


def compute_contours(outlines: Sequence[ShapeOutline], stroke: Stroke, size: float) -> list[NDArray[np.float64]]:
    """Return the result of `stroke_contours`, without the cache."""
    together = np.concatenate([outline.cubics for outline in outlines])
    if stroke.dashes:
        dashes = arc_length(together) / sum(stroke.dashes) * len(stroke.dashes) / 2
        if not dashes <= MOST_DASHES:
            raise SourceError(
                f"a stroke has {dashes:.3g} dashes; the limit is {MOST_DASHES:,}; lengthen stroke-dasharray"
            )
    left, low, right, high = bounds(together)
    scale = RESOLUTION / size
    middle = np.array([(left + right) / 2.0, (low + high) / 2.0])
    path = pathops.Path()
    for outline in outlines:
        feed(path, (outline.cubics - middle) * scale, outline.closed)
    path.stroke(
        stroke.width * scale,
        CAPS[stroke.cap],
        JOINS[stroke.join],
        stroke.miter_limit,
        [dash * scale for dash in stroke.dashes] or None,
        stroke.dash_offset * scale,
    )
    return [reduce_contour(contour, 1.0 - REFINED) / scale + middle for contour in read(path)]


def feed(path: pathops.Path, cubics: NDArray[np.float64], closed: bool) -> None:
    """Add an outline to Skia's path, without steps and arms that are too short for a direction."""
    ends = cubics[:, [0, 0, 3, 3]]
    cubics = np.where(np.abs(cubics - ends).max(axis=2, keepdims=True) < SHORTEST, ends, cubics)
    x0, y0 = cubics[0, 0].tolist()
    start = x0, y0
    path.moveTo(x0, y0)
    drawn = False
    for is_line, (x1, y1, x2, y2, x3, y3) in zip(
        straight(cubics).tolist(), cubics[:, 1:].reshape(-1, 6).tolist(), strict=True
    ):
        if max(abs(x1 - x0), abs(y1 - y0), abs(x2 - x0), abs(y2 - y0), abs(x3 - x0), abs(y3 - y0)) < SHORTEST:
            continue
        if is_line:
            path.lineTo(x3, y3)
        elif (x2, y2) == (x3, y3):
            feed_slowing(path, complex(x0, y0), complex(x1, y1), complex(x3, y3))
        else:
            path.cubicTo(x1, y1, x2, y2, x3, y3)
        x0, y0 = x3, y3
        drawn = True
    if not drawn:
        path.lineTo(*start)  # a point, which gets its cap from Skia
    elif closed:
        path.close()


def feed_slowing(path: pathops.Path, p0: complex, p1: complex, p3: complex) -> None:
    """Add a cubic with P2 = P3: float32 loses the direction near its end, so the last part is a quadratic."""
    b = p1 + (p3 - p1) * SLOWING
    d = p0 + (p1 - p0) * SLOWING
    d += (b - d) * SLOWING
    e = b + (p3 - b) * SLOWING
    a, f = p0 + (p1 - p0) * SLOWING, d + (e - d) * SLOWING
    path.cubicTo(a.real, a.imag, d.real, d.imag, f.real, f.imag)
    path.quadTo(e.real, e.imag, p3.real, p3.imag)


def read(path: pathops.Path) -> list[NDArray[np.float64]]:
    """Return the contours of Skia's path, closed bit for bit; Skia leaves the contours of some dashes open."""
    contours: list[list[complex]] = []
    for verb, arguments in path:
        if verb == pathops.PathVerb.MOVE:
            contours.append([complex(*arguments[0])])
        elif verb == pathops.PathVerb.CONIC:
            p1, p2, weight = complex(*arguments[0]), complex(*arguments[1]), arguments[2]
            contours[-1] += conic_cubics(contours[-1][-1], p1, p2, weight, REFINED)
        elif verb != pathops.PathVerb.CLOSE:
            contours[-1] += raise_degree([contours[-1][-1], *(complex(*point) for point in arguments)])
    return [closed_contour(points) for points in contours if len(points) > 1]


def raise_degree(points: list[complex]) -> list[complex]:
    """Return P1, P2 and P3 of the cubic that equals a line, quadratic or cubic."""
    start, end = points[0], points[-1]
    if len(points) == 2:
        return [start + (end - start) / 3.0, start + (end - start) * (2.0 / 3.0), end]
    if len(points) == 3:
        return [start + (points[1] - start) * (2.0 / 3.0), end + (points[1] - end) * (2.0 / 3.0), end]
    return points[1:]


def closed_contour(points: list[complex]) -> NDArray[np.float64]:
    """Return a contour from its first point and P1, P2, P3 of each cubic, closed by a line if necessary."""
    if abs(points[-1] - points[0]) < SHORTEST:
        points[-1] = points[0]
    else:
        points = points + raise_degree([points[-1], points[0]])
    flat = np.array(points).view(np.float64).reshape(-1, 2)
    return np.concatenate([flat[:-1:3, None], flat[1:].reshape(-1, 3, 2)], axis=1)
