"""Features on maps of other projections."""

import geopandas
import shapely

from vexture.base.notes import Notes
from vexture_geo.maps.place import place_features
from vexture_geo.vector.features import read_features

WORLD = "EPSG:4326"
EQUAL_EARTH, ROBINSON, SOUTH, NORTH = "EPSG:8857", "ESRI:54030", "EPSG:3031", "EPSG:3995"
RUSSIA = shapely.box(30, 50, 190, 75)


def frame(shapes, crs=WORLD, **columns):
    return geopandas.GeoDataFrame(columns, geometry=shapes, crs=crs)


def in_system(shapes, crs, source=WORLD):
    """Features of shapes in another system, and the notes."""
    notes = Notes()
    return place_features(read_features(frame(shapes, source), notes=notes), crs, notes), [
        str(note) for note in notes.in_order
    ]
