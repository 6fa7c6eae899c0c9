"""The edge of the world: what lies near it is together, and is no border of anything."""

import geopandas
import numpy as np
import pytest
import shapely

from vexture_geo.maps import MapLayer, convert_map
from vexture_geo.maps.place import RADIUS

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
