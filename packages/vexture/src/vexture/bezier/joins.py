"""Joins and caps of strokes: what connects the parallel curves of a stroke."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.chain import CubicChain, append_cubic, append_line, unit
from vexture.bezier.trigonometry import QUARTER_ERROR

MITER: Final = 0
ROUND_JOIN: Final = 1
BEVEL: Final = 2
MITER_CLIP: Final = 3
"""A miter beyond its limit is cut there, instead of at the corner (SVG 2, 13.5.5)."""

ARCS: Final = 4
"""The sides go on along circles of their curvature (`vexture.bezier.arcs_join`)."""

BUTT: Final = 0
ROUND_CAP: Final = 1
SQUARE: Final = 2


SHORT_ARC: Final = 1e-7
"""One minus the cosine of the angle of an arc that is not halved further."""


class StrokeStyle(NamedTuple):
    """Style of a stroke, for kernels."""

    half: float  # half the width
    cap: int
    join: int
    limit: float  # longest miter, in widths
    tolerance: float  # largest distance of the outline from that of the true stroke
    shortest: float  # what is shorter has no direction


@kernel
def _append_arc(
    chain: CubicChain, x: float, y: float, a: NDArray[np.float64], b: NDArray[np.float64], tolerance: float
) -> CubicChain:
    """Add the arc around (x, y) between two radii (2,) that are at most a quarter turn apart, as 2^n equal cubics.

    The distance of a cubic falls with the sixth power of the angle, and (1 - cos angle)^3 is above that power.
    """
    square = a[0] * a[0] + a[1] * a[1]
    cosine, sine = (a[0] * b[0] + a[1] * b[1]) / square, (a[0] * b[1] - a[1] * b[0]) / square
    share = tolerance / (QUARTER_ERROR * np.sqrt(square))
    count, wide = 1, 1.0 - cosine
    while wide * wide * wide > share and wide > SHORT_ARC:
        half = np.sqrt((1.0 + cosine) / 2.0)
        cosine, sine = half, sine / (2.0 * half)
        count, wide = 2 * count, sine * sine / (1.0 + cosine)
    half = np.sqrt(max((1.0 + cosine) / 2.0, 0.0))
    # tan(angle / 4) by twice tan(v / 2) = sin v / (1 + cos v)
    handle = 4.0 / 3.0 * (sine / (2.0 * half)) / (1.0 + half)
    curve = np.empty((4, 2))
    rx, ry = a[0], a[1]
    for k in range(count):
        qx, qy = (rx * cosine - ry * sine, rx * sine + ry * cosine) if k < count - 1 else (b[0], b[1])
        curve[0, 0], curve[0, 1], curve[3, 0], curve[3, 1] = x + rx, y + ry, x + qx, y + qy
        curve[1, 0], curve[1, 1] = x + rx - handle * ry, y + ry + handle * rx
        curve[2, 0], curve[2, 1] = x + qx + handle * qy, y + qy - handle * qx
        chain = append_cubic(chain, curve)
        rx, ry = qx, qy
    return chain


@kernel
def append_turn(
    chain: CubicChain,
    x: float,
    y: float,
    a: NDArray[np.float64],
    b: NDArray[np.float64],
    tangent: NDArray[np.float64],
    tolerance: float,
) -> CubicChain:
    """Add the arc around (x, y) from one radius (2,) to another, at most half a turn, that begins along a tangent."""
    dot = a[0] * b[0] + a[1] * b[1]
    if dot < 0.0:
        radius = np.sqrt(a[0] * a[0] + a[1] * a[1])
        middle = np.empty(2)
        # the sum of the radii has no direction at half a turn, but their difference has
        mx, my = unit(b[1] - a[1], a[0] - b[0])
        if mx * tangent[0] + my * tangent[1] < 0.0:
            mx, my = -mx, -my
        middle[0], middle[1] = mx * radius, my * radius
        chain = _append_arc(chain, x, y, a, middle, tolerance)
        return _append_arc(chain, x, y, middle, b, tolerance)
    return _append_arc(chain, x, y, a, b, tolerance)


@kernel
def append_join(
    chain: CubicChain, x: float, y: float, ends: NDArray[np.float64], side: float, style: StrokeStyle, kind: int
) -> CubicChain:
    """Add the outer side of a join at (x, y) between the directions `ends` (2, 2); `side` is 1 on the right, else -1.

    The ratio of miter and width is 1 / cos(half the turn), and the square of this cosine is (1 + cos turn) / 2.
    """
    h = side * style.half
    a, b, t = np.empty(2), np.empty(2), np.empty(2)
    a[0], a[1], b[0], b[1] = h * ends[0, 1], -h * ends[0, 0], h * ends[1, 1], -h * ends[1, 0]
    t[0], t[1] = ends[0, 0], ends[0, 1]
    if kind == ROUND_JOIN:
        return append_turn(chain, x, y, a, b, t, style.tolerance)
    dot = ends[0, 0] * ends[1, 0] + ends[0, 1] * ends[1, 1]
    ax, ay, bx, by = x + a[0], y + a[1], x + b[0], y + b[1]
    if kind == BEVEL or (kind == MITER and not (1.0 + dot) * style.limit * style.limit >= 2.0):
        return append_line(chain, ax, ay, bx, by)
    if (1.0 + dot) * style.limit * style.limit >= 2.0:
        share = 1.0 / (1.0 + dot)
        mx, my = x + (a[0] + b[0]) * share, y + (a[1] + b[1]) * share
        chain = append_line(chain, ax, ay, mx, my)
        return append_line(chain, mx, my, bx, by)
    mx, my = unit(ends[0, 0] - ends[1, 0], ends[0, 1] - ends[1, 1])  # from the corner to its tip
    depth = a[0] * mx + a[1] * my
    step = (style.limit * style.half - depth) / (t[0] * mx + t[1] * my)
    if not step > 0.0:
        return append_line(chain, ax, ay, bx, by)
    cx, cy, dx, dy = ax + step * t[0], ay + step * t[1], bx - step * ends[1, 0], by - step * ends[1, 1]
    chain = append_line(chain, ax, ay, cx, cy)
    chain = append_line(chain, cx, cy, dx, dy)
    return append_line(chain, dx, dy, bx, by)


@kernel
def append_cap(chain: CubicChain, x: float, y: float, tx: float, ty: float, style: StrokeStyle) -> CubicChain:
    """Add the cap at the end (x, y) of a line in a direction, from its right to its left side."""
    h = style.half
    a, b, t = np.empty(2), np.empty(2), np.empty(2)
    a[0], a[1], b[0], b[1], t[0], t[1] = h * ty, -h * tx, -h * ty, h * tx, h * tx, h * ty
    if style.cap == ROUND_CAP:
        return append_turn(chain, x, y, a, b, t, style.tolerance)
    x0, y0, x1, y1 = x + a[0], y + a[1], x + b[0], y + b[1]
    if style.cap == BUTT:
        return append_line(chain, x0, y0, x1, y1)
    chain = append_line(chain, x0, y0, x0 + t[0], y0 + t[1])
    chain = append_line(chain, x0 + t[0], y0 + t[1], x1 + t[0], y1 + t[1])
    return append_line(chain, x1 + t[0], y1 + t[1], x1, y1)
