"""Values that change with time: columns of a layer, or a table of ids, times and values; and their colours."""

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.cartography.colours import Scale, colours_of, hex_of
from vexture.errors import LimitError, ParameterError, SourceError, counted, shortened
from vexture.geo.features import Features
from vexture.notes import Notes

if TYPE_CHECKING:
    import pyarrow

__all__ = ["STEP_COLUMNS", "Steps", "Times", "coloured_steps", "with_steps"]

TABLES: Final = (".parquet", ".arrow", ".feather", ".csv")
ANY: Final = "*"
"""In a pattern of names, what stands for anything."""

ID: Final = "id"
TIME: Final = "time"

STEP_COLUMNS: Final = "columns"
"""Member of a legend: the columns of the table that have the values of its steps."""

MOST_COLOURS: Final = 100_000_000
"""Colours of all features at all steps, of which each takes some 50 bytes on the way."""

DIGITS: Final = re.compile(r"(\d+)")


@dataclass(frozen=True, eq=False)
class Times:
    """What the colours of a layer show at each step of time.

    Parameters
    ----------
    source : sequence of str, str, path, table or DataFrame
        Columns of the layer, one for each step; or a pattern of their names, such as ``y*``; or a table, or a file of
        one (Parquet, Arrow or CSV), with the columns ``id``, ``time`` and one of values.
    labels : sequence of str, optional
        Names of the steps; by default those of the columns, or the times of the table.

    Examples
    --------
    >>> Times("y*").columns(["id", "y10", "y9", "name"])
    ['y9', 'y10']
    """

    source: Any
    labels: tuple[str, ...] | None = None

    @property
    def is_table(self) -> bool:
        """Whether the values are in a table beside the layer."""
        if isinstance(self.source, os.PathLike):
            return True
        if isinstance(self.source, str):
            return self.source.lower().endswith(TABLES)
        return hasattr(self.source, "columns")

    @property
    def is_pattern(self) -> bool:
        """Whether a text stands for several columns."""
        return isinstance(self.source, str) and not self.is_table and ANY in self.source

    def columns(self, names: Sequence[str]) -> list[str]:
        """The columns of a layer, in the order of the steps; those of a pattern as their numbers rise."""
        if self.is_pattern:
            like = re.compile(".*".join(re.escape(part) for part in self.source.split(ANY)), re.DOTALL)
            found = sorted((name for name in names if like.fullmatch(name)), key=_natural)
            if not found:
                raise ParameterError(f"no column is like {self.source!r} of `time`; there are: {', '.join(names[:12])}")
            return found
        wanted = list(self.named())
        for name in wanted:
            if name not in names:
                raise ParameterError(f"it has no column {name!r} for `time`; there are: {', '.join(names[:12])}")
        if len(set(wanted)) < len(wanted):
            raise ParameterError(f"`time` names a column twice: {', '.join(wanted)[:80]}; name each once")
        return wanted

    def named(self) -> tuple[str, ...]:
        """Columns that are named one by one."""
        if self.is_table or self.is_pattern:
            return ()
        parts = self.source.split(",") if isinstance(self.source, str) else self.source
        return tuple(str(part).strip() for part in parts)


@dataclass(frozen=True, eq=False)
class Steps:
    """Colours of a layer's features at each step.

    Parameters
    ----------
    labels : tuple of str
    columns : tuple of str
        Of the table, with the values.
    rgba : (t, f, 4) array
        Not premultiplied.
    """

    labels: tuple[str, ...]
    columns: tuple[str, ...]
    rgba: NDArray[np.float64]

    def at(self, time: float) -> NDArray[np.float64]:
        """Colours at a time in steps, (f, 4); between two steps they are mixed in sRGB, as those of palettes.

        Examples
        --------
        >>> grey = np.linspace(0, 1, 3)[:, None, None] * np.ones((1, 1, 4))
        >>> Steps(("a", "b", "c"), ("a", "b", "c"), grey).at(0.5).tolist()
        [[0.25, 0.25, 0.25, 0.25]]
        """
        held = min(max(time, 0.0), len(self.rgba) - 1.0)
        first = int(held)
        share, one = held - first, self.rgba[first]
        following = self.rgba[min(first + 1, len(self.rgba) - 1)]
        return np.asarray(one + share * (following - one))

    def as_json(self, names: Sequence[str], legend: dict[str, Any]) -> dict[str, Any]:
        """What a page needs: ``ids`` and ``colors`` are those of `setTimes` of the npm package's layers."""
        coded, place = np.unique(np.round(self.rgba, 4).reshape(-1, 4), axis=0, return_inverse=True)
        words = np.array([hex_of(colour) for colour in coded], object)
        colours = words[place.reshape(self.rgba.shape[:2])].tolist()
        return {"times": list(self.labels), "ids": list(names), "colors": colours, "legend": legend}


