"""Simplify borders of polygons as arcs between the corners where three polygons meet, each arc once."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture_geo.base.extent import Bounds
from vexture_geo.tiles.shared_borders import Corners, corners_of


def simplify_borders(shapes: NDArray[Any], box: Bounds, tolerance: float, least: float) -> NDArray[Any]:
    """Simplify polygons, (n,), so that no border moves farther than a tolerance; some may become empty.

    Each arc is simplified by Douglas and Peucker's algorithm. Corners on the sides of the box stay; holes with less
    area than `least` are removed.
    """
    import shapely

    corners = corners_of(shapes)
    is_node = _nodes(corners, box)
    rolled = _roll_rings(corners, is_node)
    index, arc, backwards, ring = _arcs(corners, rolled, is_node)
    lines = shapely.linestrings(corners.points[corners.ids[index]], indices=arc)
    points, line = shapely.get_coordinates(
        shapely.simplify(lines, tolerance, preserve_topology=False), return_index=True
    )
    counts = np.bincount(line, minlength=len(lines))
    starts = np.cumsum(counts) - counts
    step = np.arange(len(points)) - starts[line]
    points = points[starts[line] + np.where(backwards[line], counts[line] - 1 - step, step)]
    ends = np.ones(len(points), np.bool_)
    ends[starts + counts - 1] = False  # the next arc begins with this corner
    return _polygons(points[ends], ring[line[ends]], corners.polygon, len(shapes), least)


def _nodes(corners: Corners, box: Bounds) -> NDArray[np.bool_]:
    """Corners between arcs, (m,): where not exactly two sides meet, on the box, and two of each ring with fewer."""
    count = len(corners.points)
    first, last = np.divmod(np.unique(corners.sides), count)
    degree = np.bincount(first, minlength=count) + np.bincount(last, minlength=count)
    x, y = corners.points.T
    is_node: NDArray[np.bool_] = (degree != 2) | (x <= box[0]) | (y <= box[1]) | (x >= box[2]) | (y >= box[3])
    bare = ~np.logical_or.reduceat(is_node[corners.ids], corners.starts)
    is_node[np.minimum.reduceat(corners.ids, corners.starts)[bare]] = True
    nodes = np.add.reduceat(is_node[corners.ids].astype(np.int64), corners.starts)
    single = nodes == 1
    if single.any():
        node = np.maximum.reduceat(np.where(is_node[corners.ids], corners.ids, -1), corners.starts)
        ring = np.repeat(np.arange(len(corners.starts)), corners.lengths)
        away = np.hypot(*(corners.points[corners.ids] - corners.points[node[ring]]).T)
        farthest = away == np.maximum.reduceat(away, corners.starts)[ring]
        chosen = np.minimum.reduceat(np.where(farthest, corners.ids, count), corners.starts)
        is_node[chosen[single]] = True
    return is_node


def _roll_rings(corners: Corners, is_node: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Places of all rings, each starting at its first node."""
    here = is_node[corners.ids]
    place = np.arange(len(here))
    first = np.minimum.reduceat(np.where(here, place, len(here)), corners.starts) - corners.starts
    lengths, begin = (np.repeat(values, corners.lengths) for values in (corners.lengths, corners.starts))
    rolled: NDArray[np.intp] = begin + (place - begin + np.repeat(first, corners.lengths)) % lengths
    return rolled


def _arcs(
    corners: Corners, rolled: NDArray[np.intp], is_node: NDArray[np.bool_]
) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.bool_], NDArray[np.intp]]:
    """Places of the corners of all arcs, with both ends; the arc of each; which arcs are reversed; the ring of each.

    Each arc begins at the lesser of its ends, so that polygons that share a border have the same arc.
    """
    starts = np.flatnonzero(is_node[corners.ids[rolled]])
    ring_of_place = np.repeat(np.arange(len(corners.starts)), corners.lengths)
    ring = ring_of_place[starts]
    sides = np.diff(np.append(starts, len(rolled)))
    last = np.append(starts[1:], 0)
    closes = np.append(ring[1:] != ring[:-1], True)
    last[closes] = corners.starts[ring[closes]]  # first node of the ring, in its rolled order
    backwards = corners.ids[rolled[starts]] > corners.ids[rolled[last]]
    counts = sides + 1
    arc = np.repeat(np.arange(len(starts)), counts)
    step = np.arange(len(arc)) - np.repeat(np.cumsum(counts) - counts, counts)
    step = np.where(backwards[arc], sides[arc] - step, step)
    place = starts[arc] + step
    place[step == sides[arc]] = last[arc[step == sides[arc]]]
    return rolled[place], arc, backwards, ring


def _polygons(
    points: NDArray[np.float64], ring: NDArray[np.intp], polygon: NDArray[np.intp], count: int, least: float
) -> NDArray[Any]:
    """Build polygons from rings, without small holes and rings without area; `ring` is the ring of each point."""
    import shapely

    fresh = _fresh(points, ring)
    points, ring = points[fresh], ring[fresh]
    lengths = np.bincount(ring, minlength=len(polygon))
    outer = np.diff(polygon, prepend=-1) != 0
    sound = lengths >= 3
    starts = np.cumsum(lengths) - lengths
    following = np.arange(1, len(points) + 1)
    following[(starts + lengths - 1)[lengths > 0]] = starts[lengths > 0]
    x, y = (points - points[starts[ring]]).T
    doubled = np.bincount(ring, x * y[following] - x[following] * y, len(polygon))
    sound &= outer | (np.abs(doubled) >= 2.0 * least)
    whole = np.zeros(count, np.bool_)
    whole[polygon[outer]] = sound[outer]
    sound &= whole[polygon]
    shapes = np.full(count, shapely.Polygon(), object)
    if not sound.any():
        return shapes
    number = np.cumsum(sound) - 1
    kept = sound[ring]
    rings = shapely.linearrings(points[kept], indices=number[ring[kept]])
    shapes[np.unique(polygon[sound])] = shapely.polygons(
        rings, indices=np.unique(polygon[sound], return_inverse=True)[1]
    )
    return shapes


def _fresh(points: NDArray[np.float64], ring: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Find points that differ from the next one in their ring: a ring that touched itself may repeat points."""
    starts = np.flatnonzero(np.diff(ring, prepend=-1))
    following = np.arange(1, len(points) + 1)
    following[np.append(starts[1:], len(points)) - 1] = starts
    fresh: NDArray[np.bool_] = (points != points[following]).any(axis=1)
    return fresh
