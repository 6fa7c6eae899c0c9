"""Features of geographic data: polygons, lines and points with an id and attributes, whole or in batches."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import ParameterError
from vexture.base.labels import texts_of
from vexture.base.notes import Notes
from vexture.base.tolerance import UNSEEN
from vexture_geo.base.coordinate_units import refuse_degrees
from vexture_geo.base.crs import MissingReferenceError, choose_crs, format_system, gis_packages, period, same_system
from vexture_geo.base.extent import Bounds
from vexture_geo.base.longitudes import close_over_poles, jumping
from vexture_geo.base.rings import Rings, refuse_far, repair_rings, rings_of
from vexture_geo.vector.feature_ids import names_beside_id
from vexture_geo.vector.feature_tables import FeatureChunk, FeatureQuery, chunks_of
from vexture_geo.vector.geojson import UNLOCATED, WORLD
from vexture_geo.vector.vectors import DAMAGED, parse_wkb, parts_of

if TYPE_CHECKING:
    import pyarrow

ID: Final = "id"
"""Column of ids of features in a table."""

NEAR: Final = 10.0
"""Distance from the origin, in units, within which drawings begin, but maps in degrees rarely do."""

BATCH: Final = 65_536
"""Most features in memory at once while streaming."""

Source = Any
"""A path, the content of a file, or a GeoDataFrame."""


@dataclass(frozen=True, eq=False)
class Lines:
    """Lines: `points`, (n, 2), of all lines, the index after the last point of each, and the feature of each."""

    points: NDArray[np.float64]
    ends: NDArray[np.intp]
    feature: NDArray[np.intp]

    @property
    def steps(self) -> NDArray[np.float64]:
        """Eastward distance of the side that ends at each point; 0 for the first point of a line."""
        steps = np.diff(self.points[:, 0], prepend=self.points[:1, 0])
        steps[self.ends[:-1]] = 0.0
        return steps


@dataclass(frozen=True, eq=False)
class Points:
    """Places, (n, 2), and the feature of each."""

    points: NDArray[np.float64]
    feature: NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Features:
    """Features of one layer.

    Parameters
    ----------
    rings : Rings
        Valid polygons in x, y in the units of `crs`, each with its `feature`.
    ids : (f,) array of str
        Unique ids of the features.
    table : pyarrow.Table
        Attributes without geometries, f rows; the first column is ``id``.
    crs : str
    lines, points : Lines, Points
        Lines and points of the features.
    """

    rings: Rings
    ids: NDArray[Any]
    table: "pyarrow.Table"
    crs: str
    lines: Lines
    points: Points
    is_numbered: bool = False
    """Whether ids are only the numbers of features, because the source has none."""

    @property
    def feature(self) -> NDArray[np.intp]:
        """Feature of each polygon, (p,)."""
        assert self.rings.feature is not None
        return self.rings.feature

    def __len__(self) -> int:
        return len(self.ids)

    def refuse_numbers(self, column: str) -> None:
        """Raise a `ParameterError` if `column` is ``id`` and ids are only numbers, which colours cannot show."""
        if column == ID and self.is_numbered:
            others = self.table.column_names[1:]
            is_there = any(name.rstrip("_") == ID for name in others)
            remedy = f"give `id` {ID} as well" if is_there else f"there are: {', '.join(others) or 'none'}"
            raise ParameterError(f"`color` is {ID!r}, but its features have numbers rather than ids; {remedy}")


@gis_packages()
def read_features(
    source: Source,
    *,
    layer: str | None = None,
    where: str | None = None,
    crs: str | None = None,
    id: str | None = None,
    columns: Sequence[str] | None = None,
    bounds: Bounds | None = None,
    notes: Notes,
) -> Features:
    """Read the features of a file of any supported format (`content.VECTOR_FILES`), or of a GeoDataFrame.

    Parameters
    ----------
    source : path, bytes or GeoDataFrame
    layer : str, optional
        Layer to read, if the source has several.
    where : str, optional
        Condition in SQL on the attributes, such as ``population > 1000 AND kind = 'town'``.
    crs : str, optional
        Reference system of the source, if it names none.
    id : str, optional
        Column that identifies features. By default it is the format's own id, or the index of a GeoDataFrame if it is
        not the default one and its labels are unique, or else the feature's number, from 0.
    columns : sequence of str, optional
        Attributes to keep; all by default.
    bounds : tuple of float, optional
        West, south, east, north in units of the source: only features whose boxes touch it are read.
    notes : Notes
        Receives what is left out or repaired.

    Raises
    ------
    SourceError
        If it cannot be read, or names no reference system.
    ParameterError
        If there is no such layer or column, or the condition is wrong.
    """
    choice = FeatureQuery(layer, where, id, None if columns is None else tuple(columns), bounds)
    (chunk,) = chunks_of(source, choice, None)
    return _features(chunk, choice, crs, {}, notes)


@gis_packages()
def feature_batches(
    source: Source,
    *,
    layer: str | None = None,
    where: str | None = None,
    crs: str | None = None,
    id: str | None = None,
    columns: Sequence[str] | None = None,
    bounds: Bounds | None = None,
    notes: Notes,
    batch: int = BATCH,
) -> Iterator[Features]:
    """Read features like `read_features`, at most `batch` at once; formats that are read as a whole are small."""
    if batch < 1:
        raise ParameterError(f"`batch` is {batch}; it must be 1 or more features")
    choice = FeatureQuery(layer, where, id, None if columns is None else tuple(columns), bounds)
    seen: dict[str, int] = {}
    for chunk in chunks_of(source, choice, batch):
        yield _features(chunk, choice, crs, seen, notes)


def _features(
    chunk: FeatureChunk, choice: FeatureQuery, crs: str | None, counts: dict[str, int], notes: Notes
) -> Features:
    """Make the features of a chunk; `counts` holds the counts of ids in earlier chunks."""
    import shapely

    notes.remark("the file is damaged: a geometry refers to arcs that it does not have", chunk.damaged)
    for said, count in chunk.remarks.items():
        notes.remark(said, count)
    if chunk.unlabelled and chunk.id_column is None:
        notes.remark(f"its index {chunk.unlabelled}, so ids are the numbers of rows; name a column of ids by `id`")
    if chunk.parsed:
        given = ~(shapely.is_missing(chunk.shapes) | shapely.is_empty(chunk.shapes))
        whole, owner, damaged = chunk.shapes[given], np.flatnonzero(given), np.zeros(0, np.intp)
    else:
        whole, owner, damaged = parse_wkb(chunk.shapes, Notes())
    unlocated = np.setdiff1d(np.arange(len(chunk.shapes)), np.concatenate([owner, damaged]))
    if choice.bounds is not None and not chunk.bounded:
        west, south, east, north = choice.bounds
        boxes = shapely.bounds(whole)
        near = (boxes[:, 0] <= east) & (boxes[:, 2] >= west) & (boxes[:, 1] <= north) & (boxes[:, 3] >= south)
        whole, owner = whole[near], owner[near]
        kept, owner = np.unique(owner, return_inverse=True)
        for message, lost in ((UNLOCATED, unlocated), (DAMAGED, damaged)):
            for _ in range(len(lost)):
                notes.left_out(message)
        chunk, unlocated, damaged = chunk.take(kept), unlocated[:0], damaged[:0]
    parts, of = parts_of(whole)
    kinds, feature = shapely.get_type_id(parts), owner[of].astype(np.intp)
    ids = _ids(chunk, choice, counts, notes)
    notes.features("left out", UNLOCATED, ids[unlocated])
    notes.features("left out", DAMAGED, ids[damaged])
    short = _short(parts, notes)
    parts, kinds, feature = parts[~short], kinds[~short], feature[~short]
    owners = feature[kinds == 3]
    rings = rings_of(parts[kinds == 3], lambda index: f"feature {ids[owners[index]]}", owners)
    refuse_far(rings, "correct it")
    lines = (kinds == shapely.GeometryType.LINESTRING) | (kinds == shapely.GeometryType.LINEARRING)
    spots = (kinds == shapely.GeometryType.POINT) & ~shapely.is_empty(parts)
    is_nowhere = not len(whole) and not len(damaged) and not (crs or chunk.crs(rings.points))
    system = WORLD if is_nowhere else _system(chunk, rings, crs, notes)
    if not shapely.is_empty(parts).all():
        box = tuple(shapely.total_bounds(parts).tolist())
        refuse_degrees(system, box, is_given=crs is not None and not chunk.is_told, near=NEAR)
    rings = _valid(rings, period(system), ids, notes)
    points = Points(shapely.get_coordinates(parts[spots]), feature[spots])
    numbered = chunk.id_column is None and chunk.labels is None
    return Features(rings, ids, _table(chunk, ids), system, _lines(parts[lines], feature[lines]), points, numbered)


def _system(chunk: FeatureChunk, rings: Rings, crs_option: str | None, notes: Notes) -> str:
    """Choose the reference system of a chunk: the source's own, or else the given one."""
    found = chunk.crs(rings.points)
    if crs_option is None or not chunk.is_told:
        try:
            return choose_crs(crs_option, found)
        except MissingReferenceError as error:
            if not chunk.parsed:
                raise
            raise MissingReferenceError(f"{error}, or set it by set_crs") from None
    system = choose_crs(None, found)
    if not same_system(other := choose_crs(crs_option, None), system):
        own, unused = format_system(system), format_system(other)
        notes.remark(f"it names its own reference system, {own}, so {unused} is not used for it")
    return system


