"""Generalising: what is smaller than a part of a pixel goes, and what two polygons share stays shared.

Borders are cut where three meet into *arcs*, and each arc is simplified once. What lies on the sides of the box stays
where it is, so that pieces of one feature in boxes side by side still fit.

Polygons too small to be seen one by one, such as a town of blocks between streets, become squares of the same area: on
a map of the country they would be nowhere if all that is smaller than a pixel went.
"""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture_geo.base.extent import Bounds
from vexture_geo.base.validity import make_valid, unite_polygons
from vexture_geo.tiles.arcs import simplify_borders
from vexture_geo.tiles.pieces import FeaturePieces, join_pieces
from vexture_geo.tiles.shared_borders import shared_lengths

MOST_ROUNDS: Final = 32
"""In each of them, small polygons become part of larger ones beside them."""

MOST_POINTS: Final = 1_000_000
"""That are simplified at once, which takes some 300 bytes for each; only tiles that no longer part have more."""

DEEPEST: Final = 8
"""Times that the box of more points is quartered."""

CELLS: Final = (1, 2, 4)
"""Pixels across the cells in which specks are gathered; those that are too few in one are gathered in a larger one."""

SHARE: Final = 0.25
"""Of a pixel's area: of a cell whose specks have less in all, no square is made."""


def generalise_polygons(pieces: FeaturePieces, box: Bounds, tolerance: float, least: float) -> FeaturePieces:
    """Polygons for pixels of some size.

    Parameters
    ----------
    pieces : Pieces
        Polygons within the box.
    box : tuple of float
        What touches its sides goes on beyond.
    tolerance : float
        Metres by which a border may move.
    least : float
        Square metres. A smaller polygon becomes part of the neighbour with which it shares most of its border; those
        without one are aggregated (`aggregate`). Smaller holes are filled. With 0, all features
        stay.
    """
    if tolerance > 0.0 and pieces.points > MOST_POINTS:
        tolerance /= 2.0  # a half here, a half below
        pieces = _thin(pieces, box, tolerance, DEEPEST)
    return _generalise_at_once(pieces, box, tolerance, least)


def _thin(pieces: FeaturePieces, box: Bounds, tolerance: float, depth: int) -> FeaturePieces:
    """Polygons with fewer points, made in parts of the box, so that memory is for the points of one."""
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
    """As above, of all at once."""
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
    """The polygons; those whose rings cross are valid then."""
    import shapely

    broken = np.flatnonzero(~shapely.is_valid(shapes))
    if len(broken):
        shapes[broken] = make_valid(shapes[broken])
    return shapes


def dissolve(pieces: FeaturePieces) -> FeaturePieces:
    """Polygons of which those of one feature do not touch."""
    return _unite_groups(pieces, np.unique(pieces.order, return_inverse=True)[1])


def _unite_groups(pieces: FeaturePieces, group: NDArray[np.intp]) -> FeaturePieces:
    """One shape for each group of pieces; it is of the feature of the group's first piece."""
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
    """Polygons without those that are too small, which are part of a neighbour; and those that have none."""
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
    several = several[np.argsort(label[several] != several, kind="stable")]  # whose feature it is comes first
    groups = np.unique(label[several], return_inverse=True)[1]
    return join_pieces([pieces.take(stays & (sizes == 1)), _unite_groups(pieces.take(several), groups)]), pieces.take(
        ~stays
    )


def _labels(
    shapes: NDArray[Any], area: NDArray[np.float64], goes_on: NDArray[np.bool_], least: float
) -> tuple[NDArray[np.intp], NDArray[np.float64], NDArray[np.bool_]]:
    """The polygon that each becomes part of, or itself; their areas then, and which of them touch the box."""
    one, other, length = shared_lengths(shapes)
    label, whole, goes_on = np.arange(len(shapes)), area.copy(), goes_on.copy()
    for _ in range(MOST_ROUNDS):
        small = (whole < least) & ~goes_on
        a, b = label[one], label[other]
        apart = small[a] & (a != b)
        # to a larger one only, so that nobody goes in a circle
        apart &= (whole[b] > whole[a]) | ((whole[b] == whole[a]) & (b > a)) | goes_on[b]
        if not apart.any():
            break
        pairs, at = np.unique(a[apart] * len(label) + b[apart], return_inverse=True)
        best = np.lexsort((pairs, np.bincount(at, length[apart]), pairs // len(label)))
        pairs = pairs[best]  # of each small one, the longest border last
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
    """Squares in place of specks, each where they are and of the feature that has most of it.

    Parameters
    ----------
    specks : Pieces
        Polygons of less than `least`.
    least : float
        Square metres: the area of a pixel, at whose corners cells begin, the same for all tiles.

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
        ranked = np.lexsort((specks.order[owner], -area, of))  # the largest part's feature, and of those the first
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
    """Of each speck, as if it were a square, what is in each cell: whose it is, its area and its middle."""
    import shapely

    middle = shapely.get_coordinates(shapely.centroid(specks.shapes))
    half = np.sqrt(shapely.area(specks.shapes))[:, np.newaxis] / 2.0
    line = np.floor((middle + half) / side) * side  # between two cells, or beside the speck
    line = np.clip(line, middle - half, middle + half)
    ends = np.stack([middle - half, line, middle + half])  # west and south of it, and east and north
    size, at = np.diff(ends, axis=0), (ends[:-1] + ends[1:]) / 2.0
    area = size[:, np.newaxis, :, 0] * size[np.newaxis, :, :, 1]
    x, y = np.broadcast_arrays(at[:, np.newaxis, :, 0], at[np.newaxis, :, :, 1])
    there = area > 0.0
    owner = np.broadcast_to(np.arange(len(specks)), area.shape)[there]
    return owner, area[there], np.stack([x[there], y[there]], axis=1)
