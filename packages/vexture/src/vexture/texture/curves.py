"""Encode curves: one per texel, or two if all curves of a planar map's leaf are straight (FORMAT.md, B.4, D.2)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import (
    CONTROL_OFFSET,
    COORDINATE_BITS,
    COUNT_SHIFT,
    MOST_CURVES,
    QUAD_FLAG,
    STRAIGHT,
)

COORDINATE = (1 << COORDINATE_BITS) - 1
OFFSETS = np.array([0, CONTROL_OFFSET, CONTROL_OFFSET, 0])[:, None]
"""Offsets of the stored coordinates of P0 to P3."""

NEAR = 1
"""Lattice units by which P1 and P2 of a straight curve may differ from the thirds of its chord."""


def curve_texels(curves: NDArray[np.int32]) -> NDArray[np.uint32]:
    """Encode curves (n, 4, 2), in lattice units, as one texel each."""
    return _words(curves + OFFSETS)


def curve_points(texels: NDArray[np.uint32]) -> NDArray[np.int32]:
    """Decode texels (n, 4) to the points of curves, (n, 4, 2), in lattice units of their leaf."""
    return _points(texels) - OFFSETS.astype(np.int32)


def _words(points: NDArray[np.int32]) -> NDArray[np.uint32]:
    words: NDArray[np.uint32] = (points[..., 0] | (points[..., 1] << COORDINATE_BITS)).astype(np.uint32)
    return words


def _points(words: NDArray[np.uint32]) -> NDArray[np.int32]:
    return np.stack([words & COORDINATE, words >> COORDINATE_BITS], axis=-1).astype(np.int32)


def _straight(ends: NDArray[np.int32]) -> NDArray[np.int32]:
    """Straight curves (n, 4, 2) between ends (n, 2, 2)."""
    p0, p3 = ends[:, 0], ends[:, 1]
    return np.stack([p0, (2 * p0 + p3 + 1) // 3, (p0 + 2 * p3 + 1) // 3, p3], axis=1)


class LeafCurves(NamedTuple):
    """Positions of the curves of some leaves in the joint texels of these leaves."""

    texel: NDArray[np.int64]  # (curves,)
    half: NDArray[np.int64]  # (curves,): 0 or 1 in a texel of two; 0 elsewhere
    is_straight: NDArray[np.bool_]  # (curves,): is it in a texel of two

    @classmethod
    def of_counts(cls, count: NDArray[np.int64], is_straight: NDArray[np.bool_]) -> "LeafCurves":
        """Positions for leaves with `count` (leaves,) curves; `is_straight` (leaves,) marks leaves of straight ones."""
        texels, paired = texels_in(count, is_straight), np.repeat(is_straight, count)
        number = np.arange(len(paired)) - np.repeat(np.cumsum(count) - count, count)
        first = np.repeat(np.cumsum(texels) - texels, count)
        return cls(first + np.where(paired, number >> 1, number), np.where(paired, number & 1, 0), paired)


def texels_in(count: NDArray[np.int64], is_straight: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Number of texels of the curves of each leaf."""
    return np.where(is_straight, (count + 1) >> 1, count)


def leaf_points(texels: NDArray[np.uint32], at: LeafCurves) -> NDArray[np.int32]:
    """Decode the curves of leaves, (n, 4, 2), at their positions in the joint texels of these leaves."""
    points = curve_points(texels[at.texel])
    ends = _points(texels).reshape(-1, 2, 2, 2)[at.texel, at.half]
    points[at.is_straight] = _straight(ends[at.is_straight])
    return points


@kernel(allocates=False)
def write_curve(curve: NDArray[np.int32], texel: NDArray[np.uint32]) -> None:
    """Encode a curve (4, 2), in lattice units, as one texel."""
    for k in range(4):
        offset = CONTROL_OFFSET if k in (1, 2) else 0
        x, y = int(curve[k, 0]) + offset, int(curve[k, 1]) + offset
        texel[k] = x | y << COORDINATE_BITS


@kernel
def read_curve(texel: NDArray[np.uint32], curve: NDArray[np.float64]) -> None:
    """Write the points of a curve to `curve`, in lattice units."""
    for k in range(4):
        offset = CONTROL_OFFSET if k in (1, 2) else 0
        word = int(texel[k])
        curve[k, 0], curve[k, 1] = (word & COORDINATE) - offset, (word >> COORDINATE_BITS) - offset


@kernel
def read_leaf_curve(flat: NDArray[np.uint32], first: int, cell: int, i: int, curve: NDArray[np.float64]) -> None:
    """Write to `curve` the points of curve i of a map's leaf; `first` is its first texel of curves, `cell` its byte."""
    if cell & STRAIGHT == 0:
        read_curve(flat[first + i], curve)
        return
    texel, word = first + (i >> 1), 2 * (i & 1)
    start, end = int(flat[texel, word]), int(flat[texel, word + 1])
    for axis in range(2):
        a, b = start >> COORDINATE_BITS * axis & COORDINATE, end >> COORDINATE_BITS * axis & COORDINATE
        curve[0, axis], curve[3, axis] = a, b
        curve[1, axis], curve[2, axis] = (2 * a + b + 1) // 3, (a + 2 * b + 1) // 3


@kernel
def texels_of_cell(cell: int) -> int:
    """Number of texels of the curves of a map's cell, from its byte."""
    if cell >= QUAD_FLAG:
        return 0
    count = cell >> COUNT_SHIFT & MOST_CURVES
    return (count + 1) >> 1 if cell & STRAIGHT != 0 else count
