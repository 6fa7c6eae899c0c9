"""Files of depths, written here, read as extents."""

import subprocess
import sys
from datetime import UTC, datetime

import numpy as np
import pytest
import xarray
from lakes import CRS, MIDDLE, NORTH_UP, RADIUS, X, Y, cone, geotiff, lake_rows, off_shore, read, shore
from rasterio.transform import Affine

from vexture.base.errors import LimitError, ParameterError, SourceError, SourceWarning
from vexture.base.notes import line_of
from vexture.conversion.reading import read as read_any
from vexture.renderers.exact import render_exact
from vexture_geo.base.crs import frame_around
from vexture_geo.depth.depths import read_depths


def lake(levels=(0.0,), x=X, y=Y, bed=False, dry=0.0, **coordinates):
    """Depths in the lake at some levels, by time, y and x."""
    ground = cone(*np.meshgrid(x, y))
    depth = np.array(levels)[:, None, None] - ground
    data = {"depth": (("time", "y", "x"), np.where(depth > 0.0, depth, dry).astype(np.float32), {"units": "m"})}
    if bed:
        data["bed_level"] = (("y", "x"), ground)
    time = ("time", 3600.0 * np.arange(len(levels)), {"units": "seconds since 2026-01-02"})
    return xarray.Dataset(data, {"time": time, "x": x, "y": y, **coordinates}, {"epsg_code": CRS})


def written(dataset, path, **options):
    dataset.to_netcdf(path / "lake.nc", **options)
    return read(path / "lake.nc")


@pytest.mark.parametrize("bed", [False, True])
@pytest.mark.parametrize("dry", [0.0, np.nan])
def test_a_series_of_netcdf(tmp_path, bed, dry):
    extent = written(lake((-1.0, 0.0, 0.5), bed=bed, dry=dry), tmp_path)
    assert [step.time for step in extent.steps] == [datetime(2026, 1, 2, hour, tzinfo=UTC) for hour in range(3)]
    assert extent.frame.crs == CRS
    assert extent.frame.metres == (800.0, 600.0)
    for step, level in zip(extent.steps, (-1.0, 0.0, 0.5), strict=True):
        assert off_shore(step.drawing, level=level) < (0.2 if bed else 0.3)
        assert step.drawing.crs == CRS
        assert step.depth.shape == (192, 256)
        assert np.nanmax(step.depth) == pytest.approx(level + 4.0, abs=0.2)
    assert (extent.bed is not None) == bed


def test_depth_and_bed_grids_have_the_northernmost_row_first(tmp_path):
    dataset = lake(bed=True)
    dataset["bed_level"] = dataset["bed_level"] * 0 + dataset["y"] - Y[0]
    extent = written(dataset, tmp_path)
    assert extent.bed[0].min() > 580.0
    assert extent.bed[-1].max() < 10.0


@pytest.mark.parametrize("flip", [{"x": slice(None, None, -1)}, {"y": slice(None, None, -1)}])
def test_axes_may_fall(tmp_path, flip):
    assert off_shore(written(lake().isel(flip), tmp_path).steps[0].drawing) < 0.3


def test_axes_may_be_uneven(tmp_path):
    x = X[0] + 790.0 * np.linspace(0.0, 1.0, 100) ** 1.3
    assert off_shore(written(lake(x=x), tmp_path).steps[0].drawing) < 0.4


def test_packed_integers_with_a_fill_value(tmp_path):
    encoding = {"depth": {"dtype": "int16", "scale_factor": 0.001, "_FillValue": -32768}}
    extent = written(lake(dry=np.nan), tmp_path, encoding=encoding)
    assert off_shore(extent.steps[0].drawing) < 0.3


@pytest.mark.parametrize("format_", ["NETCDF4", "NETCDF3_CLASSIC", "NETCDF3_64BIT"])
def test_content_instead_of_a_path(tmp_path, format_):
    lake().to_netcdf(tmp_path / "lake.nc", format=format_)
    extent = read_depths((tmp_path / "lake.nc").read_bytes(), "lake.nc")
    assert off_shore(extent.steps[0].drawing) < 0.3
    tiff = geotiff(tmp_path / "a.tif", lake_rows(), NORTH_UP)
    assert off_shore(read_depths(tiff.read_bytes(), "a.tif").steps[0].drawing) < 0.3


def test_no_time_is_one_step(tmp_path):
    extent = written(lake().isel(time=0, drop=True), tmp_path)
    assert len(extent.steps) == 1
    assert extent.steps[0].time is None


