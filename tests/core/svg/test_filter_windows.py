"""Filter primitives that combine neighbours, against closed forms and direct sums."""

from itertools import product
from math import erf, sqrt

import numpy as np
import pytest

from vexture.base.errors import LimitError
from vexture.svg.filter_frame import PixelFrame, shift
from vexture.svg.filter_operations import Convolution
from vexture.svg.filter_pixels import straighten
from vexture.svg.filter_windows import convolve, displace, gaussian_blur, gaussian_weights, morphology

FRAME = PixelFrame(0.0, 0.0, 1.0, 1.0, 14, 17)


def random_pixels(frame: PixelFrame = FRAME, seed: int = 1) -> np.ndarray:
    pixels = np.random.default_rng(seed).random((frame.rows, frame.columns, 4))
    pixels[..., :3] *= pixels[..., 3:]
    return pixels


@pytest.mark.parametrize("deviation", [0.05, 0.2, 0.4, 0.69, 0.7, 0.75, 1.0, 2.5, 9.0])
def test_weights_have_the_sum_and_variance_of_the_gaussian(deviation: float) -> None:
    weights = gaussian_weights(deviation, 200)
    distances = np.arange(len(weights))
    assert weights[0] + 2.0 * weights[1:].sum() == pytest.approx(1.0, abs=2e-5)
    assert 2.0 * (weights * distances**2).sum() == pytest.approx(deviation**2, rel=3e-3)


@pytest.mark.parametrize("deviation", [0.3, 1.0, 2.0, 5.0])
@pytest.mark.parametrize("width", [1.0, 0.25])
def test_a_blurred_edge_is_the_error_function(deviation: float, width: float) -> None:
    count = round(60 / width)
    frame = PixelFrame(-30.0, 0.0, width, 1.0, 1, count)
    pixels = np.zeros((1, count, 4))
    pixels[:, frame.xs > 0.0] = (0.2, 0.4, 0.0, 0.8)
    blurred = gaussian_blur(pixels, frame, (deviation, 0.0))
    middle = np.abs(frame.xs) < 30.0 - 5.0 * deviation
    # a pixel has the mean of its width: values at more places than the middle
    places = frame.xs[middle, None] + width * (np.arange(9) - 4.0) / 9.0
    expected = np.vectorize(lambda x: 0.5 + 0.5 * erf(x / (deviation * sqrt(2.0))))(places).mean(axis=1)
    tolerance = 0.001 if deviation >= 4.0 * width else 0.06 * width**2 / deviation**2
    np.testing.assert_allclose(blurred[0, middle, 3], 0.8 * expected, atol=tolerance)
    np.testing.assert_allclose(blurred[..., 1], 0.5 * blurred[..., 3])
    assert not blurred[..., 2].any()


def test_a_blur_has_two_deviations_and_loses_what_leaves() -> None:
    frame = PixelFrame(0.0, 0.0, 0.5, 0.5, 61, 61)
    pixels = np.zeros((61, 61, 4))
    pixels[30, 30] = 1.0
    blurred = gaussian_blur(pixels, frame, (2.0, 1.0))[..., 3]
    assert blurred.sum() == pytest.approx(1.0, abs=1e-4)
    offsets = (np.arange(61) - 30) * 0.5
    assert (blurred.sum(axis=0) * offsets**2).sum() == pytest.approx(4.0, rel=1e-3)
    assert (blurred.sum(axis=1) * offsets**2).sum() == pytest.approx(1.0, rel=1e-3)
    np.testing.assert_allclose(blurred, np.outer(blurred.sum(axis=1), blurred.sum(axis=0)), atol=1e-6)
    corner = np.zeros((61, 61, 4))
    corner[0, 0] = 1.0
    center = 2.0 * gaussian_weights(4.0, 9)[0], 2.0 * gaussian_weights(2.0, 9)[0]
    assert gaussian_blur(corner, frame, (2.0, 1.0))[..., 3].sum() == pytest.approx(
        (0.5 + center[0] / 4) * (0.5 + center[1] / 4), abs=1e-4
    )


