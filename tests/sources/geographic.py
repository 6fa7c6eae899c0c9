"""Files of geographic data for tests, written by GDAL."""

import warnings
import zipfile

import numpy as np
import pyogrio
import shapely

SUFFIX = {"GPKG": ".gpkg", "FlatGeobuf": ".fgb", "ESRI Shapefile": ".shp", "GeoJSON": ".geojson"}


def written(path, shapes, crs="EPSG:32610", driver=None, kind="Unknown", layer=None, append=False):
    """Write geometries (None: a feature without), and return the path."""
    driver = driver or next(name for name, suffix in SUFFIX.items() if suffix == path.suffix)
    blobs = np.array([None if shape is None else shapely.to_wkb(shape, flavor="iso") for shape in shapes], object)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        pyogrio.raw.write(
            path,
            geometry=blobs,
            field_data=[np.arange(len(blobs))],
            fields=["number"],
            geometry_type=kind,
            crs=crs,
            driver=driver,
            layer=layer,
            append=append,
        )
    return path


def zipped(path):
    """Zip a shapefile and its siblings, and return the path of the zip."""
    archive = path.with_suffix(".zip")
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as file:
        for each in sorted(path.parent.glob(f"{path.stem}.*")):
            if each != archive:
                file.write(each, f"data/{each.name}")
    return archive


def land(drawing):
    """The area of a drawing in the units of its source, as shapely has it: by winding numbers."""
    pieces = []
    for path in drawing.paths:
        for contour in path.contours:
            points = contour[:, 0] @ drawing.to_source[:, :2].T + drawing.to_source[:, 2]
            pieces.append(shapely.Polygon(points))
    outer = [piece for piece in pieces if piece.exterior.is_ccw]
    holes = [piece for piece in pieces if not piece.exterior.is_ccw]
    return shapely.difference(shapely.union_all(outer), shapely.union_all(holes))
