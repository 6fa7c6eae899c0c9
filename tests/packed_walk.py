"""A packed tree as its docstring defines it, leaf by leaf, in plain NumPy: independent of what built it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.layout import LATTICE
from vexture.tree.tree import Tree


class Leaf(NamedTuple):
    """A leaf's square, corner winding, pieces in its own unit square, and coverage."""

    x: float
    y: float
    side: float
    depth: int
    winding: int
    curves: NDArray[np.float64]
    coverage: float


def leaves(tree: Tree) -> list[Leaf]:
    """All leaves; fails where a quad or a curve is not met exactly once."""
    found, quads_met, curves_met = [], [], []

    def visit(quad, x, y, side, depth):
        quads_met.append(quad)
        below, curve = tree.first_quad[quad], tree.first_curve[quad]
        for k in range(4):
            corner = x + side / 2 * (k & 1), y + side / 2 * (k >> 1)
            if tree.is_quad[quad, k]:
                assert below > quad
                visit(below, *corner, side / 2, depth + 1)
                below += 1
            else:
                count = tree.count[quad, k]
                curves_met.extend(range(curve, curve + count))
                pieces = tree.curves[curve : curve + count] / LATTICE
                winding = int(tree.winding[quad, k])
                found.append(Leaf(*corner, side / 2, depth + 1, winding, pieces, tree.coverage[quad, k]))
                curve += count

    visit(0, 0.0, 0.0, 1.0, 0)
    assert sorted(quads_met) == list(range(len(tree.count)))
    assert sorted(curves_met) == list(range(len(tree.curves)))
    return found


def leaf_at(found: list[Leaf], points: NDArray[np.float64]) -> NDArray[np.int64]:
    """Index of the leaf that holds each point of the unit square."""
    squares = np.array([leaf[:3] for leaf in found])
    low, high = squares[:, :2], squares[:, :2] + squares[:, 2:]
    within = ((points[:, None] >= low) & (points[:, None] < high)).all(axis=2)
    return within.argmax(axis=1)


def x_at(curve: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
    """Place of a monotone piece at heights between those of its ends, by bisection."""
    low, high = np.zeros_like(y), np.ones_like(y)
    rising = curve[3, 1] > curve[0, 1]
    for _ in range(50):
        t = 0.5 * (low + high)
        above = (point_at(curve, t)[1] > y) == rising
        low, high = np.where(above, low, t), np.where(above, t, high)
    return point_at(curve, low)[0]


def point_at(curve: NDArray[np.float64], t: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points of a cubic, (2, n)."""
    s = 1.0 - t
    weights = np.array([s**3, 3 * s * s * t, 3 * s * t * t, t**3])
    return curve.T @ weights


def windings(leaf: Leaf, points: NDArray[np.float64]) -> NDArray[np.int64]:
    """Winding numbers at points of the unit square that lie in a leaf."""
    x, y = ((points - (leaf.x, leaf.y)) / leaf.side).T
    found = np.full(len(points), leaf.winding)
    for curve in leaf.curves:
        for end, event in ((0, 1), (3, -1)):
            if curve[end, 0] == 0.0:
                found += np.where(curve[end, 1] <= y, event, 0)
        a, d = curve[0, 1], curve[3, 1]
        crosses = (min(a, d) <= y) & (y < max(a, d))
        if crosses.any():
            left = np.zeros(len(points), bool)
            left[crosses] = x_at(curve, y[crosses]) < x[crosses]
            found += np.where(left, -1 if d > a else 1, 0)
    return found
