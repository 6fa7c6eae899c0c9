"""Gradients of CSS behind a drawing."""

from pathlib import Path

import numpy as np
import pytest

from vexture.base.errors import SourceWarning
from vexture.drawing.paint import Paint
from vexture.svg.read import read_svg


def background(tmp_path: Path, value: str, more: str = "") -> tuple[Paint, np.ndarray]:
    """Paint of the background of a drawing of 80 x 40, and the map from its pixels to the paint's coordinates."""
    file = tmp_path / "background.svg"
    style = f"background: {value}; {more}"
    root = f'xmlns="http://www.w3.org/2000/svg" width="80" height="40" style="{style}"'
    file.write_text(f'<svg {root}><path d="M0 0h9v9"/></svg>')
    drawing = read_svg(file)
    to_square = np.linalg.inv(np.vstack([drawing.to_source, [0.0, 0.0, 1.0]]))
    return drawing.paths[0].paint, to_square


def ramp_at(paint: Paint, to_square: np.ndarray, x: float, y: float) -> np.ndarray:
    """Place of a pixel in the ramp's own coordinates."""
    assert paint.gradient is not None
    return np.array(paint.gradient.to_ramp) @ to_square @ (x, y, 1.0)


def test_halfway_to_a_corner_runs_through_the_two_others(tmp_path: Path) -> None:
    paint, to_square = background(tmp_path, "linear-gradient(to top right, red, blue)")
    places = [ramp_at(paint, to_square, *corner)[0] for corner in ((0, 40), (0, 0), (80, 40), (80, 0))]
    np.testing.assert_allclose(places, [0.0, 0.5, 0.5, 1.0], atol=1e-9)


def test_an_angle_turns_from_the_top_and_its_line_ends_at_corners(tmp_path: Path) -> None:
    paint, to_square = background(tmp_path, "linear-gradient(30deg, red, blue 50%)")
    places = [ramp_at(paint, to_square, *place)[0] for place in ((0, 40), (40, 20), (40, 0), (80, 0))]
    above = np.cos(np.radians(30)) * 20 / (80 * np.sin(np.radians(30)) + 40 * np.cos(np.radians(30)))
    np.testing.assert_allclose(places, [0.0, 1.0, 1.0 + 2.0 * above, 2.0], atol=1e-9)


def test_a_radial_gradient_ends_in_the_farthest_corner_in_the_ratio_of_its_sides(tmp_path: Path) -> None:
    paint, to_square = background(tmp_path, "radial-gradient(at 20% 30%, red, blue)")
    np.testing.assert_allclose(np.hypot(*ramp_at(paint, to_square, 80, 40)), 1.0)
    across, down = np.hypot(*ramp_at(paint, to_square, 80, 12)), np.hypot(*ramp_at(paint, to_square, 16, 40))
    np.testing.assert_allclose([across, down], 0.5**0.5)


def test_a_radial_gradient_that_begins_before_its_middle_is_cut_there(tmp_path: Path) -> None:
    paint, _ = background(tmp_path, "radial-gradient(red -100%, blue 100%)")
    assert paint.gradient is not None
    assert [(stop.offset, stop.color) for stop in paint.gradient.stops] == [(0, (0.5, 0, 0.5)), (1, (0, 0, 1))]
    paint, to_square = background(tmp_path, "repeating-radial-gradient(circle 20px, red -50%, blue 25%)")
    assert paint.gradient is not None
    assert paint.gradient.focus == pytest.approx((0.0, 0.25))  # the same, three quarters of the radius farther out
    np.testing.assert_allclose(np.hypot(*ramp_at(paint, to_square, 60, 20)), 1.0)


def test_colours_of_css_are_mixed_premultiplied(tmp_path: Path) -> None:
    paint, _ = background(tmp_path, "linear-gradient(rgb(255 0 0), rgb(0 0 255 / 0))")
    assert paint.gradient is not None
    for stop in paint.gradient.stops[:-1]:
        assert stop.color == (1.0, 0.0, 0.0)
        assert stop.opacity == pytest.approx(1.0 - stop.offset)


@pytest.mark.parametrize(
    ("value", "more"),
    [
        ("linear-gradient(red, blue), linear-gradient(green, teal)", ""),
        ("linear-gradient(red, 30%, blue)", ""),
        ("linear-gradient(in oklab, red, blue)", ""),
        ("conic-gradient(red, blue)", ""),
        ("radial-gradient(at right 10px bottom 5px, red, blue)", ""),
        ("linear-gradient(red, blue)", "background-size: 9px 9px"),
        ("linear-gradient(red, blue)", "background-blend-mode: multiply; background-color: red"),
    ],
)
def test_backgrounds_that_are_not_drawn_are_named(tmp_path: Path, value: str, more: str) -> None:
    with pytest.warns(SourceWarning, match="background-image of the outermost <svg>"):
        background(tmp_path, value, more)
