"""The entry point of all sources: the content of a file decides how it is read, in every command and server."""

import io
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, TypeAlias

from vexture.content import (
    LARGEST_FILE,
    FileKind,
    about,
    is_geodatabase,
    kind_of,
    known_kind,
    read_bytes,
    start_of,
    unpacked,
)
from vexture.errors import LimitError, ParameterError, SourceError
from vexture.geo.foreign import refuse_foreign
from vexture.notes import Note, warn_of
from vexture.parameters import check_reading
from vexture.tolerance import HMIN

if TYPE_CHECKING:  # at run time a reader is imported when it is needed
    from xarray import DataArray, Dataset

    from vexture.drawing import Drawing
    from vexture.geo.extent import Extent, Frame
    from vexture.svg.images import Images
    from vexture.workers import Workers

__all__ = [
    "Source",
    "content_of",
    "drawing_of",
    "extent_of",
    "images_of",
    "name_of",
    "read",
    "read_drawing",
    "read_extent",
]

Place: TypeAlias = str | os.PathLike[str]
Source: TypeAlias = Place | bytes | bytearray | memoryview | IO[bytes]
"""A path, the content of a file, or a binary file that is open."""

UNNAMED = "drawing"


def read(
    source: Source,
    *,
    name: str | None = None,
    select: str | None = None,
    names: str | None = None,
    snap: float | None = None,
    fonts: Sequence[Place] = (),
    trace_images: bool = False,
    page_colors: Mapping[str, str] | None = None,
) -> "Drawing":
    """Read a drawing from a file of any supported kind; its content decides, not its suffix.

    - SVG, plain or gzipped (`vexture.read_svg`).
    - GeoJSON (`vexture.read_geojson`).
    - PNG, JPEG, WebP, GIF or BMP, traced (`vexture.read_image`; needs ``vexture[trace]``).
    - Wet areas of a GeoPackage, SpatiaLite, FlatGeobuf, zipped shapefile or FileGDB, KML, KMZ, GPX, GML, GeoTIFF,
      Esri grid, NetCDF or GRIB, of a series at its first time (`vexture.read_extent`; needs ``vexture[gis]``),
      GeoParquet, Feather or CSV (``vexture[map]``).

    Parameters
    ----------
    source : path, bytes or binary file
        The file, or its content. The paths of a shapefile and of the folder of a FileGDB need no zip.
    name : str, optional
        Name of the file in messages and, without its suffix, of the drawing; by default the path.
    select : str, optional
        A CSS selector, of SVG only; see `vexture.read_svg`.
    names : str, optional
        What names paths: a property of GeoJSON (`vexture.read_geojson`), an attribute or ``title`` of SVG
        (`vexture.read_svg`).
    snap : float, optional
        How far borders of polygons that become one may differ, of maps only; see `vexture.read_geojson`.
    fonts : sequence of path
        Font files, and folders of them, for the texts of an SVG; see `vexture.read_svg`.
    trace_images : bool
        Trace the pictures in an SVG (PNG, JPEG, WebP, GIF, BMP; needs ``vexture[trace]``): those in it, and those in
        files beside it or in folders below, if `source` is a path. Drawings in both places are always drawn. Other
        files and addresses are never read.
    page_colors : mapping of str to str, optional
        Colours that its page would give an SVG, such as of ``currentColor``; see `vexture.read_svg`.

    Returns
    -------
    Drawing
        Its `notes` say what was left out, simplified or chosen.

    Raises
    ------
    SourceError
        If it cannot be read, or is a texture.
    ParameterError
        If `select`, `fonts`, `trace_images` or `page_colors` is given for anything but an SVG, `names` for neither
        GeoJSON nor SVG, `snap` for anything but a map, `select` is no selector, `page_colors` holds no colour, `source`
        is the text of a file, or a parameter is of the wrong type.
    TypeError
        If `source` is something else, such as a file that is open in text mode.
    LimitError
        If `select` matches nothing that is painted, or a limit is exceeded.
    DeviceError
        If a package is missing.

    Warns
    -----
    SourceWarning
        Once, of all notes.

    Examples
    --------
    >>> read(b'<svg viewBox="0 0 2 2"><path d="M0 0h2v1h-2z"/></svg>', name="half.svg").name
    'half'
    >>> read(b'{"type": "Polygon", "coordinates": [[[4, 52], [6, 52], [6, 53], [4, 53]]]}').crs
    'OGC:CRS84'
    """
    drawing = read_drawing(
        source, name=name, select=select, names=names, snap=snap, fonts=fonts, trace_images=trace_images,
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
    trace_images: bool = False,
    page_colors: Mapping[str, str] | None = None,
) -> "Drawing":
    """Read a drawing as `read` does, but without a warning."""
    from vexture.geo.archives import unzipped

    source, shown = _checked(source), name_of(source, name)
    if not isinstance(trace_images, bool):
        raise ParameterError(f"`trace_images` is {trace_images!r:.80}; it must be True or False")
    with about(shown):
        given = unzipped(
            unpacked(source if isinstance(source, bytes | str | os.PathLike) else source.read(LARGEST_FILE + 1))
        )
        kind = FileKind.AREAS
        if not is_geodatabase(given):
            refuse_foreign(start_of(given), shown)
            kind = known_kind(start_of(given) or read_bytes(given), shown)
        check_reading(kind, select, names, snap, fonts, page_colors, trace_images=trace_images)
        if kind is not FileKind.SVG:
            return _read_other(kind, given, shown, names, snap)
        content = read_bytes(given)
    from vexture.svg.read import svg_drawing

    folder = Path(source).parent if isinstance(source, str | os.PathLike) else None
    return svg_drawing(content, shown, select, names, fonts, images_of(folder, traced=trace_images), page_colors)


