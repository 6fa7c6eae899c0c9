"""The edge of the world: what lies near it is together, and is no border of anything."""

import geopandas
import numpy as np
import pytest
import shapely

from vexture.base.notes import Notes
from vexture_geo.base.crs import transform_points
from vexture_geo.maps import MapLayer, convert_map
from vexture_geo.maps.marks import outlines, width_of
from vexture_geo.maps.place import RADIUS, place_features
from vexture_geo.vector.features import read_features

WORLD = "EPSG:4326"
FIJI = shapely.MultiPolygon([shapely.box(177, -19, 180, -17), shapely.box(-180, -19, -178, -17)])


def frame(shapes, **columns):
    return geopandas.GeoDataFrame(columns or {"v": range(len(shapes))}, geometry=shapes, crs=WORLD)


@pytest.mark.parametrize("crs", ["EPSG:3857", WORLD])
def test_points_and_lines_are_beside_the_polygons_across_the_antimeridian(crs):
    marks = [shapely.Point(-179, -16), shapely.LineString([(-179.5, -20), (-178.5, -20)]), shapely.Point(178, -16)]
    turn = 2 * np.pi * RADIUS if crs == "EPSG:3857" else 360.0
    layers = [MapLayer(frame([FIJI])), MapLayer(frame(marks))]
    for given in (layers, [MapLayer(frame([FIJI, *marks]))]):
        done = convert_map(given, crs=crs)
        assert done.conversion.drawing.to_source[0, 0] == pytest.approx(turn * 5 / 360, rel=0.05)
    alone = convert_map([layers[1]], crs=crs)
    assert alone.conversion.drawing.to_source[0, 0] == pytest.approx(turn * 4 / 360, rel=0.3)


@pytest.mark.parametrize(("crs", "unit"), [("EPSG:3857", np.pi * RADIUS / 180), (WORLD, 1.0)])
def test_most_of_a_map_across_the_antimeridian_is_where_its_system_has_it(crs, unit):
    counties = [shapely.box(x, 30, x + 5, 45) for x in range(-120, -70, 5)]
    aleutians = shapely.MultiPolygon([shapely.box(172, 51, 180, 53), shapely.box(-180, 51, -165, 53)])
    marks = [shapely.Point(144.7, 13.5), shapely.LineString([(-160, 20), (-155, 20)])]
    for given, west in (([*counties, aleutians], 172), ([*counties, aleutians, *marks], 144.7)):
        to_source = convert_map([MapLayer(frame(given))], crs=crs).conversion.drawing.to_source
        assert to_source[0, 2] == pytest.approx((west - 360) * unit, rel=0.01)
        assert to_source[0, 0] + to_source[0, 2] == pytest.approx(-70 * unit, rel=0.01)


def test_what_goes_around_the_world_stays_where_it_is():
    marks = [shapely.Point(x, 10) for x in range(-170, 180, 20)]
    done = convert_map([MapLayer(frame([FIJI])), MapLayer(frame(marks))])
    assert done.conversion.drawing.to_source[0, 0] > 2 * np.pi * RADIUS * 0.95


def bordered(shapes, crs):
    """The area of the outlines of polygons on a map, less than half a degree wide."""
    rings = place_features(read_features(frame(shapes), notes=Notes()), crs, Notes()).rings
    return shapely.union_all(outlines(rings, width_of("2px", "width"), crs, 0.2 if crs == WORLD else 2e4).shapes)


BAND = shapely.box(-179.999, 20, 179, 30)


@pytest.mark.parametrize(
    ("crs", "across", "shapes"),
    [
        ("EPSG:3857", 180.0, [FIJI, BAND]),
        (WORLD, 180.0, [FIJI, BAND]),
        ("EPSG:8857", 179.9999, [FIJI]),
        ("ESRI:54030", 179.9999, [shapely.box(170, -30, 190, -10)]),
        ("+proj=ortho +lat_0=0 +lon_0=90", 179.89, [shapely.box(170, 20, 190, 40)]),
        ("ESRI:54052", -39.9999, [shapely.box(-50, 20, 20, 40), shapely.box(170, 20, 179, 30)]),
    ],
)
def test_a_map_of_the_world_has_no_outlines_where_it_is_cut(crs, across, shapes):
    drawn = bordered(shapes, crs)
    _, south, _, north = shapes[0].bounds
    *cut, real = transform_points(
        np.array([*((across, y) for y in np.arange(south + 1, north)), (178, south)]), WORLD, crs
    )
    assert not shapely.intersects_xy(drawn, *np.transpose(cut)).any()
    assert shapely.intersects_xy(drawn, *real)


def test_neither_a_pole_nor_the_equator_around_a_hemisphere_is_a_border():
    ice = shapely.box(-180, -90, 180, -70)
    for crs in (WORLD, "EPSG:8857"):
        pole, coast = transform_points(np.array([(10.0, -90.0), (10.0, -70.0)]), WORLD, crs)
        drawn = bordered([ice], crs)
        assert not shapely.intersects_xy(drawn, *pole)
        assert shapely.intersects_xy(drawn, *coast)
    africa = shapely.box(10, -30, 40, 30)
    drawn = bordered([africa, shapely.box(-100, -80, -90, -70)], "EPSG:3031")
    equator, side = transform_points(np.array([(25.0, -0.001), (10.0, -20.0)]), WORLD, "EPSG:3031")
    assert not shapely.intersects_xy(drawn, *equator)
    assert shapely.intersects_xy(drawn, *side)
