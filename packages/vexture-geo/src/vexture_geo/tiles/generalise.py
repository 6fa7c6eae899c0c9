"""Generalise polygons: remove details smaller than a fraction of a pixel, and keep shared borders shared.

Borders are cut where three meet into *arcs*, and each arc is simplified once. Corners on the sides of the box stay in
place, so that pieces of one feature in adjacent boxes still fit.

Polygons too small to be seen one by one, such as a town of blocks between streets, become squares of the same area.
If everything smaller than a pixel were removed, they would be missing on a map of the country.
"""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture_geo.base.extent import Bounds
from vexture_geo.base.validity import make_valid, unite_polygons
from vexture_geo.tiles.pieces import FeaturePieces, join_pieces
from vexture_geo.tiles.shared_borders import Corners, corners_of, shared_lengths


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


MOST_ROUNDS: Final = 32
"""Most rounds, in each of which small polygons are merged with larger neighbours."""

MOST_POINTS: Final = 1_000_000
"""Most points simplified at once, at some 300 bytes each; only a tile that cannot be divided further has more."""

DEEPEST: Final = 8
"""Most times that a box with more points is quartered."""

CELLS: Final = (1, 2, 4)
"""Sides, in pixels, of the cells in which specks are gathered; too few specks are gathered in a larger cell."""

SHARE: Final = 0.25
"""Fraction of a pixel's area: a cell whose specks have less area in all becomes no square."""


def generalise_polygons(pieces: FeaturePieces, box: Bounds, tolerance: float, least: float) -> FeaturePieces:
    """Generalise polygons for pixels of some size.

    Parameters
    ----------
    pieces : FeaturePieces
        Polygons within the box.
    box : tuple of float
        Polygons that touch its sides continue beyond it.
    tolerance : float
        Largest distance, in metres, that a border may move.
    least : float
        Square metres. A smaller polygon is merged with the neighbour with which it shares most of its border; those
        without a neighbour are aggregated (`aggregate`). Smaller holes are filled. With 0, all features stay.
    """
    if tolerance > 0.0 and pieces.points > MOST_POINTS:
        tolerance /= 2.0  # half of it here, the other half below
        pieces = _thin(pieces, box, tolerance, DEEPEST)
    return _generalise_at_once(pieces, box, tolerance, least)


def _thin(pieces: FeaturePieces, box: Bounds, tolerance: float, depth: int) -> FeaturePieces:
    """Reduce points box by box, so that memory holds the points of one box."""
    if pieces.points <= MOST_POINTS or depth == 0:
        return _generalise_at_once(pieces, box, tolerance, 0.0)
    x, y = (box[0] + box[2]) / 2.0, (box[1] + box[3]) / 2.0
    quarters = [
        (west, south, east, north)
        for west, east in ((box[0], x), (x, box[2]))
        for south, north in ((box[1], y), (y, box[3]))
    ]
    return join_pieces([_thin(pieces.within(quarter), quarter, tolerance, depth - 1) for quarter in quarters])


def _generalise_at_once(pieces: FeaturePieces, box: Bounds, tolerance: float, least: float) -> FeaturePieces:
    """Generalise all polygons at once; see `generalise_polygons`."""
    import shapely

    kept, specks = _merge_small(dissolve(pieces), box, least)
    if len(kept):
        shapes = _repair(simplify_borders(kept.shapes, box, tolerance, least))
        if least == 0.0:
            gone = shapely.is_empty(shapes)
            shapes[gone] = kept.shapes[gone]
        kept = kept.with_shapes(shapes)
    return join_pieces([kept, aggregate(specks, least)]) if len(specks) else kept


def _repair(shapes: NDArray[Any]) -> NDArray[Any]:
    """Make polygons whose rings cross valid."""
    import shapely

    broken = np.flatnonzero(~shapely.is_valid(shapes))
    if len(broken):
        shapes[broken] = make_valid(shapes[broken])
    return shapes


def dissolve(pieces: FeaturePieces) -> FeaturePieces:
    """Unite touching polygons of each feature."""
    return _unite_groups(pieces, np.unique(pieces.order, return_inverse=True)[1])


def _unite_groups(pieces: FeaturePieces, group: NDArray[np.intp]) -> FeaturePieces:
    """Unite each group of pieces to one shape of the feature of the group's first piece."""
    if not len(pieces):
        return pieces
    order = np.argsort(group, kind="stable")
    starts = np.flatnonzero(np.diff(group[order], prepend=-1))
    counts = np.diff(np.append(starts, len(order)))
    first = order[starts]
    shapes = pieces.shapes[first].copy()
    for place in np.flatnonzero(counts > 1).tolist():
        members = order[starts[place] : starts[place] + counts[place]]
        shapes[place] = unite_polygons(pieces.shapes[members])
    return pieces.take(first).with_shapes(shapes)


