"""The sides of a stroke: parallel curves of the parts of a path, with joins, and without what they cut off each other.

On the inner side of a tight bend, where a parallel curve would go backwards, a side follows the evolute, the curve of
the centres of curvature: the nearest point of a curve is never farther than its centre of curvature, so that the band
between both sides covers all of the stroke, and covers no place backwards (Nehab, "Converting stroked primitives to
filled primitives", ACM TOG 39, 2020). Inside of an evolute, places are covered twice. A chord from where the bend
becomes tight to where it ends is therefore enough, if the bend is less than half a turn; and if the curves before and
after the bend cross, all between their crossing can go, as at the inner side of a corner.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.arcs_join import append_arcs
from vexture.bezier.bends import tangent_at, tightness_at
from vexture.bezier.chain import CubicChain, append_cubic, append_line, empty_chain
from vexture.bezier.crossings import find_crossing, wrong_turns_of
from vexture.bezier.joins import ARCS, ROUND_JOIN, StrokeStyle, append_join
from vexture.bezier.offset import append_offset, write_side
from vexture.bezier.parts import SMOOTH, STYLED, Parts, is_straight
from vexture.bezier.roots import cubic_at
from vexture.bezier.split import split

NEAR: Final = 4
"""Cubics before and after a bend, or a corner, that may cross."""

FARTHEST: Final = 2
"""Parts between those that cross and a bend, or a corner."""

MINOR: Final = 10.0
"""Tolerances of parallel curves. A part that stays within is cut off as a tight one is."""

UNSEEN: Final = 3.0
"""Tolerances of parallel curves that a point in a bend may be moved by."""

DEEP: Final = 0.5
"""Size of an evolute that can be one point, as a share of its distance from the path, and from the stroke's side."""

EVEN: Final = 1e-9
"""Sine of a turn to the wrong side that is mere rounding."""

UNEVEN: Final = 0.5
"""Most turns to the wrong side in a bend, as a share of the sine of the angle at which the parts around it cross: what
is cut off then stays on the other side of the bisector of this angle, where it is in the stroke."""


class Side(NamedTuple):
    """One side of a path: the cubics along each part, in any order of the parts."""

    chain: CubicChain
    begin: NDArray[np.int64]  # (n,): first cubic of each part
    end: NDArray[np.int64]  # (n,): and the one behind its last; a part without cubics is a point
    points: NDArray[np.float64]  # (n, 2, 2): where each part starts and ends
    tight: NDArray[np.bool_]  # (n,): parts whose evolute the side follows
    minor: NDArray[np.bool_]  # (n,): parts that are tight, or hardly move


@kernel
def tangents_of(parts: Parts) -> NDArray[np.float64]:
    """Unit directions at the start and the end of each part, and the curvature there, (n, 2, 3).

    The curvature is positive towards +90 degrees, and 0 at an end without an arm, as for a line (SVG 2, 13.5.7).
    """
    curves, n = parts.chain.cubics, parts.chain.length[0]
    found = np.empty((n, 2, 3))
    for i in range(n):
        line = is_straight(curves[i])
        for k in range(2):
            found[i, k, 0], found[i, k, 1] = tangent_at(curves[i], float(k))
            bend = 0.0 if line else tightness_at(curves[i], 1.0, float(k))
            found[i, k, 2] = bend if abs(bend) < 1e30 else 0.0
    return found


@kernel
def _write_ends(curve: NDArray[np.float64], distance: float, points: NDArray[np.float64]) -> None:
    """Write the points at a distance to the right of both ends of a part, or of its evolute where that is nearer."""
    full = np.empty(4)
    for k in range(2):
        tight = abs(tightness_at(curve, distance, float(k)))
        write_side(curve, distance / max(tight, 1.0), float(k), full)
        points[k, 0], points[k, 1] = full[0], full[1]


@kernel(allocates=False)
def _extent(chain: CubicChain, begin: int, end: int, point: NDArray[np.float64]) -> float:
    """Largest difference between a coordinate of cubics and that of a point."""
    far = 0.0
    for i in range(begin, end):
        for k in range(4):
            far = max(far, max(abs(chain.cubics[i, k, 0] - point[0]), abs(chain.cubics[i, k, 1] - point[1])))
    return far


