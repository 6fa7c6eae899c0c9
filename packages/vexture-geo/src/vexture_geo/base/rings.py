"""Rings of many polygons in a few arrays: checked, repaired, clipped, transformed."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.deadline import check_time
from vexture.base.errors import SourceError, reason_of
from vexture.base.notes import Notes
from vexture.base.tolerance import ROUND
from vexture_geo.base.extent import LARGEST, Bounds
from vexture_geo.base.snap import snap_borders
from vexture_geo.base.validity import is_heavy, make_valid, split_heavy

MOST_HALVINGS: Final = 8
"""Largest number of times that a side which a transform bends is halved."""

SHORT: Final = 1e-3
"""Length in unit-square units below which a side stays straight, within `ROUND`, in any reference system."""

MOST_CROSSINGS: Final = 250_000
"""Most crossings of the sides of a polygon to repair, which takes some 10 s."""

SIDES: Final = 64
"""Number of sides whose crossings are counted between two checks of the time limit."""


@dataclass(frozen=True, eq=False)
class Rings:
    """Polygons, each an outer ring and its holes.

    `points`, (n, 2), are those of all rings in turn; no ring repeats its first point. `ends` are the indices after the
    last point of each ring. `polygon` is the index of each ring's polygon, ascending; the first ring of a polygon is
    its outer one. `place` names a polygon for messages; the name is empty if there is only one. `feature`, (p,), is the
    feature of each polygon, which all operations preserve; None if it is not needed.
    """

    points: NDArray[np.float64]
    ends: NDArray[np.intp]
    polygon: NDArray[np.intp]
    place: Callable[[int], str]
    feature: NDArray[np.intp] | None = None

    @property
    def starts(self) -> NDArray[np.intp]:
        """Index of the first point of each ring."""
        return np.append(0, self.ends[:-1])[: len(self.ends)]

    @cached_property
    def outer(self) -> NDArray[np.intp]:
        """Index of the outer ring of each polygon."""
        return np.flatnonzero(np.diff(self.polygon, prepend=-1))

    @property
    def following(self) -> NDArray[np.intp]:
        """Index of the point after each point, around its ring."""
        after = np.arange(1, len(self.points) + 1)
        after[self.ends - 1] = self.starts
        return after

    @property
    def steps(self) -> NDArray[np.float64]:
        """Eastward distance of the side from each point."""
        across = self.points[:, 0]
        return np.asarray(across[self.following] - across)

    @cached_property
    def boxes(self) -> NDArray[np.float64]:
        """Least and greatest coordinates of each polygon, (p, 2, 2)."""
        first = self.starts[self.outer]
        if not len(first):
            return np.empty((0, 2, 2))
        return np.stack([np.minimum.reduceat(self.points, first), np.maximum.reduceat(self.points, first)], axis=1)

    @property
    def box(self) -> Bounds:
        """West, south, east, north of all polygons, of which there must be at least one."""
        (west, south), (east, north) = self.boxes[:, 0].min(axis=0), self.boxes[:, 1].max(axis=0)
        return (float(west), float(south), float(east), float(north))

    def ring_name(self, point: int) -> str:
        """Name of the ring of a point, for messages."""
        ring = int(np.searchsorted(self.ends, point, side="right"))
        polygon = int(self.polygon[ring])
        number = f"ring {ring - int(self.outer[polygon]) + 1}"
        place = self.place(polygon)
        return f"{place}, {number}" if place else number

    def take(self, polygons: NDArray[np.intp]) -> "Rings":
        """Select polygons by their indices."""
        counts = np.diff(np.append(self.outer, len(self.ends)))[polygons]
        rings = _runs(self.outer[polygons], counts)
        lengths = (self.ends - self.starts)[rings]
        points = self.points[_runs(self.starts[rings], lengths)]
        owner = np.repeat(np.arange(len(polygons)), counts)
        feature = None if self.feature is None else self.feature[polygons]
        return Rings(points, np.cumsum(lengths), owner, lambda index: self.place(int(polygons[index])), feature)

    def concatenate(self, other: "Rings") -> "Rings":
        """Append other polygons to these."""
        own = len(self.outer)
        return Rings(
            np.concatenate([self.points, other.points]),
            np.concatenate([self.ends, other.ends + len(self.points)]),
            np.concatenate([self.polygon, other.polygon + own]),
            lambda index: self.place(index) if index < own else other.place(index - own),
            None if self.feature is None or other.feature is None else np.append(self.feature, other.feature),
        )

    def shift_east(self, shift: NDArray[np.float64]) -> "Rings":
        """Move each ring along x by its own distance, (r,)."""
        points = self.points.copy()
        points[:, 0] += np.repeat(shift, self.ends - self.starts)
        return replace(self, points=points)

    @property
    def shapes(self) -> NDArray[Any]:
        """Polygons as shapely geometries."""
        import shapely

        owner = np.repeat(np.arange(len(self.ends)), self.ends - self.starts)
        return np.asarray(shapely.polygons(shapely.linearrings(self.points, indices=owner), indices=self.polygon))


def _runs(starts: NDArray[np.intp], lengths: NDArray[np.intp]) -> NDArray[np.intp]:
    """Indices of several runs, one after another."""
    before = np.cumsum(lengths) - lengths
    return np.repeat(starts - before, lengths) + np.arange(int(lengths.sum()))


def rings_of(polygons: NDArray[Any], place: Callable[[int], str], feature: NDArray[np.intp] | None = None) -> Rings:
    """Convert shapely polygons, each of a feature; empty polygons are dropped."""
    import shapely

    rings, owner = shapely.get_rings(polygons, return_index=True)
    points, ring = shapely.get_coordinates(rings, return_index=True)
    ends = np.searchsorted(ring, np.arange(len(rings)), side="right")
    keep = np.ones(len(points), np.bool_)
    keep[ends - 1] = False  # shapely repeats the first point
    full, polygon = np.unique(owner, return_inverse=True)  # without the empty ones
    return Rings(
        points[keep],
        (ends - np.arange(1, len(rings) + 1)).astype(np.intp),
        polygon.astype(np.intp),
        lambda index: place(int(full[index])),
        None if feature is None else feature[full],
    )


def refuse_far(rings: Rings, remedy: str) -> None:
    """Raise a `SourceError` that names the ring of a coordinate that is not finite or too large."""
    near = (np.abs(rings.points) <= LARGEST).all(axis=1)  # False for NaN
    if not near.all():
        point = int(near.argmin())
        x, y = rings.points[point]
        raise SourceError(f"{rings.ring_name(point)}: a point is at {x:g},{y:g}; the limit is {LARGEST:g}; {remedy}")


def repair_rings(rings: Rings, notes: Notes) -> Rings:
    """Repair polygons whose rings cross or leave their outer ring, by shapely; split heavy ones into parts.

    Polygons that enclose no area are left out, with a note.
    """
    import shapely

    shapes = rings.shapes
    valid = ~is_heavy(shapes)
    valid[valid] = shapely.is_valid(shapes[valid])
    if valid.all():
        return rings
    broken = np.flatnonzero(~valid)
    made: list[Any] = []
    for index in broken:
        _refuse_tangle(shapes[index], rings.place(int(index)))
        try:
            whole = make_valid(shapes[index : index + 1])[0]
            made.append(shapely.geometrycollections(split_heavy(whole)))
        except shapely.errors.GEOSException as error:
            place = rings.place(int(index)) or "its polygon"
            raise SourceError(f"{place} cannot be repaired ({reason_of(error)}); correct its rings") from None
    pieces, owner = _polygons(np.array(made))
    for _ in range(len(broken) - len(np.unique(owner))):
        notes.left_out("polygon that encloses nothing")
    feature = None if rings.feature is None else rings.feature[broken[owner]]
    mended = rings_of(pieces, lambda index: rings.place(int(broken[owner[index]])), feature)
    return rings.take(np.flatnonzero(valid)).concatenate(mended)


def _refuse_tangle(shape: Any, place: str) -> None:
    """Refuse a polygon with so many crossings that its repair, in one call, would not end in reasonable time."""
    import shapely

    check_time()
    points, ring = shapely.get_coordinates(shapely.get_rings(shape), return_index=True)
    if len(points) ** 2 <= 2 * MOST_CROSSINGS:
        return
    sides = shapely.linestrings(np.stack([points[:-1], points[1:]], axis=1)[ring[:-1] == ring[1:]])
    tree, crossings = shapely.STRtree(sides), 0
    for start in range(0, len(sides), SIDES):
        check_time()
        crossings += tree.query(sides[start : start + SIDES], predicate="crosses").shape[1] / 2
        if crossings > MOST_CROSSINGS:
            raise SourceError(
                f"{place or 'its polygon'}: its sides cross more than {MOST_CROSSINGS:,} times; correct its rings"
            )


def _polygons(shapes: NDArray[Any]) -> tuple[NDArray[Any], NDArray[np.intp]]:
    """Polygons among the parts of shapely geometries, and the index of the geometry of each."""
    import shapely

    parts, owner = shapely.get_parts(shapes, return_index=True)
    again, inner = shapely.get_parts(parts, return_index=True)
    keep = (shapely.get_type_id(again) == shapely.GeometryType.POLYGON) & ~shapely.is_empty(again)
    return again[keep], owner[inner][keep]


def within(rings: Rings, box: Bounds, turn: float | None) -> Rings:
    """Select polygons that reach into a box; in longitudes of period `turn`, also those a turn away."""
    found: Rings | None = None
    for shift in (0.0, -turn, turn) if turn else (0.0,):
        low, high = rings.boxes[:, 0] + (shift, 0.0), rings.boxes[:, 1] + (shift, 0.0)
        inside = (low < box[2:]).all(axis=1) & (high > box[:2]).all(axis=1)
        if inside.all() and found is None:
            found = rings
        elif inside.any() or found is None:
            part = rings.take(np.flatnonzero(inside))
            part = part.shift_east(np.full(len(part.ends), shift))
            found = part if found is None else found.concatenate(part)
    assert found is not None
    return found


def clip_polygons(shapes: NDArray[Any], box: Bounds) -> NDArray[Any]:
    """Clip polygons to a box, by a slower method where the fast one fails, as it does at some corners."""
    import shapely

    try:
        return np.asarray(shapely.clip_by_rect(shapes, *box))
    except shapely.errors.GEOSException:
        if len(shapes) == 1:
            return np.asarray(shapely.intersection(shapely.make_valid(shapes), shapely.box(*box)))
        middle = len(shapes) // 2
        return np.concatenate([clip_polygons(shapes[:middle], box), clip_polygons(shapes[middle:], box)])


def cut(rings: Rings, box: Bounds) -> Rings:
    """Clip polygons to a box."""
    beyond = (rings.boxes[:, 0] < box[:2]).any(axis=1) | (rings.boxes[:, 1] > box[2:]).any(axis=1)
    if not beyond.any():
        return rings
    leaving = np.flatnonzero(beyond)
    pieces, owner = _polygons(clip_polygons(rings.take(leaving).shapes, box))
    feature = None if rings.feature is None else rings.feature[leaving[owner]]
    return rings.take(np.flatnonzero(~beyond)).concatenate(
        rings_of(pieces, lambda index: rings.place(int(leaving[owner[index]])), feature)
    )


def map_rings(
    rings: Rings,
    mapping: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    box: Bounds,
    size: NDArray[np.float64],
) -> Rings:
    """Map the points of rings, adding points where a mapped side is no longer straight.

    Sides that pass through `box` are exact within `ROUND` of `size`, the sides of the unit square; both are in units
    after the mapping.
    """
    points, ends = rings.points, rings.ends
    image = mapping(points)
    for _ in range(MOST_HALVINGS):
        after = replace(rings, points=image, ends=ends).following
        low, high = np.minimum(image, image[after]), np.maximum(image, image[after])
        near = (low < box[2:]).all(axis=1) & (high > box[:2]).all(axis=1)
        with np.errstate(invalid="ignore"):  # the caller refuses infinite points
            sides = np.flatnonzero(near & ((high - low) > SHORT * size).any(axis=1))
            middles = (points[sides] + points[after[sides]]) / 2.0
            mapped = mapping(middles)
            bent = np.hypot(*((mapped - (image[sides] + image[after[sides]]) / 2.0) / size).T) > ROUND
        if not bent.any():
            break
        at = sides[bent] + 1
        points, image = np.insert(points, at, middles[bent], axis=0), np.insert(image, at, mapped[bent], axis=0)
        ends = ends + np.searchsorted(at, ends, side="right")
    return replace(rings, points=image, ends=ends)


def orient_rings(rings: Rings) -> Rings:
    """Orient outer rings counter-clockwise and holes clockwise, so that winding numbers count the polygons."""
    if not len(rings.ends):
        return rings
    middle = rings.points[rings.starts].repeat(rings.ends - rings.starts, axis=0)
    x, y = (rings.points - middle).T
    after = rings.following
    doubled = np.add.reduceat(x * y[after] - x[after] * y, rings.starts)
    hole = np.ones(len(rings.ends), np.bool_)
    hole[rings.outer] = False
    turn = np.repeat((doubled > 0.0) == hole, rings.ends - rings.starts)
    index = np.arange(len(turn))
    index[turn] = (np.repeat(rings.starts + rings.ends - 1, rings.ends - rings.starts) - index)[turn]
    return replace(rings, points=rings.points[index])


def snap_rings(rings: Rings, size: float, snap: float | None, notes: Notes, **options: Any) -> Rings:
    """Make borders that differ by at most `snap` identical; see `snap_borders`."""
    points, ends = snap_borders(rings.points, rings.ends, size, snap, notes, **options)
    full = np.diff(ends, prepend=0) > 0
    whole = full[rings.outer][rings.polygon]  # holes go with their outer ring
    if whole.all() and full.all():
        return replace(rings, points=points, ends=ends.astype(np.intp))
    keep = full & whole
    old, polygon = np.unique(rings.polygon[keep], return_inverse=True)
    return Rings(
        points[np.repeat(keep, np.diff(ends, prepend=0))],
        np.cumsum(np.diff(ends, prepend=0)[keep]).astype(np.intp),
        polygon.astype(np.intp),
        lambda index: rings.place(int(old[index])),
        None if rings.feature is None else rings.feature[old],
    )
