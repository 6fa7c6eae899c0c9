"""GeoDataFrames: their index and the names of their columns."""

import geopandas
import pandas as pd
import pyarrow as pa
import pytest
import shapely

from vexture.base.notes import Notes
from vexture_geo.maps import MapLayer, Scale, convert_map
from vexture_geo.vector.features import feature_batches, read_features

METRES = "EPSG:28992"


def squares(**columns):
    count = len(next(iter(columns.values())))
    shapes = [shapely.box(100 * k, 0, 100 * k + 100, 100) for k in range(count)]
    return geopandas.GeoDataFrame(columns, geometry=shapes, crs=METRES)


def test_columns_with_numbers_for_names_are_named_by_them():
    source = squares(v=[1.0, 2.0]).rename(columns={"v": 0})
    done = convert_map([MapLayer(source, id=0, order=0, columns=[0], color=Scale(0))], crs=METRES)
    assert done.table.column_names == ["id", "0"]
    assert done.table["id"].to_pylist() == ["1", "2"]


def test_the_index_of_a_frame_is_the_ids_where_it_tells_more_than_numbers():
    source = squares(v=[1.0, 2.0, 3.0])
    assert read_features(source, notes=Notes()).ids.tolist() == ["0", "1", "2"]
    named = source.set_index(pa.array(["c", "a", "b"]).to_pandas().rename("code"))
    assert read_features(named, where="v > 1", notes=Notes()).ids.tolist() == ["a", "b"]
    assert read_features(named, id="code", notes=Notes()).ids.tolist() == ["c", "a", "b"]
    assert read_features(named, bounds=(210, 10, 220, 20), notes=Notes()).ids.tolist() == ["b"]
    assert read_features(source[1:], notes=Notes()).ids.tolist() == ["1", "2"]
    assert read_features(source[1:].geometry, notes=Notes()).ids.tolist() == ["1", "2"]
    assert read_features(named, id="v", notes=Notes()).ids.tolist() == ["1", "2", "3"]
    days = source.set_index(pd.date_range("2020-01-01", periods=3))
    assert read_features(days, notes=Notes()).ids.tolist() == ["2020-01-01", "2020-01-02", "2020-01-03"]
    assert convert_map([MapLayer(named, color="id")], crs=METRES).table["id"].to_pylist() == ["c", "a", "b"]


@pytest.mark.parametrize(
    ("index", "why"),
    [
        (pd.Index(["a", "a", "b"], name="kind"), "has labels that are equal"),
        (pd.Index([1, "1", 2], name="kind"), "has labels that are equal"),
        (pd.Index([0.5, None, 2], name="kind"), "lacks labels"),
        (pd.MultiIndex.from_arrays([["a", "a", "b"], [1, 2, 3]], names=["kind", None]), "has several levels"),
    ],
)
def test_an_index_that_is_not_the_ids_says_why_and_is_an_attribute(index, why):
    notes = Notes()
    found = read_features(squares(v=[1.0, 2.0, 3.0]).set_index(index), notes=notes)
    assert found.ids.tolist() == ["0", "1", "2"]
    assert found.table.column_names == ["id", "kind", "v"]
    assert [str(note) for note in notes.in_order] == [
        f"its index {why}, so ids are the numbers of rows; name a column of ids by `id`"
    ]
    for column, count in ((None, 1), ("v", 0)):
        source, later = squares(v=[1.0, 2.0, 3.0]).set_index(index), Notes()
        assert len(list(feature_batches(source, id=column, batch=1, notes=later))) == 3
        assert [note.count for note in later.in_order] == [1] * count
