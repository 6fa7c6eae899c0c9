"""Find convex outlines hidden below later ones, on a grid of cells: conservative, so that nothing visible is lost.

An outline covers the cells within a circle in it, and touches those that meet a circle around it. What it touches of
cells that a later one covers is hidden. Outlines are cut where straight lines part what is seen of them from the rest.
"""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.roots import solve_monotone
from vexture.bezier.split import copy_curve, split, subcubic

DIRECTIONS = 8
"""Directions in which outlines are cut: in eighths of a turn, from that of x."""

SMALL = 0.15
"""An outline is cut in a direction if it loses more than this part of the radius of its circle there."""

DIAGONAL = 0.7071067811865476


@kernel(allocates=False)
def _direction(k: int) -> tuple[float, float]:
    """The unit vector of one of the directions."""
    long = 1.0 if k % 2 == 0 else DIAGONAL
    x = 0.0 if k % 4 == 2 else long if k < 2 or k == 7 else -long
    y = 0.0 if k % 4 == 0 else long if k < 4 else -long
    return x, y


@kernel(allocates=False, ahead=True)
def cover_cells(circles: NDArray[np.float64], top: NDArray[np.int32]) -> None:
    """Write to cells of the grid `top` (rows, columns) the number of the last circle that covers each wholly.

    Circles (n, 3), a middle and a radius each, are in units of the cells. A radius of 0 covers nothing.
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
    """Write how far what is seen of each circle reaches from its middle in each direction, (n, `DIRECTIONS`).

    It is -inf where nothing is seen. What hides the rest is marked. All circles lie within the grid.
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
    """Write what of a convex outline of so many cubics reaches no further than `most` in a direction; return its count.

    `ranges` (room, 3) says of which cubic of the whole each is a part, from where to where; of a line -1.

    An outline that does not go out of there once, from cubic to cubic, is left as it is, and the result is 0.
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
    made, line = 0, -1
    for place in range(count):
        number = (start + place) % count
        curve, of, begin, end = outline[number], ranges[number, 0], ranges[number, 1], ranges[number, 2]
        a, b = curve[0, 0] * to_x + curve[0, 1] * to_y, curve[1, 0] * to_x + curve[1, 1] * to_y
        c, d = curve[2, 0] * to_x + curve[2, 1] * to_y, curve[3, 0] * to_x + curve[3, 1] * to_y
        if a > most and d > most:
            continue
        copy_curve(curve, out[made])
        if a > most:
            t = solve_monotone(a, b, c, d, most)
            split(curve, t, out[made + 1], out[made])
            begin += (end - begin) * t
        elif d > most:
            t = solve_monotone(a, b, c, d, most)
            line = made + 1
            split(curve, t, out[made], out[line])
            end = begin + (end - begin) * t
        out_ranges[made, 0], out_ranges[made, 1], out_ranges[made, 2] = of, begin, end
        made += 1
        if line == made:
            out_ranges[made, 0], out_ranges[made, 1], out_ranges[made, 2] = -1.0, 0.0, 1.0
            made += 1
    for axis in range(2):
        p, q = out[line - 1, 3, axis], out[0, 0, axis]
        out[line, 0, axis], out[line, 3, axis] = p, q
        out[line, 1, axis], out[line, 2, axis] = p + (q - p) / 3.0, q - (q - p) / 3.0
    return made


@kernel(allocates=False)
def _write(
    whole: NDArray[np.float64],
    outline: NDArray[np.float64],
    ranges: NDArray[np.float64],
    count: int,
    out: NDArray[np.float64],
) -> int:
    """Write an outline, parts of a cubic that follow one another as one; return how many cubics it has then."""
    made = 0
    for c in range(count):
        if c > 0 and ranges[c, 0] >= 0.0 and ranges[c, 0] == ranges[c - 1, 0] and ranges[c, 1] == ranges[c - 1, 2]:
            made -= 1
            ranges[c, 1] = ranges[c - 1, 1]
            x, y = out[made, 0, 0], out[made, 0, 1]
            subcubic(whole[int(ranges[c, 0])], ranges[c, 1], ranges[c, 2], out[made])
            out[made, 0, 0], out[made, 0, 1] = x, y
            out[made, 3, 0], out[made, 3, 1] = outline[c, 3, 0], outline[c, 3, 1]
        else:
            copy_curve(outline[c], out[made])
        made += 1
    return made


@kernel(ahead=True)
def cut_outlines(
    outlines: NDArray[np.float64], circles: NDArray[np.float64], reach: NDArray[np.float64], ends: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Cubics of what is left of convex outlines (n, m, 4, 2) that are cut at their reach, one after another.

    Circles around them (n, 3) have the units of the cubics. `ends` (n,) is written: the place after the last cubic of
    each. None are left of one of which nothing is seen.
    """
    most = 2 * outlines.shape[1] + 2 * DIRECTIONS
    kept = 0
    for i in range(len(outlines)):
        kept += 1 if reach[i, 0] > -np.inf else 0
    out = np.empty((kept * most, 4, 2))
    one, other = np.empty((most, 4, 2)), np.empty((most, 4, 2))
    of_one, of_other = np.empty((most, 3)), np.empty((most, 3))
    at = 0
    for i in range(len(outlines)):
        if reach[i, 0] > -np.inf:
            count, is_cut = 0, False
            for k in range(outlines.shape[1]):  # halves: what is round reaches furthest, in each direction, at an end
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
                    made = _cut(one, of_one, count, k, middle + reach[i, k], other, of_other)
                    if made > 0:
                        one, other, of_one, of_other = other, one, of_other, of_one
                        count, is_cut = made, True
            if is_cut:
                at += _write(outlines[i], one, of_one, count, out[at:])
            else:
                for k in range(outlines.shape[1]):
                    copy_curve(outlines[i, k], out[at])
                    at += 1
        ends[i] = at
    return out[:at].copy()
