"""Sides longer than half the world: which way they go is said."""

import geopandas
import pytest
import shapely

from vexture_geo.base.longitudes import CLEAR_JUMP
from vexture_geo.maps.convert import convert_map
from vexture_geo.maps.prepare import MapLayer
from vexture_geo.readers import read_extent

WIDE = shapely.box(-100, 0, 100, 20)


def said(shape: shapely.Geometry) -> list[str]:
    frame = geopandas.GeoDataFrame(geometry=[shape], crs="EPSG:4326")
    notes = convert_map([MapLayer(frame)]).conversion.notes
    return [note.message for note in notes if "go the other way around" in note.message]


@pytest.mark.parametrize("shape", [WIDE, shapely.LineString([(-100, 0), (100, 20)])], ids=["polygon", "line"])
def test_a_side_that_may_be_meant_to_be_long_is_named(shape):
    (message,) = said(shape)
    assert "such as one of 200 of 360" in message


def test_the_remedy_makes_it_as_long_as_it_is_meant_to_be():
    assert said(shapely.segmentize(WIDE, 100)) == []


def test_a_border_across_the_antimeridian_is_not_named():
    assert said(shapely.Polygon([(170, 0), (-170, 0), (-170, 20), (170, 20)])) == []
    assert CLEAR_JUMP < 340 / 360


def test_a_flood_says_so_too(tmp_path):
    geopandas.GeoDataFrame(geometry=[WIDE], crs="EPSG:4326").to_file(tmp_path / "wide.gpkg")
    with pytest.warns(UserWarning, match="go the other way around; give a side"):
        read_extent(tmp_path / "wide.gpkg")
