"""Tables of features: chosen rows and columns, in batches."""

import pytest
from four_squares import save_features, squares

from vexture.base.errors import ParameterError
from vexture.base.notes import Notes
from vexture_geo.vector.features import feature_batches, read_features


@pytest.mark.parametrize("kind", ["gpkg", "fgb", "shp", "geojson", "parquet", "frame"])
def test_conditions_columns_and_bounds(kind, tmp_path):
    source = squares() if kind == "frame" else save_features(squares(), tmp_path, kind)
    found = read_features(source, id="name", where="size >= 2 AND name <> 'd'", columns=["size"], notes=Notes())
    assert sorted(found.ids) == ["b", "c"]
    near = read_features(source, id="name", bounds=(2.5, 0.2, 2.7, 0.4), notes=Notes())
    assert near.ids.tolist() == ["c"]
    assert near.feature.tolist() == [0]
    assert len(read_features(source, where="size > 9", notes=Notes())) == 0
    with pytest.raises(ParameterError, match=r"`where`.*there are: name, size"):
        read_features(source, where="width > 2", notes=Notes())
    with pytest.raises(ParameterError, match=r"no column 'width' for `columns`"):
        read_features(source, columns=["width"], notes=Notes())


@pytest.mark.parametrize("kind", ["gpkg", "fgb", "geojson", "parquet", "frame"])
def test_batches_together_are_the_whole(kind, tmp_path):
    source = squares() if kind == "frame" else save_features(squares(), tmp_path, kind)
    parts = list(feature_batches(source, id="name", where="size > 1", batch=2, notes=Notes()))
    assert max(map(len, parts)) <= 2
    assert sorted(name for part in parts for name in part.ids) == ["b", "c", "d"]
