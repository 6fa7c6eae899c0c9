"""Tables with geometries: columns of CSV and what their values are."""

import pyarrow as pa
import pyarrow.feather as pa_feather
import pyarrow.parquet as pq
import pytest
import shapely

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture_geo.vector.features import read_features

HOLE = shapely.box(4.4, 52.2, 4.6, 52.4).exterior.coords
SHAPES = [shapely.Polygon(shapely.box(4, 52, 5, 53).exterior.coords, [HOLE]), shapely.box(5, 52, 6, 53)]


@pytest.mark.parametrize("header", ["name,lon,lat", "name\tLongitude\tLatitude", '"name";"LON";"LAT"', "name,x,y"])
def test_csv_has_points_where_columns_say(header):
    between = next(sign for sign in ",\t;" if sign in header)
    content = f"{header}\n" + "\n".join(between.join(row) for row in (("a", "4.5", "52"), ("b", "", ""))) + "\n"
    crs = "EPSG:4326" if "x" in header else None
    found = read_features(content.encode(), crs=crs, notes=Notes())
    assert found.points.points.tolist() == [[4.5, 52.0]]
    assert found.table["name"].to_pylist() == ["a", "b"]
    assert found.crs == (crs or "OGC:CRS84")


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


def test_csv_without_places_says_what_it_has(tmp_path):
    (tmp_path / "a.csv").write_text("id,people\n1,2\n")
    with pytest.raises(SourceError, match=r"names no columns of places .*: id, people"):
        read_features(tmp_path / "a.csv", notes=Notes())
