"""The reference renderer: exact coverage or colours of a drawing's pixels, directly from its curves.

It deliberately uses neither the quad-tree, its boundary code nor a fill library, because it judges them. A sweep goes
from top to bottom over the drawing's chords (`vexture.renderers.flatten`), slab by slab (`vexture.renderers.exact`).
The winding number of each path, counted from left to right, identifies the chords that bound the union of the paths, or
at which the colour changes (`vexture.renderers.faces`). Their exact trapezoids are added to the pixels of the row, and
so are the integrals over faces with gradients, pictures and blurs (`vexture.renderers.regions`).
"""

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.deadline import check_time
from vexture.base.errors import LimitError, ParameterError
from vexture.base.kernels import kernel
from vexture.base.tolerance import FLATNESS, SCANLINE
from vexture.drawing.drawing import Drawing, FillRule
from vexture.renderers.faces import FLAT, RUN, PathStack, SweepFaces, find_face, forget
from vexture.renderers.flatten import Chords, find_chords, snap
from vexture.renderers.ramps import MOST_CUTS
from vexture.renderers.regions import SIDE, Regions, add_region, end_row
from vexture.renderers.samples import draw_effects
from vexture.renderers.view import Size, ViewLike, size_of, view_matrix


class Sweep(NamedTuple):
    """State of a sweep over chords."""

    lines: NDArray[np.float64]  # (n, 4): lines of `Chords`
    order: NDArray[np.int64]  # (n,): the chords, sorted by their tops
    active: NDArray[np.int64]  # (n,): first the chords in the slab, from left to right
    highs: NDArray[np.float64]  # (n,): x of each active chord at the slab's top
    lows: NDArray[np.float64]  # (n,): the same at its bottom
    counts: NDArray[np.int64]  # (2,): number of chords in the slab; number of chords of `order` reached so far

    @classmethod
    def over(cls, chords: Chords) -> "Sweep":
        """Start a sweep at the image's upper edge."""
        count = len(chords.lines)
        order = np.argsort(chords.lines[:, 0], kind="stable")
        return cls(
            chords.lines, order, np.empty(count, np.int64), np.empty(count), np.empty(count), np.zeros(2, np.int64)
        )


@kernel(allocates=False)
def next_slab(sweep: Sweep, high: float, limit: float) -> float:
    """Find and order the chords of the slab below a height; return its bottom, which is at or above `limit`."""
    lines, order, active = sweep.lines, sweep.order, sweep.active
    count, following, low = 0, sweep.counts[1], limit
    for k in range(sweep.counts[0]):
        end = lines[active[k], 1]
        if end > high:
            active[count] = active[k]
            count += 1
            low = min(low, end)
    while following < len(order) and lines[order[following], 0] <= high:
        active[count] = order[following]
        low = min(low, lines[order[following], 1])
        count += 1
        following += 1
    if following < len(order):
        low = min(low, lines[order[following], 0])
    sweep.counts[0], sweep.counts[1] = count, following
    return order_slab(lines, active[:count], high, low, sweep.highs, sweep.lows)


@kernel(allocates=False)
def order_slab(
    lines: NDArray[np.float64],
    active: NDArray[np.int64],
    high: float,
    low: float,
    highs: NDArray[np.float64],
    lows: NDArray[np.float64],
) -> float:
    """Sort the active chords from left to right; write x of each at the slab's top and bottom; return its bottom.

    If neighbours cross, the slab ends at their first crossing. Crossings by less than `SCANLINE`, as of coincident
    chords, are ignored.
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


@kernel(allocates=False)
def cross(owner: int, winding: NDArray[np.int64], evenodd: NDArray[np.bool_]) -> int:
    """Update the winding number of a chord's path; return 1 if the path begins at the chord, -1 if it ends, else 0."""
    path = abs(owner) - 1
    before = winding[path]
    after = before + (1 if owner > 0 else -1)
    winding[path] = after
    return int((after & 1) - (before & 1) if evenodd[path] else int(after != 0) - int(before != 0))


