"""Filter primitives that combine each pixel with others: blur, morphology, convolution and displacement."""

from math import ceil, floor, prod
from typing import Final

import numpy as np

from vexture.base.deadline import check_time
from vexture.base.errors import LimitError
from vexture.svg.filter_frame import Numbers, PixelFrame, Pixels, Rectangle, edge_positions, sample_columns, sample_rows
from vexture.svg.filter_operations import Convolution
from vexture.svg.filter_pixels import limit_colors, premultiply_colors, straighten

REACH: Final = 4.5
"""Deviations beyond which a Gaussian counts as 0; 7 of 10^6 parts lie there."""

LEAST_SAMPLED: Final = 0.7
"""Deviation in pixels from which on the values of a Gaussian are weights; their variance is off by 0.2% there."""

MOST_DEVIATION: Final = 1e6
"""Greatest deviation in pixels; of a picture of 1,000 pixels a side, nothing is visible then."""

MOST_STEP: Final = 1e9
"""Greatest distance of the neighbours in a convolution, in pixels; all but those at the target are beyond the edges."""

MOST_WORK: Final = 1 << 27
"""Most products of a convolution: numbers of a picture times those of the matrix that are not 0."""


BLOCK: Final = 1 << 14
"""Numbers that are blurred at a time: they stay in a processor's cache."""


def gaussian_blur(pixels: Pixels, frame: PixelFrame, deviations: tuple[float, float]) -> Pixels:
    """Blur premultiplied colours along x and y (feGaussianBlur, 9.14); pixels beyond the edges are transparent.

    Parameters
    ----------
    pixels : (rows, columns, 4) array
    frame : PixelFrame
    deviations : (float, float)
        In user units; along an axis where it is not above 0, nothing is blurred.

    Returns
    -------
    (rows, columns, 4) array
    """
    channels = np.flatnonzero(pixels.any(axis=(0, 1)))  # a shadow has only opacity
    part = np.ascontiguousarray(np.moveaxis(pixels[..., channels], 2, 0))
    part = _blur_last(part, deviations[0] / frame.width)
    part = _blur_last(np.ascontiguousarray(part.swapaxes(1, 2)), deviations[1] / frame.height).swapaxes(1, 2)
    blurred = np.zeros_like(pixels)
    blurred[..., channels] = np.moveaxis(part, 0, 2)
    return blurred


