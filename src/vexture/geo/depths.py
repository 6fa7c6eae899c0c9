"""Rasters and meshes of water depths as `Extent`."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from vexture.content import NETCDF, TIFF, start_of, unpacked
from vexture.errors import ParameterError, SourceError
from vexture.geo.crs import chosen_crs, frame_of, gis_packages, period
from vexture.geo.datasets import is_dataset
from vexture.geo.extent import Bounds, Extent, Frame, Step
from vexture.geo.mesh import MeshInFrame, MeshSeries
from vexture.geo.raster import RasterInFrame
from vexture.geo.series import Series, plausible
from vexture.notes import Notes
from vexture.tolerance import HMIN

__all__ = ["read_depths"]


@gis_packages()
def read_depths(
    source: Any,
    file_name: str,
    *,
    frame: Frame | None = None,
    bounds: Bounds | None = None,
    crs: str | None = None,
    time_dim: str | None = None,
    hmin: float = HMIN,
    variable: str | None = None,
) -> Extent:
    """Read where water is from a GeoTIFF, or from NetCDF or xarray: on rows and columns, straight or not, or on a mesh.

    A file named as a partition of D-Flow FM, ``run_0000_map.nc``, is read with all others of its run beside it.
    Parameters and errors as in `vexture.read_extent`.
    """
    if not hmin > 0.0 or not np.isfinite(hmin):
        raise ParameterError(f"`hmin` is {hmin:g} m; it must be above 0")
    notes = Notes()
    with _opened(source if is_dataset(source) else unpacked(source), time_dim, variable, notes) as series:
        system = chosen_crs(crs, series.crs)
        if frame is None:
            frame = frame_of(bounds, _whole(series.box, system), system)
        return _extent(series, Path(file_name).stem or "flood", system, frame, hmin, notes)


@contextmanager
def _opened(source: Any, time_dim: str | None, variable: str | None, notes: Notes) -> Iterator[Series | MeshSeries]:
    """Open a file of the format that its first bytes show, or a dataset of xarray."""
    start = b"" if is_dataset(source) else start_of(source)
    if is_dataset(source):
        from vexture.geo.netcdf import opened

        with opened(source, time_dim) as dataset:
            yield _series_of(dataset, time_dim, variable)
    elif start.startswith(TIFF):
        from vexture.geo.geotiff import open_geotiff

        with open_geotiff(source, time_dim, variable, notes) as series:
            yield series
    elif start.startswith(NETCDF):
        from vexture.geo.netcdf import opened
        from vexture.geo.partitions import merged_partitions, partitions_beside

        partitions = [] if isinstance(source, bytes) else partitions_beside(Path(source))
        if partitions:
            with merged_partitions(partitions, time_dim, variable) as run:
                yield run
            return
        with opened(source, time_dim) as dataset:
            yield _series_of(dataset, time_dim, variable)
    elif not start:
        raise SourceError("it cannot be opened or is empty; choose another file")
    else:
        raise SourceError("it is neither GeoTIFF nor NetCDF; write it as one of them")


def _series_of(dataset: Any, time_dim: str | None, variable: str | None) -> Series | MeshSeries:
    """Depths of an open dataset, on whatever it has them."""
    from vexture.geo.curvilinear import grid_series, places_of_grid
    from vexture.geo.netcdf import series_of
    from vexture.geo.ugrid import holds_mesh, mesh_series

    if holds_mesh(dataset):
        return mesh_series(dataset, time_dim, variable)
    grids = places_of_grid(dataset, time_dim)
    return grid_series(dataset, grids, time_dim, variable) if grids else series_of(dataset, time_dim, variable)


def _extent(series: Series | MeshSeries, name: str, system: str, frame: Frame, hmin: float, notes: Notes) -> Extent:
    """All steps of a series in one frame."""
    placed: MeshInFrame | RasterInFrame
    if isinstance(series, MeshSeries):
        placed = MeshInFrame(series, system, frame)
    else:
        placed = RasterInFrame(series, system, frame, notes)
    steps: list[Step] = []
    bed, seen = None, False
    for number, time in enumerate(series.times):
        read, ground = placed.read(number)
        depth, ground = plausible(read), None if ground is None else plausible(ground)
        drawing = placed.drawing(depth, ground, hmin)
        drawing = replace(drawing, to_source=frame.to_source, name=name, crs=frame.crs, notes=notes.listed)
        steps.append(Step(drawing, time, placed.grid(np.where(depth < 0.0, 0.0, depth))))
        if bed is None and ground is not None:
            bed = placed.grid(ground)
        seen = seen or bool(np.isfinite(depth).any())
    if not seen:
        when = "" if len(steps) == 1 else f" at any of {len(steps)} steps"
        raise SourceError(
            f"variable {series.variable!r} holds no number within the bounds{when}; write depths, 0 where it is dry"
        )
    return Extent(frame, tuple(steps), bed, notes.listed)


def _whole(box: Bounds, system: str) -> Bounds:
    """Box of a raster, with longitudes of up to half a turn if it does not cross the antimeridian."""
    turn = period(system)
    if turn and box[0] >= turn / 2:
        return (box[0] - turn, box[1], box[2] - turn, box[3])
    return box
