"""Times of depths: dates of other calendars and in texts, and what is said of times that are no dates."""

from datetime import UTC, datetime

import numpy as np
import pytest
import rasterio
import xarray
from rasterio.transform import Affine

from vexture.base.errors import SourceError
from vexture_geo.depth.depths import read_depths

NOON = [datetime(2026, 2, day, 12, tzinfo=UTC) for day in (27, 28)]


def netcdf(path, times, **about):
    along = 1e5 + 50.0 * np.arange(3)
    data = {"depth": (("time", "y", "x"), np.ones((2, 3, 3)), {"units": "m"})}
    coordinates = {"x": ("x", along), "y": ("y", along), "time": ("time", times, about)}
    xarray.Dataset(data, coordinates, {"epsg": 28992}).to_netcdf(path)
    return path


def geotiff(path, descriptions):
    where = {"crs": "EPSG:28992", "transform": Affine(50.0, 0.0, 1e5, 0.0, -50.0, 5e5)}
    with rasterio.open(path, "w", "GTiff", 3, 3, len(descriptions), dtype="float32", **where) as file:
        file.write(np.full((len(descriptions), 3, 3), 2.0, np.float32))
        for band, text in enumerate(descriptions, 1):
            file.set_band_description(band, text)
    return path


def read(path, **options):
    """Times of all steps, and what is said of them."""
    extent = read_depths(path, path.name, **options)
    return [step.time for step in extent.steps], " ".join(map(str, extent.notes))


@pytest.mark.parametrize("calendar", ["standard", "noleap", "360_day"])
def test_dates_of_other_calendars_are_those_that_the_file_names(tmp_path, calendar):
    days = [27.5, 28.5] if calendar == "360_day" else [26.5, 27.5]
    start = "2026-01-30" if calendar == "360_day" else "2026-02-01"
    path = netcdf(tmp_path / "a.nc", days, units=f"days since {start}", calendar=calendar)
    assert read(path) == (NOON, "")


def test_dates_that_our_calendar_has_not_are_named(tmp_path):
    path = netcdf(tmp_path / "a.nc", [0.5, 1.5], units="days since 2026-02-29", calendar="360_day")
    times, said = read(path)
    assert times == [None, None]
    assert "its steps are numbered: 'time' has dates that are none of ours, by its calendar '360_day'; write" in said
    assert "write times of the calendar 'standard'" in said


def test_a_calendar_that_is_unknown_is_named(tmp_path):
    times, said = read(netcdf(tmp_path / "a.nc", [0.0, 6.0], units="hours since 2026-01-01", calendar="foo"))
    assert times == [None, None]
    assert "by its calendar 'foo'; write times of the calendar 'standard'" in said


def test_dates_of_the_julian_calendar_are_told(tmp_path):
    times, said = read(netcdf(tmp_path / "a.nc", [26.5, 27.5], units="days since 2026-02-01", calendar="julian"))
    assert times == NOON
    assert "'time' has dates of the calendar 'julian', 13 days before ours" in said


def test_a_step_without_a_time_is_named(tmp_path):
    path = netcdf(tmp_path / "a.nc", [0.0, np.nan], units="hours since 2026-01-01")
    with pytest.raises(SourceError, match=r"the time axis 'time' has no time at step 2 \(counted from 1\); write one"):
        read(path)


def test_times_since_no_date_are_named(tmp_path):
    times, said = read(netcdf(tmp_path / "a.nc", [0.0, 1.0], units="hours"))
    assert times == [None, None]
    assert "'time' is in 'hours', since no date; write 'hours since" in said
    assert read(netcdf(tmp_path / "b.nc", [0.0, 1.0])) == ([None, None], "")  # it says nothing, and so do we


def test_times_in_texts_are_read(tmp_path):
    assert read(netcdf(tmp_path / "a.nc", ["2026-02-27T12:00", "2026-02-28 12:00:00"])) == (NOON, "")
    times, said = read(netcdf(tmp_path / "b.nc", ["ebb", "flow"]))
    assert times == [None, None]
    assert "'time' holds texts that are no times ('ebb', 'flow')" in said


def test_descriptions_of_bands_are_times(tmp_path):
    path = geotiff(tmp_path / "a.tif", ["2026-02-27T12:00:00Z", "2026-02-28T13:00+01:00"])
    assert read(path, time_dim="band") == (NOON, "")
    times, said = read(geotiff(tmp_path / "b.tif", ["T10", "T100"]), time_dim="band")
    assert times == [None, None]
    assert "descriptions of its bands ('T10', 'T100') are no rising times" in said
