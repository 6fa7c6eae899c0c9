"""The option `crs` and what a file of depths says of its coordinates: what is unknown, and what contradicts it."""

import numpy as np
import pytest
import rasterio
import xarray
from rasterio.transform import Affine

from vexture.errors import ParameterError, SourceError
from vexture.geo.depths import read_depths

DEGREES = {"x": {"units": "degrees_east"}, "y": {"units": "degrees_north"}}
METRES = {"x": {"units": "m"}, "y": {"units": "m"}}


def pond(path, about, west, step, mapping=None):
    """Depths of 1 m on 4 x 4 cells from a place, with attributes of the coordinates and of the grid mapping."""
    along = west + step * np.arange(4)
    data = {"depth": (("y", "x"), np.ones((4, 4)), {"units": "m", "grid_mapping": "system"})}
    data["system"] = ((), 0, mapping or {})
    xarray.Dataset(data, {axis: (axis, along, about[axis]) for axis in "xy"}).to_netcdf(path)
    return path


@pytest.mark.parametrize("name", ["Unknown projected", "a proj=longlat", "lambert_conformal_conic"])
def test_a_given_system_replaces_a_grid_mapping_that_is_unknown(tmp_path, name):
    path = pond(tmp_path / "a.nc", METRES, 1e5, 50.0, {"grid_mapping_name": name, "epsg": 0})
    assert read_depths(path, "a.nc", crs="EPSG:28992").frame.crs == "EPSG:28992"
    with pytest.raises(SourceError, match=r"'grid_mapping_name=\w+' is unknown; name it as `crs` EPSG"):
        read_depths(path, "a.nc")


def test_a_system_in_metres_for_degrees_is_refused(tmp_path):
    path = pond(tmp_path / "a.nc", DEGREES, 4.0, 0.01)
    with pytest.raises(ParameterError, match=r"`crs` EPSG:28992 is not in degrees.* 3.995,.* are; .*`crs` EPSG:4326"):
        read_depths(path, "a.nc", crs="EPSG:28992")
    assert read_depths(path, "a.nc", crs="EPSG:4258").frame.crs == "EPSG:4258"


def test_a_system_in_degrees_for_metres_is_refused(tmp_path):
    path = pond(tmp_path / "a.nc", METRES, 4.0, 5.0)
    with pytest.raises(ParameterError, match=r"`crs` EPSG:4326 is in degrees.* are in 'm'; name the system"):
        read_depths(path, "a.nc", crs="EPSG:4326")


@pytest.mark.parametrize(("west", "step"), [(4.0, 0.01), (1e5, 50.0)])
def test_a_given_system_replaces_that_of_a_geotiff_where_it_cannot_be_right(tmp_path, west, step):
    where = {"crs": "EPSG:4326", "transform": Affine(step, 0.0, west, 0.0, -step, west / 2.0)}
    with rasterio.open(tmp_path / "a.tif", "w", "GTiff", 4, 4, 1, dtype="float32", **where) as file:
        file.write(np.ones((1, 4, 4), np.float32))
    if west == 4.0:
        with pytest.raises(ParameterError, match="`crs` EPSG:28992 is not in degrees"):
            read_depths(tmp_path / "a.tif", "a.tif", crs="EPSG:28992")
    else:
        assert read_depths(tmp_path / "a.tif", "a.tif", crs="EPSG:28992").frame.crs == "EPSG:28992"
