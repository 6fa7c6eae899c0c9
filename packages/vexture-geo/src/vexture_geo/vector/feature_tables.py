"""Tables of features in any format: attributes in Arrow with geometries in WKB, in chunks."""

import os
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field, replace
from itertools import islice
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.content import VECTOR_FILES, unpack_source
from vexture.base.errors import ParameterError, SourceError, shorten_text
from vexture_geo.base.damage import missing_arcs
from vexture_geo.base.extent import Bounds
from vexture_geo.vector.archives import unzip
from vexture_geo.vector.arrow_files import is_table, open_table
from vexture_geo.vector.feature_ids import ids_of_json, with_ids
from vexture_geo.vector.frames import arrow_of, check_texts, labels_of
from vexture_geo.vector.geojson import WORLD
from vexture_geo.vector.geoparquet import GeometryColumn, geometry_column, objects_of
from vexture_geo.vector.vector_files import VectorFile, open_vectors
from vexture_geo.vector.vectors import choose_layer, gdal_errors, layers_of

if TYPE_CHECKING:
    import pyarrow

PART: Final = 16_384
"""Number of features that are filtered by a condition at once."""

MOST_NAMED: Final = 12
"""Most columns that a message names."""

REFUSALS: Final = ("Invalid SQL", "no such column", "syntax error")
"""Words in GDAL's errors about a condition, at once or, in a database, while reading."""

READ: Final = f"give a file of GeoJSON, TopoJSON, {VECTOR_FILES}"


@dataclass(frozen=True)
class FeatureQuery:
    """The part of a source to read."""

    layer: str | None = None
    where: str | None = None
    id: str | None = None
    columns: tuple[str, ...] | None = None
    bounds: Bounds | None = None

    def select_columns(self, names: list[str]) -> list[str]:
        """Select the columns to read among all; `ParameterError` if one is missing."""
        for parameter, wanted in (("id", () if self.id is None else (self.id,)), ("columns", self.columns or ())):
            for name in wanted:
                if name not in names:
                    shown = ", ".join(names[:MOST_NAMED]) + (", ..." if len(names) > MOST_NAMED else "")
                    raise ParameterError(f"it has no column {name!r} for `{parameter}`; there are: {shown or 'none'}")
        return [name for name in names if self.columns is None or name in self.columns or name == self.id]


@dataclass(frozen=True, eq=False)
class FeatureChunk:
    """Some features: attributes, geometries (WKB, or shapely geometries if `parsed`) and numbers in the source."""

    table: "pyarrow.Table"
    shapes: NDArray[Any]
    numbers: NDArray[np.int64]
    system: str | None
    id_column: str | None = None
    parsed: bool = False
    bounded: bool = False
    """Whether the bounds are already applied."""

    fallback: str | None = field(default=None)
    """Reference system for coordinates that can be degrees, if the source names none."""

    is_told: bool = False
    """Whether the source itself names its reference system, rather than implying it by its format."""

    labels: NDArray[Any] | None = None
    """Ids from the index of a GeoDataFrame, if no column has ids."""

    unlabelled: str = ""
    """Reason why the index of a GeoDataFrame does not serve as ids."""

    damaged: int = 0
    """Number of geometries that are incomplete in the source itself."""

    remarks: Mapping[str, int] = field(default_factory=dict)
    """Remarks on the source with their counts, such as links that are not read."""

    def take(self, rows: NDArray[np.intp]) -> "FeatureChunk":
        """Select rows, all of which are within bounds."""
        labels = None if self.labels is None else self.labels[rows]
        part = replace(self, table=self.table.take(rows), shapes=self.shapes[rows], numbers=self.numbers[rows])
        return replace(part, labels=labels, bounded=True)

    def crs(self, points: NDArray[np.float64]) -> str | None:
        """Return the reference system that the source names, or that its coordinates allow."""
        if self.system or self.fallback is None:
            return self.system
        degrees = not len(points) or bool((np.abs(points).max(axis=0) <= (360.0, 90.0)).all())
        return self.fallback if degrees else None


def chunks_of(source: Any, choice: FeatureQuery, batch: int | None) -> Iterator[FeatureChunk]:
    """Read the features of a source, at most `batch` at once, or all in one chunk."""
    if hasattr(source, "geometry") and hasattr(source, "crs"):
        yield from _split(_frame(source, choice), batch)
        return
    if not isinstance(source, str | bytes | os.PathLike):
        raise ParameterError(f"`source` is a {type(source).__name__}; {READ}, or a GeoDataFrame")
    source = unzip(unpack_source(source))
    if is_table(source):
        yield from _parquet(source, choice, batch)
        return
    with open_vectors(source) as file:
        yield from _gdal(file, choice, batch)


