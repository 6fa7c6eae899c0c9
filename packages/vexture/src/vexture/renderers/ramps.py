"""Gradients in an image, for the exact renderer: the colour at a point, and the corners of a ramp along a line.

The formulas are those of SVG 2, 14.2. A radial gradient's circle at t has the centre (x u, 0) and the radius 1 - g u,
where u = 1 - t, x is the focal point and g = 1 - the focal radius. A point (X, Y) is on it if

    (x x - g g) u u + 2 (g - x X) u + X X + Y Y - 1 = 0.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.drawing.paint import Gradient, Spread

MOST_CUTS: Final = 1024
"""Most corners of ramps on one line; the others are ignored."""

MOST_PERIODS: Final = 64
"""Most periods of a ramp that are cut on one line."""

FARTHEST: Final = 2.0**52
"""Position in periods beyond which a float64 has no fraction."""

Place = tuple[float, float]
"""A point of the image."""

Point = tuple[float, float, float]
"""A point in a ramp's homogeneous coordinates."""


class Ramps(NamedTuple):
    """The gradients of a drawing."""

    maps: NDArray[np.float64]  # (n, 3, 3): from homogeneous pixel coordinates to the ramp's
    radial: NDArray[np.bool_]  # (n,)
    foci: NDArray[np.float64]  # (n, 2): x and g
    spreads: NDArray[np.int64]  # (n,)
    ends: NDArray[np.int64]  # (n + 1,): ramp k has the stops from ends[k] to ends[k + 1]
    stops: NDArray[np.float64]  # (m, 5): offset, colour and opacity

    @classmethod
    def of_gradients(cls, gradients: list[Gradient], view: NDArray[np.float64]) -> "Ramps":
        """Arrays of gradients; `view` is the (3, 3) matrix from pixel coordinates to the unit square."""
        maps = [np.array([*gradient.to_ramp, (0.0, 0.0, 1.0)]) @ view for gradient in gradients]
        foci = [gradient.focus or (0.0, 0.0) for gradient in gradients]
        stops = [(s.offset, *s.color, s.opacity) for gradient in gradients for s in gradient.stops]
        return cls(
            np.array(maps).reshape(-1, 3, 3),
            np.array([gradient.focus is not None for gradient in gradients], np.bool_),
            np.array([(x, 1.0 - radius) for x, radius in foci]).reshape(-1, 2),
            np.array([gradient.spread for gradient in gradients], np.int64),
            np.cumsum([0, *(len(gradient.stops) for gradient in gradients)]),
            np.array(stops).reshape(-1, 5),
        )


@kernel(allocates=False)
def shade(ramps: Ramps, k: int, x: float, y: float, colour: NDArray[np.float64]) -> None:
    """Write the premultiplied colour of a ramp at a point of the image."""
    X, Y, W = ramp_point(ramps.maps[k], x, y)
    t = X / W
    if ramps.radial[k]:
        t = circle_through(X / W, Y / W, ramps.foci[k, 0], ramps.foci[k, 1])
    if np.isnan(t):
        colour[:] = 0.0
        return
    spread = ramps.spreads[k]
    if spread == Spread.REPEAT:
        t -= np.floor(t)
    elif spread == Spread.REFLECT:
        t = abs(t - 2.0 * np.floor(0.5 * t + 0.5))
    stops = ramps.stops[ramps.ends[k] : ramps.ends[k + 1]]
    after = 0
    while after < len(stops) and stops[after, 0] <= t:
        after += 1
    low, high = max(after - 1, 0), min(after, len(stops) - 1)
    part = (t - stops[low, 0]) / (stops[high, 0] - stops[low, 0]) if high > low and after > 0 else 0.0
    opacity = stops[low, 4] + part * (stops[high, 4] - stops[low, 4])
    for channel in range(3):
        straight = stops[low, channel + 1]
        colour[channel] = opacity * (straight + part * (stops[high, channel + 1] - straight))
    colour[3] = opacity


