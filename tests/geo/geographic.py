"""Files of geographic data for tests, written by GDAL."""

import sqlite3
import warnings
import zipfile
from contextlib import closing

import numpy as np
import pyogrio
import shapely

UTM = "EPSG:32610"
LAKE = shapely.Polygon(
    [(587000, 4090000), (590000, 4089500), (591000, 4092000), (588000, 4093000)],
    [[(588500, 4091000), (589500, 4091000), (589000, 4092000)]],
)
POND = shapely.Polygon([(592000, 4090000), (593000, 4090000), (592500, 4091000)])
FORMATS = ["lake.gpkg", "lake.fgb", "lake.shp", "lake.zip", "lake.geojson"]

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


def zip_shapefile(path):
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


def file(folder, name, shapes=(LAKE, POND), crs=UTM, **options):
    if name.endswith(".zip"):
        return zip_shapefile(written((folder / name).with_suffix(".shp"), shapes, crs, **options))
    return written(folder / name, shapes, crs, **options)


def only(extent):
    (step,) = extent.steps
    assert (step.time, step.depth, extent.bed) == (None, None, None)
    return step.drawing


def same(drawing, shape, tolerance=1e-9):
    return shapely.symmetric_difference(land(drawing), shape).area <= tolerance * shape.area


def geopackage_of(path, head, numbers, kind="POLYGON"):
    """GeoPackage of one geometry that shapely or GDAL would not write: the start of its WKB, then its coordinates."""
    path = written(path, [POND], UTM, kind="Polygon", layer="one")
    blob = b"GP\0\x01" + (32610).to_bytes(4, "little") + bytes.fromhex(head) + np.array(numbers, "<f8").tobytes()
    with closing(sqlite3.connect(path)) as base, base:
        for (trigger,) in base.execute("select name from sqlite_master where type = 'trigger'").fetchall():
            base.execute(f'drop trigger "{trigger}"')
        base.execute("update gpkg_geometry_columns set geometry_type_name = ?, z = 2, m = 2", (kind,))
        base.execute("update one set geom = ?", (blob,))
    return path
