"""Traced shading: gradients are found again, and what is none is drawn in steps, without seams or holes."""

import numpy as np
import pytest
from PIL import Image, ImageFilter
from shaded_pictures import opaque, pixels_of, traced

from vexture.tracing.shading import pieces

pytestmark = pytest.mark.filterwarnings("ignore::vexture.SourceWarning")


def shadow(blur):
    """A soft shadow with a box over it."""
    alpha = Image.new("L", (160, 120), 0)
    alpha.paste(140, (34, 34, 134, 94))
    pixels = np.zeros((120, 160, 4), np.uint8)
    pixels[..., 3] = np.asarray(alpha.filter(ImageFilter.GaussianBlur(blur)))
    pixels[24:84, 30:130] = (58, 123, 213, 255)
    return pixels


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
