"""Angular gradients, as Figma writes them: a box of HTML in a `foreignObject`, clipped by the shape."""

import numpy as np
import pytest
from svg_reference import render_drawing

from vexture.drawing.drawing import Drawing
from vexture.svg.read import svg_drawing

SIDE = 120
WHOLE = "height:100%;width:100%;opacity:1"
BOX = 'x="-1000" y="-1000" width="2000" height="2000"'


def drawn(
    gradient: str, style: str = "height:100%;width:100%;opacity:1", matrix: str = "0 .02 -.02 0 24 24"
) -> Drawing:
    """A gradient in a shape, as Figma exports it."""
    div = f'<div xmlns="http://www.w3.org/1999/xhtml" style="background:{gradient};{style}"></div>'
    html = f'<g transform="matrix({matrix})"><foreignObject id="fill" {BOX}>{div}</foreignObject></g>'
    clip = '<clipPath id="c"><rect x="4" y="4" width="40" height="40"/></clipPath>'
    return svg_drawing(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 48 48" fill="none">{clip}'
        f'<g clip-path="url(#c)" data-figma-skip-parse="true">{html}</g>'
        '<rect x="4" y="4" width="40" height="40" data-figma-gradient-fill="{}"/></svg>'.encode(),
        "a.svg",
    )


def turns(x: float = 24.0, y: float = 24.0) -> np.ndarray:
    """Turns of each pixel, clockwise from the top of the page, about a point of the view box."""
    at = (np.arange(SIDE) + 0.5) * 48 / SIDE
    across, down = np.meshgrid(at - x, at - y)
    return (np.arctan2(across, -down) / (2.0 * np.pi)) % 1.0


def seen(drawing: Drawing) -> np.ndarray:
    """Pixels of the drawing, premultiplied, 0..255."""
    return 255.0 * render_drawing(drawing, SIDE, SIDE)


def inside(x: float = 24.0, y: float = 24.0) -> np.ndarray:
    """Pixels in the shape, but for those near a point, where sectors are narrower than pixels."""
    at = (np.arange(SIDE) + 0.5) * 48 / SIDE
    across, down = np.meshgrid(at, at)
    shown = (abs(across - 24.0) < 19.0) & (abs(down - 24.0) < 19.0)
    return shown & (np.hypot(across - x, down - y) > 4.0)


def ramp(at: np.ndarray, places: list[float], colors: list[tuple[float, ...]]) -> np.ndarray:
    """Colours of a ramp at some places."""
    return np.stack([np.interp(at, places, channel) for channel in zip(*colors, strict=True)], axis=-1)


def test_colours_turn_about_the_middle() -> None:
    drawing = drawn("conic-gradient(from 90deg, rgb(255 60 60) 0deg, rgb(60 200 90) 180deg, rgb(60 90 255) 360deg)")
    # the group turns the box by a quarter, and the gradient begins a quarter later: both clockwise
    at = (turns() - 0.5) % 1.0
    right = ramp(at, [0.0, 0.5, 1.0], [(255, 60, 60), (60, 200, 90), (60, 90, 255)])
    off = abs(seen(drawing)[..., :3] - right).max(axis=2)
    where = inside() & (abs(at - 0.0) > 0.02) & (abs(at - 1.0) > 0.02)
    assert off[where].max() < 4.0
    assert [str(note) for note in drawing.notes] == ["angular gradient drawn in 91 sectors"]
    assert {path.element for path in drawing.paths if path.group < 0 or not drawing.groups[path.group].mask} == {"fill"}


def test_stops_fade_and_stand_where_they_are_said() -> None:
    drawing = drawn("conic-gradient(at 25% 50%, rgb(255 0 0 / 0) 25%, red 0.75turn)", matrix=".024 0 0 .024 24 24")
    at = turns(12.0)
    right = 255.0 * np.interp(at, [0.25, 0.75], [0.0, 1.0])
    off = abs(seen(drawing)[..., 3] - right)
    where = inside(12.0) & (abs(at - 0.0) > 0.02) & (abs(at - 1.0) > 0.02)
    assert np.quantile(off[where], 0.8) < 4.0  # others are at the borders of sectors, where Skia shows what is below


def test_hard_stops_are_exact_and_need_no_note() -> None:
    drawing = drawn("conic-gradient(red 0 90deg, blue 90deg 360deg)", matrix=".02 0 0 .02 24 24")
    at = turns()
    quarter = (at > 0.03) & (at < 0.22) & inside()
    others = (at > 0.28) & (at < 0.97) & inside()
    assert drawing.notes == ()
    assert np.ptp(seen(drawing)[quarter], axis=0).max() < 1.0
    assert seen(drawing)[quarter][0].tolist() == pytest.approx([255.0, 0.0, 0.0, 255.0], abs=1.0)
    assert seen(drawing)[others].min(axis=0).tolist() == pytest.approx([0.0, 0.0, 255.0, 255.0], abs=1.0)


def test_gradient_repeats() -> None:
    drawing = drawn("repeating-conic-gradient(black 0%, white 25%)", matrix=".02 0 0 .02 24 24")
    part = turns() * 4.0 % 1.0
    off = abs(seen(drawing)[..., 0] - 255.0 * part)
    assert off[inside() & (part > 0.1) & (part < 0.9)].max() < 12.0  # a pixel near the middle holds several sectors


def test_sectors_are_bounded() -> None:
    colours = ", ".join(f"hsl({40 * k} 100% 50%)" for k in range(60))
    (note,) = drawn(f"conic-gradient({colours})").notes
    count = int(note.message.split()[-2])
    assert 180 <= count <= 180 + 60


def test_opacity_of_the_box_counts() -> None:
    drawing = drawn("conic-gradient(red, red)", "height:100%;width:100%;opacity:.5")
    assert seen(drawing)[SIDE // 2, 30].tolist() == pytest.approx([127.5, 0.0, 0.0, 127.5], abs=1.0)
    assert drawing.notes == ()


@pytest.mark.parametrize(
    "gradient",
    ["linear-gradient(red, blue)", "conic-gradient(in hsl, red, blue)", "conic-gradient(red, blue), red", "red"],
)
def test_other_content_is_left_out_and_named(gradient: str) -> None:
    assert [str(note) for note in drawn(gradient).notes if note.kind == "left out"] == ["<foreignObject>"]


MANY = ", ".join(["red", "blue"] * 200)


@pytest.mark.parametrize(
    "gradient",
    [
        *("repeating-conic-gradient(red 0deg, blue .1deg)", "conic-gradient(from left, red, blue)"),
        *(f"conic-gradient({MANY})", "repeating-conic-gradient(red, blue, red, blue, red, blue 3deg)"),
    ],
)
def test_gradient_that_cannot_be_drawn_is_named(gradient: str) -> None:
    assert [str(note) for note in drawn(gradient).notes if note.kind == "left out"] == ["angular gradient"]


def test_part_of_a_box_is_not_taken_for_all_of_it() -> None:
    notes = drawn("conic-gradient(red, blue)", "height:50%;width:100%").notes
    assert [str(note) for note in notes if note.kind == "left out"] == ["<foreignObject>"]
