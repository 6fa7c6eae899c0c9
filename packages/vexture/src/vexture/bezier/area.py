"""Exact areas beside cubics."""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.split import subcubic


@kernel(allocates=False)
def integral_x_dy(curve: NDArray[np.float64]) -> float:
    """Integral of x dy along a cubic, (4, 2): the signed area between it and the y axis.

    This is the closed form of the integral of a polynomial of degree five (Manson and Schaefer, "Wavelet
    Rasterization", Eurographics 2011).
    """
    x0, x1, x2, x3 = curve[0, 0], curve[1, 0], curve[2, 0], curve[3, 0]
    y0, y1, y2, y3 = curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1]
    integral: float = (
        x0 * (-10.0 * y0 + 6.0 * y1 + 3.0 * y2 + y3)
        + x1 * (-6.0 * y0 + 3.0 * y2 + 3.0 * y3)
        + x2 * (-3.0 * y0 - 3.0 * y1 + 6.0 * y3)
        + x3 * (-y0 - 3.0 * y1 - 6.0 * y2 + 10.0 * y3)
    ) / 20.0
    return integral


@kernel(allocates=False)
def edge_index(x: float, y: float) -> float:
    """Position of a point on the edge of the unit square, 0..1, clockwise from the top-left corner (thesis, Table 4.1).

    For a point off the edge, this is the position of the nearest point on it.
    """
    top, right, bottom, left = 1.0 - y, 1.0 - x, y, x
    nearest = min(top, right, bottom, left)
    if nearest == top:
        return 0.25 * x
    if nearest == right:
        return 0.25 * (2.0 - y)
    if nearest == bottom:
        return 0.25 * (3.0 - x)
    return 0.25 * (3.0 + y)


@kernel
def edge_indices(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute `edge_index` of points (n, 2); (n,)."""
    indices = np.empty(len(points))
    for i in range(len(points)):
        indices[i] = edge_index(points[i, 0], points[i, 1])
    return indices


@kernel(allocates=False)
def area_right_of(p0: NDArray[np.float64], p3: NDArray[np.float64], x_dy: float) -> float:
    """Area of the part of the unit square on the right of a curve from edge to edge; `x_dy` is its integral of x dy.

    The curve from `p0` to `p3` and the square's edge, clockwise from `p3` back to `p0`, form a loop around that part.
    On the edge, x dy differs from zero only on the right side.
    """
    start, stop = edge_index(p3[0], p3[1]), edge_index(p0[0], p0[1])
    if stop <= start:
        stop += 1.0
    on_right_side = max(min(stop, 0.5) - max(start, 0.25), 0.0) + max(min(stop, 1.5) - max(start, 1.25), 0.0)
    return 4.0 * on_right_side - x_dy


@kernel
def loop_area(curve: NDArray[np.float64]) -> float:
    """Area of the loop of a cubic (4, 2) that crosses itself: positive if counter-clockwise, 0 without a loop.

    With B(t) = a t^3 + b t^2 + c t + d, two parameters s and t meet where a (s^2 + s t + t^2) + b (s + t) + c = 0. The
    cross product with a leaves one linear equation in s + t, after which s t follows.
    """
    bx = 3.0 * (curve[0, 0] - 2.0 * curve[1, 0] + curve[2, 0])
    by = 3.0 * (curve[0, 1] - 2.0 * curve[1, 1] + curve[2, 1])
    cx, cy = 3.0 * (curve[1, 0] - curve[0, 0]), 3.0 * (curve[1, 1] - curve[0, 1])
    ax, ay = curve[3, 0] - curve[0, 0] - cx - bx, curve[3, 1] - curve[0, 1] - cy - by
    square = ax * ax + ay * ay
    cross = ax * by - ay * bx
    if cross == 0.0:
        return 0.0
    total = -(ax * cy - ay * cx) / cross
    product = total * total + (total * (ax * bx + ay * by) + ax * cx + ay * cy) / square
    discriminant = total * total - 4.0 * product
    if not discriminant > 0.0:
        return 0.0
    root = np.sqrt(discriminant)
    t0, t1 = 0.5 * (total - root), 0.5 * (total + root)
    if t0 < 0.0 or t1 > 1.0:
        return 0.0
    loop = np.empty((4, 2))
    subcubic(curve, t0, t1, loop)
    return integral_x_dy(loop)


@kernel
def leaf_area(curve: NDArray[np.float64], corner: bool) -> float:
    """Area of the filled part of the unit square, 0..1, on the right of a curve or corner from edge to edge.

    `curve` (4, 2) is a cubic, or with `corner` the straight lines P0 P1 and P1 P3. The even-odd rule applies, as in the
    shader: the loop of a curve that crosses itself changes sides. Inside the loop, the winding number is off by two, so
    that twice the loop's area is added.
    """
    if corner:
        x0, x1, x3 = curve[0, 0], curve[1, 0], curve[3, 0]
        y0, y1, y3 = curve[0, 1], curve[1, 1], curve[3, 1]
        area = area_right_of(curve[0], curve[3], 0.5 * ((x0 + x1) * (y1 - y0) + (x1 + x3) * (y3 - y1)))
    else:
        area = area_right_of(curve[0], curve[3], integral_x_dy(curve)) + 2.0 * loop_area(curve)
    # outside 0..1 the whole curve is a loop: its ends cross, or miss each other by rounding
    return max(1.0 - abs(1.0 - abs(area)), 0.0)