def images_of(folder: Path | None, *, traced: bool) -> "Images":
    """Images that are read: those in an SVG, and those in a folder, if there is one; pictures if they are `traced`."""
    from vexture.svg.images import Images

    if not traced:
        return Images(folder=folder)
    from vexture.tracing.trace import embedded_image

    return Images(embedded_image, folder)


def drawing_of(source: "Drawing | Place", reading: dict[str, Any]) -> "Drawing":
    """Drawing that a source is or holds, with the parameters of its reader."""
    from vexture.drawing import Drawing

    if not isinstance(source, Drawing):
        if not isinstance(source, str | os.PathLike):
            kind = type(source).__name__
            raise TypeError(
                f"`source` is of the type {kind}; give a path or a Drawing, which vexture.read makes of bytes and files"
            )
        return read_drawing(source, **reading)
    for name, value in reading.items():
        raise ParameterError(
            f"`{name}` is {value!r}, but {source.name} is a drawing, which is read already; "
            f"use vexture.read(path, {name}=...)"
        )
    return source


def _checked(source: object) -> Place | bytes | IO[bytes]:
    """Return a source as it is, or a buffer as bytes; refuse anything else."""
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
    """Name of a source in messages: the given one, or its path."""
    if name is not None:
        return name
    if isinstance(source, bytes):
        return UNNAMED
    if isinstance(source, str | os.PathLike):
        return os.fspath(source)
    called = getattr(source, "name", None)  # of a pipe it is a number
    return called if isinstance(called, str) else UNNAMED


def _read_other(kind: FileKind, source: Place | bytes, shown: str, names: str | None, snap: float | None) -> "Drawing":
    """Read anything but SVG; the caller puts the name in front of errors."""
    if kind is FileKind.TEXTURE:
        raise SourceError("is a texture already; give the drawing that it was made from")
    name = Path(shown).stem or UNNAMED
    if kind is FileKind.PICTURE:
        from vexture.tracing.trace import image_drawing

        return image_drawing(source, name)
    if kind is FileKind.GEOJSON:
        from vexture.geo.geojson import geojson_drawing

        return geojson_drawing(read_bytes(source), name, names=names, snap=snap)
    return _read_first_step(source, shown, snap)


def _read_first_step(source: Place | bytes, shown: str, snap: float | None) -> "Drawing":
    """Wet areas at the first time; the file need not be georeferenced."""
    from dataclasses import replace

    from vexture.geo.crs import UNPLACED, MissingReferenceError

    try:
        extent = extent_of(source, shown, snap=snap)
    except MissingReferenceError:
        extent = extent_of(source, shown, crs=UNPLACED, snap=snap)
    drawing, count = extent.steps[0].drawing, len(extent.steps)
    if count == 1:
        return drawing
    told = Note("remark", f"it has {count} times, of which the first is read; vexture flood shows all")
    return replace(drawing, notes=(*drawing.notes, told))