def test_hostile_deviations_end() -> None:
    pixels = random_pixels()
    assert gaussian_blur(pixels, FRAME, (1e300, 1e300)).max() < 1e-6
    np.testing.assert_array_equal(gaussian_blur(pixels, FRAME, (-1.0, 0.0)), pixels)
    np.testing.assert_allclose(gaussian_blur(pixels, FRAME, (1e-300, 1e-300)), pixels)


@pytest.mark.parametrize("is_dilation", [False, True])
@pytest.mark.parametrize("radii", [(1.0, 0.0), (2.0, 1.0), (3.0, 5.0), (4.0, 40.0)])
def test_morphology_of_whole_pixels_is_an_extreme_of_a_rectangle(radii: tuple[float, float], is_dilation: bool) -> None:
    pixels = random_pixels()
    found = morphology(pixels, FRAME, radii, is_dilation)
    across, down = (int(radius) for radius in radii)
    padded = np.pad(pixels, ((down, down), (across, across), (0, 0)))
    for row, column in product(range(FRAME.rows), range(FRAME.columns)):
        part = padded[row : row + 2 * down + 1, column : column + 2 * across + 1]
        expected = part.max(axis=(0, 1)) if is_dilation else part.min(axis=(0, 1))
        np.testing.assert_array_equal(found[row, column], expected)


def test_radii_are_in_user_units_and_may_be_parts_of_pixels() -> None:
    frame = PixelFrame(0.0, 0.0, 0.5, 0.25, 40, 40)
    pixels = np.repeat((frame.xs / 20.0)[None, :, None], 40, axis=0).repeat(4, axis=2)  # a ramp
    inside = slice(8, -8)
    for radius in (0.1, 0.7, 1.5, 3.3):
        wider = morphology(pixels, frame, (radius, 0.6), True)[inside, inside, 3]
        np.testing.assert_allclose(wider, pixels[inside, inside, 3] + radius / 20.0)
        thinner = morphology(pixels, frame, (radius, 0.6), False)[inside, inside, 3]
        np.testing.assert_allclose(thinner, pixels[inside, inside, 3] - radius / 20.0)


def test_hostile_radii_end() -> None:
    pixels = random_pixels()
    np.testing.assert_array_equal(morphology(pixels, FRAME, (0.0, -3.0), True), pixels)
    widest = morphology(pixels, FRAME, (1e300, 1e300), True)
    np.testing.assert_array_equal(widest, np.broadcast_to(pixels.max(axis=(0, 1)), pixels.shape))
    assert not morphology(pixels, FRAME, (1e300, 1e300), False).any()


def neighbour(pixels: np.ndarray, row: int, column: int, mode: str) -> np.ndarray:
    """A pixel, or what takes its place beyond the edges."""
    rows, columns = pixels.shape[:2]
    if mode == "wrap":
        return pixels[row % rows, column % columns]
    inside = 0 <= row < rows and 0 <= column < columns
    return pixels[min(max(row, 0), rows - 1), min(max(column, 0), columns - 1)] * (inside or mode == "duplicate")


@pytest.mark.parametrize("preserves_alpha", [False, True])
@pytest.mark.parametrize("mode", ["none", "duplicate", "wrap"])
def test_a_convolution_is_the_sum_of_the_specification(mode: str, preserves_alpha: bool) -> None:
    pixels = random_pixels()
    matrix = np.random.default_rng(5).normal(size=(3, 4))
    kernel = Convolution((4, 3), tuple(matrix.ravel().tolist()), 2.5, 0.1, (3, 1), mode, preserves_alpha)
    found = convolve(pixels, FRAME, kernel, FRAME.bounds)
    source = straighten(pixels) if preserves_alpha else pixels
    for y, x in product(range(FRAME.rows), range(FRAME.columns)):
        total = np.zeros(4)
        for i, j in product(range(3), range(4)):
            total += neighbour(source, y - 1 + i, x - 3 + j, mode) * matrix[3 - i - 1, 4 - j - 1]
        alpha = source[y, x, 3] if preserves_alpha else total[3] / 2.5 + 0.1
        colors = total[:3] / 2.5 + 0.1 * alpha
        alpha = min(max(alpha, 0.0), 1.0)
        colors = colors.clip(0.0, 1.0) * alpha if preserves_alpha else colors.clip(0.0, alpha)
        np.testing.assert_allclose(found[y, x], [*colors, alpha], atol=1e-12)