@pytest.mark.parametrize("east", [0.0, 360.0])
def test_longitudes_and_latitudes_by_their_names(tmp_path, east):
    lon, lat = -122.0 + 0.0001 * np.arange(80), 36.9 + 0.0001 * np.arange(60)
    depth = np.where(np.hypot(*np.meshgrid((lon - lon[40]) / 20e-4, (lat - lat[30]) / 20e-4)) < 1.0, 2.0, 0.0)
    dataset = xarray.Dataset(
        {"wd": (("lat", "lon"), depth)},
        {
            "lon": ("lon", lon + east, {"standard_name": "longitude"}),
            "lat": ("lat", lat, {"standard_name": "latitude"}),
        },
    )
    dataset.to_netcdf(tmp_path / "a.nc")
    for extent in (
        read(tmp_path / "a.nc"),
        read(tmp_path / "a.nc", bounds=(-122.0, 36.9, -121.992, 36.906)),
    ):
        assert extent.frame.crs in ("EPSG:4326", "OGC:CRS84")
        assert extent.frame.bounds[0] == pytest.approx(-122.0, abs=1e-3)
        assert shore(extent.steps[0].drawing).mean(axis=0) == pytest.approx((lon[40], lat[30]), abs=4e-4)


def test_a_grid_mapping_by_conventions(tmp_path):
    import pyproj

    dataset = lake()
    del dataset.attrs["epsg_code"]
    dataset["mapping"] = ((), 0, {k: v for k, v in pyproj.CRS(CRS).to_cf().items() if k != "crs_wkt"})
    dataset["depth"].attrs["grid_mapping"] = "mapping"
    extent = written(dataset, tmp_path)
    assert extent.frame.metres == pytest.approx((800.0, 600.0))


def test_another_system_than_the_frames(tmp_path):
    lake().to_netcdf(tmp_path / "a.nc")
    plain = read(tmp_path / "a.nc")
    frame = frame_around((-122.9999, 36.9557, -122.9911, 36.9611), "EPSG:4326")
    turned = read(tmp_path / "a.nc", frame=frame)
    from vexture_geo.base.crs import transform_points

    back = transform_points(shore(turned.steps[0].drawing), "EPSG:4326", CRS)
    away = np.abs(np.hypot(*(back - MIDDLE).T) - RADIUS + 2.5) / 10.0
    assert turned.frame == frame
    assert away.max() < 0.3
    assert len(plain.steps) == len(turned.steps)


def flood(path, frame=None, **options):
    """Picture of a raster that is all wet, 40 x 40 cells of 10 m."""
    tiff = geotiff(path / "a.tif", np.full((40, 40), 2.0, np.float32), Affine(10.0, 0.0, 0.0, 0.0, -10.0, 400.0))
    extent = read(tiff, frame=frame, **options)
    return render_exact(extent.steps[0].drawing, (32, 32)), extent


def test_water_goes_on_beyond_a_frame_that_ends_with_the_raster(tmp_path):
    for options in ({}, {"bounds": (0.0, 0.0, 400.0, 400.0)}, {"bounds": (0.0, 100.0, 400.0, 200.0)}):
        picture, _ = flood(tmp_path, **options)
        assert picture.min() > 1.0 - 1e-6


def test_water_ends_where_the_raster_ends_inside_of_the_frame(tmp_path):
    picture, extent = flood(tmp_path, frame_around((-400.0, 0.0, 400.0, 400.0), CRS))
    assert picture[:, :16].max() < 1e-6
    assert picture[10:20, 16:].min() > 1.0 - 1e-6
    assert np.isnan(extent.steps[0].depth[:, :120]).all()
    assert (extent.steps[0].depth[:, 130:] == 2.0).all()


def test_only_what_the_bounds_need_is_read(tmp_path, monkeypatch):
    from vexture_geo.depth import raster

    monkeypatch.setattr(raster, "MOST_CELLS", 3000)
    path = geotiff(tmp_path / "a.tif", lake_rows(), NORTH_UP)
    whole = read(path)
    assert "one in 2 x 2 was read" in line_of("a.tif", whole.notes)
    assert off_shore(whole.steps[0].drawing) < 1.0
    west, south = MIDDLE[0] - 230.0, MIDDLE[1] - 50.0
    part = read(path, bounds=(west, south, west + 100.0, south + 100.0))
    assert off_shore_inside(part) < 0.3


def off_shore_inside(extent):
    points = shore(extent.steps[0].drawing)
    west, south, east, north = extent.frame.bounds
    inside = (points > (west, south)).all(axis=1) & (points < (east, north)).all(axis=1)
    away = np.hypot(*(points[inside] - MIDDLE).T)
    return np.abs(away - RADIUS + 2.5).max() / 10.0


def test_all_dry_is_an_empty_drawing(tmp_path):
    extent = written(lake((-10.0, 0.0)), tmp_path)
    assert extent.steps[0].drawing.paths == ()
    assert extent.steps[1].drawing.segments > 0


def test_a_step_without_numbers_is_dry_as_models_write_it(tmp_path):
    dataset = lake((0.0, 0.0))
    first = dataset["time"] == dataset["time"][0]
    extent = written(dataset.assign(depth=dataset["depth"].where(~first)), tmp_path)
    assert extent.steps[0].drawing.paths == ()
    assert off_shore(extent.steps[1].drawing) < 0.5


