"""Geometries as text, in columns of CSV."""

import geopandas
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import shapely

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture_geo.vector.features import read_features

HOLE = shapely.box(4.4, 52.2, 4.6, 52.4).exterior.coords
SHAPES = [shapely.Polygon(shapely.box(4, 52, 5, 53).exterior.coords, [HOLE]), shapely.box(5, 52, 6, 53)]
FRAME = geopandas.GeoDataFrame({"name": ["a", "b"], "size": [1, 2]}, geometry=SHAPES, crs="EPSG:4326")


def csv(folder):
    path = folder / "a.csv"
    path.write_text(FRAME.to_wkt().rename(columns={"geometry": "WKT"}).to_csv(index=False, sep=";"))
    return path


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
