"""Write tables of attributes as files, for a whole map or in batches of features."""

import json
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, Final

from vexture.base.errors import ParameterError

if TYPE_CHECKING:
    import pyarrow

TABLES: Final = ("parquet", "arrow", "none")
"""Kinds of files, by suffix; the last one means no file."""

LEGEND: Final = "vexture.legend"
"""Key of the legends in the metadata of the table."""


def with_legends(schema: "pyarrow.Schema", legends: list[dict[str, Any]]) -> "pyarrow.Schema":
    """Replace the metadata of a schema by the legends of colours."""
    return schema.with_metadata({LEGEND: json.dumps(legends)})


def table_bytes(table: "pyarrow.Table", kind: str) -> bytes:
    """Encode a table as Parquet or Arrow."""
    import pyarrow as pa

    sink = pa.BufferOutputStream()
    with _writer(sink, table.schema, kind) as writer:
        writer.write_table(table)
    return bytes(sink.getvalue().to_pybytes())


def write_batches(file: IO[bytes], schema: "pyarrow.Schema", batches: "Iterable[pyarrow.Table]", kind: str) -> None:
    """Write consecutive tables as one Parquet or Arrow file."""
    with _writer(file, schema, kind) as writer:
        for table in batches:
            writer.write_table(table.cast(schema))


def cast(table: "pyarrow.Table", schema: "pyarrow.Schema") -> "pyarrow.Table":
    """Cast a table to the types of an earlier one; a `ParameterError` if its values do not fit."""
    import pyarrow as pa

    try:
        return table.cast(schema)
    except (pa.ArrowInvalid, pa.ArrowTypeError, pa.ArrowNotImplementedError, ValueError) as error:
        reason = str(error).partition("\n")[0]
        raise ParameterError(f"its columns differ in type ({reason}); choose others by `columns`") from None


def check_targets(targets: Iterable[Path], sources: Iterable[Path]) -> None:
    """Raise a `ParameterError` if an output file is a source, or would replace a table that no map has written."""
    for target in targets:
        if any(target.exists() and source.exists() and target.samefile(source) for source in sources):
            raise ParameterError(f"{target} is a source itself; give another `output`, or `table` none")
        if target.suffix[1:] in TABLES and target.exists() and not _is_own(target):
            raise ParameterError(f"{target} is there, and no table of a map; give another `output`, or `table` none")


def _is_own(place: Path) -> bool:
    """Return whether a file is a table written by a map."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        if place.suffix == ".parquet":
            metadata = pq.read_schema(place).metadata
        else:
            with pa.OSFile(str(place)) as file:
                metadata = pa.ipc.open_file(file).schema.metadata
    except (pa.ArrowException, OSError, UnicodeDecodeError):
        return False
    return LEGEND.encode() in (metadata or {})


@contextmanager
def _writer(sink: Any, schema: "pyarrow.Schema", kind: str) -> Iterator[Any]:
    if kind == "parquet":
        import pyarrow.parquet as pq

        with pq.ParquetWriter(sink, schema) as writer:
            yield writer
    else:
        import pyarrow as pa

        with pa.ipc.new_file(sink, schema) as writer:
            yield writer