def test_water_levels_less_the_bed(tmp_path):
    dataset = lake(bed=True)
    dataset["zs"] = dataset["depth"] + dataset["bed_level"]
    extent = written(dataset.drop_vars("depth"), tmp_path)
    assert off_shore(extent.steps[0].drawing) < 0.2


def test_fill_values_that_the_file_does_not_name_are_no_depths(tmp_path):
    for fill in (-9999.0, 9.96921e36):
        assert off_shore(written(lake(dry=fill), tmp_path).steps[0].drawing) < 0.3


def with_layers(dataset):
    return dataset.expand_dims({"layer": [1.0, 2.0]})


def without_system(dataset):
    return dataset.assign_attrs(epsg_code="")


def shuffled(dataset):
    return dataset.isel(time=[0, 2, 1])


def repeated(dataset):
    return dataset.isel(time=[0, 1, 1])


def nothing(dataset):
    return dataset.assign(depth=dataset["depth"].where(dataset["time"] < 0.0))


def curvilinear(dataset):
    return dataset.drop_vars(["x", "y"]).rename({"x": "i", "y": "j"})


@pytest.mark.parametrize(
    ("change", "options", "error", "message"),
    [
        (without_system, {}, SourceError, r"`crs` EPSG"),
        (with_layers, {}, SourceError, r"variable 'depth' also has the dimension 'layer' \(2 long\)"),
        (shuffled, {}, SourceError, r"step 3 is before step 2 .* sortby\('time'\)"),
        (repeated, {}, SourceError, r"step 3 is the same time as step 2 .* drop_duplicates"),
        (nothing, {}, SourceError, r"variable 'depth' holds no number within the bounds at any of 3 steps"),
        (curvilinear, {}, SourceError, r"no variable is on rows and columns; it has 'depth'"),
        (lambda dataset: dataset, {"time_dim": "hour"}, ParameterError, r"no dimension 'hour'; it has .*'time'"),
        (lambda dataset: dataset, {"variable": "salt"}, ParameterError, r"'salt'; `variable` may be 'depth'"),
        (
            lambda d: d.assign(wd=d["depth"]),
            {},
            LimitError,
            r"depths may be in 'depth', 'wd'; choose one by `variable`",
        ),
        (lambda dataset: dataset, {"bounds": (0.0, 0.0, 9.0, 9.0)}, SourceError, r"within the bounds 0,0,9,9 .*covers"),
        (lambda dataset: dataset, {"hmin": 0.0}, ParameterError, r"`hmin` is 0 m; it must be above 0"),
    ],
)
def test_bad_files_are_refused_in_one_line(tmp_path, change, options, error, message):
    change(lake((0.0, 0.1, 0.2))).to_netcdf(tmp_path / "lake.nc")
    with pytest.raises(error, match=message) as caught:
        read(tmp_path / "lake.nc", **options)
    assert "\n" not in str(caught.value)


@pytest.mark.slow
def test_damaged_files_are_one_line_and_nothing_on_stderr(tmp_path):
    lake().to_netcdf(tmp_path / "a.nc")
    geotiff(tmp_path / "a.tif", lake_rows(), NORTH_UP, compress="deflate")
    names = []
    for name in ("a.nc", "a.tif"):
        data = (tmp_path / name).read_bytes()
        for share in (0.01, 0.3, 0.6, 0.95):
            names.append(f"{share}-{name}")
            (tmp_path / names[-1]).write_bytes(data[: int(share * len(data))])
        noise = bytearray(data)
        noise[len(data) // 3 : len(data) // 3 + 400] = b"\xff" * 400
        names.append(f"noise-{name}")
        (tmp_path / names[-1]).write_bytes(noise)
    (tmp_path / "text.nc").write_text("not a file of depths")
    script = (
        "import sys\nfrom vexture.base.errors import VextureError\nfrom vexture_geo.depth.depths import read_depths\n"
        "for path in sys.argv[1:]:\n"
        "    for source in (path, open(path, 'rb').read()):\n"
        "        try:\n            read_depths(source, 'a')\n            print('read')\n"
        "        except VextureError as error:\n            print(error)\n"
    )
    paths = [str(tmp_path / name) for name in [*names, "text.nc"]]
    done = subprocess.run([sys.executable, "-c", script, *paths], capture_output=True, text=True, check=False)
    assert done.stderr == ""
    assert done.returncode == 0
    lines = done.stdout.splitlines()
    assert len(lines) == 2 * len(paths)
    assert not any(str(tmp_path) in line or "vexture-" in line for line in lines[1::2])
    assert sum(line == "read" for line in lines) <= 8


def test_a_series_is_converted_at_its_first_time_and_says_so(tmp_path):
    lake((-1.0, 0.0, 0.5)).to_netcdf(tmp_path / "a.nc")
    with pytest.warns(SourceWarning, match="3 times, of which the first is read"):
        drawing = read_any(tmp_path / "a.nc")
    assert drawing.paths
