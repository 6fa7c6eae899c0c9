"""The entry point for all sources: every command and server reads a file according to its content."""

import io
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, TypeAlias

from vexture.base.content import (
    BEFORE_MARKUP,
    LARGEST_FILE,
    SHAPEFILE,
    FileKind,
    about,
    is_geodatabase,
    is_stream,
    kind_of,
    known_kind,
    read_bytes,
    start_of,
    unpack_source,
)
from vexture.base.errors import ParameterError, SourceError
from vexture.base.notes import warn_of
from vexture.conversion.extensions import find_geographic_reader, geographic_reader
from vexture.conversion.parameters import ImageTreatment, check_images, check_reading

if TYPE_CHECKING:  # at run time a reader is imported when it is needed
    from vexture.drawing.drawing import Drawing
    from vexture.svg.images import Images

Place: TypeAlias = str | os.PathLike[str]
Source: TypeAlias = Place | bytes | bytearray | memoryview | IO[bytes]
"""A path, the content of a file, or an open binary file."""

UNNAMED = "drawing"


def read(
    source: Source,
    *,
    name: str | None = None,
    select: str | None = None,
    names: str | None = None,
    snap: float | None = None,
    fonts: Sequence[Place] = (),
    images: ImageTreatment = "draw",
    page_colors: Mapping[str, str] | None = None,
) -> "Drawing":
    """Read a drawing from a file of any supported kind, which is recognized by its content, not its suffix.

    - SVG, plain or gzipped (`vexture.read_svg`).
    - GeoJSON (`vexture.read_geojson`).
    - PNG, JPEG, WebP, GIF or BMP: a rectangle with the pixels (`Paint.picture`), or the outlines that tracing finds
      (`vexture.read_image`; needs ``vexture[trace]``).
    - Wet areas of a GeoPackage, SpatiaLite, FlatGeobuf, zipped shapefile or FileGDB, KML, KMZ, GPX, GML, GeoTIFF,
      Esri grid, NetCDF or GRIB (`vexture.read_extent`; needs ``vexture[gis]``), GeoParquet, Feather or CSV
      (``vexture[map]``). A time series is read at its first time step.

    Parameters
    ----------
    source : path, bytes or binary file
        The file, or its content. A shapefile, or the folder of a FileGDB, need not be zipped if its path is given.
    name : str, optional
        Name of the file in messages and, without its suffix, of the drawing; by default the path.
    select : str, optional
        A CSS selector, for SVG only; see `vexture.read_svg`.
    names : str, optional
        Source of the paths' names: a property of GeoJSON (`vexture.read_geojson`), or an attribute or ``title`` of
        SVG (`vexture.read_svg`).
    snap : float, optional
        Largest gap between borders of polygons that are merged, for maps only; see `vexture.read_geojson`.
    fonts : sequence of path
        Font files, and folders of font files, for the texts of an SVG; see `vexture.read_svg`.
    images : str
        Treatment of a picture, and of the pictures in an SVG (PNG, JPEG, WebP, GIF, BMP): embedded ones and, if
        `source` is a path, files in its folder or in folders below. ``"draw"`` draws their pixels, ``"trace"`` traces
        them (needs ``vexture[trace]``), and ``"none"`` leaves those in an SVG out. SVG images in both places are always
        drawn. Other files and URLs are never read.
    page_colors : mapping of str to str, optional
        Colours that a page would pass to the SVG, such as that of ``currentColor``; see `vexture.read_svg`.

    Returns
    -------
    Drawing
        Its `notes` list everything that was left out, simplified or chosen.

    Raises
    ------
    SourceError
        If the source cannot be read, or is a texture.
    ParameterError
        If `select`, `fonts` or `page_colors` is given for anything but SVG, `images` for anything but SVG and pictures,
        `names` for anything but GeoJSON and SVG, or `snap` for anything but a map; if `select` is not a selector,
        `page_colors` holds something that is not a colour, `source` is the text of a file, or a parameter has the wrong
        type.
    TypeError
        If `source` is something else, such as a file that is open in text mode.
    LimitError
        If `select` matches nothing that is painted, or a limit is exceeded.
    DeviceError
        If a package is missing.

    Warns
    -----
    SourceWarning
        Once, with all notes.

    Examples
    --------
    >>> read(b'<svg viewBox="0 0 2 2"><path d="M0 0h2v1h-2z"/></svg>', name="half.svg").name
    'half'
    >>> read(b'{"type": "Polygon", "coordinates": [[[4, 52], [6, 52], [6, 53], [4, 53]]]}').crs
    'OGC:CRS84'
    """
    drawing = read_drawing(
        source, name=name, select=select, names=names, snap=snap, fonts=fonts, images=images,
        page_colors=page_colors,
    )  # fmt: skip
    warn_of(name_of(source, name), drawing.notes)
    return drawing


