"""Cut convex outlines that later ones hide, on a grid of cells; conservative, so that nothing visible is lost.

An outline covers the cells inside a circle within it, and touches the cells that meet a circle around it. A cell that a
later outline covers hides it. Outlines are cut along straight lines that part the visible from the hidden.
"""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.roots import solve_monotone
from vexture.bezier.split import copy_curve, split, subcubic

DIRECTIONS = 8
"""Number of directions in which outlines are cut: multiples of an eighth of a turn, from the x axis."""

SMALL = 0.15
"""Share of its circle's radius by which a cut must shorten an outline in a direction; smaller cuts are not made."""

DIAGONAL = 0.7071067811865476


@kernel(allocates=False)
def _direction(k: int) -> tuple[float, float]:
    """Unit vector of direction k."""
    long = 1.0 if k % 2 == 0 else DIAGONAL
    x = 0.0 if k % 4 == 2 else long if k < 2 or k == 7 else -long
    y = 0.0 if k % 4 == 0 else long if k < 4 else -long
    return x, y


@kernel(allocates=False, ahead=True)
def cover_cells(circles: NDArray[np.float64], top: NDArray[np.int32]) -> None:
    """Write to each cell of the grid `top` (rows, columns) the number of the last circle that covers all of it.

    Circles (n, 3) are centre x, centre y and radius, in units of the cells. A circle of radius 0 covers nothing.
    """
    for i in range(len(circles)):
        x, y, radius = circles[i, 0], circles[i, 1], circles[i, 2]
        for row in range(max(int(np.ceil(y - radius)), 0), min(int(np.floor(y + radius)), top.shape[0])):
            away = max(abs(row - y), abs(row + 1 - y))
            if away < radius:
                half = np.sqrt(radius * radius - away * away)
                for column in range(max(int(np.ceil(x - half)), 0), min(int(np.floor(x + half)), top.shape[1])):
                    top[row, column] = i


@kernel(allocates=False, ahead=True)
def find_reach(
    circles: NDArray[np.float64], top: NDArray[np.int32], reach: NDArray[np.float64], hides: NDArray[np.bool_]
) -> None:
    """Write the extent of each circle's visible part from its centre in each direction, (n, `DIRECTIONS`).

    The extent is -inf if nothing is visible. Circles that hide others are marked in `hides` (n,). All circles lie
    within the grid.
    """
    for i in range(len(circles)):
        x, y, radius = circles[i, 0], circles[i, 1], circles[i, 2]
        for k in range(DIRECTIONS):
            reach[i, k] = -np.inf
        for row in range(max(int(np.floor(y - radius)), 0), min(int(np.floor(y + radius)) + 1, top.shape[0])):
            away = max(row - y, y - (row + 1), 0.0)
            half = np.sqrt(max(radius * radius - away * away, 0.0))
            first, last = max(int(np.floor(x - half)), 0), min(int(np.floor(x + half)), top.shape[1] - 1)
            while first <= last and top[row, first] > i:
                hides[top[row, first]] = True
                first += 1
            while first <= last and top[row, last] > i:
                hides[top[row, last]] = True
                last -= 1
            if first > last:
                continue
            for k in range(DIRECTIONS):
                to_x, to_y = _direction(k)
                corner = (row + 0.5 - y) * to_y + 0.5 * (abs(to_x) + abs(to_y))
                reach[i, k] = max(reach[i, k], (first + 0.5 - x) * to_x + corner, (last + 0.5 - x) * to_x + corner)


