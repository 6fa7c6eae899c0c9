"""The reference renderer: exact coverage or colours of a drawing's pixels, directly from its curves.

It deliberately uses neither the quad-tree, its boundary code nor a fill library, because it judges them. A sweep goes
from top to bottom over the drawing's chords (`vexture.renderers.flatten`), slab by slab (`vexture.renderers.slabs`).
Each path's winding number, counted from left to right, tells which chords bound the union of the paths, or at which the
colour changes (`vexture.renderers.faces`). The exact trapezoids of these are added to the pixels of the row.
"""

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import Drawing, FillRule
from vexture.errors import ParameterError
from vexture.kernels import kernel
from vexture.renderers.faces import Faces, Stack, colour_slab
from vexture.renderers.flatten import Chords, find_chords
from vexture.renderers.slabs import Sweep, add_edge, cross, next_slab
from vexture.renderers.view import Size, ViewLike, size_of, view_matrix
from vexture.tolerance import FLATNESS, SCANLINE

__all__ = ["render_exact", "render_exact_colours"]


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
    image = np.zeros((height, width), np.float32)
    chords = chords_of(drawing, (width, height), view, flatness)
    if len(chords.lines):
        evenodd = np.array([path.fill_rule == FillRule.EVENODD for path in drawing.paths])
        cover_rows(Sweep.over(chords), chords.owners, evenodd, image)
    return image


def render_exact_colours(
    drawing: Drawing, size: Size, view: ViewLike = None, *, flatness: float = FLATNESS
) -> NDArray[np.float32]:
    """Exact colour of each pixel's square, in sRGB: the sum, over the faces, of a face's colour times its area there.

    A *face* is where the same paths are inside. It has one colour, composited as SVG and CSS say, with the drawing's
    groups. So nothing shines through where two paths touch. The result is (height, width, 4), premultiplied, top row
    first; all else is as in `render_exact`. The error of a component is at most 2/3 of the flatness times the length of
    the outlines in the pixel, each times the jump of the component there: by default 0.005/255 for one outline.
    """
    width, height = size_of(size)
    image = np.zeros((height, width, 4), np.float32)
    chords = chords_of(drawing, (width, height), view, flatness)
    if len(chords.lines):
        stack = Stack.of(drawing)
        colour_rows(Sweep.over(chords), chords.owners, stack, Faces.of(stack), image)
    return image


def chords_of(drawing: Drawing, size: tuple[int, int], view: ViewLike, flatness: float) -> Chords:
    """Chords of a drawing, after a look at what a caller asks for."""
    matrix = view_matrix(view, size)
    if not flatness >= SCANLINE:
        raise ParameterError(f"`flatness` is {flatness:g} pixels; it must be at least {SCANLINE:.1e}")
    return find_chords(drawing, size, matrix, flatness) if drawing.segments else Chords.room_for(0)


@kernel
def cover_rows(sweep: Sweep, owners: NDArray[np.int32], evenodd: NDArray[np.bool_], image: NDArray[np.float32]) -> None:
    """Accumulate the coverage of each row, slab by slab."""
    height, width = image.shape
    winding = np.zeros(len(evenodd), np.int64)
    change = np.empty((width + 2, 1))  # of coverage from one pixel to the next; x = width adds to the last two
    y = 0.0
    for row in range(height):
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
    """Count the windings across a slab's chords from left to right; add the chords where the union begins or ends."""
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
    sweep: Sweep, owners: NDArray[np.int32], stack: Stack, faces: Faces, image: NDArray[np.float32]
) -> None:
    """Accumulate the colours of each row, slab by slab."""
    height, width = image.shape[:2]
    change = np.empty((width + 2, 4))  # of each component, as in `cover_rows`
    y = 0.0
    for row in range(height):
        change[:] = 0.0
        while y < row + 1.0:
            low = next_slab(sweep, y, row + 1.0)
            colour_slab(sweep, owners, low - y, stack, faces, change)
            y = low
        for channel in range(4):
            value = 0.0
            for column in range(width):
                value += change[column, channel]
                image[row, column, channel] = min(max(value, 0.0), 1.0)
