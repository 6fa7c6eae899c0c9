"""A planar map while it grows: the tree, and the arrays that only a map has."""

from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.tree.growth import COVERAGE, WINDING, Growth, growth_from, longer, with_room
from vexture.tree.planar.faces import FaceTable
from vexture.tree.planar.layers import PlanarLayers
from vexture.tree.planar.shades import Shades

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


def state_from(growth: Any, layers: Any, faces: Any) -> State:
    """Make a `State` from the plain tuples that code compiled ahead of time returns."""
    return State(planar_growth_from(growth), PlanarLayers(*(*layers[:-1], Shades(*layers[-1]))), FaceTable(*faces))


def planar_growth_from(values: Any) -> PlanarGrowth:
    """Make a `PlanarGrowth` from plain tuples."""
    return PlanarGrowth(growth_from(values[0]), *values[1:])


@kernel
def with_map_room(growth: PlanarGrowth) -> PlanarGrowth:
    """Return the map with larger arrays where the next cell has no room, as `has_room` wrote."""
    tree = with_room(growth.tree)
    return PlanarGrowth(
        tree, growth.ground, longer(growth.mean, len(tree.cells)), longer(growth.sides, len(tree.curves))
    )
