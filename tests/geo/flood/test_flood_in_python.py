"""Floods from what a program holds open: datasets and arrays of xarray, read as files of the same content are."""

from pathlib import Path

import numpy as np
import pytest
import xarray
from floods import BOUNDS, CRS, scene_of, sea, series
from xarray.backends import BackendArray
from xarray.core import indexing

import vexture
from vexture.base.errors import ParameterError, SourceError
from vexture_geo.readers import extent_of

EDGES = (0.3, 0.5, 0.7)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return series(tmp_path_factory.mktemp("run") / "depth.nc", EDGES)


def same(one, other):
    assert one.frame == other.frame
    assert [step.time for step in one.steps] == [step.time for step in other.steps]
    for a, b in zip(one.steps, other.steps, strict=True):
        np.testing.assert_array_equal(a.depth, b.depth)
        assert a.drawing.segments == b.drawing.segments
        np.testing.assert_array_equal(a.drawing.paths[0].contours[0], b.drawing.paths[0].contours[0])


@pytest.mark.parametrize("as_numbers", [True, False])
def test_a_dataset_is_read_as_its_file(run, as_numbers):
    with xarray.open_dataset(run, decode_times=not as_numbers) as dataset:
        assert dataset["time"].dtype.kind == ("f" if as_numbers else "M")
        extent = vexture.read_extent(dataset)
        same(extent, vexture.read_extent(run))
        assert extent.steps[0].time is not None
        assert extent.steps[0].drawing.name == "the data"
        assert dataset["time"].dtype.kind == ("f" if as_numbers else "M")  # the user's own stays as it is


def test_an_array_is_read_too(run):
    with xarray.open_dataset(run) as dataset:
        (name,) = (key for key in dataset.data_vars if dataset[key].ndim == 3)
        array = dataset[name].rename("anything")
        whole = vexture.read_extent(dataset.drop_vars("bed_level"))
        same(vexture.read_extent(array, crs=CRS), whole)
        same(vexture.read_extent(array.rename(None), crs=CRS), whole)
        (step,) = vexture.read_extent(array.isel(time=1), crs=CRS).steps
        np.testing.assert_array_equal(step.depth, whole.steps[1].depth)


def test_times_of_other_calendars_are_kept(run):
    with xarray.open_dataset(run, decode_times=False) as numbers:
        numbers["time"].attrs["calendar"] = "365_day"
        decoded = xarray.decode_cf(numbers)
        assert decoded["time"].dtype.kind == "O"
        same(vexture.read_extent(decoded), vexture.read_extent(numbers))


class Watched(BackendArray):
    """Values that are computed when they are asked for, as those of dask are, and how many are at once."""

    def __init__(self, shape):
        self.shape, self.dtype, self.most, self.count = shape, np.dtype(np.float32), 0, 0

    def __getitem__(self, key):
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.OUTER, self.values)

    def values(self, key):
        steps, rows, columns = (np.arange(size)[place] for size, place in zip(self.shape, key, strict=True))
        depths = 2.0 - np.atleast_1d(columns) / 20.0
        found = np.broadcast_to(depths, (*np.shape(steps), np.size(rows), len(depths)))
        self.most, self.count = max(self.most, found.size), self.count + 1
        return np.float32(found)


def test_a_lazy_dataset_is_read_step_by_step():
    watched = Watched((4, 30, 50))
    lazy = xarray.Variable(("time", "y", "x"), indexing.LazilyIndexedArray(watched))
    places = {"y": 4e6 + 10.0 * np.arange(30), "x": 5e5 + 10.0 * np.arange(50), "time": np.arange(4.0)}
    extent = vexture.read_extent(xarray.Dataset({"depth": lazy}, places), crs=CRS)
    assert len(extent.steps) == 4
    assert watched.most == 30 * 50
    assert watched.count == 4


def test_errors_of_a_dataset_are_those_of_a_file_without_its_name(run):
    with xarray.open_dataset(run) as dataset:
        with pytest.raises(ParameterError, match=r"^there is no dimension 'hour'; it has"):
            vexture.read_extent(dataset, time_dim="hour")
        with pytest.raises(ParameterError, match=r"^`layer` 'sea' is for polygons"):
            vexture.read_extent(dataset, layer="sea")
        with pytest.raises(SourceError, match=r"^dimension 'x' has no coordinates"):
            vexture.read_extent(dataset.drop_vars(["x", "y"]))


@pytest.mark.usefixtures("page_is_built")
def test_the_page_of_a_dataset_is_that_of_its_file(run, tmp_path):
    with xarray.open_dataset(run) as dataset:
        told = dataset.assign_attrs(title="A surge", source="By hand")
        page = vexture.flood_page(told, amplitude=0, depths=[1.0, 2.0])
    of_file = vexture.flood_page(run, title="A surge", amplitude=0, depths=[1.0, 2.0], source="By hand")
    assert (page.title, page.height) == ("A surge", 600)
    assert page.described.startswith("3 steps, ")
    one, other = (scene_of(each.html.encode())["flood"] for each in (page, of_file))
    assert one["credits"]["source"] == "By hand"
    assert [each["from"] for each in one["depths"]] == [0.0, 1.0, 2.0]
    assert one["credits"] == other["credits"]
    assert [step["version"] for step in one["steps"]] == [step["version"] for step in other["steps"]]
    page.save(tmp_path / "surge.html")
    assert (tmp_path / "surge.html").read_text(encoding="utf-8") == page.html
    with pytest.raises(ParameterError, match="the page is an HTML file"):
        page.save(tmp_path / "surge.png")


@pytest.mark.usefixtures("page_is_built")
def test_options_that_do_not_fit_are_named(tmp_path):
    extent = extent_of(sea(tmp_path / "sea.geojson"), "sea.geojson")
    assert vexture.flood_page(extent, amplitude=0).title == "flood"
    with pytest.raises(ParameterError, match=r"`bounds` is .*, but the extent has been read; give it to"):
        vexture.flood_page(extent, bounds=BOUNDS)
    with pytest.raises(ParameterError, match="`hmin` -1"):
        vexture.flood_page(extent, hmin=-1.0)
    with pytest.raises(ParameterError, match="`height` is 0"):
        vexture.flood_page(extent, height=0)
    with pytest.raises(TypeError, match="colour"):
        vexture.flood_page(extent, colour="red")
    with pytest.raises(SourceError, match=r"missing\.nc: it cannot be opened"):
        vexture.flood_page(Path("missing.nc"))
