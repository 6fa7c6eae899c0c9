"""Clips and masks: cut outlines, and groups that mask what they are on."""

from math import pi

import pytest

from vexture.drawing.drawing import Drawing
from vexture.drawing.group import Mask
from vexture.renderers.exact import render_exact_colours
from vexture.svg.read import svg_drawing

SQUARE = '<rect width="100" height="100" fill="blue" {}/>'


def drawn(head: str, attributes: str, body: str = SQUARE) -> Drawing:
    content = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{head}{body.format(attributes)}</svg>'
    return svg_drawing(content.encode(), "a.svg")


def opacities(drawing: Drawing, *places: tuple[int, int]) -> list[float]:
    """Opacities of pixels of 10 x 10 units, by column and row."""
    picture = render_exact_colours(drawing, 10)
    return [float(picture[row, column, 3]) for column, row in places]


def test_a_clip_by_a_rectangle_cuts_the_outline() -> None:
    drawing = drawn('<clipPath id="c"><rect x="20" y="30" width="50" height="10"/></clipPath>', 'clip-path="url(#c)"')
    assert drawing.groups == ()
    assert drawing.paths[0].box.ravel().tolist() == pytest.approx([0.2, 0.6, 0.7, 0.7])


def test_a_clip_by_another_shape_is_a_mask_of_its_area() -> None:
    drawing = drawn('<clipPath id="c"><circle cx="50" cy="50" r="40"/></clipPath>', 'clip-path="url(#c)"')
    assert [group.mask for group in drawing.groups if group.mask is not None]
    assert render_exact_colours(drawing, 100)[..., 3].mean() == pytest.approx(pi * 0.4**2, rel=1e-4)


@pytest.mark.parametrize(
    ("fill", "opacity"),
    [("white", 1.0), ("black", 0.0), ("red", 0.2125), ("lime", 0.7154), ("blue", 0.0721), ("#808080", 128 / 255)],
)
def test_a_mask_shows_as_much_as_its_luminance(fill: str, opacity: float) -> None:
    """Coefficients of SVG 1.1 and CSS Masking 1, of components in sRGB."""
    drawing = drawn(f'<mask id="m"><rect width="50" height="100" fill="{fill}"/></mask>', 'mask="url(#m)"')
    assert opacities(drawing, (2, 5), (7, 5)) == pytest.approx([opacity, 0.0], abs=1e-3)


def test_a_mask_of_opacities_ignores_colours() -> None:
    head = '<mask id="m" mask-type="alpha"><rect width="50" height="100" fill="red" fill-opacity="0.25"/></mask>'
    drawing = drawn(head, 'mask="url(#m)"')
    assert Mask.OPACITY in {group.mask for group in drawing.groups}
    assert opacities(drawing, (2, 5), (7, 5)) == pytest.approx([0.25, 0.0], abs=1e-6)


def test_a_mask_ends_at_its_region() -> None:
    white = '<rect x="-500" y="-500" width="1000" height="1000" fill="white"/>'
    small = '<rect x="40" y="40" width="20" height="20" fill="blue" stroke="blue" stroke-width="20" {}/>'
    usual = drawn(f'<mask id="m">{white}</mask>', 'mask="url(#m)"', small)
    assert render_exact_colours(usual, 100)[..., 3].sum() == pytest.approx(24.0**2, rel=1e-4)
    own = f'<mask id="m" maskUnits="userSpaceOnUse" x="30" y="35" width="10" height="5">{white}</mask>'
    assert render_exact_colours(drawn(own, 'mask="url(#m)"', small), 100)[..., 3].sum() == pytest.approx(50.0, rel=1e-4)


def test_units_of_the_box_follow_the_shape() -> None:
    clip = '<clipPath id="c" clipPathUnits="objectBoundingBox"><rect width="0.5" height="0.25"/></clipPath>'
    drawing = drawn(clip, 'clip-path="url(#c)"', '<rect x="20" y="20" width="40" height="40" {}/>')
    assert drawing.paths[0].box.ravel().tolist() == pytest.approx([0.2, 0.7, 0.4, 0.8])
