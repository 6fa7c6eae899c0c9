"""Declarations of CSS: shorthands are expanded, and what is not known is dropped."""

import pytest

from vexture.base.errors import SourceError
from vexture.svg.declarations import Declaration, expand_declaration, longhands, read_style


@pytest.mark.parametrize(
    ("name", "value", "expected"),
    [
        ("fill", "red", {"fill": "red"}),
        ("fill", "", {}),
        ("marker", "url(#a)", dict.fromkeys(("marker-start", "marker-mid", "marker-end"), "url(#a)")),
        ("background", "url(a.png) red", {"background-color": "red", "background-image": "url(a.png) red"}),
        ("background", "no-repeat", {"background-color": "transparent", "background-image": "none"}),
        ("mask", "url(#m) alpha", {"mask": "url(#m)", "mask-mode": "alpha"}),
        ("mask", "url('#m') center / cover", {"mask": "url('#m')", "mask-mode": "match-source"}),
        ("mask", "url(#m) bright", {"mask": "url(#m) bright", "mask-mode": "match-source"}),
        ("mask", "none", {"mask": "none", "mask-mode": "match-source"}),
        ("border-top-style", "solid", {"border": "solid"}),
        ("border-top-left-radius", "3px", {"border-radius": "3px"}),
        ("padding-inline-start", "3px", {"padding": "3px"}),
        ("nonsense", "red", {}),
    ],
)
def test_a_property_sets_its_longhands(name: str, value: str, expected: dict[str, str]) -> None:
    assert dict(expand_declaration(name, value)) == expected


def test_all_takes_keywords_only_and_leaves_directions_alone() -> None:
    assert dict(expand_declaration("all", "red")) == {}
    found = dict(expand_declaration("all", "inherit"))
    assert found["fill"] == found["opacity"] == "inherit"
    assert "direction" not in found
    assert "unicode-bidi" not in found


PLAIN = "fill: red; -webkit-mask-mode: alpha;; stroke:blue"
ESCAPED = "fill: red /* } */; STROKE: blue !important; --own: { a; b }; fill"


def test_style_attributes_with_and_without_a_tokeniser() -> None:
    found = [(one.name, one.value, one.important) for one in read_style(PLAIN)]
    assert found == [("fill", "red", False), ("mask-mode", "alpha", False), ("stroke", "blue", False)]
    found = [(one.name, one.value, one.important) for one in read_style(ESCAPED)]
    assert found == [("fill", "red", False), ("stroke", "blue", True), ("--own", "{ a; b }", False)]
    assert [*read_style("fill: red")] == [*read_style("fill: red /**/")]


def test_a_shorthand_with_a_reference_to_a_property_waits_for_its_value() -> None:
    assert [*read_style("marker: var(--m)")] == [Declaration("marker", "var(--m)", False)]
    assert [*read_style("nonsense: var(--m)")] == []


def test_numbers_of_very_many_digits_are_refused() -> None:
    with pytest.raises(SourceError, match="an integer in its styles has more than 4,300 digits; round it"):
        [*read_style(f"fill: rgb({'9' * 5000})")]


def test_known_names_have_longhands() -> None:
    assert longhands("fill") == ("fill",)
    assert longhands("mask-image") == ("mask",)
    assert longhands("outline-style") == ("outline",)
    assert longhands("nonsense") == ()
