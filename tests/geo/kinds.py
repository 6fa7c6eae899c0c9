"""A file of every kind that a drawing is read from, for tests of all the ways in."""

import gzip
import json
from pathlib import Path

import numpy as np
import rasterio
import xarray
from geographic import UTM, file
from PIL import Image
from rasterio.transform import Affine

SVG = (
    b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="M1 1h5v7z" fill="red"/><foreignObject/></svg>'
)
RING = [[4, 52], [6, 52], [6, 53], [4, 53]]
GEOMETRIES = [{"type": "Polygon", "coordinates": [RING]}, {"type": "Point", "coordinates": [4, 52]}]
PICTURES = {"png": "PNG", "jpg": "JPEG", "webp": "WEBP", "gif": "GIF", "bmp": "BMP"}


def one_of_each(folder: Path) -> list[Path]:
    """Write them, each of another name."""
    (folder / "plain.svg").write_bytes(SVG)
    (folder / "packed.svgz").write_bytes(gzip.compress(SVG, mtime=0))
    collection = {"type": "GeometryCollection", "geometries": GEOMETRIES}
    (folder / "rings.geojson").write_text(json.dumps(collection))
    for suffix, format_name in PICTURES.items():
        picture = Image.new("RGB", (64, 48), "white")
        picture.paste((200, 0, 0), (16, 16, 48, 32))
        picture.save(folder / f"box-{suffix}.{suffix}", format_name)
    depth = np.zeros((20, 30), np.float32)
    depth[5:15, 8:20] = 1.5
    place = {"crs": UTM, "transform": Affine(10.0, 0.0, 500_000.0, 0.0, -10.0, 4_090_000.0)}
    with rasterio.open(
        folder / "raster.tif", "w", driver="GTiff", width=30, height=20, count=2, dtype="float32", **place
    ) as raster:
        raster.write(depth, 1)
        raster.write(depth, 2)
    series = {"depth": (("time", "y", "x"), np.stack([depth, depth]), {"units": "m"})}
    axes = {"time": ("time", [0.0, 3600.0], {"units": "seconds since 2026-01-02"})}
    axes |= {"x": 500_000.0 + 10.0 * np.arange(30), "y": 4_090_000.0 + 10.0 * np.arange(20)}
    xarray.Dataset(series, axes, {"epsg_code": UTM}).to_netcdf(folder / "series.nc")
    beside = folder / "unzipped"
    beside.mkdir()
    file(beside, "zipped.zip").rename(folder / "zipped.zip")
    for part in beside.iterdir():
        part.rename(folder / f"siblings{part.suffix}")
    beside.rmdir()
    for name in ("lake.gpkg", "lakes.fgb"):
        file(folder, name)
    return sorted(path for path in folder.iterdir() if path.suffix not in (".shx", ".dbf", ".prj", ".cpg"))
