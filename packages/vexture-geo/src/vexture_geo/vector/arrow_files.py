"""Read tables with geometries: GeoParquet, Feather (Arrow files), and CSV with WKT or columns of coordinates."""

import json
import os
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from io import BytesIO
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.content import ARROW, PARQUET, Header, header_of, read_bytes, start_of
from vexture.base.errors import SourceError, shorten_text
from vexture_geo.vector.curves import BROKEN
from vexture_geo.vector.geojson import WORLD
from vexture_geo.vector.wkt import wkb_of_texts

if TYPE_CHECKING:
    import pyarrow


GEOMETRY: Final = "geometry"
"""Name of the geometry column of CSV, unless an attribute has that name."""

SHOWN: Final = 60
"""Most characters of a value, or of an error of Arrow's, in a message."""

MOST_NAMED: Final = 12
"""Most columns that a message names."""

UNNAMED: Final = "several of its columns have no name; give each one, or remove it"

UTF_16: Final = (b"\xff\xfe", b"\xfe\xff")
"""First bytes of text in UTF-16."""

CODE: Final = re.compile(rb'(?<![^,;\t|"\s])0\d')
CODE_ALONE: Final = r"^\s*0\d"
"""Pattern of a number with a leading zero, for the start of any value in a text, and for one value."""

SEPARATORS: Final = ";\t"
"""Separators of columns with which a comma may be a decimal mark."""

NUMBER: Final = r"^-?\d+(,\d+)?$"
GROUPED: Final = r"^-?(\d+|[1-9]\d{0,2}(\.\d{3})+)(,\d+)?$"
BOTH: Final = r"\.\d{3},\d"
"""Pattern of a number that may have points as thousands separators, and of one that also has a decimal comma."""

LEADING_ZERO: Final = r"^-?0\d"
"""Pattern of a number with a leading zero, as codes have."""

THOUSANDS: Final = r"^-?([1-9]\d{0,2},\d{3}|\d{1,3})$"
"""Pattern of a number whose comma may separate thousands."""


@dataclass(frozen=True)
class TableFile:
    """A table in memory with the interface of `pyarrow.parquet.ParquetFile`."""

    table: "pyarrow.Table"

    @property
    def schema_arrow(self) -> "pyarrow.Schema":
        """Columns and metadata of the table."""
        return self.table.schema

    def read(self, columns: Sequence[str], use_threads: bool = False) -> "pyarrow.Table":
        """Read some columns of all rows."""
        return self.table.select(list(columns))

    def iter_batches(
        self, batch_size: int, columns: Sequence[str], use_threads: bool = False
    ) -> "Iterator[pyarrow.RecordBatch]":
        """Iterate over some columns, `batch_size` rows at once."""
        return iter(self.table.select(list(columns)).combine_chunks().to_batches(batch_size))


def is_table(source: str | os.PathLike[str] | bytes) -> bool:
    """Return whether a file is Parquet, Arrow or CSV, by its first bytes; CSV without known columns by name."""
    start = start_of(source)
    return start.startswith((PARQUET, ARROW)) or _is_csv(source, start)


def _is_csv(source: str | os.PathLike[str] | bytes, start: bytes) -> bool:
    is_named = not isinstance(source, bytes) and os.fspath(source).lower().endswith((".csv", ".tsv"))
    if start.startswith(UTF_16):
        return is_named or header_of(start.decode("utf-16", "replace").encode()).has_places
    if start.lstrip()[:1] in (b"{", b"<", b"\x1e") or b"\0" in start or not start:
        return False
    return header_of(start).has_places or (is_named and bool(header_of(start).names))


def open_table(source: str | os.PathLike[str] | bytes) -> Any:
    """Open a `pyarrow.parquet.ParquetFile`, or an object with its interface."""
    import pyarrow.parquet as pq

    start = start_of(source)
    if start.startswith(PARQUET):
        file: Any = pq.ParquetFile(BytesIO(source) if isinstance(source, bytes) else os.path.abspath(source))
    else:
        content = read_bytes(source)
        file = TableFile(_feather(content) if start.startswith(ARROW) else _csv(content))
    _refuse_repeated(file.schema_arrow.names)
    return file


def _feather(content: bytes) -> "pyarrow.Table":
    """Read an Arrow file whose offsets all lie within its buffers."""
    import pyarrow as pa

    with pa.ipc.open_file(pa.py_buffer(content)) as file:
        table = file.read_all()
    table.validate(full=True)  # reading does not check offsets, which may point anywhere
    return table


def _csv(content: bytes) -> "pyarrow.Table":
    """Read a CSV table, with geometries from its columns."""
    import pyarrow as pa

    _refuse_other_encodings(content)
    header = header_of(content.partition(b"\n")[0])
    if not header.has_places:
        shown = ", ".join(header.names[:MOST_NAMED]) + (", ..." if len(header.names) > MOST_NAMED else "")
        raise SourceError(f"its first line names no columns of places (wkt, or lon and lat, or x and y): {shown}")
    _refuse_repeated(header.names)
    table = with_decimal_commas(_columns(content, header), header)
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


def _refuse_repeated(names: Sequence[str]) -> None:
    """Raise a `SourceError` if two columns share a name, because neither could be chosen."""
    again = next((name for name, count in Counter(names).items() if count > 1), None)
    if again is not None:
        what = f"it has several columns {again!r}; rename all but one" if again else UNNAMED
        raise SourceError(what)


