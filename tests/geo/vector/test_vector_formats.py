"""Files of features in every format have the shapes and attributes of the same data in GeoJSON."""

import sqlite3
import warnings
import zipfile
from contextlib import closing

import geopandas
import numpy as np
import pyarrow as pa
import pyarrow.feather as pa_feather
import pyarrow.parquet as pq
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


@pytest.mark.parametrize("header", ["name,lon,lat", "name\tLongitude\tLatitude", '"name";"LON";"LAT"', "name,x,y"])
def test_csv_has_points_where_columns_say(header):
    between = next(sign for sign in ",\t;" if sign in header)
    content = f"{header}\n" + "\n".join(between.join(row) for row in (("a", "4.5", "52"), ("b", "", ""))) + "\n"
    crs = "EPSG:4326" if "x" in header else None
    found = read_features(content.encode(), crs=crs, notes=Notes())
    assert found.points.points.tolist() == [[4.5, 52.0]]
    assert found.table["name"].to_pylist() == ["a", "b"]
    assert found.crs == (crs or "OGC:CRS84")


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


CURVES = {
    "CIRCULARSTRING (0 0, 1 1, 2 0)": np.pi,  # of a line, the length
    "COMPOUNDCURVE ((0 0, 3 0), CIRCULARSTRING (3 0, 4 1, 5 0))": 3 + np.pi,
    "MULTICURVE ((0 0, 3 0), CIRCULARSTRING (0 0, 1 1, 2 0))": 3 + np.pi,
    "CURVEPOLYGON (CIRCULARSTRING (0 0, 2 0, 0 0))": np.pi,
    "MULTISURFACE (CURVEPOLYGON (CIRCULARSTRING (0 0, 2 0, 0 0)), ((3 0, 4 0, 4 1, 3 0)))": np.pi + 0.5,
    "SRID=4326;TIN (((0 0, 1 0, 1 1, 0 0)), ((0 0, 1 1, 0 1, 0 0)))": 1.0,
    "TRIANGLE Z ((0 0 5, 1 0 5, 1 1 5, 0 0 5))": 0.5,
    "PolyhedralSurface (((0 0, 1 0, 1 1, 0 0)))": 0.5,
    "GEOMETRYCOLLECTION (TIN (((0 0, 1 0, 1 1, 0 0))))": 0.5,
}


@pytest.mark.parametrize("text", CURVES)
@pytest.mark.parametrize("kind", ["csv", "parquet"])
def test_curves_and_surfaces_in_wkt_are_read(text, kind, tmp_path):
    table = pa.table({"n": [1], "wkt": [text]})
    if kind == "csv":
        (tmp_path / "a.csv").write_text(f'n,wkt\n1,"{text}"\n')
    else:
        pq.write_table(table, tmp_path / "a.parquet")
    found = read_features(tmp_path / f"a.{kind}", crs="EPSG:28992", notes=Notes())
    lines = np.split(found.lines.points, found.lines.ends[:-1])
    size = sum(shapely.LineString(line).length for line in lines if len(line)) + shapely.area(found.rings.shapes).sum()
    assert size == pytest.approx(CURVES[text], rel=1e-3)


@pytest.mark.parametrize("text", ["CURVEPOLYGON (CIRCULARSTRING (0 0", "TIN (((0 0, 1 0, 1 1, 0 0))), POINT (1 2)"])
def test_damaged_curves_in_csv_are_named(text):
    with pytest.raises(SourceError, match=r"row 2 has no WKT in the column 'wkt', but '(CURVE|TIN)"):
        read_features(f'n,wkt\n1,POINT (1 2)\n2,"{text}"\n'.encode(), crs="EPSG:28992", notes=Notes())


@pytest.mark.parametrize("text", ["POLYGON ((0 0, 1e999 0, 9 9, 0 0))", "CURVEPOLYGON ((0 0, 1e999 0, 9 9, 0 0))"])
def test_numbers_of_wkt_that_are_too_large_are_told_without_a_warning(text):
    with pytest.raises(SourceError, match=r"feature 0.*inf|row 1 has no WKT"):
        read_features(f'n,wkt\n1,"{text}"\n'.encode(), crs="EPSG:28992", notes=Notes())
    with pytest.raises(SourceError, match="row 1 has no WKT in the column 'wkt', but 'POLYGON"):
        read_features(b"n\twkt\n1\tPOLYGON(1e999\n", crs="EPSG:28992", notes=Notes())


@pytest.mark.parametrize("text", ["CIRCULARSTRING (0 0, inf 1, 2 0)", "CIRCULARSTRING (0 0, 1e200 1e200, 2 0)"])
def test_arcs_through_places_that_are_too_far_give_no_warning(text):
    found = read_features(f'n,wkt\n1,"{text}"\n2,"LINESTRING (0 0, 9 9)"\n'.encode(), crs="EPSG:28992", notes=Notes())
    assert found.lines.points[-2:].tolist() == [[0.0, 0.0], [9.0, 9.0]]


