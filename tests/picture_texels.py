"""Pictures as texels, packed from the text of FORMAT.md (D.6), and their true means."""

import math

import numpy as np
from numpy.typing import NDArray

from vexture.base.layout import KIND_FOCAL, KIND_FOLLOWS, KIND_PICTURE, KIND_SHIFT, MAP_HEAD, PAINT_ONE

Floats = NDArray[np.float64]
Words = NDArray[np.uint32]
LINES = 192  # scanlines between two rows of pixels


def level_of(pixels: NDArray[np.uint8], k: int) -> NDArray[np.uint8]:
    """Level k of a picture: each pixel is the mean of those among 2^k x 2^k that exist."""
    if k == 0:
        return pixels
    side = 1 << k
    rows, columns = (-(-size // side) for size in pixels.shape[:2])
    found = np.zeros((rows, columns, 4), np.uint8)
    for j in range(rows):
        for i in range(columns):
            block = pixels[j * side : (j + 1) * side, i * side : (i + 1) * side].reshape(-1, 4)
            found[j, i] = np.floor(block.mean(axis=0) + 0.5)
    return found


def texels_of_level(pixels: NDArray[np.uint8]) -> Words:
    """Texels of 2 x 2 pixels, row by row; pixels beyond the picture are 0."""
    rows, columns = pixels.shape[:2]
    whole = np.zeros((rows + rows % 2, columns + columns % 2, 4), np.uint32)
    whole[:rows, :columns] = pixels
    words = (whole << np.array([0, 8, 16, 24], np.uint32)).sum(axis=2, dtype=np.uint32)
    return words.reshape(len(words) // 2, 2, -1, 2).transpose(0, 2, 1, 3).reshape(-1, 4)


def texels_of_pixels(pixels: NDArray[np.uint8]) -> Words:
    """Texels of all levels."""
    last = math.ceil(math.log2(max(pixels.shape[:2])))
    return np.concatenate([texels_of_level(level_of(pixels, k)) for k in range(last + 1)])


def operation_of(to_pixels, pixels: NDArray[np.uint8], away: int, *, is_smooth: bool, opacity: float = 1.0) -> Words:
    """The three texels of the operation, `away` texels before those of the pixels."""
    rows, columns = pixels.shape[:2]
    found = np.full((3, 4), KIND_FOLLOWS << KIND_SHIFT, np.uint32)
    found[0] = round(opacity * PAINT_ONE), columns | rows << 16, away, KIND_PICTURE << KIND_SHIFT | int(is_smooth)
    found[1:, :3] = np.array(to_pixels, np.float32).view(np.uint32)
    return found


def with_pictures(texels: Words, root: int, to_pixels, pixels: NDArray[np.uint8], *, is_smooth: bool) -> Words:
    """The texels of a map with a picture in place of each focal gradient, which also has three texels."""
    found = np.concatenate([texels, texels_of_pixels(pixels)])
    first, operations, stops, _ = texels[root - MAP_HEAD].tolist()
    assert first + operations + stops == len(texels), "stops are last"
    found[root - MAP_HEAD, 3] = len(found) - len(texels)
    for at in range(first, first + operations):
        if texels[at, 3] >> KIND_SHIFT == KIND_FOCAL:
            found[at : at + 3] = operation_of(to_pixels, pixels, len(texels) - at, is_smooth=is_smooth, opacity=0.9)
    return found


def noise(side: int, seed: int = 1) -> NDArray[np.uint8]:
    """An opaque picture with the spectrum of a photograph, 1/f."""
    rng = np.random.default_rng(seed)
    distance = np.hypot(*np.meshgrid(np.fft.fftfreq(side), np.fft.fftfreq(side)))
    distance[0, 0] = 1.0
    found = np.full((side, side, 4), 255, np.uint8)
    for channel in range(3):
        waves = np.fft.ifft2(np.fft.fft2(rng.normal(size=(side, side))) / distance).real
        found[..., channel] = np.clip(np.rint(128 + 55 * waves / waves.std()), 0, 255)
    return found


def true_mean(pixels: NDArray[np.uint8], middle, right, up, *, is_smooth: bool) -> Floats:
    """Mean of a picture, 0..255, over a parallelogram in its pixels: exact along many scanlines, without weights."""
    middle, right, up = (np.array(one, float) for one in (middle, right, up))
    corners = middle + 0.5 * np.array([-right - up, right - up, right + up, up - right])
    low, high = corners.min(axis=0), corners.max(axis=0)
    edges = np.arange(math.floor(low[1]) - 1, math.ceil(high[1]) + 2)
    breaks = np.unique(np.clip(np.concatenate([edges, edges + 0.5, corners[:, 1]]), low[1], high[1]))
    wide = np.diff(breaks) / LINES
    y = (breaks[:-1, None] + wide[:, None] * (np.arange(LINES) + 0.5)).ravel()
    height = np.repeat(wide, LINES)
    left, far = spans_of(corners, y)
    # columns and rows around the parallelogram, which continue those at the border
    first, last = np.floor(low).astype(int) - 3, np.ceil(high).astype(int) + 3
    columns = np.clip(np.arange(first[0], last[0]), 0, pixels.shape[1] - 1)
    rows = np.clip(np.arange(first[1], last[1]), 0, pixels.shape[0] - 1)
    around = pixels[np.ix_(rows, columns)].astype(float)
    at = y - first[1] - (0.5 if is_smooth else 0.0)
    row, part = np.floor(at).astype(int), (at - np.floor(at) if is_smooth else 0.0 * at)[:, None]
    shift = first[0] + (0.5 if is_smooth else 0.0)
    sums = sums_along(around, is_smooth)
    found = sum(
        share
        * (sum_to(around, sums, line, far - shift, is_smooth) - sum_to(around, sums, line, left - shift, is_smooth))
        for share, line in ((1.0 - part, row), (part, np.minimum(row + 1, len(rows) - 1)))
    )
    return (height[:, None] * found).sum(axis=0) / (height * (far - left)).sum()


def spans_of(corners: Floats, y: Floats) -> tuple[Floats, Floats]:
    """Where horizontal lines enter and leave a convex outline."""
    left, far = np.full(len(y), np.inf), np.full(len(y), -np.inf)
    for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        if start[1] != end[1]:
            t = (y - start[1]) / (end[1] - start[1])
            x = np.where((t >= 0) & (t <= 1), start[0] + t * (end[0] - start[0]), np.nan)
            left, far = np.fmin(left, x), np.fmax(far, x)
    return left, far


def sums_along(around: Floats, is_smooth: bool) -> Floats:
    """Integral of each row up to each column, or to each centre of a column."""
    parts = 0.5 * (around[:, 1:] + around[:, :-1]) if is_smooth else around
    return np.concatenate([np.zeros((len(around), 1, 4)), parts.cumsum(axis=1)], axis=1)


def sum_to(around: Floats, sums: Floats, row: NDArray[np.int64], x: Floats, is_smooth: bool) -> Floats:
    """Integral of a row up to a place."""
    i = np.floor(x).astype(int)
    t = (x - i)[:, None]
    here = around[row, i]
    slope = 0.5 * t * t * (around[row, i + 1] - here) if is_smooth else 0.0
    return sums[row, i] + t * here + slope
