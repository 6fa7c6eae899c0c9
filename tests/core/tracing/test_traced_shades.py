"""Traced shading: gradients are found again, and what is none is drawn in steps, without seams or holes."""

import numpy as np
import pytest
from PIL import Image, ImageFilter

import vexture
from vexture.svg.read import svg_drawing
from vexture.tracing.shading import pieces
from vexture.tracing.trace import _trace_pixels

pytestmark = pytest.mark.filterwarnings("ignore::vexture.SourceWarning")

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


def drawn(drawing, size):
    """Premultiplied colours of a drawing, 0..255, in a picture over which its own coordinates are spread."""
    width, height = size
    side = max(size)
    place = [[1 / side, 0.0, 0.5 - 0.5 * width / side], [0.0, -1 / side, 0.5 + 0.5 * height / side]]
    return 255.0 * vexture.render(drawing, size, place, "exact").astype(float)


def pixels_of(body, size):
    """8-bit pixels of a drawing, not premultiplied."""
    text = f'<svg viewBox="0 0 {size[0]} {size[1]}">{body}</svg>'
    levels = drawn(svg_drawing(text.encode(), "picture.svg"), size)
    levels[..., :3] *= 255.0 / np.maximum(levels[..., 3:], 1e-6)
    return np.rint(np.clip(levels, 0.0, 255.0)).astype(np.uint8)


def premultiplied(pixels):
    return np.concatenate([pixels[..., :3] * (pixels[..., 3:] / 255.0), pixels[..., 3:]], axis=2)


def traced(pixels):
    """The drawing with its background, and the differences of its picture."""
    drawing = _trace_pixels(pixels, "picture", whole=True)
    return drawing, np.abs(drawn(drawing, pixels.shape[1::-1]) - premultiplied(pixels))


def opaque(pixels):
    return np.asarray(Image.alpha_composite(Image.new("RGBA", pixels.shape[1::-1], "white"), Image.fromarray(pixels)))


def shadow(blur):
    """A soft shadow with a box over it."""
    alpha = Image.new("L", (160, 120), 0)
    alpha.paste(140, (34, 34, 134, 94))
    pixels = np.zeros((120, 160, 4), np.uint8)
    pixels[..., 3] = np.asarray(alpha.filter(ImageFilter.GaussianBlur(blur)))
    pixels[24:84, 30:130] = (58, 123, 213, 255)
    return pixels


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


@pytest.mark.parametrize("background", ["transparent", "white"])
@pytest.mark.parametrize("scale", [1, *(pytest.param(other, marks=pytest.mark.slow) for other in (0.8, 2.5))])
def test_areas_of_a_drawing_keep_their_gradients_and_colours(scale, background):
    size = (round(240 * scale), round(160 * scale))
    pixels = pixels_of(f'<g transform="scale({scale})">{BUTTON}</g>', size)
    drawing, off = traced(pixels if background == "transparent" else opaque(pixels))
    gradients = [path.paint.gradient for path in drawing.paths if path.paint.gradient is not None]
    assert sorted(gradient.focus is not None for gradient in gradients) == [False, True]
    assert "#2e8b57" in [path.paint.hex for path in drawing.paths]
    assert off.mean() < 0.6


@pytest.mark.parametrize("blur", [6, 8, 10])
def test_a_soft_shadow_has_neither_seams_nor_holes(blur):
    _, off = traced(shadow(blur))
    assert off.mean() < 0.5
    inside = off[3:-3, 3:-3].max(axis=2)
    inside[20:82, 26:128] = 0.0  # the box's own edges
    assert inside.max() < 16.0


def test_a_soft_shadow_on_white_has_no_holes():
    _, off = traced(opaque(shadow(8)))
    assert off.mean() < 1.0
    assert (off.max(axis=2) > 40.0).mean() < 0.002


def test_what_is_no_gradient_is_drawn_in_steps():
    y, x = np.mgrid[:160, :160] / 79.5 - 1.0
    turn, far = np.arctan2(y, x) / (2.0 * np.pi), np.minimum(np.hypot(x, y), 1.0)
    hsv = np.dstack([255.0 * (turn % 1.0), 255.0 * far, np.full_like(far, 255.0)])
    wheel = np.asarray(
        Image.merge("HSV", [Image.fromarray(np.rint(c).astype(np.uint8)) for c in hsv.transpose(2, 0, 1)])
    )
    wheel = np.asarray(Image.fromarray(wheel, "HSV").convert("RGBA"))
    drawing, off = traced(wheel)
    assert off.mean() < 7.0
    assert 32 < len({path.paint.hex for path in drawing.paths}) <= 64


def test_blurred_edges_of_flat_colours_are_outlines():
    body = '<rect width="240" height="160" fill="#fff"/><path fill="#0a4d8c" d="M30 30h180v100h-180z"/>'
    for radius in (1, 2):
        image = Image.fromarray(pixels_of(body, (240, 160))).filter(ImageFilter.GaussianBlur(radius))
        drawing, _ = traced(np.asarray(image))
        assert [path.paint.hex for path in drawing.paths] == ["#ffffff", "#0a4d8c"]


def test_pieces_are_those_that_touch_by_sides():
    mask = np.random.default_rng(2).random((40, 50)) < 0.55
    found = pieces(mask)
    assert ((found > 0) == mask).all()
    same = [(found[1:], found[:-1], mask[1:] & mask[:-1]), (found[:, 1:], found[:, :-1], mask[:, 1:] & mask[:, :-1])]
    assert all((a[both] == b[both]).all() for a, b, both in same)
    for number in np.unique(found[mask])[:20]:
        reached = np.zeros_like(mask)
        reached[tuple(np.argwhere(found == number)[0])] = True
        while True:
            wider = reached.copy()
            wider[1:] |= reached[:-1]
            wider[:-1] |= reached[1:]
            wider[:, 1:] |= reached[:, :-1]
            wider[:, :-1] |= reached[:, 1:]
            if ((wider & mask) == reached).all():
                break
            reached = wider & mask
        assert (reached == (found == number)).all()