def with_steps(features: Features, times: Times, notes: Notes) -> tuple[Features, list[str], tuple[str, ...], str]:
    """Features with a column of values for each step; the columns, the steps' names, and what the values are called."""
    if times.is_table:
        columns, found, title = _joined(features, times.source, notes)
        table = features.table
        for name, values in columns.items():
            table = table.append_column(name, values)
        features, names = replace(features, table=table), list(columns)
    else:
        names = times.columns(features.table.column_names[1:])
        stems = {name.rstrip("0123456789_-. ") for name in names}
        found, title = tuple(names), (stems.pop() if len(stems) == 1 else "") or "value"
    if len(names) * len(features) > MOST_COLOURS:
        raise LimitError(
            f"{len(names):,} steps of {len(features):,} features are more than {MOST_COLOURS:,} colours; choose fewer "
            "steps by `time`, or fewer features by `where`"
        )
    labels = found if times.labels is None else tuple(str(label) for label in times.labels)
    if len(labels) != len(names):
        count = f"{counted(len(labels), 'name')} for {counted(len(names), 'step')}"
        raise ParameterError(f"`times` has {count}; give as many names as steps")
    return features, names, labels, title


def coloured_steps(
    table: "pyarrow.Table", columns: Sequence[str], labels: tuple[str, ...], scale: Scale, notes: Notes
) -> tuple[Steps, dict[str, Any]]:
    """Colours of the rows of a table at each step, on one scale of all values; and its legend."""
    import pyarrow as pa

    try:
        chunked = pa.concat_tables(
            [pa.table({scale.column: table.column(name)}) for name in columns], promote_options="permissive"
        )
    except (pa.ArrowInvalid, pa.ArrowTypeError):
        kinds = ", ".join(sorted({str(table.column(name).type) for name in columns}))
        raise ParameterError(f"the columns of `time` differ in type ({kinds}); choose columns of one type") from None
    rgba, legend = colours_of(chunked, scale, notes)
    legend |= {"times": list(labels), STEP_COLUMNS: list(columns)}
    return Steps(labels, tuple(columns), rgba.reshape(len(columns), len(table), 4)), legend


def _natural(name: str) -> list[tuple[int, Any]]:
    """Key by which numbers in names are sorted as numbers."""
    return [(0, int(part)) if part.isdigit() else (1, part) for part in DIGITS.split(name) if part]


