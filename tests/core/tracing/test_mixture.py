"""Pixels between two colours of a picture."""

import numpy as np
import pytest

import vexture
from vexture.renderers.exact import render_exact
from vexture.svg.read import svg_drawing
from vexture.tracing.mixture import Mixture, mixture
from vexture.tracing.shading import NONE_HERE, Shading


def test_edges_show_no_third_colour_that_lies_between():
    image = np.full((200, 300, 3), 255.0)
    disc = svg_drawing(b'<svg viewBox="0 0 2 2"><circle cx="1" cy="1" r=".8"/></svg>', "disc.svg")
    image[:, :200] -= 255.0 * render_exact(disc, (200, 200))[..., None]
    image[50:150, 220:280] = 128.0
    black, grey = vexture.trace(np.rint(image).astype(np.uint8)).layers()
    assert (black.paths[0].paint.hex, grey.paths[0].paint.hex) == ("#000000", "#808080")
    assert [len(path.contours) for path in grey.paths] == [1]
    assert grey.paths[0].box[0, 0] > 0.7


FLAT = np.array([(level, level, level, 255) for level in (0, 128, 255)], np.float32)
BLACK, GRAY, WHITE = range(3)


def mixed(*levels):
    """Mixture of a picture of nine equal rows of grays, of black, gray and white."""
    row = [(level, level, level, 255) for level in levels]
    image = np.repeat(np.array(row, np.float32)[None], 9, axis=0)
    nowhere = np.full(image.shape[:2], NONE_HERE, np.int16)
    return mixture(image, FLAT, Shading((), nowhere, np.zeros(image.shape[:2], np.bool_)))


@pytest.mark.parametrize("level", [51, 102, 128, 204])
def test_a_pixel_on_an_edge_is_a_mixture_of_the_tones_beside_it(level):
    """A gray between black and white has no part of the picture's own gray."""
    found = mixed(*[128] * 6, *[0] * 6, level, *[255] * 6)
    shares = [float(found.of(tone)[4, 12]) for tone in (BLACK, GRAY, WHITE)]
    assert shares == pytest.approx([1 - level / 255, 0.0, level / 255], abs=1e-6)


def test_pixels_inside_of_areas_are_pure():
    found = mixed(*[0] * 6, *[128] * 6, *[255] * 6)
    for tone, columns in ((BLACK, slice(0, 6)), (GRAY, slice(6, 12)), (WHITE, slice(12, 18))):
        expected = np.zeros((9, 18))
        expected[:, columns] = 1.0
        np.testing.assert_allclose(found.of(tone), expected, atol=1e-6)


def test_shares_of_several_tones_add_up():
    found = mixed(*[0] * 6, 90, *[255] * 6)
    np.testing.assert_allclose(found.of(BLACK, WHITE), 1.0)
    np.testing.assert_allclose(found.of(BLACK) + found.of(GRAY) + found.of(WHITE), 1.0)


def test_shares_are_means_only_where_tones_pass_into_one_another():
    first = np.zeros((9, 9), np.int16)
    first[:, 5:] = 1
    ones, soft = np.ones((9, 9), np.float32), np.zeros((9, 9), np.bool_)
    np.testing.assert_array_equal(Mixture(first, first, ones, soft).of(1)[4], [0, 0, 0, 0, 0, 1, 1, 1, 1])
    found = Mixture(first, first, ones, ~soft).of(1)[4]
    np.testing.assert_allclose(found, np.array([0, 0, 0, 1, 5, 11, 15, 16, 16]) / 16)  # binomial weights
