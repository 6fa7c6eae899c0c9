"""Triangles: outlines of the area where values are above 0, and the triangle around each sample of a grid."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.deadline import check_time

AT_ONCE: Final = 2**20
"""Pairs of triangles and samples that are processed at once, at 100 bytes each."""

ON_SIDE: Final = 1e-9
"""Fraction of a triangle by which rounding may put a sample on its side outside."""


class LevelOutline(NamedTuple):
    """A closed ring with the area above 0 to its left; its points, (n, 2), do not repeat the first.

    `border` marks points on the border of the mesh; `cell` is the length of the shorter edges crossed.
    """

    points: NDArray[np.float64]
    border: NDArray[np.bool_]
    cell: float


def outlines_above(
    points: NDArray[np.float64],
    triangles: NDArray[np.int64],
    values: NDArray[np.float64],
    border: NDArray[np.bool_] | None = None,
) -> list[LevelOutline]:
    """Outlines of the area where values at points are above 0, linear between the corners of triangles.

    The corners of a triangle, (m, 3) numbers of points, are counter-clockwise. `border`, (m, 3), marks sides from each
    corner to the next that are the border of the mesh; by default those that only one triangle has. With it, the
    triangles may be a part of the mesh, if no outline crosses the others.

    Examples
    --------
    >>> corners = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    >>> outlines_above(corners, np.array([[0, 1, 2]]), np.array([1.0, -1.0, -1.0]))[0].points
    array([[0. , 0. ],
           [0.5, 0. ],
           [0. , 0.5]])
    """
    wet = values > 0.0
    start = triangles.ravel()
    end = np.roll(triangles, -1, axis=1).ravel()
    low, high = np.minimum(start, end), np.maximum(start, end)
    keys = low * len(points) + high
    _, first, edge, count = np.unique(keys, return_index=True, return_inverse=True, return_counts=True)
    ends = np.column_stack([low[first], high[first]])
    crossing = edge + len(points)  # crossings are numbered after the points
    leaving = (wet[start] & ~wet[end]).reshape(-1, 3)
    entering = (~wet[start] & wet[end]).reshape(-1, 3)
    mixed = leaving.any(axis=1)
    number = crossing.reshape(-1, 3)[mixed]
    rows = np.arange(mixed.sum())
    froms = [number[rows, leaving[mixed].argmax(axis=1)]]
    tos = [number[rows, entering[mixed].argmax(axis=1)]]
    outer = count[edge] == 1 if border is None else border.ravel()
    froms.append(np.where(wet[start], start, crossing)[outer & (wet[start] | wet[end])])
    tos.append(np.where(wet[end], end, crossing)[outer & (wet[start] | wet[end])])
    rings = _rings(np.concatenate(froms), np.concatenate(tos))
    a, b = values[ends[:, 0]], values[ends[:, 1]]
    crossed = wet[ends[:, 0]] != wet[ends[:, 1]]
    share = np.where(crossed, a / np.where(crossed, a - b, 1.0), 0.0)[:, None]
    side = points[ends[:, 1]] - points[ends[:, 0]]
    places = np.concatenate([points, points[ends[:, 0]] + share * side])
    along = np.zeros(len(places), np.bool_)
    along[start[outer]] = along[end[outer]] = along[crossing[outer]] = True
    lengths = np.concatenate([np.full(len(points), np.nan), np.hypot(*side.T)])
    return [LevelOutline(places[ring], along[ring], _cell(lengths[ring], places[ring])) for ring in rings]


def locate_samples(
    corners: NDArray[np.float64], x: NDArray[np.float64], y: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    """Find samples of a grid in triangles; return the sample, its triangle, and the weights of its corners, (n, 3).

    `corners` are places, (m, 3, 2), counter-clockwise; `x` of columns rises evenly, and `y` of rows falls evenly.
    A sample in several triangles belongs to the first.

    Examples
    --------
    >>> locate_samples(np.array([[[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]]]), np.array([0.5, 1.5]), np.array([1.5, 0.5]))[0]
    array([0, 2, 3])
    """
    first, last = grid_ranges(corners.min(axis=1), corners.max(axis=1), x, y)
    size = np.maximum(last - first + 1, 0)
    count = size.prod(axis=1)
    some = np.flatnonzero(count)
    ends = np.cumsum(count[some])
    samples, triangles, shares = [], [], []
    free = np.ones(len(x) * len(y), np.bool_)
    at = 0
    while at < len(some):
        check_time()
        before = ends[at - 1] if at else 0
        stop = max(at + 1, int(np.searchsorted(ends, before + AT_ONCE, side="right")))
        these, counts = some[at:stop], count[some[at:stop]]
        triangle = np.repeat(these, counts)
        within = np.arange(len(triangle)) - np.repeat(ends[at:stop] - counts - before, counts)
        column = first[triangle, 0] + within % size[triangle, 0]
        row = first[triangle, 1] + within // size[triangle, 0]
        share = _shares(corners[triangle], np.stack([x[column], y[row]], axis=1))
        sample = row * len(x) + column
        inside = (share >= -ON_SIDE).all(axis=1) & free[sample]  # any number of triangles may overlap
        free[sample[inside]] = False
        samples.append(sample[inside])
        triangles.append(triangle[inside])
        shares.append(share[inside])
        at = stop
    if not samples:
        return np.empty(0, np.int64), np.empty(0, np.int64), np.empty((0, 3))
    found, place = np.unique(np.concatenate(samples), return_index=True)
    return found, np.concatenate(triangles)[place], np.concatenate(shares)[place]


def grid_ranges(
    low: NDArray[np.float64], high: NDArray[np.float64], x: NDArray[np.float64], y: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """First and last column and row of a grid of `locate_samples` in boxes from `low` to `high`, (m, 2)."""
    firsts, lasts = [], []
    for axis, places in enumerate((x, y)):
        step = places[1] - places[0] if len(places) > 1 else 1.0
        ends = (low[:, axis] - places[0]) / step, (high[:, axis] - places[0]) / step
        first, last = ends if step > 0.0 else ends[::-1]
        firsts.append(np.clip(np.ceil(first - ON_SIDE), 0, len(places)))
        lasts.append(np.clip(np.floor(last + ON_SIDE), -1, len(places) - 1))
    return np.stack(firsts, axis=1).astype(np.int64), np.stack(lasts, axis=1).astype(np.int64)


def _shares(corners: NDArray[np.float64], places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Barycentric coordinates of places, (n, 2), in a triangle each, (n, 3, 2); NaN where it has no area."""
    a = corners[:, 0]
    ab, ac, ap = corners[:, 1] - a, corners[:, 2] - a, places - a
    size = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]
    with np.errstate(invalid="ignore", divide="ignore"):
        v = (ap[:, 0] * ac[:, 1] - ap[:, 1] * ac[:, 0]) / size
        w = (ab[:, 0] * ap[:, 1] - ab[:, 1] * ap[:, 0]) / size
    return np.stack([1.0 - v - w, v, w], axis=1)


def _rings(froms: NDArray[np.int64], tos: NDArray[np.int64]) -> list[NDArray[np.int64]]:
    """Closed paths along directed steps, each step used once."""
    order = np.argsort(froms, kind="stable")
    after: dict[int, list[int]] = {}
    for a, b in zip(froms[order].tolist(), tos[order].tolist(), strict=True):
        after.setdefault(a, []).append(b)
    rings = []
    for start in list(after):
        while after[start]:
            ring, at = [], start
            while after.get(at):
                ring.append(at)
                at = after[at].pop()
            rings.append(np.array(ring))
    return rings


def _cell(lengths: NDArray[np.float64], points: NDArray[np.float64]) -> float:
    """Length of the shorter edges that a ring crosses, or of its own sides if it crosses none."""
    found = lengths[np.isfinite(lengths)]
    if not len(found):
        found = np.hypot(*(points - np.roll(points, 1, axis=0)).T)
    return float(np.quantile(found, 0.1))
