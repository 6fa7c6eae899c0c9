"""Links from one element of a document to another."""

import pytest
from lxml import etree

from vexture.svg.links import Links, reference

XLINK = "http://www.w3.org/1999/xlink"


def test_the_plain_attribute_comes_before_that_of_xlink() -> None:
    both = etree.fromstring(f'<use xmlns:xlink="{XLINK}" xlink:href="#old" href="#new"/>')
    old = etree.fromstring(f'<use xmlns:xlink="{XLINK}" xlink:href="#old" href=""/>')
    assert (reference(both), reference(old)) == ("#new", "#old")
    assert reference(etree.fromstring("<use/>")) is None


ROOT = etree.fromstring('<svg><g id="a"/><g id="a"><b id="ä b"/></g><i id="%41"/><i id="1"/></svg>')


@pytest.mark.parametrize(
    ("link", "tag", "place"),
    [
        ("#a", "g", 0),  # the first of two
        (" #a ", "g", 0),
        ("#%C3%A4%20b", "b", 0),
        (r"#\e4 \20 b", "b", 0),
        (r"#\31", "i", 1),
        ("#%41", "i", 0),  # as it is written comes before what it means
        ("#A", None, 0),
        ("#", None, 0),
        ("a", None, 0),
        ("other.svg#a", None, 0),
        (r"#\110000", None, 0),
    ],
)
def test_names_are_found_as_written_and_decoded(link: str, tag: str | None, place: int) -> None:
    expected = None if tag is None else [*ROOT.iter(tag)][place]
    assert Links(ROOT).target(link) is expected
