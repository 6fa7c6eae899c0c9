"""Depths of water as `Extent`: from rasters and meshes to outlines and grids."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np

from vexture.content import NETCDF, TIFF, start_of, unpacked
from vexture.errors import LimitError, SourceError
from vexture.geo.extent import Extent, Step
from vexture.geo.frame import Frame
from vexture.geo.mesh import MeshSeries, mesh_steps
from vexture.geo.placing import raster_steps
from vexture.geo.reference import Bounds, frame_around, gis_packages, period, reference
from vexture.geo.series import Series
from vexture.notes import Notes
from vexture.tolerance import HMIN

__all__ = ["read_depths"]


@gis_packages()
def read_depths(
    source: bytes | str | os.PathLike[str],
    file_name: str,
    *,
    frame: Frame | None = None,
    bounds: Bounds | None = None,
    crs: str | None = None,
    time_dim: str | None = None,
    hmin: float = HMIN,
    variable: str | None = None,
) -> Extent:
    """Read where water is from depths: GeoTIFF, NetCDF on rows and columns, or a UGRID mesh.

    Parameters
    ----------
    source : bytes or path
        Content of the file, or where it is.
    file_name : str
        Names the drawings.
    frame : Frame, optional
        Where the drawings stand; without one, a new one around the bounds.
    bounds : tuple of float, optional
        West, south, east, north in the file's reference system (or `crs`); without them, all of the file.
    crs : str, optional
        Reference system, in place of the file's.
    time_dim : str, optional
        Dimension that is time; without it, the one that looks like time, if there is one. With any name, the bands
        of a GeoTIFF are steps.
    hmin : float
        Metres; under less water, the ground counts as dry.
    variable : str, optional
        Which variable, or band.

    Raises
    ------
    SourceError, LimitError
        If it cannot be read; a line that says what to do.
    """
    if not hmin > 0.0 or not np.isfinite(hmin):
        raise LimitError(f"hmin is {hmin:g} m; it must be above 0")
    notes = Notes()
    with _opened(unpacked(source), time_dim, variable, notes) as series:
        return _extent(series, Path(file_name).stem or "flood", frame, bounds, crs, hmin, notes)


@contextmanager
def _opened(
    source: bytes | str | os.PathLike[str], time_dim: str | None, variable: str | None, notes: Notes
) -> Iterator[Series | MeshSeries]:
    """Open a file by how it begins."""
    start = start_of(source)
    if start.startswith(TIFF):
        from vexture.geo.rasters import open_geotiff

        with open_geotiff(source, time_dim, variable, notes) as series:
            yield series
    elif start.startswith(NETCDF):
        from vexture.geo.mesh import holds_mesh, mesh_series
        from vexture.geo.netcdf import opened, series_of

        with opened(source) as dataset:
            found = mesh_series if holds_mesh(dataset) else series_of
            yield found(dataset, time_dim, variable)
    elif not start:
        raise SourceError("it cannot be opened or is empty; choose another file")
    else:
        raise SourceError("it is neither GeoTIFF nor NetCDF; write it as one of them")


def _extent(
    series: Series | MeshSeries,
    name: str,
    frame: Frame | None,
    bounds: Bounds | None,
    crs: str | None,
    hmin: float,
    notes: Notes,
) -> Extent:
    """All steps of a series in one frame."""
    system = reference(crs, series.crs)
    if frame is None:
        frame = frame_around(bounds or _whole(series.box, system), system)
    if isinstance(series, MeshSeries):
        readings = mesh_steps(series, system, frame, hmin)
    else:
        readings = raster_steps(series, system, frame, hmin, notes)
    steps: list[Step] = []
    bed, seen = None, False
    for time, found in zip(series.times, readings, strict=True):
        drawing = replace(found.drawing, to_source=frame.to_source, name=name, crs=frame.crs, notes=notes.listed)
        steps.append(Step(drawing, time, found.depth))
        bed = found.bed if bed is None else bed
        seen = seen or found.known
    if not seen:
        when = "" if len(steps) == 1 else f" at any of {len(steps)} steps"
        raise SourceError(
            f"variable {series.variable!r} holds no number within the bounds{when}; write depths, 0 where it is dry"
        )
    return Extent(frame, tuple(steps), bed, notes.listed)


def _whole(box: Bounds, system: str) -> Bounds:
    """Box of a raster, its longitudes as people write them if it does not cross the antimeridian."""
    turn = period(system)
    if turn and box[0] >= turn / 2:
        return (box[0] - turn, box[1], box[2] - turn, box[3])
    return box
