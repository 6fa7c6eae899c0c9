"""Outlines of strokes without dashes, as contours to fill by the non-zero rule, in float64.

A stroke is a band between the two sides of its path (`vexture.bezier.sides`), with joins and caps. Where an inner side
overlaps itself, its contour goes through the path's point. The contour is then a sum of bands and wedges that are all
wound the same way, so that no place of the stroke is left out.

Only + - * / and square roots are used, so that all machines compute the same numbers.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.bends import tangent_at
from vexture.bezier.chain import CubicChain, append_line, append_reversed, close_chain, empty_chain
from vexture.bezier.joins import BUTT, StrokeStyle, append_cap
from vexture.bezier.parts import STYLED, append_part, cut_path
from vexture.bezier.reduce import reduce_contour
from vexture.bezier.sides import Side, clear_side, join_side, offset_side, tangents_of
from vexture.bezier.split import copy_curve


class StrokeOutlines(NamedTuple):
    """Closed contours, one after the other."""

    chain: CubicChain
    lengths: NDArray[np.int64]  # (room,): cubics of each contour
    number: NDArray[np.int64]  # (1,)


@kernel
def append_contour(outlines: StrokeOutlines, chain: CubicChain, shortest: float, tolerance: float) -> StrokeOutlines:
    """Add a closed chain of cubics as a contour of few cubics, unless it is a point."""
    contour = close_chain(chain, shortest)
    if len(contour) == 0:
        return outlines
    contour = reduce_contour(contour, tolerance)
    lengths, count, more = outlines.lengths, outlines.number[0], outlines.chain
    if count == len(lengths):
        lengths = np.empty(2 * count + 2, np.int64)
        for i in range(count):
            lengths[i] = outlines.lengths[i]
    needed = more.length[0] + len(contour)
    if needed > len(more.cubics):
        more = CubicChain(np.empty((2 * needed, 4, 2)), more.length)
        for i in range(more.length[0]):
            copy_curve(outlines.chain.cubics[i], more.cubics[i])
    for i in range(len(contour)):
        copy_curve(contour[i], more.cubics[more.length[0] + i])
    more.length[0] = needed
    lengths[count] = len(contour)
    outlines.number[0] = count + 1
    return StrokeOutlines(more, lengths, outlines.number)


@kernel
def _cap_end(chain: CubicChain, curve: NDArray[np.float64], right: Side, left: Side, style: StrokeStyle) -> CubicChain:
    """Add the cap at the end of the last part, from the right side to the left one."""
    tx, ty = tangent_at(curve, 1.0)
    x, y, h, n = curve[3, 0], curve[3, 1], style.half, len(right.begin)
    chain = append_line(chain, right.points[n - 1, 1, 0], right.points[n - 1, 1, 1], x + h * ty, y - h * tx)
    chain = append_cap(chain, x, y, tx, ty, style)
    return append_line(chain, x - h * ty, y + h * tx, left.points[n - 1, 1, 0], left.points[n - 1, 1, 1])


@kernel
def _cap_start(
    chain: CubicChain, curve: NDArray[np.float64], right: Side, left: Side, style: StrokeStyle
) -> CubicChain:
    """Add the cap at the start of the first part, from the left side to the right one."""
    tx, ty = tangent_at(curve, 0.0)
    x, y, h = curve[0, 0], curve[0, 1], style.half
    chain = append_line(chain, left.points[0, 0, 0], left.points[0, 0, 1], x - h * ty, y + h * tx)
    chain = append_cap(chain, x, y, -tx, -ty, style)
    return append_line(chain, x + h * ty, y - h * tx, right.points[0, 0, 0], right.points[0, 0, 1])


@kernel
def append_dot(
    outlines: StrokeOutlines, x: float, y: float, tx: float, ty: float, style: StrokeStyle, tolerance: float
) -> StrokeOutlines:
    """Add the two caps of a line of no length in a direction; nothing for butt caps."""
    if style.cap == BUTT:
        return outlines
    chain = append_cap(empty_chain(8), x, y, tx, ty, style)
    return append_contour(outlines, append_cap(chain, x, y, -tx, -ty, style), style.shortest, tolerance)


@kernel
def append_stroke(
    outlines: StrokeOutlines, cubics: NDArray[np.float64], closed: bool, style: StrokeStyle, tolerance: float
) -> StrokeOutlines:
    """Add the contours of the stroke of consecutive cubics (n, 4, 2), each of which starts where the last one ends."""
    parts = cut_path(cubics, style)
    n = parts.chain.length[0]
    if n == 0:
        return append_dot(outlines, cubics[0, 0, 0], cubics[0, 0, 1], 1.0, 0.0, style, tolerance)
    curves = parts.chain.cubics
    gap = max(abs(curves[n - 1, 3, 0] - curves[0, 0, 0]), abs(curves[n - 1, 3, 1] - curves[0, 0, 1]))
    if closed and gap >= style.shortest:
        line = append_line(empty_chain(1), curves[n - 1, 3, 0], curves[n - 1, 3, 1], curves[0, 0, 0], curves[0, 0, 1])
        parts = append_part(parts, line.cubics[0], STYLED)
        n, curves = n + 1, parts.chain.cubics
    tangents = tangents_of(parts)
    right = clear_side(parts, offset_side(parts, 1.0, style), tangents, 1.0, closed, style)
    left = clear_side(parts, offset_side(parts, -1.0, style), tangents, -1.0, closed, style)
    forth = join_side(parts, right, tangents, 1.0, closed, style)
    back = join_side(parts, left, tangents, -1.0, closed, style)
    if closed:
        outlines = append_contour(outlines, forth, style.shortest, tolerance)
        return append_contour(
            outlines, append_reversed(empty_chain(back.length[0] + 1), back), style.shortest, tolerance
        )
    chain = append_reversed(_cap_end(forth, curves[n - 1], right, left, style), back)
    return append_contour(outlines, _cap_start(chain, curves[0], right, left, style), style.shortest, tolerance)
