"""Functions of CSS colours: examples of CSS Color 4 and 5, and the formulas of its spaces."""

import pytest
import tinycss2

from vexture.drawing.color_functions import Rgba, color_of_function


def color(text: str, current: Rgba | None = None) -> Rgba | None:
    return color_of_function(tinycss2.parse_one_component_value(text), current)


def encoded(linear: float) -> float:
    """Component of sRGB (IEC 61966-2-1)."""
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("color(srgb 0.25 0.5 1 / 20%)", (0.25, 0.5, 1.0, 0.2)),
        ("color(srgb-linear 0.5 0.001 1)", (encoded(0.5), encoded(0.001), 1.0, 1.0)),
        ("lab(100 0 0)", (1.0, 1.0, 1.0, 1.0)),
        ("oklch(50% -3 40)", (encoded(0.125), encoded(0.125), encoded(0.125), 1.0)),
        ("oklch(62.7955% 0.25768 29.2339)", (1.0, 0.0, 0.0, 1.0)),
        ("lab(54.2917 80.8125 69.8851)", (1.0, 0.0, 0.0, 1.0)),
        ("color(xyz-d65 0.4124 0.2126 0.0193)", (1.0, 0.0, 0.0, 1.0)),
        ("rgb(calc(255 / 2) 0 0)", (0.5, 0.0, 0.0, 1.0)),
    ],
)
def test_spaces_lead_to_srgb(text: str, expected: Rgba) -> None:
    found = color(text)
    assert found is not None
    assert found[3] == expected[3]
    assert [min(max(part, 0.0), 1.0) for part in found[:3]] == pytest.approx(expected[:3], abs=2e-3)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("color-mix(in srgb, red, blue)", (0.5, 0.0, 0.5, 1.0)),
        ("color-mix(in srgb, red 30%, blue)", (0.3, 0.0, 0.7, 1.0)),
        ("color-mix(in srgb, red, blue 30%)", (0.7, 0.0, 0.3, 1.0)),
        ("color-mix(in srgb, red 20%, blue 20%)", (0.5, 0.0, 0.5, 0.4)),
        ("color-mix(in srgb, red 100%, blue 100%)", (0.5, 0.0, 0.5, 1.0)),
        ("color-mix(in srgb, rgb(255 0 0 / 0.2) 25%, rgb(0 0 255 / 0.8))", (0.05 / 0.65, 0.0, 0.6 / 0.65, 0.65)),
        ("color-mix(in hsl, hsl(20 100% 50%), hsl(340 100% 50%))", (1.0, 0.0, 0.0, 1.0)),
        ("color-mix(in hsl longer hue, hsl(20 100% 50%), hsl(340 100% 50%))", (0.0, 1.0, 1.0, 1.0)),
        ("light-dark(lime, red)", (0.0, 1.0, 0.0, 1.0)),
    ],
)
def test_mixtures_are_premultiplied_shares(text: str, expected: Rgba) -> None:
    assert color(text) == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("rgb(from rgb(10 20 30 / 0.4) b g r)", (30 / 255, 20 / 255, 10 / 255, 0.4)),
        ("rgb(from red r g b / calc(alpha / 4))", (1.0, 0.0, 0.0, 0.25)),
        ("hsl(from red calc(h + 120) s l)", (0.0, 1.0, 0.0, 1.0)),
        ("color(from lime srgb g r b)", (1.0, 0.0, 0.0, 1.0)),
        ("rgb(from currentcolor calc(r / 2) g b)", (0.1, 0.4, 0.6, 0.5)),
    ],
)
def test_colours_are_made_of_the_channels_of_others(text: str, expected: Rgba) -> None:
    assert color(text, (0.2, 0.4, 0.6, 0.5)) == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(
    "text",
    [
        *("color(cmyk 0 0 0 1)", "color(lab 1 1 1)", "nope(1 2 3)", "color-mix(in srgb, red)"),
        "color-mix(red, blue, lime)",
        *("color-mix(in srgb, red 110%, blue)", "color-mix(in srgb, red -1%, blue)", "color-mix(in cmyk, red, blue)"),
        *("color-mix(in hsl wrong hue, red, blue)", "color-mix(in srgb, red 10% 20%, blue)", "rgb(from red)"),
        *("rgb(from nothing r g b)", "hsl(from red r g b)", "light-dark(red)"),
    ],
)
def test_what_is_not_valid_is_no_colour(text: str) -> None:
    assert color(text) is None