def _refuse_other_encodings(content: bytes) -> None:
    """Raise a `SourceError` if a text is not in UTF-8."""
    if content.startswith(UTF_16):
        raise SourceError("it is text in UTF-16; save it as UTF-8")
    try:
        content.decode()
    except UnicodeDecodeError as error:
        first = content.rfind(b"\n", 0, error.start) + 1
        shown = shorten_text(content[first:].partition(b"\n")[0].decode("cp1252", "replace").strip(), SHOWN)
        line = content.count(b"\n", 0, error.start) + 1
        raise SourceError(
            f"its line {line} is no text in UTF-8, but in another encoding, such as Windows-1252 (where it is "
            f"{shown!r}); save the file as UTF-8"
        ) from None


def _columns(content: bytes, header: Header) -> "pyarrow.Table":
    """Read all columns of a CSV table; a column with any leading zero, as codes have, stays text."""
    import pyarrow as pa
    from pyarrow import compute

    types = {} if header.text is None else {header.text: pa.string()}  # WKB in hexadecimal digits looks like a number
    table = _read_csv(content, header, types)
    places = (header.text, header.across, header.up)
    numeric = [
        field.name
        for field in table.schema
        if (pa.types.is_integer(field.type) or pa.types.is_floating(field.type)) and field.name not in places
    ]
    if not numeric or CODE.search(content) is None:
        return table
    texts = _read_csv(content, header, types | dict.fromkeys(numeric, pa.string()))
    for name in numeric:
        if compute.any(compute.match_substring_regex(texts.column(name), CODE_ALONE)).as_py():
            table = table.set_column(table.column_names.index(name), name, texts.column(name))
    return table


def _read_csv(content: bytes, header: Header, types: dict[str, Any]) -> "pyarrow.Table":
    import pyarrow as pa
    from pyarrow import csv

    reading = csv.ReadOptions(use_threads=False, column_names=header.names, skip_rows=1)
    parsing = csv.ParseOptions(delimiter=header.delimiter, newlines_in_values=True)
    converting = csv.ConvertOptions(column_types=types, strings_can_be_null=True, quoted_strings_can_be_null=False)
    return csv.read_csv(pa.py_buffer(content), reading, parsing, converting)


def _from_texts(column: Any, name: str) -> NDArray[Any]:
    """Convert texts to WKB; None where a text is empty."""
    texts = np.array([(text or "").strip() or None for text in column.to_pylist()], object)
    found = wkb_of_texts(texts)
    for row, shape in enumerate(found):
        if shape is BROKEN:
            shown = shorten_text(" ".join(str(texts[row]).split()), SHOWN)
            raise SourceError(f"row {row + 1} has no WKT in the column {name!r}, but {shown!r}; correct it")
    return found


def _from_numbers(*columns: tuple[Any, str]) -> NDArray[Any]:
    """Convert two columns to WKB of points; None where a value is missing."""
    import pyarrow as pa
    import shapely

    places = []
    for column, name in columns:
        try:
            places.append(column.cast(pa.float64()).to_numpy())
        except (pa.ArrowInvalid, pa.ArrowNotImplementedError) as error:
            reason = shorten_text(" ".join(str(error).split()), SHOWN)
            raise SourceError(f"its column {name!r} has a value that is no number ({reason}); correct it") from None
    across, up = (np.asarray(place, np.float64) for place in places)
    found = np.full(len(across), None, object)
    given = ~(np.isnan(across) | np.isnan(up))
    found[given] = shapely.to_wkb(shapely.points(across[given], up[given]))
    return found


def with_decimal_commas(table: "pyarrow.Table", header: Header) -> "pyarrow.Table":
    """Convert columns of texts that are all numbers with decimal commas to numbers.

    If other columns have decimal points, a column whose commas may all separate thousands stays text.
    """
    import pyarrow as pa
    from pyarrow import compute

    if header.delimiter not in SEPARATORS:
        return table
    has_points = any(pa.types.is_floating(field.type) for field in table.schema)
    for at, field in enumerate(table.schema):
        if not pa.types.is_string(field.type) or field.name == header.text:
            continue
        texts = compute.utf8_trim_whitespace(table.column(at))
        texts = compute.if_else(compute.equal(texts, ""), None, texts)
        is_doubtful = _any_match(texts, LEADING_ZERO) or (has_points and _all_match(texts, THOUSANDS))
        if is_doubtful and field.name not in (header.across, header.up):
            continue
        if _any_match(texts, BOTH) and _all_match(texts, GROUPED):
            texts = compute.replace_substring(texts, ".", "")
        if _all_match(texts, NUMBER) and compute.any(compute.match_substring(texts, ",")).as_py():
            numbers = compute.cast(compute.replace_substring(texts, ",", "."), pa.float64())
            table = table.set_column(at, field.name, numbers)
    return table


def _any_match(texts: Any, pattern: str) -> bool:
    from pyarrow import compute

    return bool(compute.any(compute.match_substring_regex(texts, pattern)).as_py())


def _all_match(texts: Any, pattern: str) -> bool:
    from pyarrow import compute

    return bool(compute.all(compute.match_substring_regex(texts, pattern)).as_py())
