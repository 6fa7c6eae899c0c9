"""Cubics that follow each other, in an array that grows: what outlines of strokes are made of."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.split import copy_curve


class CubicChain(NamedTuple):
    """Cubics that follow each other, in an array with room for more."""

    cubics: NDArray[np.float64]  # (room, 4, 2)
    length: NDArray[np.int64]  # (1,): number of cubics


@kernel
def empty_chain(room: int) -> CubicChain:
    """CubicChain without cubics."""
    return CubicChain(np.empty((room, 4, 2)), np.zeros(1, np.int64))


@kernel
def append_cubic(chain: CubicChain, curve: NDArray[np.float64]) -> CubicChain:
    """Add a cubic (4, 2)."""
    count = chain.length[0]
    if count == len(chain.cubics):
        more = np.empty((2 * count + 4, 4, 2))
        for i in range(count):
            copy_curve(chain.cubics[i], more[i])
        chain = CubicChain(more, chain.length)
    copy_curve(curve, chain.cubics[count])
    chain.length[0] = count + 1
    return chain


@kernel
def append_line(chain: CubicChain, x0: float, y0: float, x1: float, y1: float) -> CubicChain:
    """Add the straight line between two points, unless they are the same."""
    if x0 == x1 and y0 == y1:
        return chain
    curve = np.empty((4, 2))
    curve[0, 0], curve[0, 1], curve[3, 0], curve[3, 1] = x0, y0, x1, y1
    for axis in range(2):
        chord = curve[3, axis] - curve[0, axis]
        curve[1, axis] = curve[0, axis] + chord / 3.0
        curve[2, axis] = curve[0, axis] + chord * (2.0 / 3.0)
    return append_cubic(chain, curve)


@kernel
def append_reversed(chain: CubicChain, other: CubicChain) -> CubicChain:
    """Add the cubics of a chain backwards."""
    curve = np.empty((4, 2))
    for i in range(other.length[0] - 1, -1, -1):
        for k in range(4):
            curve[k, 0], curve[k, 1] = other.cubics[i, 3 - k, 0], other.cubics[i, 3 - k, 1]
        chain = append_cubic(chain, curve)
    return chain


@kernel
def close_chain(chain: CubicChain, shortest: float) -> NDArray[np.float64]:
    """Contour (n, 4, 2) of a chain, closed bit for bit, without cubics that move by less than `shortest`."""
    out, count = np.empty((chain.length[0], 4, 2)), 0
    for i in range(chain.length[0]):
        curve, far = chain.cubics[i], 0.0
        start = out[count - 1, 3] if count > 0 else curve[0]
        for k in range(4):
            far = max(far, max(abs(curve[k, 0] - start[0]), abs(curve[k, 1] - start[1])))
        if far >= shortest:
            copy_curve(curve, out[count])
            count += 1
    for i in range(count):
        before = i - 1 if i else count - 1
        out[i, 0, 0], out[i, 0, 1] = out[before, 3, 0], out[before, 3, 1]
    return out[:count]


@kernel(allocates=False)
def unit(x: float, y: float) -> tuple[float, float]:
    """Vector of length 1 in a direction; zero if it has none."""
    scale = max(abs(x), abs(y))
    if not scale > 0.0:
        return 0.0, 0.0
    x, y = x / scale, y / scale
    length = np.sqrt(x * x + y * y)
    return x / length, y / length
