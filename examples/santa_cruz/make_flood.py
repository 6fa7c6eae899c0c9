"""A synthetic flood at Santa Cruz: a storm surge of a day over the terrain of this folder, as NetCDF."""

import heapq
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .ground import write_ground
from .terrain import BOUNDS, CELL, COLUMNS, CRS, FINE, ROWS, Array, terrain

NOTE = "Synthetic: an invented surge over an invented terrain on the coastline of GSHHG; no model, no measurement."
HOURS = 24
START = "2026-01-05 00:00:00"


def water_levels() -> Array:
    """Metres above the mean level of the sea, hour by hour: the tide, and a surge that comes and goes."""
    hour = np.arange(HOURS)
    tide = 0.7 * np.cos(2 * np.pi * (hour - 3) / 12.42)
    return 0.1 + tide + 2.1 * np.exp(-(((hour - 14.5) / 3.8) ** 2))


def thresholds(bed: Array) -> Array:
    """For each cell the level at which the sea reaches it: the highest sill on the lowest way there."""
    rows, columns = bed.shape
    reached = np.full(bed.shape, np.inf)
    heap = [(float(bed[r, c]), r, c) for r in (rows - 1,) for c in range(columns)]  # the southern border is sea
    while heap:
        level, r, c = heapq.heappop(heap)
        if level < reached[r, c]:
            reached[r, c] = level
            for i, j in ((r - 1, c), (r + 1, c), (r, c - 1), (r, c + 1)):
                if 0 <= i < rows and 0 <= j < columns and reached[i, j] == np.inf:
                    heapq.heappush(heap, (max(level, float(bed[i, j])), i, j))
    return reached


def depths(bed: Array) -> NDArray[np.float32]:
    """Metres of water in each hour: 0 where it is dry."""
    sill = thresholds(bed)
    wet = [np.where(level > sill, level - bed, 0) for level in water_levels()]
    return np.round(wet, 3).astype(np.float32)


def write_flood(bed: Array, path: Path) -> None:
    """Write bed and depths as CF asks for."""
    import netCDF4
    import pyproj

    with netCDF4.Dataset(path, "w") as file:
        file.setncatts(
            {"Conventions": "CF-1.11", "title": "Flood at Santa Cruz, California (synthetic)", "comment": NOTE}
        )
        for name, size in (("time", HOURS), ("y", ROWS), ("x", COLUMNS)):
            file.createDimension(name, size)
        axes = {
            "time": (
                np.arange(HOURS),
                {"standard_name": "time", "units": f"hours since {START}", "calendar": "standard"},
            ),
            "y": (
                BOUNDS[3] - CELL * (np.arange(ROWS) + 0.5),
                {"standard_name": "projection_y_coordinate", "units": "m"},
            ),
            "x": (
                BOUNDS[0] + CELL * (np.arange(COLUMNS) + 0.5),
                {"standard_name": "projection_x_coordinate", "units": "m"},
            ),
        }
        for name, (values, facts) in axes.items():
            axis = file.createVariable(name, "f8", (name,))
            axis.setncatts(facts)
            axis[:] = values
        file.createVariable("crs", "i4").setncatts(pyproj.CRS(CRS).to_cf())
        on_grid = {"units": "m", "grid_mapping": "crs"}
        data = {
            "depth": (depths(bed), ("time", "y", "x"), {"long_name": "water depth, synthetic", **on_grid}),
            "bed_level": (
                bed,
                ("y", "x"),
                {"long_name": "bed level, synthetic", "standard_name": "altitude", **on_grid},
            ),
            "water_level": (water_levels(), ("time",), {"long_name": "level of the sea, synthetic", "units": "m"}),
        }
        for name, (values, dimensions, facts) in data.items():
            variable = file.createVariable(name, "f4", dimensions, zlib=True)
            variable.setncatts(facts)
            variable[:] = values


def make_flood(folder: Path) -> tuple[Path, Path]:
    """Write `flood.nc`, `ground.jpg` and `ground.tif`; return the first two."""
    land = terrain()
    bed = land.height.reshape(ROWS, FINE, COLUMNS, FINE).mean(axis=(1, 3))
    flood, picture = folder / "flood.nc", folder / "ground.jpg"
    write_flood(bed, flood)
    write_ground(land, picture)
    return flood, picture