def test_codes_in_csv_keep_their_zeros():
    content = b'code,quoted,number,depth,lon,lat\n10,"07",10,0.5,004.5,52\n01,8,0,-0.25,5,52\n,,,,6,52\n'
    found = read_features(content, notes=Notes())
    assert found.table["code"].to_pylist() == ["10", "01", None]
    assert found.table["quoted"].to_pylist() == ["07", "8", None]
    assert found.table["number"].to_pylist() == [10, 0, None]
    assert found.table["depth"].to_pylist() == [0.5, -0.25, None]
    assert found.points.points[:, 0].tolist() == [4.5, 5.0, 6.0]


@pytest.mark.parametrize("separator", [";", "\t"])
def test_decimal_commas_of_csv_are_read(separator):
    lines = ["lon;lat;depth;code;people;word", "4,5;52,25;-0,5;01,5;1,234;1,5 m", ";;;;;", "5;52;12;2;3;2"]
    found = read_features("\n".join(lines).replace(";", separator).encode(), notes=Notes())
    assert found.points.points.tolist() == [[4.5, 52.25], [5.0, 52.0]]
    columns = {name: found.table[name].to_pylist() for name in ("depth", "code", "people", "word")}
    assert columns["depth"] == [-0.5, None, 12.0]
    assert columns["people"] == [1.234, None, 3.0]
    assert columns["code"] == ["01,5", None, "2"]
    assert columns["word"] == ["1,5 m", None, "2"]


def test_points_between_thousands_are_no_part_of_numbers_with_decimal_commas():
    content = b"lon;lat;value;doubtful\n4,5;52;1.234,5;1.234\n5;52;-12,5;1,5\n6;52;3;2\n"
    table = read_features(content, notes=Notes()).table
    assert table["value"].to_pylist() == [1234.5, -12.5, 3.0]
    assert table["doubtful"].to_pylist() == ["1.234", "1,5", "2"]


def test_commas_that_are_no_decimal_ones_stay():
    content = b"lon;lat;people;share;all\n4.5;52;1,234;0,5;1,234,567\n5;52;12,345;12,345;1\n"
    table = read_features(content, notes=Notes()).table
    assert table["people"].to_pylist() == ["1,234", "12,345"]  # beside decimal points, commas may be of thousands
    assert table["share"].to_pylist() == [0.5, 12.345]
    assert table["all"].to_pylist() == ["1,234,567", "1"]
    assert read_features(b'lon,lat,a\n4,52,"1,5"\n', notes=Notes()).table["a"].to_pylist() == ["1,5"]


def test_a_long_first_line_of_csv_is_read_as_a_whole():
    names = [f"column_{number:04}" for number in range(500)]
    content = f"lon,lat,{','.join(names)}\n4,52,{','.join('1' for _ in names)}\n"
    assert read_features(content.encode(), notes=Notes()).table.column_names[-500:] == names


@pytest.mark.parametrize("write", [pq.write_table, pa_feather.write_feather])
def test_two_columns_of_one_name_are_refused(write, tmp_path):
    shapes = pa.array([shapely.to_wkb(shape) for shape in SHAPES])
    write(pa.Table.from_arrays([pa.array([1, 2]), pa.array([3, 4]), shapes], ["a", "a", "geometry"]), tmp_path / "a")
    with pytest.raises(SourceError, match="it has several columns 'a'; rename all but one"):
        read_features(tmp_path / "a", crs="EPSG:4326", notes=Notes())


FEATURE = '{"type": "Feature", "properties": {"n": %d}, "geometry": {"type": "Point", "coordinates": [%d, 52]}}'


@pytest.mark.parametrize("between", ["\n", ",\n", "", " ", ",", "\r\n\r\n", "split"])
def test_all_features_one_after_another_are_read(between):
    parts = [FEATURE % (number, number) for number in (1, 2, 3)]
    if between == "split":  # over lines
        content = "\n".join(part.replace(", ", ",\n") for part in parts)
    else:
        content = between.join(parts) + "\n"
    found = read_features(content.encode(), notes=Notes())
    assert found.table["n"].to_pylist() == [1, 2, 3]
    assert len(found.points.points) == 3


def test_a_sequence_names_the_record_that_is_no_feature():
    for record, line in (('{"type": "Point"}', "record 2 is no Feature"), ("x", "record 2 is no JSON")):
        with pytest.raises(SourceError, match=line):
            read_features(f"{FEATURE % (1, 1)},\n{record}\n".encode(), notes=Notes())
    collection = f'{{"type": "FeatureCollection", "features": [{FEATURE % (1, 1)}]}}'
    for content in (f"{collection}\n{collection}", f"{collection} {collection}", f"{collection}\n{FEATURE % (1, 1)}"):
        with pytest.raises(SourceError, match="record 1 is no Feature"):
            read_features(content.encode(), notes=Notes())


def test_a_sequence_that_is_not_in_utf_8_is_refused():
    content = "\n".join(f'{{"type": "Feature", "id": "{name}", "geometry": null}}' for name in ("a", "ç"))
    with pytest.raises(SourceError, match=r"it is no UTF-8 text .*; save it as UTF-8"):
        read_features(content.encode("cp1252"), notes=Notes())


def test_csv_without_places_says_what_it_has(tmp_path):
    (tmp_path / "a.csv").write_text("id,people\n1,2\n")
    with pytest.raises(SourceError, match=r"names no columns of places .*: id, people"):
        read_features(tmp_path / "a.csv", notes=Notes())


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
