"""Numbers and lengths: units, percentages, and limits."""

import pytest

from vexture.svg.values import (
    LARGEST,
    TooLargeError,
    Viewport,
    bounded_number,
    fraction,
    is_relative,
    number,
    numbers,
    words,
)

VIEW = Viewport(200.0, 100.0, root_font_size=10.0)


@pytest.mark.parametrize(
    ("text", "length"),
    [
        ("1in", 96.0),
        ("2.54cm", 96.0),
        ("25.4MM", 96.0),
        ("101.6q", 96.0),
        ("72pt", 96.0),
        ("6pc", 96.0),
        ("7", 7.0),
        ("-7px", -7.0),
        ("2em", 40.0),
        ("2ex", 20.0),
        ("2rem", 20.0),
        ("25%", 50.0),
        ("10vw", 20.0),
        ("10svh", 10.0),
        ("10vmin", 10.0),
        ("10lvmax", 20.0),
        ("calc(10% + 1em)", 40.0),
        ("7kg", None),
        ("7 px 3", None),
        ("calc(1deg)", None),
        ("", None),
    ],
)
def test_lengths_in_user_units(text: str, length: float | None) -> None:
    assert VIEW.length(text, 200.0, 20.0) == (None if length is None else pytest.approx(length))


def test_units_of_the_view_refer_to_the_outermost_one() -> None:
    inner = Viewport(8.0, 6.0, outermost=(200.0, 100.0))
    assert inner.length("10vw", inner.width, 16.0) == 20.0
    assert inner.length("10%", inner.width, 16.0) == pytest.approx(0.8)
    assert inner.diagonal == pytest.approx(50**0.5)
    across = inner.along(16.0)
    assert (across("50%", 0), across("50%", 1)) == (4.0, 3.0)


def test_numbers_are_numbers_only() -> None:
    assert [number(text) for text in (" 1e3 ", "+.5", "calc(2 * 3)", "3px", "50%", "1 2", "nan", "0x1")] == [
        *(1000.0, 0.5, 6.0),
        *(None,) * 5,
    ]
    assert numbers(" 1, 2  3 ") == [1.0, 2.0, 3.0]
    assert numbers("1 2 x") is None


def test_fractions_are_clipped() -> None:
    texts = ("0.25", "25%", "-1", "7", "700%", "calc(20% + 5%)", "1px", "?", "calc(1px)")
    assert [fraction(text) for text in texts] == [0.25, 0.25, 0.0, 1.0, 1.0, 0.25, None, None, None]


def test_too_large_numbers_are_refused() -> None:
    assert bounded_number(LARGEST) == LARGEST
    for text in ("1.1e12", "-1e400", "calc(1e6 * 1e7)", "calc(1 / 0)"):
        with pytest.raises(TooLargeError, match=r"is too large; the limit is 1e\+12"):
            number(text)
    assert number("calc(0 / 0)") == 0.0


def test_words_stand_apart_outside_of_brackets() -> None:
    assert words("a, b c") == ["a", "b", "c"]
    assert words("rgb(1, 2) url(a b)  c") == ["rgb(1, 2)", "url(a b)", "c"]
    assert words("  ") == []


def test_relative_lengths_need_a_view() -> None:
    texts = ("50%", "3vw", "3DVMAX", "3px", "3em", "calc(1px + 2vh)")
    assert [is_relative(text) for text in texts] == [True, True, True, False, False, True]
