"""Ids of features in GeoJSON: the features' own, as the file has them, whatever property has that name."""

import json
from typing import Any

import numpy as np
import pytest

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture_geo.vector.features import Features, feature_batches, read_features

NONE = object()


def collection(ids: list[Any], properties: list[dict[str, Any]] | None = None, kind: str = "Polygon") -> bytes:
    """One square for each id."""
    features = []
    for place, own in enumerate(ids):
        corners = [[place, 0], [place + 1, 0], [place + 1, 1], [place, 0]]
        geometry = {"type": kind, "coordinates": [corners] if kind == "Polygon" else corners}
        given = (properties or [{"n": number} for number in range(len(ids))])[place]
        feature = {"type": "Feature", "properties": given, "geometry": geometry}
        features.append(feature | ({} if own is NONE else {"id": own}))
    return json.dumps({"type": "FeatureCollection", "features": features}).encode()


def read(content: bytes, **options: Any) -> tuple[Features, list[str]]:
    notes = Notes()
    found = read_features(content, notes=notes, **options)
    return found, [note.message for note in notes.in_order]


AGAIN = "a feature has an id that another had before: its own ends in #2, #3, ..."


@pytest.mark.parametrize(
    ("ids", "found", "said"),
    [
        ([10, 11], ["10", "11"], []),
        ([-1, -2], ["-1", "-2"], []),
        (["r1", "r2"], ["r1", "r2"], []),
        ([5, 5, 6], ["5", "5#2", "6"], [AGAIN]),
        ([1, "1", "x"], ["1", "1#2", "x"], [AGAIN]),
        ([1.5, 2], ["1.5", "2"], []),
        ([7, NONE], ["7", "#1"], ["a feature has no 'id': its id is # and its number"]),
        ([NONE, NONE], ["0", "1"], []),
    ],
)
def test_ids_are_those_of_the_file(ids: list[Any], found: list[str], said: list[str]) -> None:
    features, notes = read(collection(ids))
    assert features.ids.tolist() == found
    assert notes == said


@pytest.mark.parametrize("ids", [[10, 11], ["r1", "r2"], [-1, -2], [2, 1]])
def test_an_id_of_the_feature_wins_over_a_property(ids: list[Any]) -> None:
    content = collection(ids, [{"id": 1, "n": 1}, {"id": 2, "n": 2}])
    features, _ = read(content)
    assert features.ids.tolist() == [str(one) for one in ids]
    assert features.table.column("id_").to_pylist() == [1, 2]
    assert read(content, id="id")[0].ids.tolist() == ["1", "2"], "unless the column is asked for"
    assert read(content, where="n > 1")[0].ids.tolist() == [str(ids[1])]
    batches = feature_batches(content, notes=Notes(), batch=1)
    assert [one for part in batches for one in part.ids.tolist()] == [str(one) for one in ids]


def test_a_property_is_the_id_where_features_have_none() -> None:
    features, _ = read(collection([NONE, NONE], [{"id": 7, "name": "x"}, {"id": 9, "name": "y"}]))
    assert features.ids.tolist() == ["7", "9"]
    assert features.table.column_names == ["id", "name"]


DAMAGED = "feature whose geometry is damaged, or has a line or ring of too few points"


def test_a_geometry_of_too_few_points_is_left_out() -> None:
    whole = json.loads(collection(["a", "b", "c"]))
    whole["features"][1]["geometry"]["coordinates"] = [[[5, 5], [5, 5]]]
    content = json.dumps(whole).encode()
    features, notes = read(content)
    assert np.unique(features.rings.feature).tolist() == [0, 2]
    assert notes == [DAMAGED]
    assert read(content, bounds=(0, 0, 9, 9))[1] == [DAMAGED]
    for feature in whole["features"]:
        feature["geometry"]["coordinates"] = [[[5, 5], [5, 5]]]
    with pytest.raises(SourceError, match="each geometry is damaged, or has a line or ring of too few points"):
        read(json.dumps(whole).encode())
