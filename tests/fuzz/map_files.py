"""Small files of maps and of depths, made here, and readers of them: features with all they have, and depths."""

import tempfile
import warnings
import zipfile
from io import BytesIO
from pathlib import Path

import geopandas
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import shapely
from rasterio import Affine
from rasterio.io import MemoryFile

from vexture.base.notes import Notes
from vexture_geo.base.crs import MissingReferenceError
from vexture_geo.readers import extent_of
from vexture_geo.vector.features import read_features

HEADER_ENDS = b"\n---\n"
"""Between the header and the numbers of a grid of floats, which are two files."""

CRS = "EPSG:28992"


def read_map(data: bytes) -> str:
    """Features of a file: finite corners, and as many rows as ids."""
    notes = Notes()
    try:
        found = read_features(data, notes=notes)
    except MissingReferenceError:
        found = read_features(data, crs=CRS, notes=notes)
    assert np.isfinite(found.rings.points).all(), "a corner is not finite"
    assert found.table.num_rows == len(found.ids) == len(set(found.ids)), "ids are not those of rows"
    said = sorted({note.message for note in notes.in_order})
    return (
        f"{len(found.rings.ends)} {len(found.lines.ends)} {len(found.points.points)} {found.table.schema.types} {said}"
    )


def read_floats(data: bytes) -> str:
    """A grid of floats and the header beside it."""
    header, _, numbers = data.partition(HEADER_ENDS)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "a.flt")
        path.write_bytes(numbers)
        path.with_suffix(".hdr").write_bytes(header)
        extent = extent_of(path, "a.flt", crs=CRS)
    return f"{len(extent.steps[0].drawing.paths)} {sorted({note.message for note in extent.notes})}"


def _kml() -> list[bytes]:
    ring = "<LinearRing><coordinates>4,52 6,52,1 6,53 4,52</coordinates></LinearRing>"
    shapes = (
        f"<Polygon><outerBoundaryIs>{ring}</outerBoundaryIs><innerBoundaryIs>{ring}</innerBoundaryIs></Polygon>",
        "<MultiGeometry><Point><coordinates>4,52</coordinates></Point>"
        "<LineString><coordinates>4,52 5,52</coordinates></LineString></MultiGeometry>",
    )
    about = '<name>a</name><ExtendedData><Data name="n"><value>1</value></Data></ExtendedData>'
    marks = "".join(f"<Placemark>{about}{shape}</Placemark>" for shape in shapes)
    return [f'<kml xmlns="http://www.opengis.net/kml/2.2"><Document><Folder>{marks}</Folder></Document></kml>'.encode()]


def _kmz() -> list[bytes]:
    packed = BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr(zipfile.ZipInfo("doc.kml"), _kml()[0])
    return [packed.getvalue()]


def _gpx() -> list[bytes]:
    points = '<trkpt lat="52" lon="4"><ele>1</ele><time>2026-01-02T03:04:05Z</time></trkpt><trkpt lat="53" lon="5"/>'
    return [
        (
            '<gpx xmlns="http://www.topografix.com/GPX/1/1" version="1.1">'
            f"<trk><name>b</name><trkseg>{points}</trkseg></trk></gpx>"
        ).encode()
    ]


def _gml() -> list[bytes]:
    place = "<gml:exterior><gml:LinearRing><gml:posList>0 0 9 0 9 9 0 0</gml:posList></gml:LinearRing></gml:exterior>"
    return [
        (
            '<o:FeatureCollection xmlns:o="http://a/b" xmlns:gml="http://www.opengis.net/gml"><gml:featureMember>'
            f'<o:t gml:id="t1"><o:g><gml:Polygon srsName="{CRS}">{place}</gml:Polygon></o:g><o:n>1</o:n></o:t>'
            "</gml:featureMember></o:FeatureCollection>"
        ).encode()
    ]


def _csv() -> list[bytes]:
    return [
        b"name;lat;lon;depth;code\na;52,25;4,5;0,5;01\nb;52;5;1;02\n",
        b'x,y,name\n1,2,"a\nb"\n3,4,\n',
        b"id\twkt\n1\tPOLYGON ((0 0, 9 0, 9 9, 0 0))\n2\tMULTIPOINT ((1 2), (3 4))\n",
    ]


