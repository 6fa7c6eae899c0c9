"""The font that characters ask for: families, features, and axes of variable fonts."""

import pytest
from lxml import etree

from vexture.svg.style import ElementStyle
from vexture.svg.text.font_query import families, features, query_of, stretch, variations


def style(**inherited: str) -> ElementStyle:
    return ElementStyle({name.replace("_", "-"): value for name, value in inherited.items()}, {}, 20.0)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Open  Sans", ("Open Sans",)),
        ("'A, B', \"C'D\" ,E", ("A, B", "C'D", "E")),
        ("SERIF, 'Serif', Monospace", ("serif", "Serif", "monospace")),
        (" , , ", ()),
        ("", ()),
    ],
)
def test_families_are_names_and_generic_words(text: str, expected: tuple[str, ...]) -> None:
    assert families(text) == expected


def test_widths_are_words_or_percentages() -> None:
    assert [stretch(text) for text in ("condensed", "62.5%", "nonsense")] == [75.0, 62.5, 100.0]


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ({}, ()),
        ({"font_variant": "small-caps"}, ("smcp",)),
        ({"font_variant_numeric": "tabular-nums slashed-zero"}, ("tnum", "zero")),
        ({"font_kerning": "none"}, ("-kern",)),
        ({"letter_spacing": "3.0"}, ("-liga", "-clig")),
        ({"letter_spacing": "0"}, ()),
        (
            {"font_feature_settings": "'ss01', \"swsh\" 2, 'kern' off, 'liga' on"},
            ("ss01=1", "swsh=2", "kern=0", "liga=1"),
        ),
        ({"font_feature_settings": "'long1', 'a b!' 1, 'salt' 1.5"}, ()),
    ],
)
def test_features_of_a_style(given: dict[str, str], expected: tuple[str, ...]) -> None:
    assert features(style(**given)) == expected


def test_axes_are_sorted_and_the_last_value_of_one_counts() -> None:
    assert variations("'wght' 700, 'slnt' -5.5, 'wght' 300") == (("slnt", -5.5), ("wght", 300.0))
    assert variations("normal") == ()


def test_a_query_has_all_that_chooses_a_font() -> None:
    element = etree.fromstring('<g xml:lang="de-CH"><text/></g>')[0]
    query = query_of(style(font_weight="bold", font_style="Oblique 10deg", font_size_adjust="ex-height 0.5"), element)
    assert (query.weight, query.style, query.stretch, query.size) == (700.0, "oblique", 100.0, 20.0)
    assert (query.adjust, query.language) == (0.5, "de-CH")
    assert query_of(style(), element).adjust is None
    assert query_of(style(), element) == query_of(style(font_weight="400"), element)
