"""Colours of CSS and paints that refer to others."""

import colorsys

import pytest

from vexture.drawing.colors import parse_color, parse_paint


def rgba(text: str) -> tuple[float, ...] | None:
    found = parse_color(text)
    assert not isinstance(found, str)
    return None if found is None else (*found.rgb, found.alpha)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("RebeccaPurple", (0x66 / 255, 0x33 / 255, 0x99 / 255, 1.0)),
        (" #48c8 ", (0x44 / 255, 0x88 / 255, 0xCC / 255, 0x88 / 255)),
        ("#4080C0", (0x40 / 255, 0x80 / 255, 0xC0 / 255, 1.0)),
        ("rgb(300, -20, 51)", (1.0, 0.0, 0.2, 1.0)),
        ("rgb(20% 40% 60% / 50%)", (0.2, 0.4, 0.6, 0.5)),
        ("transparent", (0.0, 0.0, 0.0, 0.0)),
        ("hwb(0 50% 50%)", (0.5, 0.5, 0.5, 1.0)),
    ],
)
def test_colours_are_those_of_css(text: str, expected: tuple[float, ...]) -> None:
    assert rgba(text) == pytest.approx(expected)


@pytest.mark.parametrize("hue", range(0, 360, 25))
def test_hsl_is_that_of_python(hue: int) -> None:
    found = rgba(f"hsl({hue} 70% 30%)")
    assert found is not None
    assert found[:3] == pytest.approx(colorsys.hls_to_rgb(hue / 360, 0.3, 0.7))


def test_saturation_and_lightness_are_clamped_before_they_are_converted() -> None:
    assert rgba("hsl(120 200% 50%)") == pytest.approx((0.0, 1.0, 0.0, 1.0))
    assert rgba("hsl(120 50% 200%)") == pytest.approx((1.0, 1.0, 1.0, 1.0))


@pytest.mark.parametrize(
    "text", ["", "reddish", "#12", "#12345", "rgb(1 2)", "hsl(0, 1, 2)", "rgb(1, 2 3)", "red blue", "#" + "f" * 10**6]
)
def test_what_is_no_colour_is_none(text: str) -> None:
    assert parse_color(text) is None


def test_a_colour_of_the_element_waits_for_it() -> None:
    own = parse_color("rgb(0 0 255 / 0.5)")
    assert not isinstance(own, str)
    mixture = "color-mix(in srgb, currentcolor, white)"
    assert parse_color("currentColor", own) == own
    assert parse_color(mixture) == mixture
    found = parse_color(mixture, own)
    assert found is not None
    assert not isinstance(found, str)
    assert found.alpha == pytest.approx(0.75)


def test_paints_have_a_reference_a_colour_or_both() -> None:
    red, found = parse_color("red"), parse_paint("url(#a)  red")
    assert found is not None
    assert (found.reference, found.color) == ("#a", red)
    assert parse_paint("url('#b') none") == ("#b", None)
    assert parse_paint(" none ") == (None, None)
    assert parse_paint("context-stroke") == (None, "context-stroke")
    assert parse_paint("red icc-color(acme, 0.1)") == (None, red)
    assert parse_paint("reddish") is None
