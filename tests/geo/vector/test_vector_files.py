"""Files of features in every format have the shapes and attributes of the same data in GeoJSON."""

import sqlite3
import warnings
import zipfile
from contextlib import closing

import geopandas
import numpy as np
import pytest
import shapely

import vexture
from vexture.base.content import FileKind, kind_of, start_of
from vexture.base.errors import LimitError, ParameterError, SourceError
from vexture.base.notes import Notes
from vexture.conversion.reading import content_of, read_drawing
from vexture_geo.base.crs import MissingReferenceError
from vexture_geo.vector.features import read_features

HOLE = shapely.box(4.4, 52.2, 4.6, 52.4).exterior.coords
SHAPES = [shapely.Polygon(shapely.box(4, 52, 5, 53).exterior.coords, [HOLE]), shapely.box(5, 52, 6, 53)]
FRAME = geopandas.GeoDataFrame({"name": ["a", "b"], "size": [1, 2]}, geometry=SHAPES, crs="EPSG:4326")


def saved(path, driver, **options):
    with warnings.catch_warnings(action="ignore"):  # of what writes them
        FRAME.to_file(path, driver=driver, **options)
    return path


def zipped(archive, *paths, folder=""):
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as packed:
        for path in paths:
            packed.write(path, folder + path.name)
    return archive


def geodatabase(folder):
    return saved(folder / "a.gdb", "OpenFileGDB")


def zipped_geodatabase(folder):
    return zipped(folder / "b.zip", *geodatabase(folder).iterdir(), folder="data/a.gdb/")


def zipped_geojson(folder):
    (folder / "read.txt").write_text("not of the map")
    return zipped(folder / "a.zip", saved(folder / "a.geojson", "GeoJSON"), folder / "read.txt", folder="x/")


def without_identifier(folder):
    path = saved(folder / "a.gpkg", "GPKG")
    with closing(sqlite3.connect(path)) as base, base:
        base.execute("pragma application_id = 0")
        base.execute("pragma user_version = 0")
    return path


def csv(folder):
    path = folder / "a.csv"
    path.write_text(FRAME.to_wkt().rename(columns={"geometry": "WKT"}).to_csv(index=False, sep=";"))
    return path


def feather(folder):
    FRAME.to_feather(folder / "a.feather")
    return folder / "a.feather"


WRITERS = {
    "FileGDB": geodatabase,
    "FileGDB in a zip": zipped_geodatabase,
    "KML": lambda folder: saved(folder / "a.kml", "LIBKML"),
    "KMZ in parts": lambda folder: saved(folder / "a.kmz", "LIBKML"),
    "KMZ": lambda folder: zipped(folder / "b.kmz", saved(folder / "doc.kml", "LIBKML")),
    "GML": lambda folder: saved(folder / "a.gml", "GML"),
    "SpatiaLite": lambda folder: saved(folder / "a.sqlite", "SQLite", SPATIALITE="YES", INIT_WITH_EPSG="NO"),
    "SQLite": lambda folder: saved(folder / "a.sqlite", "SQLite"),
    "CSV with WKT": csv,
    "Feather": feather,
    "GeoJSON in a zip": zipped_geojson,
    "a sequence with marks": lambda folder: saved(folder / "a.geojsons", "GeoJSONSeq", RS="YES"),
    "a sequence in lines": lambda folder: saved(folder / "a.geojsonl", "GeoJSONSeq"),
    "a GeoPackage without an identifier": without_identifier,
}


@pytest.mark.parametrize("kind", WRITERS)
def test_every_format_has_the_shapes_and_attributes_of_geojson(kind, tmp_path):
    path = WRITERS[kind](tmp_path)
    crs = "EPSG:4326" if kind == "CSV with WKT" else None
    for source in [path, content_of(path)]:  # a file, or an upload
        found = read_features(source, crs=crs, notes=Notes())
        assert found.crs in ("EPSG:4326", "OGC:CRS84")
        table = found.table.rename_columns([name.lower() for name in found.table.column_names])
        assert table["name"].to_pylist() == ["a", "b"]
        assert [int(size) for size in table["size"].to_pylist()] == [1, 2]  # all values of KML are texts
        assert found.feature.tolist() == [0, 1]
        wrong = shapely.area(shapely.symmetric_difference(found.rings.shapes, SHAPES))
        np.testing.assert_allclose(wrong, 0.0, atol=1e-9)


@pytest.mark.parametrize("kind", WRITERS)
def test_every_format_is_a_drawing(kind, tmp_path):
    path = WRITERS[kind](tmp_path)
    assert path.is_dir() or kind_of(start_of(path)) in (FileKind.AREAS, FileKind.GEOJSON)
    for drawing in (read_drawing(path), read_drawing(content_of(path))):
        areas = []
        for path in drawing.paths:
            area = shapely.Polygon()
            for contour in path.contours:
                ring = contour[:, 0] @ drawing.to_source[:, :2].T + drawing.to_source[:, 2]
                area = shapely.symmetric_difference(area, shapely.Polygon(ring))
            areas.append(area)
        assert shapely.symmetric_difference(shapely.union_all(areas), shapely.union_all(SHAPES)).area < 1e-9


GPX = b"""<gpx xmlns="http://www.topografix.com/GPX/1/1" version="1.1">%s<trk><name>T</name><trkseg>
<trkpt lat="52" lon="4"/><trkpt lat="53" lon="5"/></trkseg></trk></gpx>"""
PLACE = b'<wpt lat="52.5" lon="4.5"><name>W</name></wpt>'


