"""GeoJSON: what its areas are, and one line with the place for everything that is wrong."""

import gzip
import json
import warnings

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given
from hypothesis import strategies as st

import vexture
from vexture.base.errors import ParameterError, SourceError, SourceWarning
from vexture.cli.main import main
from vexture.drawing.drawing import FillRule
from vexture.drawing.paint import Paint
from vexture_geo.vector.geojson import MOST_NESTED, read_geojson

OUTER = [[0, 0], [10, 0], [10, 5], [0, 5], [0, 0]]
HOLE = [[2, 1], [4, 1], [4, 3], [2, 3], [2, 1]]
POLYGON = {"type": "Polygon", "coordinates": [OUTER, HOLE]}
COLLECTION = {
    "type": "FeatureCollection",
    "features": [
        {"type": "Feature", "properties": {"fill": "#f80", "fill-opacity": 0.5}, "geometry": POLYGON},
        {"type": "Feature", "properties": None, "geometry": {"type": "MultiPolygon", "coordinates": [[OUTER], [HOLE]]}},
    ],
}


def read(value):
    return read_geojson(json.dumps(value).encode())


def corners(drawing):
    """Ends of all contours in the units of the source."""
    ends = [contour[:, 0] for path in drawing.paths for contour in path.contours]
    return [points @ drawing.to_source[:, :2].T + drawing.to_source[:, 2] for points in ends]


def test_a_polygon_keeps_its_holes_its_aspect_and_its_coordinates():
    drawing = read(POLYGON)
    assert [path.fill_rule for path in drawing.paths] == [FillRule.EVENODD]
    for found, ring in zip(corners(drawing), (OUTER, HOLE), strict=True):
        np.testing.assert_allclose(found, ring[:-1], atol=1e-12)
    points = np.concatenate(drawing.paths[0].contours)[:, 0]
    np.testing.assert_allclose([points.min(axis=0), points.max(axis=0)], [[0, 0.25], [1, 0.75]])
    texture = vexture.convert(drawing)
    inside = texture.contains([(0.05, 0.3), (0.3, 0.45), (0.5, 0.1), (0.95, 0.7)])
    assert inside.tolist() == [True, False, False, True]
    assert texture.roots[0].crs == "OGC:CRS84"


def test_colours_are_those_of_simplestyle():
    drawing = read(COLLECTION)
    orange = Paint((1.0, 136 / 255, 0.0), 0.5)
    assert [path.paint for path in drawing.paths] == [orange, Paint(), Paint()]
    assert [root.paint for root in vexture.convert(drawing, split="paint").roots] == [orange, Paint()]


@pytest.mark.parametrize(
    "properties", [{"fill": "red"}, {"fill": 3}, {"fill-opacity": 2}, {"fill-opacity": "1"}, {"fill-opacity": True}]
)
def test_bad_colours_are_named_and_black(properties):
    with pytest.warns(SourceWarning, match=next(iter(properties))):
        drawing = read({"type": "Feature", "properties": properties, "geometry": POLYGON})
    assert drawing.paths[0].paint == Paint()


def test_strokes_are_named():
    with pytest.warns(SourceWarning, match="left out: stroke of a feature$"):
        read({"type": "Feature", "properties": {"fill": "#0f0", "stroke": "#f00"}, "geometry": POLYGON})


def test_rings_may_be_open_and_turn_either_way():
    found = corners(read({"type": "Polygon", "coordinates": [OUTER[:-1][::-1]]}))
    np.testing.assert_allclose(found[0], OUTER[:-1][::-1], atol=1e-12)


def test_heights_are_ignored():
    high = [[x, y, 100.0] for x, y in OUTER]
    np.testing.assert_array_equal(corners(read({"type": "Polygon", "coordinates": [high]})), [OUTER[:-1]])


def test_what_has_no_area_is_left_out_and_named():
    line = {"type": "LineString", "coordinates": [[0, 0], [1, 1]]}
    mixed = {"type": "GeometryCollection", "geometries": [line, {"type": "Point", "coordinates": [0, 0]}, POLYGON]}
    with pytest.warns(SourceWarning, match="left out: LineString, Point"):
        assert read(mixed).segments == 8
    with pytest.warns(SourceWarning, match="ring of fewer than three positions"):
        assert read({"type": "Polygon", "coordinates": [OUTER, [[1, 1], [2, 2], [1, 1]]]}).segments == 4
    with pytest.raises(SourceError, match=r"no polygon to fill \(left out: LineString\)"):
        read(line)


@pytest.mark.parametrize("kind", ["link", "url", "Link"])
def test_a_link_to_a_system_is_refused_and_not_taken_for_degrees(kind):
    there = {"href" if kind != "url" else "url": "http://127.0.0.1:9/secret"}
    with pytest.raises(SourceError, match=r"its crs is a link to .*secret', and nothing is fetched"):
        read({**POLYGON, "crs": {"type": kind, "properties": there}})


@pytest.mark.parametrize(
    ("name", "crs"),
    [
        ("urn:ogc:def:crs:EPSG::28992", "EPSG:28992"),
        ("EPSG:3857", "EPSG:3857"),
        (7, "OGC:CRS84"),
        ("a\nb", "OGC:CRS84"),
    ],
)
def test_the_old_member_crs_is_read(name, crs):
    assert read({**POLYGON, "crs": {"type": "name", "properties": {"name": name}}}).crs == crs


