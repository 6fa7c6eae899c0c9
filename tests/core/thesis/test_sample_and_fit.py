"""The thesis's own strategy: what it samples, fits and counts."""

import numpy as np
import pytest

import degenerate
from vexture.drawing.drawing import Drawing, FillRule, Path
from vexture.renderers.exact import render_exact
from vexture.thesis.build import build
from vexture.thesis.tree import CellKind


def drawing_of(*contours, rule=FillRule.NONZERO):
    return Drawing((Path(tuple(contours), rule),))


def test_corners_are_divided_rather_than_kept():
    triangle = Drawing.polygon([(0.1, 0.15), (0.83, 0.2), (0.4, 0.9)])
    sampled, direct = build(triangle, strategy="sampled"), build(triangle)
    assert not (sampled.kind == CellKind.CORNER).any()
    assert len(sampled.curves) > 2 * len(direct.curves)
    assert sampled.quad_depth.max() > direct.quad_depth.max()


def test_coverage_is_that_of_straight_lines():
    circle = drawing_of(degenerate.circle((0.5, 0.5), 0.4))
    tree = build(circle, 0.01, strategy="sampled")
    diamond = 2 * 0.4**2
    assert tree.kind.tolist() == [[CellKind.CURVE] * 4]
    assert abs(tree.quad_coverage[0] - diamond) < 1e-6


def test_hole_is_empty_and_ring_is_full():
    ring = drawing_of(degenerate.circle((0.5, 0.5), 0.45), degenerate.circle((0.5, 0.5), 0.2), rule=FillRule.EVENODD)
    tree = build(ring, 1e-5, strategy="sampled")  # small cells, so that their straight lines are near
    truth = float(render_exact(ring, (128, 128)).mean())
    assert abs(float(tree.quad_coverage[0]) - truth) < 0.01


@pytest.mark.slow
def test_a_thin_shape_between_samples_is_sampled_again():
    sliver = Drawing.polygon([(0.1, 0.1), (0.9, 0.8), (0.9, 0.803), (0.1, 0.103)])
    tree = build(sliver, strategy="sampled", max_depth=10)
    truth = float(render_exact(sliver, (256, 256)).mean())
    assert abs(float(tree.quad_coverage[0]) - truth) < 0.25 * truth


def test_straight_sides_on_cell_lines_stay_on_one_side():
    square = Drawing.polygon([(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)])
    tree = build(square, strategy="sampled", max_depth=6)
    assert abs(float(tree.quad_coverage[0]) - 0.25) <= 4 * 0.5 * 4.0**-6  # half a cell at each corner


def test_empty_drawing():
    assert build(Drawing(()), strategy="sampled").kind.tolist() == [[CellKind.EMPTY] * 4]


def test_deviation_is_within_tolerance_where_it_is_resolved():
    blob = drawing_of(degenerate.circle((0.45, 0.53), 0.31))
    tree = build(blob, 2e-4, strategy="sampled")
    assert tree.unresolved == 0
    assert tree.deviation <= 2e-4
    points = np.concatenate([p[[0, 3]] for p in tree.curves])
    assert ((np.abs(points) < 1e-12) | (np.abs(points - 1) < 1e-12)).any(axis=1).all()
