"""Flood polygons: the area that a file says, in the frame, or one line that says what to do."""

import gzip
import json
import sqlite3
import warnings
import zipfile
from contextlib import closing
from io import BytesIO

import numpy as np
import pytest
import shapely
from click.testing import CliRunner
from geographic import land, written, zipped
from hypothesis import given, settings
from hypothesis import strategies as st

import vexture
from vexture.bezier.convert import straight
from vexture.cli import main
from vexture.errors import LimitError, SourceError, SourceWarning, VextureError
from vexture.sources.extent import read_extent
from vexture.sources.frame import Frame
from vexture.sources.reading import is_geographic, read_drawing, start_of
from vexture.sources.reference import frame_around, transformed

UTM = "EPSG:32610"
LAKE = shapely.Polygon(
    [(587000, 4090000), (590000, 4089500), (591000, 4092000), (588000, 4093000)],
    [[(588500, 4091000), (589500, 4091000), (589000, 4092000)]],
)
POND = shapely.Polygon([(592000, 4090000), (593000, 4090000), (592500, 4091000)])
FORMATS = ["lake.gpkg", "lake.fgb", "lake.shp", "lake.zip", "lake.geojson"]


def file(folder, name, shapes=(LAKE, POND), crs=UTM, **options):
    if name.endswith(".zip"):
        return zipped(written((folder / name).with_suffix(".shp"), shapes, crs, **options))
    return written(folder / name, shapes, crs, **options)


def only(extent):
    (step,) = extent.steps
    assert (step.time, step.depth, extent.bed) == (None, None, None)
    return step.drawing


def same(drawing, shape, tolerance=1e-9):
    return shapely.symmetric_difference(land(drawing), shape).area <= tolerance * shape.area


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
    assert is_geographic(start_of(path), "lake")


def test_a_frame_decides_and_the_data_is_transformed_into_it(tmp_path):
    path = file(tmp_path, "lake.gpkg")
    frame = frame_around((-122.05, 36.93, -121.90, 37.0), "EPSG:4326")
    extent = read_extent(path, "lake.gpkg", frame=frame)
    assert extent.frame == frame
    drawing = only(extent)
    corners = np.concatenate([ring.coords[:-1] for ring in (LAKE.exterior, LAKE.interiors[0], POND.exterior)])
    expected = transformed(corners, UTM, "EPSG:4326")
    found = np.concatenate(drawing.paths[0].contours)[:, 0] @ drawing.to_source[:, :2].T + drawing.to_source[:, 2]
    gaps = np.hypot(*(found[:, None] - expected).T).min(axis=1)
    assert gaps.max() < 1e-12 * 180
    texture = vexture.convert(drawing)
    ground = np.array([[588000.0, 4090500.0], [589000.0, 4091200.0], [592500.0, 4090300.0], [591500.0, 4090300.0]])
    places = (transformed(ground, UTM, "EPSG:4326") - drawing.to_source[:, 2]) / drawing.to_source.diagonal()
    assert texture.contains(places).tolist() == [True, False, True, False]


def test_a_long_side_that_bends_in_the_frames_system_is_followed(tmp_path):
    box = shapely.box(0, 40, 40, 70)
    path = file(tmp_path, "europe.gpkg", [box], "EPSG:4326")
    drawing = only(read_extent(path, "europe.gpkg", frame=frame_around((2.5e6, 1.5e6, 7e6, 6e6), "EPSG:3035")))
    assert 20 < drawing.segments < 4000
    rim = shapely.get_coordinates(shapely.segmentize(box, 0.5))
    exact = shapely.Polygon(transformed(rim, "EPSG:4326", "EPSG:3035"))
    square = shapely.box(*(drawing.to_source @ (0, 0, 1)), *(drawing.to_source @ (1, 1, 1)))
    gap = shapely.hausdorff_distance(land(drawing), shapely.intersection(exact, square), densify=0.01)
    assert gap < 1e-4 * 4.8e6


