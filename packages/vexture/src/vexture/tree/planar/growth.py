"""A planar map while it grows: the tree, and what a map has beside it."""

from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.tree.growth import COVERAGE, WINDING, Growth, roomy, with_needed_room
from vexture.tree.planar.faces import FaceTable
from vexture.tree.planar.layers import PlanarLayers

BASE: Final = WINDING
IS_MEAN: Final = COVERAGE
"""Columns of the cells that mean something else here."""


class PlanarGrowth(NamedTuple):
    """The map while it grows. Columns of its cells: whether a quad, count, base paint, whether only the mean counts."""

    tree: Growth
    ground: NDArray[np.int64]  # (stack,): ground of each cell to divide
    mean: NDArray[np.float64]  # (quads, 4, 4)
    sides: NDArray[np.int64]  # (curves, 2)


class State(NamedTuple):
    """A map while it grows, with its layers and the faces that were met."""

    growth: PlanarGrowth
    layers: PlanarLayers
    faces: FaceTable


def growth_from_tuples(tree: tuple[Any, ...], *others: Any) -> PlanarGrowth:
    """Make a growth of the plain tuples that `plant_map` returns."""
    return PlanarGrowth(Growth(*tree), *others)


def with_room(growth: PlanarGrowth) -> PlanarGrowth:
    """The map, with at least twice the room where the next cell has none."""
    tree = with_needed_room(growth.tree)
    return PlanarGrowth(tree, growth.ground, roomy(growth.mean, len(tree.cells)), roomy(growth.sides, len(tree.curves)))
