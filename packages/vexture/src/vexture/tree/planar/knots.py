"""Knots of a ramp: the places where its colour may bend or jump, including those of its repetitions."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.drawing.paint import Spread
from vexture.tree.planar.shades import OFFSET

PAD, REFLECT = int(Spread.PAD), int(Spread.REFLECT)


class Knots(NamedTuple):
    """Places on an unrolled ramp, in order; at each, the stops that end the part before it and begin the part after."""

    place: NDArray[np.float64]
    before: NDArray[np.int64]  # numbers of stops
    after: NDArray[np.int64]


@kernel
def stops_of_period(stops: NDArray[np.float64], spread: int) -> NDArray[np.float64]:
    """Stops of a ramp, or those of one period of a ramp that goes on, which reach from 0 to 1."""
    if spread == PAD:
        return stops
    count = len(stops)
    ramp = np.empty((count + 2, stops.shape[1]))
    for k in range(count + 2):
        for c in range(stops.shape[1]):
            ramp[k, c] = stops[min(max(k - 1, 0), count - 1), c]
    ramp[0, OFFSET], ramp[count + 1, OFFSET] = 0.0, 1.0
    return ramp


@kernel
def knots_of(ramp: NDArray[np.float64], spread: int, low: float, high: float) -> Knots:
    """Knots of a ramp with the stops `ramp` in an interval of places, and the next knot on each side."""
    first, last = (0, 0) if spread == PAD else (int(np.floor(low)), int(np.ceil(high)))
    count, room = 0, len(ramp) * (last - first + 1)
    knots = Knots(np.empty(room), np.empty(room, np.int64), np.empty(room, np.int64))
    for period in range(first, last + 1):
        for k in range(len(ramp)):
            is_turned = spread == REFLECT and period % 2 == 1
            stop = len(ramp) - 1 - k if is_turned else k
            place = period + 1.0 - ramp[stop, OFFSET] if is_turned else period + ramp[stop, OFFSET]
            if count > 0 and knots.place[count - 1] == place:
                knots.after[count - 1] = stop
                continue
            knots.place[count], knots.before[count], knots.after[count] = place, stop, stop
            count += 1
    begin, end = 0, count - 1
    for k in range(count):
        begin = k if knots.place[k] <= low else begin
    for k in range(count - 1, -1, -1):
        end = k if knots.place[k] >= high else end
    return Knots(knots.place[begin : end + 1], knots.before[begin : end + 1], knots.after[begin : end + 1])


@kernel(allocates=False)
def differ(stops: NDArray[np.float64], one: int, other: int) -> bool:
    """Whether two stops differ visibly."""
    equal = True
    for c in range(4):
        equal = equal and stops[one, c] == stops[other, c]
    return not equal and max(stops[one, 3], stops[other, 3]) > 0.0


@kernel(allocates=False)
def jumps(knots: Knots, ramp: NDArray[np.float64], k: int) -> bool:
    """Whether the colour jumps at a knot."""
    return differ(ramp, knots.before[k], knots.after[k])


@kernel(allocates=False)
def is_beside_ramp(knots: Knots, ramp: NDArray[np.float64], k: int, most: float) -> bool:
    """Whether the colour changes between a knot and the one before or after, less than `most` places away."""
    for one in range(max(k - 1, 0), min(k + 1, len(knots.place) - 1)):
        is_near = knots.place[one + 1] - knots.place[one] < most
        if is_near and differ(ramp, knots.after[one], knots.before[one + 1]):
            return True
    return False
