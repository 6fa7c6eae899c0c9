"""Images and views that can be checked by eye."""

import numpy as np

from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import Paint
from vexture.renderers.cpu import render_cpu
from vexture.renderers.exact import render_exact
from vexture.renderers.flatten import find_chords
from vexture.renderers.picture import composite_pictures, paint_layer
from vexture.renderers.shader import read_shader
from vexture.renderers.view import fit, size_of, view_base, view_matrix
from vexture.texture.texture import Root, Texture

TRIANGLE = Drawing.polygon([(0, 0), (1, 0), (0, 1)])


def test_full_cells_fill_the_image() -> None:
    full_cells = np.array([[[0, 0, 0, 0xFFFFFFFF]]], np.uint32)
    image = render_cpu(Texture(full_cells, (Root("full"),)), (1, 1))
    np.testing.assert_allclose(image, [[1.0]])
    assert image.dtype == np.float32


def test_exact_coverage_of_a_triangle() -> None:
    image = render_exact(TRIANGLE, (2, 2))
    np.testing.assert_allclose(image, [(0.5, 0.0), (1.0, 0.5)])
    assert image.dtype == np.float32


def test_chords_of_a_triangle_are_those_that_are_not_level() -> None:
    chords = find_chords(TRIANGLE, (2, 2), np.array([[0.5, 0, 0], [0, -0.5, 1], [0, 0, 1]]), 1e-3)
    np.testing.assert_allclose(chords.lines, [(0.0, 2.0, 0.0, 1.0), (0.0, 2.0, 0.0, 0.0)])
    assert chords.owners.tolist() == [-1, 1]


def test_a_translucent_layer_darkens_the_one_below() -> None:
    full = np.ones((1, 1), np.float32)
    picture = composite_pictures(
        (1, 1), [paint_layer(Paint((1.0, 0.0, 0.0)), full), paint_layer(Paint(opacity=0.25), full)]
    )
    np.testing.assert_allclose(picture, [[(0.75, 0.0, 0.0, 1.0)]])
    assert picture.dtype == np.float32


def test_a_shader_file_is_included_once() -> None:
    assert read_shader("coverage.glsl").count("VexturePlace vexture_place(") == 1


def test_a_size_is_two_numbers_or_one() -> None:
    assert size_of((640, 480)) == (640, 480)
    assert size_of(64) == (64, 64)


def test_the_unit_square_in_a_square_image() -> None:
    view = fit((4, 4))
    np.testing.assert_allclose(view, [(0.25, 0.0, 0.0), (0.0, -0.25, 1.0), (0.0, 0.0, 1.0)])
    assert not np.signbit(view[view == 0.0]).any()


def test_an_affine_view_gets_a_third_row() -> None:
    np.testing.assert_allclose(view_matrix([[0.5, 0, 0], [0, -0.5, 1]], (2, 2))[2], (0.0, 0.0, 1.0))


def test_base_of_a_view_is_at_the_centre() -> None:
    assert view_base(np.diag([0.125, 0.125, 1.0]), (4, 4)) == (1 << 30, 1 << 30)
