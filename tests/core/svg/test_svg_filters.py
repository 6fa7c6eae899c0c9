"""Names of filters in notes, and those that leave nothing."""

import pytest
from lxml import etree

from vexture.svg.filters import HIDING, filter_label, join_names
from vexture.svg.page import ENCLOSED
from vexture.svg.paint_servers import PaintServers
from vexture.svg.read import svg_drawing
from vexture.svg.report import Report
from vexture.svg.style import Cascade

DEFINED = (
    '<filter id="blur"><feGaussianBlur/></filter>'
    '<filter id="shadow"><feOffset/><feGaussianBlur/><feMerge><feMergeNode/></feMerge><feOffset/></filter>'
    '<filter id="empty"/><filter id="narrow" width="0"><feFlood/></filter>'
    '<filter id="turned" height="-5%"><feFlood/></filter><rect id="rect"/>'
)


def document(value: str) -> bytes:
    body = f'{DEFINED}<rect width="9" height="9" style="filter: {value}"/>'
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">{body}</svg>'.encode()


@pytest.mark.parametrize(
    ("value", "label"),
    [
        ("url(#blur)", "filter of blur"),
        ("url(#shadow)", "filter of offset, blur and merge"),
        ("url('#blur') drop-shadow(1px 1px red)", "filter of blur and drop shadow"),
        ("blur(1px) blur(2px)", "filter of blur"),
        ("url(#rect)", None),
        ("url(#blur) url(#missing)", None),
        ("url(#empty)", HIDING),
        ("url(#narrow)", HIDING),
        ("url(#turned)", HIDING),
        ("blur(1px) url(#empty)", HIDING),
    ],
)
def test_a_filter_is_named_by_its_steps(value: str, label: str | None) -> None:
    root, report = etree.fromstring(document(value)), Report()
    assert filter_label(value, PaintServers(root, Cascade(root, report, ENCLOSED), report)) == label
    assert (not svg_drawing(document(value), "a.svg").paths) == (label == HIDING)


def test_of_many_steps_some_are_listed() -> None:
    assert join_names(["a"]) == "a"
    assert join_names(["a", "b"]) == "a and b"
    assert join_names(list("abcd")) == "a, b, c and d"
    assert join_names(list("abcde")) == "a, b, c, d and more"
