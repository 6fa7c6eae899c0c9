"""Maps of the world in other projections: nothing smears where they are torn, poles are whole, lines are curved."""

import geopandas
import numpy as np
import pytest
import shapely

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture_geo.base.crs import transform_points
from vexture_geo.maps import MapLayer, convert_map
from vexture_geo.maps.domain import domain_of
from vexture_geo.maps.lines import lines_along, rings_along
from vexture_geo.maps.place import place_features
from vexture_geo.vector.features import Lines, read_features

WORLD = "EPSG:4326"
EQUAL_EARTH, ROBINSON, SOUTH, NORTH = "EPSG:8857", "ESRI:54030", "EPSG:3031", "EPSG:3995"


def frame(shapes, crs=WORLD, **columns):
    return geopandas.GeoDataFrame(columns, geometry=shapes, crs=crs)


def in_system(shapes, crs, source=WORLD):
    """Features of shapes in another system, and the notes."""
    notes = Notes()
    return place_features(read_features(frame(shapes, source), notes=notes), crs, notes), [
        str(note) for note in notes.in_order
    ]


RUSSIA = shapely.box(30, 50, 190, 75)
ANTARCTICA = shapely.Polygon([(longitude, -70 - 4 * (longitude % 3)) for longitude in range(-180, 181, 5)])


@pytest.mark.parametrize("crs", [EQUAL_EARTH, ROBINSON, "+proj=moll +lon_0=-90"])
def test_what_lies_across_the_edge_of_a_map_is_on_both_sides_of_it(crs):
    features, _ = in_system([RUSSIA, shapely.box(-170, 0, -20, 10)], crs)
    rings = features.rings
    places = np.random.default_rng(2).uniform((-179.9, -89.0), (179.9, 89.0), (2000, 2))
    tree = shapely.STRtree([RUSSIA, shapely.box(-190, 50, -170, 75), shapely.box(-170, 0, -20, 10)])
    edge = shapely.union_all([tree.geometries[0], tree.geometries[1], tree.geometries[2]])
    clear = shapely.distance(shapely.boundary(edge), shapely.points(places)) > 0.5
    inside = shapely.contains_xy(edge, *places.T)
    found = shapely.contains_xy(shapely.union_all(rings.shapes), *transform_points(places, WORLD, crs).T)
    assert (found == inside)[clear].all()


@pytest.mark.parametrize("crs", ["ESRI:54052", "+proj=igh_o +lon_0=100", "+proj=imoll +lon_0=-30", "+proj=healpix"])
def test_an_interrupted_map_is_cut_at_its_lobes(crs):
    world = [shapely.box(-180, -90, 180, -62), shapely.box(-75, -30, 20, 81), shapely.box(-180, 20, 180, 40)]
    features, said = in_system([*world, shapely.LineString([(-170, 61), (0, 61), (170, 61)])], crs)
    assert not said
    places = np.random.default_rng(3).uniform((-179.9, -89.0), (179.9, 89.0), (3000, 2))
    on_map, shapes = transform_points(places, WORLD, crs), shapely.union_all(features.rings.shapes)
    clear = shapely.distance(shapely.union_all(shapely.boundary(world)), shapely.points(places)) > 0.5
    inside = shapely.contains_xy(shapely.union_all(world), *places.T)
    assert (shapely.contains_xy(shapes, *on_map.T) == inside)[clear].all()
    longest = 0.05 * np.ptp(on_map[:, 0])
    rings = features.rings
    assert np.hypot(*(rings.points[rings.following] - rings.points).T).max() < longest
    assert len(features.lines.ends) > 1
    assert np.hypot(*np.diff(features.lines.points[: features.lines.ends[0]], axis=0).T).max() < longest


@pytest.mark.parametrize("crs", ["+proj=isea", "+proj=bertin1953"])
def test_what_lies_across_a_tear_at_no_meridian_is_told(crs):
    bands = [shapely.box(-180, south, 180, south + 20) for south in range(-80, 80, 20)]
    _, said = in_system(bands, crs)
    assert any("torn, and is smeared over the map; choose another `crs`" in line for line in said)
    assert not in_system([shapely.box(10, 40, 12, 42)], crs)[1]


@pytest.mark.parametrize(("crs", "side"), [(SOUTH, -1), (NORTH, 1), ("EPSG:3571", 1)])
def test_a_map_around_a_pole_is_its_hemisphere(crs, side):
    around = shapely.transform(ANTARCTICA, lambda places: places * (1, -side))
    features, said = in_system([around, shapely.box(10, -30, 50, 30)], crs)
    pole = transform_points(
        np.array([[0.0, side * 90.0], [77.0, side * 80.0], [180.0, side * 80.0], [0.0, side * 62.0]]), WORLD, crs
    )
    (land,) = features.rings.take(np.flatnonzero(features.feature == 0)).shapes
    assert shapely.contains_xy(land, *pole.T).tolist() == [True, True, True, False]
    back = transform_points(features.rings.points, crs, WORLD)
    assert (side * back[:, 1]).min() > -1e-6
    equator = np.hypot(*transform_points(np.array([[30.0, 0.0]]), WORLD, crs)[0])
    assert np.hypot(*features.rings.points.T).max() == pytest.approx(equator, rel=1e-5)
    assert any("cut off at the equator" in line for line in said)


def test_a_band_around_the_world_is_a_ring_around_its_pole():
    features, _ = in_system([shapely.box(-180, -90, 180, -60)], SOUTH)
    radius = np.hypot(*transform_points(np.array([[0.0, -60.0]]), WORLD, SOUTH)[0])
    assert shapely.area(features.rings.shapes).sum() == pytest.approx(np.pi * radius**2, rel=1e-4)


