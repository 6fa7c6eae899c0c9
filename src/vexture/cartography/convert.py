"""From files of features to the texture of a map, its table and its legend."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vexture.cartography.map import Layout, drawn
from vexture.cartography.marks import Length
from vexture.cartography.placing import MERCATOR
from vexture.cartography.scales import NO_DATA, Kind, Legend, Scale
from vexture.content import about
from vexture.deadline import DEFAULT_SECONDS, within
from vexture.errors import DeviceError, ParameterError
from vexture.geo.crs import gis_packages
from vexture.geo.features import read_features
from vexture.notes import Note, Notes, line_of
from vexture.pipeline import run
from vexture.texture.files import write_together
from vexture.texture.texture import Texture

if TYPE_CHECKING:
    from pyarrow import Table

__all__ = ["Map", "convert_map"]


@dataclass(frozen=True, slots=True, eq=False)
class Map:
    """A map that was made.

    Attributes
    ----------
    texture : Texture
        One planar map, whose elements are the features by their names: `Texture.with_paints` colours them anew, and
        `Texture.element_at` tells which is where.
    table : pyarrow.Table
        Attributes, a row for each feature; the first column, ``id``, has the names.
    legend : Legend or None
        What the colours mean.
    notes : tuple of Note
        What was repaired, cut or left out.
    """

    texture: Texture
    table: "Table"
    legend: Legend | None
    notes: tuple[Note, ...]

    @property
    def warning(self) -> str:
        """All notes in a line."""
        return line_of(self.texture.name, self.notes)

    def facts(self) -> dict[str, Any]:
        """For JSON."""
        root = self.texture.roots[0]
        return {
            "name": self.texture.name,
            "features": self.table.num_rows,
            "crs": root.crs,
            "to_source": root.to_source.tolist(),
            "legend": None if self.legend is None else self.legend.facts(),
            "notes": [note.facts() for note in self.notes],
        }

    def save(self, texture: str | os.PathLike[str], table: str | os.PathLike[str]) -> int:
        """Write the texture and its table, ``.parquet`` or ``.arrow``, or on an error none; the bytes of the first."""
        content = self.texture.to_ktx2()
        write_together({Path(texture): content, Path(table): _table_bytes(self.table, Path(table).suffix.lower())})
        return len(content)


def _table_bytes(table: "Table", suffix: str) -> bytes:
    held = BytesIO()
    if suffix == ".arrow":
        from pyarrow import ipc

        with ipc.new_file(held, table.schema) as writer:
            writer.write_table(table)
    else:
        from pyarrow import parquet

        parquet.write_table(table, held)
    return held.getvalue()


def convert_map(
    sources: Any,
    name: str | None = None,
    *,
    layer: str | None = None,
    where: str | None = None,
    id: str | None = None,
    columns: Sequence[str] | None = None,
    crs: str = MERCATOR,
    source_crs: str | None = None,
    color: str | None = None,
    scale: Kind = "auto",
    classes: int = 5,
    breaks: tuple[float, ...] = (),
    palette: str | None = None,
    no_data: tuple[float, float, float, float] = NO_DATA,
    order: str | None = None,
    snap: float | None = None,
    gaps: float = 0.0,
    stroke: str = "1.5px",
    symbol: str | os.PathLike[str] | None = None,
    symbol_size: str = "8px",
    pixels: float = 1000.0,
    tolerance: Any = "auto",
    max_seconds: float = DEFAULT_SECONDS,
) -> Map:
    """Make a map of vector files or GeoDataFrames, the later ones over the earlier ones.

    Parameters are those of the command ``vexture map``; see `Layout`, `Scale` and `read_features`.

    Raises
    ------
    SourceError
        If a source cannot be read, or nothing of it is in the map's plane.
    ParameterError
        If a parameter is out of range, or a column, layer or palette is not there.
    LimitError
        If the map is too large, or takes longer than `max_seconds`.
    DeviceError
        If a package of ``vexture[map]`` is missing.
    """
    if isinstance(sources, str | os.PathLike) or hasattr(sources, "to_arrow"):
        sources = [sources]
    if not 1.0 <= pixels <= 1e6:
        raise ParameterError(f"`pixels` is {pixels:g}; it must be in 1..1,000,000")
    if not gaps >= 0.0:
        raise ParameterError(f"`gaps` is {gaps}; it must be 0 or more, in units of the map's reference system")
    notes = Notes()
    drawn_symbol = None
    if symbol is not None:
        from vexture.reading import read_drawing

        drawn_symbol = read_drawing(symbol)
    layout = Layout(
        crs, color, Scale(scale, classes, breaks, palette, no_data), order, snap, gaps,
        Length.parsed(stroke, "stroke"), drawn_symbol, Length.parsed(symbol_size, "symbol-size"), pixels,
    )  # fmt: skip
    with within(max_seconds), _packages(), gis_packages():
        several = []
        for source in sources:
            shown = os.fspath(source) if isinstance(source, str | os.PathLike) else "the GeoDataFrame"
            with about(shown):
                several.append(
                    read_features(
                        source,
                        layer=layer,
                        where=where,
                        crs=source_crs,
                        id=id,
                        columns=_wanted(columns, color, order),
                        notes=notes,
                    )
                )
        title = name or (Path(sources[0]).stem if isinstance(sources[0], str | os.PathLike) else "map")
        with about(title):
            made = drawn(several, layout, title, notes)
        done = run(made.drawing, split="faces", restyle=True, tolerance=tolerance, max_seconds=max_seconds)
    return Map(done.texture, made.table, made.legend, done.notes)


def _wanted(columns: Sequence[str] | None, color: str | None, order: str | None) -> list[str] | None:
    """Columns to keep, with those that are used."""
    if columns is None:
        return None
    used = [name for name in (color, order) if name not in (None, "area")]
    return [*dict.fromkeys([*columns, *(name for name in used if name is not None)])]


def _packages() -> Any:
    from contextlib import contextmanager

    @contextmanager
    def told() -> Any:
        try:
            yield
        except ModuleNotFoundError as error:
            if (error.name or "").split(".")[0] not in ("pyarrow", "cmap"):
                raise
            raise DeviceError(f"maps need the package {error.name}: pip install 'vexture[map]'") from None

    return told()
