"""Numbers that are no depths: classes of depth, masks, states, colours, and numbers that stand for none."""

import numpy as np
import pytest
import rasterio
from rasterio.enums import ColorInterp
from small_grids import COLUMNS, ROWS, columns, geotiff, netcdf, read, said

from vexture.base.errors import SourceError


def width(drawing, frame):
    """Metres from west to east of an area of stripes that begins in the east."""
    x0, _, x1, _ = frame.box
    low = min(path.box[0, 0] for path in drawing.paths)
    return (x1 - low) / (x1 - x0) * frame.metres[0]


def test_states_of_wet_and_dry_are_areas_without_depth(tmp_path):
    flags = {"flag_values": np.arange(2, dtype="i1"), "flag_meanings": "dry wet"}
    extent = read(netcdf(tmp_path / "run.nc", {"state": (columns(0, 1), flags)}))
    (step,) = extent.steps
    assert (step.depth, step.classes) == (None, None)
    assert width(step.drawing, extent.frame) == pytest.approx(60.0, abs=0.1)


@pytest.mark.parametrize("numbers", [(0, 1), (0, 255), (255, 1), (0, 1.0)])
def test_masks_are_areas_without_depth(tmp_path, numbers):
    dtype = "f4" if isinstance(numbers[1], float) else "u1"
    paths = [
        geotiff(tmp_path / "mask.tif", columns(*numbers).astype(dtype)),
        netcdf(tmp_path / "mask.nc", {"extent": (columns(*numbers), {})}, dtype),
    ]
    for path in paths:
        extent = read(path)
        (step,) = extent.steps
        assert (step.depth, step.deeper, step.classes) == (None, (), None)
        assert width(step.drawing, extent.frame) == pytest.approx(60.0, abs=0.1)
        assert "is read as water of no known depth; if they are depths, write their unit into the file" in said(extent)


def test_numbers_of_masks_are_depths_where_the_file_says_a_unit(tmp_path):
    path = netcdf(tmp_path / "depth.nc", {"depth": (columns(0, 1), {"units": "m"})})
    assert np.nanmax(read(path).steps[0].depth) == 1.0
    path = geotiff(tmp_path / "depth.tif", columns(0, 1).astype("u1"))
    with rasterio.open(path, "r+") as file:
        file.units = ("m",)
    assert np.nanmax(read(path).steps[0].depth) == 1.0


def test_a_mask_is_known_by_all_its_times(tmp_path):
    numbers = np.concatenate([columns(0, 0), columns(0, 1), columns(0, 2)])
    path = netcdf(tmp_path / "run.nc", {"depth": (numbers, {})}, "f4")
    assert [float(np.nanmax(step.depth)) for step in read(path).steps] == [0.0, 1.0, 2.0]


@pytest.mark.parametrize("photometric", ["RGB", "palette"])
def test_pictures_are_refused(tmp_path, photometric):
    pixels = np.arange(ROWS * COLUMNS, dtype="u1").reshape(ROWS, COLUMNS)
    is_rgb = photometric == "RGB"
    path = geotiff(tmp_path / "photo.tif", np.stack([pixels] * 3) if is_rgb else pixels, photometric=photometric)
    if not is_rgb:
        with rasterio.open(path, "r+") as file:
            file.write_colormap(1, {k: (k, 0, 0, 255) for k in range(100)})
            file.colorinterp = [ColorInterp.palette]
    with pytest.raises(SourceError, match="its numbers are those of colours, and no depths"):
        read(path)


def test_whole_numbers_without_a_unit_are_named(tmp_path):
    path = geotiff(tmp_path / "classes.tif", columns(0, 1, 2, 3).astype("u1"))
    assert "whole numbers without a unit, taken as metres" in said(read(path))