def test_bounds_cut_the_data_at_the_squares_borders_not_at_the_frames(tmp_path):
    path = file(tmp_path, "lake.fgb")
    extent = read_extent(path, "lake.fgb", bounds=(588000, 4090000, 590000, 4091000))
    assert extent.frame.bounds == (588000, 4090000, 590000, 4091000)
    drawing = only(extent)
    low, high = drawing.to_source @ (0, 0, 1), drawing.to_source @ (1, 1, 1)
    assert same(drawing, shapely.intersection(shapely.union(LAKE, POND), shapely.box(*low, *high)))
    assert low[1] < 4090000
    assert high[1] > 4091000


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
    with pytest.raises(LimitError, match=r"2 layers; choose one by --layer: lake, pond"):
        read_extent(path, "many.gpkg")
    assert same(only(read_extent(path, "many.gpkg", layer="pond")), POND)
    with pytest.raises(LimitError, match=r"no layer 'sea'; its layers are: lake, gauges, pond"):
        read_extent(path, "many.gpkg", layer="sea")
    with pytest.raises(LimitError, match="leave --layer out"):
        read_extent(b'{"type": "Polygon", "coordinates": []}', "a.geojson", layer="sea")


def test_a_zip_of_several_shapefiles_has_layers(tmp_path):
    written(tmp_path / "lake.shp", [LAKE])
    written(tmp_path / "pond.shp", [POND])
    archive = tmp_path / "both.zip"
    with zipfile.ZipFile(archive, "w") as out:
        for path in sorted(tmp_path.glob("*.*")):
            if path != archive:
                out.write(path, path.name.upper())
    with pytest.raises(LimitError, match=r"choose one by --layer: LAKE, POND"):
        read_extent(archive, "both.zip")
    assert same(only(read_extent(archive, "both.zip", layer="POND")), POND)


@pytest.mark.parametrize("name", ["lake.gpkg", "lake.fgb", "lake.shp", "lake.zip"])
def test_without_a_reference_system_it_asks_and_convert_takes_coordinates_as_they_are(tmp_path, name):
    path = file(tmp_path, name, crs=None)
    with pytest.raises(SourceError, match=r"lake\.\w+: it names no reference system.*--crs EPSG"):
        read_extent(path, name)
    assert only(read_extent(path, name, crs=UTM)).crs == UTM
    drawing = read_drawing(path)
    assert (drawing.crs, drawing.name) == (None, "lake")
    assert same(drawing, shapely.union(LAKE, POND))
    with pytest.raises(LimitError, match="'EPSG:1' is unknown"):
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


def test_coordinates_in_metres_without_a_system_are_no_degrees():
    plain = json.dumps(shapely.geometry.mapping(LAKE)).encode()
    with pytest.raises(SourceError, match=r"cannot be longitudes and latitudes; .*--crs"):
        read_extent(plain, "lake.geojson")
    assert same(only(read_extent(plain, "lake.geojson", crs=UTM)), LAKE)
    assert same(only(read_extent(gzip.compress(plain), "lake.geojson", crs=UTM)), LAKE)


@pytest.mark.parametrize(
    ("shape", "crs", "bounds", "hint"),
    [
        (LAKE, UTM, (0, 0, 10, 10), "the bounds look like degrees"),
        (shapely.box(4, 52, 5, 53), "EPSG:28992", (80000, 440000, 90000, 450000), "look like degrees: give --crs EPSG"),
        (LAKE, UTM, (1e6, 0, 2e6, 10), "correct the bounds"),
        (shapely.box(4, 52, 5, 53), "EPSG:4326", (6, 52, 7, 53), "correct the bounds"),
    ],
)
def test_an_extent_outside_of_the_bounds_names_both_boxes(tmp_path, shape, crs, bounds, hint):
    path = file(tmp_path, "lake.gpkg", [shape], crs)
    with pytest.raises(SourceError, match=hint) as raised:
        read_extent(path, "lake.gpkg", bounds=bounds)
    for number in (f"{shape.bounds[0]:g}", f"{bounds[0]:.6g}" if abs(bounds[0]) < 1e5 else f"{bounds[0]:.0f}"):
        assert number in str(raised.value)
    assert str(raised.value).count("\n") == 0


def test_an_extent_outside_of_a_frame_of_another_system_is_refused(tmp_path):
    path = file(tmp_path, "lake.gpkg")
    with pytest.raises(SourceError, match=r"587000,4089500,.*\(EPSG:32610\).* 4,52,5,53 \(EPSG:4326\)"):
        read_extent(path, "lake.gpkg", frame=frame_around((4, 52, 5, 53), "EPSG:4326"))