@kernel(allocates=False)
def add_edge(x0: float, x1: float, height: float, jump: tuple[float, ...], change: NDArray[np.float64]) -> None:
    """Add a jump of n components times the area to the right of a straight edge; `change` is (width + 2, n).

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
        beyond = part * (0.5 * (start + end) - column)
        for k in range(len(jump)):
            change[column, k] += jump[k] * (part - beyond)
            change[column + 1, k] += jump[k] * beyond


BAND: Final = 4
"""Rows between two checks of the time limit: a row of thousands of outlines may take a second."""


def render_exact(
    drawing: Drawing, size: Size, view: ViewLike = None, *, flatness: float = FLATNESS
) -> NDArray[np.float32]:
    """Exact coverage of each pixel's square by the drawing's silhouette: a box filter of one pixel in screen space.

    The silhouette is the union, over the paths, of the points whose winding number the path's fill rule accepts;
    contours may cross, overlap and coincide. `size`, `view` and the result are as in `vexture.coverage`. `flatness` is
    the largest distance between a curve and its chords, in pixels; by default, the error of coverage is at most
    0.03/255.
    """
    width, height = size_of(size)
    image = np.zeros((height, width), np.float32)
    chords = chords_of(drawing, (width, height), view, flatness)
    if len(chords.lines):
        evenodd = np.array([path.fill_rule == FillRule.EVENODD for path in drawing.paths])
        sweep = Sweep.over(chords)
        for rows in bands(height, drawing.name):
            cover_rows(sweep, chords.owners, evenodd, rows, image)
    return image


def render_exact_colours(
    drawing: Drawing, size: Size, view: ViewLike = None, *, flatness: float = FLATNESS
) -> NDArray[np.float32]:
    """Exact colour of each pixel's square, in sRGB: the sum over the faces of a face's colour times its area there.

    A *face* is the set of points that lie inside the same paths. Its colour is composited as SVG and CSS define, with
    the drawing's groups: once for a flat face; where gradients, pictures or blurs are visible, the colour at each point
    is integrated. So nothing shines through where two paths touch. The result is (height, width, 4), premultiplied, top
    row first; all else is as in `render_exact`.

    The error of a component is at most 2/3 of the flatness times the length of the outlines in the pixel, each times
    the jump of the component there: by default 0.005/255 for one outline. Integrals over gradients are refined until
    they are steady. This adds an error of up to 0.02/255 in most drawings; it was 0.1/255 in the worst pixel of 120
    random drawings with all blend modes and up to ten periods of a gradient in a pixel. More than 64 periods in a
    pixel, or 1,024 corners of ramps on a line in one, are not resolved. Integrals over pictures are exact, up to
    0.01/255 where more than 512 corners of a picture's pixels lie in one pixel of the image, not parallel to it; a
    `LimitError` is raised if more than 1,024 of its columns and rows meet a line in one, or 500 its borders.
    Splines are integrated like gradients, up to 256 coefficients in a pixel; so are blurs, which are true Gaussians of
    their sources, up to 0.1/255 (see `vexture.renderers.gaussians`).
    """
    return _integrate_colours(drawing, size_of(size), view, flatness=flatness)


def _integrate_colours(
    drawing: Drawing, size: tuple[int, int], view: ViewLike, is_linear: bool = False, flatness: float = FLATNESS
) -> NDArray[np.float32]:
    """Return the colours of an image, like `render_exact_colours`; those of faces may be in linear light."""
    width, height = size
    drawing = draw_effects(drawing, _integrate_colours)
    image = np.zeros((height, width, 4), np.float32)
    chords = chords_of(drawing, size, view, flatness)
    if len(chords.lines):
        stack = PathStack.of_drawing(drawing, view_matrix(view, size), size, _integrate_colours, is_linear)
        varies = bool((stack.shades >= 0).any())
        regions = Regions.between(chords.lines if varies else chords.lines[:0], width)
        sweep, faces = Sweep.over(chords), SweepFaces.at_start(stack)
        for rows in bands(height, drawing.name):
            colour_rows(sweep, chords.owners, stack, faces, regions, rows, image)
            if stack.samples.lost[0]:
                raise LimitError(
                    f"{drawing.name}: more than {MOST_CUTS:,} columns and rows of a picture meet a line in one pixel, "
                    "the limit of the exact renderer; make the image larger, or use another `renderer`"
                )
    return image


def chords_of(drawing: Drawing, size: tuple[int, int], view: ViewLike, flatness: float) -> Chords:
    """Check a caller's arguments; return the chords of the drawing."""
    matrix = view_matrix(view, size)
    if not flatness >= SCANLINE:
        raise ParameterError(f"`flatness` is {flatness:g} pixels; it must be at least {SCANLINE:.1e}")
    return find_chords(drawing, size, matrix, flatness) if drawing.segments else Chords.room_for(0)


def bands(height: int, name: str) -> Iterator[tuple[int, int]]:
    """Yield the first row and the last row + 1 of each band of an image; check the time limit before each."""
    for first in range(0, height, BAND):
        check_time(name, "the exact renderer", "use another `renderer`, simplify the drawing")
        yield first, min(first + BAND, height)


