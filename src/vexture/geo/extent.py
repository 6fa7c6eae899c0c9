"""Where water is, at one time or at several: what all readers of geographic data give."""

import os
from dataclasses import dataclass
from datetime import datetime

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import Drawing
from vexture.errors import LimitError, SourceError
from vexture.geo.frame import Frame
from vexture.reading import holds_depths, start_of
from vexture.tolerance import HMIN

__all__ = ["Extent", "Step", "read_extent"]


@dataclass(frozen=True, slots=True, eq=False)
class Step:
    """Where water is at one time.

    Parameters
    ----------
    drawing : Drawing
        The area under water, in the frame; without paths if all is dry.
    time : datetime or None
        When, as the file says it (UTC where it says nothing).
    depth : (rows, columns) float32 array or None
        Depth in metres over the frame, the northernmost row first, NaN where nothing is known; None where the source
        has none.
    """

    drawing: Drawing
    time: datetime | None = None
    depth: NDArray[np.float32] | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Extent:
    """Where water is, in one frame.

    Parameters
    ----------
    frame : Frame
        Rectangle of the world that all steps are read into.
    steps : tuple of Step
        In the order of time; one for a file without time.
    bed : (rows, columns) float32 array or None
        Height of the bed in metres over the frame, the northernmost row first, where the source has it.

    Examples
    --------
    >>> pond = b'{"type": "Polygon", "coordinates": [[[4, 52], [5, 52], [5, 53], [4, 53]]]}'
    >>> extent = read_extent(pond, "pond.geojson")
    >>> extent.steps[0].time, extent.bed, extent.frame.bounds
    (None, None, (4.0, 52.0, 5.0, 53.0))
    """

    frame: Frame
    steps: tuple[Step, ...]
    bed: NDArray[np.float32] | None = None


def read_extent(
    source: str | os.PathLike[str] | bytes,
    file_name: str | None = None,
    *,
    frame: Frame | None = None,
    bounds: tuple[float, float, float, float] | None = None,
    crs: str | None = None,
    time_dim: str | None = None,
    hmin: float = HMIN,
    variable: str | None = None,
    layer: str | None = None,
) -> Extent:
    """Read where water is from any geographic data that there is a reader for.

    Parameters
    ----------
    source : path or bytes
        Polygons (GeoJSON, GeoPackage, FlatGeobuf, shapefile) or depths (GeoTIFF, NetCDF, UGRID).
    file_name : str, optional
        What it is called: names the drawings and, with the first bytes, says what it is; by default the path.
    frame : Frame, optional
        Where the water is put; by default a new frame around `bounds`.
    bounds : tuple of float, optional
        West, south, east, north in the reference system of the data; by default all of it.
    crs : str, optional
        Reference system of the data, above what the file says.
    time_dim : str, optional
        Dimension that is time, for depths; by default the one that looks like it. With any name the bands of a
        GeoTIFF are steps.
    hmin : float
        Depth in metres from which there is water, for depths; 0.05 by default.
    variable : str, optional
        Variable that holds the depth, where there are several that could.
    layer : str, optional
        Layer of polygons, where there are several.

    Returns
    -------
    Extent
        One step for each time, or one for a file without times.

    Raises
    ------
    SourceError
        If it cannot be read; a line that says what to do.
    LimitError
        If a parameter does not fit it.
    DeviceError
        If a package is missing.

    Examples
    --------
    >>> lake = b'{"type": "Polygon", "coordinates": [[[4, 52], [5, 52], [5, 53], [4, 53]]]}'
    >>> extent = read_extent(lake, "lake.geojson")
    >>> extent.frame.crs, extent.steps[0].drawing.name
    ('OGC:CRS84', 'lake')
    """
    if file_name is None:
        file_name = "the data" if isinstance(source, bytes) else os.fspath(source)
    try:
        if holds_depths(start_of(source), file_name):
            from vexture.geo.depths import read_depths

            _refuse({"--layer": layer}, "polygons, and this file holds depths")
            return read_depths(
                source,
                file_name,
                frame=frame,
                bounds=bounds,
                crs=crs,
                time_dim=time_dim,
                hmin=hmin,
                variable=variable,
            )
        from vexture.geo.polygons import read_polygons

        _refuse({"--time-dim": time_dim, "--variable": variable}, "depths, and this file holds polygons")
        return read_polygons(source, file_name, frame=frame, bounds=bounds, crs=crs, layer=layer)
    except (SourceError, LimitError) as error:
        if isinstance(source, bytes):
            raise
        raise type(error)(f"{os.fspath(source)}: {error}") from None


def _refuse(options: dict[str, str | None], kind: str) -> None:
    """Refuse options that mean nothing."""
    for option, value in options.items():
        if value is not None:
            raise LimitError(f"{option} {value!r} is for {kind}; leave it out")
