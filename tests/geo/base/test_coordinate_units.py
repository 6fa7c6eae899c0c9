"""The option `crs` and what a file of depths says of its coordinates: what is unknown, and what contradicts it."""

import json

import geopandas
import numpy as np
import pytest
import rasterio
import shapely
import xarray
from rasterio.transform import Affine

from vexture.base.errors import ParameterError, SourceError
from vexture.base.notes import Notes
from vexture_geo.depth.depths import read_depths
from vexture_geo.readers import extent_of
from vexture_geo.vector.features import feature_batches, read_features

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


SMALL = [4.0, 52.0, 4.03, 52.02]
"""Degrees: 2 km of the Netherlands, and 3 cm where they are taken for metres."""


def shape(path, west, south, east, north):
    ring = [[west, south], [east, south], [east, north], [west, north], [west, south]]
    feature = {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [ring]}}
    path.write_text(json.dumps({"type": "FeatureCollection", "features": [feature]}))
    return path


def grid(path, west, south, cell):
    header = f"ncols 4\nnrows 3\nxllcorner {west}\nyllcorner {south}\ncellsize {cell}\n"
    path.write_text(header + "1 1 1 1\n" * 3)
    return path


@pytest.mark.parametrize("crs", ["EPSG:28992", "EPSG:32610", "+proj=utm +zone=10 +datum=WGS84"])
def test_degrees_without_a_unit_are_refused_in_metres(tmp_path, crs):
    for path in (grid(tmp_path / "a.asc", 4.0, 52.0, 0.01), shape(tmp_path / "a.geojson", *SMALL)):
        with pytest.raises(ParameterError, match=r"coordinates 4,52,4\.0\d,52\.0\d .*degrees.*give `crs` EPSG:4326"):
            extent_of(path, path.name, crs=crs)


@pytest.mark.parametrize("crs", ["EPSG:3857", "EPSG:27700"])
def test_degrees_are_refused_also_where_a_system_is_used_around_its_origin(tmp_path, crs):
    path = grid(tmp_path / "a.asc", 4.0, 52.0, 0.01)
    with pytest.raises(ParameterError, match="look like degrees"):
        extent_of(path, "a.asc", crs=crs)


@pytest.mark.parametrize("box", [(-6.0, 42.0, 12.0, 53.0), (-125.0, 25.0, -67.0, 49.0)])
def test_degrees_of_a_country_are_refused_far_from_where_a_system_is_used(tmp_path, box):
    path = shape(tmp_path / "a.geojson", *box)
    table = f'WKT\n"{shapely.box(*box).wkt}"\n'.encode()
    said = r"look like degrees, and `crs` EPSG:28992 is not in degrees: it is used far from there; give `crs` EPSG:4326"
    with pytest.raises(ParameterError, match=said):
        extent_of(path, "a.geojson", crs="EPSG:28992")
    for read in (read_features, lambda *given, **options: [*feature_batches(*given, **options)]):
        with pytest.raises(ParameterError, match=said):
            read(table, crs="EPSG:28992", notes=Notes())


def test_a_map_of_degrees_in_a_system_of_metres_is_refused(tmp_path):
    frame = geopandas.read_file(shape(tmp_path / "a.geojson", 4.0, 52.0, 7.0, 53.0)).set_crs(28992, allow_override=True)
    for geometry in (frame.geometry, frame.representative_point(), frame.boundary):
        with pytest.raises(SourceError, match="look like degrees, and its system EPSG:28992 is not in degrees"):
            read_features(frame.set_geometry(geometry), notes=Notes())
    assert len(read_features(frame.set_crs(4326, allow_override=True), notes=Notes())) == 1


@pytest.mark.parametrize("box", [(5.0, 5.0, 105.0, 45.0), (-50.0, -20.0, 50.0, 20.0)])
def test_a_plane_that_begins_near_the_origin_is_read(tmp_path, box):
    path = shape(tmp_path / "a.geojson", *box)
    assert extent_of(path, "a.geojson", crs="EPSG:28992").frame.bounds == box


def test_a_flume_of_metres_around_the_origin_is_read(tmp_path):
    path = grid(tmp_path / "a.asc", 0.0, 0.0, 0.75)
    assert extent_of(path, "a.asc", crs="EPSG:28992").frame.metres == (3.0, 2.25)
    path = shape(tmp_path / "a.geojson", 0.0, 0.0, 3.0, 1.0)
    assert extent_of(path, "a.geojson", crs="EPSG:28992").frame.metres == (3.0, 1.0)


def test_the_system_of_a_file_is_refused_where_its_coordinates_are_degrees(tmp_path):
    path = pond(tmp_path / "a.nc", DEGREES, 4.0, 0.01, {"spatial_ref": "EPSG:32610"})
    with pytest.raises(SourceError, match=r"its system EPSG:32610 is not in degrees.* are; give `crs` EPSG:4326"):
        read_depths(path, "a.nc")
    assert read_depths(path, "a.nc", crs="EPSG:4326").frame.crs == "EPSG:4326"


def test_coordinates_in_radians_are_refused(tmp_path):
    about = {axis: {"units": "radian", "standard_name": name} for axis, name in (("x", "longitude"), ("y", "latitude"))}
    path = pond(tmp_path / "a.nc", about, 0.07, 0.0002)
    with pytest.raises(SourceError, match="are in 'radian'; write them in degrees"):
        read_depths(path, "a.nc")


def test_coordinates_that_are_no_degrees_are_told_as_the_file_has_them(tmp_path):
    path = pond(tmp_path / "a.nc", {"x": {}, "y": {}}, 5e5, 100.0)
    with pytest.raises(SourceError, match="the bounds 499950,499950,500350,500350 "):
        read_depths(path, "a.nc", crs="EPSG:4326")
