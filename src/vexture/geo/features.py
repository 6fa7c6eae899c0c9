"""Features: the polygons, lines and points of geographic data, with the attributes and the name of each.

All formats become arrays of shapely's geometries and one table of Arrow. GDAL gets a file only in memory, as in
`vexture.geo.vectors`; GeoParquet, which is columns already, goes past it.
"""

import json
import os
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.content import read_bytes
from vexture.errors import LimitError, ParameterError, SourceError
from vexture.geo.crs import MissingReferenceError, chosen_crs, gis_packages
from vexture.geo.geojson import WORLD
from vexture.geo.vectors import content_for_gdal, parted, read_by_gdal
from vexture.notes import Notes

if TYPE_CHECKING:
    from pyarrow import Table

__all__ = ["ID", "Features", "read_features"]

ID: Final = "id"
"""The column of names that every table begins with."""

PARQUET: Final = b"PAR1"
MOST_NAMED: Final = 8
"""Columns, or names, that a message lists."""

DEGREES: Final = (180.0, 90.0)
TEXTS: Final = (".json", ".topojson", ".geojson")
"""Files whose coordinates are degrees where they do not say it."""


@dataclass(frozen=True, eq=False)
class Features:
    """The f features of a source.

    Parameters
    ----------
    parts : (n,) array of shapely's geometries
        Polygons, lines and points, none of them empty or a collection, x before y.
    feature : (n,) intp array
        The feature of each part, ascending.
    ids : (f,) array of str
        Each once: the column that was chosen, or ``id``, or the number that the format gives.
    table : pyarrow.Table
        Attributes, f rows; the first column, ``id``, is `ids`.
    crs : str
        Reference system of the parts.
    """

    parts: NDArray[Any]
    feature: NDArray[np.intp]
    ids: NDArray[np.str_]
    table: "Table"
    crs: str


def listed(names: Sequence[str]) -> str:
    """Some of the names, for a message."""
    return ", ".join(map(repr, names[:MOST_NAMED])) + (", ..." if len(names) > MOST_NAMED else "") or "none"


@gis_packages()
def read_features(
    source: Any,
    *,
    layer: str | None = None,
    where: str | None = None,
    crs: str | None = None,
    id: str | None = None,
    columns: Sequence[str] | None = None,
    notes: Notes,
) -> Features:
    """Read the features of a vector file, or of a GeoDataFrame.

    Parameters
    ----------
    source : path or GeoDataFrame
        GeoPackage, GeoParquet, FlatGeobuf, shapefile, GeoJSON or TopoJSON.
    layer : str, optional
        Where there are several.
    where : str, optional
        Condition on attributes, as in SQL: ``"population > 1000 AND state = 'CA'"``.
    crs : str, optional
        Reference system of the source; it overrides the one in the file.
    id : str, optional
        Column of the features' names.
    columns : sequence of str, optional
        Attributes to read; by default all.
    notes : Notes
        Gets what is left out.

    Raises
    ------
    SourceError
        If it cannot be read.
    ParameterError
        If it has no such layer or column, the condition is not understood or holds of nothing, or names repeat in a
        column that was chosen.
    """
    wkb, table, found = _columns_of(source, layer, where)
    if table.num_rows == 0:
        raise _nothing(where)
    wanted = [name for name in (id, *(columns or ())) if name is not None]
    for name in wanted:
        if name not in table.column_names:
            raise ParameterError(f"there is no column {name!r}; the columns are {listed(_attributes(table))}")
    ids = _ids(table, id, notes)
    kept = _attributes(table) if columns is None else [*dict.fromkeys(columns)]
    import pyarrow as pa

    attributes = {name: table.column(name) for name in kept if name.lower() != ID}
    parts, feature = parted(wkb, notes)
    if not len(parts):
        raise SourceError(f"none of its {table.num_rows:,} features has a place; give some with geometries")
    if not (crs or found):
        found = _guessed(parts, source)
    return Features(parts, feature, ids, pa.table({ID: ids.tolist(), **attributes}), chosen_crs(crs, found))


