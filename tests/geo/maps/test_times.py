"""Tables of times as pandas makes them: each is read in the order of its times, or ends in a line."""

import geopandas
import numpy as np
import pandas as pd
import pyarrow as pa
import pytest
import shapely

from vexture.base.errors import ParameterError, SourceError
from vexture.base.notes import Notes
from vexture_geo.maps import Times
from vexture_geo.maps.times import with_steps
from vexture_geo.vector.features import read_features

SHAPES = [shapely.box(k, 0, k + 1, 1) for k in range(4)]


def squares(index=tuple("abcd")):
    return geopandas.GeoDataFrame({"v": [1, 2, 3, 4]}, geometry=SHAPES, crs="EPSG:28992", index=list(index))


def table(**columns):
    return pd.DataFrame({"id": list("abcd") * 2, "time": [1] * 4 + [2] * 4, "val": range(8)}).assign(**columns)


def steps(source, frame=None):
    """Names of the steps, and the values of the first feature."""
    features = read_features(squares() if frame is None else frame, notes=Notes())
    found, names, labels, _ = with_steps(features, Times(source), Notes())
    return list(labels), [found.table[name][0].as_py() for name in names]


def test_times_of_every_kind_are_in_their_order():
    months = pd.Categorical(["Jan"] * 4 + ["Feb"] * 4, ["Jan", "Feb"], ordered=True)
    assert steps(table(time=months)) == (["Jan", "Feb"], [0, 4])
    assert steps(table(time=months.as_unordered())) == (["Feb", "Jan"], [4, 0])
    periods = pd.PeriodIndex(["2020-02"] * 4 + ["2020-01"] * 4, freq="M")
    assert steps(table(time=periods)) == (["2020-01", "2020-02"], [4, 0])
    assert steps(table(time=["a"] * 4 + [10] * 4)) == (["10", "a"], [4, 0])
    assert steps(table(time=["\u00b2"] * 4 + ["1"] * 4)) == (["1", "\u00b2"], [4, 0])
    assert steps(table(time=["-2"] * 4 + ["-10"] * 4)) == (["-10", "-2"], [4, 0])
    assert steps(table(time=["10"] * 4 + ["9.5"] * 4)) == (["9.5", "10"], [4, 0])
    assert steps(table(time=["y10"] * 4 + ["y9"] * 4)) == (["y9", "y10"], [4, 0])


def test_labels_tell_times_apart_in_one_form():
    assert steps(table(time=[737425.25] * 4 + [737425.5] * 4))[0] == ["737425.25", "737425.5"]
    hours = pd.to_datetime(["2020-01-01 23:00"] * 4 + ["2020-01-02 00:00"] * 4)
    assert steps(table(time=hours))[0] == ["2020-01-01 23:00:00", "2020-01-02 00:00:00"]
    assert steps(table(time=hours.normalize()))[0] == ["2020-01-01", "2020-01-02"]
    assert Times("y*", tuple(pd.date_range("2020-01-01", periods=2))).labels == ("2020-01-01", "2020-01-02")
    with pytest.raises(ParameterError, match="`labels` names two steps 'a'"):
        Times("y*", ("a", "a", "b"))


def test_ids_of_a_table_and_of_a_frame_are_the_same_texts():
    halves = [0.5, 1.5, 2.5, 3.5]
    assert steps(table(id=halves * 2), squares(halves))[1] == [0, 4]
    with pytest.raises(SourceError, match="no id of the table"):
        steps(table(id=[0.4, 1.4, 2.4, 3.4] * 2), squares(range(4)))
    assert steps(table(id=[0.0, 1.0, 2.0, 3.0] * 2), squares(range(4)))[1] == [0, 4]
    days = pd.date_range("2020-01-01", periods=4)
    assert steps(table(id=[*days, *days]), squares(days))[1] == [0, 4]
    assert steps(table(id=["a", 1, 2, 3] * 2))[1] == [0, 4]
    assert steps(table(id=pd.Categorical(list("abcd") * 2)))[1] == [0, 4]
    with pytest.raises(ParameterError, match="column id of the table of `times` holds list"):
        steps(table(id=[["a"]] * 8))


def test_values_of_every_kind_are_read_and_geometries_left_out():
    assert steps(table(val=["x", 1] * 4)) == (["1", "2"], ["x", "x"])
    assert steps(table(val=pd.Categorical(list("abcdefgh"))))[1] == ["a", "e"]
    assert steps(geopandas.GeoDataFrame(table(), geometry=SHAPES * 2))[1] == [0, 4]
    assert steps(pa.table({"id": ["a"], "time": pa.array([5.0]), "val": [1]})) == (["5"], [1])
    with pytest.raises(SourceError, match="no row of the table of `times` has a time"):
        steps(table(time=[None, np.nan] * 4))
