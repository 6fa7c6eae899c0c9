"""Gradients of a picture are found again."""

import numpy as np
import pytest
from shaded_pictures import drawn, opaque, pixels_of, premultiplied, traced

GRADIENTS = {
    "black to white": '<linearGradient id="a"><stop/><stop offset="1" stop-color="#fff"/></linearGradient>',
    "two hues": '<linearGradient id="a"><stop stop-color="#e61e28"/><stop offset="1" stop-color="#1e3cdc"/>'
    "</linearGradient>",
    "diagonal": '<linearGradient id="a" x2="1" y2="1"><stop stop-color="#ffd633"/><stop offset=".4" stop-color="#2a8"/>'
    '<stop offset="1" stop-color="#d1203a"/></linearGradient>',
    "there and back": '<linearGradient id="a" x2=".5" spreadMethod="reflect"><stop stop-color="#fff4c0"/>'
    '<stop offset="1" stop-color="#803090"/></linearGradient>',
    "to nothing": '<linearGradient id="a"><stop stop-color="#e61e28"/><stop offset="1" stop-color="#e61e28" '
    'stop-opacity="0"/></linearGradient>',
    "radial": '<radialGradient id="a" gradientUnits="userSpaceOnUse" cx="100" cy="40" r="210">'
    '<stop stop-color="#fff4c0"/><stop offset="1" stop-color="#803090"/></radialGradient>',
    "turned ellipse": '<radialGradient id="a" gradientUnits="userSpaceOnUse" cx="0" cy="0" r="190" '
    'gradientTransform="translate(160 50) rotate(25) scale(1 .6)"><stop stop-color="#fff4c0"/>'
    '<stop offset="1" stop-color="#803090"/></radialGradient>',
}

BUTTON = """<linearGradient id="a" x2="1" y2="1"><stop stop-color="#ffd633"/><stop offset="1" stop-color="#d1203a"/>
</linearGradient>
<radialGradient id="b"><stop stop-color="#fff"/><stop offset="1" stop-color="#1060c0"/></radialGradient>
<rect x="20" y="20" width="200" height="120" rx="20" fill="url(#a)"/><circle cx="80" cy="80" r="44" fill="url(#b)"/>
<path fill="#2e8b57" d="M160 40h40v80h-40z"/>"""


@pytest.mark.parametrize("name", GRADIENTS)
def test_a_gradient_is_found_again(name):
    pixels = pixels_of(f'{GRADIENTS[name]}<rect width="300" height="100" fill="url(#a)"/>', (300, 100))
    drawing, off = traced(pixels)
    assert [path.paint.gradient is not None for path in drawing.paths] == [True]
    assert (drawing.paths[0].paint.gradient.focus is not None) == ("radial" in GRADIENTS[name])
    assert off.mean() < 0.6
    assert len(drawing.paths[0].paint.gradient.stops) <= 12


def test_noise_hides_no_gradient():
    pixels = pixels_of(f'{GRADIENTS["two hues"]}<rect width="300" height="100" fill="url(#a)"/>', (300, 100))
    noise = np.random.default_rng(0).normal(0, 3, (100, 300, 3))
    noisy = np.dstack([np.clip(pixels[..., :3] + noise, 0, 255).astype(np.uint8), pixels[..., 3]])
    drawing, _ = traced(noisy)
    assert [path.paint.gradient is not None for path in drawing.paths] == [True]
    assert np.abs(drawn(drawing, (300, 100)) - premultiplied(pixels)).mean() < 1.0


@pytest.mark.parametrize("background", ["transparent", pytest.param("white", marks=pytest.mark.slow)])
@pytest.mark.parametrize("scale", [1, *(pytest.param(other, marks=pytest.mark.slow) for other in (0.8, 2.5))])
def test_areas_of_a_drawing_keep_their_gradients_and_colours(scale, background):
    size = (round(240 * scale), round(160 * scale))
    pixels = pixels_of(f'<g transform="scale({scale})">{BUTTON}</g>', size)
    drawing, off = traced(pixels if background == "transparent" else opaque(pixels))
    gradients = [path.paint.gradient for path in drawing.paths if path.paint.gradient is not None]
    assert sorted(gradient.focus is not None for gradient in gradients) == [False, True]
    assert "#2e8b57" in [path.paint.hex for path in drawing.paths]
    assert off.mean() < 0.6
