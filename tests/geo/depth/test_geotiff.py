"""Depths in GeoTIFFs: their place, packing and bands."""

import numpy as np
import pytest
from lakes import CRS, NORTH_UP, X, Y, cone, geotiff, lake_rows, off_shore, read
from rasterio.transform import Affine

from vexture.base.errors import SourceError, SourceWarning
from vexture_geo.readers import read_extent


def test_geotiff_with_nodata_scale_and_offset(tmp_path):
    depth = lake_rows()
    packed = np.where(depth > 0.0, np.rint((depth + 1.0) / 0.001), -32768).astype(np.int16)
    path = geotiff(tmp_path / "a.tif", packed, NORTH_UP, nodata=-32768, tags=((0.001,), (-1.0,)))
    extent = read(path)
    assert off_shore(extent.steps[0].drawing) < 0.3
    assert np.nanmax(extent.steps[0].depth) == pytest.approx(4.0, abs=0.2)


def test_a_turned_geotiff(tmp_path):
    turn = Affine.translation(X[0], Y[0]) @ Affine.rotation(30.0) @ Affine.scale(10.0, 10.0)
    columns, rows = np.meshgrid(np.arange(80) + 0.5, np.arange(80) + 0.5)
    x, y = turn.a * columns + turn.b * rows + turn.c, turn.d * columns + turn.e * rows + turn.f
    middle = turn @ (40.0, 40.0)
    depth = np.maximum(-cone(x, y, middle), 0.0).astype(np.float32)
    extent = read(geotiff(tmp_path / "a.tif", depth, turn))
    assert off_shore(extent.steps[0].drawing, middle) < 0.3


def test_bands_are_steps_only_if_time_is_asked_for(tmp_path):
    path = geotiff(tmp_path / "a.tif", lake_rows(), NORTH_UP, bands=3)
    with pytest.warns(SourceWarning, match="3 bands, of which the first is read"):
        first = read_extent(path)
    assert len(first.steps) == 1
    assert first.notes == first.steps[0].drawing.notes
    assert [(note.kind, note.count) for note in first.notes] == [("remark", 1)]
    every = read(path, time_dim="band")
    assert (len(every.steps), every.notes) == (3, ())


@pytest.mark.parametrize(
    ("profile", "message"), [({"crs": None}, "`crs` EPSG"), ({"transform": Affine.identity()}, "no geotransform")]
)
@pytest.mark.filterwarnings("ignore::rasterio.errors.NotGeoreferencedWarning")
def test_geotiff_that_does_not_say_where_it_is(tmp_path, profile, message):
    path = geotiff(tmp_path / "a.tif", lake_rows(), **{"transform": NORTH_UP, **profile})
    with pytest.raises(SourceError, match=message):
        read(path)
    if "crs" in profile:
        assert read(path, crs=CRS).frame.crs == CRS


def test_geotiff_of_nothing(tmp_path):
    path = geotiff(tmp_path / "a.tif", np.full((20, 20), np.nan, np.float32), NORTH_UP)
    with pytest.raises(SourceError, match="variable 'band 1' holds no number within the bounds; write depths"):
        read(path)
