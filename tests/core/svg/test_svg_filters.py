"""Names of filters in notes, and those that leave nothing."""

import pytest

from vexture import Drawing
from vexture.svg.filters import HIDING, join_names
from vexture.svg.read import svg_drawing

DEFINED = (
    '<filter id="blur"><feGaussianBlur/></filter>'
    '<filter id="shadow"><feOffset/><feGaussianBlur/><feMerge><feMergeNode/></feMerge><feOffset/></filter>'
    '<filter id="empty"/><filter id="narrow" width="0"><feFlood/></filter>'
    '<filter id="turned" height="-5%"><feFlood/></filter><rect id="rect"/>'
)


def drawn(value: str) -> Drawing:
    body = f'{DEFINED}<rect width="9" height="9" style="filter: {value}"/>'
    return svg_drawing(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">{body}</svg>'.encode(), "a.svg")


@pytest.mark.parametrize(
    ("value", "label"),
    [
        ("url(#blur)", "filter of blur"),
        ("url(#shadow)", "filter of offset, blur and merge"),
        ("url('#blur') drop-shadow(1px 1px red)", "filter of blur and drop shadow"),
        ("blur(1px) blur(2px)", "filter of blur"),
        ("none", None),
        ("url(#rect)", None),
        ("url(#blur) url(#missing)", None),
        ("url(#empty)", HIDING),
        ("url(#narrow)", HIDING),
        ("url(#turned)", HIDING),
        ("blur(1px) url(#empty)", HIDING),
    ],
)
def test_a_filter_is_named_by_its_steps(value: str, label: str | None) -> None:
    found = drawn(value)
    labels = [note.message for note in found.notes if note.message.startswith("filter of ")]
    assert labels == ([label] if label else [])
    assert len(found.paths) == (0 if label == HIDING else 1)


def test_of_many_steps_some_are_listed() -> None:
    assert join_names(["a"]) == "a"
    assert join_names(["a", "b"]) == "a and b"
    assert join_names(list("abcd")) == "a, b, c and d"
    assert join_names(list("abcde")) == "a, b, c, d and more"
