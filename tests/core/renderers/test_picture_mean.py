"""The mean of a picture over a parallelogram: the mirror of the shader against exact integrals."""

import math
from functools import cache

import numpy as np
import pytest

from picture_texels import noise, operation_of, texels_of_pixels, true_mean
from vexture.base.layout import KIND_KEEP, KIND_LINEAR, KIND_MIX, KIND_SHIFT, MASKS, PAINT_ONE, STOP_BITS
from vexture.drawing.group import Mask
from vexture.drawing.picture import Picture, Sampling
from vexture.renderers.gradient import VextureRegion, program
from vexture.renderers.pixels import first_level, picture_mean
from vexture.texture.encode import texel_rows

PHOTOGRAPH = 512
UPRIGHT, MOST = 0.5, 2.0  # of 255


@cache
def picture(name: str):
    """Pixels and their texels."""
    if name == "photograph":
        pixels = noise(PHOTOGRAPH)
    else:
        columns, rows = map(int, name.split("x"))
        pixels = np.random.default_rng(columns).integers(0, 256, (rows, columns, 4)).astype(np.uint8)
    return pixels, texel_rows(np.concatenate([np.zeros((7, 4), np.uint32), texels_of_pixels(pixels)]))


def found_mean(name: str, middle, right, up, *, is_smooth: bool, share: float = 1.0):
    pixels, texels = picture(name)
    level = first_level((pixels.shape[1], pixels.shape[0]), 7, False)
    sides = [tuple(map(float, one)) for one in (middle, right, up)]
    return np.array(picture_mean(texels, level, is_smooth, *sides, share))


def worst_of(
    name: str, size: float, stretch: float, degrees: float, *, is_smooth: bool, count: int, beyond: float = 0.0
):
    """Largest difference over random places, of 255."""
    pixels, _ = picture(name)
    rng, worst = np.random.default_rng(3), 0.0
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    right, up = np.array([c, s]) * size * stretch, np.array([-s, c]) * size
    reach = 0.5 * (np.abs(right) + np.abs(up))
    for _ in range(count):
        low, high = reach - beyond, np.array(pixels.shape[1::-1]) - reach + beyond
        middle = rng.uniform(low, high)
        found = found_mean(name, middle, right, up, is_smooth=is_smooth)
        worst = max(worst, np.abs(found - true_mean(pixels, middle, right, up, is_smooth=is_smooth)).max())
    return worst


@pytest.mark.parametrize("is_smooth", [False, True])
@pytest.mark.parametrize("size", [1e-4, 0.03, 0.4, 1.0, 2.7, 6.5])
def test_the_mean_over_an_upright_box_is_exact(size: float, is_smooth: bool) -> None:
    for name in ("photograph", "13x6"):
        assert worst_of(name, size, 1.0, 0.0, is_smooth=is_smooth, count=60, beyond=min(1.5 * size, 1.5)) < UPRIGHT


@pytest.mark.parametrize("degrees", [30, 45, 83])
@pytest.mark.parametrize(("size", "stretch"), [(0.01, 1), (0.3, 6), (1, 1), (1, 6), (2.5, 2), (6, 1)])
def test_the_mean_over_a_turned_box_is_nearly_exact(size: float, stretch: float, degrees: float) -> None:
    assert worst_of("13x15", size, stretch, degrees, is_smooth=False, count=60, beyond=1.0) < UPRIGHT
    assert worst_of("photograph", size, stretch, degrees, is_smooth=True, count=60) < MOST


@pytest.mark.parametrize("is_smooth", [False, True])
@pytest.mark.parametrize(("stretch", "degrees"), [(1, 0), (1, 30), (6, 0), (6, 30), (6, 45)])
def test_a_small_photograph_is_its_mean(stretch: float, degrees: float, is_smooth: bool) -> None:
    """512 pixels at 37, where trilinear filters with 16 samples are off by 17 to 63."""
    for pixels in (37.0, 33.0):
        worst = worst_of("photograph", PHOTOGRAPH / pixels, stretch, degrees, is_smooth=is_smooth, count=40)
        assert worst < 1.25 * MOST, (pixels, worst)


def test_a_picture_in_one_pixel_is_its_mean() -> None:
    pixels, _ = picture("13x6")
    for size in ((13.0, 6.0), (40.0, 40.0), (1e9, 1e9)):
        found = found_mean("13x6", (6.5, 3.0), (size[0], 0.0), (0.0, size[1]), is_smooth=True)
        if size == (13.0, 6.0):
            np.testing.assert_allclose(found, pixels.mean(axis=(0, 1)), atol=1e-6)
        assert (found >= 0.0).all()
        assert (found <= 255.0).all()


