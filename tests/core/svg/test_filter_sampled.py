"""Steps of filters that are sampled, from SVG to the pixels of their pictures."""

import pickle

import numpy as np
import pytest

from vexture.drawing.drawing import Drawing
from vexture.drawing.picture import Picture
from vexture.renderers.exact import render_exact_colours
from vexture.svg.filter_frame import PixelFrame
from vexture.svg.filter_noise import turbulence
from vexture.svg.filter_operations import Turbulence
from vexture.svg.read import svg_drawing
from vexture.tree.planar.blurs import with_splines

DISC = '<circle cx="50" cy="50" r="20" fill="#e02040" filter="url(#f)"/>'
NOISE = '<feTurbulence baseFrequency=".05"/>'
REGION = 'x="0" y="0" width="100" height="100" filterUnits="userSpaceOnUse" color-interpolation-filters="sRGB"'


def read(steps: str, shape: str = DISC, attributes: str = REGION) -> Drawing:
    text = f'<svg viewBox="0 0 100 100"><filter id="f" {attributes}>{steps}</filter>{shape}</svg>'
    return svg_drawing(text.encode(), "it.svg")


def picture_of(drawing: Drawing) -> Picture:
    (path,) = with_splines(drawing).paths
    assert path.paint.picture is not None
    return path.paint.picture


def colour_in(drawing: Drawing, x: float, y: float) -> tuple[float, ...]:
    """Colour of the picture at a point in the SVG's units."""
    return picture_of(drawing).color_at(x / 100, 1 - y / 100)


def test_a_sampled_step_is_noted_with_its_density() -> None:
    (note,) = read('<feTurbulence baseFrequency=".05"/>').notes
    assert note.kind == "simplified"
    assert "turbulence as a picture of 256 x 256 pixels" in note.message


def test_noise_is_that_of_the_pixel_function() -> None:
    picture = picture_of(read('<feTurbulence type="fractalNoise" baseFrequency=".02 .05" numOctaves="2" seed="7"/>'))
    frame = PixelFrame(0.0, 0.0, 100 / 256, 100 / 256, 256, 256)
    wanted = turbulence(Turbulence((0.02, 0.05), 2, 7.0, True), frame, frame.bounds, 1)
    alpha = wanted[..., 3].clip(0.0, 1.0)
    np.testing.assert_allclose(picture.pixels[..., 3] / 255.0, alpha, atol=0.6 / 255)


def test_a_thick_disc_is_a_rounded_square() -> None:
    drawing = read('<feMorphology operator="dilate" radius="10 5"/>')
    for x, y, alpha in ((79.0, 50.0, 1.0), (81.0, 50.0, 0.0), (50.0, 74.0, 1.0), (50.0, 76.0, 0.0), (76.0, 68.0, 0.0)):
        assert colour_in(drawing, x, y)[3] == pytest.approx(alpha, abs=0.01)
    assert colour_in(drawing, 75.0, 50.0)[:3] == pytest.approx((224 / 255, 32 / 255, 64 / 255), abs=0.01)


def test_negative_radii_change_nothing() -> None:
    assert read('<feMorphology radius="-1"/>').paths[0].paint.effect is None


def test_light_from_a_distance_falls_on_the_whole_region() -> None:
    light = '<feDiffuseLighting lighting-color="#8040c0" diffuseConstant=".5"><feDistantLight elevation="90"/>'
    drawing = read(f"{light}</feDiffuseLighting>")
    wanted = 0.5 * 128 / 255, 0.5 * 64 / 255, 0.5 * 192 / 255, 1.0
    for x, y in ((10.0, 10.0), (50.0, 50.0)):
        assert colour_in(drawing, x, y) == pytest.approx(wanted, abs=0.01)


def test_a_displacement_by_a_flood_moves_the_shape() -> None:
    channels = 'xChannelSelector="R" yChannelSelector="A"'
    steps = f'<feFlood flood-color="#ff0000"/><feDisplacementMap in="SourceGraphic" {channels} scale="20"/>'
    drawing = read(steps)
    assert colour_in(drawing, 25.0, 40.0)[3] == pytest.approx(1.0, abs=0.02)  # the shape 10 to the left and above
    assert colour_in(drawing, 65.0, 55.0)[3] == pytest.approx(0.0, abs=0.02)


