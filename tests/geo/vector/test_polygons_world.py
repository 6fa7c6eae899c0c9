"""Flood polygons in the world: frames, bounds, other reference systems, the antimeridian and the poles."""

import gzip
import json
import warnings

import numpy as np
import pytest
import shapely
from geographic import FORMATS, LAKE, POND, UTM, file, land, only, same, written
from hypothesis import given, settings
from hypothesis import strategies as st

import vexture
from vexture.base.errors import SourceError, SourceWarning
from vexture_geo.base.crs import frame_around, transform_points
from vexture_geo.base.extent import Frame
from vexture_geo.base.longitudes import close_over_poles, jumping, unwrap_rings
from vexture_geo.base.rings import rings_of
from vexture_geo.readers import read_extent


def test_a_frame_decides_and_the_data_is_transformed_into_it(tmp_path):
    path = file(tmp_path, "lake.gpkg")
    frame = frame_around((-122.05, 36.93, -121.90, 37.0), "EPSG:4326")
    extent = read_extent(path, "lake.gpkg", frame=frame)
    assert extent.frame == frame
    drawing = only(extent)
    corners = np.concatenate([ring.coords[:-1] for ring in (LAKE.exterior, LAKE.interiors[0], POND.exterior)])
    expected = transform_points(corners, UTM, "EPSG:4326")
    found = np.concatenate(drawing.paths[0].contours)[:, 0] @ drawing.to_source[:, :2].T + drawing.to_source[:, 2]
    gaps = np.hypot(*(found[:, None] - expected).T).min(axis=1)
    assert gaps.max() < 1e-12 * 180
    texture = vexture.convert(drawing)
    ground = np.array([[588000.0, 4090500.0], [589000.0, 4091200.0], [592500.0, 4090300.0], [591500.0, 4090300.0]])
    places = (transform_points(ground, UTM, "EPSG:4326") - drawing.to_source[:, 2]) / drawing.to_source.diagonal()
    assert texture.contains(places).tolist() == [True, False, True, False]


@pytest.mark.parametrize("beyond", [(-500, 0), (500, 0), (0, -500), (0, 500)])
def test_what_leaves_the_square_on_one_side_is_cut_there(tmp_path, beyond):
    box = shapely.box(40, 40, 60, 60)
    shape = shapely.convex_hull(shapely.union(box, shapely.affinity.translate(box, *beyond)))
    drawing = only(read_extent(file(tmp_path, "strip.gpkg", [shape]), "strip.gpkg", bounds=(0, 0, 100, 100)))
    square = shapely.box(*(drawing.to_source @ (0, 0, 1)), *(drawing.to_source @ (1, 1, 1)))
    assert same(drawing, shapely.intersection(shape, square))


def test_a_long_side_that_bends_in_the_frames_system_is_followed(tmp_path):
    box = shapely.box(0, 40, 40, 70)
    path = file(tmp_path, "europe.gpkg", [box], "EPSG:4326")
    drawing = only(read_extent(path, "europe.gpkg", frame=frame_around((2.5e6, 1.5e6, 7e6, 6e6), "EPSG:3035")))
    assert 20 < drawing.segments < 4000
    rim = shapely.get_coordinates(shapely.segmentize(box, 0.5))
    exact = shapely.Polygon(transform_points(rim, "EPSG:4326", "EPSG:3035"))
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


def test_coordinates_in_metres_without_a_system_are_no_degrees():
    plain = json.dumps(shapely.geometry.mapping(LAKE)).encode()
    with pytest.raises(SourceError, match=r"cannot be longitudes and latitudes; .*`crs`"):
        read_extent(plain, "lake.geojson")
    assert same(only(read_extent(plain, "lake.geojson", crs=UTM)), LAKE)
    assert same(only(read_extent(gzip.compress(plain), "lake.geojson", crs=UTM)), LAKE)


UNUSED = "+proj=tmerc +lat_0=3 +lon_0=7 +x_0=12345 +ellps=bessel"
"""A system of which no area of use is known."""