def read_extent(
    source: "Place | bytes | Dataset | DataArray",
    file_name: str | None = None,
    *,
    frame: "Frame | None" = None,
    bounds: tuple[float, float, float, float] | None = None,
    crs: str | None = None,
    time_dim: str | None = None,
    hmin: float = HMIN,
    variable: str | None = None,
    layer: str | None = None,
    snap: float | None = None,
    depths: Sequence[float] = (),
) -> "Extent":
    """Read wet areas from geographic data of any supported kind.

    Parameters
    ----------
    source : path, bytes, Dataset or DataArray
        Polygons (in any format that `vexture.read` takes) or depths (GeoTIFF, Esri's .asc and .flt, GRIB, NetCDF: on
        rows and columns, a curvilinear grid or a mesh); or depths as xarray holds them, read one step at a time.
    file_name : str, optional
        Name of the file and of the drawings; by default the path.
    frame : Frame, optional
        Frame of the drawings; by default a new one around `bounds`.
    bounds : tuple of float, optional
        West, south, east, north in the reference system of the data; by default all of it.
    crs : str, optional
        Reference system of the data; it overrides the one in the file.
    time_dim : str, optional
        Dimension of time, for depths; by default the one that looks like it. With any, bands of a GeoTIFF are steps.
    hmin : float
        Depth in metres from which there is water, for depths; 0.05 by default.
    variable : str, optional
        Variable of the depths, where there are several.
    layer : str, optional
        Layer of polygons, where there are several.
    snap : float, optional
        Borders of two polygons that differ by no more than this become one, in parts of the frame's larger side; 3e-6
        by default, 0 leaves all as it is.
    depths : sequence of float
        Depths in metres above `hmin`: each step also holds the areas under at least so much water. Polygons and masks
        have none. A file of classes of depth has those that begin where its own classes do.

    Returns
    -------
    Extent
        One step for each time, or one for a file without times. Its `notes` say what was left out or chosen.

    Raises
    ------
    SourceError
        If it cannot be read.
    LimitError
        If it exceeds a limit, or has several layers or variables and none is chosen.
    ParameterError
        If a parameter does not fit it.
    DeviceError
        If a package is missing.

    Warns
    -----
    SourceWarning
        Once, of all notes.

    Examples
    --------
    >>> lake = b'{"type": "Polygon", "coordinates": [[[4, 52], [5, 52], [5, 53], [4, 53]]]}'
    >>> extent = read_extent(lake, "lake.geojson")
    >>> extent.frame.crs, extent.steps[0].drawing.name
    ('OGC:CRS84', 'lake')
    """
    from vexture.geo.datasets import is_dataset

    path = "" if isinstance(source, bytes) or is_dataset(source) else str(os.fspath(source))
    shown = file_name or path or "the data"
    options: dict[str, Any] = {
        "frame": frame,
        "bounds": bounds,
        "crs": crs,
        "time_dim": time_dim,
        "variable": variable,
        "layer": layer,
    }
    try:
        extent = extent_of(source, shown, hmin=hmin, snap=snap, depths=depths, **options)
    except (SourceError, LimitError, ParameterError) as error:
        raise type(error)(f"{path}: {error}" if path else str(error)) from None
    warn_of(shown, extent.notes)
    return extent


def extent_of(
    source: "Place | bytes | Dataset | DataArray",
    file_name: str,
    *,
    frame: "Frame | None" = None,
    bounds: tuple[float, float, float, float] | None = None,
    crs: str | None = None,
    time_dim: str | None = None,
    hmin: float = HMIN,
    variable: str | None = None,
    layer: str | None = None,
    snap: float | None = None,
    depths: Sequence[float] = (),
    workers: "Workers | None" = None,
) -> "Extent":
    """Read wet areas as `read_extent` does, but without a warning, and without the file's name in errors."""
    from vexture.geo.datasets import is_dataset
    from vexture.geo.foreign import refuse_foreign

    if not is_dataset(source):
        source = unpacked(source)
        refuse_foreign(start_of(source), file_name)
    if is_dataset(source) or kind_of(start_of(source), file_name) is FileKind.DEPTHS:
        from vexture.geo.depths import read_depths

        _refuse({"`layer`": layer, "`snap`": snap}, "polygons, and this file holds depths")
        return read_depths(
            source, file_name, frame=frame, bounds=bounds, crs=crs, time_dim=time_dim, hmin=hmin, variable=variable,
            depths=depths, workers=workers,
        )  # fmt: skip
    from vexture.geo.polygons import read_polygons

    _refuse({"`time_dim`": time_dim, "`variable`": variable}, "depths, and this file holds polygons")
    return read_polygons(source, file_name, frame=frame, bounds=bounds, crs=crs, layer=layer, snap=snap)


def _refuse(options: dict[str, str | float | None], kind: str) -> None:
    """Refuse parameters for data of another kind."""
    for option, value in options.items():
        if value is not None:
            raise ParameterError(f"{option} {value!r} is for {kind}; leave it out")


def content_of(path: str | os.PathLike[str]) -> bytes:
    """Content of a file as `read_bytes` has it; a zip of a FileGDB, or of a shapefile and the files beside it."""
    from vexture.geo.archives import whole

    with about(os.fspath(path)):
        return whole(Path(path)) or read_bytes(path)