def _merge_small(pieces: FeaturePieces, box: Bounds, least: float) -> tuple[FeaturePieces, FeaturePieces]:
    """Merge polygons that are too small with a neighbour; return the polygons, and small ones without a neighbour."""
    import shapely

    none = pieces.take(np.zeros(len(pieces), np.bool_))
    if not len(pieces):
        return pieces, none
    area = shapely.area(pieces.shapes)
    bounds = shapely.bounds(pieces.shapes).reshape(-1, 4)
    inside = (bounds[:, :2] > box[:2]).all(axis=1) & (bounds[:, 2:] < box[2:]).all(axis=1)
    if not (inside & (area < least)).any():
        return pieces, none
    label, whole, goes_on = _labels(pieces.shapes, area, ~inside, least)
    stays = ((whole >= least) | goes_on)[label]
    sizes = np.bincount(label, minlength=len(label))[label]
    several = np.flatnonzero(stays & (sizes > 1))
    several = several[np.argsort(label[several] != several, kind="stable")]  # the polygon that keeps its feature first
    groups = np.unique(label[several], return_inverse=True)[1]
    return join_pieces([pieces.take(stays & (sizes == 1)), _unite_groups(pieces.take(several), groups)]), pieces.take(
        ~stays
    )


def _labels(
    shapes: NDArray[Any], area: NDArray[np.float64], goes_on: NDArray[np.bool_], least: float
) -> tuple[NDArray[np.intp], NDArray[np.float64], NDArray[np.bool_]]:
    """Polygon into which each is merged, or itself; their areas after merging, and which of them touch the box."""
    one, other, length = shared_lengths(shapes)
    label, whole, goes_on = np.arange(len(shapes)), area.copy(), goes_on.copy()
    for _ in range(MOST_ROUNDS):
        small = (whole < least) & ~goes_on
        a, b = label[one], label[other]
        apart = small[a] & (a != b)
        # only into a larger one, so that no merges form a cycle
        apart &= (whole[b] > whole[a]) | ((whole[b] == whole[a]) & (b > a)) | goes_on[b]
        if not apart.any():
            break
        pairs, at = np.unique(a[apart] * len(label) + b[apart], return_inverse=True)
        best = np.lexsort((pairs, np.bincount(at, length[apart]), pairs // len(label)))
        pairs = pairs[best]  # the longest border of each small polygon comes last
        last = np.append(np.flatnonzero(np.diff(pairs // len(label))), len(pairs) - 1)
        target = np.arange(len(label))
        target[pairs[last] // len(label)] = pairs[last] % len(label)
        while (target[target] != target).any():
            target = target[target]
        moved = target != np.arange(len(label))
        np.add.at(whole, target[moved], whole[moved])
        np.logical_or.at(goes_on, target[moved], goes_on[moved])
        label = target[label]
    return label, whole, goes_on


def aggregate(specks: FeaturePieces, least: float) -> FeaturePieces:
    """Replace specks by squares, each in place of its specks and of the feature with the largest part.

    Parameters
    ----------
    specks : FeaturePieces
        Polygons with less area than `least`.
    least : float
        Square metres: the area of a pixel. Cells begin at corners of pixels, and so are the same for all tiles.

    Examples
    --------
    >>> import shapely
    >>> shapes = shapely.box([0.0, 5.0, 75.0], [0.0, 0.0, 0.0], [4.0, 9.0, 75.5], [4.0, 4.0, 0.5])
    >>> specks = FeaturePieces(np.arange(3), np.array(["a", "b", "far"], object), shapes)
    >>> found = aggregate(specks, 100.0)
    >>> found.ids.tolist(), shapely.area(found.shapes).round(9).tolist()
    (['a'], [32.0])
    """
    import shapely

    made = []
    owner, area, middle = _parts(specks, np.sqrt(least))
    for times in CELLS:
        side = times * np.sqrt(least)
        cell, of = np.unique(np.floor(middle / side), axis=0, return_inverse=True)
        whole = np.bincount(of, area, len(cell))
        filled = whole >= SHARE * least
        ranked = np.lexsort((specks.order[owner], -area, of))  # largest part first, then first feature
        first = owner[ranked[np.searchsorted(of[ranked], np.arange(len(cell)))]]
        half = np.sqrt(np.minimum(whole, side**2))[:, np.newaxis] / 2.0
        at = np.stack([np.bincount(of, area * place, len(cell)) / whole for place in middle.T], axis=1)
        at = np.clip(at, cell * side + half, (cell + 1.0) * side - half)[filled]
        low, high = at - half[filled], at + half[filled]
        made.append(specks.take(first[filled]).with_shapes(shapely.box(*low.T, *high.T)))
        rest = ~filled[of]
        owner, area, middle = owner[rest], area[rest], middle[rest]
        if not len(owner):
            break
    return join_pieces(made)


def _parts(specks: FeaturePieces, side: float) -> tuple[NDArray[np.intp], NDArray[np.float64], NDArray[np.float64]]:
    """Divide specks, as squares, among cells: return the speck, the area and the middle of each part."""
    import shapely

    middle = shapely.get_coordinates(shapely.centroid(specks.shapes))
    half = np.sqrt(shapely.area(specks.shapes))[:, np.newaxis] / 2.0
    line = np.floor((middle + half) / side) * side  # between two cells, or outside the speck
    line = np.clip(line, middle - half, middle + half)
    ends = np.stack([middle - half, line, middle + half])  # parts lie west and south of it, or east and north
    size, at = np.diff(ends, axis=0), (ends[:-1] + ends[1:]) / 2.0
    area = size[:, np.newaxis, :, 0] * size[np.newaxis, :, :, 1]
    x, y = np.broadcast_arrays(at[:, np.newaxis, :, 0], at[np.newaxis, :, :, 1])
    there = area > 0.0
    owner = np.broadcast_to(np.arange(len(specks)), area.shape)[there]
    return owner, area[there], np.stack([x[there], y[there]], axis=1)
