"""Noise of Perlin as filters define it (feTurbulence, Filter Effects 1, 9.21), at places of user space."""

from functools import lru_cache
from itertools import product
from math import ceil, floor, hypot, trunc
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.deadline import check_time
from vexture.svg.filter_frame import Numbers, PixelFrame, Pixels, Rectangle
from vexture.svg.filter_operations import Turbulence
from vexture.svg.filter_pixels import premultiply_colors

LATTICE: Final = 256
"""Points of the lattice along an axis, after which it repeats."""

ORIGIN: Final = 4096
"""Lattice point at the origin of user space."""

MODULUS: Final = 2**31 - 1
MULTIPLIER: Final = 7**5
"""Numbers of the random generator (Park and Miller, 1988)."""

MOST_OCTAVES: Final = 10
"""Most octaves; all further ones together change a component by less than a quarter of 1/255."""

MOST_FREQUENCY: Final = 1e9
"""Greatest frequency; far below it, noise already has no detail that pixels could show."""


BLOCK: Final = 1 << 14
"""Numbers that are computed at a time: they stay in a processor's cache."""


class NoiseLattice(NamedTuple):
    """Random numbers of noise: a permutation, continued beyond its end, and unit vectors of the four channels."""

    selector: NDArray[np.intp]  # (2 LATTICE + 2,)
    across: Numbers  # (LATTICE, 4)
    down: Numbers


def next_random(number: int) -> int:
    """Return the random number after another one.

    Examples
    --------
    >>> next_random(1), next_random(16807)
    (16807, 282475249)
    """
    return MULTIPLIER * number % MODULUS


def start_seed(seed: float) -> int:
    """Return the first number of the generator for the attribute `seed`, which is rounded towards 0.

    Examples
    --------
    >>> start_seed(0.9), start_seed(-5.0), start_seed(7.0), start_seed(1e30)
    (1, 6, 7, 2147483646)
    """
    number = trunc(seed)
    if number <= 0:
        number = -number % (MODULUS - 1) + 1
    return min(number, MODULUS - 1)


@lru_cache(maxsize=8)
def noise_lattice(seed: int) -> NoiseLattice:
    """Return the random numbers of noise for a first number of the generator."""
    number = seed
    vectors = np.empty((4, LATTICE, 2))
    for channel in range(4):
        for point in range(LATTICE):
            components = []
            for _ in range(2):
                number = next_random(number)
                components.append((number % (2 * LATTICE) - LATTICE) / LATTICE)
            length = hypot(*components)
            vectors[channel, point] = [component / length for component in components]
    selector = list(range(LATTICE))
    for point in range(LATTICE - 1, 0, -1):
        number = next_random(number)
        other = number % LATTICE
        selector[point], selector[other] = selector[other], selector[point]
    continued = np.array(selector + selector + selector[:2], np.intp)
    return NoiseLattice(continued, vectors[..., 0].T.copy(), vectors[..., 1].T.copy())


class _Seam(NamedTuple):
    """Lattice points of a tile along an axis, and the first point beyond it, which is the tile's first one."""

    extent: float
    end: float


def stitch_frequency(frequency: float, extent: float) -> float:
    """Return the nearest frequency of which a tile contains whole periods of the lattice.

    Examples
    --------
    >>> stitch_frequency(0.034, 100.0), stitch_frequency(0.035, 100.0), stitch_frequency(0.004, 100.0)
    (0.03, 0.04, 0.01)
    """
    low, high = floor(extent * frequency) / extent, ceil(extent * frequency) / extent
    return low if low > 0.0 and frequency / low < high / frequency else high


