"""A round lake of known depths, and its shore as it is read."""

import numpy as np
import rasterio
from rasterio.transform import Affine

from vexture_geo.depth.depths import read_depths

CRS = "EPSG:32610"
X, Y = 500_000.0 + 10.0 * np.arange(80), 4_090_000.0 + 10.0 * np.arange(60)
MIDDLE, RADIUS = (500_400.0, 4_090_300.0), 200.0


def cone(x, y, middle=MIDDLE, slope=0.02):
    """Height of the bed of a round lake: 0 at its shore."""
    return slope * (np.hypot(x - middle[0], y - middle[1]) - RADIUS)


def read(path, **options):
    return read_depths(path, path.name, **options)


def shore(drawing):
    """Points along the outline, in the units of the source."""
    found = []
    t = np.linspace(0.0, 1.0, 16)[:, None]
    for path in drawing.paths:
        for p0, p1, p2, p3 in np.concatenate(path.contours):
            found.append((1 - t) ** 3 * p0 + 3 * (1 - t) ** 2 * t * p1 + 3 * (1 - t) * t * t * p2 + t**3 * p3)
    return np.concatenate(found) @ drawing.to_source[:, :2].T + drawing.to_source[:, 2]


def off_shore(drawing, middle=MIDDLE, level=0.0):
    """Largest distance of the outline from the lake's true shore, in cells of 10 m."""
    away = np.hypot(*(shore(drawing) - middle).T)
    return np.abs(away - RADIUS - (level - 0.05) / 0.02).max() / 10.0


def geotiff(path, depth, transform, crs=CRS, bands=1, tags=None, **profile):
    rows, columns = depth.shape
    profile = {"dtype": depth.dtype, "nodata": None, **profile}
    with rasterio.open(
        path, "w", driver="GTiff", width=columns, height=rows, count=bands, transform=transform, crs=crs, **profile
    ) as file:
        for band in range(1, bands + 1):
            file.write(depth, band)
        if tags:
            file.scales, file.offsets = tags
    return path


NORTH_UP = Affine(10.0, 0.0, X[0] - 5.0, 0.0, -10.0, Y[-1] + 5.0)


def lake_rows():
    """Depths of the lake, northernmost row first."""
    return np.maximum(-cone(*np.meshgrid(X, Y[::-1])), 0.0).astype(np.float32)
