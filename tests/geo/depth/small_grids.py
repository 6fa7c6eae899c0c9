"""Small grids of numbers, in files of NetCDF and GeoTIFF."""

import netCDF4
import numpy as np
import rasterio
from rasterio.transform import Affine

from vexture.base.notes import line_of
from vexture_geo.depth.depths import read_depths

CRS = "EPSG:32610"
CELL, ROWS, COLUMNS = 10.0, 8, 12
PLACE = Affine(CELL, 0.0, 500_000.0, 0.0, -CELL, 4_000_080.0)


def columns(*numbers):
    """Numbers that fill as many columns each, by time, y and x."""
    line = np.repeat(numbers, COLUMNS // len(numbers))
    return np.broadcast_to(line, (1, ROWS, COLUMNS))


def netcdf(path, variables, dtype="i1", bounds=None):
    """A file of variables: numbers by time, y and x, and attributes."""
    with netCDF4.Dataset(path, "w") as file:
        for name, count in (("time", None), ("y", ROWS), ("x", COLUMNS)):
            file.createDimension(name, count)
        file.epsg_code = CRS
        for name, first, count in (("x", 500_005.0, COLUMNS), ("y", 4_000_005.0, ROWS)):
            file.createVariable(name, "f8", (name,))[:] = first + CELL * np.arange(count)
        if bounds is not None:
            file.createDimension("class", len(bounds))
            file.createDimension("two", 2)
            file.createVariable("class_bounds_hs", "f8", ("class", "two"))[:] = bounds
        for name, (numbers, about) in variables.items():
            one = file.createVariable(name, dtype, ("time", "y", "x"), fill_value=about.pop("_FillValue", False))
            one.set_auto_maskandscale(False)
            one.setncatts(about)
            one[:] = numbers
    return path


def geotiff(path, numbers, **profile):
    bands = np.asarray(numbers)
    bands = bands if bands.ndim == 3 else bands[None]
    count, rows, across = bands.shape
    with rasterio.open(
        path, "w", driver="GTiff", width=across, height=rows, count=count, dtype=bands.dtype, crs=CRS,
        transform=PLACE, **profile,
    ) as file:  # fmt: skip
        file.write(bands)
    return path


def read(path, **options):
    return read_depths(path, path.name, **options)


def said(extent):
    return line_of("file", extent.notes)
