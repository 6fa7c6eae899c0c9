"""Mean colours of leaves of planar maps."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from degenerate import circle, drawing, polygon
from gradient_drawings import (
    DRAWINGS,
    SQUARE,
    WARM,
    linear,
    painted_path,
)
from picture_drawings import DISC, PICTURES, fitted, pictured_path, random_picture, random_pixels
from planar import cell_at, colour_paths, sample_picture
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Group, Mask
from vexture.drawing.paint import Paint
from vexture.drawing.picture import Sampling
from vexture.renderers.exact import render_exact_colours
from vexture.tree.planar.build import build_map


@pytest.mark.parametrize("name", DRAWINGS)
def test_means_are_those_of_many_points(name: str) -> None:
    planar = build_map(DRAWINGS[name])
    wanted = sample_picture(DRAWINGS[name], 2, 64)
    np.testing.assert_allclose(planar.mean[0].reshape(2, 2, 4)[::-1], wanted, atol=1.5 / 255)


@pytest.mark.slow
def test_a_crowded_cell_has_the_mean_of_its_gradients() -> None:
    rng = np.random.default_rng(7)
    lines = [polygon([(0.01, y), (0.99, 1 - y), (0.99, 1.004 - y)]) for y in rng.uniform(0.1, 0.9, 90)]
    ramp = linear((0, 0), (1, 0), WARM)
    of = Drawing(
        tuple(painted_path(line, Paint((0, 0, k % 2), 0.5) if k % 3 else ramp) for k, line in enumerate(lines))
    )
    planar = build_map(of, max_depth=2)
    assert planar.unresolved > 0
    np.testing.assert_allclose(planar.mean[0].reshape(2, 2, 4)[::-1], sample_picture(of, 2, 40), atol=0.02)


@pytest.mark.parametrize("seed", range(8))
def test_means_are_exact(seed: int) -> None:
    of = colour_paths(Drawing(drawing(seed).paths + drawing(seed + 100).paths), np.random.default_rng(seed))
    means = build_map(of).mean[0].reshape(2, 2, 4)[::-1]
    np.testing.assert_allclose(means, render_exact_colours(of, 2), atol=2e-4)


def test_a_cell_that_is_too_full_has_its_mean() -> None:
    rng = np.random.default_rng(7)
    lines = [polygon([(0.01, y), (0.99, 1 - y), (0.99, 1.004 - y)]) for y in rng.uniform(0.1, 0.9, 90)]
    of = Drawing(tuple(Path((line,), paint=Paint((k % 2, 0, 1 - k % 2), 0.5)) for k, line in enumerate(lines)))
    planar = build_map(of, max_depth=3)
    assert planar.unresolved > 0
    wanted = render_exact_colours(of, 8)
    for x in range(8):
        for y in range(8):
            quad, k, _ = cell_at(planar, ((x + 0.5) / 8, (y + 0.5) / 8))
            if planar.is_mean[quad, k]:
                np.testing.assert_allclose(planar.mean[quad, k], wanted[7 - y, x], atol=0.01)


def box_means(pixels: np.ndarray) -> np.ndarray:
    """Mean of each quarter of the unit square, by its row from the top and its column, of fitted pixels."""
    rows, columns = pixels.shape[0] // 2, pixels.shape[1] // 2
    return pixels.reshape(2, rows, 2, columns, 4).mean(axis=(1, 3)) / 255.0


@pytest.mark.parametrize("side", [2, 64, 512])
@pytest.mark.parametrize("sampling", [Sampling.PIXELS, Sampling.LINEAR])
def test_means_of_noise_are_exact(side: int, sampling: Sampling) -> None:
    rng = np.random.default_rng(side)
    pixels = random_pixels(rng, side, side)
    pixels[rng.random((side, side)) < 0.5] = 0
    planar = build_map(Drawing((pictured_path(SQUARE, fitted(pixels, sampling)),)))
    wanted = box_means(pixels) if sampling is Sampling.PIXELS or side > 2 else planar.mean[0].reshape(2, 2, 4)[::-1]
    np.testing.assert_allclose(planar.mean[0].reshape(2, 2, 4)[::-1], wanted, atol=0.5 / 255)


@pytest.mark.parametrize("angle", [0.0, 0.4])
def test_means_of_noise_beside_outlines(angle: float) -> None:
    """A disc of 512 x 512 noise: leaves with outlines that hold thousands of pixels."""
    pixels = random_pixels(np.random.default_rng(2), 512, 512, True)
    pixels[:, :200] //= 3
    pixels[..., 3] = 255
    of = Drawing((pictured_path(circle((0.5, 0.5), 0.45), fitted(pixels, Sampling.PIXELS, angle)),))
    planar = build_map(of)
    (a, b, c), (d, e, f) = of.paths[0].paint.picture.to_pixels
    x, y = np.meshgrid((np.arange(2048) + 0.5) / 2048, (np.arange(2048)[::-1] + 0.5) / 2048)
    i, j = (np.clip(np.floor(part), 0, 511).astype(int) for part in (a * x + b * y + c, d * x + e * y + f))
    shown = pixels[j, i] / 255.0 * (np.hypot(x - 0.5, y - 0.5) < 0.45)[..., None]
    wanted = shown.reshape(2, 1024, 2, 1024, 4).mean(axis=(1, 3))
    np.testing.assert_allclose(planar.mean[0].reshape(2, 2, 4)[::-1], wanted, atol=1 / 255)


def test_means_of_noise_in_a_mask_of_noise() -> None:
    """The mean of a product of noises is no product of means, least of all of a picture masked by itself."""
    pixels = random_pixels(np.random.default_rng(3), 64, 64)
    photo = fitted(pixels, Sampling.PIXELS)
    paths = (pictured_path(SQUARE, photo, 0), pictured_path(SQUARE, photo, 1))
    planar = build_map(Drawing(paths, groups=(Group(), Group(0, mask=Mask.OPACITY))))
    wanted = box_means(pixels * (pixels[..., 3:] / 255.0))
    np.testing.assert_allclose(planar.mean[0].reshape(2, 2, 4)[::-1], wanted, atol=1 / 255)


@pytest.mark.parametrize("name", PICTURES)
def test_means_of_pictures_are_those_of_many_points(name: str) -> None:
    planar = build_map(PICTURES[name])
    wanted = sample_picture(PICTURES[name], 2, 48)
    np.testing.assert_allclose(planar.mean[0].reshape(2, 2, 4)[::-1], wanted, atol=2 / 255)


@settings(max_examples=6, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_means_of_random_pictures_are_those_of_many_points(seed: int) -> None:
    rng = np.random.default_rng(seed)
    of = Drawing((pictured_path(SQUARE, random_picture(rng)), pictured_path(DISC, random_picture(rng))))
    wanted = sample_picture(of, 2, 32)
    np.testing.assert_allclose(build_map(of).mean[0].reshape(2, 2, 4)[::-1], wanted, atol=4 / 255)
