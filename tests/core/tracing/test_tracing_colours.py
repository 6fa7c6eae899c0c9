"""Colours of traced pictures: a background, a few flat ones, translucent ones."""

import numpy as np
import pytest
from PIL import Image
from traced_drawings import COLOURS, LOGO, coloured, distances, file_of, hexes, on_white

import vexture
from vexture.base.errors import SourceWarning
from vexture.svg.read import svg_drawing
from vexture.tracing.colours import along, background_of, bin_colours, dilate, is_flat


def test_scan_that_reaches_its_border_is_still_its_dark_part():
    image = np.full((100, 100), 255, np.uint8)
    image[:, :60] = 0
    traced = vexture.trace(image)
    assert hexes(traced) == ["#000000"]
    np.testing.assert_allclose(traced.paths[0].box, [[0, 0], [0.6, 1]], atol=0.01)


def test_jpeg_has_the_colours_of_its_areas():
    logo = svg_drawing(LOGO, "logo.svg")
    data = file_of(on_white(coloured(logo, 480, 320)), "JPEG", quality=75)
    traced = vexture.read_image(data, "logo.jpg")
    assert traced.name == "logo"
    assert len(traced.layers()) == len(COLOURS)
    assert distances(logo, traced, 480)[0] < 0.3


def test_translucent_colours_are_translucent_paints():
    pixels = np.zeros((60, 60, 4), np.uint8)
    pixels[10:50, 10:50] = (255, 0, 0, 128)
    assert [path.paint.hex for path in vexture.trace(pixels).paths] == ["#ff000080"]


def test_picture_of_nothing_is_a_drawing_of_nothing():
    with pytest.warns(SourceWarning, match="all background"):
        assert vexture.trace(np.full((20, 20), 255, np.uint8)).paths == ()


@pytest.fixture
def logo(tmp_path):
    file = tmp_path / "logo.png"
    Image.fromarray(on_white(coloured(svg_drawing(LOGO, "logo.svg"), 240, 160))).save(file)
    return file


def picture(*colours: tuple[int, int, int, int]) -> np.ndarray:
    """Columns of eight pixels of each colour, premultiplied."""
    return np.repeat(np.repeat(np.array(colours, np.float32)[None], 8, axis=1), 24, axis=0)


RED, LIME, BLACK, NOTHING = (255, 0, 0, 255), (0, 255, 0, 255), (0, 0, 0, 255), (0, 0, 0, 0)


def test_a_background_is_transparent_or_the_colour_of_most_of_the_border():
    framed = picture(RED, RED, RED)
    framed[4:20, 4:20] = LIME
    assert background_of(framed).tolist() == list(RED)
    framed[4:20, 16:] = LIME
    assert background_of(framed).tolist() == list(RED), "a quarter of the border may have other colours"
    assert background_of(picture(RED, LIME, BLACK)) is None
    framed[10, 10] = NOTHING
    assert background_of(framed).tolist() == list(NOTHING)


def test_pixels_of_an_edge_are_not_flat():
    flat = is_flat(picture(RED, LIME, BLACK))
    assert np.flatnonzero(~flat.all(axis=0)).tolist() == [7, 8, 15, 16]
    assert is_flat(picture((10, 10, 10, 255), (26, 10, 10, 255))).all()
    assert not is_flat(picture((10, 10, 10, 255), (27, 10, 10, 255))).all()


def test_similar_colours_are_one_by_frequency():
    pixels = np.array([(100, 0, 0, 255)] * 6 + [(102, 0, 0, 255)] * 6 + [RED] * 20, np.float32)
    means, counts = bin_colours(pixels)
    assert counts.tolist() == [20, 12]
    assert means.tolist() == [list(RED), [101.0, 0.0, 0.0, 255.0]]


def test_the_nearest_mixture_is_a_projection():
    a, b = np.array(RED, np.float32), np.array(LIME, np.float32)
    pixels = np.array([RED, LIME, (63.75, 191.25, 0, 255), (127.5, 127.5, 60, 255), (255, 0, 0, 155)], np.float32)
    share, distance = along(pixels, a, b)
    assert share == pytest.approx([1.0, 0.0, 0.25, 0.5, 1.0], abs=1e-6)
    assert distance == pytest.approx([0.0, 0.0, 0.0, 60.0, 100.0], abs=1e-3)


def test_a_mask_grows_in_all_directions():
    mask = np.zeros((7, 7), np.bool_)
    mask[3, 3] = True
    for by in (1, 2):
        expected = np.zeros((7, 7), np.bool_)
        expected[3 - by : 4 + by, 3 - by : 4 + by] = True
        np.testing.assert_array_equal(dilate(mask, by), expected)
