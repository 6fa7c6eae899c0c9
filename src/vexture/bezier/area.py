"""Areas beside cubics, exact."""

import numpy as np
from numpy.typing import NDArray

from vexture.kernels import kernel

__all__ = ["area_right_of", "edge_index", "integral_x_dy"]


@kernel
def integral_x_dy(curve: NDArray[np.float64]) -> float:
    """Integral of x dy along a cubic, (4, 2): the signed area between it and the y axis.

    The polynomial of degree five is integrated in closed form (Manson and Schaefer, "Wavelet Rasterization",
    Eurographics 2011).

    Examples
    --------
    >>> integral_x_dy(np.array([[1.0, 0.0], [1.0, 1.0], [1.0, 2.0], [1.0, 3.0]]))
    3.0
    """
    x0, x1, x2, x3 = curve[0, 0], curve[1, 0], curve[2, 0], curve[3, 0]
    y0, y1, y2, y3 = curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1]
    return (
        x0 * (-10.0 * y0 + 6.0 * y1 + 3.0 * y2 + y3)
        + x1 * (-6.0 * y0 + 3.0 * y2 + 3.0 * y3)
        + x2 * (-3.0 * y0 - 3.0 * y1 + 6.0 * y3)
        + x3 * (-y0 - 3.0 * y1 - 6.0 * y2 + 10.0 * y3)
    ) / 20.0


@kernel
def edge_index(x: float, y: float) -> float:
    """Place of a point on the edge of the unit square: distance clockwise from its top-left corner, over 4.

    Thesis, Table 4.1. A point beside the edge counts as the nearest point on it.

    Examples
    --------
    >>> edge_index(0.5, 1.0), edge_index(1.0, 0.5), edge_index(0.5, 0.0), edge_index(0.0, 0.5)
    (0.125, 0.375, 0.625, 0.875)
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
def area_right_of(p0: NDArray[np.float64], p3: NDArray[np.float64], x_dy: float) -> float:
    """Area of the part of the unit square on the right of a curve from edge to edge.

    The loop of the curve and of the square's edge, clockwise from P3 back to P0, has that part on its right. On
    the edge x dy is not zero on the right side only.

    Parameters
    ----------
    p0, p3 : (2,) float64 arrays
        Where the curve starts and ends, on the square's edge.
    x_dy : float
        Integral of x dy along it.

    Examples
    --------
    >>> area_right_of(np.array([0.0, 0.5]), np.array([1.0, 0.5]), 0.0)
    0.5
    """
    start, stop = edge_index(p3[0], p3[1]), edge_index(p0[0], p0[1])
    if stop <= start:
        stop += 1.0
    on_right_side = max(min(stop, 0.5) - max(start, 0.25), 0.0) + max(min(stop, 1.5) - max(start, 1.25), 0.0)
    return 4.0 * on_right_side - x_dy