@kernel(allocates=False)
def ramp_point(matrix: NDArray[np.float64], x: float, y: float) -> Point:
    """Map a point of the image to homogeneous coordinates of a ramp."""
    return (
        matrix[0, 0] * x + matrix[0, 1] * y + matrix[0, 2],
        matrix[1, 0] * x + matrix[1, 1] * y + matrix[1, 2],
        matrix[2, 0] * x + matrix[2, 1] * y + matrix[2, 2],
    )


@kernel(allocates=False)
def circle_through(X: float, Y: float, x: float, g: float) -> float:
    """Largest t whose circle passes through a point and has no negative radius; NaN if there is none."""
    a, b, c = x * x - g * g, g - x * X, X * X + Y * Y - 1.0
    if a > 0.0 and b * b < a * c:  # outside the cone of the circles
        return np.nan
    one, other = roots(a, b, c)
    low, high = min(one, other), max(one, other)
    if np.isfinite(low) and g * low <= 1.0:
        return 1.0 - low
    return 1.0 - high if np.isfinite(high) and g * high <= 1.0 else np.nan


@kernel(allocates=False)
def roots(a: float, b: float, c: float) -> tuple[float, float]:
    """Roots of a s s + 2 b s + c; infinite if there are fewer; without real roots, twice the vertex."""
    q = -(b + np.copysign(np.sqrt(max(b * b - a * c, 0.0)), b))
    if q == 0.0:
        return (0.0, 0.0) if a != 0.0 else (np.inf, np.inf)
    return (q / a if a != 0.0 else np.inf), c / q


@kernel(allocates=False)
def cut_line(ramps: Ramps, k: int, start: Place, end: Place, cuts: NDArray[np.float64], count: int) -> int:
    """Cut a line in the image at the corners and jumps of a ramp's colour; return the new count of cuts.

    Cuts are parts, in 0..1, of the line from `start` to `end`. If the line misses the circle of a corner, its point
    nearest to the circle is a cut.
    """
    p, q = ramp_point(ramps.maps[k], start[0], start[1]), ramp_point(ramps.maps[k], end[0], end[1])
    d = q[0] - p[0], q[1] - p[1], q[2] - p[2]
    x, g = ramps.foci[k]
    first, last = periods(ramps, k, p, q)
    for period in range(first, last + 1):
        for j in range(ramps.ends[k + 1] - ramps.ends[k] + 1):
            t = corner(ramps, k, period, j)
            if ramps.radial[k]:
                u = 1.0 - t
                e, f = p[0] - x * u * p[2], d[0] - x * u * d[2]
                radius, change = (1.0 - g * u) * p[2], (1.0 - g * u) * d[2]
                s = roots(
                    f * f + d[1] * d[1] - change * change,
                    e * f + p[1] * d[1] - radius * change,
                    e * e + p[1] * p[1] - radius * radius,
                )
                count = add_cut(s[1], cuts, add_cut(s[0], cuts, count))
            else:
                count = add_cut((t * p[2] - p[0]) / (d[0] - t * d[2]), cuts, count)
    a = x * x - g * g
    if ramps.radial[k] and a >= 0.0:  # the sides of the cone, where the equation has a double root
        b, change = g * p[2] - x * p[0], g * d[2] - x * d[0]
        s = roots(
            change * change - a * (d[0] * d[0] + d[1] * d[1] - d[2] * d[2]),
            b * change - a * (p[0] * d[0] + p[1] * d[1] - p[2] * d[2]),
            b * b - a * (p[0] * p[0] + p[1] * p[1] - p[2] * p[2]),
        )
        count = add_cut(s[1], cuts, add_cut(s[0], cuts, count))
    return count