def changed(*path, value):
    found = json.loads(json.dumps(COLLECTION))  # nothing in it twice
    part = found
    for step in path[:-1]:
        part = part[step]
    part[path[-1]] = value
    return found


FEATURES = ("features", 1)
RINGS = (*FEATURES, "geometry", "coordinates", 1)


@pytest.mark.parametrize(
    ("value", "says"),
    [
        (changed("features", value=3), "no list of features"),
        (changed(*FEATURES, value=None), "feature 2 is not of the type Feature"),
        (changed(*FEATURES, "geometry", value=[]), "feature 2, the geometry is a list"),
        (changed(*FEATURES, "geometry", "type", value="Curve"), "feature 2, type 'Curve' is none"),
        (changed(*FEATURES, "geometry", "type", value={}), "feature 2, type an object is none"),
        (changed(*FEATURES, "geometry", "coordinates", value=None), "feature 2, MultiPolygon has no list"),
        (changed(*RINGS, value=3), "feature 2, polygon 2, the polygon is a int"),
        (changed(*RINGS, 0, value="abc"), "feature 2, polygon 2, ring 1 is a str"),
        (changed(*RINGS, 0, 2, value=["1", "2"]), r"ring 1, position 3 is \['1', '2'\]; it must be two numbers"),
        (changed(*RINGS, 0, 2, value=[True, 1]), "ring 1, position 3 is"),
        (changed(*RINGS, 0, 2, value=[1]), "ring 1, position 3 is"),
        (changed(*RINGS, 0, value=[[1], [2], [3]]), "ring 1, position 1 is"),
        (
            changed(*RINGS, 0, 1, value=[float("nan"), 1]),
            r"feature 2, polygon 2, ring 1, position 2 is \[nan, 1\]; give finite numbers up to 1e.15",
        ),
        (changed(*RINGS, 0, 1, value=[1, float("inf")]), r"ring 1, position 2 is \[1, inf\]"),
        (changed(*RINGS, 0, 1, value=[10**400, 0]), "ring 1, position 2 is .100000"),
        ({"type": "Topology", "objects": {}}, "convert TopoJSON"),
        ({"type": "Polygon", "coordinates": [[[0, 0], [2, 2], [2, 2], [0, 0]]]}, "enclose no area"),
        ({"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [2, 0]]]}, "the drawing's box is 2 x 0"),
        (
            {"type": "Polygon", "coordinates": [[[-1e308, 0], [1e308, 0], [0, 1e308]]]},
            "position 1 is .*; give finite numbers up to 1e.15",
        ),
        ([], "its outermost value is a list"),
    ],
)
def test_every_fault_is_one_line_with_its_place(value, says):
    with pytest.raises(SourceError, match=says) as refused:
        read(value)
    assert str(refused.value).isprintable()


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"", "not JSON"),
        (b"{", "not JSON"),
        (b"\xff{}", "no UTF-8 text|not JSON"),
        (b'{"a":' * 200_000, "nested too deeply"),
        (b'{"type":"Polygon","coordinates":' + b"[" * 200_000, "nested too deeply"),
        (b'{"type":"Polygon","coordinates":[[[%s,1]]]}' % (b"9" * 5000), "thousands of digits"),
    ],
)
def test_what_is_no_json_is_one_line(content, says):
    with pytest.raises(SourceError, match=says):
        read_geojson(content)


def test_collections_in_collections_have_a_limit():
    nested = POLYGON
    for _ in range(MOST_NESTED + 1):
        nested = {"type": "GeometryCollection", "geometries": [nested]}
    with pytest.raises(SourceError, match=f"more than {MOST_NESTED} deep"):
        read(nested)
    assert read(nested["geometries"][0]).segments == 8


JSON = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.sampled_from(["Polygon", "Feature", "MultiPolygon"]),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(st.sampled_from(["type", "coordinates", "geometry", "features", "geometries"]), inner)
    ),
)


@given(
    JSON, st.sampled_from([(), ("features",), FEATURES, (*FEATURES, "geometry"), RINGS, (*RINGS, 0), (*RINGS, 0, 1)])
)
def test_anything_is_read_or_refused(value, place):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        try:
            drawing = read(changed(*place, value=value) if place else value)
        except SourceError:
            return
        assert drawing.paths


def test_files_are_found_by_their_suffix_or_their_content(tmp_path):
    text = "\ufeff " + json.dumps(POLYGON)
    for name in ("delft.geojson", "delft.json", "delft"):
        (tmp_path / name).write_text(text)
        assert vexture.convert(tmp_path / name).name == "delft"
    (tmp_path / "packed.geojson").write_bytes(gzip.compress(json.dumps(POLYGON).encode()))
    assert vexture.read_geojson(tmp_path / "packed.geojson").segments == 8
    result = CliRunner().invoke(main, ["convert", str(tmp_path / "delft.geojson"), "-o", str(tmp_path / "out")])
    assert (result.exit_code, result.output.split(",")[0]) == (0, "delft: 8 segments")
    with pytest.raises(ParameterError, match="chooses elements of an SVG"):
        vexture.convert(tmp_path / "delft.geojson", select="path")
    (tmp_path / "bad.geojson").write_text("{")
    with pytest.raises(SourceError, match=r"bad\.geojson: not JSON"):
        vexture.convert(tmp_path / "bad.geojson")
