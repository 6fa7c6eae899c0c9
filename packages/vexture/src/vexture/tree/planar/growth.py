"""A planar map while it grows: the tree, and the arrays that only a map has."""

from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.tree.growth import COVERAGE, WINDING, Growth, roomy, with_needed_room
from vexture.tree.planar.faces import FaceTable
from vexture.tree.planar.layers import PlanarLayers

BASE: Final = WINDING
IS_MEAN: Final = COVERAGE
"""Columns of the cells that have another meaning in a map."""


class PlanarGrowth(NamedTuple):
    """The map while it grows. Columns of its cells: whether it is a quad, count, base paint, whether it is a mean."""

    tree: Growth
    ground: NDArray[np.int64]  # (stack,): ground of each cell to divide
    mean: NDArray[np.float64]  # (quads, 4, 4)
    sides: NDArray[np.int64]  # (curves, 2)


class State(NamedTuple):
    """A map while it grows, with its layers and the faces met so far."""

    growth: PlanarGrowth
    layers: PlanarLayers
    faces: FaceTable


def growth_from_tuples(tree: tuple[Any, ...], *others: Any) -> PlanarGrowth:
    """Make a `PlanarGrowth` from the plain tuples that `plant_map` returns."""
    return PlanarGrowth(Growth(*tree), *others)


def with_room(growth: PlanarGrowth) -> PlanarGrowth:
    """Return the map with larger arrays where the next cell has no room."""
    tree = with_needed_room(growth.tree)
    return PlanarGrowth(tree, growth.ground, roomy(growth.mean, len(tree.cells)), roomy(growth.sides, len(tree.curves)))
