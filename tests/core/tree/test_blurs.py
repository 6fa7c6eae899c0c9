"""Splines in the place of blurs, against closed forms and sums over fine grids."""

from dataclasses import replace

import numpy as np
import pytest

from blur_drawings import BLURS, IDENTITY, INNER, STRIPES, WHOLE, blurred_square, box_integral, random_blur, soft_path
from gradient_drawings import SQUARE, WARM, linear, painted_path
from vexture.base.errors import LimitError
from vexture.drawing.blur import Blur
from vexture.drawing.drawing import Drawing
from vexture.drawing.picture import Picture, Sampling
from vexture.tree.planar.blurs import with_splines
from vexture.tree.planar.pixels import list_pixels, mean_of_picture
from vexture.tree.planar.splines import spline_integral

LEVEL = 1 / 255


def picture_of(drawing: Drawing) -> Picture:
    picture = with_splines(drawing).paths[0].paint.picture
    assert picture is not None
    return picture


def points(count: int = 300) -> list[tuple[float, float]]:
    return [(x, y) for x, y in np.random.default_rng(5).random((count, 2)).tolist()]


@pytest.mark.parametrize("deviations", [(0.3, 0.02), (0.05, 0.05), (0.01, 0.012)])
def test_a_blurred_square_is_a_product_of_error_functions(deviations: tuple[float, float]) -> None:
    picture = picture_of(Drawing((soft_path(Blur(INNER, IDENTITY, deviations, WHOLE)),)))
    errors = [abs(picture.color_at(x, y)[3] - blurred_square(deviations, x, y)) for x, y in points()]
    assert max(errors) < 1.0 * LEVEL
    assert np.mean(errors) < 0.2 * LEVEL


def test_an_inverted_blur_is_the_rest() -> None:
    blur = Blur(INNER, IDENTITY, (0.05, 0.05), WHOLE)
    picture = picture_of(Drawing((soft_path(blur, (1.0, 0.5, 0.0), 0.6),)))
    rest = picture_of(Drawing((soft_path(replace(blur, is_inverted=True), (1.0, 0.5, 0.0), 0.6),)))
    for x, y in points(50):
        red, green, blue, alpha = rest.color_at(x, y)
        assert alpha == pytest.approx(0.6 - picture.color_at(x, y)[3])
        assert (red, green, blue) == pytest.approx((alpha, 0.5 * alpha, 0.0))


def test_colours_are_blurred_one_by_one() -> None:
    picture = picture_of(Drawing((soft_path(Blur(STRIPES, IDENTITY, (0.06, 0.06), WHOLE, has_colors=True)),)))
    for x, y in points(100):
        across = [box_integral(k / 4, k / 4 + 0.25, 0.06, x) for k in range(4)]
        wanted = sum(
            share * np.array([*path.paint.color, 1.0]) for share, path in zip(across, STRIPES.paths, strict=True)
        ) * box_integral(0.0, 1.0, 0.06, y)
        np.testing.assert_allclose(picture.color_at(x, y), wanted, atol=1.0 * LEVEL)


def test_linear_light_is_brighter_between_two_colours() -> None:
    blur = Blur(STRIPES, IDENTITY, (0.06, 0.06), WHOLE, has_colors=True)
    encoded = picture_of(Drawing((soft_path(blur),))).color_at(0.25, 0.5)
    linear_light = picture_of(Drawing((soft_path(replace(blur, is_linear=True)),))).color_at(0.25, 0.5)
    assert encoded[0] == pytest.approx(0.5, abs=0.01)
    assert linear_light[0] == pytest.approx(0.735, abs=0.01)  # sRGB of one half


def test_a_blurred_gradient_has_its_colours_inside_its_face() -> None:
    ramp = Drawing((painted_path(SQUARE, linear((0, 0), (1, 0), WARM)),))
    picture = picture_of(Drawing((soft_path(Blur(ramp, IDENTITY, (0.02, 0.02), WHOLE, has_colors=True)),)))
    gradient = ramp.paths[0].paint.gradient
    assert gradient is not None
    offsets = [stop.offset for stop in gradient.stops]
    for x in (0.2, 0.6, 0.8):  # far from stops, where the ramp bends
        wanted = [np.interp(x, offsets, [stop.color[c] for stop in gradient.stops]) for c in range(3)]
        np.testing.assert_allclose(picture.color_at(x, 0.5)[:3], wanted, atol=1.5 * LEVEL)


def test_equal_blurs_share_their_pixels() -> None:
    soft = with_splines(BLURS["two shadows"])
    one, other = (path.paint.picture for path in soft.paths[:2])
    assert one is not None
    assert other is not None
    assert one.pixels is other.pixels


def test_a_blur_that_is_too_fine_is_refused() -> None:
    with pytest.raises(LimitError, match="coefficients; the limit is 750,000") as caught:
        with_splines(Drawing((soft_path(Blur(INNER, IDENTITY, (0.001, 0.001), WHOLE)),)))
    assert "\n" not in str(caught.value)


def test_integrals_of_the_spline_are_those_of_its_values() -> None:
    x = np.linspace(-2.5, 2.5, 100_001)
    far = np.abs(x)
    values = np.where(far < 1, 2 / 3 - far**2 + far**3 / 2, np.maximum(2 - far, 0) ** 3 / 6)
    wanted = np.cumsum(values) * (x[1] - x[0])
    np.testing.assert_allclose([spline_integral(float(at)) for at in x[::500]], wanted[::500], atol=1e-4)


@pytest.mark.parametrize("seed", range(8))
def test_means_of_splines_are_those_of_many_points(seed: int) -> None:
    rng = np.random.default_rng(seed)
    picture = picture_of(Drawing((soft_path(random_blur(rng)),)))
    rows, columns = picture.pixels.shape[:2]
    in_pixels = replace(picture, to_pixels=IDENTITY, color=picture.color and (1.0, 1.0, 1.0), opacity=1.0)
    words, (begin,) = list_pixels([in_pixels])
    out = np.empty(4)
    for _ in range(5):
        middle = rng.uniform(-3.0, 3.0 + np.array([columns, rows]), 2)
        size = np.exp(rng.uniform(-2.0, 2.5, 2))
        mean_of_picture(words, begin, int(picture.sampling), tuple(middle), tuple(size), out)
        places = middle + size * ((np.moveaxis(np.indices((40, 40)), 0, -1).reshape(-1, 2) + 0.5) / 40 - 0.5)
        # a box that is all beyond the border is moved to it
        places = np.clip(places, -0.5 * size, np.array([columns, rows]) + 0.5 * size)
        wanted = np.mean([in_pixels.color_at(*place) for place in places.tolist()], axis=0)
        if picture.sampling is Sampling.SPLINE:
            np.testing.assert_allclose(out, wanted, atol=0.1 * LEVEL)
        else:
            mean = 1.0 - out[0] if picture.sampling is Sampling.INVERSE else out[0]
            assert mean == pytest.approx(wanted[3], abs=0.1 * LEVEL)
