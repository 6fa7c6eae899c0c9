"""The quad-tree of the thesis: what follows from its arrays."""

import numpy as np

from vexture.thesis.tree import CellKind, CellTree

QUAD, CURVE, FULL, EMPTY = CellKind.QUAD, CellKind.CURVE, CellKind.FULL, CellKind.EMPTY


def chain(*leaves: int) -> CellTree:
    """Quads in one another's second cell; the last cell of each is a leaf of a kind."""
    n = len(leaves)
    kind = np.array([[EMPTY, QUAD if k + 1 < n else EMPTY, EMPTY, leaf] for k, leaf in enumerate(leaves)], np.uint8)
    ref = np.full((n, 4), -1, np.int32)
    ref[:-1, 1] = np.arange(1, n)
    coverage = np.where(kind == FULL, 1.0, 0.0)
    return CellTree(kind, ref, coverage, np.zeros((0, 4, 2)), 0.0, 0)


def test_depth_of_each_quad() -> None:
    assert chain(EMPTY, FULL, EMPTY).quad_depth.tolist() == [0, 1, 2]


def test_coverage_of_a_quad_is_the_mean_of_its_cells() -> None:
    assert chain(EMPTY, FULL).quad_coverage.tolist() == [0.0, 0.25]


def test_the_widest_leaf_is_the_one_with_a_curve_that_is_least_deep() -> None:
    assert chain(CURVE, CURVE).widest_leaf == 0.5
    assert chain(FULL, EMPTY, CURVE, CURVE).widest_leaf == 0.125
    assert chain(FULL, EMPTY).widest_leaf == 0.0