def _gdal(file: VectorFile, choice: FeatureQuery, batch: int | None) -> Iterator[FeatureChunk]:
    import pyarrow as pa
    from pyogrio import raw, read_info

    content, is_json = file.content, file.is_json
    with gdal_errors(file.formats):
        found = layers_of(file, choice.layer)
        layers = [layer for layer in found if layer.kind is not None]
        if found and not layers:
            raise SourceError(f"it has no geometries, only a table ({found[0].name}); give the file of its places")
        number = choose_layer(layers, choice.layer, any_kind=True).number
        info = read_info(content, layer=number)
    names = [str(each) for each in info["fields"]]
    columns = choice.select_columns(names)
    may_have_ids = is_json and choice.id is None
    ids = ids_of_json(content, "id" in names) if may_have_ids and isinstance(content, bytes) else {}
    own = "id" if may_have_ids and "id" in names and not ids else choice.id
    if own is not None and own not in columns:
        columns.append(own)
    options: dict[str, Any] = {"layer": number, "columns": columns, "where": choice.where, "bbox": choice.bounds}
    options |= {"return_fids": True, "batch_size": batch or 65_536, "use_pyarrow": True}
    topology = is_json and not info["crs"]
    damaged = missing_arcs(content) if topology and isinstance(content, bytes) else 0
    links = file.links
    with ExitStack() as stack:
        with _condition(choice.where, names), gdal_errors(file.formats):
            meta, reader = stack.enter_context(raw.open_arrow(content, **options))
        places = meta["fid_column"] or "OGC_FID", meta["geometry_name"] or "wkb_geometry"
        while True:  # no lock of GDAL is held while the caller works on a chunk
            with _condition(choice.where, names), gdal_errors(file.formats):
                table = (
                    reader.read_all() if batch is None else pa.Table.from_batches([*islice(reader, 1)], reader.schema)
                )
            if batch is None or len(table):
                chunk = _arrow_chunk(table, *places, own, topology, is_json, meta["crs"], damaged)
                chunk = replace(chunk, remarks=links)
                yield replace(chunk, table=with_ids(chunk.table, chunk.numbers, ids), id_column="id") if ids else chunk
                damaged, links = 0, {}
            if batch is None or not len(table):
                return


def _arrow_chunk(
    table: "pyarrow.Table",
    number: str,
    geometry: str,
    id_column: str | None,
    topology: bool,
    is_json: bool,
    crs: str | None,
    damaged: int,
) -> FeatureChunk:
    """Make a chunk of GDAL's table: GDAL's number precedes attributes of that name, and its geometry follows them."""
    first, last = table.schema.get_all_field_indices(number)[0], table.schema.get_all_field_indices(geometry)[-1]
    numbers = np.asarray(table.column(first).to_numpy(), np.int64)
    shapes = objects_of(table.column(last))
    kept = table.remove_column(last).remove_column(first)
    check_texts(kept)
    return FeatureChunk(
        kept,
        shapes,
        numbers,
        crs,
        id_column,
        bounded=True,
        fallback=WORLD if topology else None,
        is_told=crs is not None and not is_json,
        damaged=damaged,
    )


@contextmanager
def _condition(condition: str | None, names: list[str]) -> Iterator[None]:
    """Add the names of existing columns to GDAL's error about a condition."""
    try:
        yield
    except SourceError as error:
        if condition is None or not any(sign in str(error) for sign in REFUSALS):
            raise
        raise ParameterError(_refusal(condition, names)) from None


def _refusal(condition: str, names: list[str]) -> str:
    shown = ", ".join(names[:MOST_NAMED]) + (", ..." if len(names) > MOST_NAMED else "")
    return f"`where` {condition!r} is no condition on its columns; there are: {shown or 'none'}"


