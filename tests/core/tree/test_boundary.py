"""The resolved boundary, against brute force on degenerate drawings."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import degenerate
from vexture.base.layout import LATTICE
from vexture.bezier.monotone import monotone_pieces
from vexture.thesis.build import root_level
from vexture.thesis.subdivide import children
from vexture.tree.boundary import crowded_area, quantise, resolve
from vexture.tree.crossings import x_at
from vexture.tree.cubics import gather

CLEAR = 2.6  # lattice units: nearer to an outline than this no answer is wrong
SAGITTA = 2e-5  # of the brute force's chords


def levels(drawing, depth):
    """Levels 0..depth of a drawing with every cell divided, and the sizes of their cells."""
    cubics, owner, rules = gather(drawing)
    level = root_level(drawing, monotone_pieces(cubics, owner))
    for k in range(depth + 1):
        yield level, 2.0**-k, rules
        everything = np.ones(len(level.slot), bool)
        level, _ = children(level, everything, rules, 2.0**-k, 0)


def in_cell(points, level, c, size):
    return ((points >= level.origin[c]) & (points < level.origin[c] + size)).all(axis=1)


def inside_resolved(curves, boundary, point):
    """Inside by the resolved boundary, from the left edge of the point's slab; also whether roles alternate."""
    slab = np.searchsorted(boundary.heights, point[1], side="right") - 1
    middle = 0.5 * (boundary.heights[slab] + boundary.heights[slab + 1])
    spans = (boundary.run_y[:, 0] <= middle) & (boundary.run_y[:, 1] >= middle)
    total = boundary.left[slab] + boundary.run_role[spans].sum()
    state = boundary.left[slab]
    for r in np.flatnonzero(spans):
        if x_at(curves[boundary.run_piece[r]], point[1]) < point[0]:
            state += boundary.run_role[r]
    return state, total


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10**9))
@example(0)
def test_resolved_boundary_equals_brute_force(seed):
    drawing = degenerate.drawing(seed)
    if not drawing.segments:
        return
    points = degenerate.points_near(drawing, np.random.default_rng(seed), 400)
    windings, distance = degenerate.path_windings(drawing, points)
    truth = degenerate.silhouette(drawing, windings)
    for level, size, rules in levels(drawing, 2):
        for c in range(len(level.slot)):
            first, last = level.piece_at[c], level.piece_at[c + 1]
            present = level.present[level.path_at[c] : level.path_at[c + 1]]
            curves = quantise(level.pieces.points[first:last], *level.origin[c], size)
            owner = np.searchsorted(present[:, 0], level.pieces.path[first:last])
            once = np.ones(len(owner), np.int64)
            boundary = resolve(curves, owner, once, present[:, 1].copy(), rules[present[:, 0]])
            clear = distance > CLEAR * size / LATTICE + SAGITTA
            for i in np.flatnonzero(in_cell(points, level, c, size) & clear):
                state, total = inside_resolved(curves, boundary, (points[i] - level.origin[c]) / size * LATTICE)
                assert state == truth[i]
                assert total in (0, 1)


def test_crowded_area_is_the_mean_over_the_cell():
    drawing = degenerate.drawing(7)
    points = np.random.default_rng(1).random((20_000, 2))
    truth = degenerate.silhouette(drawing, degenerate.path_windings(drawing, points, 64)[0])
    level, size, rules = next(levels(drawing, 0))
    area = crowded_area(level.pieces.points, level.pieces.path, level.present, rules, 0.0, 0.0, size)
    assert abs(area - truth.mean()) < 0.02