@pytest.mark.parametrize("shapes", [[], [None], [shapely.Polygon()], [shapely.Point(1, 2)]])
def test_without_polygons_all_is_dry_within_the_bounds(tmp_path, shapes):
    path = file(tmp_path, "dry.gpkg", shapes)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        drawing = only(read_extent(path, "dry.gpkg", bounds=(0, 0, 10, 10)))
    assert (drawing.paths, drawing.crs) == ((), UTM)
    np.testing.assert_allclose(drawing.to_source @ (0.5, 0.5, 1), (5, 5))
    with pytest.raises(SourceError, match=r"no polygon.*give --bounds"):
        read_extent(path, "dry.gpkg")


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


def geopackage_of(path, head, numbers, kind="POLYGON"):
    """GeoPackage of one geometry that shapely or GDAL would not write: the start of its WKB, then its coordinates."""
    path = written(path, [POND], UTM, kind="Polygon", layer="one")
    blob = b"GP\0\x01" + (32610).to_bytes(4, "little") + bytes.fromhex(head) + np.array(numbers, "<f8").tobytes()
    with closing(sqlite3.connect(path)) as base, base:
        for (trigger,) in base.execute("select name from sqlite_master where type = 'trigger'").fetchall():
            base.execute(f'drop trigger "{trigger}"')
        base.execute("update gpkg_geometry_columns set geometry_type_name = ?, z = 2, m = 2", (kind,))
        base.execute("update one set geom = ?", (blob,))
    return path


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


@pytest.mark.parametrize("name", ["a.gpkg", "a.fgb", "a.geojson"])
def test_invalid_rings_are_repaired(tmp_path, name):
    bow = shapely.Polygon([(0, 0), (10, 10), (10, 0), (0, 10)])
    outside = shapely.Polygon([(20, 0), (30, 0), (30, 10), (20, 10)], [[(28, 2), (36, 2), (36, 4), (28, 4)]])
    doubled = shapely.Polygon([(40, 0), (40, 0), (50, 0), (50, 0), (50, 10), (40, 0)])
    path = file(tmp_path, name, [bow, outside, doubled, POND], driver=None)
    drawing = only(read_extent(path, name, crs=UTM, bounds=(0, 0, 60, 10)))
    lobes = [shapely.Polygon([(0, 0), (5, 5), (0, 10)]), shapely.Polygon([(10, 0), (10, 10), (5, 5)])]
    notched = shapely.difference(shapely.box(20, 0, 30, 10), shapely.box(28, 2, 36, 4))
    expected = shapely.union_all([*lobes, notched, shapely.Polygon([(40, 0), (50, 0), (50, 10)])])
    assert same(drawing, expected)


def test_rings_that_are_not_closed_are_closed(tmp_path):
    corners = [(0, 0), (10, 0), (10, 10), (0, 10)]
    path = geopackage_of(tmp_path / "open.gpkg", "01030000000100000004000000", corners)
    assert same(only(read_extent(path, "open.gpkg")), shapely.box(0, 0, 10, 10))


def test_a_polygon_that_encloses_nothing_is_left_out(tmp_path):
    flat = shapely.Polygon([(0, 0), (10, 10), (5, 5), (0, 0)])
    with pytest.warns(SourceWarning, match="left out: polygon that encloses nothing"):
        drawing = only(read_extent(file(tmp_path, "flat.gpkg", [flat, POND]), "flat.gpkg"))
    assert same(drawing, POND)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("name", ["a.gpkg", "a.fgb"])
def test_a_coordinate_that_is_not_finite_is_refused_by_name(tmp_path, name, value):
    hole = [(588500, 4091000), (589500, 4091000), (value, 4092000)]
    with np.errstate(invalid="ignore"):
        bad = shapely.MultiPolygon([POND, shapely.Polygon(LAKE.exterior, [hole])])
        path = file(tmp_path, name, [LAKE, bad])
    with pytest.raises(SourceError, match="feature 2, polygon 2, ring 2: a coordinate is not finite"):
        read_extent(path, name)


def test_a_point_without_an_image_is_refused_by_name():
    frame = Frame((-6e6, -6e6, 6e6, 6e6), "+proj=ortho +lat_0=90", (1.2e7, 1.2e7))
    far = {"type": "Polygon", "coordinates": [[[0, 80], [10, 80], [10, -80], [0, -80]]]}
    with pytest.raises(SourceError, match="ring 1: it has no place in the reference system of the frame"):
        read_extent(json.dumps(far).encode(), "far.geojson", frame=frame)


