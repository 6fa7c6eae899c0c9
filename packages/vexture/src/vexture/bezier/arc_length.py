"""Lengths along a path of cubics, and the parts of a path between two lengths."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.roots import velocity_at
from vexture.bezier.split import copy_curve, subcubic

NODES: Final = (0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363)
WEIGHTS: Final = (0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763)
"""Positive nodes of Gauss and Legendre for eight points between -1 and 1, and their weights."""

ACCURACY: Final = 1e-9
"""Largest error of a piece's length, as a share of the length of the cubic's control polygon."""

FINEST: Final = 2.0**-24
"""Parameter. Shorter pieces are not halved, not even at a cusp."""

STEPS: Final = 60
"""Most steps that find the place at a length."""


class ArcLengths(NamedTuple):
    """Pieces of a path whose lengths are known, in their order; `number` of them."""

    owner: NDArray[np.int64]  # (room,): cubic of each piece
    span: NDArray[np.float64]  # (room, 2): its parameters
    end: NDArray[np.float64]  # (room,): length of the path up to its end
    number: NDArray[np.int64]  # (1,)


@kernel(allocates=False)
def _piece_length(curve: NDArray[np.float64], t0: float, t1: float) -> float:
    """Length of a cubic from t0 to t1, by quadrature."""
    half, middle, total = 0.5 * (t1 - t0), 0.5 * (t0 + t1), 0.0
    for k in range(4):
        for t in (middle - half * NODES[k], middle + half * NODES[k]):
            vx = velocity_at(curve[0, 0], curve[1, 0], curve[2, 0], curve[3, 0], t)
            vy = velocity_at(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], t)
            total += WEIGHTS[k] * np.sqrt(vx * vx + vy * vy)
    return total * half


@kernel
def _append_piece(lengths: ArcLengths, owner: int, t0: float, t1: float, length: float) -> ArcLengths:
    """Add a piece."""
    count = lengths.number[0]
    if count == len(lengths.owner):
        more = ArcLengths(
            np.empty(2 * count + 4, np.int64), np.empty((2 * count + 4, 2)), np.empty(2 * count + 4), lengths.number
        )
        for i in range(count):
            more.owner[i], more.end[i] = lengths.owner[i], lengths.end[i]
            more.span[i, 0], more.span[i, 1] = lengths.span[i, 0], lengths.span[i, 1]
        lengths = more
    lengths.owner[count], lengths.span[count, 0], lengths.span[count, 1] = owner, t0, t1
    lengths.end[count] = (lengths.end[count - 1] if count > 0 else 0.0) + length
    lengths.number[0] = count + 1
    return lengths


@kernel
def measure_path(cubics: NDArray[np.float64]) -> ArcLengths:
    """Measure a path (n, 4, 2); its cubics are halved until the halves have the length of the whole."""
    n = len(cubics)
    lengths = ArcLengths(np.empty(2 * n, np.int64), np.empty((2 * n, 2)), np.empty(2 * n), np.zeros(1, np.int64))
    for i in range(n):
        polygon = 0.0
        for k in range(3):
            dx, dy = cubics[i, k + 1, 0] - cubics[i, k, 0], cubics[i, k + 1, 1] - cubics[i, k, 1]
            polygon += np.sqrt(dx * dx + dy * dy)
        t, step = 0.0, 1.0
        while t < 1.0 and polygon > 0.0:
            whole = _piece_length(cubics[i], t, t + step)
            halves = _piece_length(cubics[i], t, t + 0.5 * step) + _piece_length(cubics[i], t + 0.5 * step, t + step)
            if abs(halves - whole) > ACCURACY * polygon and step > FINEST:
                step *= 0.5
                continue
            lengths = _append_piece(lengths, i, t, t + step, halves)
            t += step
            while t < 1.0 and t / (2.0 * step) == np.floor(t / (2.0 * step)):
                step *= 2.0
    return lengths


@kernel(ahead=True)
def path_length(cubics: NDArray[np.float64]) -> float:
    """Length of consecutive cubics (n, 4, 2).

    Examples
    --------
    >>> import numpy as np
    >>> from vexture.bezier.convert import line_cubics
    >>> round(path_length(line_cubics(np.array([[0.0, 0.0]]), np.array([[3.0, 4.0]]))), 9)
    5.0
    """
    return total_length(measure_path(cubics))


@kernel(allocates=False)
def total_length(lengths: ArcLengths) -> float:
    """Length of a path that was measured."""
    return lengths.end[lengths.number[0] - 1] if lengths.number[0] > 0 else 0.0


@kernel(allocates=False)
def find_place(cubics: NDArray[np.float64], lengths: ArcLengths, length: float) -> tuple[int, float]:
    """Cubic and parameter at a length from the start of a path, which is not empty."""
    low, high = 0, lengths.number[0] - 1
    while low < high:
        middle = (low + high) // 2
        if lengths.end[middle] < length:
            low = middle + 1
        else:
            high = middle
    owner, t0, t1 = lengths.owner[low], lengths.span[low, 0], lengths.span[low, 1]
    before = lengths.end[low - 1] if low > 0 else 0.0
    whole, wanted = lengths.end[low] - before, length - before
    if wanted >= whole or whole <= 0.0:
        return owner, t1
    if wanted <= 0.0:
        return owner, t0
    curve, first, last = cubics[owner], t0, t1
    t = t0 + (t1 - t0) * (wanted / whole)
    for _ in range(STEPS):
        off = _piece_length(curve, first, t) - wanted
        if off > 0.0:
            t1 = t
        else:
            t0 = t
        vx = velocity_at(curve[0, 0], curve[1, 0], curve[2, 0], curve[3, 0], t)
        vy = velocity_at(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], t)
        speed = np.sqrt(vx * vx + vy * vy)
        step = t - off / speed if speed > 0.0 else -1.0
        if not t0 < step < t1:
            step = 0.5 * (t0 + t1)
        if abs(step - t) <= 1e-14 * (last - first):
            return owner, step
        t = step
    return owner, t


@kernel
def cut_between(cubics: NDArray[np.float64], first: int, t0: float, last: int, t1: float) -> NDArray[np.float64]:
    """Cubics (m, 4, 2) of a path from t0 of one cubic to t1 of the same or a later one."""
    out = np.empty((last - first + 1, 4, 2))
    for i in range(first, last + 1):
        low, high = (t0 if i == first else 0.0), (t1 if i == last else 1.0)
        if low == 0.0 and high == 1.0:
            copy_curve(cubics[i], out[i - first])
        else:
            subcubic(cubics[i], low, high, out[i - first])
        if i > first:
            out[i - first, 0, 0], out[i - first, 0, 1] = out[i - first - 1, 3, 0], out[i - first - 1, 3, 1]
    return out
