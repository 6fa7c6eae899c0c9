"""Dashes of a path: each is stroked as a path of its own."""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.arc_length import ArcLengths, cut_between, find_place, measure_path, total_length
from vexture.bezier.bends import tangent_at
from vexture.bezier.chain import append_line, empty_chain
from vexture.bezier.joins import StrokeStyle
from vexture.bezier.outlines import StrokeOutlines, append_dot, append_stroke
from vexture.bezier.roots import cubic_at
from vexture.bezier.split import copy_curve


@kernel
def _close(cubics: NDArray[np.float64], closed: bool) -> NDArray[np.float64]:
    """Cubics of a path, with a line from its end to its start, if it is closed and they differ."""
    n = len(cubics)
    a, b = cubics[n - 1, 3], cubics[0, 0]
    if not closed or (a[0] == b[0] and a[1] == b[1]):
        return cubics
    out = np.empty((n + 1, 4, 2))
    for i in range(n):
        copy_curve(cubics[i], out[i])
    line = append_line(empty_chain(1), a[0], a[1], b[0], b[1])
    copy_curve(line.cubics[0], out[n])
    return out


@kernel(allocates=False)
def _find_phase(dashes: NDArray[np.float64], offset: float) -> tuple[int, float]:
    """Dash or gap at an offset into the pattern, and what is left of it; the offset may be negative."""
    whole = 0.0
    for k in range(len(dashes)):
        whole += dashes[k]
    offset -= whole * np.floor(offset / whole)
    for k in range(len(dashes)):
        if offset < dashes[k] or (offset == 0.0 and dashes[k] == 0.0):
            return k, dashes[k] - offset
        offset -= dashes[k]
    return 0, dashes[0]


@kernel
def _append_dash(
    outlines: StrokeOutlines,
    cubics: NDArray[np.float64],
    lengths: ArcLengths,
    begin: float,
    end: float,
    style: StrokeStyle,
    tolerance: float,
) -> StrokeOutlines:
    """Add the stroke of a path between two lengths; beyond the end of a closed path, it goes on at its start."""
    whole = total_length(lengths)
    first, t0 = find_place(cubics, lengths, begin)
    if end - begin < style.shortest:
        curve = cubics[first]
        x, y = _point_at(curve, t0)
        tx, ty = tangent_at(curve, t0)
        if tx == 0.0 and ty == 0.0:  # at a cusp
            tx = 1.0
        return append_dot(outlines, x, y, tx, ty, style, tolerance)
    if end <= whole:
        last, t1 = find_place(cubics, lengths, end)
        return append_stroke(outlines, cut_between(cubics, first, t0, last, t1), False, style, tolerance)
    last, t1 = find_place(cubics, lengths, end - whole)
    n = len(cubics)
    one, two = cut_between(cubics, first, t0, n - 1, 1.0), cut_between(cubics, 0, 0.0, last, t1)
    both = np.empty((len(one) + len(two), 4, 2))
    for i in range(len(one)):
        copy_curve(one[i], both[i])
    for i in range(len(two)):
        copy_curve(two[i], both[len(one) + i])
    return append_stroke(outlines, both, False, style, tolerance)


@kernel
def append_dashes(
    outlines: StrokeOutlines,
    cubics: NDArray[np.float64],
    closed: bool,
    dashes: NDArray[np.float64],
    offset: float,
    style: StrokeStyle,
    tolerance: float,
) -> StrokeOutlines:
    """Add the strokes of the dashes of consecutive cubics (n, 4, 2); `dashes` (2 m,) are lengths of dashes and gaps.

    A dash of no length is a dot: its caps, along the path. On a closed path, a dash that ends at its end and one that
    begins at its start are one.
    """
    cubics = _close(cubics, closed)
    lengths = measure_path(cubics)
    whole = total_length(lengths)
    k, left = _find_phase(dashes, offset)
    if not whole >= style.shortest:
        if k % 2 == 0:
            outlines = append_dot(outlines, cubics[0, 0, 0], cubics[0, 0, 1], 1.0, 0.0, style, tolerance)
        return outlines
    around = left if closed and k % 2 == 0 else 0.0  # of the dash at the start, which waits for the one at the end
    if around >= whole:
        return append_stroke(outlines, cubics, True, style, tolerance)
    at, begins = 0.0, around > 0.0
    while at < whole:
        end = at + left
        if k % 2 == 0 and not begins:
            if end >= whole - style.shortest and around > 0.0:
                return _append_dash(outlines, cubics, lengths, at, whole + around, style, tolerance)
            outlines = _append_dash(outlines, cubics, lengths, at, min(end, whole), style, tolerance)
        at, begins = end, False
        k = (k + 1) % len(dashes)
        left = dashes[k]
    if around > 0.0:
        outlines = _append_dash(outlines, cubics, lengths, 0.0, around, style, tolerance)
    return outlines


@kernel(allocates=False)
def _point_at(curve: NDArray[np.float64], t: float) -> tuple[float, float]:
    """Point of a cubic."""
    x = cubic_at(curve[0, 0], curve[1, 0], curve[2, 0], curve[3, 0], t)
    return x, cubic_at(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], t)
