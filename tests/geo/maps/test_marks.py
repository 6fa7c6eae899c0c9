"""Outlines of polygons, which have none where a map of the world is cut."""

import geopandas
import numpy as np
import pytest
import shapely

from vexture.base.notes import Notes
from vexture_geo.base.crs import transform_points
from vexture_geo.maps.marks import outlines, width_of
from vexture_geo.maps.place import place_features
from vexture_geo.vector.features import read_features

WORLD = "EPSG:4326"
FIJI = shapely.MultiPolygon([shapely.box(177, -19, 180, -17), shapely.box(-180, -19, -178, -17)])


def frame(shapes, **columns):
    return geopandas.GeoDataFrame(columns or {"v": range(len(shapes))}, geometry=shapes, crs=WORLD)


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
