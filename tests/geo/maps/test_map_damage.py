"""Sources of which a part is missing say so, and options that are wrong are called by their names."""

import json

import geopandas
import pandas as pd
import pyogrio
import pytest
import shapely
from click.testing import CliRunner

from vexture.base.errors import ParameterError, SourceError
from vexture.base.notes import Notes
from vexture.cli.main import main
from vexture_geo.maps import MapLayer, convert_map
from vexture_geo.maps.place import place_features
from vexture_geo.vector.feature_tables import FeatureQuery, chunks_of
from vexture_geo.vector.features import read_features

METRES = "EPSG:28992"


def frame(shapes, crs=METRES, **columns):
    return geopandas.GeoDataFrame(columns or {"v": range(len(shapes))}, geometry=shapes, crs=crs)


def squares(count=3):
    return frame([shapely.box(k, 0, k + 1, 1) for k in range(count)])


@pytest.mark.parametrize("kind", ["gpkg", "parquet", "frame"])
def test_empty_geometries_are_counted_with_those_that_are_none(kind, tmp_path):
    source = frame([shapely.box(0, 0, 1, 1), shapely.Polygon(), None, shapely.MultiPolygon()])
    if kind != "frame":
        place = tmp_path / f"land.{kind}"
        (source.to_parquet if kind == "parquet" else source.to_file)(place)
        source = place
    notes, where = Notes(), "2, 3, 4" if kind == "gpkg" else "1, 2, 3"
    assert len(read_features(source, notes=notes).rings.outer) == 1
    assert [str(note) for note in notes.in_order] == [f"feature without geometry (3: {where})"]


@pytest.mark.parametrize(("part", "most"), [("shp", 1 << 30), ("shx", 1 << 30), ("shp", 50)])
def test_a_shapefile_that_is_cut_off_is_damaged(part, most, tmp_path, monkeypatch):
    squares().to_file(tmp_path / "land.shp")
    place = tmp_path / f"land.{part}"
    content = place.read_bytes()
    assert len(read_features(tmp_path / "land.shp", notes=Notes())) == 3
    place.write_bytes(content[:-8])
    monkeypatch.setattr("vexture_geo.vector.vector_files.LARGEST_FILE", most)
    with pytest.raises(SourceError, match=rf"land\.{part} is damaged: it has \d+ of the {len(content)} bytes"):
        read_features(tmp_path / "land.shp", notes=Notes())


def topology(*arcs):
    made = [{"type": "Polygon", "id": f"{k}", "arcs": each} for k, each in enumerate(arcs)]
    held = {"land": {"type": "GeometryCollection", "geometries": made}}
    ring = [[4, 52], [5, 52], [5, 53], [4, 53], [4, 52]]
    return json.dumps({"type": "Topology", "objects": held, "arcs": [ring]}).encode()


def test_arcs_that_a_topology_does_not_have_are_said():
    notes = Notes()
    read_features(topology([[0]], [[7]], [[0], [-9]]), notes=notes)
    assert "the file is damaged: a geometry refers to arcs that it does not have (2)" in map(str, notes.in_order)
    whole = Notes()
    read_features(topology([[0]], [[-1]]), notes=whole)
    assert whole.in_order == ()
    (_, *later) = chunks_of(topology(*[[[0]]] * 3, [[7]]), FeatureQuery(), 2)
    assert [chunk.damaged for chunk in later] == [0]


@pytest.mark.parametrize("kind", ["lines", "points"])
def test_metres_beside_places_of_zero_are_no_degrees(kind):
    places = [(0, 0), (0, 0), (84000, 447000), (85000, 448000), (86000, 448000)]
    shapes = [shapely.Point(place) for place in places]
    if kind == "lines":
        shapes = [shapely.LineString([place, (place[0] + 1, place[1])]) for place in places]
    with pytest.raises(SourceError, match=r"0,0,8600\d,448000 \(EPSG:4326\) cannot be longitudes.* `source_crs` EPSG"):
        convert_map([MapLayer(frame(shapes, "EPSG:4326"))])


def test_a_place_that_is_none_is_told_by_the_feature_and_its_coordinates():
    points = frame([shapely.Point(4, 52), shapely.Point(84000, 447000), shapely.Point(5, 53)], "EPSG:4326")
    notes = Notes()
    place_features(read_features(points, notes=notes), "EPSG:3857", notes)
    assert [str(note) for note in notes.in_order] == [
        "point beyond the map",
        "a place such as 84000,447000 is no longitude and latitude; correct it, or name the system that all are in by "
        "`source_crs` (1: 1)",
    ]