def test_an_identity_convolution_keeps_the_shape() -> None:
    drawing = read('<feConvolveMatrix kernelMatrix="0 0 0 0 1 0 0 0 0"/>')
    assert colour_in(drawing, 50.0, 50.0) == pytest.approx((224 / 255, 32 / 255, 64 / 255, 1.0), abs=0.01)
    assert colour_in(drawing, 75.0, 50.0)[3] == 0.0


def test_colours_of_a_sampled_step_change_pixel_by_pixel() -> None:
    noise = '<feTurbulence type="fractalNoise" baseFrequency=".05"/>'
    plain, opaque = read(noise), read(noise + '<feColorMatrix values="1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 1"/>')
    values = picture_of(plain).pixels.astype(float)
    red = values[..., 0] / np.maximum(values[..., 3], 1.0)
    np.testing.assert_allclose(picture_of(opaque).pixels[..., 0] / 255.0, red, atol=0.03)
    assert (picture_of(opaque).pixels[..., 1:3] == 0).all()
    assert (picture_of(opaque).pixels[..., 3] == 255).all()


def test_factors_without_an_exact_form_are_sampled() -> None:
    steps = '<feFlood flood-color="#ff0000" flood-opacity=".5" result="a"/><feComposite in="SourceGraphic" in2="a"'
    drawing = read(f'{steps} operator="arithmetic" k1="1" k2=".5" k3=".25" k4=".1"/>')
    red = 0.5 * 224 / 255 + 0.5 * 224 / 255 + 0.25 * 0.5 + 0.1
    assert colour_in(drawing, 50.0, 50.0)[0] == pytest.approx(min(red, 1.0), abs=0.01)
    assert colour_in(drawing, 5.0, 5.0) == pytest.approx((0.225, 0.1, 0.1, 0.225), abs=0.01)


def test_later_sampled_filters_have_fewer_pixels() -> None:
    shapes = "".join(f'<rect x="{10 * k}" width="9" height="9" filter="url(#f)"/>' for k in range(4))
    drawing = read('<feTurbulence baseFrequency=".05"/>', shapes)
    assert [path.paint.effect.depth for path in drawing.paths if path.paint.effect] == [8, 8, 8, 7]


def test_a_chain_of_sampled_steps_keeps_its_pixels() -> None:
    noise = '<feTurbulence type="fractalNoise" baseFrequency=".2" seed="3"/>'
    chain = noise + '<feConvolveMatrix kernelMatrix="0 0 0 0 1 0 0 0 0"/>' * 3
    assert (picture_of(read(chain)).pixels == picture_of(read(noise)).pixels).all()


def test_the_exact_renderer_draws_sampled_steps() -> None:
    drawing = read('<feMorphology operator="dilate" radius="10 5"/>')
    image = render_exact_colours(drawing, 20)
    assert image[10, 10] == pytest.approx((224 / 255, 32 / 255, 64 / 255, 1.0), abs=0.01)
    assert image[10, 17, 3] == pytest.approx(0.0, abs=0.01)
    assert image[10, 14, 3] == pytest.approx(1.0, abs=0.01)


def test_steps_that_double_end() -> None:
    double = '<feComposite operator="arithmetic" k1=".3" k2=".5" k3=".5" k4=".01"/>'
    twice = double.replace("<feComposite", '<feComposite in="a" in2="a"')
    steps = '<feTurbulence baseFrequency=".1" result="a"/>' + twice.replace("/>", ' result="a"/>') * 30
    notes = [note.message for note in read(steps).notes]
    assert len(notes) == 1
    assert "limit is" in notes[0]


@pytest.mark.parametrize(
    "steps",
    [
        '<feMorphology radius="3 5"/><feColorMatrix values="1 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 0 9 -3"/>',
        f'{NOISE}<feComponentTransfer><feFuncA type="gamma" exponent="2"/></feComponentTransfer>',
        f"{NOISE}<feDropShadow/>",
    ],
)
def test_a_sampled_filter_can_go_to_another_process(steps: str) -> None:
    drawing = read(steps)
    again = pickle.loads(pickle.dumps(drawing))
    for one, other in zip(with_splines(drawing).paths, with_splines(again).paths, strict=True):
        assert one.paint.picture is not None
        assert other.paint.picture is not None
        assert (one.paint.picture.pixels == other.paint.picture.pixels).all()
