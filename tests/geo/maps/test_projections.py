"""Maps of the world in other projections: nothing smears where they are torn, poles are whole, lines are curved."""

import numpy as np
import pytest
import shapely
from projected import EQUAL_EARTH, ROBINSON, RUSSIA, WORLD, frame, in_system

from vexture_geo.base.crs import transform_points
from vexture_geo.maps import MapLayer, convert_map


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


def test_a_projected_source_is_on_a_map_of_the_world():
    done = convert_map([MapLayer(frame([shapely.box(0, 3e5, 2e5, 6e5)], "EPSG:28992"))], crs=EQUAL_EARTH)
    (root,) = done.conversion.texture.roots
    place = transform_points(np.array([[1e5, 4.5e5]]), "EPSG:28992", EQUAL_EARTH)
    assert done.conversion.texture.element_at((place - root.to_source[:, 2]) / root.to_source[0, 0]).name == ["0"]
