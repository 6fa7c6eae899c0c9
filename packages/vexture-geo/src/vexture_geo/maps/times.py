"""Values that change with time, from columns of a layer or a table of ids, times and values; and their colours."""

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import LimitError, ParameterError, SourceError, format_count, shorten_text
from vexture.base.labels import texts_of
from vexture.base.notes import Notes
from vexture_geo.maps.colours import Scale, colours_of, hex_of
from vexture_geo.vector.features import Features
from vexture_geo.vector.frames import arrow_of

if TYPE_CHECKING:
    import pyarrow

TABLES: Final = (".parquet", ".arrow", ".feather", ".csv")
ANY: Final = "*"
"""Wildcard in a pattern of names."""

ID: Final = "id"
TIME: Final = "time"

STEP_COLUMNS: Final = "columns"
"""Member of a legend that lists the columns of the table with the values of its steps."""

MOST_COLOURS: Final = 100_000_000
"""Most colours of all features at all steps; each takes some 50 bytes during conversion."""

DIGITS: Final = re.compile(r"(\d+)")


@dataclass(frozen=True, eq=False)
class Times:
    """Values that the colours of a layer show at each step of time.

    Parameters
    ----------
    source : sequence of str, str, path, table or DataFrame
        Columns of the layer, one for each step; a pattern of their names, such as ``y*``; or a table, or the file of
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

    def __post_init__(self) -> None:
        if self.labels is not None:
            labels = tuple(str(label) for label in texts_of(self.labels))
            if again := [label for label in labels if labels.count(label) > 1]:
                raise ParameterError(f"`labels` names two steps {again[0]!r}; name each otherwise")
            object.__setattr__(self, "labels", labels)

    @property
    def is_table(self) -> bool:
        """True if the values are in a table beside the layer."""
        if isinstance(self.source, os.PathLike):
            return True
        if isinstance(self.source, str):
            return self.source.lower().endswith(TABLES)
        return hasattr(self.source, "columns")

    @property
    def is_pattern(self) -> bool:
        """True if a text is a pattern for several columns."""
        return isinstance(self.source, str) and not self.is_table and ANY in self.source

    def columns(self, names: Sequence[str]) -> list[str]:
        """Columns of a layer in the order of the steps; those of a pattern are sorted by their numbers."""
        if self.is_pattern:
            like = re.compile(".*".join(re.escape(part) for part in self.source.split(ANY)), re.DOTALL)
            found = sorted((name for name in names if like.fullmatch(name)), key=_natural)
            if not found:
                raise ParameterError(
                    f"no column is like {self.source!r} of `times`; there are: {', '.join(names[:12])}"
                )
            return found
        wanted = list(self.column_names())
        for name in wanted:
            if name not in names:
                raise ParameterError(f"it has no column {name!r} for `times`; there are: {', '.join(names[:12])}")
        if len(set(wanted)) < len(wanted):
            raise ParameterError(f"`times` names a column twice: {', '.join(wanted)[:80]}; name each once")
        return wanted

    def column_names(self) -> tuple[str, ...]:
        """Columns that are named one by one, not by a pattern."""
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
        Columns of the table with the values.
    rgba : (t, f, 4) array
        Not premultiplied.
    """

    labels: tuple[str, ...]
    columns: tuple[str, ...]
    rgba: NDArray[np.float64]

    def at(self, time: float) -> NDArray[np.float64]:
        """Colours at a time in steps, (f, 4); between two steps they are mixed in sRGB, as in palettes.

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
        """Return data for a page: ``ids`` and ``colors`` are those of `setTimes` of the npm package's layers."""
        coded, place = np.unique(np.round(self.rgba, 4).reshape(-1, 4), axis=0, return_inverse=True)
        words = np.array([hex_of(colour) for colour in coded], object)
        colours = words[place.reshape(self.rgba.shape[:2])].tolist()
        return {"times": list(self.labels), "ids": list(names), "colors": colours, "legend": legend}


def with_steps(features: Features, times: Times, notes: Notes) -> tuple[Features, list[str], tuple[str, ...], str]:
    """Add a column of values for each step; return features, columns, names of steps, and the title of the values."""
    if times.is_table:
        columns, found, title = _join_values(features, times.source, notes)
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
            "steps by `times`, or fewer features by `where`"
        )
    labels = found if times.labels is None else times.labels
    if len(labels) != len(names):
        count = f"{format_count(len(labels), 'name')} for {format_count(len(names), 'step')}"
        raise ParameterError(f"`labels` has {count}; give as many names as steps")
    return features, names, labels, title


def colour_steps(
    table: "pyarrow.Table", columns: Sequence[str], labels: tuple[str, ...], scale: Scale, notes: Notes
) -> tuple[Steps, dict[str, Any]]:
    """Colour the rows of a table at each step, on one scale of all values; return colours and legend."""
    import pyarrow as pa

    try:
        chunked = pa.concat_tables(
            [pa.table({scale.column: table.column(name)}) for name in columns], promote_options="permissive"
        )
    except (pa.ArrowInvalid, pa.ArrowTypeError):
        kinds = ", ".join(sorted({str(table.column(name).type) for name in columns}))
        raise ParameterError(f"the columns of `times` differ in type ({kinds}); choose columns of one type") from None
    rgba, legend = colours_of(chunked, scale, notes)
    legend |= {"times": list(labels), STEP_COLUMNS: list(columns)}
    return Steps(labels, tuple(columns), rgba.reshape(len(columns), len(table), 4)), legend