def test_domains():
    assert domain_of("EPSG:3035") is None
    assert domain_of(SOUTH).pole == -90.0
    assert np.allclose(domain_of("+proj=moll +lon_0=-90").box, (-270, -90, 90, 90), atol=1e-4)


def test_a_line_is_curved_where_a_map_bends_it_and_parted_where_it_is_torn():
    parallel = shapely.LineString([(-60, 60), (60, 60)])
    features, _ = in_system([parallel], "EPSG:3035")
    truth = transform_points(np.stack([np.linspace(-60, 60, 2001), np.full(2001, 60.0)], axis=1), WORLD, "EPSG:3035")
    line = shapely.LineString(features.lines.points)
    assert shapely.hausdorff_distance(line, shapely.LineString(truth)) < 2e-5 * np.ptp(truth[:, 0])
    across, _ = in_system([shapely.LineString([(170, 10), (-170, 10)])], EQUAL_EARTH)
    assert len(across.lines.ends) == 2
    assert np.abs(np.diff(across.lines.points[: across.lines.ends[0], 0])).max() < 2e6
    assert across.lines.feature.tolist() == [0, 0]


def test_lines_on_web_mercator_go_on_beyond_the_antimeridian_and_end_at_its_edge():
    features, _ = in_system([shapely.LineString([(179, 10), (-179, 10)])], "EPSG:3857")
    assert np.ptp(features.lines.points[:, 0]) < 3e5
    features, said = in_system([shapely.LineString([(0, 80), (0, 90)])], "EPSG:3857")
    assert features.lines.points[:, 1].max() == pytest.approx(20037508.34, rel=1e-6)
    assert any("85.05" in line for line in said)


def test_there_and_back():
    lines = Lines(np.arange(10.0).reshape(5, 2), np.array([2, 5]), np.array([4, 7]))
    rings = rings_along(lines)
    assert rings.points[:, 0].tolist() == [0, 2, 4, 6, 8, 6]
    again = lines_along(rings)
    assert (again.points == lines.points).all()
    assert again.ends.tolist() == [2, 5]
    assert again.feature.tolist() == [4, 7]


def test_the_world_on_a_map_of_a_country_is_cut_to_where_that_is_used():
    features, said = in_system([shapely.box(-170, -80, 170, 80), shapely.box(4, 51, 5, 52)], "EPSG:28992")
    assert any("cut off at the area of use" in line for line in said)
    assert np.abs(features.rings.points).max() < 1e6
    with pytest.raises(SourceError, match="no place in EPSG:28992"):
        in_system([shapely.box(-100, -80, -90, -70)], "EPSG:28992")


def test_a_projected_source_is_on_a_map_of_the_world():
    done = convert_map([MapLayer(frame([shapely.box(0, 3e5, 2e5, 6e5)], "EPSG:28992"))], crs=EQUAL_EARTH)
    (root,) = done.conversion.texture.roots
    place = transform_points(np.array([[1e5, 4.5e5]]), "EPSG:28992", EQUAL_EARTH)
    assert done.conversion.texture.element_at((place - root.to_source[:, 2]) / root.to_source[0, 0]).name == ["0"]


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    ("crs", "middle", "radius"),
    [
        ("+proj=ortho +lat_0=40 +lon_0=10", (10, 40), 89.9),
        ("ESRI:102038", (-72.533, 42.533), 89.9),
        ("+proj=ortho +lat_0=0 +lon_0=170", (170, 0), 89.9),
        ("ESRI:102034", (0, 90), 65),
        ("+proj=geos +h=35785831 +lon_0=-75", (-75, 0), 81),
        ("+proj=nsper +h=3000000 +lat_0=-50 +lon_0=20", (20, -50), 47),
    ],
)
def test_a_map_of_one_side_of_the_globe_is_cut_at_its_rim(crs, middle, radius):
    world = [RUSSIA, shapely.box(-170, -60, -20, 10), ANTARCTICA, shapely.box(-180, 20, 180, 40)]
    around = shapely.LineString([(-170, 15), (0, 15), (170, 15)])
    marks = [
        around,
        shapely.LineString([(middle[0], -80), (middle[0], 80)]),
        *map(shapely.Point, [middle, (middle[0] + 180, 0)]),
    ]
    features, said = in_system([*world, *marks], crs)
    assert any("one side of the globe: it is cut off" in line for line in said)
    assert "point beyond the map" in said
    places = np.random.default_rng(4).uniform((-179.9, -89.0), (179.9, 89.0), (3000, 2))
    cap = domain_of(crs).cap
    seen = cap.distance(places) < cap.radius - 0.5
    assert cap.radius == pytest.approx(radius, abs=1)
    world += [
        shapely.box(-190, 50, -170, 75),
        shapely.Polygon([*ANTARCTICA.exterior.coords[:-1], (180, -90), (-180, -90)]),
    ]
    world.remove(ANTARCTICA)
    clear = seen & (shapely.distance(shapely.union_all(shapely.boundary(world)), shapely.points(places)) > 0.5)
    found = shapely.contains_xy(shapely.union_all(features.rings.shapes), *transform_points(places, WORLD, crs).T)
    assert (found == shapely.contains_xy(shapely.union_all(world), *places.T))[clear].all()
    assert shapely.is_valid(features.rings.shapes).all()
    line = cap.distance(transform_points(features.lines.points, crs, WORLD))
    assert len(line) > 2
    assert line.max() < cap.radius + 0.05
    assert not in_system([shapely.box(middle[0], middle[1] - 3, middle[0] + 1, middle[1] - 1)], crs)[1]
