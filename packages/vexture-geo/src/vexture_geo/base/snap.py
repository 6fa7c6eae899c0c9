"""Snap borders that polygons were meant to share, but that differ slightly, so that they become identical.

Corners of different rings that lie close together become one corner. A side near a corner of another ring gets that
corner (a T-junction). Details of a single ring stay as they are, however small.
"""

from collections.abc import Iterator
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.deadline import check_time
from vexture.base.errors import ParameterError, format_count
from vexture.base.notes import Notes

DEFAULT_SNAP: Final = 3e-6
"""Fraction of the drawing's larger side: corners that are each off by 1e-6 meet. `UNSEEN` is seven times this."""

MOST_SNAP: Final = 0.01

NOISE: Final = 1e-9
"""Fraction of the drawing's larger side. Smaller differences of borders cost nothing: a leaf's lattice merges them."""

ROUNDS: Final = 5
"""Most rounds of adding corners to sides: a side bent to a corner may then lie near another."""

TESTS: Final = 1 << 23
"""Most pairs of a shape and a corner that are tested between two checks of the time limit."""

FEWEST: Final = 32
"""Fewest shapes in a call, which has a fixed cost."""

MOST_NEAR: Final = 50
"""Average number of corners near a corner or side above which snapping would destroy the drawing."""

Numbers = NDArray[np.int64]
Points = NDArray[np.float64]


class _Corners(NamedTuple):
    """Rings as lists of corners."""

    points: Points  # (m, 2), each once
    ids: Numbers  # (n,): the corner at each place of the rings, one ring after another
    ring: Numbers  # (n,): the ring of each place

    def owners(self, thing: Numbers, count: int) -> Numbers:
        """The only ring of each thing, (count,), where place k belongs to `thing[k]`; -1 if several rings share it."""
        least, most = np.full(count, len(self.ring)), np.full(count, -1)
        np.minimum.at(least, thing, self.ring)
        np.maximum.at(most, thing, self.ring)
        return np.where(least == most, least, -1)

    def following(self) -> Numbers:
        """The place after each, around its ring."""
        after = np.arange(1, len(self.ring) + 1)
        last = np.flatnonzero(np.diff(self.ring, append=-1))
        after[last] = np.append(0, last[:-1] + 1)[: len(last)]
        return after


class _TooDenseError(Exception):
    """More corners lie within the distance than snapping can handle."""


def snap_borders(
    points: Points,
    ends: Numbers,
    size: float,
    snap: float | None,
    notes: Notes,
    *,
    unit: str = "",
    noticeable: float = NOISE,
) -> tuple[Points, Numbers]:
    """Make corners and sides within a distance of those of other rings identical with them.

    Parameters
    ----------
    points : (n, 2) array
        Corners of all rings in turn; no ring repeats its first corner.
    ends : (r,) array
        Index after the last corner of each ring.
    size : float
        Larger side of the drawing.
    snap : float or None
        Distance as a fraction of that side; 0 does nothing, and None means 3e-6.
    notes : Notes
        Receives a remark if something moves by more than `noticeable`, as a fraction of that side; by default, by more
        than rounding does.
    unit : str
        Unit of the points, for the remark.

    Returns
    -------
    (n, 2) and (r,) arrays
        The new rings, in the same order; rings that no longer enclose an area are empty. A ring that was narrower than
        the distance may touch itself.

    Raises
    ------
    ParameterError
        If `snap` is not in 0..0.01.

    Examples
    --------
    >>> left, right = [(0, 0), (1, 0), (1, 1), (0, 1)], [(1.001, 0), (2, 0), (2, 2), (1.001, 2)]
    >>> points, ends = snap_borders(np.array([*left, *right], float), np.array([4, 8]), 2.0, 0.001, Notes())
    >>> points[ends[0] :].tolist()
    [[1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.001, 2.0], [1.0, 1.0]]
    """
    distance = DEFAULT_SNAP if snap is None else snap
    if not 0.0 <= distance <= MOST_SNAP:
        raise ParameterError(f"`snap` is {distance}; it must be in 0..{MOST_SNAP}, in parts of the drawing's size")
    if distance == 0.0 or len(ends) < 2:
        return points, ends
    try:
        corners, moved, farthest = _snap_corners(points, ends, distance * size, NOISE * size)
    except _TooDenseError:
        notes.remark(f"its corners are too near one another to snap borders within {distance:g}; give a smaller `snap`")
        return points, ends
    if farthest <= NOISE * size:
        return points, ends
    if farthest > noticeable * size:
        part = f"{farthest / size:.1g} of the drawing's size"
        by = f"{farthest:.2g} {unit} ({part})" if unit else part
        notes.remark(f"{format_count(moved, 'corner')} snapped to borders beside them, by up to {by}")
    return corners.points[corners.ids], np.searchsorted(corners.ring, np.arange(len(ends)), side="right")