def read_drawing(
    source: Source,
    *,
    name: str | None = None,
    select: str | None = None,
    names: str | None = None,
    snap: float | None = None,
    fonts: Sequence[Place] = (),
    images: ImageTreatment = "draw",
    page_colors: Mapping[str, str] | None = None,
    for_outlines: bool = False,
) -> "Drawing":
    """Read a drawing as `read` does, but without a warning; for its outlines only, trace a picture, which has none."""
    source, label = _check_source(source), name_of(source, name)
    check_images(images)
    with about(label):
        given = unpack_source(
            source if isinstance(source, bytes | str | os.PathLike) else source.read(LARGEST_FILE + 1)
        )
        kind = FileKind.AREAS
        if not is_geodatabase(given):
            if not _is_drawing(given) and (reader := find_geographic_reader()) is not None:
                given = reader.unpack(given, label)
            kind = known_kind(start_of(given) or read_bytes(given), label)
        check_reading(kind, select, names, snap, fonts, page_colors, images)
        if kind is FileKind.PICTURE:
            return _read_picture(given, label, "trace" if for_outlines else images)
        if kind is not FileKind.SVG:
            return _read_other(kind, given, label, names, snap)
        content = read_bytes(given)
    from vexture.svg.read import svg_drawing

    folder = Path(source).parent if isinstance(source, str | os.PathLike) else None
    return svg_drawing(content, label, select, names, fonts, images_of(folder, images), page_colors)


def images_of(folder: Path | None, images: ImageTreatment) -> "Images":
    """Return the access to images of an SVG, embedded ones and those in a folder if given, with their treatment."""
    from vexture.svg.images import Images

    if images != "trace":
        return Images(folder=folder, has_pictures=images == "draw")
    from vexture.tracing.trace import embedded_image

    return Images(embedded_image, folder)


def drawing_of(source: "Drawing | Place", reading: dict[str, Any], *, for_outlines: bool = False) -> "Drawing":
    """Return a source that is a drawing, or read the drawing with the parameters of its reader, as `read_drawing`."""
    from vexture.drawing.drawing import Drawing

    if not isinstance(source, Drawing):
        if not isinstance(source, str | os.PathLike):
            kind = type(source).__name__
            raise TypeError(
                f"`source` is of the type {kind}; give a path or a Drawing, which vexture.read makes of bytes and files"
            )
        return read_drawing(source, for_outlines=for_outlines, **reading)
    for name, value in reading.items():
        raise ParameterError(
            f"`{name}` is {value!r}, but {source.name} is a drawing, which is read already; "
            f"use vexture.read(path, {name}=...)"
        )
    return source


def _check_source(source: object) -> Place | bytes | IO[bytes]:
    """Return a source, with a buffer as bytes; refuse anything that is not a source."""
    if isinstance(source, bytearray | memoryview):
        return bytes(source)
    if isinstance(source, io.TextIOBase):
        raise TypeError("`source` is open in text mode; open it in binary mode: open(path, 'rb')")
    if not (isinstance(source, bytes | str | os.PathLike) or hasattr(source, "read")):
        kind = type(source).__name__
        raise TypeError(f"`source` is of the type {kind}; give a path, bytes or a file that is open in binary mode")
    if isinstance(source, str) and source.lstrip().startswith(("<", "{")) and not os.path.exists(source):
        start = " ".join(source[:60].split())
        raise ParameterError(f"`source` is no path, but a text: {start} ...; use vexture.read(text.encode())")
    return source  # type: ignore[return-value]


def name_of(source: Source, name: str | None = None) -> str:
    """Return the name of a source for messages: `name`, or else its path."""
    if name is not None:
        return name
    if isinstance(source, bytes):
        return UNNAMED
    if isinstance(source, str | os.PathLike):
        return os.fspath(source)
    called = getattr(source, "name", None)  # a number for a pipe
    return called if isinstance(called, str) else UNNAMED


def _read_other(kind: FileKind, source: Place | bytes, label: str, names: str | None, snap: float | None) -> "Drawing":
    """Read anything but SVG; the caller adds the file's name to errors."""
    if kind is FileKind.TEXTURE:
        raise SourceError("is a texture already; give the drawing that it was made from")
    name = Path(label).stem or UNNAMED
    return geographic_reader(kind).read_drawing(kind, source, label, name, names=names, snap=snap)


def _read_picture(source: Place | bytes, label: str, images: ImageTreatment) -> "Drawing":
    """Read a picture; the caller adds the file's name to errors."""
    name = Path(label).stem or UNNAMED
    if images == "trace":
        from vexture.tracing.trace import image_drawing

        return image_drawing(source, name)
    from vexture.tracing.whole import picture_drawing

    return picture_drawing(source, name)


def _is_drawing(source: Place | bytes) -> bool:
    """Return whether the first bytes belong to an SVG drawing, a picture or a texture, not to geographic data."""
    start = start_of(source)
    kind = kind_of(start)
    return kind in (FileKind.TEXTURE, FileKind.PICTURE) or (
        kind is FileKind.SVG and start.lstrip(BEFORE_MARKUP)[:1] == b"<"
    )


def content_of(path: str | os.PathLike[str]) -> bytes:
    """Return the content of a file; a FileGDB, or a shapefile with the files next to it, is packed as a zip."""
    with about(os.fspath(path)):
        if not is_stream(path) and (is_geodatabase(path) or start_of(path).startswith(SHAPEFILE)):
            return geographic_reader(FileKind.AREAS).pack(Path(path)) or read_bytes(path)
        return read_bytes(path)
