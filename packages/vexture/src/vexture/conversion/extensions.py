"""Readers that other distributions add: `vexture.readers` has the entry point ``geographic`` for geographic data."""

import os
from functools import cache
from importlib.metadata import entry_points
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Protocol, TypeAlias, cast

from vexture.base.content import FileKind
from vexture.base.errors import DeviceError

if TYPE_CHECKING:
    from vexture.drawing.drawing import Drawing

READERS: Final = "vexture.readers"
"""Group of the entry points that add readers; each names a module with the functions of `GeographicReader`."""

GEOGRAPHIC: Final = "geographic"

Source: TypeAlias = str | os.PathLike[str] | bytes


class GeographicReader(Protocol):
    """A reader of geographic data; `vexture_geo.extension` is one."""

    def unpack(self, source: Source, file_name: str) -> Source:
        """Return the source, or the content of a zip; refuse formats that are recognized but not supported."""

    def pack(self, path: Path) -> bytes | None:
        """Pack a shapefile or FileGDB, which is several files, into one zip; return None for anything else."""

    def read_drawing(
        self, kind: FileKind, source: Source, file_name: str, name: str, *, names: str | None, snap: float | None
    ) -> "Drawing":
        """Read the areas of a file, at its first time step."""

    def describe_tiles(self, path: Path) -> tuple[dict[str, Any], list[str]] | None:
        """Describe a pyramid of tiles, as JSON and as lines of text; return None for anything else."""

    def flood_widget(self, source: Any, options: dict[str, Any]) -> Any:
        """Make the widget of a flood from its page or data; return None for anything else."""


@cache
def find_geographic_reader() -> GeographicReader | None:
    """Import the reader of geographic data, if one is installed."""
    points = entry_points(group=READERS, name=GEOGRAPHIC)
    return next((cast(GeographicReader, point.load()) for point in points), None)


def geographic_reader(kind: FileKind) -> GeographicReader:
    """Import the reader of geographic data of a kind; raise a `DeviceError` if none is installed."""
    reader = find_geographic_reader()
    if reader is None:
        extra = "geo" if kind is FileKind.GEOJSON else "gis"
        raise DeviceError(f"reading geographic data needs the package vexture-geo: pip install 'vexture[{extra}]'")
    return reader