TAVEUNI = [(179.9, -17), (-179.8, -17), (-179.8, -16.7), (179.9, -16.7)]
"""Across the antimeridian, as GeoJSON's writers should not but do give it."""


@pytest.mark.parametrize("crs", ["EPSG:4326", "OGC:CRS84"])
def test_rings_across_the_antimeridian_are_taken_as_such(tmp_path, crs):
    hole = [(-179.95, -16.9), (-179.9, -16.9), (-179.9, -16.8), (-179.95, -16.8)]
    path = file(tmp_path, "fiji.gpkg", [shapely.Polygon(TAVEUNI, [hole])], crs)
    extent = read_extent(path, "fiji.gpkg")
    np.testing.assert_allclose(extent.frame.bounds, (179.9, -17, 180.2, -16.7))
    expected = shapely.difference(shapely.box(179.9, -17, 180.2, -16.7), shapely.box(180.05, -16.9, 180.1, -16.8))
    assert same(only(extent), expected)
    for bounds in [(179.9, -17, -179.8, -16.7), (-180.1, -17, -179.8, -16.7)]:
        again = only(read_extent(path, "fiji.gpkg", bounds=bounds))
        np.testing.assert_allclose(land(again).area, expected.area)


def test_polygons_cut_at_the_antimeridian_are_put_together(tmp_path):
    halves = shapely.MultiPolygon([shapely.box(179.9, -17, 180, -16.7), shapely.box(-180, -17, -179.8, -16.7)])
    path = file(tmp_path, "fiji.fgb", [halves], "EPSG:4326")
    extent = read_extent(path, "fiji.fgb")
    np.testing.assert_allclose(extent.frame.bounds, (179.9, -17, 180.2, -16.7))
    assert same(only(extent), shapely.box(179.9, -17, 180.2, -16.7))


def test_a_frame_in_metres_may_lie_across_the_antimeridian(tmp_path):
    path = file(tmp_path, "fiji.gpkg", [shapely.Polygon(TAVEUNI)], "EPSG:4326")
    corners = transformed(np.array(TAVEUNI), "EPSG:4326", "EPSG:3460")
    (west, south), (east, north) = corners.min(axis=0), corners.max(axis=0)
    drawing = only(read_extent(path, "fiji.gpkg", frame=frame_around((west, south, east, north), "EPSG:3460")))
    assert same(drawing, shapely.Polygon(corners), 1e-3)
    back = written(tmp_path / "metres.gpkg", [shapely.Polygon(corners)], "EPSG:3460")
    frame = frame_around((179.9, -17, -179.8, -16.7), "EPSG:4326")
    assert same(only(read_extent(back, "metres.gpkg", frame=frame)), shapely.box(179.9, -17, 180.2, -16.7), 1e-3)


def test_a_map_of_the_world_is_no_ring_across_the_antimeridian(tmp_path):
    world = shapely.box(-180, -90, 180, 90)
    path = file(tmp_path, "world.gpkg", [world], "EPSG:4326")
    around = shapely.box(-192, -90, 192, 90)  # it goes on beyond the frame
    assert same(only(read_extent(path, "world.gpkg")), around)
    coast = [(lon, -70 + 5 * np.sin(lon)) for lon in range(180, -181, -10)]
    antarctica = shapely.Polygon([(-180, -90), (180, -90), *coast])
    south = only(read_extent(file(tmp_path, "south.gpkg", [antarctica], "EPSG:4326"), "south.gpkg"))
    np.testing.assert_allclose(shapely.intersection(land(south), world).area, antarctica.area)
    whole = only(read_extent(path, "world.gpkg", bounds=(170, -10, -170, 10)))
    np.testing.assert_allclose(land(whole).bounds, [*(whole.to_source @ (0, 0, 1)), *(whole.to_source @ (1, 1, 1))])


