"""Uniform cubic B-splines of pixels: means over boxes, and the coefficients of a blurred raster.

A coefficient belongs to the centre of its pixel. A row or column that does not exist is replaced by the nearest one.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.drawing.picture import Sampling

SPLINE, OPACITY, INVERSE = int(Sampling.SPLINE), int(Sampling.OPACITY), int(Sampling.INVERSE)

TAPER: Final = 4.5
"""Deviations from the middle at which a Gaussian is cut off."""

LEAST_OPACITY: Final = 1e-9
"""Opacity below which a colour has no hue."""

STEPS: Final = 12
"""Steps of Newton's method, with which a fifth root of 0.003 is exact to rounding."""

HALVINGS: Final = 10
"""Squarings of exp(-t / 1024), whose series has few terms; ``exp`` of the C library differs between platforms."""


@kernel(allocates=False)
def spline_integral(x: float) -> float:
    """Integral of the cubic B-spline up to a distance from its middle; 0 before it, 1 beyond.

    Examples
    --------
    >>> [round(spline_integral(x), 6) for x in (-2.0, -1.0, 0.0, 1.0, 2.0)]
    [0.0, 0.041667, 0.5, 0.958333, 1.0]
    """
    far = abs(x)
    if far >= 2.0:
        beyond = 0.0
    elif far >= 1.0:
        rest = (2.0 - far) * (2.0 - far)
        beyond = rest * rest / 24.0
    else:
        beyond = 0.5 - far * (2.0 / 3.0 - far * far * (1.0 / 3.0 - far / 8.0))
    return beyond if x < 0.0 else 1.0 - beyond


@kernel(allocates=False)
def spline_span(low: float, high: float) -> tuple[int, int]:
    """Return the first coefficient, which may not exist, with a weight in an interval, and the one after the last."""
    return int(np.floor(low - 0.5)) - 1, int(np.floor(high - 0.5)) + 3


@kernel(allocates=False)
def _falloff(t: float) -> float:
    """Return exp(-t) for t from 0 to about 12."""
    part = t / (1 << HALVINGS)
    value = 1.0 - part * (1.0 - part * (0.5 - part * (1.0 / 6.0 - part / 24.0)))
    for _ in range(HALVINGS):
        value *= value
    return value


@kernel
def blur_rows(
    raster: NDArray[np.float64], first: float, step: float, count: int, deviation: float
) -> NDArray[np.float64]:
    """Blurred values (count, columns, components) of the rows of a raster (rows, columns, components).

    Lengths are in rows, and `first` is the height of the first value. The raster is 0 beyond its rows, which are means:
    the variance of a row is part of that of the blur.
    """
    rows, columns, components = raster.shape
    out = np.zeros((count, columns, components))
    variance = max(deviation * deviation - 1.0 / 12.0, 1e-3)
    reach = TAPER * deviation
    total = 0.0
    for k in range(-int(reach) - 1, int(reach) + 2):
        total += _falloff(0.5 * k * k / variance)
    for j in range(count):
        middle = first + step * j - 0.5
        low, high = max(int(np.ceil(middle - reach)), 0), min(int(np.floor(middle + reach)), rows - 1)
        for row in range(low, high + 1):
            weight = _falloff(0.5 * (row - middle) * (row - middle) / variance) / total
            for i in range(columns):
                for c in range(components):
                    out[j, i, c] += weight * raster[row, i, c]
    return out