def test_the_distances_of_a_convolution_are_in_user_units() -> None:
    fine = PixelFrame(0.0, 0.0, 0.5, 0.5, 40, 40)
    ramp = 0.2 + np.add.outer(fine.ys, 2.0 * fine.xs)[..., None] * np.full(4, 0.01)
    edge = Convolution((3, 1), (-1.0, 0.0, 1.0), 1.0, 0.0, (1, 0), lengths=(1.7, 1.0))
    found = convolve(ramp, fine, edge, fine.bounds)[8:-8, 8:-8, 3]
    assert not found.any()  # of the slope -2 * 0.01 * 2 * 1.7: turned by 180 degrees, the right neighbour counts -1
    edge = Convolution((3, 1), (1.0, 0.0, -1.0), 1.0, 0.0, (1, 0), lengths=(1.7, 1.0))
    np.testing.assert_allclose(convolve(ramp, fine, edge, fine.bounds)[8:-8, 8:-8, 3], 2.0 * 0.02 * 1.7)


def test_a_divisor_of_0_is_the_sum_of_the_matrix() -> None:
    pixels = random_pixels()
    flat = np.broadcast_to(pixels[3, 3], pixels.shape)
    same = convolve(flat, FRAME, Convolution((3, 3), (2.0,) * 9, 0.0), FRAME.bounds)
    np.testing.assert_allclose(same, flat)
    none = convolve(flat, FRAME, Convolution((3, 1), (1.0, 0.0, -1.0), 0.0, 0.0, (1, 0)), FRAME.bounds)
    np.testing.assert_allclose(none, 0.0, atol=1e-12)


def test_a_convolution_with_too_much_work_is_refused() -> None:
    with pytest.raises(LimitError, match=r"matrix of 1000 x 1000 .* the limit is 134,217,728; use a smaller matrix"):
        convolve(random_pixels(), FRAME, Convolution((1000, 1000), (1.0,) * 1_000_000), FRAME.bounds)
    with pytest.raises(LimitError, match="matrix of 3 x 3 with 2 numbers"):
        convolve(random_pixels(), FRAME, Convolution((3, 3), (1.0, 2.0)), FRAME.bounds)


def test_an_even_displacement_is_a_move() -> None:
    pixels = random_pixels()
    map_color = np.array([0.25, 0.9, 0.6, 0.8])
    displacements = np.broadcast_to(map_color * (0.8, 0.8, 0.8, 1.0), pixels.shape)
    found = displace(pixels, FRAME, displacements, 6.0, (0, 2))
    np.testing.assert_allclose(found, shift(pixels, FRAME, -6.0 * (0.25 - 0.5), -6.0 * (0.6 - 0.5)), atol=1e-12)
    grey = np.broadcast_to((0.5, 0.5, 0.5, 1.0), pixels.shape)
    np.testing.assert_array_equal(displace(pixels, FRAME, grey, 6.0, (0, 1)), pixels)


def test_a_displacement_is_in_user_units() -> None:
    frame = PixelFrame(0.0, 0.0, 0.5, 0.25, 40, 40)
    ramp = np.repeat((frame.xs / 40.0)[None, :, None], 40, axis=0).repeat(4, axis=2)
    share = np.repeat((frame.ys / 10.0)[:, None, None], 40, axis=1).repeat(4, axis=2)
    share[..., 3] = 1.0
    found = displace(ramp, frame, share, 3.0, (1, 0))
    expected = (frame.xs + 3.0 * (frame.ys[:, None] / 10.0 - 0.5)) / 40.0
    np.testing.assert_allclose(found[8:-8, 8:-8, 0], expected[8:-8, 8:-8])


def test_a_hostile_displacement_shows_nothing() -> None:
    found = displace(random_pixels(), FRAME, random_pixels(seed=2), 1e308, (0, 3))
    assert not found.any()