FID: Final = "fid"
"""The number that a format gives to a feature."""


def _attributes(table: "Table") -> list[str]:
    return [name for name in table.column_names if name != FID]


def _nothing(where: str | None) -> Exception:
    if where is None:
        return SourceError("it has no features; give a layer that has some")
    return ParameterError(f"`where` {where!r} holds of no feature; correct it")


def _ids(table: "Table", chosen: str | None, notes: Notes) -> NDArray[np.str_]:
    """Names of the features, each once."""
    found = chosen or next((name for name in _attributes(table) if name.lower() == ID), None)
    if found is not None:
        values = table.column(found).to_pylist()
        texts = np.array(["" if value is None else _text(value) for value in values])
        names, count = np.unique(texts, return_counts=True)
        if len(names) == len(texts) and "" not in names:
            return texts
        worst = str(names[count.argmax()])
        if chosen is not None:
            what = f"{worst!r} {int(count.max())} times" if count.max() > 1 else "a feature without a value"
            raise ParameterError(
                f"`id` {chosen!r}: the column has {what}; choose one in which each value is there once"
            )
        notes.remark(f"its column {found!r} has {worst!r} {int(count.max())} times, so features are named by number")
    return np.array([str(number) for number in table.column(FID).to_pylist()])


def _text(value: Any) -> str:
    return str(int(value)) if isinstance(value, float) and value.is_integer() else str(value)


def _guessed(parts: NDArray[Any], source: Any) -> str | None:
    """The reference system of GeoJSON and TopoJSON that name none: degrees (RFC 7946, 4), if they can be."""
    import shapely

    if not isinstance(source, str | os.PathLike) or Path(source).suffix.lower() not in TEXTS:
        return None
    x0, y0, x1, y1 = shapely.total_bounds(parts)
    within = max(abs(x0), abs(x1)) <= 2 * DEGREES[0] and max(abs(y0), abs(y1)) <= DEGREES[1]
    if not within:
        raise MissingReferenceError(
            f"it names no reference system, and x from {x0:g} to {x1:g} is not in degrees; give the one of the source"
        )
    return WORLD


def _columns_of(source: Any, layer: str | None, where: str | None) -> tuple[NDArray[Any], "Table", str | None]:
    """WKB of each feature, or None; all attributes, with `FID`; and the reference system that the source names."""
    if hasattr(source, "geometry") and hasattr(source, "to_arrow"):
        return _of_frame(source, layer, where)
    if not isinstance(source, str | os.PathLike):
        kind = type(source).__name__
        raise TypeError(f"`source` is of the type {kind}; give a path or a GeoDataFrame")
    content = read_bytes(source)
    if content.startswith(PARQUET):
        return _of_parquet(content, layer, where)
    content = content_for_gdal(source, content)
    return read_by_gdal(content, layer, where)


def _of_frame(frame: Any, layer: str | None, where: str | None) -> tuple[NDArray[Any], "Table", str | None]:
    """Of a GeoDataFrame, whose index names the features."""
    import pyarrow as pa
    import shapely

    _refuse_layer(layer, "a GeoDataFrame")
    if where is not None:
        frame = frame.query(where)
    attributes = {str(name): pa.array(frame[name]) for name in frame.columns if name != frame.geometry.name}
    attributes.pop(FID, None)
    table = pa.table({FID: pa.array([str(name) for name in frame.index]), **attributes})
    crs = None if frame.crs is None else frame.crs.to_wkt()
    return np.asarray(shapely.to_wkb(frame.geometry.array), object), table, crs