def _parquet(source: Any, choice: FeatureQuery, batch: int | None) -> Iterator[FeatureChunk]:
    import pyarrow as pa

    if choice.layer is not None:
        raise ParameterError(f"a table has no layers, so none {choice.layer!r}; leave `layer` out")
    try:
        file = open_table(source)
        geometry = geometry_column(file)
        names = [name for name in file.schema_arrow.names if name != geometry.name]
        columns = choice.select_columns(names)
        used = names if choice.where is not None else columns  # a condition may use any column
        wanted = [*used, geometry.name]
        if batch is None and choice.where is None:
            table = file.read(wanted, use_threads=False)  # a thread that runs out of memory ends the process
            yield _parquet_chunk(table, np.arange(len(table)), geometry, columns, choice)
            return
        first, kept = 0, []
        for part in file.iter_batches(batch_size=batch or PART, columns=wanted, use_threads=False):
            table, numbers = pa.Table.from_batches([part]), np.arange(first, first + len(part))
            first += len(part)
            if choice.where is not None:
                rows = _rows_where(table.drop_columns([geometry.name]), choice.where)
                table, numbers = table.take(rows), numbers[rows]
            if batch is None:  # only selected rows are ever in memory together
                kept.append((table, numbers))
            else:
                yield _parquet_chunk(table, numbers, geometry, columns, choice)
                geometry = replace(geometry, remarks=())
        if batch is None:
            tables = [table for table, _ in kept] or [file.schema_arrow.empty_table().select(wanted)]
            numbers = np.concatenate([np.empty(0, np.int64), *(each for _, each in kept)])
            yield _parquet_chunk(pa.concat_tables(tables), numbers, geometry, columns, choice)
    except (pa.ArrowInvalid, pa.ArrowNotImplementedError, OSError, UnicodeDecodeError) as error:  # the last for names
        raise SourceError(f"the table cannot be read ({shorten_text(str(error), 120)}); save it again") from None


def _parquet_chunk(
    table: "pyarrow.Table",
    numbers: NDArray[np.int64],
    geometry: GeometryColumn,
    columns: list[str],
    choice: FeatureQuery,
) -> FeatureChunk:
    shapes, crs = geometry.shapes(table), geometry.crs
    told = dict.fromkeys(geometry.remarks, 1)
    is_told = crs not in (None, WORLD)
    return FeatureChunk(table.select(columns), shapes, numbers, crs, choice.id, is_told=is_told, remarks=told)


def _rows_where(table: "pyarrow.Table", condition: str) -> NDArray[np.intp]:
    """Indices of rows that meet a condition in SQL."""
    import duckdb
    import pyarrow as pa

    number = "__row"
    numbered = table.append_column(number, pa.array(np.arange(len(table))))
    with duckdb.connect(config={"enable_external_access": False, "threads": 1}) as connection:
        connection.register("features", numbered)
        try:
            found = connection.execute(f"SELECT {number} FROM features WHERE ({condition})").fetchnumpy()[number]
        except duckdb.Error:
            raise ParameterError(_refusal(condition, table.column_names)) from None
    return np.sort(np.asarray(found, np.intp))


def _frame(frame: Any, choice: FeatureQuery) -> FeatureChunk:
    """Make a chunk of a GeoDataFrame."""
    import pyarrow as pa

    if choice.layer is not None:
        raise ParameterError(f"a GeoDataFrame has no layers, so none {choice.layer!r}; leave `layer` out")
    shapes = np.asarray(frame.geometry.values, object)
    columns = [] if frame.ndim == 1 else [str(name) for name in frame.columns]
    if len(set(columns)) < len(columns):
        again = next(name for name in columns if columns.count(name) > 1)
        raise ParameterError(f"it has several columns {again!r}; rename all but one")
    given = {} if frame.ndim == 1 else dict(zip(columns, (frame[name] for name in frame.columns), strict=True))
    others = {name: arrow_of(values) for name, values in given.items() if str(values.dtype) != "geometry"}
    labels, why = labels_of(frame.index)
    if why:  # keeps the levels of the index as columns
        named = [(number, str(name)) for number, name in enumerate(frame.index.names) if name is not None]
        levels = {name: frame.index.get_level_values(number) for number, name in named}
        others = {name: arrow_of(level.to_series()) for name, level in levels.items() if name not in columns} | others
    if labels is not None and choice.id == frame.index.name and choice.id not in others:
        choice = replace(choice, id=None)
    columns = choice.select_columns([*others])
    table = pa.table(others) if others else pa.table({"row": np.arange(len(shapes))})
    rows = np.arange(len(shapes)) if choice.where is None else _rows_where(table, choice.where)
    crs = None if frame.crs is None else str(frame.crs.to_wkt())
    part = table.take(rows).select(columns)
    chunk = FeatureChunk(
        part, shapes[rows], rows.astype(np.int64), crs, choice.id, parsed=True, is_told=crs is not None
    )
    return replace(chunk, labels=None if labels is None else labels[rows], unlabelled=why)


def _split(chunk: FeatureChunk, batch: int | None) -> Iterator[FeatureChunk]:
    """Split a chunk into runs of rows."""
    step = batch or max(len(chunk.numbers), 1)
    for first in range(0, max(len(chunk.numbers), 1), step):
        rows = slice(first, first + step)
        part = replace(chunk, table=chunk.table.slice(first, step), shapes=chunk.shapes[rows])
        labels = None if chunk.labels is None else chunk.labels[rows]
        yield replace(part, numbers=chunk.numbers[rows], labels=labels)
        chunk = replace(chunk, unlabelled="")  # reported only once
