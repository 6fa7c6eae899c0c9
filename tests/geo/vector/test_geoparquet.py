"""Geometries of Parquet files in every encoding, and the reference systems that their columns name."""

import json

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import shapely

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture_geo.vector.feature_tables import FeatureQuery, chunks_of
from vexture_geo.vector.features import read_features

SQUARE, NOTCHED = (
    shapely.box(0, 0, 1, 1),
    shapely.Polygon([(2, 0), (4, 0), (4, 2)], [[(3, 0.2), (3.5, 0.2), (3.5, 0.6)]]),
)
LINES = [shapely.LineString([(0, 0), (1, 1)]), shapely.LineString([(2, 0), (3, 1), (4, 0)])]
KINDS = {
    "point": [shapely.Point(1, 2), shapely.Point(3, 4), shapely.Point(5, 6)],
    "linestring": [*LINES, LINES[0]],
    "polygon": [SQUARE, NOTCHED, SQUARE],
    "multipoint": [shapely.MultiPoint([(1, 2), (3, 4)]), shapely.MultiPoint([(5, 6)])],
    "multilinestring": [shapely.MultiLineString(LINES), shapely.MultiLineString(LINES[:1])],
    "multipolygon": [shapely.MultiPolygon([SQUARE, NOTCHED]), shapely.MultiPolygon([NOTCHED])],
}


def lists(kind, shapes, separated):
    """An array of GeoArrow."""
    _, points, offsets = shapely.to_ragged_array(shapes)
    points = np.asarray(points, np.float64)
    found = (
        pa.StructArray.from_arrays([pa.array(points[:, 0]), pa.array(points[:, 1])], ["x", "y"])
        if separated
        else pa.FixedSizeListArray.from_arrays(pa.array(points.ravel()), 2)
    )
    for ends in offsets:
        found = pa.ListArray.from_arrays(pa.array(np.asarray(ends, np.int32)), found)
    return found


def saved(place, geometry, about=None, name="geometry", **metadata):
    """A Parquet file with a column of geometries."""
    table = pa.table({"n": np.arange(len(geometry)), name: geometry})
    if about is not None:
        metadata["geo"] = json.dumps({"version": "1.1.0", "primary_column": name, "columns": {name: about}})
    pq.write_table(table.replace_schema_metadata(metadata), place, row_group_size=2)
    return place


def shapes_of(place, batch=None):
    chunks = list(chunks_of(place, FeatureQuery(), batch))
    return shapely.from_wkb(np.concatenate([chunk.shapes for chunk in chunks]))


@pytest.mark.parametrize("separated", [True, False])
@pytest.mark.parametrize("kind", KINDS)
def test_encodings_of_geoarrow_are_read(kind, separated, tmp_path):
    shapes = np.array(KINDS[kind], object)
    array = lists(kind, shapes, separated)
    place = saved(tmp_path / "a.parquet", array, {"encoding": kind, "geometry_types": []})
    assert shapely.equals_exact(shapes_of(place), shapes).all()
    assert shapely.equals_exact(shapes_of(place, 1), shapes).all()
    assert read_features(place, notes=Notes()).crs == "OGC:CRS84"


def test_a_part_of_the_rows_and_what_has_no_geometry(tmp_path):
    shapes = np.array([*KINDS["multipolygon"] * 3], object)
    array = pa.chunked_array([lists("multipolygon", shapes, True)[1:4], pa.nulls(1, lists("x", shapes, True).type)])
    place = saved(tmp_path / "a.parquet", array, {"encoding": "multipolygon"})
    found = shapes_of(place)
    assert shapely.equals_exact(found[:3], shapes[1:4]).all()
    assert found[3] is None
    notes = Notes()
    some = read_features(place, where="n > 1", notes=notes)
    assert some.ids.tolist() == ["2", "3"]
    assert [str(note) for note in notes.in_order] == ["feature without geometry (1: 3)"]


def test_a_ring_of_two_corners_is_left_out_and_named(tmp_path):
    ring = [{"x": 0.0, "y": 0.0}, {"x": 1.0, "y": 0.0}, {"x": 1.0, "y": 1.0}, {"x": 0.0, "y": 0.0}]
    rings = [[ring], [ring[:2]], [ring]]
    place = saved(tmp_path / "a.parquet", pa.array(rings), {"encoding": "polygon"})
    notes = Notes()
    assert read_features(place, notes=notes).feature.tolist() == [0, 2]
    assert "geometry is damaged" in str(notes.in_order[0])
    assert str(notes.in_order[0]).endswith("(1: 1)")


