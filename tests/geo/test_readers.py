"""Readers of geographic data: which reader a file gets, and parameters that are for the other kind of data."""

import pytest
from floods import BOUNDS, geotiff, sea, series

from vexture.base.errors import ParameterError, SourceError
from vexture_geo.readers import extent_of, read_extent, read_first_step


@pytest.mark.parametrize("options", [{"time_dim": "time"}, {"variable": "depth"}])
def test_parameters_of_depths_are_refused_for_polygons(tmp_path, options):
    with pytest.raises(ParameterError, match="is for depths, and this file holds polygons; leave it out"):
        extent_of(sea(tmp_path / "sea.geojson"), "sea.geojson", **options)


@pytest.mark.parametrize("options", [{"layer": "sea"}, {"snap": 0.001}])
def test_parameters_of_polygons_are_refused_for_depths(tmp_path, options):
    path = geotiff(tmp_path / "depth.tif", [[1.0, 2.0]])
    with pytest.raises(ParameterError, match="is for polygons, and this file holds depths; leave it out"):
        extent_of(path, "depth.tif", **options)


def test_errors_of_read_extent_name_the_file(tmp_path):
    path = sea(tmp_path / "sea.geojson")
    with pytest.raises(ParameterError, match=r"sea\.geojson: `variable` 'h' is for depths"):
        read_extent(path, variable="h")
    with pytest.raises(ParameterError, match=r"^`variable` 'h' is for depths"):
        read_extent(path.read_bytes(), "sea.geojson", variable="h")


def test_the_first_of_several_times_is_read_and_noted(tmp_path):
    drawing = read_first_step(series(tmp_path / "run.nc", [0.25, 0.75]), "run.nc", None)
    assert "it has 2 times, of which the first is read" in drawing.notes[-1].message
    first = extent_of(series(tmp_path / "one.nc", [0.25]), "one.nc").steps[0].drawing
    assert drawing.segments == first.segments
    (one,), (other,) = (each.paths[0].contours for each in (drawing, first))
    assert (one == other).all()


def test_a_file_without_a_reference_system_is_a_plane_only_as_a_drawing(tmp_path):
    path = geotiff(tmp_path / "depth.tif", [[1.0, 2.0], [1.0, 2.0]], crs=None)
    with pytest.raises(SourceError, match="give `crs` EPSG"):
        extent_of(path, "depth.tif")
    drawing = read_first_step(path, "depth.tif", None)
    west, south, east, north = BOUNDS
    assert drawing.to_source @ (0.5, 0.5, 1.0) == pytest.approx(((west + east) / 2, (south + north) / 2))
