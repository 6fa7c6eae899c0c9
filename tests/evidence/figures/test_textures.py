"""Pictures of texels show the texels: every one, in its colour."""

import numpy as np
import pytest
from fitting import assert_legible

import vexture
from vexture.drawing.drawing import Drawing
from vexture_evidence.figures.textures import texture_images, textures
from vexture_evidence.measures.shape import example


def test_a_pair_is_shown_turned_counter_clockwise():
    pair = vexture.convert(example("duck"), encoding="thesis", bits=16)
    quads, curves = (strip.pixels for strip in texture_images(pair))
    assert quads.shape == (4, len(pair.quads), 3)
    assert curves.shape == (2, len(pair.curves), 3)
    for row, pixel in ((0, 0), (5, 1), (len(pair.curves) - 1, 0)):
        np.testing.assert_array_equal(curves[1 - pixel, row], pair.curves[row, pixel] / 65535)


def test_pairs_of_8_and_16_bits_have_the_same_range():
    for bits in (8, 16):
        full = vexture.convert(Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)]), encoding="thesis", bits=bits)
        assert texture_images(full)[0].pixels[..., 2].max() == 1.0  # a full quad's coverage


def test_a_packed_texel_is_a_column_of_four_words():
    texture = vexture.convert(example("duck"), capacity=4, tolerance=0)
    (strip,) = texture_images(texture)
    assert strip.title == "6 quads and 42 curves of 4 words"
    assert strip.pixels.shape == (4, 48, 3)
    for texel, word in ((0, 2), (7, 0), (47, 3)):
        value = int(texture.flat[texel, word])
        expected = [(value & 0xFFFF) / 65535, (value >> 16) / 65535, 0.5 if texel < 6 else 0.0]
        np.testing.assert_array_equal(strip.pixels[word, texel], expected)


def test_quads_of_every_shape_of_an_atlas_are_told_from_curves():
    both = vexture.atlas([example("duck"), example("holes")])
    blue = texture_images(both)[0].pixels[0, :, 2]
    second = both.roots[1].quad
    assert blue[0] == blue[second] == 0.5
    assert blue[second - 1] == 0.0


@pytest.mark.parametrize("drawing", ["empty", "duck", "font"])
def test_textures_are_shown_at_one_scale(drawing):
    shape = Drawing(()) if drawing == "empty" else example(drawing)
    shown = {
        "8 bits": vexture.convert(shape, encoding="thesis", bits=8),
        "16 bits": vexture.convert(shape, encoding="thesis"),
        "packed": vexture.convert(shape),
    }
    figure = textures(shown)
    assert len({axes.get_xlim() for axes in figure.axes}) == 1
    assert_legible(figure)
    for axes in figure.axes:
        for image in axes.images:
            left, right, bottom, top = image.get_extent()
            assert (right - left, abs(top - bottom)) == image.get_array().shape[1::-1]
