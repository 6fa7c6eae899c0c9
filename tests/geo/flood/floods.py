"""Small floods, and `vexture flood` run on them."""

import json
import re
import subprocess
import time
from pathlib import Path

import netCDF4
import numpy as np
import xarray
from server import COMMAND, SECONDS, TOKEN, Server, serving

from typed_commands import run_command
from vexture.drawing.drawing import Drawing
from vexture_geo.base.extent import Frame
from vexture_geo.flood.relief import relief_of
from vexture_geo.flood.surface import surface_of

BOUNDS = (500000.0, 4000000.0, 504000.0, 4002000.0)
CRS = "EPSG:32610"
FRAME = Frame(BOUNDS, CRS, (4000.0, 2000.0))
HMIN = 0.05
TOO_MANY = 429, 503  # uploads in so short a time, connections


def sea(path, east=0.5, crs=CRS, bounds=BOUNDS):
    """GeoJSON of water in the west of a box, up to a share of its width."""
    west, south, right, north = bounds
    edge = west + east * (right - west)
    ring = [[west, south], [edge, south], [edge, north], [west, north], [west, south]]
    shape = {"type": "Polygon", "coordinates": [ring]}
    if crs:
        shape["crs"] = {"type": "name", "properties": {"name": crs}}
    path.write_text(json.dumps(shape))
    return path


def depths(east=0.5, rows=20, columns=40, deep=2.0):
    """Depths that fall to nothing at a share of the width."""
    middles = (np.arange(columns) + 0.5) / columns
    line = np.maximum(deep * (1.0 - middles / east), 0.0)
    return np.tile(line.astype(np.float32), (rows, 1))


def geotiff(path, values, crs=CRS, bounds=BOUNDS, **profile):
    import rasterio

    from vexture_geo.flood.grids import pixels_to

    values = np.asarray(values)
    bands = values if values.ndim == 3 else values[None]
    count, rows, columns = bands.shape
    place = {"transform": pixels_to(bounds, (columns, rows))} if bounds else {}
    with rasterio.open(
        path,
        "w",
        driver="GTiff",
        width=columns,
        height=rows,
        count=count,
        dtype=bands.dtype,
        crs=crs,
        **place,
        **profile,
    ) as raster:
        raster.write(bands)
    return path


def wkt():
    import pyproj

    return pyproj.CRS.from_user_input(CRS).to_wkt()


def series(path, edges, times=True, reverse=False):
    """NetCDF of depths, a step for each edge."""
    west, south, east, north = BOUNDS
    columns, rows = 40, 20
    with netCDF4.Dataset(path, "w") as file:
        for name, count in (("time", len(edges)), ("y", rows), ("x", columns)):
            file.createDimension(name, count)
        x, y = file.createVariable("x", "f8", ("x",)), file.createVariable("y", "f8", ("y",))
        x[:] = west + (np.arange(columns) + 0.5) * (east - west) / columns
        y[:] = south + (np.arange(rows) + 0.5) * (north - south) / rows
        if times:
            when = file.createVariable("time", "f8", ("time",))
            when.units = "hours since 2026-02-14 06:00:00"
            when[:] = np.arange(len(edges))[:: -1 if reverse else 1]
        system = file.createVariable("crs", "i4")
        system.crs_wkt = wkt()
        depth = file.createVariable("depth", "f4", ("time", "y", "x"))
        depth.setncatts({"units": "m", "standard_name": "sea_floor_depth_below_sea_surface", "grid_mapping": "crs"})
        depth[:] = [depths(edge) for edge in edges]
        bed = file.createVariable("bed_level", "f4", ("y", "x"))
        bed.setncatts({"units": "m", "grid_mapping": "crs", "standard_name": "altitude"})
        bed[:] = np.tile(np.linspace(-2.0, 2.0, columns), (rows, 1))
    return path


def flood(*arguments):
    return run_command("flood", *arguments)


def scene_of(page):
    text = page.decode() if isinstance(page, bytes) else Path(page).read_text(encoding="utf-8")
    return json.loads(re.search(r'<script type="application/json" id="vexture-scene">(.*?)</script>', text, re.S)[1])


class FloodServer(Server):
    """A running `vexture flood --serve`."""

    def __init__(self, folder, *options, token=True, program=COMMAND):
        secret = folder / "token"
        secret.write_text(f"{TOKEN}\n")
        given = ["--token-file", str(secret)] if token else []
        arguments = [*program, "flood", *map(str, options), "--serve", "--port", "0", *given]
        self.process = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.said = self.process.stdout.readline()
        if not self.said:
            raise RuntimeError(self.process.communicate()[1])
        self.url = re.search(r"http://\S+/", self.said)[0]
        self.port = int(self.url.rpartition(":")[2].strip("/"))

    def put(self, name, body, token=TOKEN):
        """Status and JSON of an upload, as soon as the server takes one: many tests share it."""
        for _ in range(10 * SECONDS):
            status, told = super().put(name, body, token)
            if status not in TOO_MANY:
                break
            time.sleep(0.1)
        return status, told


def flooding(folder, *options, token=True):
    """Context of a running server."""
    return serving(folder, *options, token=token, kind=FloodServer)


def west(share):
    """Water up to a share of the frame's width."""
    x0, _, x1, _ = FRAME.box
    edge = x0 + share * (x1 - x0)
    return Drawing.polygon([(0, 0), (edge, 0), (edge, 1), (0, 1)])


def surfaces(extent):
    relief = relief_of(extent)
    return relief, [surface_of(step, extent.frame, relief, extent.bed, HMIN) for step in extent.steps]


def write_speeds(path, edges, **speeds):
    """Write a series of depths with variables of speeds: dimensions, values that are spread over them, attributes."""
    with xarray.open_dataset(series(path, edges), decode_cf=False) as dataset:
        data = dataset.load()
    for name, (dims, values, attributes) in speeds.items():
        shape = [data.sizes.get(dim, 2) for dim in dims]
        data[name] = (dims, np.broadcast_to(np.asarray(values, np.float32), shape).copy(), attributes)
    data.to_netcdf(path)
    return path