def turbulence(noise: Turbulence, frame: PixelFrame, subregion: Rectangle, samples: int = 1) -> Pixels:
    """Return noise as premultiplied colours in the colour space of the primitive.

    Parameters
    ----------
    noise : Turbulence
    frame : PixelFrame
    subregion : (left, top, right, bottom)
        Tile that is to be stitched.
    samples : int
        Places along each side of a pixel that are averaged.

    Returns
    -------
    (rows, columns, 4) array
    """
    frequencies = [min(frequency, MOST_FREQUENCY) for frequency in noise.frequency]
    if min(frequencies) < 0.0:
        return np.zeros((frame.rows, frame.columns, 4))
    stitches: list[_Seam | None] = [None, None]
    if noise.is_stitched:
        for axis in range(2):
            extent = subregion[axis + 2] - subregion[axis]
            if extent > 0.0 and frequencies[axis] > 0.0:
                frequencies[axis] = min(stitch_frequency(frequencies[axis], extent), MOST_FREQUENCY)
            count = trunc(extent * frequencies[axis] + 0.5)
            stitches[axis] = _Seam(count, trunc(subregion[axis] * frequencies[axis] + ORIGIN + count))
    lattice, height = noise_lattice(start_seed(noise.seed)), max(1, BLOCK // (4 * frame.columns))
    total = np.zeros((frame.rows, frame.columns, 4))
    offsets = (np.arange(samples) + 0.5) / samples - 0.5
    for top in range(0, frame.rows, height):
        rows = total[top : top + height]
        for down, across in product(offsets.tolist(), offsets.tolist()):
            xs = (frame.xs + frame.width * across) * frequencies[0]
            ys = (frame.ys[top : top + height] + frame.height * down) * frequencies[1]
            sums = _octaves(noise, lattice, (xs, ys), stitches)
            rows += premultiply_colors(0.5 * (sums + 1.0) if noise.is_fractal else sums)
    return np.asarray(total / samples**2)


def _octaves(
    noise: Turbulence, lattice: NoiseLattice, places: tuple[Numbers, Numbers], stitches: list[_Seam | None]
) -> Numbers:
    """Add up octaves of noise; places are columns and rows in lattice steps of the first one."""
    (xs, ys), (across, down), factor = places, stitches, 1.0
    sums = np.zeros((len(ys), len(xs), 4))
    for _ in range(min(noise.octaves, MOST_OCTAVES)):
        check_time()
        octave = _noise(lattice, xs * factor, ys * factor, across, down)
        sums += (octave if noise.is_fractal else np.abs(octave)) / factor
        factor *= 2.0
        across, down = (side and _Seam(2 * side.extent, 2 * side.end - ORIGIN) for side in (across, down))
    return sums


def _noise(lattice: NoiseLattice, xs: Numbers, ys: Numbers, across: _Seam | None, down: _Seam | None) -> Numbers:
    """Return noise of the four channels at columns and rows in lattice steps."""
    left, right, x, x_share = _cells(xs, across)
    top, bottom, y, y_share = _cells(ys, down)
    x, x_share = x[:, None], x_share[:, None]
    y, y_share = y[:, None, None], y_share[:, None, None]
    at_left, at_right = lattice.selector[left], lattice.selector[right]

    def rise(at: NDArray[np.intp], row: NDArray[np.intp], to_x: Numbers, to_y: Numbers) -> Numbers:
        point = lattice.selector[at + row[:, None]]
        return np.asarray(to_x * lattice.across[point] + to_y * lattice.down[point])

    upper = rise(at_left, top, x, y)
    upper += x_share * (rise(at_right, top, x - 1.0, y) - upper)
    lower = rise(at_left, bottom, x, y - 1.0)
    lower += x_share * (rise(at_right, bottom, x - 1.0, y - 1.0) - lower)
    upper += y_share * (lower - upper)
    return upper


def _cells(places: Numbers, stitches: _Seam | None) -> tuple[NDArray[np.intp], NDArray[np.intp], Numbers, Numbers]:
    """Return the lattice points on both sides of places, distances from the first, and shares of the second.

    The specification rounds towards 0, which tears the noise left of lattice point 0, so this rounds down.
    """
    moved = places + ORIGIN
    low = np.floor(moved)
    high, part = low + 1.0, moved - low
    if stitches is not None:
        low, high = (np.where(point >= stitches.end, point - stitches.extent, point) for point in (low, high))
    points = (np.mod(point, LATTICE).astype(np.intp) for point in (low, high))
    return *points, part, part * part * (3.0 - 2.0 * part)  # type: ignore[return-value]
