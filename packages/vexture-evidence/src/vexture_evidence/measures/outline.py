"""Distances of points from a drawing's outline, and the points at which the thesis's method first samples it."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.points import points_along, points_at
from vexture.drawing.drawing import Drawing
from vexture.thesis.sample_and_fit import SAMPLES_ACROSS
from vexture_evidence.measures.closeups import all_cubics

CHORDS: Final = 256
"""Chords of each cubic, from which the search for the nearest point starts."""

BATCH: Final = 1 << 20
"""Pairs of points and chords that are compared at a time."""

BUCKETS: Final = 64
"""Squares along a side of the unit square; the points in a square are compared with the chords near it."""

MARGIN: Final = 1 / 64
"""Unit-square units; chords whose middle is within this of a square are near it."""

STEPS: Final = 4
"""Steps of Newton's method, after which the nearest point is exact up to rounding."""


def first_samples(drawing: Drawing) -> NDArray[np.float64]:
    """Points at which the thesis's method first samples the outline, (n, 2)."""
    cubics = all_cubics(drawing)
    extent = np.hypot(*np.diff(cubics, axis=1).transpose(2, 0, 1)).sum(axis=1)
    density = np.maximum(np.ceil(extent * SAMPLES_ACROSS).astype(np.int64), 3)
    owner = np.repeat(np.arange(len(cubics)), density)
    t = (np.arange(len(owner)) - np.repeat(np.cumsum(density) - density, density)) / density[owner]
    return points_at(cubics[owner], t)


def off_outline(points: NDArray[np.float64], drawing: Drawing) -> NDArray[np.float64]:
    """Distances, (n,), of points, (n, 2), from the outline of a drawing that is not empty.

    Examples
    --------
    >>> off_outline(np.array([[0.5, 0.25]]), Drawing.polygon([(0, 0), (1, 0), (0, 1)])).round(9).tolist()
    [0.176776695]
    """
    cubics = all_cubics(drawing)
    t = np.linspace(0.0, 1.0, CHORDS + 1)
    curve = points_along(cubics, t)
    chords = np.stack([curve[:, :-1], curve[:, 1:]], axis=2).reshape(-1, 2, 2)
    near, share = _nearest_chords(points, chords)
    return _refined_distances(points, cubics[near // CHORDS], (near % CHORDS + share) / CHORDS)


def _nearest_chords(
    points: NDArray[np.float64], chords: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Index of the nearest chord of each point, and the place on it, 0..1.

    Most points are so near to the outline that only few chords need to be compared.
    """
    near, share = np.zeros(len(points), np.int64), np.zeros(len(points))
    middle, half = chords.mean(axis=1), 0.5 * float(np.linalg.norm(np.diff(chords, axis=1), axis=2).max())
    row = np.floor(points * BUCKETS).astype(np.int64)
    buckets, owner = np.unique(row, axis=0, return_inverse=True)
    far = [np.empty(0, np.int64)]
    for number, low in enumerate(buckets / BUCKETS):
        mine = np.flatnonzero(owner.ravel() == number)
        close = np.flatnonzero(((middle > low - MARGIN) & (middle < low + 1 / BUCKETS + MARGIN)).all(axis=1))
        if not len(close):
            far.append(mine)
            continue
        which, share[mine], off = _nearest_of(points[mine], chords[close])
        near[mine] = close[which]
        far.append(mine[off > MARGIN - half])  # a chord beyond the margin may be nearer
    rest = np.concatenate(far)
    near[rest], share[rest], _ = _nearest_of(points[rest], chords)
    return near, share


def _nearest_of(
    points: NDArray[np.float64], chords: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.float64]]:
    """Index of the nearest chord, the place on it and the distance, by comparison with all chords."""
    start, step = chords[:, 0], chords[:, 1] - chords[:, 0]
    square = np.maximum((step**2).sum(axis=1), np.finfo(np.float64).tiny)
    near, share, off = np.empty(len(points), np.int64), np.empty(len(points)), np.empty(len(points))
    rows = max(1, BATCH // len(chords))
    for part in (slice(first, first + rows) for first in range(0, len(points), rows)):
        x, y = (points[part, None, axis] - start[:, axis] for axis in range(2))
        along = ((x * step[:, 0] + y * step[:, 1]) / square).clip(0.0, 1.0)
        squared = (x - along * step[:, 0]) ** 2 + (y - along * step[:, 1]) ** 2
        near[part] = squared.argmin(axis=1)
        share[part] = np.take_along_axis(along, near[part, None], axis=1)[:, 0]
        off[part] = np.sqrt(squared.min(axis=1))
    return near, share, off


def _refined_distances(
    points: NDArray[np.float64], cubics: NDArray[np.float64], t: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Distances of points from their cubics, by Newton's method from approximate parameters."""
    hodograph = 3.0 * np.diff(cubics, axis=1)
    for _ in range(STEPS):
        s = 1.0 - t
        weights = np.stack([s * s, 2.0 * s * t, t * t], axis=1)
        tangent = np.einsum("nk,nkc->nc", weights, hodograph)
        length = np.maximum((tangent**2).sum(axis=1), np.finfo(np.float64).tiny)
        t = (t + ((points - points_at(cubics, t)) * tangent).sum(axis=1) / length).clip(0.0, 1.0)
    distance: NDArray[np.float64] = np.hypot(*(points - points_at(cubics, t)).T)
    return distance
