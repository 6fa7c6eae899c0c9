"""Parts of a path that have a parallel curve, or an evolute: what a stroke offsets."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.bends import MOST_CUTS, find_cuts, tangent_at
from vexture.bezier.chain import CubicChain, append_cubic, empty_chain, unit
from vexture.bezier.joins import ROUND_JOIN, StrokeStyle
from vexture.bezier.roots import cubic_at, turning_points
from vexture.bezier.split import subcubic

STRAIGHT: Final = 1e-9
"""Sine of the angle between the arms of a cubic that counts as a line."""

TINY: Final = 8.0
"""Shortest steps. A smaller part is a corner; a larger one may have an arm of zero, at a cusp."""

NOISE: Final = 1e-6
"""Length of an arm, as a share of the extent of a tiny part, that has no direction."""

SMOOTH: Final = -1
"""Kind of a join between parts of one cubic, which need none."""

STYLED: Final = -2
"""Kind of a join of the style of the stroke."""


class Parts(NamedTuple):
    """Parts of a path."""

    chain: CubicChain
    kind: NDArray[np.int64]  # (room,): kind of the join at its start
    last: NDArray[np.float64]  # (2,): where the path is


@kernel
def append_part(parts: Parts, curve: NDArray[np.float64], kind: int) -> Parts:
    """Add a part of a path."""
    count = parts.chain.length[0]
    kinds = parts.kind
    if count == len(kinds):
        kinds = np.empty(2 * count + 4, np.int64)
        for i in range(count):
            kinds[i] = parts.kind[i]
    kinds[count] = kind
    return Parts(append_cubic(parts.chain, curve), kinds, parts.last)


@kernel
def _append_straight(parts: Parts, curve: NDArray[np.float64]) -> Parts:
    """Add a cubic without area: the line between its ends and the points where it turns back."""
    far = 3
    for k in (1, 2):
        dx, dy = curve[k, 0] - curve[0, 0], curve[k, 1] - curve[0, 1]
        fx, fy = curve[far, 0] - curve[0, 0], curve[far, 1] - curve[0, 1]
        if dx * dx + dy * dy > fx * fx + fy * fy:
            far = k
    fx, fy = curve[far, 0] - curve[0, 0], curve[far, 1] - curve[0, 1]
    along, at, line = np.empty(4), np.empty(3), np.empty((4, 2))
    for k in range(4):
        along[k] = (curve[k, 0] - curve[0, 0]) * fx + (curve[k, 1] - curve[0, 1]) * fy
    count = turning_points(along[0], along[1], along[2], along[3], at)
    at[count] = 1.0
    x, y, kind = curve[0, 0], curve[0, 1], STYLED
    for k in range(count + 1):
        line[0, 0], line[0, 1] = x, y
        for axis in range(2):
            line[3, axis] = cubic_at(curve[0, axis], curve[1, axis], curve[2, axis], curve[3, axis], at[k])
            chord = line[3, axis] - line[0, axis]
            line[1, axis], line[2, axis] = line[0, axis] + chord / 3.0, line[0, axis] + chord * (2.0 / 3.0)
        if line[3, 0] != x or line[3, 1] != y:
            parts = append_part(parts, line, kind)
            x, y, kind = line[3, 0], line[3, 1], ROUND_JOIN
    return parts


@kernel(allocates=False)
def is_straight(curve: NDArray[np.float64]) -> bool:
    """Whether all arms have the same or the opposite direction."""
    ax, ay = 0.0, 0.0
    for k in range(3):
        x, y = unit(curve[k + 1, 0] - curve[k, 0], curve[k + 1, 1] - curve[k, 1])
        if ax == 0.0 and ay == 0.0:
            ax, ay = x, y
        elif abs(ax * y - ay * x) > STRAIGHT:
            return False
    return True


@kernel(allocates=False)
def _write_part(curve: NDArray[np.float64], t0: float, t1: float, shortest: float, out: NDArray[np.float64]) -> None:
    """Write the part of a cubic from t0 to t1, (4, 2), with arms that are too short to have a direction set to zero."""
    subcubic(curve, t0, t1, out)
    for k, end in ((1, 0), (2, 3)):
        if max(abs(out[k, 0] - out[end, 0]), abs(out[k, 1] - out[end, 1])) < shortest:
            out[k, 0], out[k, 1] = out[end, 0], out[end, 1]


@kernel
def _extent(curve: NDArray[np.float64], t0: float, t1: float) -> float:
    """Largest difference between a coordinate of a control point of the part of a cubic and that of its start."""
    part, far = np.empty((4, 2)), 0.0
    subcubic(curve, t0, t1, part)
    for k in range(1, 4):
        far = max(far, max(abs(part[k, 0] - part[0, 0]), abs(part[k, 1] - part[0, 1])))
    return far


@kernel
def _append_arm(parts: Parts, curve: NDArray[np.float64], at_end: bool, size: float, kind: int) -> Parts:
    """Add a line along the direction at the start of a cubic, or at its end: all that counts of a tiny part."""
    line, t, k = np.empty((4, 2)), (1.0 if at_end else 0.0), (3 if at_end else 0)
    tx, ty = tangent_at(curve, t)
    for i in range(4):
        along = size * (i / 3.0 - t)
        line[i, 0], line[i, 1] = curve[k, 0] + along * tx, curve[k, 1] + along * ty
    return append_part(parts, line, kind)


@kernel
def _append_curved(parts: Parts, curve: NDArray[np.float64], style: StrokeStyle, cuts: NDArray[np.float64]) -> Parts:
    """Add a cubic with area, cut where it slows down or bends too tightly.

    A tiny part is a corner, wherever its curve goes: a round join of the parts before and after it covers all that it
    does. At an end of the cubic it is a direction.
    """
    tiny = TINY * style.shortest
    count, begin, t0, kind = find_cuts(curve, style.half, cuts), 0.0, 0.0, STYLED
    part = np.empty((4, 2))
    for k in range(count + 1):
        t1 = cuts[k] if k < count else 1.0
        if _extent(curve, begin, t1) < tiny:
            t0 = t1
            continue
        if begin < t0:
            if begin == 0.0:
                parts = _append_arm(parts, curve, False, style.shortest, kind)
            kind = ROUND_JOIN
        size = _extent(curve, t0, t1)
        _write_part(curve, t0, t1, style.shortest if size > tiny else NOISE * size, part)
        ends = part[1, 0] == part[0, 0] and part[1, 1] == part[0, 1]
        parts = append_part(parts, part, ROUND_JOIN if ends and kind == SMOOTH else kind)
        kind, begin, t0 = SMOOTH, t1, t1
    if begin < 1.0:
        if begin == 0.0:
            parts = _append_arm(parts, curve, False, style.shortest, kind)
        parts = _append_arm(parts, curve, True, style.shortest, ROUND_JOIN)
    return parts


@kernel
def cut_path(cubics: NDArray[np.float64], style: StrokeStyle) -> Parts:
    """Parts of a path that have parallel curves, or an evolute; steps without a direction are left out."""
    parts = Parts(empty_chain(2 * len(cubics)), np.empty(2 * len(cubics), np.int64), cubics[0, 0].copy())
    curve, cuts = np.empty((4, 2)), np.empty(MOST_CUTS)
    for i in range(len(cubics)):
        size = 0.0
        for k in range(4):
            for axis in range(2):
                size = max(size, abs(cubics[i, k, axis] - parts.last[axis]))
        if size < style.shortest:
            continue
        _write_part(cubics[i], 0.0, 1.0, style.shortest, curve)
        for axis in range(2):  # after steps that were left out
            if curve[1, axis] == curve[0, axis]:
                curve[1, axis] = parts.last[axis]
            curve[0, axis] = parts.last[axis]
            parts.last[axis] = curve[3, axis]
        parts = _append_straight(parts, curve) if is_straight(curve) else _append_curved(parts, curve, style, cuts)
    return parts