def test_a_region_of_no_area_has_the_colours_along_it() -> None:
    pixels, _ = picture("13x15")
    for right, up in (((3.0, 1.0), (6.0, 2.0)), ((0.0, 0.0), (0.0, 0.0)), ((0.0, 0.0), (2.0, 0.1))):
        found = found_mean("13x15", (6.2, 7.1), right, up, is_smooth=False)
        places = (np.arange(400) + 0.5) / 400 - 0.5
        one, other = (np.multiply.outer(places, side) for side in (right, up))
        x, y = np.floor((6.2, 7.1) + one[:, None] + other).astype(int).reshape(-1, 2).T
        np.testing.assert_allclose(found, pixels[y, x].mean(axis=0), atol=2.0)


@pytest.mark.parametrize("sampling", [Sampling.PIXELS, Sampling.LINEAR])
def test_a_program_paints_the_colour_of_the_picture_at_a_point(sampling: Sampling) -> None:
    pixels, _ = picture("13x6")
    pixels = pixels.copy()
    pixels[..., :3] = np.minimum(pixels[..., :3], pixels[..., 3:])
    drawn = Picture(((11.0, 3.0, 0.5), (2.0, -7.0, 6.0)), pixels, sampling, 0.75)
    operation = operation_of(drawn.to_pixels, pixels, 3, is_smooth=sampling is Sampling.LINEAR, opacity=0.75)
    texels = texel_rows(np.concatenate([operation, texels_of_pixels(pixels)]))
    for x, y in np.random.default_rng(0).uniform(0, 1, (200, 2)).tolist():
        region = VextureRegion((x, y), (1e-6, 0.0), (0.0, 1e-6))
        found = np.array(program(texels, 0, 3, region, 1.0)) / 65535.0
        assert np.abs(found - drawn.color_at(x, y)).max() < UPRIGHT / 255


def masked_program(to_pixels, pixels):
    """Texels of a program, a picture that a linear gradient masks, and the number of those of the program."""
    words = np.zeros((6, 4), np.uint32)
    words[:3] = operation_of(to_pixels, pixels, 8, is_smooth=True)
    words[3, 3] = KIND_KEEP << KIND_SHIFT
    words[4, :3] = np.array([3.0, 1.0, -1.0], np.float32).view(np.uint32)
    words[4, 3] = KIND_LINEAR << KIND_SHIFT | 2 << STOP_BITS | 2
    words[5] = PAINT_ONE, MASKS + int(Mask.OPACITY), 0, KIND_MIX << KIND_SHIFT
    stops = np.zeros((2, 4), np.uint32)
    stops[:, 0] = np.array([0.0, 1.0], np.float32).view(np.uint32)
    stops[1, 2] = PAINT_ONE << 16
    return texel_rows(np.concatenate([words, stops, texels_of_pixels(pixels)])), len(words)


@pytest.mark.slow
@pytest.mark.parametrize(("size", "most"), [(4.0, 1.0), (14.0, 2.0), (40.0, 2.5)])
def test_a_product_of_a_picture_and_a_mask_is_averaged(size: float, most: float) -> None:
    pixels, _ = picture("photograph")
    texels, count = masked_program(((512.0, 0.0, 0.0), (0.0, -512.0, 512.0)), pixels)
    side, points = size / 512, (np.arange(48) + 0.5) / 48 - 0.5
    for x, y in np.random.default_rng(1).uniform(0.2, 0.8, (4, 2)).tolist():
        region = VextureRegion((x, y), (side, 0.0), (0.0, side))
        found = program(texels, 0, count, region, 1.0)
        small = side / len(points)
        parts = [
            program(texels, 0, count, VextureRegion((x + a * side, y + b * side), (small, 0.0), (0.0, small)), 1.0)
            for a in points
            for b in points
        ]
        assert np.abs(np.subtract(found, np.mean(parts, axis=0))).max() / 257 < most


@pytest.mark.parametrize("seed", range(4))
def test_any_numbers_come_to_an_end(seed: int) -> None:
    _, texels = picture("13x6")
    rng = np.random.default_rng(seed)
    wild = [0.0, -0.0, 1e-30, 1e30, -1e300, math.inf, -math.inf, math.nan, 3.0, 7e5]
    for _ in range(300):
        size = int(rng.integers(1, 65536)), int(rng.integers(1, 65536))
        level = first_level(size, int(rng.integers(0, 2**32)), False)
        sides = [(float(rng.choice(wild)), float(rng.choice(wild))) for _ in range(3)]
        picture_mean(texels, level, bool(rng.integers(2)), *sides, 2.0**-20)