def test_a_ring_around_a_pole_is_refused_by_name(tmp_path):
    ring = shapely.Polygon([(lon, 80) for lon in range(-180, 180, 10)])
    path = file(tmp_path, "arctic.gpkg", [shapely.MultiPolygon([shapely.box(0, 0, 1, 1), ring])], "EPSG:4326")
    with pytest.raises(SourceError, match=r"feature 1, polygon 2, ring 1 goes around a pole.*polar"):
        read_extent(path, "arctic.gpkg")
    disc = shapely.Point(0, 0).buffer(1e6)
    path = file(tmp_path, "disc.gpkg", [disc], "EPSG:3413")
    assert same(only(read_extent(path, "disc.gpkg")), disc)
    part = only(read_extent(path, "disc.gpkg", frame=frame_around((0, 80, 10, 85), "EPSG:4326")))
    assert land(part).bounds[1] == pytest.approx(
        transformed(np.array([[0, 1e6]]), "EPSG:3413", "EPSG:4326")[0, 1], 1e-3
    )
    with pytest.raises(SourceError, match="ring 1 goes around a pole"):
        read_extent(path, "disc.gpkg", frame=frame_around((-180, 70, 180, 90), "EPSG:4326"))


@pytest.mark.parametrize("share", [0.02, 0.3, 0.6, 0.95, 0.999])
@pytest.mark.parametrize("name", ["lake.gpkg", "lake.fgb", "lake.zip", "lake.geojson"])
def test_a_file_that_breaks_off_is_one_line_and_nothing_on_stderr(tmp_path, name, share, capfd):
    rng = np.random.default_rng(1)
    shapes = [shapely.Point(*centre).buffer(50, 64) for centre in rng.uniform(0, 1e5, (200, 2))]
    path = file(tmp_path, name, shapes)
    content = path.read_bytes()
    path.write_bytes(content[: int(share * len(content))])
    capfd.readouterr()
    with pytest.raises(SourceError) as raised:
        read_extent(path, name)
    assert str(raised.value).count("\n") == 0
    assert "/vsi" not in str(raised.value)
    assert capfd.readouterr() == ("", "")


