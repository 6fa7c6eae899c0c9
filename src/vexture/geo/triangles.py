"""Outlines of the area where values on a triangle mesh are above 0, straight within each triangle."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Outline", "outlines_above"]


class Outline(NamedTuple):
    """A closed ring, with the area above 0 to its left; the first of its points, (n, 2), is not repeated at the end.

    `border` marks points on the border of the mesh; `cell` is the length of the shorter edges crossed.
    """

    points: NDArray[np.float64]
    border: NDArray[np.bool_]
    cell: float


def outlines_above(
    points: NDArray[np.float64], triangles: NDArray[np.int64], values: NDArray[np.float64]
) -> list[Outline]:
    """Outlines of the area where values at points are above 0, linear between the corners of triangles.

    The corners of a triangle, (m, 3) numbers of points, are in counter-clockwise order.

    Examples
    --------
    >>> corners = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    >>> outlines_above(corners, np.array([[0, 1, 2]]), np.array([1.0, -1.0, -1.0]))[0].points
    array([[0. , 0. ],
           [0.5, 0. ],
           [0. , 0.5]])
    """
    wet = values > 0.0
    start = triangles.ravel()
    end = np.roll(triangles, -1, axis=1).ravel()
    low, high = np.minimum(start, end), np.maximum(start, end)
    keys = low * len(points) + high
    _, first, edge, count = np.unique(keys, return_index=True, return_inverse=True, return_counts=True)
    ends = np.column_stack([low[first], high[first]])
    crossing = edge + len(points)  # crossings are numbered after the points
    leaving = (wet[start] & ~wet[end]).reshape(-1, 3)
    entering = (~wet[start] & wet[end]).reshape(-1, 3)
    mixed = leaving.any(axis=1)
    number = crossing.reshape(-1, 3)[mixed]
    rows = np.arange(mixed.sum())
    froms = [number[rows, leaving[mixed].argmax(axis=1)]]
    tos = [number[rows, entering[mixed].argmax(axis=1)]]
    outer = count[edge] == 1
    froms.append(np.where(wet[start], start, crossing)[outer & (wet[start] | wet[end])])
    tos.append(np.where(wet[end], end, crossing)[outer & (wet[start] | wet[end])])
    rings = _rings(np.concatenate(froms), np.concatenate(tos))
    a, b = values[ends[:, 0]], values[ends[:, 1]]
    crossed = wet[ends[:, 0]] != wet[ends[:, 1]]
    share = np.where(crossed, a / np.where(crossed, a - b, 1.0), 0.0)[:, None]
    side = points[ends[:, 1]] - points[ends[:, 0]]
    places = np.concatenate([points, points[ends[:, 0]] + share * side])
    border = np.zeros(len(places), np.bool_)
    border[start[outer]] = border[end[outer]] = border[crossing[outer]] = True
    lengths = np.concatenate([np.full(len(points), np.nan), np.hypot(*side.T)])
    return [Outline(places[ring], border[ring], _cell(lengths[ring], places[ring])) for ring in rings]


def _rings(froms: NDArray[np.int64], tos: NDArray[np.int64]) -> list[NDArray[np.int64]]:
    """Closed paths along directed steps, each step used once."""
    order = np.argsort(froms, kind="stable")
    after: dict[int, list[int]] = {}
    for a, b in zip(froms[order].tolist(), tos[order].tolist(), strict=True):
        after.setdefault(a, []).append(b)
    rings = []
    for start in list(after):
        while after[start]:
            ring, at = [], start
            while after.get(at):
                ring.append(at)
                at = after[at].pop()
            rings.append(np.array(ring))
    return rings


def _cell(lengths: NDArray[np.float64], points: NDArray[np.float64]) -> float:
    """Length of the shorter edges that a ring crosses, or of its own sides where it crosses none."""
    found = lengths[np.isfinite(lengths)]
    if not len(found):
        found = np.hypot(*(points - np.roll(points, 1, axis=0)).T)
    return float(np.quantile(found, 0.1))
