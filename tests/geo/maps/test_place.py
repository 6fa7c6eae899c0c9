"""Maps of the world in projections that tear it apart: nothing is drawn across, nothing is lost."""

import geopandas
import numpy as np
import pyproj
import pytest
import shapely

from vexture.base.notes import Notes
from vexture_geo.maps.place import place_features
from vexture_geo.vector.features import read_features

BOXES = [(165.0, -20.0, 190.0, 15.0), (-40.0, 30.0, -20.0, 50.0), (-190.0, 50.0, -160.0, 70.0), (0.0, 0.0, 5.0, 5.0)]
CAP = shapely.Polygon([(longitude, -70.0) for longitude in range(175, -180, -10)])


def area(box):
    """Square metres of a rectangle between parallels."""
    outline = shapely.segmentize(shapely.box(*box), 0.05)
    return abs(pyproj.Geod(ellps="WGS84").geometry_area_perimeter(outline)[0])


def wrapped(box):
    """A rectangle in longitudes from -180 to 180: one across the antimeridian jumps."""
    return shapely.transform(shapely.box(*box), lambda xy: np.stack([(xy[:, 0] + 180) % 360 - 180, xy[:, 1]], axis=1))


@pytest.mark.parametrize("crs", ["EPSG:8857", "+proj=eqearth +lon_0=150", "EPSG:5070", "ESRI:54034"])
def test_a_map_that_keeps_areas_keeps_them_where_it_is_torn(crs):
    frame = geopandas.GeoDataFrame(geometry=[*map(wrapped, BOXES), CAP], crs="EPSG:4326")
    rings = place_features(read_features(frame, notes=Notes()), crs, Notes()).rings
    shapes = rings.shapes
    found = np.bincount(rings.feature, shapely.area(shapes))
    true = [*map(area, BOXES), area((-180.0, -90.0, 180.0, -70.0))]
    np.testing.assert_allclose(found, true, rtol=5e-4)  # sides bend by 1e-5 of the map
    assert shapely.is_valid(shapes).all()
    widths = (rings.boxes[:, 1] - rings.boxes[:, 0])[rings.feature < len(BOXES), 0]
    assert widths.max() < 5e6
