"""A table of four features for tests of tables, and files of it."""

import geopandas
import shapely

NAMES = ["a", "b", "c", "d"]


def squares() -> geopandas.GeoDataFrame:
    """Four squares side by side in metres, the last with a hole."""
    shapes = [shapely.box(k, 0, k + 1, 1) for k in range(3)]
    shapes.append(shapely.Polygon(shapely.box(3, 0, 4, 1).exterior, [shapely.box(3.2, 0.2, 3.8, 0.8).exterior.coords]))
    return geopandas.GeoDataFrame({"name": NAMES, "size": [1, 2, 3, 4]}, geometry=shapes, crs="EPSG:28992")


def save_features(frame, folder, kind):
    """Write a table of features to a file of a kind; return its path."""
    place = folder / f"map.{kind}"
    if kind == "parquet":
        frame.to_parquet(place)
    else:
        frame.to_file(place)
    return place