def _valid(rings: Rings, turn: float | None, ids: NDArray[Any], notes: Notes) -> Rings:
    """Repair polygons and note visible repairs; those that jump over the antimeridian are unwrapped later."""
    import shapely

    if not len(rings.ends):
        return rings
    later = np.zeros(len(rings.outer), np.bool_)
    if turn:
        rings, polar = close_over_poles(rings, turn)
        notes.remark("a polygon around a pole is closed along the antimeridian", polar)
        later = jumping(rings, turn)
    here = rings.take(np.flatnonzero(~later)) if later.any() else rings
    wrong = ~shapely.is_valid(here.shapes)
    if wrong.any():
        assert here.feature is not None
        owner, before = here.feature[wrong], _areas(here, len(ids))
        here = repair_rings(here, notes)
        change = np.abs(_areas(here, len(ids)) - before)[owner]
        seen = change > (UNSEEN / 10 * np.ptp(rings.points, axis=0).max()) ** 2
        notes.features("remark", "a polygon that crossed or overlapped itself is repaired", ids[owner[seen]])
    return here.concatenate(rings.take(np.flatnonzero(later))) if later.any() else here


def _areas(rings: Rings, count: int) -> NDArray[np.float64]:
    """Area of the polygons of each feature, (count,)."""
    import shapely

    assert rings.feature is not None
    return np.bincount(rings.feature, shapely.area(rings.shapes), minlength=count).astype(np.float64)


