from itertools import pairwise

import numpy as np
import pytest

from vexture.conversion.pipeline import convert
from vexture.drawing.drawing import Drawing
from vexture.renderers.view import window
from vexture.thesis.cpu import render_thesis_cpu
from vexture_evidence.measures.shape import ConvertedDrawing, example
from vexture_evidence.measures.thesis_ways import draw_as_thesis


def upright(*stripes):
    """Stripes of full height, each from one x to another."""
    contours = [[(a, 0), (b, 0), (b, 1), (a, 1)] for a, b in stripes]
    return convert(Drawing.polygon(*contours), encoding="thesis", strategy="direct")


def duck():
    return ConvertedDrawing(example("duck")).way("sampled").texture


def test_a_level_grid_meets_an_upright_edge_four_points_at_once():
    texture = upright((0.0, 0.3))
    row = draw_as_thesis(texture, (4, 4)).image[0]
    np.testing.assert_allclose(row, (1, 0.25, 0, 0))  # the truth is 0.2
    np.testing.assert_allclose(draw_as_thesis(texture, (4, 4), samples=1).image[0], (1, 0, 0, 0))


def test_a_pixel_sees_the_leaf_of_its_centre_alone():
    texture, view = upright((0.0, 0.3), (0.55, 0.65)), window(0.2, 0.2, 0.5, 0.5).matrix((1, 1))
    np.testing.assert_allclose(draw_as_thesis(texture, (1, 1), view).image, 0.25)  # not the stripe in the next cell
    assert render_thesis_cpu(texture, (1, 1), view)[0, 0] > 0.3


def test_the_cut_off_is_where_the_thesis_has_it():
    texture = duck()
    assert draw_as_thesis(texture, (16, 16), samples=1, cut_off=16.5).from_mip.all()  # the whole square is one quad
    assert not draw_as_thesis(texture, (16, 16), samples=1, cut_off=0.0).from_mip.any()
    root = texture.quads[0, 0, 2] / texture.maximum
    np.testing.assert_allclose(draw_as_thesis(texture, (16, 16), samples=1, cut_off=16.5).image, root, rtol=1e-6)
    few = [draw_as_thesis(texture, (32, 32), samples=1, cut_off=cut_off).from_mip for cut_off in (1, 2, 4, 8, 16)]
    for fewer, more in pairwise(few):
        assert (fewer <= more).all()
        assert fewer.sum() < more.sum()


def test_a_long_pixel_is_as_large_as_it_is_long():
    long = [[1 / 4, 0, 0], [0, -1 / 16, 1]]
    values = [set(draw_as_thesis(duck(), (4, 16), long, cut_off=cut_off).image.flat) for cut_off in (3.9, 4.1)]
    assert [len(several) for several in values] == [4, 1]  # its quarters, the whole


def test_constant_leaves_are_not_mip_values():
    texture = upright((0.0, 0.5))
    assert len(texture.quads) == 1
    assert not draw_as_thesis(
        texture, (2, 2), cut_off=1.5
    ).from_mip.any()  # larger than the leaves, but they are no quads


def test_beyond_the_horizon_there_is_nothing():
    view = [[0.1, 0, 0], [0, 0.1, 0], [0, 0.25, -0.5]]
    image = draw_as_thesis(upright((0.0, 1.0)), (4, 8), view).image
    assert image[:2].max() == 0
    assert image[3:].max() == 1
    assert not render_thesis_cpu(upright((0.0, 1.0)), (4, 8), view)[:2].any()


@pytest.mark.parametrize("size", [8, 32])
def test_without_cell_borders_in_the_pixels_both_renderers_nearly_agree(size):
    ours, theirs = render_thesis_cpu(duck(), (size, size)), draw_as_thesis(duck(), (size, size)).image
    assert (np.abs(ours - theirs) < 0.13).mean() > 0.8