@pytest.mark.parametrize(
    ("shape", "crs", "bounds", "hint"),
    [
        (LAKE, UTM, (0, 0, 10, 10), "the bounds look like degrees"),
        (shapely.box(-6, 42, 12, 53), UNUSED, (80000, 440000, 90000, 450000), "look like degrees: give `crs` EPSG"),
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


@pytest.mark.parametrize("shapes", [[], [None], [shapely.Polygon()]])
def test_without_polygons_all_is_dry_within_the_bounds(tmp_path, shapes):
    path = file(tmp_path, "dry.gpkg", shapes)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        drawing = only(read_extent(path, "dry.gpkg", bounds=(0, 0, 10, 10)))
    assert (drawing.paths, drawing.crs) == ((), UTM)
    np.testing.assert_allclose(drawing.to_source @ (0.5, 0.5, 1), (5, 5))
    with pytest.raises(SourceError, match=r"no polygon.*give `bounds`"):
        read_extent(path, "dry.gpkg")


def test_a_point_without_an_image_is_refused_by_name():
    frame = Frame((-6e6, -6e6, 6e6, 6e6), "+proj=ortho +lat_0=90", (1.2e7, 1.2e7))
    far = {"type": "Polygon", "coordinates": [[[0, 80], [10, 80], [10, -80], [0, -80]]]}
    with pytest.raises(SourceError, match=r"ring 1: a point is at inf,inf; .* no place in the reference system"):
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
    corners = transform_points(np.array(TAVEUNI), "EPSG:4326", "EPSG:3460")
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


@pytest.mark.parametrize(
    "corners",
    [
        [(-180, -90), (180, -90), (180, -60), (0, -60), (0, 60), (180, 60), (180, 90), (-180, 90)],
        [(-180, -90), (180, -90), (180, -80), (90, 0), (180, 65), (180, 90), (-180, 90), (-180, 65), (-120, 0)],
        [(-180, -90), (180, -90), (180, 80), (-180, 80), (-170, 70)],
        [(-180, 0), (180, 10), (-180, 20)],
    ],
    ids=["E", "both poles", "one upright side", "wedge"],
)
def test_sides_around_the_whole_world_keep_their_length(corners):
    shape = shapely.Polygon(corners)
    rings = rings_of(np.array([shape, shapely.reverse(shape)]), str)
    for found in unwrap_rings(rings, 360.0).shapes:
        assert found.equals(shape)
    assert not jumping(rings, 360.0).any()
    assert close_over_poles(rings, 360.0)[1] == 0


def test_a_ring_that_changes_the_side_of_the_antimeridian_on_it_lies_across_it():
    corners = [(170, 60), (180, 60), (-180, 60), (-170, 60), (-170, 70), (-180, 70), (180, 70), (170, 70)]
    stairs = [*corners[:2], (180, 61), (-180, 61), (-180, 62), (-170, 62), *corners[4:]]
    rings = rings_of(np.array([shapely.Polygon(corners), shapely.Polygon(stairs)]), str)
    across, steps = unwrap_rings(rings, 360.0).shapes
    assert across.equals(shapely.box(170, 60, 190, 70))
    assert steps.bounds == (170, 60, 190, 70)
    assert steps.is_valid


def test_a_coast_that_jumps_twice_beside_the_edge_of_a_map_keeps_its_pole():
    coast = [(180, -80), (-179, -79), (179, -78), *((lon, -70) for lon in range(170, -180, -10)), (-180, -80)]
    rings = rings_of(np.array([shapely.Polygon([(-180, -90), (180, -90), *coast])]), str)
    (found,) = unwrap_rings(rings, 360.0).shapes
    assert found.bounds == (-180, -90, 181, -70)
    assert found.is_valid


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
        transform_points(np.array([[0, 1e6]]), "EPSG:3413", "EPSG:4326")[0, 1], 1e-3
    )
    with pytest.raises(SourceError, match="ring 1 goes around a pole"):
        read_extent(path, "disc.gpkg", frame=frame_around((-180, 70, 180, 90), "EPSG:4326"))


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


def test_what_holds_something_else_is_no_empty_flood():
    point = b'{"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [4, 52]}}'
    with pytest.raises(SourceError, match=r"no polygon \(left out: Point\); give polygons of what is under water"):
        read_extent(point, "well.geojson", bounds=(3, 51, 5, 53))
