"""Values of font properties: sizes and weights that depend on the parent's, and the shorthand."""

import pytest

from vexture.svg.font_values import font_longhands, font_weight, in_pixels, text_size
from vexture.svg.values import Viewport

VIEW = Viewport(200.0, 100.0, root_font_size=10.0)


@pytest.mark.parametrize(
    ("text", "size"),
    [
        *(("Medium", 16.0), ("larger", 24.0), ("SMALLER", 20 / 1.2), ("150%", 30.0), ("2em", 40.0), ("2rem", 20.0)),
        *(("12pt", 16.0), ("-3px", 0.0), ("nonsense", 0.0)),
    ],
)
def test_sizes_refer_to_the_parents(text: str, size: float) -> None:
    assert text_size(text, 20.0, VIEW) == pytest.approx(size)


BOLDER = [(100, 400), (349, 400), (350, 700), (549, 700), (550, 900), (899, 900), (950, 950)]
LIGHTER = [(50, 50), (100, 100), (549, 100), (550, 400), (749, 400), (750, 700), (900, 700), (1000, 700)]


@pytest.mark.parametrize(
    ("word", "parent", "weight"),
    [("bolder", parent, weight) for parent, weight in BOLDER] + [("lighter", *pair) for pair in LIGHTER],
)
def test_relative_weights_are_those_of_the_table_in_the_standard(word: str, parent: float, weight: float) -> None:
    """CSS Fonts 4, 2.2.1."""
    assert font_weight(word, str(parent)) == weight


def test_weights_stay_within_their_range() -> None:
    found = [font_weight(text) for text in ("normal", "BOLD", "0.5", "2000", "350", "nonsense")]
    assert found == [400.0, 700.0, 1.0, 1000.0, 350.0, 400.0]


def test_spacings_no_longer_depend_on_a_font() -> None:
    assert [in_pixels(text, 20.0, VIEW) for text in ("0.5em", "3px", "normal")] == ["10.0", "3.0", "0"]


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ("12px serif", {"font-size": "12px", "font-family": "serif"}),
        (
            "oblique small-caps bold condensed 2em/1.5 'A, B', serif",
            {
                "font-style": "oblique",
                "font-variant": "small-caps",
                "font-weight": "bold",
                "font-stretch": "condensed",
                "font-size": "2em",
                "font-family": "'A, B', serif",
            },
        ),
        ("300 12px serif", {"font-weight": "300", "font-size": "12px", "font-family": "serif"}),
        ("normal normal 12px serif", {"font-size": "12px", "font-family": "serif"}),
    ],
)
def test_the_shorthand_sets_all_of_its_properties(value: str, expected: dict[str, str]) -> None:
    usual = dict.fromkeys(("font-style", "font-variant", "font-weight", "font-stretch"), "normal")
    assert dict(font_longhands(value)) == usual | expected


@pytest.mark.parametrize("value", ["12px", "serif", "bold serif", "caption", "12px inherit", "red 12px", ""])
def test_a_shorthand_without_a_size_and_a_family_sets_nothing(value: str) -> None:
    assert [pair for pair in font_longhands(value) if pair[0] in ("font-size", "font-family")] == []
