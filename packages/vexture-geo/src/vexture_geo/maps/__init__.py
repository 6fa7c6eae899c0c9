"""Maps: features of geographic data as one texture, coloured by their attributes, with a table beside it.

`convert.py` begins; `prepare.py` reads the layers, and `place.py` brings features into the map's reference system;
`coverage.py` closes gaps between polygons and orders overlaps; `colours.py` chooses colours and makes the legend,
`times.py` those of each step of time; `marks.py` makes areas of lines and points; `paths.py` makes the drawing.
"""

from vexture_geo.maps.colours import Scale
from vexture_geo.maps.convert import Map, convert_map
from vexture_geo.maps.prepare import MapLayer
from vexture_geo.maps.times import Times

__all__ = ["Map", "MapLayer", "Scale", "Times", "convert_map"]
