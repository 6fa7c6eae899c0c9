"""Reduce the cubics of a closed contour: one cubic replaces a run of monotone pieces if it follows them."""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.fit import fit_run
from vexture.bezier.monotone import monotone_pieces
from vexture.bezier.split import copy_curve

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


@kernel(ahead=True)
def reduce_contour(contour: NDArray[np.float64], tolerance: float) -> NDArray[np.float64]:
    """Replace a closed contour (n, 4, 2) by few monotone cubics (m, 4, 2) within a tolerance, closed bit for bit.

    Runs end where x or y turns, where a quad-tree cuts anyway. Each cubic is as long as the tolerance allows.
    """
    pieces = monotone_pieces(contour, np.zeros(len(contour), np.int64)).points
    n, begin = len(pieces), 0
    while begin < n - 1 and not _turns_between(pieces[begin - 1], pieces[begin], UNSEEN * tolerance):
        begin += 1
    pieces = np.concatenate((pieces[begin:], pieces[:begin]))
    out, trial = np.empty((n, 4, 2)), np.empty((4, 2))
    count, at, end = 0, 0, 0
    while at < n:
        if at == end:
            end += 1
            while end < n and not _turns_between(pieces[end - 1], pieces[end], UNSEEN * tolerance):
                end += 1
        copy_curve(pieces[at], out[count])
        good, bad, step = at + 1, end + 1, 1
        while bad - good > 1:  # doubling, then bisection
            last = min(good + step, end) if bad > end else (good + bad) // 2
            step *= 2
            if fit_run(pieces, at, last, tolerance, True, trial) <= tolerance:
                good = last
                copy_curve(trial, out[count])
            else:
                bad = last
        at, count = good, count + 1
    return out[:count].copy()
