"""Features of every format: the same polygons, ids and attributes; conditions, columns, bounds and batches."""

import json

import geopandas
import numpy as np
import pyarrow.parquet as pq
import pytest
import shapely
from four_squares import NAMES, save_features, squares

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture_geo.vector.features import read_features


@pytest.mark.parametrize("kind", ["gpkg", "fgb", "shp", "geojson", "parquet", "frame"])
def test_every_format_gives_the_same_features(kind, tmp_path):
    source = squares() if kind == "frame" else save_features(squares(), tmp_path, kind)
    found = read_features(source, id="name", notes=Notes())
    order = np.argsort(found.ids)  # FlatGeobuf sorts by place
    assert found.ids[order].tolist() == NAMES
    assert found.table.column_names[0] == "id"
    assert found.table["id"].to_pylist() == found.ids.tolist()
    assert np.array(found.table["size"].to_pylist())[order].tolist() == [1, 2, 3, 4]
    assert found.crs == "EPSG:28992"
    areas = np.bincount(found.feature, shapely.area(found.rings.shapes))
    assert np.allclose(areas[order], [1, 1, 1, 0.64])


def test_ids_are_unique_and_say_what_they_were():
    frame = squares().assign(code=["x", "x", None, "x"])
    notes = Notes()
    assert read_features(frame, id="code", notes=notes).ids.tolist() == ["x", "x#2", "#2", "x#3"]
    assert [str(note) for note in notes.in_order] == [
        "a feature has no 'code': its id is # and its number (1: #2)",
        "a feature has an id that another had before: its own ends in #2, #3, ... (2: x#2, x#3)",
    ]


def test_topojson_has_ids_and_degrees():
    arcs = [[[4, 52], [4, 53], [5, 53], [4, 52]]]
    objects = {"land": {"type": "GeometryCollection", "geometries": [{"type": "Polygon", "id": "07", "arcs": [[0]]}]}}
    found = read_features(json.dumps({"type": "Topology", "arcs": arcs, "objects": objects}).encode(), notes=Notes())
    assert (found.ids.tolist(), found.crs) == (["07"], "OGC:CRS84")


def test_geojson_without_a_name_is_read():
    text = json.loads(squares().to_crs("EPSG:4326").to_json())
    assert len(read_features(json.dumps(text).encode(), notes=Notes())) == len(NAMES)


def test_lines_points_empty_and_broken_geometries():
    bow = shapely.Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
    shapes = [shapely.LineString([(0, 0), (1, 1)]), shapely.MultiPoint([(1, 1), (2, 2)]), bow, shapely.Polygon(), None]
    notes = Notes()
    found = read_features(geopandas.GeoDataFrame(geometry=shapes, crs="EPSG:28992"), notes=notes)
    assert (found.lines.feature.tolist(), found.points.feature.tolist()) == ([0], [1, 1])
    assert shapely.area(found.rings.shapes).sum() == pytest.approx(2)
    assert {str(note) for note in notes.in_order} == {
        "feature without geometry (2: 3, 4)",
        "a polygon that crossed or overlapped itself is repaired (1: 2)",
    }


def test_a_repair_that_nobody_can_see_is_not_told():
    loop = [(0, 0), (2, 0), (2, 1), (2 + 1e-7, 1 + 1e-7), (2, 1 + 1e-7), (2 + 1e-7, 1), (2, 2), (0, 2)]
    notes = Notes()
    found = read_features(geopandas.GeoDataFrame(geometry=[shapely.Polygon(loop)], crs="EPSG:28992"), notes=notes)
    assert shapely.is_valid(found.rings.shapes).all()
    assert not notes.in_order


def test_a_source_without_a_reference_system_says_so(tmp_path):
    place = save_features(squares().set_crs(None, allow_override=True), tmp_path, "parquet")
    with pytest.raises(SourceError, match=r"names no reference system.*`crs`"):
        read_features(place, notes=Notes())
    assert read_features(place, crs="EPSG:28992", notes=Notes()).crs == "EPSG:28992"


def test_parquet_without_geometries_says_so(tmp_path):
    pq.write_table(read_features(squares(), notes=Notes()).table, tmp_path / "a.parquet")
    with pytest.raises(SourceError, match="no geometries"):
        read_features(tmp_path / "a.parquet", notes=Notes())


def test_a_source_that_names_its_reference_system_keeps_it(tmp_path):
    """GeoJSON is said to be in degrees by its format, whatever it holds: there the given system counts."""
    notes = Notes()
    found = read_features(save_features(squares(), tmp_path, "gpkg"), crs="EPSG:4326", notes=notes)
    assert found.crs == "EPSG:28992"
    assert [str(note) for note in notes.in_order] == [
        "it names its own reference system, EPSG:28992, so EPSG:4326 is not used for it"
    ]
    text = squares().set_crs(None, allow_override=True).to_json().encode()
    assert read_features(text, crs="EPSG:28992", notes=Notes()).crs == "EPSG:28992"


def test_rings_of_two_corners_and_infinite_ids():
    ring = {"type": "Polygon", "coordinates": [[[0, 0], [1, 1], [0, 0]]]}
    square = {"type": "Polygon", "coordinates": [[[2, 2], [3, 2], [3, 3], [2, 2]]]}
    features = [{"type": "Feature", "properties": {}, "geometry": geometry} for geometry in (ring, square)]
    notes = Notes()
    text = json.dumps({"type": "FeatureCollection", "features": features}).encode()
    found = read_features(text, notes=notes)
    assert (len(found), found.feature.tolist()) == (2, [1])
    assert [str(note) for note in notes.in_order] == ["polygon with a ring of fewer than three corners"]
    frame = squares().assign(code=[1.0, np.inf, 2.5, 1e20])
    assert read_features(frame, id="code", notes=Notes()).ids.tolist() == ["1", "inf", "2.5", "100000000000000000000"]


@pytest.mark.parametrize("name", ["id", "OGC_FID", "wkb_geometry"])
@pytest.mark.parametrize("values", [(5, 6), ("a", "b")])
def test_attributes_are_named_as_the_columns_of_gdal(name, values):
    """Whole numbers that are called `id` were a traceback."""
    places = [shapely.geometry.mapping(shapely.box(place, 0, place + 1, 1)) for place in range(2)]
    listed = [
        {"type": "Feature", "properties": {name: value}, "geometry": place}
        for value, place in zip(values, places, strict=True)
    ]
    found = read_features(json.dumps({"type": "FeatureCollection", "features": listed}).encode(), notes=Notes())
    assert found.table[name].to_pylist() == ([*map(str, values)] if name == "id" else [*values])
