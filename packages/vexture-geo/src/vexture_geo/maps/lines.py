"""Lines for a map: remove jumps of longitude, clip to a box, and add points where the map bends them."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture_geo.base.extent import Bounds
from vexture_geo.base.longitudes import FULL_TURN
from vexture_geo.base.rings import Rings
from vexture_geo.vector.features import Lines


def unwrap_lines(lines: Lines, turn: float) -> Lines:
    """Remove jumps of longitude, so that no side is longer than half a turn; lines continue beyond the antimeridian.

    A side of a whole turn goes around the world, as a parallel does. If the line comes from or continues to places
    within the turn, the side only changes the side of the antimeridian.

    Examples
    --------
    >>> across = Lines(np.array([[179.0, 0.0], [-179.0, 1.0]]), np.array([2]), np.array([0]))
    >>> unwrap_lines(across, 360.0).points.tolist()
    [[179.0, 0.0], [181.0, 1.0]]
    >>> equator = Lines(np.array([[-180.0, 0.0], [180.0, 0.0]]), np.array([2]), np.array([0]))
    >>> unwrap_lines(equator, 360.0).points.tolist()
    [[-180.0, 0.0], [180.0, 0.0]]
    """
    if not len(lines.ends):
        return lines
    step = lines.steps
    turns = np.where(np.abs(step) > turn / 2, -np.rint(step / turn), 0.0)
    starts = np.append(0, lines.ends[:-1])
    full = np.abs(step) >= turn * FULL_TURN
    inner = ~full & (step != 0.0)
    inner[starts] = False
    turns[starts] = 0.0
    turns[full & ~np.append(False, inner[:-1]) & ~np.append(inner[1:], False)] = 0.0
    shift = np.cumsum(turns)
    shift -= np.repeat(shift[starts], np.diff(lines.ends, prepend=0))
    points = lines.points + np.stack([turn * shift, np.zeros(len(shift))], axis=1)
    return Lines(points, lines.ends, lines.feature)


def lines_in_box(lines: Lines, box: Bounds, turn: float | None) -> Lines:
    """Clip lines to a box, including parts that lie in it a turn away."""
    import shapely

    low, high = np.array(box[:2]), np.array(box[2:])
    if ((lines.points >= low) & (lines.points <= high)).all():
        return lines
    owner = np.repeat(np.arange(len(lines.ends)), np.diff(lines.ends, prepend=0))
    found, feature = [], []
    for shift in (0.0, -turn, turn) if turn else (0.0,):
        whole = shapely.linestrings(lines.points + np.array([shift, 0.0]), indices=owner)
        parts, of = shapely.get_parts(shapely.clip_by_rect(whole, *box), return_index=True)
        keep = (shapely.get_type_id(parts) == shapely.GeometryType.LINESTRING) & ~shapely.is_empty(parts)
        found.append(parts[keep])
        feature.append(lines.feature[of[keep]])
    parts = np.concatenate(found)
    points, owner = shapely.get_coordinates(parts, return_index=True)
    return Lines(points, np.searchsorted(owner, np.arange(len(parts)), side="right"), np.concatenate(feature))


def change_lines(lines: Lines, change: Callable[[NDArray[Any]], NDArray[Any]]) -> Lines:
    """Apply a change to shapely lines, and keep the lines among the results."""
    import shapely

    owner = np.repeat(np.arange(len(lines.ends)), np.diff(lines.ends, prepend=0))
    parts, of = shapely.get_parts(change(shapely.linestrings(lines.points, indices=owner)), return_index=True)
    keep = (shapely.get_type_id(parts) == shapely.GeometryType.LINESTRING) & ~shapely.is_empty(parts)
    parts, of = parts[keep], of[keep]
    points, owner = shapely.get_coordinates(parts, return_index=True)
    return Lines(points, np.searchsorted(owner, np.arange(len(parts)), side="right"), lines.feature[of])


def densify(rings: Rings, longest: float) -> Rings:
    """Add midpoints to sides until none is longer than `longest`; sides that neighbours share stay byte-identical."""
    points, ends = rings.points, rings.ends
    while len(points):
        after = replace(rings, points=points, ends=ends).following
        long = np.flatnonzero((np.abs(points[after] - points) > longest).any(axis=1))
        if not len(long):
            break
        middles = (points[long] + points[after[long]]) / 2.0
        points, ends = (
            np.insert(points, long + 1, middles, axis=0),
            ends + np.searchsorted(long + 1, ends, side="right"),
        )
    return replace(rings, points=points, ends=ends)


def rings_along(lines: Lines) -> Rings:
    """Make rings that follow lines to their ends and back, because what bends rings then also bends lines."""
    lengths = np.diff(lines.ends, prepend=0)
    starts = lines.ends - lengths
    sizes = 2 * lengths - 2
    of = np.repeat(np.arange(len(lengths)), sizes)
    place = np.arange(len(of)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    index = starts[of] + np.minimum(place, sizes[of] - place)
    owner = np.arange(len(lengths))
    return Rings(lines.points[index], np.cumsum(sizes), owner, lambda line: f"line {line + 1}", lines.feature)


def lines_along(rings: Rings) -> Lines:
    """Recover the lines of `rings_along`."""
    assert rings.feature is not None
    sizes = rings.ends - rings.starts
    lengths = sizes // 2 + 1
    of = np.repeat(np.arange(len(lengths)), lengths)
    place = np.arange(len(of)) - np.repeat(np.cumsum(lengths) - lengths, lengths)
    return Lines(rings.points[rings.starts[of] + place], np.cumsum(lengths), rings.feature)
