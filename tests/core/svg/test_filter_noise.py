"""Noise of filters, against the specification's algorithm at single places."""

from math import floor, sqrt

import numpy as np
import pytest
from svg_reference import render_file

from vexture.svg.filter_frame import PixelFrame
from vexture.svg.filter_noise import (
    MOST_OCTAVES,
    next_random,
    noise_lattice,
    start_seed,
    stitch_frequency,
    turbulence,
)
from vexture.svg.filter_operations import Turbulence

FRAME = PixelFrame(-20.0, 7.0, 1.5, 0.75, 12, 10)
TILE = (-20.0, 7.0, 20.0, 37.0)


def test_the_random_numbers_are_those_of_the_specification() -> None:
    number = 1
    for _ in range(10_000):
        number = next_random(number)
    assert number == 1_043_618_065  # the test that the specification names


@pytest.mark.parametrize(("seed", "first"), [(0, 1), (1, 1), (-1, 2), (-0.7, 1), (2.9, 2), (2**31 - 2, 2**31 - 2)])
def test_seeds_are_whole_and_positive(seed: float, first: int) -> None:
    assert start_seed(seed) == first


def test_hostile_seeds_are_numbers_of_the_generator() -> None:
    assert {start_seed(seed) for seed in (2.0**31, 1e300)} == {2**31 - 2}
    assert start_seed(-(2.0**31) + 2) == 1
    assert all(1 <= start_seed(seed) <= 2**31 - 2 for seed in (-1e300, -(2.0**31), -(2.0**31) + 1))


def test_the_lattice_is_a_permutation_with_unit_vectors() -> None:
    lattice = noise_lattice(7)
    assert sorted(lattice.selector[:256].tolist()) == list(range(256))
    assert lattice.selector[256:].tolist() == lattice.selector[:258].tolist()[:256] + lattice.selector[:2].tolist()
    np.testing.assert_allclose(np.hypot(lattice.across, lattice.down), 1.0)


