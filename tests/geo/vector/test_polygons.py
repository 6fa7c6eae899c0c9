"""Flood polygons: every format gives the area that is in the file."""

import sys
import zipfile

import numpy as np
import pytest
import shapely
from click.testing import CliRunner
from geographic import FORMATS, LAKE, POND, UTM, file, geopackage_of, land, only, same, written

import vexture
from vexture.base.content import FileKind, kind_of, start_of
from vexture.base.errors import DeviceError, LimitError, ParameterError, SourceError, SourceWarning
from vexture.bezier.convert import straight
from vexture.cli.main import main
from vexture.conversion.reading import read_drawing
from vexture_geo.readers import read_extent


@pytest.mark.parametrize("as_bytes", [False, True])
@pytest.mark.parametrize("name", FORMATS)
def test_every_format_gives_the_same_area_in_its_own_coordinates(tmp_path, name, as_bytes):
    path = file(tmp_path, name, driver="GeoJSON" if name.endswith("json") else None)
    if as_bytes and name.endswith(".shp"):
        with pytest.raises(SourceError, match=r"\.zip"):
            read_extent(path.read_bytes(), name)
        return
    extent = read_extent(path.read_bytes() if as_bytes else path, name)
    drawing = only(extent)
    assert (drawing.name, drawing.crs, extent.frame.crs) == ("lake", UTM, UTM)
    assert same(drawing, shapely.union(LAKE, POND))
    np.testing.assert_allclose(extent.frame.bounds, (587000, 4089500, 593000, 4093000))
    np.testing.assert_allclose(extent.frame.metres, (6000, 3500))
    np.testing.assert_array_equal(drawing.to_source, extent.frame.to_source)
    assert straight(np.concatenate(drawing.paths[0].contours)).all()
    assert drawing.segments == 4 + 3 + 3
    assert kind_of(start_of(path), "lake") in (FileKind.AREAS, FileKind.GEOJSON)


def test_polygons_that_touch_or_overlap_are_one_water(tmp_path):
    shapes = [shapely.box(0, 0, 10, 10), shapely.box(10, 0, 20, 10), shapely.box(5, 5, 15, 15)]
    drawing = only(read_extent(file(tmp_path, "cells.gpkg", shapes), "cells.gpkg"))
    texture = vexture.convert(drawing)
    across = np.array([[10, 2], [10 + 1e-6, 2], [10, 7], [7, 7], [13, 12], [2, 12]], float)
    places = (across - drawing.to_source[:, 2]) / drawing.to_source.diagonal()
    assert texture.contains(places).tolist() == [True, True, True, True, True, False]


def test_layers_are_chosen_by_name(tmp_path):
    path = written(tmp_path / "many.gpkg", [LAKE], UTM, layer="lake", kind="Polygon")
    written(path, [shapely.Point(1, 2)], UTM, layer="gauges", kind="Point", append=True)
    assert same(only(read_extent(path, "many.gpkg")), LAKE)  # the only one with polygons
    written(path, [POND], UTM, layer="pond", kind="Polygon", append=True)
    with pytest.raises(LimitError, match=r"2 layers; choose one by `layer`: lake, pond"):
        read_extent(path, "many.gpkg")
    assert same(only(read_extent(path, "many.gpkg", layer="pond")), POND)
    with pytest.raises(ParameterError, match=r"no layer 'sea'; its layers are: lake, gauges, pond"):
        read_extent(path, "many.gpkg", layer="sea")
    with pytest.raises(ParameterError, match="leave `layer` out"):
        read_extent(b'{"type": "Polygon", "coordinates": []}', "a.geojson", layer="sea")


def test_a_zip_of_several_shapefiles_has_layers(tmp_path):
    written(tmp_path / "lake.shp", [LAKE])
    written(tmp_path / "pond.shp", [POND])
    archive = tmp_path / "both.zip"
    with zipfile.ZipFile(archive, "w") as out:
        for path in sorted(tmp_path.glob("*.*")):
            if path != archive:
                out.write(path, path.name.upper())
    with pytest.raises(LimitError, match=r"choose one by `layer`: LAKE, POND"):
        read_extent(archive, "both.zip")
    assert same(only(read_extent(archive, "both.zip", layer="POND")), POND)


