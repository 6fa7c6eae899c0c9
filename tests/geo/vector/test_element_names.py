"""Paths know which element of the source they draw."""

import io
import json

import pytest
from PIL import Image

import vexture
from vexture.base.errors import ParameterError, SourceError
from vexture_geo.vector.geojson import read_geojson

SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"'
BOX = '<rect width="5" height="5"/>'
HOUSE = f'<defs><symbol id="house"><rect id="wall" width="5" height="5"/><g id="top">{BOX}</g></symbol></defs>'


@pytest.mark.parametrize(
    ("body", "names"),
    [
        (BOX, [""]),
        ('<rect id="a" width="5" height="5" stroke="red"/>', ["a", "a/stroke"]),
        ('<rect width="5" height="5" stroke="red"/>', ["", ""]),
        (f'<g id="a"><g>{BOX}</g><g id="b">{BOX}</g>{BOX}</g>{BOX}', ["a", "b", "a", ""]),
        (f'{HOUSE}<use id="one" href="#house"/><use href="#house"/>', ["one", "one", "wall", "top"]),
        (f'{HOUSE}<g id="g"><use href="#house"/></g>', ["wall", "top"]),
        (f'{HOUSE}<g id="u"><use id="v" href="#house"/></g><use id="w" href="#u"/>', ["v", "v", "w", "w"]),
        (f'<g id="a"><use href="#b"/></g><g id="b">{BOX}</g>', ["b", "b"]),
    ],
)
def test_an_svg_path_has_the_nearest_id_and_an_instance_its_own(body: str, names: list[str]) -> None:
    drawing = vexture.read(f"{SVG}>{body}</svg>".encode())
    assert [path.element for path in drawing.paths] == names


def test_an_outermost_svg_names_what_nothing_else_names() -> None:
    drawing = vexture.read(f'{SVG} id="all">{BOX}<g id="b">{BOX}</g></svg>'.encode())
    assert [path.element for path in drawing.paths] == ["all", "b"]


def collection() -> bytes:
    ring = [[0, 0], [1, 0], [1, 1], [0, 0]]
    features = [
        {"id": 7, "properties": {"name": "Ada", "code": "A"}},
        {"properties": {"name": "Bob", "code": 2.5}},
        {"id": "c", "properties": None},
        {"properties": {"name": ["no text"], "code": True}},
    ]
    geometry = {"type": "MultiPolygon", "coordinates": [[ring], [ring]]}
    listed = [{"type": "Feature", "geometry": geometry, **feature} for feature in features]
    return json.dumps({"type": "FeatureCollection", "features": listed}).encode()


@pytest.mark.parametrize(("names", "found"), [(None, ["7", "Bob", "c", ""]), ("code", ["A", "2.5", "c", ""])])
def test_polygons_are_named_after_their_feature(names: str | None, found: list[str]) -> None:
    for drawing in (read_geojson(collection(), names=names), vexture.read(collection(), names=names)):
        assert [path.element for path in drawing.paths] == [name for name in found for _ in range(2)]


def test_names_of_a_property_that_no_feature_has_are_refused() -> None:
    with pytest.raises(SourceError, match="no feature has the property 'nme' of `names`; there are 'code', 'name'"):
        read_geojson(collection(), names="nme")


def test_names_are_for_geojson_and_svg() -> None:
    picture = io.BytesIO()
    Image.new("RGB", (4, 4), "red").save(picture, "PNG")
    with pytest.raises(ParameterError, match="`names` 'code' is for the elements of GeoJSON and SVG; leave it out"):
        vexture.read(picture.getvalue(), names="code")


LABELLED = (
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:i="http://www.inkscape.org/namespaces/inkscape" viewBox="0 0 9 9">'
    '<g i:label="sky"><title>All the sky</title><rect id="r1" width="9" height="9" fill="blue"/>'
    '<circle id="c1" r="3" i:label="sun" stroke="red"><title>The\n Sun</title></circle></g>'
    '<path id="p" d="M0 5h9v4H0z"/></svg>'
)


@pytest.mark.parametrize(
    ("names", "found"),
    [
        (None, ["r1", "c1", "c1/stroke", "p"]),
        ("i:label", ["sky", "sun", "sun/stroke", ""]),
        ("title", ["All the sky", "The Sun", "The Sun/stroke", ""]),
    ],
)
def test_names_may_be_labels_and_titles(names: str | None, found: list[str]) -> None:
    assert [path.element for path in vexture.read(LABELLED.encode(), names=names).paths] == found


@pytest.mark.parametrize("names", ["label", "x:label", "", ":"])
def test_names_that_no_element_has_are_told(names: str) -> None:
    with pytest.raises(SourceError, match=f"no element has the name '{names}' of `names`; give title, id or another"):
        vexture.read(LABELLED.encode(), names=names)
