"""Rasters that are larger than what is kept of them in memory, and files larger than what a server accepts."""

import subprocess
import sys

import numpy as np
import pytest
import rasterio
from floods import BOUNDS, series
from rasterio.windows import Window

from vexture.base.content import LARGEST_FILE
from vexture_geo.depth.contours import shore_values
from vexture_geo.depth.depths import read_depths

SIDE, CELL, WET = 20_000, 2.0, 4_000
AT_MOST = 500.0
"""Megabytes above those of the packages: a third of the raster."""

MEASURED = """
import resource, sys
import contourpy, pyproj, rasterio, shapely
from vexture_geo.depth.depths import read_depths
peak = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
before = peak()
extent = read_depths(sys.argv[1], sys.argv[1])
x0, y0, x1, y1 = extent.steps[0].drawing.paths[0].box.ravel()
print(x1 - x0, y1 - y0, peak() - before, extent.notes[0])
"""


@pytest.mark.slow
@pytest.mark.long
def test_a_raster_of_1600_megabytes_needs_a_part_of_them(tmp_path):
    path = tmp_path / "large.tif"
    with rasterio.open(
        path, "w", driver="GTiff", width=SIDE, height=SIDE, count=1, dtype="float32", crs="EPSG:32610", tiled=True,
        blockxsize=512, blockysize=512, compress="deflate", sparse_ok=True,
        transform=rasterio.Affine(CELL, 0.0, 500_000.0, 0.0, -CELL, 4_040_000.0),
    ) as file:  # fmt: skip
        file.write(np.ones((WET, WET), np.float32), 1, window=Window(8000, 8000, WET, WET))
    found = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", MEASURED, path], capture_output=True, text=True, check=True
    )
    width, height, peak, note = found.stdout.split(maxsplit=3)
    share = WET / SIDE * 15 / 16  # of the unit square, in which the frame has margins
    assert float(width) == pytest.approx(share, rel=0.01)
    assert float(height) == pytest.approx(share, rel=0.01)
    assert note.startswith("20,000 x 20,000 cells are too many: one in 10 x 10 was read")
    assert float(peak) < AT_MOST


def test_a_file_on_the_disk_may_be_larger_than_an_upload(tmp_path):
    path = series(tmp_path / "run.nc", (0.3, 0.6))
    with path.open("r+b") as file:
        file.truncate(LARGEST_FILE + 2**20)
    extent = read_depths(path, path.name)
    assert len(extent.steps) == 2
    assert extent.frame.bounds == pytest.approx(BOUNDS)


@pytest.mark.parametrize("bed", [True, False])
def test_the_shore_does_not_depend_on_the_strips_in_which_it_is_computed(bed):
    random = np.random.default_rng(7)
    depth = np.maximum(random.normal(size=(700, 30)), 0.0)
    ground = random.normal(size=depth.shape) if bed else None
    whole = shore_values(depth, 0.05, ground)
    below = shore_values(depth[100:], 0.05, ground[100:] if bed else None)
    np.testing.assert_array_equal(whole[103:], below[3:])
