"""Datasets and arrays of xarray are read as the files that hold them."""

import numpy as np
import pytest
import xarray
from floods import CRS, series
from xarray.backends import BackendArray
from xarray.core import indexing

import vexture

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
