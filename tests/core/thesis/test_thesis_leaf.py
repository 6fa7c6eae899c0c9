"""Leaves of the thesis: what a cell becomes, by drawings whose cells are known."""

import numpy as np
import pytest

from vexture.drawing.drawing import Drawing
from vexture.thesis.build import build
from vexture.thesis.leaf import snap_to_edge
from vexture.thesis.tree import CellKind, CellTree


def cell_of(*corners: tuple[float, float], **parameters: int) -> tuple[CellTree, int, float]:
    """Tree of a polygon in the lower left quarter, kind of its cell there, and coverage of that."""
    tree = build(Drawing.polygon(corners), **parameters)
    return tree, int(tree.kind[0, 0]), float(tree.coverage[0, 0])


def test_a_straight_corner_is_one_leaf() -> None:
    tree, kind, coverage = cell_of((0, 0), (0.25, 0), (0.25, 0.25), (0, 0.25))
    assert (kind, coverage) == (CellKind.CORNER, pytest.approx(0.25))
    np.testing.assert_allclose(tree.curves[tree.ref[0, 0]], [(0, 0.5), (0.5, 0.5), (0.5, 0.5), (0.5, 0)], atol=1e-4)


def test_a_straight_side_is_a_curve() -> None:
    tree, kind, coverage = cell_of((0, 0), (0.5, 0), (0, 0.5))
    assert (kind, coverage) == (CellKind.CURVE, pytest.approx(0.5))
    np.testing.assert_allclose(tree.curves[tree.ref[0, 0]][[0, 3]], [(0, 1), (1, 0)], atol=1e-4)


def test_what_fits_no_leaf_at_the_limit_is_unresolved_and_keeps_its_area() -> None:
    tree, kind, coverage = cell_of((0.1, 0.1), (0.2, 0.1), (0.2, 0.2), (0.1, 0.2), max_depth=1)
    assert (tree.unresolved, kind) == (1, CellKind.EMPTY)
    assert coverage == pytest.approx(0.04, abs=1e-4)


@pytest.mark.parametrize(
    ("point", "snapped"), [((0.3, 0.1), (0.3, 0.0)), ((0.95, 0.4), (1.0, 0.4)), ((1.2, 0.5), (1.0, 0.5))]
)
def test_a_point_moves_to_the_nearest_side(point: tuple[float, float], snapped: tuple[float, float]) -> None:
    moved = np.array(point)
    snap_to_edge(moved)
    assert moved.tolist() == list(snapped)