@pytest.mark.parametrize("name", ["lake.gpkg", "lake.fgb", "lake.shp", "lake.zip"])
def test_without_a_reference_system_it_asks_and_convert_takes_coordinates_as_they_are(tmp_path, name):
    path = file(tmp_path, name, crs=None)
    with pytest.raises(SourceError, match=r"lake\.\w+: it names no reference system.*`crs` EPSG"):
        read_extent(path, name)
    assert only(read_extent(path, name, crs=UTM)).crs == UTM
    drawing = read_drawing(path)
    assert (drawing.crs, drawing.name) == (None, "lake")
    assert same(drawing, shapely.union(LAKE, POND))
    with pytest.raises(ParameterError, match="'EPSG:1' is unknown"):
        read_extent(path, name, crs="EPSG:1")


@pytest.mark.parametrize("name", ["lake.gpkg", "lake.fgb", "lake.shp"])
def test_the_command_line_converts_it(tmp_path, name):
    path = file(tmp_path, name)
    target = tmp_path / "lake.ktx2"
    outcome = CliRunner().invoke(main, ["convert", str(path), "-o", str(target)])
    assert outcome.exit_code == 0, outcome.output
    texture = vexture.load(target)
    assert texture.roots[0].crs == UTM
    np.testing.assert_allclose(texture.roots[0].to_source, read_drawing(path).to_source)
    outcome = CliRunner().invoke(main, ["convert", str(path), "--select", "path", "-o", str(target)])
    assert outcome.exit_code == 1
    assert "leave it out" in outcome.output


def test_what_has_no_area_is_left_out_and_named_once(tmp_path):
    inner = shapely.GeometryCollection([POND, shapely.Point(0, 0)])
    shapes = [
        shapely.GeometryCollection([LAKE, shapely.LineString([(0, 0), (1, 1)]), inner]),
        shapely.Point(1, 1),
        None,
    ]
    path = file(tmp_path, "mixed.gpkg", shapes)
    with pytest.warns(SourceWarning) as caught:
        drawing = only(read_extent(path, "mixed.gpkg"))
    (warning,) = caught
    assert str(warning.message) == "mixed.gpkg: left out: feature without geometry, LineString, Point (2)"
    assert same(drawing, shapely.union(LAKE, POND))


@pytest.mark.parametrize("name", ["lake.gpkg", "lake.fgb", "lake.shp"])
def test_heights_are_not_looked_at(tmp_path, name):
    high = shapely.force_3d(shapely.union(LAKE, POND), 7.0)
    path = written(tmp_path / name, shapely.get_parts(high), UTM, kind="Polygon Z")
    assert same(only(read_extent(path, name)), shapely.union(LAKE, POND))


@pytest.mark.parametrize(("code", "more"), [("d3070000", (5,)), ("bb0b0000", (7, 5))])  # M, ZM
def test_measures_are_not_looked_at(tmp_path, code, more):
    numbers = [(*corner, *more) for corner in POND.exterior.coords]
    path = geopackage_of(tmp_path / "measured.gpkg", f"01{code}0100000004000000", numbers)
    assert same(only(read_extent(path, "measured.gpkg")), POND)


def test_curved_polygons_are_read_as_chords(tmp_path):
    circle = [(0, 0), (500, 500), (1000, 0), (500, -500), (0, 0)]
    path = geopackage_of(tmp_path / "round.gpkg", "010a00000001000000010800000005000000", circle, "CURVEPOLYGON")
    drawing = only(read_extent(path, "round.gpkg"))
    np.testing.assert_allclose(land(drawing).area, np.pi * 500**2, rtol=2e-3)


def test_a_parameter_of_depths_is_refused(tmp_path):
    path = file(tmp_path, "lake.gpkg")
    for option in ({"time_dim": "time"}, {"variable": "depth"}):
        with pytest.raises(ParameterError, match=r"is for depths, and this file holds polygons"):
            read_extent(path, "lake.gpkg", **option)


def test_without_the_packages_it_says_what_to_install_and_plain_geojson_is_read(tmp_path, monkeypatch):
    geopackage = file(tmp_path, "lake.gpkg")
    geojson = file(tmp_path, "lake.geojson")
    for package in ("pyogrio", "pyproj"):
        monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(DeviceError, match=r"needs the package pyogrio: pip install 'vexture\[gis\]'"):
        read_drawing(geopackage)
    assert read_drawing(geojson).segments == 10