def test_a_file_without_geometries_says_so_whether_or_not_it_names_a_system(tmp_path):
    place = tmp_path / "names.fgb"
    pyogrio.write_dataframe(pd.DataFrame({"name": ["a", "b"]}), place, SPATIAL_INDEX="NO")
    with pytest.raises(SourceError, match="none of its features has a geometry that can be drawn"):
        convert_map([MapLayer(place)])
    notes = Notes()
    assert len(read_features(place, notes=notes)) == 2
    assert [str(note) for note in notes.in_order] == ["feature without geometry (2: 0, 1)"]


def test_metres_that_are_said_to_be_degrees_name_the_option_of_the_source():
    for shape in (shapely.box(1000, 1000, 2000, 2000), shapely.LineString([(1000, 1000), (2000, 2000)])):
        far = frame([shape, shapely.Point(84000, 447000)], "EPSG:4326")
        with pytest.raises(SourceError, match=r"cannot be longitudes and latitudes; name .* by `source_crs` EPSG"):
            convert_map([MapLayer(far)])
    some = frame([shapely.Point(84000, 447000), shapely.Point(4, 52), shapely.Point(5, 52)], "EPSG:4326")
    lost = [str(note) for note in convert_map([MapLayer(some)]).conversion.notes]
    assert "point beyond the map" in lost
    done = convert_map([MapLayer(squares(), source_crs="EPSG:4326")], crs=METRES)
    (said,) = map(str, done.conversion.notes)
    assert said == "it names its own reference system, EPSG:28992, so EPSG:4326 is not used for it"


def test_tiles_of_no_feature_say_why(tmp_path):
    squares().to_file(tmp_path / "land.gpkg")
    given = ["tiles", str(tmp_path / "land.gpkg"), "-o", str(tmp_path / "o.pmtiles"), "--processes", "1"]
    done = CliRunner().invoke(main, [*given, "--where", "v > 7"])
    assert (done.exit_code, "no feature meets --where 'v > 7'; correct it" in done.output) == (1, True)
    assert [path.name for path in tmp_path.iterdir()] == ["land.gpkg"]


def test_data_far_from_where_a_system_is_meant_for_say_so():
    counties = frame([shapely.box(x, 35, x + 2, 37) for x in range(-110, -80, 2)], "EPSG:4326")
    found = convert_map([MapLayer(counties)], crs=METRES).conversion.notes
    (said,) = map(str, found)
    assert said.startswith("some of it is far outside of the area of use of EPSG:28992 (Netherlands - onshore")
    assert said.endswith("choose another `crs`")
    for crs in ("EPSG:5070", "EPSG:3857", "EPSG:8857", "EPSG:3995"):
        assert convert_map([MapLayer(counties)], crs=crs).conversion.notes == ()
    points = frame([shapely.Point(x, 35) for x in (-110, -90)], "EPSG:4326")
    (said,) = map(str, convert_map([MapLayer(points)], crs=METRES).conversion.notes)
    assert "far outside of the area of use" in said
    beside = frame([shapely.box(2, 49, 9, 54)], "EPSG:4326")
    assert convert_map([MapLayer(beside)], crs=METRES).conversion.notes == ()


def test_unknown_columns_of_ids_are_still_refused():
    with pytest.raises(ParameterError, match="no column 'code' for `id`; there are: v"):
        read_features(squares().set_index([["a", "b", "c"]]), id="code", notes=Notes())


@pytest.mark.parametrize("place", ["name", "footer"])
def test_a_geoparquet_whose_names_are_damaged_is_one_line(place, tmp_path):
    """pyarrow raises a UnicodeDecodeError for the name of a column that is no UTF-8."""
    source = tmp_path / "land.parquet"
    frame([shapely.box(4, 52, 5, 53)], "EPSG:4326", population=[1]).to_parquet(source)
    content = source.read_bytes()
    assert content.count(b"population") > 1
    damaged = content.replace(b"population", b"popula\xe8ion") if place == "name" else content[:-40] + bytes(40)
    source.write_bytes(damaged)
    with pytest.raises(SourceError, match=r"the table cannot be read \(.*\); save it again|none of GeoJSON"):
        read_features(source, notes=Notes())
    result = CliRunner().invoke(main, ["map", str(source), "-o", str(tmp_path / "land.ktx2")])
    assert (result.exit_code, result.stderr.count("\n")) == (1, 1)
    assert "Traceback" not in result.stderr
    assert not (tmp_path / "land.ktx2").exists()
