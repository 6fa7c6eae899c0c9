"""Pixel art: its squares come out exactly, and nothing else is taken for it."""

import io

import numpy as np
import pytest
from PIL import Image

import vexture
from vexture.base.errors import SourceWarning
from vexture.svg.read import svg_drawing
from vexture.tracing.squares import squares
from vexture.tracing.trace import embedded_image

INKS = np.array(
    [(0, 0, 0, 0), (20, 12, 28, 255), (208, 70, 72, 255), (48, 52, 109, 255), (255, 255, 255, 80)], np.uint8
)

DRAWINGS = {
    "disc": '<circle cx="12" cy="12" r="9"/>',
    "cross": '<path d="M5 5l14 14M19 5l-14 14" stroke="#000"/>',
    "rounded": '<rect x="3" y="3" width="18" height="18" rx="3"/>',
    "house": '<path d="M3.5 20.5h17v-11l-8.5-7l-8.5 7z" fill="none" stroke="#333"/>',
}


def sprite(side, seed=0):
    """A figure of few colours, of which many pixels stand alone."""
    ink = np.random.default_rng(seed).choice(len(INKS), (side, side), p=(0.4, 0.3, 0.15, 0.1, 0.05))
    return INKS[ink]


def drawn(drawing, size):
    """Premultiplied colours of a drawing, 0..255, in a picture that all of it fills."""
    width, height = size
    side = max(size)
    place = [[1 / side, 0.0, 0.5 - 0.5 * width / side], [0.0, -1 / side, 0.5 + 0.5 * height / side]]
    return 255.0 * vexture.render(drawing, size, place, "exact").astype(float)


def premultiplied(pixels):
    return np.concatenate([pixels[..., :3] * (pixels[..., 3:] / 255.0), pixels[..., 3:]], axis=2)


def file_of(pixels):
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "PNG")
    return file.getvalue()


def smooth(body, width):
    """Pixels of a drawing of 24 units, black on white, with smooth edges."""
    drawing = svg_drawing(f'<svg viewBox="0 0 24 24">{body}</svg>'.encode(), "drawing.svg")
    return np.rint(255.0 - drawn(drawing, (width, width))[..., 3]).astype(np.uint8)


@pytest.mark.parametrize("side", [8, 16, 32, 64])
@pytest.mark.parametrize("times", [1, 3])
def test_every_pixel_is_an_exact_square(side, times):
    pixels = sprite(side)[: side - 3].repeat(times, axis=0).repeat(times, axis=1)
    drawing = vexture.trace(pixels)
    size = pixels.shape[1::-1]
    np.testing.assert_allclose(drawn(drawing, size), premultiplied(pixels), atol=0.01)
    corners = drawing.to_source @ np.vstack([np.vstack([path.box for path in drawing.paths]).T, np.ones(8)])
    np.testing.assert_allclose(corners / times, np.rint(corners / times), atol=1e-9)
    assert {path.paint.hex for path in drawing.paths} == {"#140c1c", "#d04648", "#30346d", "#ffffff50"}


def test_squares_of_a_colour_are_one_outline():
    pixels = np.zeros((5, 5, 4), np.uint8)
    pixels[1:4, 1:4] = INKS[1]
    pixels[2, 2] = INKS[2]
    ring, dot = vexture.trace(pixels).paths
    assert [len(contour) for contour in (*ring.contours, *dot.contours)] == [4, 4, 4]


def test_outlines_of_squares_that_touch_at_a_corner_are_their_own():
    assert squares(np.eye(2) > 0) == "M0 0H1V1H0ZM1 1H2V2H1Z"
    assert squares(np.eye(2)[::-1] > 0) == "M1 0H2V1H1ZM0 1H1V2H0Z"


def test_the_border_is_left_out_and_in_an_image_it_is_not():
    pixels = sprite(16)
    pixels[pixels[..., 3] < 255] = (90, 160, 60, 255)
    pixels[0] = pixels[-1] = pixels[:, 0] = pixels[:, -1] = (90, 160, 60, 255)
    assert "#5aa03c" not in [path.paint.hex for path in vexture.trace(pixels).paths]
    whole = embedded_image(file_of(pixels))
    over = premultiplied(pixels)
    np.testing.assert_allclose(drawn(whole, (16, 16)), over, atol=0.01)


def test_of_two_colours_the_darker_is_the_drawing():
    board = np.where(np.add.outer(np.arange(8), np.arange(8)) % 2, np.uint8(255), np.uint8(0))
    drawing = vexture.trace(board)
    assert [path.paint.hex for path in drawing.paths] == ["#000000"]
    assert len(drawing.paths[0].contours) == 32


def test_art_with_a_border_of_several_colours_is_all_of_it():
    pixels = sprite(16)
    pixels[..., 3] = 255
    with pytest.warns(SourceWarning, match="has no background"):
        drawing = vexture.trace(pixels)
    np.testing.assert_allclose(drawn(drawing, (16, 16)), premultiplied(pixels), atol=0.01)


@pytest.mark.parametrize("width", [16, 24, 32, 48])
@pytest.mark.parametrize("name", DRAWINGS)
def test_small_drawings_with_smooth_edges_are_none(name, width):
    drawing = vexture.trace(smooth(DRAWINGS[name], width))
    ends = np.concatenate([contour[:, 0] for path in drawing.paths for contour in path.contours])
    assert np.abs(width * ends - np.rint(width * ends)).max() > 0.05
