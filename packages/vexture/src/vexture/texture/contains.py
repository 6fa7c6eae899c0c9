"""Test whether points lie inside a shape of a packed texture, by its stored winding numbers."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vexture.base.errors import ParameterError
from vexture.base.kernels import kernel
from vexture.base.layout import (
    CELL_BITS,
    COUNT_SHIFT,
    COVERAGE_ONE,
    LATTICE,
    MOST_CURVES,
    MOST_DEPTH,
    QUAD_FLAG,
    WINDING_OFFSET,
)
from vexture.texture.curves import read_curve
from vexture.tree.crossings import x_at

BYTE = (1 << CELL_BITS) - 1


def checked_points(points: ArrayLike) -> NDArray[np.float64]:
    """Convert points to an array (n, 2); raise a `ParameterError` if they are no such array of numbers."""
    try:
        array = np.asarray(points, np.float64)
    except (TypeError, ValueError):
        raise ParameterError("`points` is no array of numbers; give (n, 2)") from None
    if array.ndim != 2 or array.shape[1] != 2:
        raise ParameterError(f"`points` has the shape {array.shape}; it must be (n, 2)")
    return array


@kernel
def _winding(
    flat: NDArray[np.uint32], first: int, count: int, corner: int, x: float, y: float, curve: NDArray[np.float64]
) -> int:
    """Winding number at a point of a leaf; `curve` is scratch."""
    winding = corner
    for i in range(first, min(first + count, len(flat))):
        read_curve(flat[i], curve)
        start, end = curve[0, 1], curve[3, 1]
        if curve[0, 0] == 0.0 and start <= y:
            winding += 1
        if curve[3, 0] == 0.0 and end <= y:
            winding -= 1
        if min(start, end) <= y < max(start, end):
            low, high = min(curve[0, 0], curve[3, 0]), max(curve[0, 0], curve[3, 0])
            if high <= x or (low <= x and x_at(curve, y) <= x):
                winding += -1 if end > start else 1
    return winding


@kernel
def _inside(flat: NDArray[np.uint32], root: int, x: float, y: float, curve: NDArray[np.float64]) -> bool:
    """Return whether a point of the unit square is inside; all arithmetic down to the leaf is exact."""
    quad = root
    for _ in range(MOST_DEPTH):
        if quad >= len(flat):
            return False
        right, upper = 1 if x >= 0.5 else 0, 1 if y >= 0.5 else 0
        x, y = 2.0 * x - right, 2.0 * y - upper
        quads, curves, cell = 0, 0, 0
        for k in range(right + 2 * upper + 1):
            quads += cell // QUAD_FLAG
            curves += cell >> COUNT_SHIFT & MOST_CURVES
            cell = int(flat[quad, 2]) >> CELL_BITS * k & BYTE
        if cell >= QUAD_FLAG:
            quad = int(flat[quad, 0]) + quads
            continue
        count = cell >> COUNT_SHIFT
        if count == 0:
            coverage = int(flat[quad, 3]) >> CELL_BITS * (right + 2 * upper) & BYTE
            return bool(2 * coverage > COVERAGE_ONE)
        corner = (cell & (1 << COUNT_SHIFT) - 1) - WINDING_OFFSET
        first = int(flat[quad, 1]) + curves
        return _winding(flat, first, count, corner, LATTICE * x, LATTICE * y, curve) > 0
    return False


@kernel
def points_inside(flat: NDArray[np.uint32], root: int, points: NDArray[np.float64], inside: NDArray[np.bool_]) -> None:
    """Write to `inside` (m,) whether points (m, 2), in unit-square units, are inside the shape with root quad `root`.

    Points outside 0 <= x < 1, 0 <= y < 1 are not inside. The texels need no validation: all indices are checked.
    """
    curve = np.empty((4, 2))
    for i in range(len(points)):
        x, y = points[i, 0], points[i, 1]
        inside[i] = 0.0 <= x < 1.0 and 0.0 <= y < 1.0 and _inside(flat, root, x, y, curve)
