"""Sources of maps, maps of them, and what is at a place."""

import geopandas
import numpy as np
import shapely

from vexture_geo.maps import MapLayer, convert_map

METRES = "EPSG:28992"


def cells(count=200, seed=3):
    """Voronoi cells in a square of a kilometre: a coverage without gaps."""
    points = shapely.multipoints(np.random.default_rng(seed).uniform(0, 1000, (count, 2)))
    parts = shapely.get_parts(shapely.voronoi_polygons(points, extend_to=shapely.box(0, 0, 1000, 1000)))
    shapes = shapely.intersection(parts, shapely.box(0, 0, 1000, 1000))
    values = np.arange(count, dtype=float)
    return geopandas.GeoDataFrame(
        {"code": [f"c{k}" for k in range(count)], "value": values}, geometry=shapes, crs=METRES
    )


def frame(shapes, crs="EPSG:4326", **columns):
    return geopandas.GeoDataFrame(columns, geometry=shapes, crs=crs)


def mapped(source, crs=METRES, **options):
    """A map of one layer."""
    chosen = {name: options.pop(name) for name in ("snap", "size", "restyle") if name in options}
    return convert_map([MapLayer(source, **options)], crs=crs, **chosen)


def names_at(done, points):
    """Ids of the features at points in the units of the map."""
    (root,) = done.conversion.texture.roots
    return done.conversion.texture.element_at((points - root.to_source[:, 2]) / root.to_source[0, 0]).name


def messages(done):
    return [str(note) for note in done.conversion.notes]


def overlapping():
    return [shapely.box(0, 0, 600, 600), shapely.box(500, 500, 1000, 1000), shapely.box(1000, 0, 1200, 200)]
