"""The colour of a gradient at a point, as SVG 2 defines it (14.2)."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.drawing.paint import Gradient, Spread, Stop

REFLECT, REPEAT = int(Spread.REFLECT), int(Spread.REPEAT)


class Shades(NamedTuple):
    """Gradients in two arrays only, because each array slows every call of a kernel."""

    rows: NDArray[np.float64]  # (n, 11): both rows of the map to the ramp; the columns from `FOCUS` on
    stops: NDArray[np.float64]  # (stops, 5): colours, not premultiplied, and `OFFSET`


FOCUS, RADIUS, SPREAD, FIRST, COUNT = range(6, 11)
"""Columns of a gradient: focal point and radius, -1 if it is linear; spread; first stop; number of stops."""

OFFSET = 4
"""Column of a stop; the others are its colour and opacity."""


def shades_of(gradients: Sequence[Gradient]) -> Shades:
    """Make the arrays of gradients."""
    rows: list[list[float]] = []
    stops: list[tuple[float, ...]] = []
    for one in gradients:
        focus = one.focus or (-1.0, -1.0)
        rows.append([*one.to_ramp[0], *one.to_ramp[1], *focus, one.spread, len(stops), len(one.stops)])
        stops += [(*stop.color, stop.opacity, stop.offset) for stop in one.stops]
    return Shades(np.array(rows, np.float64).reshape(-1, 11), np.array(stops, np.float64).reshape(-1, 5))


def gradient_of(shades: Shades, number: int) -> Gradient:
    """Gradient with a number."""
    row = shades.rows[number].tolist()
    first, count = int(row[FIRST]), int(row[COUNT])
    stops = [Stop(t, (r, g, b), a) for r, g, b, a, t in shades.stops[first : first + count].tolist()]
    focus = None if row[FOCUS] < 0.0 else (row[FOCUS], row[RADIUS])
    return Gradient((tuple(row[:3]), tuple(row[3:6])), tuple(stops), Spread(int(row[SPREAD])), focus)


@kernel(allocates=False)
def _ramp_place(focus: float, radius: float, x: float, y: float) -> float:
    """Greatest t whose circle goes through a point and has a radius of at least 0; NaN if there is none.

    With q from the focal point to the point: |q - t c|^2 = (fr + t dr)^2, where c = (-fx, 0) and dr = 1 - fr.
    """
    q, grows = x - focus, 1.0 - radius
    a = focus * focus - grows * grows
    b = radius * grows - q * focus
    c = q * q + y * y - radius * radius
    inside = b * b - a * c
    if inside < 0.0:
        return np.nan
    far = b + np.copysign(np.sqrt(inside), b)  # the roots are far / a and c / far, without cancellation
    first = far / a if a != 0.0 else -np.inf
    second = c / far if far != 0.0 else -np.inf
    for t in (max(first, second), min(first, second)):
        if abs(t) < np.inf and radius + t * grows >= 0.0:
            return t
    return np.nan


@kernel(allocates=False)
def _spread(spread: int, t: float) -> float:
    """Place on the ramp from 0 to 1; unchanged if padded, because the first and last colours continue."""
    if spread == REPEAT:
        return t - np.floor(t)
    if spread == REFLECT:
        return 1.0 - abs(1.0 - t % 2.0)
    return t


@kernel(allocates=False)
def flat_shade(shades: Shades, number: int, out: NDArray[np.float64]) -> bool:
    """Write the premultiplied colour (4,) of a gradient and return True, if it has one colour everywhere."""
    row = shades.rows[number]
    if row[COUNT] != 1.0 or row[FOCUS] + row[RADIUS] >= 1.0:
        return False
    stop = shades.stops[int(row[FIRST])]
    for c in range(3):
        out[c] = stop[c] * stop[3]
    out[3] = stop[3]
    return True


@kernel(allocates=False)
def shade_at(shades: Shades, number: int, x: float, y: float, out: NDArray[np.float64]) -> None:
    """Write the premultiplied colour (4,) of a gradient at a point of the unit square."""
    row, stops = shades.rows[number], shades.stops
    t = row[0] * x + row[1] * y + row[2]
    if row[FOCUS] >= 0.0:
        t = _ramp_place(row[FOCUS], row[RADIUS], t, row[3] * x + row[4] * y + row[5])
    for c in range(4):
        out[c] = 0.0
    if np.isnan(t):
        return
    t = _spread(int(row[SPREAD]), t)
    first = int(row[FIRST])
    last = first + int(row[COUNT]) - 1
    k = first
    while k <= last and stops[k, OFFSET] <= t:
        k += 1
    low, high = max(k - 1, first), min(k, last)
    way = stops[high, OFFSET] - stops[low, OFFSET]
    share = (t - stops[low, OFFSET]) / way if low < high else 0.0
    for c in range(4):
        out[c] = stops[low, c] + share * (stops[high, c] - stops[low, c])
    for c in range(3):
        out[c] *= out[3]
