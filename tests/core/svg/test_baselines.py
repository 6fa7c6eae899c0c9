"""Baselines of texts: heights that follow from the metrics of the font, as fontTools reads them."""

from pathlib import Path

import pytest
from plainer_texts import SIZE, font, top_and_bottom
from svg_texts import drawn

ASCENT, DESCENT = (getattr(font()["hhea"], name) * SIZE / font()["head"].unitsPerEm for name in ("ascent", "descent"))
X_HEIGHT = top_and_bottom("x")[0] * SIZE


def drop(folder: Path, attributes: str, spans: str = "h") -> float:
    """Distance of the baseline of an h from the line of its text, downwards in user units."""
    drawing = drawn(folder, f'<text x="10" y="50" {attributes}>{spans}</text>')
    _, high = drawing.paths[-1].box.tolist()
    return 100.0 * (1.0 - high[1]) + top_and_bottom("h")[0] * SIZE - 50.0


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("auto", 0.0),
        ("alphabetic", 0.0),
        ("text-before-edge", ASCENT),
        ("text-after-edge", DESCENT),
        ("central", (ASCENT + DESCENT) / 2.0),
        ("middle", X_HEIGHT / 2.0),
        ("hanging", 0.8 * ASCENT),
        ("mathematical", 0.5 * ASCENT),
    ],
)
def test_a_baseline_of_the_font_lies_on_the_line(tmp_path: Path, name: str, expected: float) -> None:
    assert drop(tmp_path, f'dominant-baseline="{name}"') == pytest.approx(expected, abs=1e-6)


def test_a_part_has_the_dominant_baseline_around_it_or_its_own_alignment(tmp_path: Path) -> None:
    hanging = 'dominant-baseline="hanging"'
    same = drop(tmp_path, hanging, '<tspan dominant-baseline="no-change">h</tspan>')
    own = drop(tmp_path, hanging, '<tspan alignment-baseline="middle">h</tspan>')
    assert same == pytest.approx(0.8 * ASCENT, abs=1e-6)
    assert own == pytest.approx(X_HEIGHT / 2.0, abs=1e-6)


@pytest.mark.parametrize(("shift", "expected"), [("3", -3.0), ("25%", -SIZE / 4.0), ("-1em", SIZE), ("baseline", 0.0)])
def test_shifts_move_up_and_add_up(tmp_path: Path, shift: str, expected: float) -> None:
    once = f'<tspan baseline-shift="{shift}">h</tspan>'
    twice = f'<tspan baseline-shift="{shift}">{once}</tspan>'
    assert drop(tmp_path, "", once) == pytest.approx(expected, abs=1e-6)
    assert drop(tmp_path, "", twice) == pytest.approx(2.0 * expected, abs=1e-6)
    assert drop(tmp_path, f'baseline-shift="{shift}"') == pytest.approx(0.0, abs=1e-6)


def test_superscripts_rise_as_the_font_says(tmp_path: Path) -> None:
    rise = font()["OS/2"].ySuperscriptYOffset * SIZE / font()["head"].unitsPerEm
    assert drop(tmp_path, "", '<tspan baseline-shift="super">h</tspan>') == pytest.approx(-rise, abs=1e-6)
