"""Polygons too small to be seen one by one: squares of the same area replace many specks.

A town of blocks between streets, or islands, would be nowhere on a map of the country if all that is smaller than a
pixel went: here, what they cover of each pixel stays covered.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture_geo.tiles.pieces import FeaturePieces, join_pieces

CELLS: Final = (1, 2, 4)
"""Pixels across the cells in which specks are gathered; those that are too few in one are gathered in a larger one."""

SHARE: Final = 0.25
"""Of a pixel's area: of a cell whose specks have less in all, no square is made."""


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
