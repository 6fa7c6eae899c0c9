"""Which reader a file needs, by its suffix or its first bytes."""

import os
from pathlib import Path
from typing import TYPE_CHECKING, Final

from vexture.errors import LimitError

if TYPE_CHECKING:
    from vexture.drawing import Drawing

__all__ = ["BYTE_ORDER_MARK", "is_geojson", "read_drawing"]

GEOJSON_SUFFIXES: Final = (".geojson", ".json")
BYTE_ORDER_MARK: Final = b"\xef\xbb\xbf"


def is_geojson(start: bytes, file_name: str | os.PathLike[str]) -> bool:
    """Whether a file is GeoJSON, from how its content starts and what it is called.

    Examples
    --------
    >>> is_geojson(b'  {"type": "Feature"}', "delft"), is_geojson(b"<svg/>", "delft.svg")
    (True, False)
    """
    by_name = Path(file_name).suffix.lower() in GEOJSON_SUFFIXES
    return by_name or start.removeprefix(BYTE_ORDER_MARK).lstrip()[:1] == b"{"


def read_drawing(path: str | os.PathLike[str], select: str | None = None) -> "Drawing":
    """Read a drawing of any kind of file that there is a reader for.

    Parameters
    ----------
    path : path
        SVG or GeoJSON.
    select : str, optional
        A CSS selector, of SVG only.

    Raises
    ------
    SourceError
        If it cannot be read.
    LimitError
        If `select` is given where it means nothing, or as `read_svg` says.
    """
    if is_geojson(_start(path), path):
        from vexture.sources.geojson import read_geojson

        if select is not None:
            raise LimitError(f"{os.fspath(path)}: select={select!r} chooses elements of an SVG; leave it out")
        return read_geojson(path)
    from vexture.sources.svg import read_svg

    return read_svg(path, select)


def _start(path: str | os.PathLike[str]) -> bytes:
    """Return first bytes of a file, none if it cannot be read: the reader says why."""
    try:
        with Path(path).open("rb") as file:
            return file.read(64)
    except (OSError, ValueError):
        return b""