def _joined(features: Features, source: Any, notes: Notes) -> tuple[dict[str, Any], tuple[str, ...], str]:
    """Columns of a table's values, one for each of its times; the times, and the name of the values."""
    import pyarrow as pa
    import pyarrow.compute as pc

    table = _table(source)
    others = [name for name in table.column_names if name not in (ID, TIME)]
    if len(others) != 1 or len(table.column_names) != 3:
        names = ", ".join(table.column_names[:12])
        raise ParameterError(f"the table of `time` has the columns {names}; it needs id, time and one of values")
    given = _without_blanks(table.column(TIME).combine_chunks())
    if given.null_count == len(given):
        raise SourceError("no row of the table of `time` has a time; fill in the column time")
    notes.remark("a row of the table of times has no time, and does not count", given.null_count)
    times, labels = _sorted(pc.drop_null(pc.unique(given)))
    step = pc.index_in(given, value_set=times)
    row = pc.index_in(_as_texts(table.column(ID)), value_set=pa.array(features.ids.tolist(), pa.string()))
    known = np.asarray(pc.and_(row.is_valid(), step.is_valid()))
    if not known.any():
        raise SourceError(f"no id of the table of `time` is that of a feature, such as {features.ids[0]}; choose `id`")
    if lost := len(pc.unique(table.column(ID).filter(pc.is_null(row)))):
        notes.remark(f"{lost} ids of the table of times are those of no feature")
    place = np.full((len(labels), len(features)), -1, np.int64)
    steps, rows = (np.asarray(each.filter(pa.array(known)).cast(pa.int64())) for each in (step, row))
    place[steps, rows] = np.flatnonzero(known)
    if again := len(steps) - int((place >= 0).sum()):
        notes.remark(f"{again} rows of the table of times have the id and the time of a later one, which counts")
    values, columns = table.column(others[0]).combine_chunks(), dict[str, Any]()
    if pa.types.is_floating(values.type):
        infinite = pc.sum(pc.is_inf(values)).as_py() or 0
        notes.remark("a value of the table of times is infinite, and has the colour of no data", infinite)
    for label, one in zip(labels, place, strict=True):
        columns[_free(label, {*features.table.column_names, *columns})] = values.take(
            pa.array(one, pa.int64(), mask=one < 0)
        )
    return columns, labels, others[0]


def _without_blanks(times: Any) -> Any:
    """Times of which empty texts, and what is no number, are null."""
    import pyarrow as pa
    import pyarrow.compute as pc

    is_text = pa.types.is_string(times.type) or pa.types.is_large_string(times.type)
    blank = pc.equal(times, "") if is_text else pc.is_null(times, nan_is_null=True)
    return pc.if_else(pc.fill_null(blank, True), pa.scalar(None, times.type), times)


def _sorted(times: Any) -> tuple[Any, tuple[str, ...]]:
    """Times in their order, and as names; texts are sorted as their numbers rise."""
    import pyarrow as pa
    import pyarrow.compute as pc

    if pa.types.is_string(times.type) or pa.types.is_large_string(times.type):
        texts = sorted(times.to_pylist(), key=_natural)
        return pa.array(texts, times.type), tuple(texts)
    ordered = times.take(pc.sort_indices(times))
    return ordered, tuple(_text(value) for value in ordered.to_pylist())


def _free(name: str, taken: set[str]) -> str:
    """A name that no column has."""
    while name in taken:
        name += "_"
    return name


def _text(value: Any) -> str:
    """A time as a name: midnight is a day, and a number has no empty decimals."""
    text = f"{value:g}" if isinstance(value, float) and abs(value) < 1e6 else str(value)
    return text.removesuffix(" 00:00:00")


def _as_texts(column: Any) -> Any:
    """Ids as texts."""
    import pyarrow as pa

    column = column.combine_chunks()
    if pa.types.is_dictionary(column.type):
        column = column.dictionary_decode()
    if pa.types.is_floating(column.type):
        column = column.cast(pa.int64(), safe=False)
    return column.cast(pa.string())


def _table(source: Any) -> "pyarrow.Table":
    """A table of ids, times and values."""
    import pyarrow as pa

    if isinstance(source, pa.Table):
        return source
    if not isinstance(source, str | os.PathLike):
        return pa.Table.from_pandas(source, preserve_index=False).replace_schema_metadata(None)
    path = Path(source)
    try:
        if path.suffix.lower() == ".csv":
            from pyarrow import csv

            # ids such as 01001 are texts
            return csv.read_csv(path, convert_options=csv.ConvertOptions(column_types={ID: pa.string()}))
        content = path.read_bytes()
        if content.startswith(b"PAR1"):
            import pyarrow.parquet as pq

            return pq.read_table(BytesIO(content))
        from pyarrow import feather

        return feather.read_table(BytesIO(content))
    except OSError as error:
        reason = error.strerror or shortened(str(error), 120)
        raise SourceError(f"{path}: cannot be read as a table ({reason}); give Parquet, Arrow or CSV") from None
    except pa.ArrowInvalid as error:
        raise SourceError(f"{path}: cannot be read as a table ({shortened(str(error), 120)}); save it again") from None