@kernel
def offset_side(parts: Parts, side: float, style: StrokeStyle) -> Side:
    """Offset each part to the right (side 1) or left (-1); tight parts have no cubics yet."""
    curves, n = parts.chain.cubics, parts.chain.length[0]
    chain, points = empty_chain(2 * n + 4), np.empty((n, 2, 2))
    begin, end, tight, minor = (
        np.empty(n, np.int64),
        np.empty(n, np.int64),
        np.empty(n, np.bool_),
        np.empty(n, np.bool_),
    )
    full, distance = np.empty(4), side * style.half
    for i in range(n):
        begin[i] = chain.length[0]
        tight[i] = not is_straight(curves[i]) and -tightness_at(curves[i], distance, 0.5) > 1.0
        if tight[i]:
            _write_ends(curves[i], distance, points[i])
        else:
            for k in range(2):
                write_side(curves[i], distance, float(k), full)
                points[i, k, 0], points[i, k, 1] = full[0], full[1]
            if is_straight(curves[i]):
                chain = append_line(chain, points[i, 0, 0], points[i, 0, 1], points[i, 1, 0], points[i, 1, 1])
            else:
                chain = append_offset(chain, curves[i], distance, style.tolerance)
        end[i] = chain.length[0]
        minor[i] = tight[i] or _extent(chain, begin[i], end[i], points[i, 0]) <= MINOR * style.tolerance
    return Side(chain, begin, end, points, tight, minor)


@kernel(allocates=False)
def _is_smooth(parts: Parts, tangents: NDArray[np.float64], i: int, k: int, style: StrokeStyle) -> bool:
    """Whether a part and the next one, k, need no join."""
    a, b = tangents[i, 1], tangents[k, 0]
    turn = a[0] * b[1] - a[1] * b[0]
    return a[0] * b[0] + a[1] * b[1] > 0.0 and (parts.kind[k] == SMOOTH or style.half * abs(turn) <= style.tolerance)


