"""Names of elements: by an id, another attribute, one with a prefix, or a title."""

import pytest
from lxml import etree

from vexture.base.errors import SourceError
from vexture.svg.names import ElementNames

INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"
ROOT = etree.fromstring(
    f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="{INKSCAPE}" xmlns:own="urn:a">'
    '<g id="a" label="plain" inkscape:label="sun"><title>  The\n sun </title><title>no</title><g/></g>'
    '<g id="" inkscape:label="hill"><g xmlns:own="urn:b" own:kind="deep"><title><b>bold</b> hill</title></g></g>'
    '<g own:kind="wide"/></svg>'
)
ELEMENTS = [*ROOT.iter("{*}g")]


@pytest.mark.parametrize(
    ("by", "expected"),
    [
        ("id", ["a", "", "", "", ""]),
        ("label", ["plain", "", "", "", ""]),
        ("inkscape:label", ["sun", "", "hill", "", ""]),
        ("own:kind", ["", "", "", "deep", "wide"]),  # a prefix of two namespaces
        ("title", ["The sun", "", "", "bold hill", ""]),
    ],
)
def test_an_element_has_the_name_that_is_asked_for(by: str, expected: list[str]) -> None:
    names = ElementNames(ROOT, by)
    assert [names.of(element) for element in ELEMENTS] == expected


@pytest.mark.parametrize("by", ["class", "inkscape:kind", "nowhere:label"])
def test_a_name_that_no_element_has_is_refused(by: str) -> None:
    with pytest.raises(SourceError, match=f"no element has the name '{by}' of `names`; give title, id or another"):
        ElementNames(ROOT, by)


def test_ids_may_be_missing() -> None:
    root = etree.fromstring("<svg><g/></svg>")
    assert ElementNames(root).of(root[0]) == ""