@kernel(allocates=False)
def _cut(
    outline: NDArray[np.float64],
    ranges: NDArray[np.float64],
    count: int,
    k: int,
    most: float,
    out: NDArray[np.float64],
    out_ranges: NDArray[np.float64],
) -> int:
    """Write the part of a convex outline of `count` cubics up to `most` in direction k; return its number of cubics.

    `ranges` (room, 3) holds the index of the original cubic of each, -1 for a line, and its parameter interval. If the
    ends of the outline's cubics do not enter that half-plane exactly once, nothing is written, and the result is 0.
    """
    to_x, to_y = _direction(k)
    entries, start = 0, 0
    for i in range(count):
        is_here = outline[i, 0, 0] * to_x + outline[i, 0, 1] * to_y <= most
        is_next = outline[i, 3, 0] * to_x + outline[i, 3, 1] * to_y <= most
        if is_next and not is_here:
            entries, start = entries + 1, i
    if entries != 1:
        return 0
    written, line = 0, -1
    for place in range(count):
        number = (start + place) % count
        curve, of, begin, end = outline[number], ranges[number, 0], ranges[number, 1], ranges[number, 2]
        a, b = curve[0, 0] * to_x + curve[0, 1] * to_y, curve[1, 0] * to_x + curve[1, 1] * to_y
        c, d = curve[2, 0] * to_x + curve[2, 1] * to_y, curve[3, 0] * to_x + curve[3, 1] * to_y
        if a > most and d > most:
            continue
        copy_curve(curve, out[written])
        if a > most:
            t = solve_monotone(a, b, c, d, most)
            split(curve, t, out[written + 1], out[written])
            begin += (end - begin) * t
        elif d > most:
            t = solve_monotone(a, b, c, d, most)
            line = written + 1
            split(curve, t, out[written], out[line])
            end = begin + (end - begin) * t
        out_ranges[written, 0], out_ranges[written, 1], out_ranges[written, 2] = of, begin, end
        written += 1
        if line == written:
            out_ranges[written, 0], out_ranges[written, 1], out_ranges[written, 2] = -1.0, 0.0, 1.0
            written += 1
    for axis in range(2):
        p, q = out[line - 1, 3, axis], out[0, 0, axis]
        out[line, 0, axis], out[line, 3, axis] = p, q
        out[line, 1, axis], out[line, 2, axis] = p + (q - p) / 3.0, q - (q - p) / 3.0
    return written


@kernel(allocates=False)
def _write(
    whole: NDArray[np.float64],
    outline: NDArray[np.float64],
    ranges: NDArray[np.float64],
    count: int,
    out: NDArray[np.float64],
) -> int:
    """Write an outline, with consecutive parts of the same cubic joined; return its number of cubics."""
    written = 0
    for c in range(count):
        if c > 0 and ranges[c, 0] >= 0.0 and ranges[c, 0] == ranges[c - 1, 0] and ranges[c, 1] == ranges[c - 1, 2]:
            written -= 1
            ranges[c, 1] = ranges[c - 1, 1]
            x, y = out[written, 0, 0], out[written, 0, 1]
            subcubic(whole[int(ranges[c, 0])], ranges[c, 1], ranges[c, 2], out[written])
            out[written, 0, 0], out[written, 0, 1] = x, y
            out[written, 3, 0], out[written, 3, 1] = outline[c, 3, 0], outline[c, 3, 1]
        else:
            copy_curve(outline[c], out[written])
        written += 1
    return written


@kernel(ahead=True)
def cut_outlines(
    outlines: NDArray[np.float64], circles: NDArray[np.float64], reach: NDArray[np.float64], ends: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Cut convex outlines (n, m, 4, 2) at their `reach`; return the remaining cubics of all, one after another.

    `circles` (n, 3), around the outlines, have the units of the cubics. The index after the last cubic of each outline
    is written to `ends` (n,). An outline of which nothing is visible has no cubics.
    """
    most = 2 * outlines.shape[1] + 2 * DIRECTIONS
    visible = 0
    for i in range(len(outlines)):
        visible += 1 if reach[i, 0] > -np.inf else 0
    out = np.empty((visible * most, 4, 2))
    one, other = np.empty((most, 4, 2)), np.empty((most, 4, 2))
    of_one, of_other = np.empty((most, 3)), np.empty((most, 3))
    at = 0
    for i in range(len(outlines)):
        if reach[i, 0] > -np.inf:
            count, is_cut = 0, False
            for k in range(outlines.shape[1]):  # halved: a circle's farthest point in each direction is an end
                split(outlines[i, k], 0.5, one[count], one[count + 1])
                for half in range(2):
                    of_one[count, 0], of_one[count, 1], of_one[count, 2] = k, 0.5 * half, 0.5 + 0.5 * half
                    count += 1
            for k in range(DIRECTIONS):
                to_x, to_y = _direction(k)
                middle, far = circles[i, 0] * to_x + circles[i, 1] * to_y, -np.inf
                for c in range(count):
                    far = max(far, one[c, 0, 0] * to_x + one[c, 0, 1] * to_y - middle)
                if far - reach[i, k] > SMALL * circles[i, 2]:
                    remaining = _cut(one, of_one, count, k, middle + reach[i, k], other, of_other)
                    if remaining > 0:
                        one, other, of_one, of_other = other, one, of_other, of_one
                        count, is_cut = remaining, True
            if is_cut:
                at += _write(outlines[i], one, of_one, count, out[at:])
            else:
                for k in range(outlines.shape[1]):
                    copy_curve(outlines[i, k], out[at])
                    at += 1
        ends[i] = at
    return out[:at].copy()