def _curves() -> list[bytes]:
    texts = (
        "CIRCULARSTRING (0 0, 1 1, 2 0)",
        "CURVEPOLYGON (COMPOUNDCURVE (CIRCULARSTRING (0 0, 1 1, 2 0), (2 0, 0 0)))",
        "MULTISURFACE (((5 5, 6 5, 6 6, 5 5)), CURVEPOLYGON (CIRCULARSTRING (9 9, 9 7, 7 7, 7 9, 9 9)))",
        "TIN Z (((0 0 0, 0 9 0, 9 0 0, 0 0 0)), ((9 9 1, 0 9 0, 9 0 0, 9 9 1)))",
    )
    return [f'n,wkt\n1,"{text}"\n'.encode() for text in texts]


def _frame() -> geopandas.GeoDataFrame:
    shapes = [shapely.box(0, 0, 9, 9).difference(shapely.box(3, 3, 5, 5)), shapely.box(20, 0, 29, 9)]
    return geopandas.GeoDataFrame({"name": ["a", None], "n": [1, 2]}, geometry=shapes, crs=CRS)


def _feather() -> list[bytes]:
    file = BytesIO()
    _frame().to_feather(file, compression="uncompressed")
    return [file.getvalue()]


def _parquet() -> list[bytes]:
    found = []
    for encoding in ("WKB", "geoarrow"):
        file = BytesIO()
        with warnings.catch_warnings(action="ignore"):
            _frame().to_parquet(file, geometry_encoding=encoding)
        found.append(file.getvalue())
    texts, file = pa.table({"name": ["a"], "geometry": ["POLYGON ((0 0, 9 0, 9 9, 0 0))"]}), BytesIO()
    pq.write_table(texts, file)
    return [*found, file.getvalue()]


def _asc() -> list[bytes]:
    header = "ncols 4\nnrows 3\nxllcorner 100000\nyllcorner 400000\ncellsize 50\nNODATA_value -9999\n"
    return [(header + "1 0.5 1.5e0 -9999\n" * 3).encode(), (header.upper() + "0 1\n" * 6).encode()]


def _flt() -> list[bytes]:
    header = _asc()[0].partition(b"1 0.5")[0] + b"byteorder LSBFIRST\n"
    return [header + HEADER_ENDS + np.array([[1.0, 1.0, 1.5, -9999.0]] * 3, "<f4").tobytes()]


def _grib() -> list[bytes]:
    about = {"DISCIPLINE": "10", "IDS": "CENTER=7 REF_TIME=2026-02-14T06:00:00Z", "PDS_PDTN": "0"}
    template = "4 14 2 0 0 0 0 0 1 0 0 0 {} 1 0 0 0 0 0 255 0 0 0 0 0"
    place = {"crs": "EPSG:4326", "transform": Affine(0.01, 0.0, 4.0, 0.0, -0.01, 52.0)}
    messages = []
    for hour, encoding in ((0, "IEEE_FLOATING_POINT"), (3, "SIMPLE_PACKING"), (6, "COMPLEX_PACKING")):
        with warnings.catch_warnings(action="ignore"), MemoryFile() as memory:
            with memory.open(
                driver="GRIB", width=8, height=6, count=1, dtype="float32", **place, **about,
                PDS_TEMPLATE_NUMBERS=template.format(hour), DATA_ENCODING=encoding,
            ) as file:  # fmt: skip
                file.write(np.arange(48, dtype="float32").reshape(6, 8) / 10.0, 1)
            messages.append(memory.read())
    return [*messages, messages[0] + messages[1]]


SEEDS = {
    "kml": _kml,
    "kmz": _kmz,
    "gpx": _gpx,
    "gml": _gml,
    "csv": _csv,
    "curves": _curves,
    "feather": _feather,
    "parquet": _parquet,
    "asc": _asc,
    "flt": _flt,
    "grib": _grib,
}
"""Files by the name of their target; its folder of the corpus, if there is one, has those that broke a reader."""
