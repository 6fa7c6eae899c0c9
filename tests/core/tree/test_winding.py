"""Counted windings, against brute force on degenerate drawings."""

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st
from test_boundary import in_cell, levels

import degenerate
from vexture.tree.crossings import x_at
from vexture.tree.cubics import gather

SAGITTA = 2e-5  # of the brute force's chords


def winding_by_rule(level, c, present, point):
    """The rule of windings as the documentation states it, read literally."""
    path, w = present
    for i in range(level.piece_at[c], level.piece_at[c + 1]):
        if level.pieces.path[i] != path:
            continue
        curve = level.pieces.points[i]
        w += sum(
            sign for end, sign in ((0, 1), (3, -1)) if curve[end, 0] == level.origin[c, 0] and curve[end, 1] <= point[1]
        )
        if (
            min(curve[0, 1], curve[3, 1]) <= point[1] < max(curve[0, 1], curve[3, 1])
            and x_at(curve, point[1]) < point[0]
        ):
            w -= 1 if curve[3, 1] > curve[0, 1] else -1
    return w


@settings(max_examples=8, deadline=None)
@given(st.integers(0, 10**9))
@example(2044)  # paths 0 and 3 are one, of which the first is in the tree
@example(77255)  # one path is the same circle twice
def test_counted_windings_equal_brute_force(seed):
    drawing = degenerate.drawing(seed)
    if not drawing.segments:
        return
    points = degenerate.points_near(drawing, np.random.default_rng(seed), 300)
    cubics, owner, rules = gather(drawing)  # leaves out copies of contours that change no fill
    counted = [degenerate.cubic_windings(cubics[owner == p], points) for p in range(len(rules))]
    truth, distance = [each[0] for each in counted], np.min([each[1] for each in counted], axis=0)
    for level, size, _ in levels(drawing, 3):
        for c in range(len(level.slot)):
            for i in np.flatnonzero(in_cell(points, level, c, size) & (distance > SAGITTA)):
                for present in level.present[level.path_at[c] : level.path_at[c + 1]]:
                    assert winding_by_rule(level, c, present, points[i]) == truth[present[0]][i]
