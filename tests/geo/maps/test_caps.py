"""Maps of one side of the globe, and of a hemisphere around a pole, are caps."""

import numpy as np
import pytest
import shapely
from projected import NORTH, RUSSIA, SOUTH, WORLD, in_system

from vexture_geo.base.crs import transform_points
from vexture_geo.maps.domain import domain_of

ANTARCTICA = shapely.Polygon([(longitude, -70 - 4 * (longitude % 3)) for longitude in range(-180, 181, 5)])


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