def _natural(name: str) -> list[tuple[int, Any]]:
    """Return a key that sorts numbers in names as numbers."""
    return [(0, int(part)) if part.isdecimal() else (1, part) for part in DIGITS.split(name) if part]


def _join_values(features: Features, source: Any, notes: Notes) -> tuple[dict[str, Any], tuple[str, ...], str]:
    """Return a column of a table's values for each of its times, the times, and the name of the values."""
    import pyarrow as pa

    table = _table(source)
    others = [name for name in table.column_names if name not in (ID, TIME)]
    if len(others) != 1 or len(table.column_names) != 3:
        names = ", ".join(table.column_names[:12])
        raise ParameterError(f"the table of `times` has the columns {names}; it needs id, time and one of values")
    steps, labels = _steps(table.column(TIME))
    if not labels:
        raise SourceError("no row of the table of `times` has a time; fill in the column time")
    notes.remark("a row of the table of times has no time, and does not count", int((steps < 0).sum()))
    codes, ids = _encode_values(table.column(ID), ID)
    notes.remark("a row of the table of times has no id, and does not count", int((codes < 0).sum()))
    row_of = {name: row for row, name in enumerate(features.ids.tolist())}
    texts = texts_of(ids.to_pylist())
    found = np.array([*(row_of.get(name, -1) for name in texts), -1], np.int64)
    rows = found[codes]
    known = (rows >= 0) & (steps >= 0)
    if not known.any():
        raise SourceError(f"no id of the table of `times` is that of a feature, such as {features.ids[0]}; choose `id`")
    lost = [str(texts[code]) for code in np.unique(codes[(rows < 0) & (codes >= 0)]).tolist()]
    if lost:
        told = shorten_text(lost[0], 40)
        notes.remark(f"no feature has {format_count(len(lost), 'id')} of the table of times, such as {told}")
    place = np.full((len(labels), len(features)), -1, np.int64)
    place[steps[known], rows[known]] = np.flatnonzero(known)
    if again := int(known.sum() - (place >= 0).sum()):
        notes.remark(
            f"the table of times has {format_count(again, 'row')} with the id and the time of a later one, which counts"
        )
    values, columns = table.column(others[0]).combine_chunks(), dict[str, Any]()
    for label, one in zip(labels, place, strict=True):
        columns[_free(label, {*features.table.column_names, *columns})] = values.take(
            pa.array(one, pa.int64(), mask=one < 0)
        )
    return columns, labels, others[0]


def _encode_values(column: Any, name: str) -> tuple[NDArray[np.int64], Any]:
    """Index of each value of a column among its distinct values, -1 where there is none; and these."""
    import pyarrow as pa

    try:
        column = column.unify_dictionaries() if pa.types.is_dictionary(column.type) else column.dictionary_encode()
    except pa.ArrowNotImplementedError:
        raise ParameterError(
            f"the column {name} of the table of `times` holds {column.type}; give numbers, dates or texts"
        ) from None
    coded = column.combine_chunks()
    coded = coded.chunk(0) if isinstance(coded, pa.ChunkedArray) else coded
    return np.asarray(coded.indices.cast(pa.int64()).fill_null(-1)), coded.dictionary


def _steps(column: Any) -> tuple[NDArray[np.int64], tuple[str, ...]]:
    """Step of each row, -1 where it has no time, and the names of the steps."""
    import pyarrow as pa

    codes, coded = _encode_values(column, TIME)
    times = coded.to_pylist()
    used = [code for code in np.unique(codes).tolist() if code >= 0 and texts_of([times[code]])[0]]
    if not (pa.types.is_dictionary(column.type) and column.type.ordered):
        keys = dict(zip(used, _keys([times[code] for code in used]), strict=True))
        used.sort(key=keys.__getitem__)
    step = np.full(len(times) + 1, -1, np.int64)  # the last is for rows without a time
    step[used] = np.arange(len(used))
    return step[codes], tuple(str(name) for name in texts_of([times[code] for code in used]))


def _keys(times: list[Any]) -> list[Any]:
    """Keys that sort times: texts as numbers, or else by the numbers in them."""
    if not all(isinstance(time, str) for time in times):
        return times
    try:
        numbers = [float(time) for time in times]
    except ValueError:
        numbers = [np.nan]
    return [_natural(time) for time in times] if np.isnan(numbers).any() else numbers


def _free(name: str, used_names: set[str]) -> str:
    """Make a name that no column has."""
    while name in used_names:
        name += "_"
    return name


def _table(source: Any) -> "pyarrow.Table":
    """Read a table of ids, times and values."""
    import pyarrow as pa

    if isinstance(source, pa.Table):
        return source
    if not isinstance(source, str | os.PathLike):
        return _of_frame(source)
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
        reason = error.strerror or shorten_text(str(error), 120)
        raise SourceError(f"{path}: cannot be read as a table ({reason}); give Parquet, Arrow or CSV") from None
    except pa.ArrowInvalid as error:
        raise SourceError(
            f"{path}: cannot be read as a table ({shorten_text(str(error), 120)}); save it again"
        ) from None


def _of_frame(frame: Any) -> "pyarrow.Table":
    """Convert the columns of a DataFrame, without geometries."""
    import pyarrow as pa

    if not hasattr(frame, "items"):
        raise ParameterError(f"`times` is a {type(frame).__name__}; give a DataFrame of pandas or a table of Arrow")
    columns = [(str(name), values) for name, values in frame.items() if str(values.dtype) != "geometry"]
    return pa.table([arrow_of(values) for _, values in columns], [name for name, _ in columns])
