"""Merging: a chain of pieces that one cubic describes within tolerance becomes that cubic (the thesis's fit).

The pieces of a cell are merged after they are rounded to its lattice. The ends of a chain do not move, so neighbouring
cells still meet. Where a fitted cubic crosses other pieces, the crossing is resolved afterwards like any other.
"""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import LATTICE
from vexture.bezier.fit import fit_run
from vexture.bezier.monotone import MOST_PARTS, turns
from vexture.bezier.split import copy_curve, split

MOST_MERGED = 64
"""Pieces. In a cell with more, nothing is merged, because the cell will be divided."""


@kernel
def _fit_run(
    curves: NDArray[np.float64], first: int, last: int, tolerance: float, out: NDArray[np.float64]
) -> tuple[int, float]:
    """Fit one cubic to pieces first..last-1; write its monotone parts; return how many (0: no fit) and its distance."""
    rest = np.empty((4, 2))
    distance = fit_run(curves, first, last, tolerance, False, rest)
    if not distance <= tolerance:
        return 0, 0.0
    return _monotone_parts(rest, out), distance


@kernel
def _monotone_parts(rest: NDArray[np.float64], out: NDArray[np.float64]) -> int:
    """Write the monotone parts of a cubic, with their inner ends rounded to the cell's lattice; return how many.

    `rest` is overwritten.
    """
    t = np.empty(4)
    count, parts, before = turns(rest, t), 0, 0.0
    for k in range(count):
        split(rest, (t[k] - before) / (1.0 - before), out[parts], rest)
        before = t[k]
        for axis in range(2):
            inner = min(max(np.rint(rest[0, axis]), 1.0 if axis == 0 else 0.0), LATTICE)
            out[parts, 2, axis] += inner - out[parts, 3, axis]
            rest[1, axis] += inner - rest[0, axis]
            out[parts, 3, axis], rest[0, axis] = inner, inner
        if out[parts, 0, 0] != out[parts, 3, 0] or out[parts, 0, 1] != out[parts, 3, 1]:
            parts += 1
    if rest[0, 0] != rest[3, 0] or rest[0, 1] != rest[3, 1]:
        copy_curve(rest, out[parts])
        parts += 1
    return parts


@kernel(allocates=False)
def follows(curves: NDArray[np.float64], i: int, j: int) -> bool:
    """Whether piece i starts where piece j ends."""
    return curves[i, 0, 0] == curves[j, 3, 0] and curves[i, 0, 1] == curves[j, 3, 1]


@kernel(allocates=False)
def _chain_end(curves: NDArray[np.float64], path: NDArray[np.int64], first: int) -> int:
    """Number of the piece after the chain that starts with piece `first`."""
    last = first + 1
    while last < len(path) and path[last] == path[first] and follows(curves, last, last - 1):
        last += 1
    return last


@kernel
def merge_chains(
    curves: NDArray[np.float64],
    path: NDArray[np.int64],
    tolerance: float,
    most: int,
    merged: NDArray[np.float64],
    merged_path: NDArray[np.int64],
) -> tuple[int, float]:
    """Write the pieces of a cell, with as many as possible merged; return their number and the largest distance.

    Each chain is merged greedily: one cubic replaces as many of its first pieces as possible, the next cubic as many of
    the rest, and so on. `curves` are in the order of their contours. `tolerance` is the largest distance of a cubic
    from the pieces that it replaces, in lattice units. Once more than `most` written pieces are not horizontal, the
    rest is left out, because the cell will be divided. `merged` (room, 4, 2) and `merged_path` (room,) are written and
    need room for `MOST_PARTS` pieces more than `curves` holds.
    """
    trial = np.empty((MOST_PARTS, 4, 2))
    best = np.empty((MOST_PARTS, 4, 2))
    count, upright, deviation, first, chain_end = 0, 0, 0.0, 0, 0
    while first < len(path) and upright <= most:
        if first == chain_end:
            chain_end = _chain_end(curves, path, first)
        fitting, failing, parts, distance = 1, chain_end - first + 1, 0, 0.0
        length = chain_end - first
        while length > fitting:
            found, off = _fit_run(curves, first, first + length, tolerance, trial)
            if 0 < found < length:
                fitting, parts, distance = length, found, off
                for k in range(found):
                    copy_curve(trial[k], best[k])
            else:
                failing = length
            length = (fitting + failing) // 2
        if parts == 0:
            copy_curve(curves[first], merged[count])
            parts = 1
        else:
            for k in range(parts):
                copy_curve(best[k], merged[count + k])
            deviation = max(deviation, distance)
        for k in range(parts):
            merged_path[count + k] = path[first]
            upright += 1 if merged[count + k, 0, 1] != merged[count + k, 3, 1] else 0
        count += parts
        first += fitting
    return count, deviation
