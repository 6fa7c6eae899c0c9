"""The mean of a spline over a parallelogram: the mirror of the shader against integrals."""

import math
from functools import cache

import numpy as np
import pytest

from spline_texels import blurred, colored, mean_of_spline, spline_operation, texels_of_spline
from vexture.drawing.picture import Picture, Sampling
from vexture.renderers.gradient import VextureRegion, program
from vexture.renderers.pixels import first_level
from vexture.renderers.splines import sampled_mean
from vexture.texture.encode import texel_rows

FIRST = 7
KINDS = ("edge", "corner", "dot")
SIZE = (173, 150)
UPRIGHT, MOST, FAR = 0.1, 1.0, 2.0  # of 255


@cache
def spline(kind: str, components: int):
    """Coefficients and their texels."""
    pixels = blurred(kind, *SIZE)
    pixels = pixels if components == 1 else colored(pixels)
    return pixels, texel_rows(np.concatenate([np.zeros((FIRST, 4), np.uint32), texels_of_spline(pixels)]))


def found_mean(kind: str, components: int, middle, right, up, share: float = 1.0):
    pixels, texels = spline(kind, components)
    level = first_level(pixels.shape[1::-1], FIRST, components == 1)
    sides = [tuple(map(float, one)) for one in (middle, right, up)]
    sampling = Sampling.OPACITY if components == 1 else Sampling.SPLINE
    return np.array(sampled_mean(texels, level, int(sampling), *sides, share))[:components]


def worst_of(size: float, stretch: float, degrees: float, slant: float = 0.0, components: int = 1, count: int = 20):
    """Largest difference over places about the middle of each spline, of 255."""
    rng, worst = np.random.default_rng(3), 0.0
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    right, up = np.array([c, s]) * size * stretch, np.array([-s, c]) * size
    up = up + slant * right
    reach = 0.5 * (np.abs(right) + np.abs(up)) + 3.0
    for kind in KINDS:
        for _ in range(count):
            middle = 0.5 * np.array(SIZE) + rng.uniform(-reach, reach)
            found = found_mean(kind, components, middle, right, up)
            worst = max(worst, np.abs(found - mean_of_spline(spline(kind, components)[0], middle, right, up)).max())
    return worst


@pytest.mark.parametrize("components", [1, 4])
@pytest.mark.parametrize("size", [1e-6, 0.2, 1.0, 3.3, 8.0, 11.9])
def test_the_mean_over_an_upright_box_is_exact_if_it_is_of_opacities(size: float, components: int) -> None:
    most = UPRIGHT if components == 1 else MOST if size < 6.0 else FAR
    assert worst_of(size, 1.0, 0.0, components=components) < most
    if size < 3.0:
        assert worst_of(size, 0.4, 90.0, components=components) < most


@pytest.mark.parametrize(
    ("stretch", "degrees", "slant"), [(1, 45, 0), (1, 31, 0), (1.3, 45, 0), (1.3, 70, 0), (1, 0, 0.6), (1, 20, 0.3)]
)
def test_the_mean_over_any_parallelogram_up_to_six_deviations_is_nearly_exact(stretch, degrees, slant) -> None:
    for size in (0.01, 0.3, 1.0, 1.8, 2.5, 3.5, 5.0, 6.5, 8.0):
        assert worst_of(size, stretch, degrees, slant, count=6) < MOST, size


@pytest.mark.slow
@pytest.mark.parametrize(("degrees", "slant"), [(0, 0), (30, 0), (45, 0), (45, 0.7)])
def test_the_mean_over_a_long_parallelogram_is_nearly_exact(degrees: float, slant: float) -> None:
    for size in (0.02, 0.3, 1.0, 1.8, 2.5, 3.5, 5.0, 8.0):
        assert worst_of(size, 6.0, degrees, slant, count=6) < 1.25 * MOST, size


@pytest.mark.slow
@pytest.mark.parametrize("components", [1, 4])
@pytest.mark.parametrize(("stretch", "degrees"), [(1, 0), (1, 37), (1, 45), (3, 0), (3, 45)])
def test_the_mean_over_a_wide_footprint_is_nearly_exact(stretch: float, degrees: float, components: int) -> None:
    for size in (9.0, 13.0, 16.0, 20.0, 27.0):
        assert worst_of(size, stretch, degrees, components=components, count=6) < FAR * components**0.5, size


def test_a_spline_in_one_pixel_is_its_mean() -> None:
    for kind in KINDS:
        pixels, _ = spline(kind, 1)
        found = found_mean(kind, 1, (86.0, 75.0), (1e9, 0.0), (0.0, 1e9))
        np.testing.assert_allclose(found, pixels.mean(), atol=0.5)


@pytest.mark.parametrize("kind", KINDS)
def test_beyond_the_border_its_coefficients_continue(kind: str) -> None:
    pixels, _ = spline(kind, 1)
    for place in ((-4.0, -1e6), (-1e3, 40.2), (172.7, 149.9), (86.1, 1e9), (1e30, -1e30)):
        near = np.clip(place, -9.0, np.add(SIZE, 9.0))
        expected = mean_of_spline(pixels, near, (1.0, 0.0), (0.0, 1.0))
        np.testing.assert_allclose(found_mean(kind, 1, place, (1.0, 0.0), (0.0, 1.0)), expected, atol=1e-6)


@pytest.mark.parametrize("sampling", [Sampling.SPLINE, Sampling.OPACITY, Sampling.INVERSE])
@pytest.mark.parametrize(("columns", "rows"), [(13, 6), (1, 1), (4, 9)])
def test_a_program_paints_the_colour_of_the_spline_at_a_point(sampling: Sampling, columns: int, rows: int) -> None:
    color = None if sampling is Sampling.SPLINE else (51 / 255, 0.0, 1.0)
    rng = np.random.default_rng(3)
    pixels = rng.integers(0, 256, (rows, columns, 1)).astype(np.uint8)
    pixels = pixels if sampling.components == 1 else colored(blurred("edge", columns, rows))
    drawn = Picture(((11.0, 3.0, 0.5), (2.0, -7.0, 6.0)), pixels, sampling, 0.75, color)
    word = 0 if color is None else 51 | 255 << 16
    operation = spline_operation(drawn.to_pixels, pixels, 3, sampling, word, 0.75)
    texels = texel_rows(np.concatenate([operation, texels_of_spline(pixels)]))
    for x, y in rng.uniform(0, 1, (200, 2)).tolist():
        region = VextureRegion((x, y), (1e-6, 0.0), (0.0, 1e-6))
        found = np.array(program(texels, 0, 3, region, 1.0)) / 65535.0
        assert np.abs(found - drawn.color_at(x, y)).max() < (UPRIGHT if color else MOST) / 255


@pytest.mark.parametrize("seed", range(4))
def test_any_numbers_come_to_an_end(seed: int) -> None:
    _, texels = spline("dot", 1)
    rng = np.random.default_rng(seed)
    wild = [0.0, -0.0, 1e-30, 1e30, -1e300, math.inf, -math.inf, math.nan, 3.0, 7e5]
    for _ in range(300):
        size = int(rng.integers(1, 65536)), int(rng.integers(1, 65536))
        sampling = int(rng.choice(Sampling))
        level = first_level(size, int(rng.integers(0, 2**32)), sampling >= Sampling.OPACITY)
        sides = [(float(rng.choice(wild)), float(rng.choice(wild))) for _ in range(3)]
        sampled_mean(texels, level, sampling, *sides, 2.0**-20)
