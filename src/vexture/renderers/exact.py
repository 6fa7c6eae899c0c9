"""The reference renderer: exact area coverage of a drawing, directly from its curves.

It deliberately uses neither the quad-tree, its boundary code nor a fill library, because it judges them. A sweep goes
from top to bottom over the drawing's chords (`vexture.renderers.flatten`). Between two consecutive heights at which a
chord begins, ends or crosses another lies a *slab*, in which all chords run from top to bottom in one order. Each
path's winding number, counted from left to right, tells which chords bound the union; the exact trapezoids of these
are added to the pixels of the row.

No slab is thinner than `SCANLINE` pixels; a wrong order within one of that height costs no more than its area.
"""

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import Drawing, FillRule
from vexture.errors import ParameterError
from vexture.kernels import kernel
from vexture.renderers.flatten import Chords, find_chords, snap
from vexture.renderers.view import Size, ViewLike, size_of, view_matrix
from vexture.tolerance import FLATNESS, SCANLINE

__all__ = ["render_exact"]


def render_exact(
    drawing: Drawing, size: Size, view: ViewLike = None, *, flatness: float = FLATNESS
) -> NDArray[np.float32]:
    """Exact coverage of each pixel's square by the drawing's silhouette: the one-pixel box filter in screen space.

    The silhouette is the union, over the paths, of the points whose winding number the path's fill rule accepts;
    contours may cross, overlap and coincide. `size`, `view` and the result are as in `vexture.coverage`. `flatness` is
    the largest distance between a curve and its chords, in pixels; at the default, the error of coverage is at most
    0.03/255.
    """
    width, height = size_of(size)
    matrix = view_matrix(view, (width, height))
    image = np.zeros((height, width), np.float32)
    if not flatness >= SCANLINE:
        raise ParameterError(f"`flatness` is {flatness:g} pixels; it must be at least {SCANLINE:.1e}")
    if drawing.segments:
        chords = find_chords(drawing, (width, height), matrix, flatness)
        rules = np.array([path.fill_rule == FillRule.EVENODD for path in drawing.paths])
        sweep(chords, np.argsort(chords.lines[:, 0], kind="stable"), rules, image)
    return image


@kernel
def sweep(chords: Chords, order: NDArray[np.int64], evenodd: NDArray[np.bool_], image: NDArray[np.float32]) -> None:
    """Accumulate the coverage of each row, slab by slab; `order` sorts the chords by their tops."""
    height, width = image.shape
    lines = chords.lines
    active, highs, lows = np.empty(len(order), np.int64), np.empty(len(order)), np.empty(len(order))
    winding = np.zeros(len(evenodd), np.int64)
    change = np.empty(width + 2)  # of coverage from one pixel to the next; x = width adds to the last two
    count, following, y = 0, 0, 0.0
    for row in range(height):
        change[:] = 0.0
        while y < row + 1.0:
            low = row + 1.0
            kept = 0
            for k in range(count):
                end = lines[active[k], 1]
                if end > y:
                    active[kept] = active[k]
                    kept += 1
                    low = min(low, end)
            count = kept
            while following < len(order) and lines[order[following], 0] <= y:
                active[count] = order[following]
                low = min(low, lines[order[following], 1])
                count += 1
                following += 1
            if following < len(order):
                low = min(low, lines[order[following], 0])
            if count > 0:
                low = order_slab(lines, active[:count], y, low, highs, lows)
                fill_slab(chords.owners, active[:count], highs, lows, low - y, evenodd, winding, change)
            y = low
        coverage = 0.0
        for column in range(width):
            coverage += change[column]
            image[row, column] = min(max(coverage, 0.0), 1.0)


@kernel
def order_slab(
    lines: NDArray[np.float64],
    active: NDArray[np.int64],
    high: float,
    low: float,
    highs: NDArray[np.float64],
    lows: NDArray[np.float64],
) -> float:
    """Sort the active chords from left to right; write where each meets the slab's top and bottom; return its bottom.

    If neighbours change places, the slab ends at the first such crossing. Changes by less than `SCANLINE`, as of
    coincident chords, are ignored.
    """
    while True:
        for k in range(len(active)):
            chord = active[k]
            slope = lines[chord, 3]
            x = lines[chord, 2] + (high - lines[chord, 0]) * slope
            end = x + (low - high) * slope
            place = k
            while place > 0 and highs[place - 1] + lows[place - 1] > x + end:
                active[place], highs[place], lows[place] = active[place - 1], highs[place - 1], lows[place - 1]
                place -= 1
            active[place], highs[place], lows[place] = chord, x, end
        cut = low
        for k in range(len(active) - 1):
            above, below = highs[k] - highs[k + 1], lows[k] - lows[k + 1]
            if max(above, below) > SCANLINE:
                cut = min(cut, high + (low - high) * above / (above - below))
        cut = max(snap(cut), high + SCANLINE)
        if cut >= low:
            return low
        low = cut


@kernel
def fill_slab(
    owners: NDArray[np.int32],
    active: NDArray[np.int64],
    highs: NDArray[np.float64],
    lows: NDArray[np.float64],
    height: float,
    evenodd: NDArray[np.bool_],
    winding: NDArray[np.int64],
    change: NDArray[np.float64],
) -> None:
    """Count the windings across a slab's chords from left to right; add the chords where the union begins or ends."""
    covering = 0  # paths that are inside here
    for k in range(len(active)):
        owner = owners[active[k]]
        path = abs(owner) - 1
        before = winding[path]
        after = before + (1 if owner > 0 else -1)
        winding[path] = after
        step = (after & 1) - (before & 1) if evenodd[path] else int(after != 0) - int(before != 0)
        covering += step
        if step > 0 and covering == 1:
            add_edge(highs[k], lows[k], height, change)
        elif step < 0 and covering == 0:
            add_edge(highs[k], lows[k], -height, change)
    for chord in active:
        winding[abs(owners[chord]) - 1] = 0


@kernel
def add_edge(x0: float, x1: float, height: float, change: NDArray[np.float64]) -> None:
    """Add the area to the right of a straight edge, column by column.

    For the part of the edge in one column, of height h and mean distance m from the column's left side, h (1 - m) lies
    in that column and h in each column further right.
    """
    right_side = len(change) - 2.0
    left = min(max(min(x0, x1), 0.0), right_side)
    right = min(max(max(x0, x1), 0.0), right_side)
    first, last = int(left), int(right)
    density = height / (right - left) if last > first else 0.0
    for column in range(first, last + 1):
        start, end = max(left, float(column)), min(right, column + 1.0)
        part = density * (end - start) if last > first else height
        mean = 0.5 * (start + end) - column
        change[column] += part * (1.0 - mean)
        change[column + 1] += part * mean