def _of_parquet(content: bytes, layer: str | None, where: str | None) -> tuple[NDArray[Any], "Table", str | None]:
    """Of GeoParquet (1.0 and 1.1), whose geometries are WKB."""
    import pyarrow as pa
    from pyarrow import parquet

    _refuse_layer(layer, "GeoParquet")
    try:
        table = parquet.read_table(BytesIO(content))
        said = json.loads((table.schema.metadata or {})[b"geo"])
        name = said["primary_column"]
        described = said["columns"][name]
        encoding, crs = described["encoding"], described.get("crs", WORLD)
        shapes = table.column(name)
    except (pa.ArrowException, KeyError, TypeError, ValueError, OSError) as error:
        if isinstance(error, KeyError):
            raise SourceError("it is Parquet without geometries; write it as GeoParquet") from None
        raise SourceError(f"it is damaged Parquet ({' '.join(str(error).split())[:120]}); save it again") from None
    if encoding != "WKB":
        raise SourceError(f"its geometries are encoded as {str(encoding)[:40]!r}; write them as WKB")
    others = [column for column in table.column_names if column not in (name, *_other_geometries(said), FID)]
    table = table.select([name, *others]).add_column(0, FID, pa.array(range(table.num_rows)))
    if where is not None:
        table = _filtered(table, where)
        shapes = table.column(name)
    text = json.dumps(crs) if isinstance(crs, dict) else crs
    return np.array(shapes.to_pylist(), object), table.drop_columns([name]), text


def _other_geometries(said: dict[str, Any]) -> list[str]:
    return [*said.get("columns", ()), "bbox"]


CONDITION: Final = re.compile(r"""\s*"?([^"'<>=!]+?)"?\s*(<=|>=|<>|!=|=|<|>)\s*('(?:[^']|'')*'|[-+.\deE]+)\s*""")
CONJUNCTION: Final = re.compile(r"\s+AND\s+", re.IGNORECASE)


def _filtered(table: "Table", where: str) -> "Table":
    """Rows of which a condition holds: comparisons of a column with a number or a text, joined by AND."""
    import pyarrow as pa
    import pyarrow.compute as pc

    chosen = None
    for text in CONJUNCTION.split(where.strip()):
        match = CONDITION.fullmatch(text)
        if match is None:
            raise ParameterError(
                f"`where` {text!r} is not understood; of GeoParquet, compare columns with numbers or 'texts', "
                "joined by AND"
            )
        name, sign, value = match.groups()
        if name not in table.column_names:
            raise ParameterError(f"`where`: there is no column {name!r}; the columns are {listed(_attributes(table))}")
        compare = {"<": pc.less, "<=": pc.less_equal, ">": pc.greater, ">=": pc.greater_equal, "=": pc.equal}
        act = compare.get(sign, pc.not_equal)
        try:
            operand = value[1:-1].replace("''", "'") if value.startswith("'") else float(value)
            found = act(table.column(name), pa.scalar(operand))
        except (pa.ArrowException, ValueError):
            raise ParameterError(f"`where` {text!r}: the column is of the type {table.column(name).type}") from None
        chosen = found if chosen is None else pc.and_(chosen, found)
    return table.filter(chosen)


def _refuse_layer(layer: str | None, kind: str) -> None:
    if layer is not None:
        raise ParameterError(f"`layer` {layer!r}: {kind} has no layers; leave it out")


def joined(several: Sequence[Features]) -> Features:
    """Features of one reference system after one another; names stay as they are, if none is there twice."""
    if len(several) == 1:
        return several[0]
    import pyarrow as pa

    ids = np.concatenate([one.ids for one in several])
    names, count = np.unique(ids, return_counts=True)
    if count.max() > 1:
        raise LimitError(
            f"two sources name a feature {str(names[count.argmax()])!r}; give `id`, a column of other names"
        )
    before = np.cumsum([0, *(len(one.ids) for one in several)])
    return replace(
        several[0],
        parts=np.concatenate([one.parts for one in several]),
        feature=np.concatenate([one.feature + start for one, start in zip(several, before, strict=False)]),
        ids=ids,
        table=pa.concat_tables([one.table for one in several], promote_options="permissive"),
    )
