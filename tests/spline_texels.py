"""Pictures of spline coefficients as texels, packed from the text of FORMAT.md (D.6), and the splines' true means."""

import math

import numpy as np
from numpy.typing import NDArray

from picture_texels import level_of, operation_of, texels_of_pixels
from vexture.base.layout import KIND_FOCAL, KIND_FOLLOWS, KIND_PICTURE, KIND_SHIFT, MAP_HEAD
from vexture.drawing.picture import Sampling

Floats = NDArray[np.float64]
Words = NDArray[np.uint32]
DEVIATION = 4 / 3  # grid steps: the coefficients are 0.75 deviations apart


def blurred(kind: str, columns: int, rows: int, angle: float = 0.5) -> NDArray[np.uint8]:
    """Coefficients (rows, columns, 1) of an edge, a corner or a dot that is blurred about the middle of a grid."""
    edge = np.vectorize(lambda x: 0.5 * (1.0 + math.erf(x / DEVIATION / 2**0.5)))
    y, x = np.mgrid[0:rows, 0:columns] + 0.5
    x, y = x - 0.5 * columns - 0.2, y - 0.5 * rows + 0.3
    if kind == "edge":
        values = edge(x * math.cos(angle) + y * math.sin(angle))
    elif kind == "corner":
        values = edge(x) * edge(y)
    else:
        values = 0.5 * np.exp(-0.37 * (x * x + y * y) / DEVIATION**2)  # as of a disc with a radius of 1.2 deviations
    found = np.linalg.solve(samples(rows), np.linalg.solve(samples(columns), values.T).T)
    return np.clip(np.rint(255 * found), 0, 255).astype(np.uint8)[..., None]


def samples(count: int) -> Floats:
    """Matrix from the coefficients in a row to the spline's values at their places."""
    found = 2 / 3 * np.eye(count) + (np.eye(count, k=1) + np.eye(count, k=-1)) / 6
    found[0, 0] += 1 / 6
    found[-1, -1] += 1 / 6
    return found


def colored(coefficients: NDArray[np.uint8], seed: int = 5) -> NDArray[np.uint8]:
    """Premultiplied coefficients (rows, columns, 4) of several colours, whose opacities are given."""
    rows, columns, _ = coefficients.shape
    waves = np.random.default_rng(seed).uniform(0.2, 1.0, (3, 2))
    y, x = np.mgrid[0:rows, 0:columns]
    parts = [0.5 + 0.5 * np.sin(0.6 * (a * x + b * y) + a) for a, b in waves]
    return np.stack([*(np.floor(part * coefficients[..., 0]) for part in parts), coefficients[..., 0]], 2).astype(
        np.uint8
    )


def texels_of_opacities(pixels: NDArray[np.uint8]) -> Words:
    """Texels of all levels: an index, and the blocks of 4 x 4 that are not all equal."""
    entries: list[int] = []
    blocks: list[list[int]] = []
    for k in range(math.ceil(math.log2(max(pixels.shape[:2]))) + 1):
        level = level_of(np.repeat(pixels, 4, axis=2), k)[..., 0]
        for j in range(0, level.shape[0], 4):
            for i in range(0, level.shape[1], 4):
                block = level[j : j + 4, i : i + 4]
                if (block == block[0, 0]).all():
                    entries.append(int(block[0, 0]))
                    continue
                entries.append(256 + len(blocks))
                words = [sum(int(value) << 8 * c for c, value in enumerate(row)) for row in block]
                blocks.append(words + [0] * (4 - len(words)))
    entries += [0] * (-len(entries) % 8)
    pairs = np.array(entries, np.uint32).reshape(-1, 4, 2)
    return np.concatenate([pairs[..., 0] | pairs[..., 1] << 16, np.array(blocks, np.uint32).reshape(-1, 4)])


def texels_of_spline(pixels: NDArray[np.uint8]) -> Words:
    """Texels of all levels, by the number of components."""
    return texels_of_opacities(pixels) if pixels.shape[2] == 1 else texels_of_pixels(pixels)


def spline_operation(to_pixels, pixels, away: int, sampling: Sampling, color: int = 0, opacity: float = 1.0) -> Words:
    """The three texels of the operation."""
    found = operation_of(to_pixels, pixels, away, is_smooth=False, opacity=opacity)
    found[0, 3] = KIND_PICTURE << KIND_SHIFT | int(sampling)
    found[1, 3] = KIND_FOLLOWS << KIND_SHIFT | color
    return found


def spline_at(pixels: NDArray[np.uint8], x: Floats, y: Floats) -> Floats:
    """Values of a spline, 0..255, (..., components); coefficients at the border continue."""

    def around(place: Floats, count: int) -> tuple[NDArray[np.int64], Floats]:
        first = np.floor(place - 0.5).astype(np.int64)[..., None] + np.arange(-1, 3)
        away = np.abs(place[..., None] - first - 0.5)
        near, far = 2 / 3 - away**2 + away**3 / 2, np.maximum(2 - away, 0) ** 3 / 6
        return np.clip(first, 0, count - 1), np.where(away < 1, near, far)

    columns, across = around(x, pixels.shape[1])
    rows, down = around(y, pixels.shape[0])
    return np.einsum("...j,...i,...jic->...c", down, across, pixels[rows[..., None], columns[..., None, :]])


def mean_of_spline(pixels: NDArray[np.uint8], middle, right, up, points: int = 40) -> Floats:
    """Mean of a spline, 0..255, over a parallelogram: by Gauss-Legendre quadrature in both directions."""
    places, weights = np.polynomial.legendre.leggauss(points)
    a, b = 0.5 * places[:, None, None], 0.5 * places[None, :, None]
    x, y = np.moveaxis(np.array(middle) + a * np.array(right) + b * np.array(up), 2, 0)
    return 0.25 * np.einsum("a,b,abc->c", weights, weights, spline_at(pixels, x, y))


def with_splines(texels: Words, root: int, to_pixels, pixels, sampling: Sampling, color: int) -> Words:
    """The texels of a map with a spline in place of each focal gradient, which also has three texels."""
    found = np.concatenate([texels, texels_of_spline(pixels)])
    first, operations, stops, _ = texels[root - MAP_HEAD].tolist()
    assert first + operations + stops == len(texels), "stops are last"
    found[root - MAP_HEAD, 3] = len(found) - len(texels)
    for at in range(first, first + operations):
        if texels[at, 3] >> KIND_SHIFT == KIND_FOCAL:
            found[at : at + 3] = spline_operation(to_pixels, pixels, len(texels) - at, sampling, color, opacity=0.9)
    return found