@given(data=st.data())
@settings(max_examples=150)
def test_random_damage_is_one_line_or_a_drawing(tmp_path_factory, data):
    name = data.draw(st.sampled_from(["lake.gpkg", "lake.fgb", "lake.zip"]))
    content = bytearray(file(tmp_path_factory.mktemp("damage"), name).read_bytes())
    for _ in range(data.draw(st.integers(1, 8))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    line = ""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        try:
            read_extent(bytes(content), name, crs=UTM)
        except VextureError as error:
            line = str(error)
    assert "\n" not in line


def inside_zip(**files):
    packed = BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for name, content in files.items():
            archive.writestr(name.replace("_", "."), content)
    return packed.getvalue()


VRT = b"""<OGRVRTDataSource><OGRVRTLayer name="a"><SrcDataSource>/etc/passwd</SrcDataSource></OGRVRTLayer>
</OGRVRTDataSource>"""
PIPELINE = b'{"type": "gdal_streamed_alg", "command_line": "gdal vector read /vsicurl/http://127.0.0.1/a.gpkg"}'


@pytest.mark.parametrize(
    ("content", "name", "line"),
    [
        (VRT, "a.gpkg", "none of GeoJSON, GeoPackage"),
        (VRT, "a.shp", "none of GeoJSON, GeoPackage"),
        (PIPELINE, "a.gdalg.json", "'gdal_streamed_alg' is none that GeoJSON knows"),
        (b"SQLite format 3\0" + bytes(200), "a.gpkg", "no GeoPackage"),
        (inside_zip(a_vrt=VRT), "a.zip", "holds no shapefile"),
        (inside_zip(a_shp=VRT, a_shx=VRT), "a.zip", "no layers"),
        (inside_zip(a_shp=b"\0\0\x27\x0a" + bytes(200)), "a.zip", r"lacks its a\.shx"),
        (b"PK\x03\x04", "a.zip", "damaged"),
        (b"fgb\x03fgb", "a.fgb", "no layers"),
        (b"", "a.gpkg", "none of GeoJSON, GeoPackage"),
        (b"", "a.geojson", "not JSON"),
        (b"[1, 2]", "a.geojson", "not GeoJSON"),
    ],
)
def test_only_the_formats_meant_here_are_opened(content, name, line):
    with pytest.raises(SourceError, match=line) as raised:
        read_extent(content, name)
    assert str(raised.value).count("\n") == 0


@pytest.mark.parametrize(
    "name", ["/vsicurl/http://127.0.0.1:9/a.gpkg", "http://127.0.0.1:9/a.gpkg", "absent.gpkg", "a\0.shp"]
)
def test_a_name_is_that_of_a_file_on_the_disk_or_of_none(name):
    with pytest.raises(SourceError, match="cannot be read"):
        read_extent(name, "a.gpkg")


def test_names_with_marks_are_names(tmp_path):
    folder = tmp_path / "a!b?c#d"
    folder.mkdir()
    for name in FORMATS:
        file(tmp_path, name)
    for path in list(tmp_path.glob("lake.*")):
        path.rename(folder / path.name.replace("lake", "water!lake", 1))
    for name in FORMATS:
        path = folder / f"water!{name}"
        assert same(only(read_extent(path, path.name, crs=UTM)), shapely.union(LAKE, POND)), name


def test_a_shapefile_without_its_index_says_so(tmp_path):
    path = file(tmp_path, "lake.shp")
    path.with_suffix(".shx").unlink()
    with pytest.raises(SourceError, match=r"lake\.shp lacks its lake\.shx"):
        read_extent(path, "lake.shp")


def test_a_parameter_of_depths_is_refused(tmp_path):
    path = file(tmp_path, "lake.gpkg")
    for option in ({"time_dim": "time"}, {"variable": "depth"}):
        with pytest.raises(LimitError, match=r"is for depths, and this file holds polygons"):
            read_extent(path, "lake.gpkg", **option)


@st.composite
def stars(draw):
    """Polygons with a hole around a place, in units of their size."""
    seed = draw(st.integers(0, 2**32 - 1))
    rng = np.random.default_rng(seed)
    count = draw(st.integers(5, 60))
    angle = np.sort(rng.uniform(0, 2 * np.pi, count))
    if np.diff(angle, append=angle[0] + 2 * np.pi).max() > 3.0:
        angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    radius = rng.uniform(0.6, 1.0, count)
    way = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    inner = np.linspace(0, 2 * np.pi, 7, endpoint=False) + rng.uniform(0, 1)
    hole = 0.05 * np.stack([np.cos(inner), np.sin(inner)], axis=1)
    return way * radius[:, None], hole[:: draw(st.sampled_from([1, -1]))]


PLACES = {
    "EPSG:32610": (587000, 4090000, 3000),
    "EPSG:28992": (85000, 447000, 500),
    "EPSG:2227": (6e6, 2e6, 9000),
    "EPSG:4326": (-122.0, 36.9, 0.1),
    "EPSG:3857": (-1.36e7, 4.4e6, 5000),
    "EPSG:3413": (1e5, -2e6, 1e4),
    "EPSG:4258": (179.99, 10, 0.05),
}


@given(star=stars(), crs=st.sampled_from(sorted(PLACES)), name=st.sampled_from(FORMATS))
@settings(max_examples=60)
def test_a_random_polygon_keeps_its_area_and_maps_back(tmp_path_factory, star, crs, name):
    x, y, size = PLACES[crs]
    shell, hole = (np.array([x, y]) + size * ring for ring in star)
    shape = shapely.Polygon(shell, [hole])
    path = file(tmp_path_factory.mktemp("star"), name, [shape], crs)
    # GDAL writes GeoJSON of degrees with 7 decimals
    precision = 1e-6 if name.endswith("json") else 1e-9
    drawing = only(read_extent(path, name, crs=crs))
    to_unit = [1 / drawing.to_source[0, 0], 0, 0, 1 / drawing.to_source[1, 1]]
    to_unit += [-drawing.to_source[0, 2] * to_unit[0], -drawing.to_source[1, 2] * to_unit[3]]
    unit = shapely.affinity.affine_transform(shape, to_unit)
    plain = shapely.affinity.affine_transform(land(drawing), to_unit)
    np.testing.assert_allclose(plain.area, unit.area, rtol=max(precision * abs(x) / size, 1e-9))
    found = np.concatenate(drawing.paths[0].contours)[:, 0] @ drawing.to_source[:, :2].T + drawing.to_source[:, 2]
    expected = np.concatenate([shell, hole])
    nearest = np.abs(found[:, None] - expected).max(axis=2).min(axis=1)
    assert len(found) == len(expected)
    assert nearest.max() <= precision * max(abs(x), abs(y))
