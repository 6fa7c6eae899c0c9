"""Attributes of a pyramid's features: the table beside it, and colours by one of its columns."""

from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import ParameterError
from vexture.base.notes import Notes
from vexture_geo.maps.colours import Scale, check_scale, colours_of, rgba_of
from vexture_geo.tiles.texture import GREY, pack_colours
from vexture_geo.vector.features import ID
from vexture_geo.vector.tables import TABLES, cast, with_legends, write_batches

if TYPE_CHECKING:
    import pyarrow

ROWS, PAINTS = "attributes.arrow", "paints.npy"
"""Files in the folder of an unfinished pyramid."""


@dataclass(frozen=True)
class TileStyle:
    """Attributes, colours and order of features in a pyramid.

    Parameters
    ----------
    color : Scale or None
        Colours by an attribute.
    fill : str or None
        One CSS colour for all features; grey by default.
    columns : tuple of str or None
        Attributes in the table; all by default.
    order : str or None
        Column whose greater values are painted above; by default smaller features are above larger ones.
    table : str
        Kind of the table's file: ``parquet``, ``arrow`` or ``none``.
    """

    color: Scale | None = None
    fill: str | None = None
    columns: tuple[str, ...] | None = None
    order: str | None = None
    table: str = TABLES[-1]

    def check(self) -> None:
        """Raise a `ParameterError` for wrong options before anything is read."""
        if self.color is not None and self.fill is not None:
            raise ParameterError("`color` and `fill` exclude each other; leave one out")
        if self.fill is not None:
            rgba_of(self.fill, "fill")
        if self.color is not None:
            check_scale(self.color)

    @property
    def has_table(self) -> bool:
        """True if a table is written."""
        return self.table != TABLES[-1]

    @property
    def read(self) -> list[str] | None:
        """Columns to read; None for all."""
        wanted = (None if self.color is None else self.color.column, self.order)
        own = list(dict.fromkeys(name for name in wanted if name not in (None, ID)))  # ids are always read
        if not self.has_table:
            return own
        return None if self.columns is None else list(dict.fromkeys([*self.columns, *own]))

    @property
    def key(self) -> list[Any]:
        """All options as JSON, to compare with those of an unfinished pyramid."""
        scale = self.color
        colours = scale and [scale.column, scale.kind, scale.palette, scale.classes, scale.no_data]
        return [colours, self.fill, self.columns and list(self.columns), self.order, self.table]


class Attributes:
    """Attributes of a source, written to a folder batch by batch; the column of colours stays in memory."""

    def __init__(self, folder: Path, style: TileStyle) -> None:
        self._folder, self._style = folder, style
        self._coloured: list[pyarrow.ChunkedArray] = []
        self._writer: Any = None
        self._opened = ExitStack()

    def add(self, features: Any) -> None:
        """Append the attributes of some features."""
        if self._style.color is not None:
            name = self._style.color.column
            features.refuse_numbers(name)
            if name not in features.table.column_names:
                colours_of(features.table, self._style.color, Notes())  # its error lists the columns
            self._coloured.append(features.table.column(name))
        if self._style.has_table:
            import pyarrow as pa

            if self._writer is None:
                file = self._opened.enter_context((self._folder / ROWS).open("wb"))
                self._schema = features.table.schema.remove_metadata()
                self._writer = self._opened.enter_context(pa.ipc.new_file(file, self._schema))
            self._writer.write_table(cast(features.table, self._schema))

    def close(self, layer: str, notes: Notes) -> list[dict[str, Any]]:
        """Write the features' colours, and return the legends."""
        self._opened.close()
        style = self._style
        if style.color is None or not self._coloured:
            rgba, legends = np.array([GREY if style.fill is None else rgba_of(style.fill, "fill")]), []
        else:
            import pyarrow as pa

            values = [chunk for column in self._coloured for chunk in column.chunks]
            table = pa.table({style.color.column: pa.chunked_array(values, self._coloured[0].type)})
            rgba, legend = colours_of(table, style.color, notes)
            legends = [{"layer": layer, **legend}]
        np.save(self._folder / PAINTS, pack_colours(rgba))
        return legends


def paints_of(folder: Path) -> NDArray[np.uint32]:
    """Read the colours of features by their numbers; a single colour applies to all."""
    found: NDArray[np.uint32] = np.load(folder / PAINTS)
    return found


def write_table(file: IO[bytes], folder: Path, kind: str, legends: list[dict[str, Any]]) -> None:
    """Write the table of a folder as Parquet or Arrow."""
    import pyarrow as pa

    with pa.memory_map(str(folder / ROWS)) as rows, pa.ipc.open_file(rows) as reader:

        def batches() -> Iterator["pyarrow.Table"]:
            for number in range(reader.num_record_batches):
                yield pa.Table.from_batches([reader.get_batch(number)])

        write_batches(file, with_legends(reader.schema, legends), batches(), kind)