def noise_at(seed: int, channel: int, x: float, y: float) -> float:
    """Noise at one place, written for one place: corners in turn, each with its weight."""
    selector, vectors, number = [*range(256)], {}, seed
    for each in range(4):
        for point in range(256):
            pair = []
            for _ in "xy":
                number = 16807 * (number % 127773) - 2836 * (number // 127773)
                number += (number <= 0) * (2**31 - 1)
                pair.append(number % 512 / 256.0 - 1.0)
            vectors[each, point] = [part / sqrt(pair[0] ** 2 + pair[1] ** 2) for part in pair]
    for i in reversed(range(1, 256)):
        number = 16807 * (number % 127773) - 2836 * (number // 127773)
        number += (number <= 0) * (2**31 - 1)
        selector[i], selector[number % 256] = selector[number % 256], selector[i]
    total = 0.0
    for right in (0, 1):
        for down in (0, 1):
            column, row = floor(x) + right, floor(y) + down
            point = selector[(selector[column % 256] + row) % 256]
            dx, dy = x - column, y - row
            weight = 1.0
            for distance in (abs(dx), abs(dy)):
                weight *= 1.0 - distance**2 * (3.0 - 2.0 * distance)
            total += weight * (vectors[channel, point][0] * dx + vectors[channel, point][1] * dy)
    return total


def test_fractal_noise_is_the_sum_of_octaves_at_the_middle_of_pixels() -> None:
    noise = Turbulence((0.13, 0.07), 3, 42.0, is_fractal=True)
    found = turbulence(noise, FRAME, TILE)
    for row, column, channel in [(0, 0, 3), (3, 7, 0), (11, 9, 1), (8, 2, 2)]:
        x, y = FRAME.xs[column] * 0.13, FRAME.ys[row] * 0.07
        sums = [sum(noise_at(42, c, x * 2**k, y * 2**k) / 2**k for k in range(3)) for c in (channel, 3)]
        value, alpha = (np.clip(0.5 * (total + 1.0), 0.0, 1.0) for total in sums)
        assert found[row, column, channel] == pytest.approx(value * alpha if channel < 3 else alpha)


def test_turbulence_is_the_sum_of_magnitudes() -> None:
    found = turbulence(Turbulence((0.13, 0.07), 2, -9.0), FRAME, TILE)[4, 5]
    x, y = FRAME.xs[5] * 0.13, FRAME.ys[4] * 0.07
    sums = [sum(abs(noise_at(10, c, x * 2**k, y * 2**k)) / 2**k for k in range(2)) for c in range(4)]
    assert found.tolist() == pytest.approx([*(total * sums[3] for total in sums[:3]), sums[3]])


@pytest.mark.parametrize("is_fractal", [False, True])
def test_stitched_tiles_continue_at_the_opposite_edge(is_fractal: bool) -> None:
    noise = Turbulence((0.11, 0.06), 4, 3.0, is_fractal, is_stitched=True)
    thin = 1e-7
    for edges in ((-20.0, 20.0), (7.0, 37.0)):
        at_edges = []
        for place in edges:
            if edges[0] < 0.0:
                frame = PixelFrame(place - thin / 2.0, 7.0, thin, 0.5, 60, 1)
            else:
                frame = PixelFrame(-20.0, place - thin / 2.0, 0.5, thin, 1, 80)
            at_edges.append(turbulence(noise, frame, TILE))
        np.testing.assert_allclose(*at_edges, atol=1e-5)
    loose = turbulence(Turbulence((0.11, 0.06), 4, 3.0, is_fractal), PixelFrame(20.0, 7.0, 0.1, 0.5, 60, 1), TILE)
    assert np.abs(loose - at_edges[0][:1]).max() > 0.02


def test_stitching_takes_the_frequency_of_least_relative_change() -> None:
    assert stitch_frequency(0.25, 10.0) == 0.3  # 2.5 periods: 2 is a change by 1.25, 3 one by 1.2
    assert stitch_frequency(0.245, 10.0) == 0.3  # 0.2 is nearer, but not in proportion
    assert stitch_frequency(0.24, 10.0) == 0.2
    assert stitch_frequency(0.3, 10.0) == 0.3


def test_averages_over_a_pixel_are_those_of_finer_pixels() -> None:
    noise = Turbulence((0.3, 0.3), 2, 1.0, is_fractal=True)
    fine = turbulence(noise, PixelFrame(-20.0, 7.0, 0.5, 0.25, 36, 30), TILE)
    expected = fine.reshape(12, 3, 10, 3, 4).mean(axis=(1, 3))
    np.testing.assert_allclose(turbulence(noise, FRAME, TILE, samples=3), expected, atol=1e-12)


def test_special_parameters() -> None:
    assert not turbulence(Turbulence((-0.1, 0.1)), FRAME, TILE).any()
    assert not turbulence(Turbulence((0.1, 0.1), 0), FRAME, TILE).any()
    grey = turbulence(Turbulence((0.0, 0.0), 5, is_fractal=True), FRAME, TILE)
    np.testing.assert_array_equal(grey, np.broadcast_to((0.25, 0.25, 0.25, 0.5), grey.shape))


def test_hostile_parameters_end() -> None:
    for stitched in (False, True):
        hostile = turbulence(Turbulence((1e300, 1e-300), 10**9, 1e300, True, stitched), FRAME, TILE)
        assert np.isfinite(hostile).all()
        empty = turbulence(Turbulence((0.1, 0.1), 2, 0.0, True, stitched), FRAME, (5.0, 5.0, 5.0, 5.0))
        assert np.isfinite(empty).all()
    many, most = (turbulence(Turbulence((0.1, 0.1), n), FRAME, TILE) for n in (10**9, MOST_OCTAVES))
    np.testing.assert_array_equal(many, most)


@pytest.mark.parametrize(("kind", "octaves"), [("turbulence", 2), ("fractalNoise", 4)])
def test_resvg_draws_the_same_noise(kind: str, octaves: int) -> None:
    drawn = render_file(
        '<svg xmlns="http://www.w3.org/2000/svg" width="40" height="30"><filter id="f" x="0" y="0" width="40" '
        'height="30" filterUnits="userSpaceOnUse" color-interpolation-filters="sRGB"><feTurbulence '
        f'baseFrequency="0.07 0.11" numOctaves="{octaves}" seed="-5" type="{kind}"/></filter>'
        '<rect width="40" height="30" filter="url(#f)"/></svg>'
    )
    frame = PixelFrame(-0.5, -0.5, 1.0, 1.0, 30, 40)  # it takes the corners of pixels
    noise = Turbulence((0.07, 0.11), octaves, -5.0, kind == "fractalNoise")
    np.testing.assert_allclose(turbulence(noise, frame, (0.0, 0.0, 40.0, 30.0)), drawn, atol=1.5 / 255)