def _short(parts: NDArray[Any], notes: Notes) -> NDArray[np.bool_]:
    """Find polygons with a ring of fewer than three corners, which enclose nothing."""
    import shapely

    rings, owner = shapely.get_rings(parts, return_index=True)
    found = np.zeros(len(parts), np.bool_)
    found[owner[shapely.get_num_coordinates(rings) < 4]] = True
    for _ in range(int(found.sum())):
        notes.left_out("polygon with a ring of fewer than three corners")
    return found


def _lines(lines: NDArray[Any], feature: NDArray[np.intp]) -> Lines:
    import shapely

    points, owner = shapely.get_coordinates(lines, return_index=True)
    return Lines(points, np.searchsorted(owner, np.arange(len(lines)), side="right"), feature)


def _ids(chunk: FeatureChunk, choice: FeatureQuery, counts: dict[str, int], notes: Notes) -> NDArray[Any]:
    """Ids of features as texts; an id that occurred before gets a number."""
    if chunk.id_column is None and chunk.labels is not None:
        return chunk.labels
    if chunk.id_column is None:
        return np.array([str(number) for number in chunk.numbers.tolist()], object)
    values = texts_of(chunk.table.column(chunk.id_column).to_pylist())
    texts, again, none = list[str](), list[str](), list[str]()
    for value, number in zip(values, chunk.numbers.tolist(), strict=True):
        name = f"#{number}" if value is None or value == "" else value
        if name != value:
            none.append(name)
        is_again = bool(before := counts.get(name, 0))
        counts[name] = before + 1
        while before and (name := f"{value}#{before + 1}") in counts:
            before += 1
        if before:
            counts[name] = 1
        if is_again:
            again.append(name)
        texts.append(name)
    notes.features("remark", f"a feature has no {chunk.id_column!r}: its id is # and its number", none)
    notes.features("remark", "a feature has an id that another had before: its own ends in #2, #3, ...", again)
    return np.array(texts, object)


def _table(chunk: FeatureChunk, ids: NDArray[Any]) -> "pyarrow.Table":
    """Attributes with `id` as the first column."""
    import pyarrow as pa

    table = chunk.table
    if "id" in table.column_names:
        at = table.column_names.index("id")
        same = chunk.id_column == "id"
        table = table.remove_column(at) if same else table.rename_columns(names_beside_id(table.column_names))
    others = dict(zip(table.column_names, table.columns, strict=True))
    return pa.table({"id": pa.array(ids.tolist(), pa.string()), **others})