@kernel(allocates=False)
def _wrong_turns(tangents: NDArray[np.float64], first: int, last: int, side: float) -> float:
    """Sum of the sines of turns to the other side than directions should turn; infinite if they turn back.

    Directions are numbered along the path, two to a part, and those of a closed path go on beyond its end.
    """
    n, wrong = len(tangents), 0.0
    a = tangents[first // 2 % n, first % 2]
    px, py = a[0], a[1]
    for m in range(first + 1, last + 1):
        t = tangents[m // 2 % n, m % 2]
        turn, whole = side * (px * t[1] - py * t[0]), side * (a[0] * t[1] - a[1] * t[0])
        wrong += max(turn, 0.0)
        if whole > wrong + EVEN or (turn > -EVEN and px * t[0] + py * t[1] < 0.0):
            return np.inf
        if whole > -EVEN and a[0] * t[0] + a[1] * t[1] < 0.0:
            return np.inf
        px, py = t[0], t[1]
    return wrong


@kernel
def _trim(side: Side, before: int, after: int, sign: float, slack: float, wrong: float) -> bool:
    """Cut the cubics of two parts where they cross near the end of one and the start of the other.

    Curves that miss each other by less than `slack` are drawn out to where they cross. `wrong` is the sum of the sines
    of turns between them to the wrong side; with those of what is cut off, they must be few for the angle of the cut.
    """
    cubics, rest = side.chain.cubics, np.empty((4, 2))
    for i in range(side.end[before] - 1, max(side.begin[before], side.end[before] - NEAR) - 1, -1):
        for k in range(side.begin[after], min(side.end[after], side.begin[after] + NEAR)):
            a, b = cubics[i], cubics[k]
            t, u = find_crossing(a, b, sign, slack)
            if t <= 0.0:
                continue
            turns = wrong + wrong_turns_of(cubics, i, side.end[before] - 1, min(t, 1.0), 1.0, sign)
            turns += wrong_turns_of(cubics, side.begin[after], k, 0.0, max(u, 0.0), sign)
            ax, ay = tangent_at(a, t)
            bx, by = tangent_at(b, u)
            x = cubic_at(a[0, 0], a[1, 0], a[2, 0], a[3, 0], t)
            y = cubic_at(a[0, 1], a[1, 1], a[2, 1], a[3, 1], t)
            far = 0.0
            for end in (side.points[before, 1], side.points[after, 0]):
                far = max(far, max(abs(end[0] - x), abs(end[1] - y)))
            if turns > max(UNEVEN * abs(ax * by - ay * bx), slack / max(far, slack)):
                continue
            split(a, t, a, rest)
            split(b, u, rest, b)
            b[0, 0], b[0, 1] = a[3, 0], a[3, 1]
            side.end[before], side.begin[after] = i + 1, k
            side.points[before, 1, 0], side.points[before, 1, 1] = a[3, 0], a[3, 1]
            side.points[after, 0, 0], side.points[after, 0, 1] = a[3, 0], a[3, 1]
            return True
    return False


@kernel
def _follow_bend(side: Side, first: int, count: int, slack: float) -> Side:
    """Add chords of the evolutes along a bend, without points that move by less than `slack`."""
    n, chain, start = len(side.begin), side.chain, np.empty(2)
    x, y = side.points[first, 0, 0], side.points[first, 0, 1]
    at_x, at_y = x, y
    for m in range(count):
        i = (first + m) % n
        to_x, to_y = side.points[i, 1, 0], side.points[i, 1, 1]
        begin, end = side.begin[i], side.end[i]
        start[0], start[1] = side.points[i, 0, 0], side.points[i, 0, 1]
        side.points[i, 0, 0], side.points[i, 0, 1] = x, y
        side.begin[i] = chain.length[0]
        if max(abs(start[0] - at_x), abs(start[1] - at_y)) > slack:  # after a tiny part that is tight only in part
            chain = append_line(chain, x, y, at_x, at_y)
            chain = append_line(chain, at_x, at_y, start[0], start[1])
            x, y = start[0], start[1]
            at_x, at_y = x, y
        moves = not side.tight[i] and _extent(chain, begin, end, start) > slack
        if moves or max(abs(to_x - x), abs(to_y - y)) > slack:
            chain = append_line(chain, x, y, at_x, at_y)
            x, y = at_x, at_y
        if moves:
            for k in range(begin, end):
                chain = append_cubic(chain, chain.cubics[k])
            x, y = to_x, to_y
        at_x, at_y = to_x, to_y
        if m == count - 1:
            chain = append_line(chain, x, y, at_x, at_y)
            x, y = at_x, at_y
        side.end[i] = chain.length[0]
        side.points[i, 1, 0], side.points[i, 1, 1] = x, y
    return Side(chain, side.begin, side.end, side.points, side.tight, side.minor)


@kernel(allocates=False)
def _drop(side: Side, first: int, count: int, x: float, y: float) -> None:
    """Leave out parts: all of them are a point."""
    n = len(side.begin)
    for m in range(count):
        i = (first + m) % n
        side.begin[i], side.end[i] = 0, 0
        for k in range(2):
            side.points[i, k, 0], side.points[i, k, 1] = x, y


@kernel(allocates=False)
def _is_around_point(parts: Parts, side: Side, first: int, count: int, half: float) -> bool:
    """Whether a bend turns around the first point of its evolute, and has the others near it, deep in the stroke."""
    n, far, room = len(side.begin), 0.0, np.inf
    for m in range(count):
        i = (first + m) % n
        for k in range(2):
            curve, point = parts.chain.cubics[i], side.points[i, k]
            dx, dy = point[0] - curve[3 * k, 0], point[1] - curve[3 * k, 1]
            radius = np.sqrt(dx * dx + dy * dy)
            room = min(room, min(radius, half - radius))
            far = max(far, max(abs(point[0] - side.points[first, 0, 0]), abs(point[1] - side.points[first, 0, 1])))
    return far <= DEEP * room


@kernel
def _bend_length(
    flags: NDArray[np.bool_], parts: Parts, tangents: NDArray[np.float64], i: int, closed: bool, style: StrokeStyle
) -> int:
    """Number of parts with a flag from i on that need no joins between them; 0 if i is not the first of them."""
    n, count = len(flags), 1
    if not flags[i]:
        return 0
    if (i > 0 or (closed and n > 1)) and flags[i - 1] and _is_smooth(parts, tangents, (i - 1) % n, i, style):
        if i > 0:
            return 0
        while count < n and flags[count] and _is_smooth(parts, tangents, count - 1, count, style):
            count += 1
        return n if count == n else 0  # all parts may be one bend
    while count < n:
        k = (i + count) % n
        if (k == 0 and not closed) or not flags[k] or not _is_smooth(parts, tangents, (k - 1) % n, k, style):
            break
        count += 1
    return count


@kernel
def clear_side(
    parts: Parts, side: Side, tangents: NDArray[np.float64], sign: float, closed: bool, style: StrokeStyle
) -> Side:
    """Add the evolutes of tight bends, and cut parts at the inner side of bends and corners where they cross."""
    n = len(side.begin)
    for i in range(n):
        count = _bend_length(side.minor, parts, tangents, i, closed, style)
        if count > 0 and _is_around_point(parts, side, i, count, style.half):
            _drop(side, i, count, side.points[i, 0, 0], side.points[i, 0, 1])
        elif count > 0:
            side = _follow_bend(side, i, count, UNSEEN * style.tolerance)
    for i in range(n):
        count = _bend_length(side.minor, parts, tangents, i, closed, style)
        if side.minor[i] and count == 0:
            continue
        if count == 0 and ((i == 0 and not closed) or _is_smooth(parts, tangents, (i - 1) % n, i, style)):
            continue
        _cut_off(side, tangents, i, count, sign, closed, style.tolerance)
    return side


@kernel
def _cut_off(
    side: Side, tangents: NDArray[np.float64], i: int, count: int, sign: float, closed: bool, slack: float
) -> bool:
    """Cut off what is beyond the crossing of parts before and after a bend of parts from i on; whether there is one."""
    n = len(side.begin)
    for reach in range(2 * FARTHEST + 1):
        for back in range(max(0, reach - FARTHEST), min(reach, FARTHEST) + 1):
            first, last = i - 1 - back, i + count + reach - back
            if last - first >= n or (not closed and (first < 0 or last >= n)):
                continue
            before, after = first % n, last % n
            if side.end[before] == side.begin[before] or side.end[after] == side.begin[after]:
                continue
            if side.minor[before] or side.minor[after]:
                continue
            wrong = _wrong_turns(tangents, 2 * first + 1 + 2 * n, 2 * last + 2 * n, sign)
            if wrong <= UNEVEN and _trim(side, before, after, sign, slack, wrong):
                _drop(side, before + 1, last - first - 1, side.points[before, 1, 0], side.points[before, 1, 1])
                return True
    return False


@kernel
def _connect(
    chain: CubicChain,
    at: NDArray[np.float64],
    corner: NDArray[np.float64],
    ends: NDArray[np.float64],
    to: NDArray[np.float64],
    side: float,
    style: StrokeStyle,
    kind: int,
) -> CubicChain:
    """Add what connects a side, which ends `at` a point, with the start `to` of the next part."""
    h = side * style.half
    if at[0] == to[0] and at[1] == to[1]:
        return chain
    turn = ends[0, 0] * ends[1, 1] - ends[0, 1] * ends[1, 0]
    forward = ends[0, 0] * ends[1, 0] + ends[0, 1] * ends[1, 1] > 0.0
    if forward and (kind == SMOOTH or style.half * abs(turn) <= style.tolerance):
        return append_line(chain, at[0], at[1], to[0], to[1])
    outer = side * turn > 0.0 or (turn == 0.0 and side > 0.0)
    if not outer:
        chain = append_line(chain, at[0], at[1], corner[0], corner[1])
        return append_line(chain, corner[0], corner[1], to[0], to[1])
    chain = append_line(chain, at[0], at[1], corner[0] + h * ends[0, 1], corner[1] - h * ends[0, 0])
    if kind == ARCS:
        chain = append_arcs(chain, corner[0], corner[1], ends, side, style)
    else:
        chain = append_join(chain, corner[0], corner[1], ends, side, style, ROUND_JOIN if kind == SMOOTH else kind)
    return append_line(chain, corner[0] + h * ends[1, 1], corner[1] - h * ends[1, 0], to[0], to[1])


@kernel
def join_side(
    parts: Parts, side: Side, tangents: NDArray[np.float64], sign: float, closed: bool, style: StrokeStyle
) -> CubicChain:
    """One side of a stroke, with its joins; closed, if the path is."""
    curves, n = parts.chain.cubics, parts.chain.length[0]
    chain, ends = empty_chain(2 * side.chain.length[0] + 8), np.empty((2, 3))
    for i in range(n):
        for k in range(side.begin[i], side.end[i]):
            chain = append_cubic(chain, side.chain.cubics[k])
        k = (i + 1) % n
        if k == 0 and not closed:
            break
        for axis in range(3):
            ends[0, axis], ends[1, axis] = tangents[i, 1, axis], tangents[k, 0, axis]
        kind = style.join if parts.kind[k] == STYLED else parts.kind[k]
        chain = _connect(chain, side.points[i, 1], curves[i, 3], ends, side.points[k, 0], sign, style, kind)
    return chain
