"""The colour of a gradient at a point, as SVG 2 defines it (14.2)."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.kernels import kernel
from vexture.paint import Gradient, Spread

__all__ = ["Shades", "shade_at", "shades_of"]

REFLECT, REPEAT = int(Spread.REFLECT), int(Spread.REPEAT)


class Shades(NamedTuple):
    """Gradients, a row for each; `first` has one row more."""

    to_ramp: NDArray[np.float64]  # (n, 6): both rows of the map
    focus: NDArray[np.float64]  # (n, 2): x of the focal point and focal radius; -1 of linear ones
    spread: NDArray[np.int64]
    first: NDArray[np.int64]  # first stop of each
    offset: NDArray[np.float64]  # (stops,)
    straight: NDArray[np.float64]  # (stops, 4): colours, not premultiplied


def shades_of(gradients: Sequence[Gradient]) -> Shades:
    """The arrays of some gradients."""
    stops = [stop for gradient in gradients for stop in gradient.stops]
    return Shades(
        np.array([[*one.to_ramp[0], *one.to_ramp[1]] for one in gradients], np.float64).reshape(-1, 6),
        np.array([one.focus or (-1.0, -1.0) for one in gradients], np.float64).reshape(-1, 2),
        np.array([int(one.spread) for one in gradients], np.int64),
        np.cumsum([0, *(len(one.stops) for one in gradients)], dtype=np.int64),
        np.array([stop.offset for stop in stops], np.float64),
        np.array([(*stop.color, stop.opacity) for stop in stops], np.float64).reshape(-1, 4),
    )


@kernel(allocates=False)
def _ramp_place(focus: float, radius: float, x: float, y: float) -> float:
    """The greatest t whose circle goes through a point and has a radius; NaN if there is none.

    With q from the focal point to the point: |q - t c|^2 = (fr + t dr)^2, of c = (-fx, 0) and dr = 1 - fr.
    """
    q, grows = x - focus, 1.0 - radius
    a = focus * focus - grows * grows
    b = radius * grows - q * focus
    c = q * q + y * y - radius * radius
    inside = b * b - a * c
    if inside < 0.0:
        return np.nan
    far = b + np.copysign(np.sqrt(inside), b)  # the roots are far / a and c / far: neither is a small difference
    first = far / a if a != 0.0 else -np.inf
    second = c / far if far != 0.0 else -np.inf
    for t in (max(first, second), min(first, second)):
        if abs(t) < np.inf and radius + t * grows >= 0.0:
            return t
    return np.nan


@kernel(allocates=False)
def _spread(spread: int, t: float) -> float:
    """The place on the ramp itself, 0..1."""
    if spread == REPEAT:
        return t - np.floor(t)
    if spread == REFLECT:
        return 1.0 - abs(1.0 - t % 2.0)
    return min(max(t, 0.0), 1.0)


@kernel(allocates=False)
def shade_at(shades: Shades, number: int, x: float, y: float, out: NDArray[np.float64]) -> None:
    """Write the premultiplied colour (4,) of a gradient at a point of the unit square."""
    row, focus = shades.to_ramp[number], shades.focus[number]
    t = row[0] * x + row[1] * y + row[2]
    if focus[0] >= 0.0:
        t = _ramp_place(focus[0], focus[1], t, row[3] * x + row[4] * y + row[5])
    for c in range(4):
        out[c] = 0.0
    if np.isnan(t):
        return
    t = _spread(shades.spread[number], t)
    first, last = shades.first[number], shades.first[number + 1] - 1
    k = first
    while k <= last and shades.offset[k] <= t:
        k += 1
    low, high = max(k - 1, first), min(k, last)
    way = shades.offset[high] - shades.offset[low]
    share = (t - shades.offset[low]) / way if low < high else 0.0
    for c in range(4):
        out[c] = shades.straight[low, c] + share * (shades.straight[high, c] - shades.straight[low, c])
    for c in range(3):
        out[c] *= out[3]
