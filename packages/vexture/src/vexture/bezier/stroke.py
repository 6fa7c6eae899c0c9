"""The outline of a stroke, as contours to fill by the non-zero rule, in float64.

A stroke is a band between the parallel curves of its path, which `vexture.bezier.offset` makes, with joins and caps.
Where an inner side overlaps itself, its contour goes through the path's point. The contour is then a sum of bands and
wedges that are all wound the same way, so that no place of the stroke is left out (Nehab, "Converting stroked
primitives to filled primitives", ACM TOG 39, 2020).

The reader of SVG does not use it yet: dashes and `arcs` joins are missing, and it makes more cubics than Skia.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.joins import BUTT, ROUND_JOIN, StrokeStyle, append_cap, append_join
from vexture.bezier.offset import (
    MOST_CUTS,
    CubicChain,
    append_cubic,
    append_evolute,
    append_line,
    append_offset,
    empty_chain,
    find_cuts,
    tangent_at,
    tightness_at,
    unit,
    write_part,
    write_side,
)
from vexture.bezier.roots import cubic_at, turning_points, velocity_at
from vexture.bezier.split import copy_curve, split

STRAIGHT: Final = 1e-9
"""Sine of the angle between the arms of a cubic that counts as a line."""

SMOOTH: Final = -1
"""Kind of a join between parts of one cubic, which need none."""

STYLED: Final = -2
"""Kind of a join of the style of the stroke."""

STEPS: Final = 12
"""Newton steps that find where the inner sides of a join cross."""


class Parts(NamedTuple):
    """Parts of a path."""

    chain: CubicChain
    kind: NDArray[np.int64]  # (room,): kind of the join at its start
    last: NDArray[np.float64]  # (2,): where the path is


@kernel
def _append_part(parts: Parts, curve: NDArray[np.float64], kind: int) -> Parts:
    """Add a part of a path."""
    count = parts.chain.length[0]
    kinds = parts.kind
    if count == len(kinds):
        kinds = np.empty(2 * count + 4, np.int64)
        kinds[:count] = parts.kind
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
            parts = _append_part(parts, line, kind)
            x, y, kind = line[3, 0], line[3, 1], ROUND_JOIN
    return parts


@kernel(allocates=False)
def _is_straight(curve: NDArray[np.float64]) -> bool:
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
def is_moving(curve: NDArray[np.float64]) -> bool:
    """Whether a cubic is more than a point."""
    for k in range(1, 4):
        if curve[k, 0] != curve[0, 0] or curve[k, 1] != curve[0, 1]:
            return True
    return False


@kernel
def cut_path(cubics: NDArray[np.float64], style: StrokeStyle) -> Parts:
    """Parts of a path that have parallel curves, or an evolute; steps without a direction are left out."""
    parts = Parts(empty_chain(2 * len(cubics)), np.empty(2 * len(cubics), np.int64), cubics[0, 0].copy())
    curve, part, cuts = np.empty((4, 2)), np.empty((4, 2)), np.empty(MOST_CUTS)
    for i in range(len(cubics)):
        size = 0.0
        for k in range(4):
            for axis in range(2):
                size = max(size, abs(cubics[i, k, axis] - parts.last[axis]))
        if size < style.shortest:
            continue
        write_part(cubics[i], 0.0, 1.0, style.shortest, curve)
        for axis in range(2):  # after steps that were left out
            if curve[1, axis] == curve[0, axis]:
                curve[1, axis] = parts.last[axis]
            curve[0, axis] = parts.last[axis]
            parts.last[axis] = curve[3, axis]
        if _is_straight(curve):
            parts = _append_straight(parts, curve)
            continue
        count, t0, kind = find_cuts(curve, style.half, cuts), 0.0, STYLED
        for k in range(count + 1):
            t1 = cuts[k] if k < count else 1.0
            if t1 <= t0:
                continue
            write_part(curve, t0, t1, style.shortest, part)
            if is_moving(part):
                ends = part[1, 0] == part[0, 0] and part[1, 1] == part[0, 1]
                parts = _append_part(parts, part, ROUND_JOIN if ends and kind == SMOOTH else kind)
                kind = SMOOTH
            t0 = t1
    return parts


@kernel
def _side_of(parts: Parts, side: float, style: StrokeStyle, starts: NDArray[np.int64]) -> CubicChain:
    """Offset each part to the right (side 1) or left (-1); write where the cubics of each begin (n + 1,)."""
    curves, n = parts.chain.cubics, parts.chain.length[0]
    chain, ends = empty_chain(2 * n + 4), np.empty((2, 4))
    for i in range(n):
        starts[i] = chain.length[0]
        middle = -side * tightness_at(curves[i], style.half, 0.5)
        if _is_straight(curves[i]):
            write_side(curves[i], side * style.half, 0.0, ends[0])
            write_side(curves[i], side * style.half, 1.0, ends[1])
            chain = append_line(chain, ends[0, 0], ends[0, 1], ends[1, 0], ends[1, 1])
        elif middle > 1.0:
            chain = append_evolute(chain, curves[i], side * style.half)
        else:
            chain = append_offset(chain, curves[i], side * style.half, style.tolerance)
    starts[n] = chain.length[0]
    return chain


@kernel
def _trim_crossing(before: NDArray[np.float64], after: NDArray[np.float64]) -> bool:
    """Cut two cubics where they cross, if Newton's method finds that from the end of one and the start of the other."""
    t, u, size = 1.0, 0.0, 0.0
    for k in range(4):
        size = max(size, max(abs(before[k, 0] - before[3, 0]), abs(before[k, 1] - before[3, 1])))
    x = y = 0.0
    for _ in range(STEPS):
        x = cubic_at(before[0, 0], before[1, 0], before[2, 0], before[3, 0], t)
        y = cubic_at(before[0, 1], before[1, 1], before[2, 1], before[3, 1], t)
        ox = cubic_at(after[0, 0], after[1, 0], after[2, 0], after[3, 0], u) - x
        oy = cubic_at(after[0, 1], after[1, 1], after[2, 1], after[3, 1], u) - y
        ax = velocity_at(before[0, 0], before[1, 0], before[2, 0], before[3, 0], t)
        ay = velocity_at(before[0, 1], before[1, 1], before[2, 1], before[3, 1], t)
        bx = velocity_at(after[0, 0], after[1, 0], after[2, 0], after[3, 0], u)
        by = velocity_at(after[0, 1], after[1, 1], after[2, 1], after[3, 1], u)
        if max(abs(ox), abs(oy)) <= 1e-12 * size:
            if not (0.0 < t < 1.0 and 0.0 < u < 1.0):
                return False
            split(before, t, before, np.empty((4, 2)))
            split(after, u, np.empty((4, 2)), after)
            after[0, 0], after[0, 1] = before[3, 0], before[3, 1]
            return True
        cross = ax * by - ay * bx
        if cross == 0.0:
            return False
        t, u = t + (ox * by - oy * bx) / cross, u + (ox * ay - oy * ax) / cross
        if not (-0.5 < t < 1.5 and -0.5 < u < 1.5):
            return False
    return False


