"""Ramps of gradients: the shape of their lines of equal colour, and the part of a ramp that lies in a box.

The colour at a place t of the ramp is that of a line, or of a circle with the centre (focus (1 - t), 0) and the radius
(1 - t) times the focal radius plus t, in the coordinates of the ramp. A row holds the columns of `shades.Shades`.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.tree.planar.shades import FOCUS, OFFSET, RADIUS

FLAT, LINES, NESTED, TOUCHING, CONE = range(5)
"""Shape of the lines of equal colour: a point, lines, nested circles, touching circles, or circles of a cone."""

CLOSE: Final = 1e-9
"""Radii. Focal circles within this distance of touching the outer circle touch it, and places on a ramp within this
distance are one."""


@kernel(allocates=False)
def shape_of_ramp(row: NDArray[np.float64]) -> int:
    """Shape of the lines of equal colour of a gradient."""
    focus, radius = row[FOCUS], row[RADIUS]
    if focus < 0.0:
        return LINES if row[0] != 0.0 or row[1] != 0.0 else FLAT
    if row[0] * row[4] - row[1] * row[3] == 0.0:
        return FLAT
    beyond = focus - abs(1.0 - radius)
    if beyond < -CLOSE:
        return NESTED
    return TOUCHING if beyond <= CLOSE and radius != 1.0 else CONE


@kernel(allocates=False)
def turn_outwards(row: NDArray[np.float64], stops: NDArray[np.float64]) -> None:
    """Rewrite a gradient of nested circles so that its last circle is the largest."""
    focus, radius = row[FOCUS], row[RADIUS]
    if focus < 0.0 or radius < 1.0:
        return
    row[0], row[1], row[2] = -row[0] / radius, -row[1] / radius, (focus - row[2]) / radius
    row[3], row[4], row[5] = row[3] / radius, row[4] / radius, row[5] / radius
    row[FOCUS], row[RADIUS] = focus / radius, 1.0 / radius
    last = len(stops) - 1
    for k in range(len(stops) // 2):
        for c in range(stops.shape[1]):
            stops[k, c], stops[last - k, c] = stops[last - k, c], stops[k, c]
    for k in range(len(stops)):
        stops[k, OFFSET] = 1.0 - stops[k, OFFSET]


@kernel(allocates=False)
def scale_of_ramp(row: NDArray[np.float64]) -> tuple[float, float]:
    """Largest and least length on the ramp's plane of a unit of the drawing; both are that of the ramp for lines."""
    a, b, d, e = row[0], row[1], row[3], row[4]
    if row[FOCUS] < 0.0:
        across = np.sqrt(a * a + b * b)
        return across, across
    first, second = a * a + b * b, d * d + e * e  # singular values of a matrix of two rows
    mixed = a * d + b * e
    apart = np.sqrt((first - second) * (first - second) + 4.0 * mixed * mixed)
    largest = np.sqrt(0.5 * (first + second + apart))
    return largest, abs(a * e - b * d) / largest


@kernel(allocates=False)
def place_in_circles(focus: float, radius: float, x: float, y: float) -> float:
    """Place of a point on the ramp of nested circles: the greatest root, as in FORMAT.md, D.6."""
    grows = 1.0 - radius
    a = focus * focus - grows * grows
    b = radius * grows - (x - focus) * focus
    c = (x - focus) * (x - focus) + y * y - radius * radius
    return (b - np.sqrt(max(b * b - a * c, 0.0))) / a


@kernel(allocates=False)
def reach_of_ramp(row: NDArray[np.float64], shape: int, box: NDArray[np.float64]) -> tuple[float, float]:
    """Lower and upper bound of the places on the ramp in a box; for circles, the lower is where the radius is 0."""
    focus, radius = row[FOCUS], row[RADIUS]
    grows = 1.0 - radius
    low, high, away = np.inf, -np.inf, 0.0
    if shape == TOUCHING:
        return -np.inf, np.inf
    for corner in range(4):
        x, y = box[corner >> 1, 0], box[corner & 1, 1]
        u, v = row[0] * x + row[1] * y + row[2], row[3] * x + row[4] * y + row[5]
        if shape == LINES:
            low, high = min(low, u), max(high, u)
        elif shape == NESTED:
            high = max(high, place_in_circles(focus, radius, u, v))
        else:
            tip = u - focus / grows
            away = max(away, np.sqrt(tip * tip + v * v))
    if shape == LINES:
        return low, high
    if shape == NESTED:
        return -radius / grows, high
    # the distance of a circle of radius r from the tip is r (focus / grows - 1)
    return -radius / grows, (away / (focus / grows - 1.0) - radius) / grows