@pytest.mark.parametrize(("encoding", "values"), [("polygon", [1.0]), ("point", [[1.0, 2.0]]), ("cube", [b""])])
def test_an_encoding_that_is_not_what_the_column_has_is_refused(encoding, values, tmp_path):
    place = saved(tmp_path / "a.parquet", pa.array(values), {"encoding": encoding})
    with pytest.raises(SourceError, match="save it as GeoParquet with geometries in WKB"):
        shapes_of(place)


class Extension(pa.ExtensionType):
    """A column of geometries, which Arrow writes as the type GEOMETRY or GEOGRAPHY."""

    def __init__(self, about):
        self.about = about
        super().__init__(pa.binary(), "geoarrow.wkb")

    def __arrow_ext_serialize__(self):
        return json.dumps(self.about).encode()

    @classmethod
    def __arrow_ext_deserialize__(cls, storage, serialized):
        return cls(json.loads(serialized))


@pytest.mark.parametrize(
    ("about", "crs", "said"),
    [
        ({}, "OGC:CRS84", 0),
        ({"crs": "EPSG:28992"}, "EPSG:28992", 0),
        ({"crs": "28992"}, "EPSG:28992", 0),
        ({"crs": "srid:28992"}, "EPSG:28992", 0),
        ({"crs": "projjson:own"}, "EPSG:28992", 0),
        ({"edges": "spherical"}, "OGC:CRS84", 1),
    ],
)
def test_a_column_of_the_type_for_geometries_names_its_system(about, crs, said, tmp_path):
    from pyproj import CRS

    blobs = pa.array(shapely.to_wkb([SQUARE, NOTCHED, SQUARE]))
    column = pa.ExtensionArray.from_storage(Extension(about), blobs)
    place = tmp_path / "a.parquet"
    table = pa.table({"shape": column}).replace_schema_metadata({"own": CRS("EPSG:28992").to_json()})
    pq.write_table(table, place, store_schema="own" in str(about))
    if pq.ParquetFile(place).schema.column(0).logical_type.type not in ("GEOMETRY", "GEOGRAPHY"):
        pytest.skip("this pyarrow has no type for geometries")
    notes = Notes()
    assert read_features(place, notes=notes).crs == crs
    assert [str(note) for note in notes.in_order] == said * [
        "its sides are great circles; they are drawn straight in longitude and latitude"
    ]


def test_metadata_that_the_arrow_schema_lacks_are_found(tmp_path):
    place, table = tmp_path / "a.parquet", pa.table({"geometry": shapely.to_wkb([SQUARE])})
    about = {"version": "1.0.0", "primary_column": "geometry", "columns": {"geometry": {"encoding": "WKB"}}}
    with pq.ParquetWriter(place, table.schema) as writer:
        writer.write_table(table)
        writer.add_key_value_metadata({"geo": json.dumps(about)})
    assert pq.ParquetFile(place).schema_arrow.metadata is None
    assert read_features(place, notes=Notes()).crs == "OGC:CRS84"


def test_texts_that_are_not_in_utf_8_are_damaged_geometries(tmp_path):
    texts = pa.array([SQUARE.wkt.encode(), b"POLYGON\xff((0 0", None]).view(pa.string())
    notes = Notes()
    found = read_features(saved(tmp_path / "a.parquet", texts, name="WKT"), crs="EPSG:28992", notes=notes)
    assert found.feature.tolist() == [0]
    assert any("damaged" in str(note) for note in notes.in_order)


def test_texts_of_geometries_are_read_and_said(tmp_path):
    texts = [SQUARE.wkt, f"SRID=28992;{NOTCHED.wkt}", None, "POLYGON((0 0", shapely.to_wkb(SQUARE, hex=True), "01zz"]
    place = saved(tmp_path / "a.parquet", pa.array(texts), name="WKT")
    with pytest.raises(SourceError, match="names no reference system"):
        read_features(place, notes=Notes())
    notes = Notes()
    assert read_features(place, crs="EPSG:28992", notes=notes).feature.tolist() == [0, 1, 4]
    said = [str(note) for note in notes.in_order]
    assert "its geometries are texts in WKT" in said
    assert sum("damaged" in line and line.endswith("(2: 3, 5)") for line in said) == 1


def test_a_parquet_file_without_geometries_is_refused(tmp_path):
    place = saved(tmp_path / "a.parquet", pa.array(["a", "b"]), name="kind")
    with pytest.raises(SourceError, match=r"no geometries: .*save it as GeoParquet"):
        shapes_of(place)