def test_a_gpx_has_the_layers_with_features():
    track = read_features(GPX % b"", notes=Notes())
    assert track.lines.points.tolist() == [[4, 52], [5, 53]]
    assert track.table["name"].to_pylist() == ["T"]
    with pytest.raises(LimitError, match="2 layers; choose one by `layer`: waypoints, tracks"):
        read_features(GPX % PLACE, notes=Notes())
    assert read_features(GPX % PLACE, layer="waypoints", notes=Notes()).points.points.tolist() == [[4.5, 52.5]]
    assert len(read_features(GPX % PLACE, layer="track_points", notes=Notes()).points.points) == 2


MARK = "<Placemark><name>%s</name><Point><coordinates>%d,52</coordinates></Point></Placemark>"
RING = "0,0 1,0 1,1 0,0"
SIDES = f"<outerBoundaryIs><LinearRing><coordinates>{RING}</coordinates></LinearRing></outerBoundaryIs>"
SQUARE = f"<Polygon>{SIDES}</Polygon>"
UNNAMED = ["<Document>%s</Document>", "<Folder>%s</Folder>", "<Document><Folder>%s</Folder></Document>", "%s"]


def kml(content):
    return f'<kml xmlns="http://www.opengis.net/kml/2.2">{content}</kml>'


@pytest.mark.parametrize("around", UNNAMED)
def test_kml_needs_no_names(around, tmp_path):
    (tmp_path / "doc.kml").write_text(kml(around % f"<Placemark><name>a</name>{SQUARE}</Placemark>"))
    for source in [tmp_path / "doc.kml", zipped(tmp_path / "a.kmz", tmp_path / "doc.kml")]:
        found = read_features(source, notes=Notes())
        assert found.table["Name"].to_pylist() == ["a"]
        assert found.rings.shapes[0].area == 0.5
        assert len(read_drawing(source).paths) == 1


def test_a_layer_without_a_name_can_be_chosen():
    content = kml(f"<Document>{MARK % ('a', 4)}<Folder><name>F</name>{MARK % ('b', 5)}</Folder></Document>").encode()
    with pytest.raises(LimitError, match="it has 2 layers; choose one by `layer`: unnamed, F"):
        read_features(content, notes=Notes())
    for layer, name in (("unnamed", "a"), ("F", "b")):
        assert read_features(content, layer=layer, notes=Notes()).table["Name"].to_pylist() == [name]


@pytest.mark.parametrize(
    ("content", "error", "line"),
    [
        (b"x,y\n1,2\n", MissingReferenceError, "names no reference system"),
        (b"lon,lat\n1,two\n", SourceError, "column 'lat' has a value that is no number"),
        (
            b"wkt,n\nPOINT (1 2),1\nPOINT (1),2\n",
            SourceError,
            r"row 2 has no WKT in .* 'wkt', but 'POINT \(1\)'",
        ),
        (b"wkt,n\nPOINT (1 2),1\nPOINT (1 2)\n", SourceError, "the table cannot be read"),
        (b"lon,lat\n1,\xff\n", SourceError, "its line 2 is no text in UTF-8"),
        (
            "name,lon,lat\na,4,52\nBesançon,5,53\n".encode("cp1252"),
            SourceError,
            "line 3 is no text in UTF-8, .* Windows-1252 .*'Besançon,5,53'.*; save the file as UTF-8",
        ),
        ("name,lon,lat\na,4,52\n".encode("utf-16"), SourceError, "it is text in UTF-16; save it as UTF-8"),
        (b"a,a,lon,lat\n1,2,4,52\n", SourceError, "it has several columns 'a'; rename all but one"),
        (b"lon,lat,,\n4,52,,\n", SourceError, "several of its columns have no name; give each one"),
        (b"ARROW1\0\0" + bytes(40), SourceError, "the table cannot be read"),
        (b"<gpx><wpt lat='1' lon='2'/>", SourceError, "the XML is damaged"),
        (b'{"type": "Feature"}\n{"type": "Feature"\n', SourceError, "record 2 is no JSON"),
        (b'\x1e{"type": "Feature", "geometry": null}\n\x1e{"type": "Point"}', SourceError, "record 2 is no Feature"),
        (b"SQLite format 3\0" + bytes(200), SourceError, "damaged"),
    ],
)
def test_damage_is_one_line(content, error, line):
    with pytest.raises(error, match=line) as raised:
        read_features(content, notes=Notes())
    assert "\n" not in str(raised.value)


def test_a_folder_says_what_it_is_not(tmp_path):
    with pytest.raises(SourceError, match="is a folder, and no FileGDB; name a file in it"):
        vexture.read(tmp_path)
    geodatabase(tmp_path).rename(tmp_path / "map")
    with pytest.raises(SourceError, match=r"its name does not end in \.gdb; rename it"):
        read_features(tmp_path / "map", notes=Notes())


def test_a_zip_of_several_maps_asks_for_one(tmp_path):
    names = ("a.geojson", "b.geojson")
    archive = zipped(tmp_path / "a.zip", *(saved(tmp_path / name, "GeoJSON") for name in names))
    with pytest.raises(LimitError, match=r"holds 2 files that can be read: a\.geojson, b\.geojson; zip one of them"):
        read_features(archive, notes=Notes())
    with pytest.raises(ParameterError, match="has no layer 'b'"):
        read_features(geodatabase(tmp_path), layer="b", notes=Notes())
