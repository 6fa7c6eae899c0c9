"""Which variables of a NetCDF file hold depths, and where their samples are."""

import numpy as np
import pytest
import xarray

from vexture.base.errors import ParameterError
from vexture_geo.depth.depths import read_depths


def test_longitudes_that_cross_the_antimeridian_are_joined(tmp_path):
    east = np.append(np.arange(178.5, 180.0, 0.1), np.arange(-179.9, -178.0, 0.1))
    depth = np.where(np.arange(len(east)) < 20, 2.0, 0.0) * np.ones((9, 1))
    along = {
        "lon": ("lon", east, {"units": "degrees_east"}),
        "lat": ("lat", np.linspace(-17, -16, 9), {"units": "degrees_north"}),
    }
    xarray.Dataset({"depth": (("lat", "lon"), depth)}, along).to_netcdf(tmp_path / "fiji.nc")
    west, south, end, north = read_depths(tmp_path / "fiji.nc", "fiji.nc").frame.bounds
    assert (west, end) == pytest.approx((178.45, 182.05), abs=0.1)
    assert (south, north) == pytest.approx((-17.05, -15.95), abs=0.1)


@pytest.mark.parametrize("units", ["m", "n/a", "m (MSL/NAP)", "m+NAP", "1", "-", "", "5e-1 m", "unknown"])
def test_what_may_be_a_length_is_a_depth(tmp_path, units):
    one = xarray.DataArray(np.ones((3, 3)), {"x": [0.0, 10.0, 20.0], "y": [0.0, 10.0, 20.0]}, ("y", "x"), "one")
    one.assign_attrs(units=units).to_dataset().assign_attrs(epsg=28992).to_netcdf(tmp_path / "a.nc")
    assert read_depths(tmp_path / "a.nc", "a.nc").steps[0].drawing.paths


@pytest.mark.parametrize("units", ["m/s", "m s-1", "knots", "m3 s-1", "ft per second", "mm/day", "degC", "kPa"])
def test_what_is_no_length_is_no_depth(tmp_path, units):
    along = {"x": [0.0, 10.0, 20.0], "y": [0.0, 10.0, 20.0]}
    data = {
        "one": (("y", "x"), np.ones((3, 3)), {"units": units}),
        "two": (("y", "x"), np.ones((3, 3)), {"units": "m"}),
    }
    xarray.Dataset(data, along, {"epsg": 28992}).to_netcdf(tmp_path / "a.nc")
    assert read_depths(tmp_path / "a.nc", "a.nc").steps[0].drawing.paths  # of 'two', the only length
    with pytest.raises(ParameterError, match=f"'one' is in '{units}', no unit of length"):
        read_depths(tmp_path / "a.nc", "a.nc", variable="one")
