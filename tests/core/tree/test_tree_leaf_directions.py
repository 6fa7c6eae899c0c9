"""The direction of an outline where it crosses from one leaf into the next, which is seen under a magnifying glass."""

from collections import defaultdict

import numpy as np

from degenerate import circle
from vexture.base.layout import LATTICE
from vexture.drawing.drawing import Drawing, Path
from vexture.tree.build import build_tree
from vexture.tree.tree import Tree


def directions(tree: Tree) -> dict[tuple[float, float], list[complex]]:
    """Unit vectors along the curves that end at each point in the unit square."""
    corner, side = np.zeros((len(tree.count), 2)), np.ones(len(tree.count))
    found = defaultdict(list)
    for quad in range(len(tree.count)):
        below, curve = int(tree.first_quad[quad]), int(tree.first_curve[quad])
        half = 0.5 * side[quad]
        for k in range(4):
            place = corner[quad] + half * np.array([k & 1, k >> 1])
            if tree.is_quad[quad, k]:
                corner[below], side[below] = place, half
                below += 1
            for _ in range(tree.count[quad, k]):
                points = place + half * tree.curves[curve] / LATTICE
                for end, control in ((0, 1), (3, 2)):
                    way = complex(*(points[control] - points[end]))
                    found[tuple(points[end].round(12).tolist())].append(way / abs(way))
                curve += 1
    return found


def test_outlines_hardly_bend_at_borders_of_leaves() -> None:
    rng = np.random.default_rng(0)
    bends = []
    for _ in range(60):
        disc = circle(tuple(rng.uniform(0.41, 0.59, 2)), rng.uniform(0.1, 0.4))
        met = directions(build_tree(Drawing((Path((disc,)),)), capacity=4))
        bends += [abs((pair[0] * pair[1].conjugate()).imag) for pair in met.values() if len(pair) == 2]
    assert len(bends) > 200
    assert np.quantile(bends, 0.9) < 5e-4  # radians; 7.7e-4 if the handles of short pieces are rounded as they are
