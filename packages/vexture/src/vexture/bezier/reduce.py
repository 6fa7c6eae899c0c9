"""Reduce the cubics of a closed contour: one cubic replaces a run of monotone pieces if it follows them."""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.fit import MEASURED, chord_parameters, fit_cubic, project
from vexture.bezier.monotone import monotone_pieces
from vexture.bezier.roots import cubic_at
from vexture.bezier.split import copy_curve

PER_PIECE, MOST_SAMPLES = 8, 96
"""Points of a run that a fit uses: for each piece, and in all."""

LEAST_PER_PIECE = 4
"""Points of a piece that is longer than the tolerance: a short arc between long lines is seen, too."""

UNSEEN = 0.1
"""Share of the tolerance. A shorter step back does not end a run: strokers leave such steps at joins."""


@kernel(allocates=False)
def _turns_between(before: NDArray[np.float64], after: NDArray[np.float64], unseen: float) -> bool:
    """Return whether two pieces go in opposite directions in x or in y, both by more than `unseen`."""
    for axis in range(2):
        first, second = before[3, axis] - before[0, axis], after[3, axis] - after[0, axis]
        if first * second < 0.0 and min(abs(first), abs(second)) > unseen:
            return True
    return False


@kernel(allocates=False)
def _returns(before: NDArray[np.float64], after: NDArray[np.float64], tolerance: float) -> bool:
    """Return whether a piece goes back along the one before it, which is longer than both may be apart then."""
    far, gap = 0.0, 0.0
    for axis in range(2):
        far = max(far, abs(before[3, axis] - before[0, axis]))
        gap = max(gap, abs(after[3, axis] - before[0, axis]))
    return gap <= 2.0 * tolerance < far


@kernel(allocates=False)
def _ends_run(pieces: NDArray[np.float64], i: int, tolerance: float) -> bool:
    """Return whether a run ends before a piece, which may be past the last: where x or y turns, and around a way back.

    A piece and the one that goes back along it stay as they are: if they changed sides, a gap would open.
    """
    n = len(pieces)
    a, b, c, d = pieces[(i - 2) % n], pieces[(i - 1) % n], pieces[i % n], pieces[(i + 1) % n]
    return _turns_between(b, c, UNSEEN * tolerance) or _returns(a, b, tolerance) or _returns(c, d, tolerance)


@kernel(allocates=False)
def _polygon_length(curve: NDArray[np.float64]) -> float:
    """Length of the control polygon of a cubic."""
    total = 0.0
    for k in range(3):
        dx, dy = curve[k + 1, 0] - curve[k, 0], curve[k + 1, 1] - curve[k, 1]
        total += np.sqrt(dx * dx + dy * dy)
    return total


@kernel
def _fit_pieces(
    pieces: NDArray[np.float64], lengths: NDArray[np.float64], first: int, last: int, tolerance: float
) -> tuple[float, NDArray[np.float64]]:
    """Fit one monotone cubic (4, 2) to the pieces first..last-1; its distance from them, infinite if they close.

    Each piece has points in proportion to its length, since pieces near a cusp are tiny, but a few if it can be seen.
    """
    curve, whole, count = np.empty((4, 2)), 0.0, 0
    for i in range(first, last):
        whole += lengths[i]
    samples = min(PER_PIECE * (last - first), MOST_SAMPLES)
    points = np.empty((samples + (LEAST_PER_PIECE + 1) * (last - first) + 1, 2))
    for i in range(first, last):
        parts = max(int(np.ceil(samples * lengths[i] / whole)), LEAST_PER_PIECE if lengths[i] > tolerance else 1)
        for m in range(parts):
            for axis in range(2):
                p0, p1, p2, p3 = pieces[i, 0, axis], pieces[i, 1, axis], pieces[i, 2, axis], pieces[i, 3, axis]
                points[count, axis] = cubic_at(p0, p1, p2, p3, m / parts)
            count += 1
    points[count, 0], points[count, 1] = pieces[last - 1, 3, 0], pieces[last - 1, 3, 1]
    if points[0, 0] == points[count, 0] and points[0, 1] == points[count, 1]:
        return np.inf, curve
    points = points[: count + 1]
    distance = fit_cubic(points, tolerance / 2.0, curve)
    if distance > tolerance:
        return distance, curve
    for axis in range(2):
        low, high = min(curve[0, axis], curve[3, axis]), max(curve[0, axis], curve[3, axis])
        for k in (1, 2):
            curve[k, axis] = min(max(curve[k, axis], low), high)
    x, y, t, squares = np.empty(count + 1), np.empty(count + 1), np.empty(count + 1), np.empty(count + 1)
    for i in range(count + 1):
        x[i], y[i] = points[i, 0], points[i, 1]
    chord_parameters(points, t)
    for _ in range(MEASURED):
        distance = project(x, y, t, curve, squares)
    return distance, curve


@kernel
def reduce_contour(contour: NDArray[np.float64], tolerance: float) -> NDArray[np.float64]:
    """Replace a closed contour (n, 4, 2) by few monotone cubics (m, 4, 2) within a tolerance, closed bit for bit.

    Runs end where x or y turns, where a quad-tree cuts anyway, and around pieces that go back along others. Each cubic
    is as long as the tolerance allows.
    """
    pieces = monotone_pieces(contour, np.zeros(len(contour), np.int64)).points
    n, begin = len(pieces), 0
    while begin < n - 1 and not _ends_run(pieces, begin, tolerance):
        begin += 1
    pieces = np.concatenate((pieces[begin:], pieces[:begin]))
    out, lengths = np.empty((n, 4, 2)), np.empty(n)
    for i in range(n):
        lengths[i] = _polygon_length(pieces[i])
    count, at, end = 0, 0, 0
    while at < n:
        if at == end:
            end += 1
            while end < n and not _ends_run(pieces, end, tolerance):
                end += 1
        copy_curve(pieces[at], out[count])
        good, bad, step = at + 1, end + 1, 1
        while bad - good > 1:  # doubling, then bisection
            last = min(good + step, end) if bad > end else (good + bad) // 2
            step *= 2
            distance, trial = _fit_pieces(pieces, lengths, at, last, tolerance)
            if distance <= tolerance:
                good = last
                copy_curve(trial, out[count])
            else:
                bad = last
        at, count = good, count + 1
    return out[:count].copy()