@kernel
def cover_rows(
    sweep: Sweep,
    owners: NDArray[np.int32],
    evenodd: NDArray[np.bool_],
    rows: tuple[int, int],
    image: NDArray[np.float32],
) -> None:
    """Accumulate the coverage of each row of a band, slab by slab; the sweep has reached the band's first row."""
    width = image.shape[1]
    winding = np.zeros(len(evenodd), np.int64)
    change = np.empty((width + 2, 1))  # of coverage from one pixel to the next; x = width adds to the last two
    y = float(rows[0])
    for row in range(rows[0], rows[1]):
        change[:] = 0.0
        while y < row + 1.0:
            low = next_slab(sweep, y, row + 1.0)
            cover_slab(sweep, owners, low - y, evenodd, winding, change)
            y = low
        coverage = 0.0
        for column in range(width):
            coverage += change[column, 0]
            image[row, column] = min(max(coverage, 0.0), 1.0)


@kernel
def cover_slab(
    sweep: Sweep,
    owners: NDArray[np.int32],
    height: float,
    evenodd: NDArray[np.bool_],
    winding: NDArray[np.int64],
    change: NDArray[np.float64],
) -> None:
    """Count winding numbers along a slab's chords, left to right; add the chords where the union begins or ends."""
    active, highs, lows = sweep.active[: sweep.counts[0]], sweep.highs, sweep.lows
    covering = 0  # paths that are inside here
    for k in range(len(active)):
        step = cross(owners[active[k]], winding, evenodd)
        covering += step
        if step > 0 and covering == 1:
            add_edge(highs[k], lows[k], height, (1.0,), change)
        elif step < 0 and covering == 0:
            add_edge(highs[k], lows[k], -height, (1.0,), change)
    for chord in active:
        winding[abs(owners[chord]) - 1] = 0


@kernel
def colour_rows(
    sweep: Sweep,
    owners: NDArray[np.int32],
    stack: PathStack,
    faces: SweepFaces,
    regions: Regions,
    rows: tuple[int, int],
    image: NDArray[np.float32],
) -> None:
    """Accumulate the colours of each row of a band, like `cover_rows`."""
    width = image.shape[1]
    change = np.empty((width + 2, 4))  # of each component, as in `cover_rows`
    y = float(rows[0])
    for row in range(rows[0], rows[1]):
        change[:] = 0.0
        forget(faces)
        while y < row + 1.0:
            low = next_slab(sweep, y, row + 1.0)
            colour_slab(sweep, owners, (y, low), stack, faces, regions, change)
            y = low
        end_row(stack, faces, regions, change)
        for channel in range(4):
            value = 0.0
            for column in range(width):
                value += change[column, channel]
                image[row, column, channel] = min(max(value, 0.0), 1.0)


@kernel(allocates=False)
def colour_slab(
    sweep: Sweep,
    owners: NDArray[np.int32],
    heights: tuple[float, float],
    stack: PathStack,
    faces: SweepFaces,
    regions: Regions,
    change: NDArray[np.float64],
) -> None:
    """Add the jumps of colour at a slab's chords, and the regions between them in which the colour varies."""
    active, left = sweep.active[: sweep.counts[0]], faces.left
    name, begin, face = 0, SIDE, (FLAT, 0)
    left[:] = 0.0
    for k in range(len(active)):
        owner = owners[active[k]]
        path = abs(owner) - 1
        step = cross(owner, faces.winding, stack.evenodd)
        if step != 0:
            if face[0] != FLAT:
                add_region((begin, active[k]), face, heights, stack, faces, regions, change)
            faces.inside[path // RUN] += step
            name ^= stack.names[path]
            found = find_face(name, stack, faces)
            begin, face = active[k], (faces.starts[found], faces.ends[found])
            right = faces.colours[found]
            jump = right[0] - left[0], right[1] - left[1], right[2] - left[2], right[3] - left[3]
            if jump != (0.0, 0.0, 0.0, 0.0):
                add_edge(sweep.highs[k], sweep.lows[k], heights[1] - heights[0], jump, change)
                for channel in range(4):
                    left[channel] = right[channel]
    if face[0] != FLAT:
        add_region((begin, SIDE), face, heights, stack, faces, regions, change)
    for chord in active:
        path = abs(owners[chord]) - 1
        faces.winding[path] = 0
        faces.inside[path // RUN] = 0