def _blur_last(values: Numbers, deviation: float) -> Numbers:
    """Blur along the last axis, by a deviation in its steps."""
    if not deviation > 0.0:
        return values
    lines = values.reshape(-1, values.shape[-1])
    weights = gaussian_weights(deviation, lines.shape[1])
    blurred, height = weights[0] * lines, max(1, BLOCK // lines.shape[1])
    for top in range(0, len(lines), height):
        check_time()
        block, sums = lines[top : top + height], blurred[top : top + height]
        scaled = np.empty_like(block)
        for distance, weight in enumerate(weights[1:].tolist(), 1):
            np.multiply(block, weight, out=scaled)
            sums[:, distance:] += scaled[:, :-distance]
            sums[:, :-distance] += scaled[:, distance:]
    return np.reshape(blurred, values.shape)


def gaussian_weights(deviation: float, count: int) -> Numbers:
    """Return weights of a Gaussian at distances of 0, 1, ... steps, fewer than `count`.

    With those at negative distances, all weights (also those that `count` leaves out) have the sum 1.

    Examples
    --------
    >>> gaussian_weights(0.5, 9).round(4).tolist()
    [0.791, 0.0981, 0.0061, 0.0003]
    """
    deviation = min(deviation, MOST_DEVIATION)
    if deviation >= LEAST_SAMPLED:
        distances = np.arange(min(count, 1 + ceil(min(REACH * deviation, float(count)))))
        values: Numbers = np.exp(-0.5 * (distances / deviation) ** 2)
        # the sum over all distances is that of the integral, but for 2 exp(-2 (pi deviation)^2)
        total = deviation * np.sqrt(2.0 * np.pi) * (1.0 + 2.0 * np.exp(-2.0 * (np.pi * deviation) ** 2))
        return np.asarray(values / total)
    # values of a narrow Gaussian have too small a variance; this is the discrete kernel of exactly that variance
    # (Lindeberg 1990), exp(-t) I_n(t), as the Fourier integral of exp(t (cos w - 1)), which is exact for so few steps
    angles = np.pi * (np.arange(64) + 0.5) / 64
    spectrum = np.exp(deviation**2 * (np.cos(angles) - 1.0))
    distances = np.arange(min(count, 1 + ceil(6.0 * deviation)))
    return np.array([np.mean(spectrum * np.cos(distance * angles)) for distance in distances])


def morphology(pixels: Pixels, frame: PixelFrame, radii: tuple[float, float], is_dilation: bool) -> Pixels:
    """Return the greatest or least components in a rectangle about each pixel (feMorphology, 9.17).

    Pixels beyond the edges are transparent. The picture is linear between the middles of its pixels, so radii may be
    fractions of pixels.

    Parameters
    ----------
    pixels : (rows, columns, 4) array
    frame : PixelFrame
    radii : (float, float)
        Half of the rectangle's sides, in user units; one that is not above 0 has no effect.
    is_dilation : bool

    Returns
    -------
    (rows, columns, 4) array
    """
    along_y = _extreme_rows(pixels, radii[1] / frame.height, is_dilation)
    return _extreme_rows(along_y.swapaxes(0, 1), radii[0] / frame.width, is_dilation).swapaxes(0, 1)


def _extreme_rows(values: Numbers, radius: float, is_dilation: bool) -> Numbers:
    if not radius > 0.0:
        return values
    extreme, count = np.maximum if is_dilation else np.minimum, len(values)
    whole = min(floor(radius + 1e-9), count)
    padded = np.zeros((count + 2 * whole, *values.shape[1:]))
    padded[whole : whole + count] = values
    width, size = 1, 2 * whole + 1  # windows of twice the width, as long as they fit
    while 2 * width <= size:
        padded = extreme(padded[:-width], padded[width:])
        width *= 2
    if width < size:
        padded = extreme(padded[: width - size], padded[size - width :])
    part = min(radius, count + 1.0) - whole
    if part > 1e-9:
        positions = np.arange(float(count))
        for side in (-1.0, 1.0):
            ends = sample_rows(values, positions + side * (whole + part), (-0.5, count - 0.5), "none")
            padded = extreme(padded, ends)
    return padded


def convolve(pixels: Pixels, frame: PixelFrame, kernel: Convolution, bounds: Rectangle) -> Pixels:
    """Add up weighted neighbours of each pixel (feConvolveMatrix, 9.9).

    Parameters
    ----------
    pixels : (rows, columns, 4) array
    frame : PixelFrame
    kernel : Convolution
        Neighbours are at distances in user units, and are interpolated between pixels.
    bounds : (left, top, right, bottom)
        Edges of the picture.

    Returns
    -------
    (rows, columns, 4) array

    Raises
    ------
    LimitError
        If it takes more than `MOST_WORK` products.
    """
    check_work(kernel, frame)
    columns, rows = kernel.order
    matrix = np.reshape(np.array(kernel.matrix)[::-1], (rows, columns))  # turned, as a convolution is
    source = straighten(pixels) if kernel.preserves_alpha else pixels
    left, top, right, bottom = edge_positions(frame, bounds)
    sums = np.zeros_like(pixels)
    ys, xs = np.arange(float(frame.rows)), np.arange(float(frame.columns))
    dx, dy = min(kernel.lengths[0] / frame.width, MOST_STEP), min(kernel.lengths[1] / frame.height, MOST_STEP)
    with np.errstate(over="ignore", invalid="ignore"):
        for i in np.flatnonzero(matrix.any(axis=1)):
            line = sample_rows(source, ys + (i - kernel.target[1]) * dy, (top, bottom), kernel.edges)
            for j in np.flatnonzero(matrix[i]):
                check_time()
                places = xs + (j - kernel.target[0]) * dx
                sums += matrix[i, j] * sample_columns(line, places, (left, right), kernel.edges)
        sums /= kernel.divisor if kernel.divisor != 0.0 else sum(kernel.matrix) or 1.0
        sums[..., 3] = source[..., 3] if kernel.preserves_alpha else sums[..., 3] + kernel.bias
        sums[..., :3] += kernel.bias * sums[..., 3:]
    return premultiply_colors(sums) if kernel.preserves_alpha else limit_colors(sums)


def check_work(kernel: Convolution, frame: PixelFrame) -> None:
    """Raise a `LimitError` if a convolution takes more than `MOST_WORK` products."""
    work = sum(number != 0.0 for number in kernel.matrix) * 4 * frame.rows * frame.columns
    if prod(kernel.order) != len(kernel.matrix) or work > MOST_WORK:
        raise LimitError(
            f"a filter's matrix of {kernel.order[0]} x {kernel.order[1]} with {len(kernel.matrix):,} numbers takes "
            f"{work:,} products; the limit is {MOST_WORK:,}; use a smaller matrix"
        )


def displace(
    pixels: Pixels, frame: PixelFrame, displacements: Pixels, scale: float, channels: tuple[int, int]
) -> Pixels:
    """Return the colours at displaced places (feDisplacementMap, 9.11), linearly between pixels.

    Parameters
    ----------
    pixels : (rows, columns, 4) array
    frame : PixelFrame
    displacements : (rows, columns, 4) array
        In the colour space of the primitive; the middle grey of a channel leaves a pixel.
    scale : float
        Displacement between 0 and 1 of a channel, in user units.
    channels : (int, int)
        Channels 0..3 that displace along x and along y.

    Returns
    -------
    (rows, columns, 4) array
    """
    straight = straighten(displacements)
    rows, columns = frame.rows, frame.columns
    with np.errstate(over="ignore"):
        xs = np.arange(columns) + scale / frame.width * (straight[..., channels[0]] - 0.5)
        ys = np.arange(rows)[:, None] + scale / frame.height * (straight[..., channels[1]] - 0.5)
    xs, ys = xs.clip(-1.0, columns).ravel(), ys.clip(-1.0, rows).ravel()
    padded = np.pad(pixels, ((1, 2), (1, 2), (0, 0))).reshape(-1, 4)
    x, y = np.floor(xs).astype(np.intp), np.floor(ys).astype(np.intp)
    right, down = (xs - x)[:, None], (ys - y)[:, None]
    first = (y + 1) * (columns + 3) + x + 1
    above = padded[first] * (1.0 - right) + padded[first + 1] * right
    below = padded[first + columns + 3] * (1.0 - right) + padded[first + columns + 4] * right
    return np.reshape(above * (1.0 - down) + below * down, pixels.shape)
