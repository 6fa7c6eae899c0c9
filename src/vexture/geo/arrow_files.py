"""Tables with geometries: GeoParquet, Feather (files of Arrow), and CSV with WKT or with coordinates in columns."""

import json
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from io import BytesIO
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.content import ARROW, PARQUET, Header, header_of, read_bytes, start_of
from vexture.errors import SourceError, shortened
from vexture.geo.curves import BROKEN
from vexture.geo.geoparquet import WORLD
from vexture.geo.wkt import wkb_of_texts

if TYPE_CHECKING:
    import pyarrow

__all__ = ["TableFile", "is_table", "opened_table"]

GEOMETRY: Final = "geometry"
"""Name of the geometries of CSV; a column that has it already has a longer one."""

SHOWN: Final = 60
"""Characters of a value, or of an error of Arrow's, in a message."""

MOST_NAMED: Final = 12
"""Columns that a message names."""


@dataclass(frozen=True)
class TableFile:
    """A table in memory, which is read as `pyarrow.parquet.ParquetFile` is."""

    table: "pyarrow.Table"

    @property
    def schema_arrow(self) -> "pyarrow.Schema":
        """Its columns and metadata."""
        return self.table.schema

    def read(self, columns: Sequence[str], use_threads: bool = False) -> "pyarrow.Table":
        """Some columns of all rows."""
        return self.table.select(list(columns))

    def iter_batches(
        self, batch_size: int, columns: Sequence[str], use_threads: bool = False
    ) -> "Iterator[pyarrow.RecordBatch]":
        """Some columns, so many rows at once."""
        return iter(self.table.select(list(columns)).combine_chunks().to_batches(batch_size))


def is_table(source: str | os.PathLike[str] | bytes) -> bool:
    """Whether a file is Parquet, Arrow or CSV, by its first bytes; CSV without known columns by its name."""
    start = start_of(source)
    return start.startswith((PARQUET, ARROW)) or _is_csv(source, start)


def _is_csv(source: str | os.PathLike[str] | bytes, start: bytes) -> bool:
    if start.lstrip()[:1] in (b"{", b"<", b"\x1e") or b"\0" in start or not start:
        return False
    is_named = not isinstance(source, bytes) and os.fspath(source).lower().endswith((".csv", ".tsv"))
    return header_of(start).has_places or (is_named and bool(header_of(start).names))


def opened_table(source: str | os.PathLike[str] | bytes) -> Any:
    """A `pyarrow.parquet.ParquetFile`, or what is read alike."""
    import pyarrow.parquet as pq

    start = start_of(source)
    if start.startswith(PARQUET):
        return pq.ParquetFile(BytesIO(source) if isinstance(source, bytes) else os.path.abspath(source))
    content = read_bytes(source)
    return TableFile(_feather(content) if start.startswith(ARROW) else _csv(content, header_of(start)))


def _feather(content: bytes) -> "pyarrow.Table":
    """A file of Arrow, of which nothing points out of its buffers."""
    import pyarrow as pa

    with pa.ipc.open_file(pa.py_buffer(content)) as file:
        table = file.read_all()
    table.validate(full=True)  # which reading does not: an offset may lead anywhere
    return table


def _csv(content: bytes, header: Header) -> "pyarrow.Table":
    """A table of text, with geometries of its columns."""
    import pyarrow as pa
    from pyarrow import csv

    if not header.has_places:
        shown = ", ".join(header.names[:MOST_NAMED]) + (", ..." if len(header.names) > MOST_NAMED else "")
        raise SourceError(f"its first line names no columns of places (wkt, or lon and lat, or x and y): {shown}")
    parsing = csv.ParseOptions(delimiter=header.delimiter, newlines_in_values=True)
    types = {} if header.text is None else {header.text: pa.string()}  # WKB in hexadecimal digits looks like a number
    converting = csv.ConvertOptions(column_types=types, strings_can_be_null=True, quoted_strings_can_be_null=False)
    table = csv.read_csv(pa.py_buffer(content), csv.ReadOptions(use_threads=False), parsing, converting)
    table = table.rename_columns([name.strip() for name in table.column_names])
    if header.text is not None:
        shapes = _from_texts(table.column(header.text), header.text)
        table = table.drop_columns([header.text])
    else:
        assert header.across is not None
        assert header.up is not None
        shapes = _from_numbers(*((table.column(name), name) for name in (header.across, header.up)))
    name = GEOMETRY
    while name in table.column_names:
        name += "_"
    crs = WORLD if header.is_degrees else None
    geo = {"version": "1.0.0", "primary_column": name, "columns": {name: {"encoding": "WKB", "crs": crs}}}
    table = table.append_column(name, pa.array(shapes.tolist(), pa.binary()))
    return table.replace_schema_metadata({"geo": json.dumps(geo)})


def _from_texts(column: Any, name: str) -> NDArray[Any]:
    """WKB of texts; None where there is none."""
    texts = np.array([(text or "").strip() or None for text in column.to_pylist()], object)
    found = wkb_of_texts(texts)
    for row, shape in enumerate(found):
        if shape is BROKEN:
            shown = shortened(" ".join(str(texts[row]).split()), SHOWN)
            raise SourceError(f"row {row + 1} has no WKT in the column {name!r}, but {shown!r}; correct it")
    return found


def _from_numbers(*columns: tuple[Any, str]) -> NDArray[Any]:
    """WKB of the points of two columns; None where one has no value."""
    import pyarrow as pa
    import shapely

    places = []
    for column, name in columns:
        try:
            places.append(column.cast(pa.float64()).to_numpy())
        except (pa.ArrowInvalid, pa.ArrowNotImplementedError) as error:
            reason = shortened(" ".join(str(error).split()), SHOWN)
            raise SourceError(f"its column {name!r} has a value that is no number ({reason}); correct it") from None
    across, up = (np.asarray(place, np.float64) for place in places)
    found = np.full(len(across), None, object)
    given = ~(np.isnan(across) | np.isnan(up))
    found[given] = shapely.to_wkb(shapely.points(across[given], up[given]))
    return found
