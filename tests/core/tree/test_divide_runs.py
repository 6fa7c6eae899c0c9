"""Runs: neighbours along a contour that go down the tree as one, which changes nothing but the time."""

from itertools import pairwise

import numpy as np
import pytest

from vexture.drawing.contours import ring_contours
from vexture.drawing.drawing import Drawing, FillRule, Path
from vexture.tree.bounds import DEFAULT_DEPTH, bounds_of
from vexture.tree.build import SLICE, grow_on, new_growth
from vexture.tree.cubics import gather
from vexture.tree.divide import CROWDED, RUN, Cell, PiecePool, divide
from vexture.tree.growth import LAST, PIECES, WAITING, Growth, growth_from, tree_of
from vexture.tree.tree import MOST_QUADS


def coast(seed, sizes, rule=FillRule.EVENODD, low=0.0):
    """Rough rings, each a path, some of which touch the sides of the unit square."""
    random, paths = np.random.default_rng(seed), []
    for size in sizes:
        angle = np.sort(random.random(size)) * 2 * np.pi
        rough = 1.0 + 0.3 * np.cumsum(random.normal(size=size)) / size**0.5
        middle, scale = low + (1.0 - low) * random.random(2), 0.3 * random.random() + 0.05
        points = middle + scale * rough[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        paths.append(Path(ring_contours(np.clip(points, low, 1.0), np.array([size])), rule))
    return Drawing(tuple(paths))


def grown(drawing, in_runs, tolerance=0.0, max_depth=DEFAULT_DEPTH):
    """The tree of a drawing, whose pieces start in runs or one by one."""
    cubics, owner, rules = gather(drawing)
    bounds = bounds_of(tolerance, max_depth, 8, None, MOST_QUADS)
    tree, _ = new_growth(cubics, owner, max_depth, in_runs)
    tree = Growth(*tree)
    runs = int((tree.pool[2][: tree.stack[0, LAST]] < 0).sum())
    while tree.counts[WAITING] > 0:
        tree = growth_from(grow_on(tree, rules, bounds, SLICE, 0))
    return tree_of(tree), runs


@pytest.mark.parametrize("tolerance", [0.0, 1e-4])
@pytest.mark.parametrize("low", [0.0, 0.01])
@pytest.mark.parametrize(
    "sizes",
    [(20_000,), (5, 3000, 17, 900, 8000), (31,) * 40, (5,) * 900],
    ids=["one ring", "several", "rings of two runs", "rings shorter than a run"],
)
def test_a_tree_of_runs_is_that_of_pieces(sizes, low, tolerance):
    rule = FillRule.EVENODD if len(sizes) == 1 else FillRule.NONZERO
    drawing = coast(len(sizes), sizes, rule, low)
    fast, runs = grown(drawing, True, tolerance)
    slow, none = grown(drawing, False, tolerance)
    assert 0.5 < runs / sum(-(-size // RUN) for size in sizes) < 1.1
    assert none == 0
    for field in ("is_quad", "count", "winding", "coverage", "curves"):
        assert (getattr(fast, field) == getattr(slow, field)).all(), field
    assert fast.deviation == slow.deviation


def test_no_leaf_at_the_depth_limit_is_lost_in_a_run():
    drawing = coast(7, (40_000,))
    fast, _ = grown(drawing, True, max_depth=3)
    slow, _ = grown(drawing, False, max_depth=3)
    assert (fast.coverage == slow.coverage).all()
    assert fast.unresolved == slow.unresolved > 0


@pytest.mark.parametrize("at_limit", [False, True])
def test_lists_of_few_pieces_hold_no_runs(at_limit):
    drawing = coast(3, (4 * CROWDED,), low=0.01)
    cubics, owner, _ = gather(drawing)
    tree, _ = new_growth(cubics, owner, 4, True)
    growth, child_at = Growth(*tree), np.empty(9, np.int64)
    pool, last = PiecePool(*growth.pool), int(growth.stack[0, LAST])
    middle = np.median(cubics[:, 0], axis=0)
    cell = Cell(0.9 * middle[0] - 0.5, middle[1] - 0.5, 1.0, 0, last)
    divide(pool, cell, 1e-6, int(growth.stack[0, PIECES]), at_limit, child_at)
    lists = [pool.numbers[start:end] for start, end in pairwise(child_at[:5].tolist())]
    length = np.diff(pool.runs[:, :2])[:, 0]
    crowded = [sum(length[-1 - i] if i < 0 else 1 for i in numbers.tolist()) > CROWDED for numbers in lists]
    assert [bool((numbers < 0).any()) for numbers in lists] == [not at_limit and many for many in crowded]
    assert any(crowded)
    assert not all(crowded)
