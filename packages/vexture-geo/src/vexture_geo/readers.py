"""Readers of geographic data: wet places of any supported kind, as an `Extent` or as a drawing."""

import os
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, TypeAlias

from vexture.base.content import FileKind, kind_of, start_of, unpack_source
from vexture.base.errors import LimitError, ParameterError, SourceError
from vexture.base.notes import Note, warn_of
from vexture.base.tolerance import HMIN
from vexture_geo.base.foreign import refuse_foreign

if TYPE_CHECKING:
    from xarray import DataArray, Dataset

    from vexture.base.workers import Workers
    from vexture.drawing.drawing import Drawing
    from vexture_geo.base.extent import Extent, Frame

Place: TypeAlias = str | os.PathLike[str]


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
        Dimension of time, for depths; by default the one that looks like time. With any value, bands of a GeoTIFF are
        steps.
    hmin : float
        Depth in metres from which a place is wet, for depths; 0.05 by default.
    variable : str, optional
        Variable of the depths, if there are several.
    layer : str, optional
        Layer of polygons, if there are several.
    snap : float, optional
        Largest distance, as a fraction of the frame's larger side, at which borders of two polygons become one; 3e-6 by
        default, and 0 leaves everything as it is.
    depths : sequence of float
        Depths in metres above `hmin`: each step also holds the areas with at least this depth. Polygons and masks have
        none. A file of classes of depth has only those at which its own classes begin.

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
        One warning with all notes.

    Examples
    --------
    >>> lake = b'{"type": "Polygon", "coordinates": [[[4, 52], [5, 52], [5, 53], [4, 53]]]}'
    >>> extent = read_extent(lake, "lake.geojson")
    >>> extent.frame.crs, extent.steps[0].drawing.name
    ('OGC:CRS84', 'lake')
    """
    from vexture_geo.base.datasets import is_dataset

    path = "" if isinstance(source, bytes) or is_dataset(source) else str(os.fspath(source))
    shown = file_name or path or "the data"
    try:
        extent = extent_of(
            source, shown, frame=frame, bounds=bounds, crs=crs, time_dim=time_dim, hmin=hmin, variable=variable,
            layer=layer, snap=snap, depths=depths,
        )  # fmt: skip
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
    """Read wet areas like `read_extent`, but without a warning, and without the file's name in errors."""
    from vexture_geo.base.datasets import is_dataset

    if not is_dataset(source):
        source = unpack_source(source)
        refuse_foreign(start_of(source), file_name)
    if is_dataset(source) or kind_of(start_of(source), file_name) is FileKind.DEPTHS:
        from vexture_geo.depth.depths import read_depths

        _refuse({"`layer`": layer, "`snap`": snap}, "polygons, and this file holds depths")
        return read_depths(
            source, file_name, frame=frame, bounds=bounds, crs=crs, time_dim=time_dim, hmin=hmin, variable=variable,
            depths=depths, workers=workers,
        )  # fmt: skip
    from vexture_geo.vector.polygons import read_polygons

    _refuse({"`time_dim`": time_dim, "`variable`": variable}, "depths, and this file holds polygons")
    return read_polygons(source, file_name, frame=frame, bounds=bounds, crs=crs, layer=layer, snap=snap)


def _refuse(options: dict[str, str | float | None], kind: str) -> None:
    """Raise a `ParameterError` for parameters of another kind of data."""
    for option, value in options.items():
        if value is not None:
            raise ParameterError(f"{option} {value!r} is for {kind}; leave it out")


def read_first_step(source: Place | bytes, file_name: str, snap: float | None) -> "Drawing":
    """Read the wet areas at the first time; the file need not be georeferenced."""
    from vexture_geo.base.crs import UNPLACED, MissingReferenceError

    try:
        extent = extent_of(source, file_name, snap=snap)
    except MissingReferenceError:
        extent = extent_of(source, file_name, crs=UNPLACED, snap=snap)
    drawing, count = extent.steps[0].drawing, len(extent.steps)
    if count == 1:
        return drawing
    note = Note("remark", f"it has {count} times, of which the first is read; vexture flood shows all")
    return replace(drawing, notes=(*drawing.notes, note))
