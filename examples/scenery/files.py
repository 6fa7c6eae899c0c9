"""Files of a scene: a flood as NetCDF, the sea's polygon, a picture of the ground."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray
from PIL import Image

from .grid import Array, Grid

QUALITY = 82  # of the JPEG

Facts = dict[str, Any]


def sea_of(coastline: Path, grid: Grid) -> shapely.Geometry:
    """The sea of a `coastline.geojson`, in metres."""
    features = json.loads(coastline.read_text())["features"]
    degrees = shapely.from_geojson(json.dumps(features[0]["geometry"]))
    return shapely.transform(degrees, grid.metres)


def hours(start: str, count: int) -> tuple[Array, Facts]:
    """An axis of time, hour by hour."""
    facts = {"standard_name": "time", "units": f"hours since {start}", "calendar": "standard"}
    return np.arange(count, dtype=np.float64), facts


def write_flood(
    path: Path,
    grid: Grid,
    facts: dict[str, str],
    time: tuple[Array, Facts],
    data: dict[str, tuple[NDArray[Any], tuple[str, ...], Facts]],
) -> None:
    """Write variables on the grid as CF asks for: values, dimensions and attributes of each."""
    import netCDF4
    import pyproj

    rows, columns = grid.shape
    west, _, _, north = grid.bounds
    axes = {
        "time": time,
        "y": (
            north - grid.cell * (np.arange(rows) + 0.5),
            {"standard_name": "projection_y_coordinate", "units": "m"},
        ),
        "x": (
            west + grid.cell * (np.arange(columns) + 0.5),
            {"standard_name": "projection_x_coordinate", "units": "m"},
        ),
    }
    with netCDF4.Dataset(path, "w") as file:
        file.setncatts({"Conventions": "CF-1.11", **facts})
        for name, (values, _) in axes.items():
            file.createDimension(name, len(values))
        for name, (values, about) in axes.items():
            axis = file.createVariable(name, "f8", (name,))
            axis.setncatts(about)
            axis[:] = values
        file.createVariable("crs", "i4").setncatts(pyproj.CRS(grid.crs).to_cf())
        for name, (values, dimensions, about) in data.items():
            variable = file.createVariable(name, "f4", dimensions, zlib=True)
            mapped = {"grid_mapping": "crs"} if "x" in dimensions else {}
            variable.setncatts({**about, "units": "m", **mapped})
            variable[:] = values


def write_ground(image: Image.Image, grid: Grid, note: str, path: Path) -> None:
    """Write the picture as JPEG, and beside it as a GeoTIFF that knows where it is."""
    import rasterio

    exif = Image.Exif()
    exif[0x010E] = note  # ImageDescription
    image.save(path, quality=QUALITY, optimize=True, comment=note, exif=exif)
    where = rasterio.Affine(grid.pixel, 0, grid.bounds[0], 0, -grid.pixel, grid.bounds[3])
    profile = {"driver": "GTiff", "width": image.width, "height": image.height, "count": 3, "dtype": "uint8"}
    profile |= {"crs": grid.crs, "transform": where}
    profile |= {"compress": "JPEG", "photometric": "YCBCR", "jpeg_quality": QUALITY}
    with rasterio.open(path.with_suffix(".tif"), "w", **profile) as file:
        file.update_tags(TIFFTAG_IMAGEDESCRIPTION=note)
        file.write(np.moveaxis(np.asarray(image), 2, 0))
