"""Floods from what a program holds open: datasets and arrays of xarray, read as files of the same content are."""

from pathlib import Path

import pytest
import xarray
from floods import BOUNDS, scene_of, sea, series

import vexture
from vexture.base.errors import ParameterError, SourceError
from vexture_geo.readers import extent_of

EDGES = (0.3, 0.5, 0.7)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return series(tmp_path_factory.mktemp("run") / "depth.nc", EDGES)


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
