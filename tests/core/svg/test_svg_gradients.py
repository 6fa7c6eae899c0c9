"""Gradients of an SVG, at the edges of the standard; the fixtures in `gradients` are compared as pictures elsewhere."""

import warnings
from pathlib import Path

import numpy as np
import pytest
from plainer import plainer
from svg_reference import render_drawing, render_file

import vexture
from vexture.base.errors import SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import Paint
from vexture.renderers.exact import render_exact_colours
from vexture.svg.read import read_svg

STOPS = '<stop stop-color="red"/><stop offset="1" stop-color="blue"/>'
LIME, BLACK = '<stop offset="{}" stop-color="lime"/>', '<stop offset="{}"/>'
RED, GREEN, BLUE, NOTHING = "ff0000", "00ff00", "0000ff", "none"
SQUARE = '<rect width="100" height="100" fill="url(#g){}"/>'


def drawing_of(body: str) -> Drawing:
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        return vexture.read(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{body}</svg>'.encode())


def linear(attributes: str, stops: str = STOPS, fallback: str = "") -> str:
    gradient = f'<linearGradient id="g" gradientUnits="userSpaceOnUse" x2="100" {attributes}>{stops}</linearGradient>'
    return gradient + SQUARE.format(fallback)


def radial(attributes: str) -> str:
    gradient = f'<radialGradient id="g" gradientUnits="userSpaceOnUse" cx="50" cy="50" {attributes}>{STOPS}'
    return f"{gradient}</radialGradient>{SQUARE.format('')}"


def colors(drawing: Drawing) -> list[str]:
    """What Skia draws in three pixels of the middle row."""
    row = render_drawing(drawing, 100, 100)[50, (5, 50, 95), :]
    return [bytes(np.uint8(np.rint(255 * pixel[:3]))).hex() if pixel[3] else NOTHING for pixel in row]


CASES = {
    "negative radius": (radial('r="-20"'), [BLUE] * 3),
    "no radius": (radial('r="0" fr="9"'), [BLUE] * 3),
    "negative focal radius": (radial('r="20" fr="-10"'), [BLUE, "f60009", BLUE]),
    "focal circle equal to the outer one": (radial('r="20" fr="20" spreadMethod="repeat"'), [BLUE, RED, BLUE]),
    "focal point outside": (radial('r="20" fx="90"'), [BLUE, BLUE, NOTHING]),
    "focal point on the circle, nearly": (radial('r="20" fx="70.0001"'), [BLUE, "82007c", NOTHING]),
    "radius without meaning": (radial('r="abc"'), ["1c00e3", "fb0003", "1700e8"]),
    "no length": (linear('x1="50" x2="50" y1="10" y2="10" spreadMethod="repeat"').replace(' x2="100"', ""), [BLUE] * 3),
    "singular transform": (linear('gradientTransform="scale(0 1)"'), [NOTHING] * 3),
    "singular transform, fallback": (linear('gradientTransform="scale(0 1)"', STOPS, " lime"), [GREEN] * 3),
    "invalid transform": (linear('gradientTransform="translate(50) melt(3)"'), ["f1000e", "7e0081", "0b00f4"]),
    "no stops": (linear("", ""), [NOTHING] * 3),
    "no stops, fallback": (linear("", "", " lime"), [NOTHING] * 3),
    "one stop": (linear("", LIME.format(0.5)), [GREEN] * 3),
    "one transparent stop": (linear("", '<stop stop-opacity="0"/>'), [NOTHING] * 3),
    "offset without meaning": (linear("", LIME.format(0.5) + BLACK.format("abc")), [GREEN, "000000", "000000"]),
    "offsets beyond": (linear("", LIME.format(-1) + BLACK.format("200%")), ["00f100", "007e00", "000b00"]),
    "stops in a group are none": (linear("", f"<g>{STOPS}</g>"), [NOTHING] * 3),
    "a reference to no gradient": (linear('href="#r"') + '<rect id="r"/>', ["f1000e", "7e0081", "0b00f4"]),
    "references in a circle": (
        f'<linearGradient id="g" href="#h"/><linearGradient id="h" href="#g"/>{SQUARE.format("")}',
        [NOTHING] * 3,
    ),
    "unit of a box": (
        f'<linearGradient id="g" x2="10px">{STOPS}</linearGradient>{SQUARE.format("")}',
        ["fe0001", "f2000d", "e70018"],
    ),
}
"""What Chromium draws, but for gradients that repeat in no length, of which it draws the mean."""


@pytest.mark.parametrize("name", CASES)
def test_edges_of_the_standard(name: str) -> None:
    body, expected = CASES[name]
    found = colors(drawing_of(body))
    for ours, theirs in zip(found, expected, strict=True):
        assert (ours == NOTHING) == (theirs == NOTHING), found
        if ours != NOTHING:
            levels = [np.frombuffer(bytes.fromhex(text), np.uint8).astype(int) for text in (ours, theirs)]
            assert np.abs(levels[0] - levels[1]).max() <= 1, found


@pytest.mark.parametrize(
    ("body", "said"),
    [
        (radial('r="-20"'), "r='-20' of <radialGradient id=\"g\">"),
        (radial('fr="-20"'), "fr='-20' of <radialGradient id=\"g\">"),
        (radial('fx="3 4"'), "fx='3 4' of <radialGradient id=\"g\">"),
        (linear('spreadMethod="melt"'), "spreadMethod='melt' of <linearGradient id=\"g\">"),
        (linear('gradientTransform="melt()"'), "gradientTransform='melt.*' of <linearGradient id=\"g\">"),
        (linear("", LIME.format("a") + STOPS), "offset='a' of <stop>"),
        (linear("", '<stop stop-color="rot"/>' + STOPS), "stop-color='rot' of <stop>"),
    ],
)
def test_invalid_values_are_named_once(body: str, said: str) -> None:
    said = said.replace("<stop>", "(the 1st )?<stop>")
    with pytest.warns(SourceWarning, match=f"{said}( in line 1)?$"):
        vexture.read(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{body}{body}</svg>'.encode())


def test_opacities_reach_the_stops_and_the_mean() -> None:
    body = linear('fill-opacity="1"', '<stop stop-opacity="0.5"/><stop offset="1" stop-color="blue"/>')
    (path,) = drawing_of(f'<g opacity="0.5" fill-opacity="0.5">{body}</g>').paths
    assert path.paint.gradient is not None
    assert [stop.opacity for stop in path.paint.gradient.stops] == [0.125, 0.25]
    assert path.paint.opacity == 0.1875


def test_layers_are_flat_and_silhouettes_lose_nothing() -> None:
    drawing = drawing_of(linear("") + linear(""))
    (layer,) = drawing.layers()
    assert [path.paint for path in layer.paths] == [Paint((0.5, 0.0, 0.5))] * 2
    assert drawing.notes == ()


FIXTURES = sorted((Path(__file__).parent / "fixtures" / "gradients").glob("*.svg"))
NOT_BY_RESVG = ("attributes-by-reference", "lengths-of-the-other-kind", "stroke-not-scaling")
SIZE, TIMES = 25, 8


@pytest.mark.parametrize(
    "path", [path for path in FIXTURES if path.stem not in NOT_BY_RESVG], ids=lambda path: path.stem
)
def test_exact_colours_are_what_resvg_draws_eight_times_as_large(path: Path) -> None:
    side = f'<svg width="{SIZE * TIMES}" height="{SIZE * TIMES}" '
    text = plainer(f"gradients/{path.stem}") or path.read_text()
    large = render_file(text.replace("<svg ", side, 1))
    mean = large.reshape(SIZE, TIMES, SIZE, TIMES, 4).mean(axis=(1, 3))
    gap = np.abs(render_exact_colours(read_svg(path), SIZE) - mean).max(axis=2)
    assert gap.mean() < 0.5 / 255
    assert gap.max() < 0.05  # half of a pixel of theirs along a jump


def test_a_gradient_of_very_many_stops_keeps_as_many_as_a_pixel_can_run_through() -> None:
    stops = "".join(f'<stop offset="{k / 999}" stop-color="rgb({k // 4},0,{250 - k // 4})"/>' for k in range(1000))
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><linearGradient id="g">{stops}</linearGradient>'
    with pytest.warns(SourceWarning, match="gradient of more than 128 stops, of which as many are kept"):
        drawing = vexture.read(f'{text}<rect width="9" height="9" fill="url(#g)"/></svg>'.encode())
    gradient = drawing.paths[0].paint.gradient
    assert gradient is not None
    assert (len(gradient.stops), gradient.stops[0].offset, gradient.stops[-1].offset) == (128, 0.0, 1.0)


@pytest.mark.parametrize(("focus", "radius"), [(0.3, 0.3), (0.1, 0.1), (0.45, 0.45), (0.05, 0.05)])
def test_a_focal_circle_that_touches_the_end_circle_touches_it_in_the_texture(focus: float, radius: float) -> None:
    """In float32, of decimals, the circles crossed: the picture was one flat colour."""
    gradient = f'<radialGradient id="g" fx="{focus}" fr="{radius}">{STOPS}</radialGradient>'
    drawing = drawing_of(gradient + SQUARE.format(""))
    gap = np.abs(vexture.convert(drawing).render(20) - render_exact_colours(drawing, 20)).max(axis=2)
    assert gap.mean() < 1 / 255
