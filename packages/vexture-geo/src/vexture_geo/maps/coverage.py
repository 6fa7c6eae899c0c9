"""Clean coverages of polygons: snap borders, close gaps, and resolve overlaps by rank."""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import ParameterError
from vexture.base.notes import Notes
from vexture_geo.base.rings import Rings, rings_of, snap_rings
from vexture_geo.base.snap import DEFAULT_SNAP, MOST_SNAP
from vexture_geo.base.validity import make_valid
from vexture_geo.vector.features import Features

NOISE: Final = 1e-9
"""Overlaps with less area than this times the square of the map's larger side are ignored."""


def clean_coverage(
    rings: Rings,
    rank: NDArray[np.int64],
    size: float,
    snap: float | None,
    notes: Notes,
    *,
    names: NDArray[Any],
    unit: str,
    is_ordered: bool = False,
) -> Rings:
    """Make polygons share borders: close gaps up to `snap` wide, and give overlaps to the feature of higher rank.

    Parameters
    ----------
    rings : Rings
        Polygons of features.
    rank : (f,) array
        Order of the features; where they overlap, the higher one is visible.
    size : float
        Larger side of the map.
    snap : float or None
        As a fraction of `size`; 0 leaves everything as it is.
    notes : Notes
        Receives what was snapped and closed, and which polygons overlap. Moves by the default `snap` are not noted.
    names : (f,) array
        Names of the features.
    unit : str
        Unit of the coordinates, for the notes.
    is_ordered : bool
        Whether the user chose the order; then it is not noted that polygons lie below others.
    """
    width = (DEFAULT_SNAP if snap is None else snap) * size
    if rings.feature is None or len(np.unique(rings.feature)) < 2:
        return rings  # one feature has no neighbours
    if 0.0 < width <= MOST_SNAP * size and _is_clean(rings, width):
        return rings
    rings = snap_rings(rings, size, snap, notes, unit=unit, noticeable=DEFAULT_SNAP * (1.0 + 1e-9))
    if snap == 0.0 or len(rings.outer) < 2:
        return rings
    return _close_gaps(rings, rank, size, width, notes, names, is_ordered)


def _is_clean(rings: Rings, width: float) -> bool:
    """Return whether shared borders are already byte-identical, without overlaps and narrow gaps.

    This check costs much less than snapping.
    """
    import shapely

    try:
        return len(rings.outer) > 1 and bool(shapely.coverage_is_valid(rings.shapes, gap_width=width))
    except (shapely.errors.GEOSException, ValueError):
        return False


def _close_gaps(
    rings: Rings,
    rank: NDArray[np.int64],
    size: float,
    width: float,
    notes: Notes,
    names: NDArray[Any],
    is_ordered: bool,
) -> Rings:
    """Remove gaps and overlaps of polygons."""
    import shapely

    assert rings.feature is not None
    shapes = rings.shapes
    wrong = ~shapely.is_valid(shapes)
    shapes[wrong] = make_valid(shapes[wrong])
    try:
        found = shapely.coverage_invalid_edges(shapes, gap_width=width)
        amiss = ~shapely.is_empty(found)
        if not amiss.any():
            return rings
        order = np.argsort(-rank[rings.feature], kind="stable")  # the first polygon of an overlap keeps it
        clean = np.empty(len(shapes), object)
        clean[order] = shapely.coverage_clean(shapes[order], gap_width=width, merge_strategy="min_index")
    except (shapely.errors.GEOSException, ValueError):
        notes.remark("gaps between its polygons are as they were: they could not be closed")
        return rings
    change = shapely.area(clean) - shapely.area(shapes)
    _note_changes(change / size**2, names[rings.feature], notes, is_ordered)
    parts, owner = shapely.get_parts(clean, return_index=True)
    keep = (shapely.get_type_id(parts) == shapely.GeometryType.POLYGON) & ~shapely.is_empty(parts)
    origin = owner[keep]
    return rings_of(parts[keep], lambda index: rings.place(int(origin[index])), rings.feature[origin])


def _note_changes(change: NDArray[np.float64], names: NDArray[Any], notes: Notes, is_ordered: bool) -> None:
    """Note which polygons lost or gained area, as fractions of the square around the map."""
    if not is_ordered:
        below = "a polygon lies below others that overlap it: `order` says which is above"
        notes.features("remark", below, names[change < -NOISE])
    notes.features("remark", "a polygon has grown into narrow gaps beside it", names[change > NOISE])


def ranks(features: Features, order: str | None) -> NDArray[np.int64]:
    """Rank features for painting: by a column, or else smaller above larger; ties keep the order of the source.

    Raises
    ------
    ParameterError
        If there is no such column, or it cannot be sorted.
    """
    import pyarrow as pa
    import pyarrow.compute as pc
    import shapely

    if order is None:
        weights = shapely.area(features.rings.shapes)
        area: NDArray[np.float64] = np.bincount(features.feature, weights, len(features)).astype(np.float64)
        return ranks_by_area(area)
    if order not in features.table.column_names:
        known = ", ".join(features.table.column_names)
        raise ParameterError(f"it has no column {order!r} for `order`; there are: {known}")
    try:
        found = pc.sort_indices(features.table.column(order))
    except (pa.ArrowInvalid, pa.ArrowNotImplementedError, pa.ArrowTypeError):
        raise ParameterError(f"`order` {order!r} cannot be sorted; name a column of numbers or text") from None
    sequence = np.asarray(found, np.int64)
    nulls = np.asarray(features.table.column(order).is_null(nan_is_null=True))[sequence]
    sequence = np.append(sequence[nulls], sequence[~nulls])  # rows without a value are lowest
    return _places(sequence)


def ranks_by_area(area: NDArray[np.float64]) -> NDArray[np.int64]:
    """Rank features of some areas for painting: smaller above larger; ties keep the order of the source.

    Examples
    --------
    >>> ranks_by_area(np.array([1.0, 4.0, 1.0])).tolist()
    [1, 0, 2]
    """
    return _places(np.argsort(-area, kind="stable"))


def _places(sequence: NDArray[np.int64]) -> NDArray[np.int64]:
    """Place of each feature in a sequence of all."""
    rank = np.empty(len(sequence), np.int64)
    rank[sequence] = np.arange(len(sequence))
    return rank