@kernel
def _connect(
    chain: CubicChain,
    corner: NDArray[np.float64],
    ends: NDArray[np.float64],
    to: NDArray[np.float64],
    side: float,
    style: StrokeStyle,
    kind: int,
) -> CubicChain:
    """Add what connects a side, which ends at the last point of the chain, to the start `to` of the next part."""
    last = chain.cubics[chain.length[0] - 1, 3]
    lx, ly, h = last[0], last[1], side * style.half
    if lx == to[0] and ly == to[1]:
        return chain
    turn = ends[0, 0] * ends[1, 1] - ends[0, 1] * ends[1, 0]
    forward = ends[0, 0] * ends[1, 0] + ends[0, 1] * ends[1, 1] > 0.0
    if (kind == SMOOTH and forward) or (forward and style.half * abs(turn) <= style.tolerance):
        return append_line(chain, lx, ly, to[0], to[1])
    outer = side * turn > 0.0 or (turn == 0.0 and side > 0.0)
    if not outer:
        chain = append_line(chain, lx, ly, corner[0], corner[1])
        return append_line(chain, corner[0], corner[1], to[0], to[1])
    chain = append_line(chain, lx, ly, corner[0] + h * ends[0, 1], corner[1] - h * ends[0, 0])
    chain = append_join(chain, corner[0], corner[1], ends, side, style, ROUND_JOIN if kind == SMOOTH else kind)
    return append_line(chain, corner[0] + h * ends[1, 1], corner[1] - h * ends[1, 0], to[0], to[1])


@kernel
def _join_side(
    parts: Parts, offset: CubicChain, starts: NDArray[np.int64], side: float, closed: bool, style: StrokeStyle
) -> CubicChain:
    """One side of a stroke, with its joins; closed, if the path is."""
    curves, n = parts.chain.cubics, parts.chain.length[0]
    ends = np.empty((n, 2, 2))
    for i in range(n):
        ends[i, 0, 0], ends[i, 0, 1] = tangent_at(curves[i], 0.0)
        ends[i, 1, 0], ends[i, 1, 1] = tangent_at(curves[i], 1.0)
    for i in range(n if closed else n - 1):
        k = (i + 1) % n
        a, b = ends[i, 1], ends[k, 0]
        turn = side * (a[0] * b[1] - a[1] * b[0])
        whole = starts[i + 1] > starts[i] and starts[k + 1] > starts[k] and i != k
        if parts.kind[k] != SMOOTH and turn < 0.0 and whole:
            _trim_crossing(offset.cubics[starts[i + 1] - 1], offset.cubics[starts[k]])
    chain = empty_chain(2 * offset.length[0] + 8)
    turning, full, to = np.empty((2, 2)), np.empty(4), np.empty(2)
    for i in range(n):
        for k in range(starts[i], starts[i + 1]):
            chain = append_cubic(chain, offset.cubics[k])
        if starts[i] == starts[i + 1]:  # the evolute of an arc of a circle is a point
            write_side(
                curves[i], side * style.half / max(abs(tightness_at(curves[i], style.half, 0.5)), 1.0), 0.5, full
            )
            point = np.empty((4, 2))
            for m in range(4):
                point[m, 0], point[m, 1] = full[0], full[1]
            chain = append_cubic(chain, point)
        k = (i + 1) % n
        if k == 0 and not closed:
            break
        for axis in range(2):
            turning[0, axis], turning[1, axis] = ends[i, 1, axis], ends[k, 0, axis]
            to[axis] = offset.cubics[starts[k], 0, axis] if starts[k + 1] > starts[k] else curves[k, 0, axis]
        if k == 0:
            to[0], to[1] = chain.cubics[0, 0, 0], chain.cubics[0, 0, 1]
        kind = style.join if parts.kind[k] == STYLED else parts.kind[k]
        chain = _connect(chain, curves[i, 3], turning, to, side, style, kind)
    return chain


