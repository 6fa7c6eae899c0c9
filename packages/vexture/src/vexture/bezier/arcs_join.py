"""The join `arcs` of SVG 2 (13.5.6): both sides of a corner go on along their circles of curvature until these meet."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.chain import CubicChain, append_line, unit
from vexture.bezier.joins import MITER_CLIP, ROUND_JOIN, StrokeStyle, append_join, append_turn

FLAT: Final = 1e-6
"""Half the width over a radius, below which a circle is taken for a line."""

TERMS: Final = 8
"""Terms of the series of sine and cosine, for angles up to half a turn over 16."""


@kernel(allocates=False)
def _turn_vector(x: float, y: float, angle: float) -> tuple[float, float]:
    """Vector turned by an angle of at most half a turn, by series and doubling: libraries differ in the last bit."""
    part = angle / 16.0
    sine, cosine, term = 0.0, 0.0, 1.0
    for k in range(TERMS):
        cosine += term
        term *= part / (2 * k + 1)
        sine += term
        term *= -part / (2 * k + 2)
    for _ in range(4):
        cosine, sine = cosine * cosine - sine * sine, 2.0 * sine * cosine
    return x * cosine - y * sine, x * sine + y * cosine


@kernel(allocates=False)
def _solve_quadratic(a: float, b: float, c: float) -> float:
    """Least positive root of a x^2 + b x + c; -1 if there is none."""
    if a == 0.0:
        return -c / b if b != 0.0 and -c / b > 0.0 else -1.0
    inner = b * b - 4.0 * a * c
    if inner < 0.0:
        return -1.0
    q = -0.5 * (b + (np.sqrt(inner) if b >= 0.0 else -np.sqrt(inner)))
    one, two = q / a, (c / q if q != 0.0 else -1.0)
    low, high = min(one, two), max(one, two)
    return low if low > 0.0 else (high if high > 0.0 else -1.0)


@kernel(allocates=False)
def _write_circle(radius: float, end: NDArray[np.float64], circle: NDArray[np.float64]) -> None:
    """Write the circle (x, y, radius) that touches a side at its end (x, y, tx, ty); its centre is left of positive."""
    circle[0], circle[1], circle[2] = end[0] - radius * end[3], end[1] + radius * end[2], radius


@kernel(allocates=False)
def _meet(circles: NDArray[np.float64], ends: NDArray[np.float64]) -> bool:
    """Change the radii of two circles by the same amount until they touch; False if that is not possible.

    With the radii r and s and the growths m and n (1 or -1), their centres are a line in the amount.
    """
    r, s = abs(circles[0, 2]), abs(circles[1, 2])
    dx, dy = circles[1, 0] - circles[0, 0], circles[1, 1] - circles[0, 1]
    square = dx * dx + dy * dy
    if abs(r - s) * abs(r - s) <= square <= (r + s) * (r + s):
        return True
    apart = square > (r + s) * (r + s)
    grow = (1.0 if apart or r < s else -1.0, 1.0 if apart or s < r else -1.0)
    mx = my = 0.0
    for k in range(2):
        turn = grow[k] * (1.0 if circles[k, 2] > 0.0 else -1.0) * (1.0 if k == 1 else -1.0)
        mx, my = mx - turn * ends[k, 3], my + turn * ends[k, 2]
    wanted, rate = (r + s, 2.0) if apart else (abs(r - s), -2.0)
    amount = _solve_quadratic(
        mx * mx + my * my - rate * rate, 2.0 * (dx * mx + dy * my - wanted * rate), square - wanted * wanted
    )
    if amount < 0.0:
        return False
    for k in range(2):
        size = abs(circles[k, 2]) + grow[k] * amount
        if size <= 0.0:
            return False
        _write_circle(size if circles[k, 2] > 0.0 else -size, ends[k], circles[k])
    return True


@kernel(allocates=False)
def _meet_line(circle: NDArray[np.float64], end: NDArray[np.float64], line: NDArray[np.float64]) -> bool:
    """Enlarge a circle until it touches a line (x, y, tx, ty); False if that is not possible."""
    off = (circle[0] - line[0]) * line[3] - (circle[1] - line[1]) * line[2]
    size, sign = abs(circle[2]), 1.0 if circle[2] > 0.0 else -1.0
    if abs(off) <= size:
        return True
    rate = sign * (-end[3] * line[3] - end[2] * line[2]) * (1.0 if off > 0.0 else -1.0)
    if rate >= 1.0:
        return False
    _write_circle(sign * (size + (abs(off) - size) / (1.0 - rate)), end, circle)
    return True


@kernel(allocates=False)
def _cross_line(
    circle: NDArray[np.float64], x: float, y: float, tx: float, ty: float, out: NDArray[np.float64]
) -> bool:
    """Write the points (2, 2) where a circle crosses a line in a unit direction; one point twice if it only touches."""
    px, py = circle[0] - x, circle[1] - y
    along, off = px * tx + py * ty, px * ty - py * tx
    square = circle[2] * circle[2] - off * off
    if square < -1e-9 * circle[2] * circle[2]:
        return False
    root = np.sqrt(max(square, 0.0))
    for k in range(2):
        step = along + (root if k == 1 else -root)
        out[k, 0], out[k, 1] = x + step * tx, y + step * ty
    return True


@kernel(allocates=False)
def _cross_circles(circles: NDArray[np.float64], out: NDArray[np.float64]) -> bool:
    """Write the points (2, 2) where two circles cross: on the line of equal powers."""
    dx, dy = circles[1, 0] - circles[0, 0], circles[1, 1] - circles[0, 1]
    square = dx * dx + dy * dy
    if square == 0.0:
        return False
    share = (square + circles[0, 2] * circles[0, 2] - circles[1, 2] * circles[1, 2]) / (2.0 * square)
    tx, ty = unit(-dy, dx)
    return _cross_line(circles[0], circles[0, 0] + share * dx, circles[0, 1] + share * dy, tx, ty, out)


@kernel(allocates=False)
def _is_ahead(end: NDArray[np.float64], x: float, y: float, forth: float) -> bool:
    """Whether a point is ahead (forth 1) of an end (x, y, tx, ty), or behind it (-1): within half its circle."""
    dx, dy = x - end[0], y - end[1]
    return forth * (dx * end[2] + dy * end[3]) > 0.0


@kernel(allocates=False)
def _nearest(found: NDArray[np.float64], ends: NDArray[np.float64], x: float, y: float) -> int:
    """Index of the one of two points, nearest to (x, y), that both sides reach; -1 if there is none."""
    best, least = -1, np.inf
    for k in range(2):
        px, py = found[k, 0], found[k, 1]
        if _is_ahead(ends[0], px, py, 1.0) and _is_ahead(ends[1], px, py, -1.0):
            square = (px - x) * (px - x) + (py - y) * (py - y)
            if square < least:
                best, least = k, square
    return best


@kernel
def _append_along(
    chain: CubicChain, circle: NDArray[np.float64], x0: float, y0: float, x1: float, y1: float, tolerance: float
) -> CubicChain:
    """Add the arc of a circle between two points, or a line for a circle of radius 0."""
    if circle[2] == 0.0:
        return append_line(chain, x0, y0, x1, y1)
    a, b, t = np.empty(2), np.empty(2), np.empty(2)
    a[0], a[1], b[0], b[1] = x0 - circle[0], y0 - circle[1], x1 - circle[0], y1 - circle[1]
    sign = 1.0 if circle[2] > 0.0 else -1.0
    t[0], t[1] = -sign * a[1], sign * a[0]
    if a[0] == b[0] and a[1] == b[1]:
        return chain
    return append_turn(chain, circle[0], circle[1], a, b, t, tolerance)


@kernel
def _clip(
    circles: NDArray[np.float64],
    ends: NDArray[np.float64],
    point: NDArray[np.float64],
    corner: NDArray[np.float64],
    longest: float,
    cuts: NDArray[np.float64],
) -> int:
    """Write where the limit cuts both sides, (2, 2): 0 if it is beyond the point where they meet, 2 if before both.

    The limit is measured along the arc that leaves the corner along its bisector and goes through that point.
    """
    mx, my = unit(ends[0, 2] - ends[1, 2], ends[0, 3] - ends[1, 3])
    wx, wy = point[0] - corner[0], point[1] - corner[1]
    across, square = mx * wy - my * wx, wx * wx + wy * wy
    qx, qy, tx, ty = corner[0] + longest * mx, corner[1] + longest * my, mx, my
    if abs(across) * longest > FLAT * square:
        radius = square / (2.0 * across)
        angle = longest / radius
        if abs(angle) >= 3.0:
            return 0
        tx, ty = _turn_vector(mx, my, angle)
        sx, sy = _turn_vector(my, -mx, angle)
        qx, qy = corner[0] + radius * (sx - my), corner[1] + radius * (sy + mx)
        chord_x, chord_y = qx - corner[0], qy - corner[1]
        if chord_x * chord_x + chord_y * chord_y >= square:
            return 0
    elif longest * longest >= square:
        return 0
    found = np.empty((2, 2))
    for k in range(2):
        side = (ends[k, 0] - qx) * tx + (ends[k, 1] - qy) * ty
        if side >= 0.0:
            return 2
        if circles[k, 2] == 0.0:
            slope = ends[k, 2] * tx + ends[k, 3] * ty
            if slope == 0.0:
                return 2
            cuts[k, 0], cuts[k, 1] = ends[k, 0] - side / slope * ends[k, 2], ends[k, 1] - side / slope * ends[k, 3]
            continue
        if not _cross_line(circles[k], qx, qy, -ty, tx, found):
            return 2
        best, least = -1, np.inf
        for m in range(2):  # of the two crossings, the one on the way to the point
            forth = 1.0 if k == 0 else -1.0
            ahead = _is_ahead(ends[k], found[m, 0], found[m, 1], forth)
            dx, dy = found[m, 0] - ends[k, 0], found[m, 1] - ends[k, 1]
            if ahead and dx * dx + dy * dy < least:
                best, least = m, dx * dx + dy * dy
        if best < 0:
            return 2
        cuts[k, 0], cuts[k, 1] = found[best, 0], found[best, 1]
    return 1


@kernel
def append_arcs(
    chain: CubicChain, x: float, y: float, directions: NDArray[np.float64], side: float, style: StrokeStyle
) -> CubicChain:
    """Add the outer side of an `arcs` join at (x, y) between two directions with curvatures (2, 3).

    The radius of a side is that of the path's curvature, and half the width more or less.
    """
    ends, circles, lines = np.empty((2, 4)), np.zeros((2, 3)), 0
    for k in range(2):
        tx, ty, bend = directions[k, 0], directions[k, 1], directions[k, 2]
        ends[k, 0], ends[k, 1] = x + side * style.half * ty, y - side * style.half * tx
        ends[k, 2], ends[k, 3] = tx, ty
        if abs(bend) * style.half > 1.0:
            return append_join(chain, x, y, directions, side, style, ROUND_JOIN)
        if abs(bend) * style.half < FLAT:
            lines += 1
        else:
            _write_circle(1.0 / bend + side * style.half, ends[k], circles[k])
    found = np.empty((2, 2))
    if lines == 0:
        good = _meet(circles, ends) and _cross_circles(circles, found)
    elif lines == 1:
        c, m = (0, 1) if circles[1, 2] == 0.0 else (1, 0)
        good = _meet_line(circles[c], ends[c], ends[m])
        good = good and _cross_line(circles[c], ends[m, 0], ends[m, 1], ends[m, 2], ends[m, 3], found)
    else:
        good = False
    best = _nearest(found, ends, x, y) if good else -1
    if best < 0:
        return append_join(chain, x, y, directions, side, style, MITER_CLIP)
    point, corner, cuts = found[best], np.empty(2), np.empty((2, 2))
    corner[0], corner[1] = x, y
    cut = _clip(circles, ends, point, corner, style.limit * style.half, cuts)
    if cut == 2:
        return append_line(chain, ends[0, 0], ends[0, 1], ends[1, 0], ends[1, 1])
    if cut == 0:
        for k in range(2):
            cuts[k, 0], cuts[k, 1] = point[0], point[1]
    chain = _append_along(chain, circles[0], ends[0, 0], ends[0, 1], cuts[0, 0], cuts[0, 1], style.tolerance)
    chain = append_line(chain, cuts[0, 0], cuts[0, 1], cuts[1, 0], cuts[1, 1])
    return _append_along(chain, circles[1], cuts[1, 0], cuts[1, 1], ends[1, 0], ends[1, 1], style.tolerance)