@kernel(allocates=False)
def cut_turns(ramps: Ramps, k: int, start: Place, end: Place, cuts: NDArray[np.float64], count: int) -> int:
    """Cut the interval from the y of `start` to that of `end` where a horizontal line touches a circle of a ramp.

    A line l of the ramp's plane touches a circle of centre c and radius r if (l . c)^2 = r r (l0 l0 + l1 l1). The
    horizontal line at y is, in the ramp's plane, one - y other. The circles are those of the corners near the line from
    `start` to `end`.
    """
    m = ramps.maps[k]
    one, other = cross_columns(m, 2, 0), cross_columns(m, 0, 1)
    x, g = ramps.foci[k]
    first, last = periods(ramps, k, ramp_point(m, start[0], start[1]), ramp_point(m, end[0], end[1]))
    for period in range(first, last + 1):
        for j in range(ramps.ends[k + 1] - ramps.ends[k] + 1):
            u = 1.0 - corner(ramps, k, period, j)
            radius = 1.0 - g * u
            e, f = one[0] * x * u + one[2], other[0] * x * u + other[2]
            y = roots(
                f * f - radius * radius * (other[0] * other[0] + other[1] * other[1]),
                radius * radius * (one[0] * other[0] + one[1] * other[1]) - e * f,
                e * e - radius * radius * (one[0] * one[0] + one[1] * one[1]),
            )
            for k_root in range(2):
                count = add_cut((y[k_root] - start[1]) / (end[1] - start[1]), cuts, count)
    return count


@kernel(allocates=False)
def cross_columns(m: NDArray[np.float64], i: int, j: int) -> Point:
    """Cross product of two columns of a matrix."""
    return (
        m[1, i] * m[2, j] - m[2, i] * m[1, j],
        m[2, i] * m[0, j] - m[0, i] * m[2, j],
        m[0, i] * m[1, j] - m[1, i] * m[0, j],
    )


@kernel(allocates=False)
def corner(ramps: Ramps, k: int, period: int, j: int) -> float:
    """Position on a ramp of stop j in a period; after the last stop, of the start of the period."""
    place = ramps.ends[k] + j
    offset = ramps.stops[place, 0] if place < ramps.ends[k + 1] else 0.0
    backwards = ramps.spreads[k] == Spread.REFLECT and period % 2 != 0
    return period + (1.0 - offset if backwards else offset)


@kernel(allocates=False)
def periods(ramps: Ramps, k: int, p: Point, q: Point) -> tuple[int, int]:
    """First and last period of a ramp on a line from p to q in the ramp's coordinates; 0 and 0 without repetition.

    If every point has a colour, t changes by at most the length of the line over |g| - x. There are at most
    `MOST_PERIODS` periods, and that many in a cone, where t may change faster.
    """
    if ramps.spreads[k] == Spread.PAD:
        return 0, 0
    x, g = ramps.foci[k]
    ax, ay, bx, by = p[0] / p[2], p[1] / p[2], q[0] / q[2], q[1] / q[2]
    middle, reach = 0.5 * (ax + bx), 0.5 * abs(bx - ax)
    if ramps.radial[k]:
        middle = circle_through(middle, 0.5 * (ay + by), x, g)
        reach = 0.5 * np.hypot(bx - ax, by - ay) / max(abs(g) - x, 0.0)
    if np.isnan(middle):
        middle = 0.0
    reach = min(reach, 0.5 * MOST_PERIODS)
    return (int(np.floor(middle - reach)), int(np.floor(middle + reach))) if abs(middle) < FARTHEST else (0, -1)


@kernel(allocates=False)
def add_cut(part: float, cuts: NDArray[np.float64], count: int) -> int:
    """Insert a part of a line into the sorted cuts if it is new and between the ends; return the new count."""
    place = count
    while place > 0 and cuts[place - 1] > part:
        place -= 1
    if not 0.0 < part < 1.0 or count == len(cuts) or (place > 0 and cuts[place - 1] == part):
        return count
    for k in range(count, place, -1):
        cuts[k] = cuts[k - 1]
    cuts[place] = part
    return count + 1
