"""Numbers that stand for no value without being declared so."""

import numpy as np
import pytest
import rasterio
from small_grids import columns, geotiff, netcdf, read, said


@pytest.mark.parametrize(
    ("dtype", "fill", "about"),
    [
        ("f4", 9999.0, {}),
        ("f4", 999.0, {"units": "m"}),
        ("f4", 9999.0, {"units": "cm"}),
        ("f4", -99999.0, {"units": "mm"}),
        ("u2", 65535, {"scale_factor": 0.001}),
        ("i2", 32767, {"scale_factor": 0.01, "units": "m"}),
        ("i2", -32767, {"scale_factor": 0.01, "units": "m"}),
    ],
)
def test_undeclared_fill_values_are_unknown_and_named(tmp_path, dtype, fill, about):
    path = netcdf(tmp_path / "run.nc", {"depth": (columns(fill, 200), dict(about))}, dtype)
    extent = read(path)
    depth = extent.steps[0].depth
    assert np.isnan(depth[:, :100]).all()
    unit = {"cm": 0.01, "mm": 0.001}.get(about.get("units"), 1.0) * about.get("scale_factor", 1.0)
    np.testing.assert_allclose(depth[:, 140:], 200 * unit, rtol=1e-6)
    assert "taken as unknown; declare them, as _FillValue or nodata" in said(extent)


def test_a_deep_sea_keeps_its_depths_of_nines(tmp_path):
    path = netcdf(tmp_path / "sea.nc", {"depth": (columns(999, 800), {"units": "m"})}, "f4")
    assert np.nanmax(read(path).steps[0].depth) == 999.0


@pytest.mark.parametrize(("fill", "depth"), [(99.0, 3.0), (99.99, 9.5), (999.9, 0.5), (-1.0, 2.0), (-99.0, 2.0)])
@pytest.mark.parametrize("about", [{"units": "m"}, {"units": "ft"}])
def test_small_undeclared_fill_values_of_depths_are_unknown(tmp_path, fill, depth, about):
    path = netcdf(tmp_path / "run.nc", {"depth": (columns(fill, 0.0, depth), about)}, "f4")
    extent = read(path)
    assert np.isnan(extent.steps[0].depth[:, 10]).all()
    assert np.nanmax(extent.steps[0].depth) == pytest.approx(depth * (0.3048 if about["units"] == "ft" else 1.0))
    assert f"'depth' has values of {fill:g}, taken as unknown" in said(extent)


@pytest.mark.parametrize(
    ("numbers", "unit", "note"),
    [
        ((0.0, 12.0, 99.0), "m", "has values of 99, read as depths; if they stand for none, declare them"),
        ((0.0, 99.0), "m", "has values of 99, read as depths"),
        ((0.0, 5.0, 99.0), "cm", ""),
        ((0.0, 60.0, 99.0), "m", ""),
        ((0.0, 5.0, 98.0), "m", ""),
    ],
)
def test_depths_of_nines_that_may_be_water_stay(tmp_path, numbers, unit, note):
    path = netcdf(tmp_path / "run.nc", {"depth": (columns(*numbers), {"units": unit})}, "f4")
    extent = read(path)
    assert np.nanmax(extent.steps[0].depth) == pytest.approx(numbers[-1] * (0.01 if unit == "cm" else 1.0))
    assert note in said(extent)
    assert bool(note) == bool(extent.notes)


def test_a_pit_of_few_cells_stays(tmp_path):
    numbers = columns(0.0, 5.0).copy()
    numbers[..., 0, :3] = 99.0
    extent = read(netcdf(tmp_path / "run.nc", {"depth": (numbers, {"units": "m"})}, "f4"))
    assert np.nanmax(extent.steps[0].depth) == 99.0
    assert "read as depths" in said(extent)


def test_beds_and_levels_below_zero_stay(tmp_path):
    fields = {"bed_level": (columns(-1.0, -1.0, 1.0), {"units": "m"}), "water_level": (columns(0.0), {"units": "m"})}
    extent = read(netcdf(tmp_path / "run.nc", fields, "f4"))
    assert np.nanmax(extent.steps[0].depth) == pytest.approx(1.0, abs=0.1)
    assert extent.notes == ()


def test_undeclared_fill_values_of_rasters_are_unknown(tmp_path):
    path = geotiff(tmp_path / "depth.tif", columns(9999.0, 0.5).astype("f4"))
    assert np.nanmax(read(path).steps[0].depth) == 0.5
    path = geotiff(tmp_path / "whole.tif", columns(32767, 50).astype("i2"))
    with rasterio.open(path, "r+") as file:
        file.scales, file.units = (0.01,), ("m",)
    extent = read(path)
    assert np.nanmax(extent.steps[0].depth) == pytest.approx(0.5)
    assert "band 1 has values of 327.67, taken as unknown" in said(extent)
