"""Real heights below Norris Dam, Tennessee, and in them the channels of the Clinch River and its creeks."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scenery.grid import Array, Grid

from .channels import accumulated, carved, channels, flow, lateral

CRS = "EPSG:32616"
BOUNDS = (752070.0, 4005720.0, 761250.0, 4013280.0)
CELL = 30.0  # metres
FINE = 4  # pixels of the picture along a cell
ABOVE = 7540.0  # square kilometres of the basin above the dam, from which the river comes in
NORTH = "ymax"  # what the file calls the latitude of its northern border: see README.md


class Terrain(NamedTuple):
    """Arrays of cells over a grid, the northernmost row first."""

    grid: Grid
    height: Array  # metres above the sea, with the channels
    lateral: Array  # square kilometres from which water comes to a channel beside it; 0 where there is none
    bank: Array  # metres from the bank of the nearest channel, negative in it
    source: tuple[int, int]  # row and column of the cell in which the river comes in
    exits: NDArray[np.bool_]  # cells from which water leaves


def sampled(grid: Grid) -> Array:
    """Heights of SRTM on the grid, smoothly between its samples, which are farther apart."""
    import rasterio
    from matplotlib import cbook
    from rasterio.warp import Resampling, reproject

    dem = cbook.get_sample_data("jacksboro_fault_dem.npz")
    degrees = rasterio.Affine(float(dem["dx"]), 0, float(dem["xmin"]), 0, -float(dem["dy"]), float(dem[NORTH]))
    metres = rasterio.Affine(grid.cell, 0, grid.bounds[0], 0, -grid.cell, grid.bounds[3])
    out = np.full(grid.shape, np.nan, np.float32)
    reproject(
        dem["elevation"].astype(np.float32), out, src_transform=degrees, src_crs="EPSG:4326", dst_transform=metres,
        dst_crs=grid.crs, resampling=Resampling.cubic_spline, dst_nodata=np.nan,
    )  # fmt: skip
    if not np.isfinite(out).all():
        raise SystemExit("the grid reaches beyond the heights of SRTM")
    return out.astype(np.float64)


def terrain(cell: float = CELL) -> Terrain:
    """Heights of SRTM, and the channels that they lead to."""
    grid = Grid(CRS, BOUNDS, cell, FINE)
    height = sampled(grid)
    exits = np.zeros(grid.shape, bool)
    exits[-1] = True  # all water goes to the south
    row = int(np.argmin(height[:, -1]))  # the river comes from the east
    ways = flow(height, exits)
    own = np.full(grid.shape, (cell / 1000) ** 2)
    own[row, -1] += ABOVE
    area = accumulated(own, ways)
    bed, bank = carved(height, channels(area, ways), cell)
    own[row, -1] -= ABOVE
    return Terrain(grid, bed, lateral(own, area, ways), bank, (row, grid.shape[1] - 1), exits)