@kernel
def _append_reversed(chain: CubicChain, other: CubicChain) -> CubicChain:
    """Add the cubics of a chain backwards."""
    curve = np.empty((4, 2))
    for i in range(other.length[0] - 1, -1, -1):
        for k in range(4):
            curve[k, 0], curve[k, 1] = other.cubics[i, 3 - k, 0], other.cubics[i, 3 - k, 1]
        chain = append_cubic(chain, curve)
    return chain


@kernel
def _cap_end(
    chain: CubicChain, curve: NDArray[np.float64], forward: bool, style: StrokeStyle, to: NDArray[np.float64]
) -> CubicChain:
    """Add the cap at an end of a part, from the last point of the chain to the point `to`."""
    tx, ty = tangent_at(curve, 1.0 if forward else 0.0)
    k = 3 if forward else 0
    if not forward:
        tx, ty = -tx, -ty
    x, y, h = curve[k, 0], curve[k, 1], style.half
    last = chain.cubics[chain.length[0] - 1, 3]
    chain = append_line(chain, last[0], last[1], x + h * ty, y - h * tx)
    chain = append_cap(chain, x, y, tx, ty, style)
    return append_line(chain, x - h * ty, y + h * tx, to[0], to[1])


@kernel
def append_dot(chain: CubicChain, x: float, y: float, tx: float, ty: float, style: StrokeStyle) -> CubicChain:
    """Add the two caps of a line of no length in a direction; nothing for butt caps."""
    if style.cap != BUTT:
        chain = append_cap(chain, x, y, tx, ty, style)
        chain = append_cap(chain, x, y, -tx, -ty, style)
    return chain


@kernel
def close_chain(chain: CubicChain) -> NDArray[np.float64]:
    """Contour (n, 4, 2) of a chain without points, closed bit for bit."""
    out, count = np.empty((chain.length[0], 4, 2)), 0
    for i in range(chain.length[0]):
        if is_moving(chain.cubics[i]):
            copy_curve(chain.cubics[i], out[count])
            count += 1
    for i in range(count):
        out[i, 0, 0], out[i, 0, 1] = out[i - 1 if i else count - 1, 3, 0], out[i - 1 if i else count - 1, 3, 1]
    return out[:count].copy()


@kernel
def stroke_path(
    cubics: NDArray[np.float64], closed: bool, style: StrokeStyle
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Contours of the stroke of consecutive cubics (n, 4, 2), to fill by the non-zero rule: (m, 4, 2) and (k, 4, 2).

    An open path has one contour; the second one is empty then. Each cubic starts where the one before it ends.
    """
    parts = cut_path(cubics, style)
    n = parts.chain.length[0]
    if n == 0:
        return close_chain(append_dot(empty_chain(8), cubics[0, 0, 0], cubics[0, 0, 1], 1.0, 0.0, style)), np.empty(
            (0, 4, 2)
        )
    curves = parts.chain.cubics
    gap = max(abs(curves[n - 1, 3, 0] - curves[0, 0, 0]), abs(curves[n - 1, 3, 1] - curves[0, 0, 1]))
    if closed and gap >= style.shortest:
        line = append_line(empty_chain(1), curves[n - 1, 3, 0], curves[n - 1, 3, 1], curves[0, 0, 0], curves[0, 0, 1])
        parts = _append_part(parts, line.cubics[0], STYLED)
        n, curves = n + 1, parts.chain.cubics
    starts = np.empty(n + 1, np.int64)
    right = _join_side(parts, _side_of(parts, 1.0, style, starts), starts, 1.0, closed, style)
    left = _join_side(parts, _side_of(parts, -1.0, style, starts), starts, -1.0, closed, style)
    if closed:
        return close_chain(right), close_chain(_append_reversed(empty_chain(left.length[0] + 1), left))
    chain = _cap_end(right, curves[n - 1], True, style, left.cubics[left.length[0] - 1, 3])
    chain = _append_reversed(chain, left)
    chain = _cap_end(chain, curves[0], False, style, right.cubics[0, 0])
    return close_chain(chain), np.empty((0, 4, 2))
