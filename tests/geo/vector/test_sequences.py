"""Sequences of GeoJSON: features one after another."""

import pytest

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture_geo.vector.features import read_features

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