@kernel
def swap_sides(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Exchange rows and columns of values (rows, columns, components)."""
    rows, columns, components = values.shape
    out = np.empty((columns, rows, components))
    for j in range(rows):
        for i in range(columns):
            for c in range(components):
                out[i, j, c] = values[j, i, c]
    return out


@kernel
def to_coefficients(values: NDArray[np.float64]) -> None:
    """Replace values (rows, columns, components) by the coefficients, along columns, of the spline through them.

    This solves (c[j - 1] + 4 c[j] + c[j + 1]) / 6 = value[j] by elimination (Thomas, 1949), where the coefficients
    beyond the ends repeat the last ones.
    """
    rows, columns, components = values.shape
    share = np.empty(rows)
    before = 0.0
    for j in range(rows):
        diagonal = 4.0 + (1.0 if j == 0 else 0.0) + (1.0 if j == rows - 1 else 0.0)
        pivot = diagonal - before
        share[j] = 1.0 / pivot
        for i in range(columns):
            for c in range(components):
                above = values[j - 1, i, c] if j > 0 else 0.0
                values[j, i, c] = (6.0 * values[j, i, c] - above) * share[j]
        before = share[j]
    for j in range(rows - 2, -1, -1):
        for i in range(columns):
            for c in range(components):
                values[j, i, c] -= share[j] * values[j + 1, i, c]


@kernel
def spline_words(values: NDArray[np.float64]) -> NDArray[np.uint32]:
    """Words (rows, columns) of the coefficients of the spline through values (rows, columns, components), 0..1.

    Four components are premultiplied colours, and one is an opacity. Values are overwritten.
    """
    to_coefficients(values)
    turned = swap_sides(values)
    to_coefficients(turned)
    columns, rows, components = turned.shape
    words = np.empty((rows, columns), np.uint32)
    for j in range(rows):
        for i in range(columns):
            most, word = 255, 0
            for k in range(components):
                c = components - 1 - k  # the opacity first, which no colour exceeds
                value = min(int(np.floor(255.0 * min(max(turned[i, j, c], 0.0), 1.0) + 0.5)), most)
                most = value if k == 0 else most
                word |= value << 8 * c
            words[j, i] = word
    return words


class BlurAxis(NamedTuple):
    """The values of a blur along one axis, in cells of its raster."""

    first: float  # place of the first value
    step: float
    values: int  # number of them
    deviation: float


@kernel(ahead=True)
def blurred_words(raster: NDArray[np.float64], down: BlurAxis, across: BlurAxis, is_linear: int) -> NDArray[np.uint32]:
    """Words (rows, columns) of the spline of a blurred raster (side, side, components); see `spline_words`.

    If `is_linear` is 1, colours are blurred in linear light. The raster is then overwritten.
    """
    if is_linear == 1:
        _convert(raster, True)
    values = swap_sides(blur_rows(raster, down.first, down.step, down.values, down.deviation))
    values = swap_sides(blur_rows(values, across.first, across.step, across.values, across.deviation))
    if is_linear == 1:
        _convert(values, False)
    return spline_words(values)


@kernel(allocates=False)
def _convert(values: NDArray[np.float64], is_encoded: bool) -> None:
    """Convert premultiplied colours (rows, columns, 4) from sRGB to linear light, or back."""
    rows, columns, _ = values.shape
    for j in range(rows):
        for i in range(columns):
            alpha = min(max(values[j, i, 3], 0.0), 1.0)
            for c in range(3):
                straight = min(max(values[j, i, c] / max(alpha, LEAST_OPACITY), 0.0), 1.0)
                values[j, i, c] = alpha * (to_linear(straight) if is_encoded else from_linear(straight))


@kernel(allocates=False)
def to_linear(encoded: float) -> float:
    """Linear light of an sRGB component (IEC 61966-2-1); the power of 2.4 is x^2 (x^(1/5))^2.

    Examples
    --------
    >>> round(float(to_linear(0.5)), 6)
    0.214041
    """
    if encoded <= 0.04045:
        return encoded / 12.92
    x = (encoded + 0.055) / 1.055
    root = _root(x, 5)
    return x * x * root * root


@kernel(allocates=False)
def from_linear(linear: float) -> float:
    """Return the sRGB component of linear light; the power of 5/12 is the twelfth root to the fifth.

    Examples
    --------
    >>> round(float(from_linear(to_linear(0.5))), 9)
    0.5
    """
    if linear <= 0.0031308:
        return linear * 12.92
    root = np.sqrt(np.sqrt(_root(linear, 3)))
    return 1.055 * root * root * root * root * root - 0.055


@kernel(allocates=False)
def _root(x: float, degree: int) -> float:
    """Root of a number in 0..1 above 0.003, by Newton's method from above; ``pow`` differs between platforms."""
    root = 1.0
    for _ in range(STEPS):
        power = 1.0
        for _ in range(degree - 1):
            power *= root
        root -= (root * power - x) / (degree * power)
    return root