def _snap_corners(points: Points, ends: Numbers, distance: float, noise: float) -> tuple[_Corners, int, float]:
    """Return new corners; how many moved or were added to sides by more than `noise`; and the largest move."""
    places = np.ascontiguousarray(points + 0.0).view(np.complex128).ravel()  # no -0.0: equal corners have equal bits
    unique, ids = np.unique(places, return_inverse=True)
    ring = np.repeat(np.arange(len(ends)), np.diff(ends, prepend=0))
    corners = _Corners(unique.view(np.float64).reshape(-1, 2), ids, ring)
    target = _targets(corners, distance)
    by = np.linalg.norm(corners.points[target] - corners.points, axis=1)
    moved, farthest = int((by > noise).sum()), float(by.max())
    corners = _tidy(corners._replace(ids=target[ids]))
    for _ in range(ROUNDS):
        corners, added, most = _with_junctions(corners, distance, noise)
        if added == 0:
            break
        moved, farthest = moved + added, max(farthest, most)
        corners = _tidy(corners)
    return corners, moved, farthest


def _near(shapes: NDArray[Any], tree: Any, distance: float) -> Numbers:
    """Find pairs (2, k) of a shape and a corner of the tree within a distance."""

    def parts() -> Iterator[Numbers]:
        step, found = max(FEWEST, TESTS // max(len(tree), 1)), 0
        for first in range(0, len(shapes), step):
            check_time()
            pairs = tree.query(shapes[first : first + step], predicate="dwithin", distance=distance)
            found += pairs.shape[1]
            if found > MOST_NEAR * (len(shapes) + step):
                raise _TooDenseError
            pairs[0] += first
            yield pairs

    return np.concatenate([*parts()], axis=1) if len(shapes) else np.empty((2, 0), np.int64)


def _targets(corners: _Corners, distance: float) -> Numbers:
    """Corner that each becomes: the nearest fixed one before it, if one of another ring is near."""
    import shapely

    shapes, count = shapely.points(corners.points), len(corners.points)
    earlier, later = _near(shapes, shapely.STRtree(shapes), distance)[::-1]
    owner = corners.owners(corners.ids, count)
    apart = (earlier < later) & ((owner[earlier] != owner[later]) | (owner[earlier] < 0))
    earlier, later = earlier[apart], later[apart]
    by = np.linalg.norm(corners.points[earlier] - corners.points[later], axis=1)
    order = np.lexsort((by, later))
    target = list(range(count))
    for i, j in zip(earlier[order].tolist(), later[order].tolist(), strict=True):
        if target[j] == j and target[i] == i:
            target[j] = i
    return np.array(target, np.int64)


def _with_junctions(corners: _Corners, distance: float, noise: float) -> tuple[_Corners, int, float]:
    """Give each side the corners of other rings near it; return their number and the sides' largest move, too."""
    import shapely

    after = corners.ids[corners.following()]
    low, high, count = np.minimum(corners.ids, after), np.maximum(corners.ids, after), len(corners.points)
    keys, side = np.unique(low * count + high, return_inverse=True)
    first, last = corners.points[keys // count], corners.points[keys % count]
    used = np.unique(corners.ids)
    tree = shapely.STRtree(shapely.points(corners.points[used]))
    at, corner = _near(shapely.linestrings(np.stack([first, last], axis=1)), tree, distance)
    corner = used[corner]
    own, of_side = corners.owners(corners.ids, count)[corner], corners.owners(side, len(keys))[at]
    way, to = (last - first)[at], corners.points[corner] - first[at]
    along = (way * to).sum(axis=1) / (way * way).sum(axis=1)
    away = np.abs(way[:, 0] * to[:, 1] - way[:, 1] * to[:, 0]) / np.hypot(way[:, 0], way[:, 1])
    wanted = (along > 0.0) & (along < 1.0) & (away > noise) & ((own != of_side) | (own < 0))
    wanted &= (corner != keys[at] // count) & (corner != keys[at] % count)
    if not wanted.any():
        return corners, 0, 0.0
    at, corner, along = at[wanted], corner[wanted], along[wanted]
    order = np.lexsort((along, at))
    number = np.bincount(at, minlength=len(keys))
    begin, added = np.cumsum(number) - number, number[side]
    place = np.repeat(np.arange(len(side)), added)
    step = np.arange(len(place)) - np.repeat(np.cumsum(added) - added, added)
    backwards = (corners.ids != low)[place]
    chosen = begin[side[place]] + np.where(backwards, added[place] - 1 - step, step)
    where = np.argsort(np.concatenate([np.arange(len(side)), place]), kind="stable")
    ids = np.concatenate([corners.ids, corner[order][chosen]])[where]
    ring = np.concatenate([corners.ring, corners.ring[place]])[where]
    return corners._replace(ids=ids, ring=ring), len(place), float(away[wanted].max())


def _tidy(corners: _Corners) -> _Corners:
    """Remove repeated corners, sides that go back and forth, and rings that then have fewer than three corners."""
    while True:
        after = corners.following()
        before = np.empty_like(after)
        before[after] = np.arange(len(after))
        ids, length = corners.ids, np.bincount(corners.ring)[corners.ring]
        repeated = ids == ids[after]
        spike = ids[before] == ids[after]
        drop = (length < 3) | (repeated if repeated.any() else spike | spike[before])
        if not drop.any():
            return corners
        corners = corners._replace(ids=ids[~drop], ring=corners.ring[~drop])
