"""What every packed tree promises, asserted on its arrays as their docstring defines them."""

import runpy
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import degenerate
import packed_walk
from vexture import read_svg
from vexture.base.errors import LimitError, ParameterError, SourceError
from vexture.base.layout import LATTICE, MOST_CURVES, MOST_DEPTH
from vexture.drawing.drawing import Drawing
from vexture.drawing.drawing import Path as Outline
from vexture.renderers.exact import render_exact
from vexture.tree.bounds import DEFAULT_CAPACITY
from vexture.tree.build import build_tree

ROOT = Path(__file__).parents[3]
SHAPES = sorted((ROOT / "examples" / "shapes").glob("*.svg"))
corpora = SimpleNamespace(**runpy.run_path(str(ROOT / "packages" / "vexture-evidence" / "benchmarks" / "corpora.py")))

CHORDS = 512
SAGITTA = 8e-6  # of the brute force's chords, unit-square units
ROUNDING = 4.0 / LATTICE  # cell sides: to the lattice, where curves cross, and beside the left edge
SNAPPED = (
    2.0**-16
)  # unit-square units: points on the middle lines of the unit square are rounded to the lattice of depth 1
AREA_ROUNDING = 5e-5  # of the drawing


def check(drawing, seed, tolerance=0.0, **parameters):
    """Assert everything that holds of the tree of any drawing; return the tree and its leaves."""
    tree = build_tree(drawing, tolerance=tolerance, **parameters)
    found = packed_walk.leaves(tree)
    assert sum(leaf.side**2 for leaf in found) == 1.0
    assert tree.deviation <= tolerance
    assert sum(not len(leaf.curves) and 0.0 < leaf.coverage < 1.0 for leaf in found) <= tree.unresolved
    ends = tree.curves[:, [0, 3]]
    assert ends.min(initial=0) >= 0
    assert ends.max(initial=0) <= LATTICE
    mean_of_cells_is_coverage(tree)
    numbered_breadth_first(tree)
    truth = render_exact(drawing, (64, 64)).mean(dtype=np.float64)
    assert abs(tree.coverage[0].mean() - truth) <= AREA_ROUNDING + 10.0 * tolerance
    if drawing.segments:
        points_are_inside_where_the_drawing_says(drawing, found, seed, tolerance)
    return tree, found


def mean_of_cells_is_coverage(tree):
    for quad, cell in zip(*np.nonzero(tree.is_quad), strict=True):
        below = tree.first_quad[quad] + np.count_nonzero(tree.is_quad[quad, :cell])
        assert tree.coverage[quad, cell] == pytest.approx(tree.coverage[below].mean(), abs=1e-12)


def numbered_breadth_first(tree):
    """First quads and curves follow from the order alone; a shader tells by it how many quads come before one."""
    below, pieces = tree.is_quad.sum(axis=1), tree.count.sum(axis=1, dtype=int)
    np.testing.assert_array_equal(tree.first_quad, np.where(below, 1 + np.cumsum(below) - below, 0))
    np.testing.assert_array_equal(tree.first_curve, np.where(pieces, np.cumsum(pieces) - pieces, 0))


def points_are_inside_where_the_drawing_says(drawing, found, seed, tolerance):
    rng = np.random.default_rng(seed)
    points = degenerate.points_near(drawing, rng, 300)
    windings, gap = degenerate.path_windings(drawing, points, CHORDS)
    truth = degenerate.silhouette(drawing, windings)
    held = packed_walk.leaf_at(found, points)
    for k in np.unique(held):
        leaf, of_leaf = found[k], held == k
        if not len(leaf.curves):
            if leaf.coverage in (0.0, 1.0):
                clear = of_leaf & (gap > ROUNDING * leaf.side + SNAPPED + tolerance + SAGITTA)
                assert (truth[clear] == leaf.coverage).all(), leaf
            continue
        answer = packed_walk.windings(leaf, points[of_leaf])
        assert set(answer) <= {0, 1}, leaf
        clear = gap[of_leaf] > ROUNDING * leaf.side + SNAPPED + tolerance + SAGITTA
        assert (answer[clear] == truth[of_leaf][clear]).all(), leaf


def check_area_of_leaves(found):
    """A leaf's coverage is what its own pieces say: the mean over a fine grid."""
    steps = (np.arange(128) + 0.5) / 128
    grid = np.column_stack([axis.ravel() for axis in np.meshgrid(steps, steps)])
    for leaf in found:
        if len(leaf.curves):
            filled = packed_walk.windings(leaf, np.array([leaf.x, leaf.y]) + leaf.side * grid)
            assert filled.mean() == pytest.approx(leaf.coverage, abs=0.01)


@pytest.mark.slow
@settings(max_examples=40, deadline=None)
@example(30, 4, 0.0)  # an edge along a cell line that another one's end touches
@example(77, 4, 0.0)
@example(23, 4, 0.0)
@given(st.integers(0, 10**9), st.sampled_from([1, 2, 4, 8, 15]), st.sampled_from([0.0, 1e-5, 1e-3]))
def test_degenerate_drawings(seed, capacity, tolerance):
    drawing = degenerate.drawing(seed)
    check(drawing, seed, tolerance, capacity=capacity, max_depth=6 + seed % 7)


@pytest.mark.parametrize("tolerance", [0.0, 1e-4])
@pytest.mark.parametrize("path", SHAPES, ids=lambda path: path.stem)
def test_drawn_shapes(path, tolerance):
    check(read_svg(path), 1, tolerance)


@pytest.mark.slow
def test_letters():
    for letter in corpora.glyphs(corpora.dejavu_sans(), "agR&8@%ß"):
        _, found = check(letter, 2)
        check_area_of_leaves(found[::15])


@pytest.mark.slow
def test_icons():
    for path in [*corpora.mdi(4, 3), *corpora.simple_icons(4, 3)]:
        check(read_svg(path), 3)


def test_a_leaf_holds_no_more_than_its_capacity_but_where_all_pieces_meet():
    drawing = read_svg(ROOT / "examples" / "shapes" / "font.svg")
    for capacity in (1, 3, DEFAULT_CAPACITY):
        tree = build_tree(drawing, capacity=capacity, max_depth=MOST_DEPTH)
        assert tree.count.max() <= MOST_CURVES
        for leaf in packed_walk.leaves(tree):
            if capacity < len(leaf.curves):
                ends = [tuple(end) for curve in leaf.curves for end in {tuple(curve[0]), tuple(curve[3])}]
                assert Counter(ends).most_common(1)[0][1] == len(leaf.curves)


def test_where_many_pieces_meet_no_depth_is_wasted():
    points = 0.5 + 0.4 * np.exp(2j * np.pi * np.arange(5) / 5).view(float).reshape(5, 2) * [1, 1]
    spokes = [np.array([(0.5, 0.5), a, (a + b) / 2]) for a, b in zip(points, np.roll(points, -1, 0), strict=True)]
    tree = build_tree(Drawing(tuple(Outline((degenerate.polygon(spoke),)) for spoke in spokes)), max_depth=MOST_DEPTH)
    assert max(leaf.depth for leaf in packed_walk.leaves(tree)) <= 6
    assert tree.unresolved == 0


def open_ends(tree):
    """Starts minus ends at every exact point, in units of the finest lattice; those that cancel are left out."""
    balance = Counter()
    for leaf in packed_walk.leaves(tree):
        corner, scale = np.array([leaf.x, leaf.y]), leaf.side
        for curve in leaf.curves:
            for end, event in ((0, 1), (3, -1)):
                balance[tuple(np.ldexp(corner + scale * curve[end], MOST_DEPTH + 15))] += event
    return {point: sign for point, sign in balance.items() if sign}


def ragged(points, seed):
    """Outline of many straight edges that crosses itself nowhere: one point in every direction from the middle."""
    rng = np.random.default_rng(seed)
    angle = 2 * np.pi * (np.arange(points) + 0.8 * rng.random(points)) / points
    radius = 0.3 + 0.15 * rng.random(points)
    return degenerate.polygon(np.column_stack([np.cos(angle), np.sin(angle)]) * radius[:, None] + (0.4871, 0.5137))


@pytest.mark.parametrize("precision", [None, 1e-6])
@pytest.mark.parametrize("tolerance", [0.0, 1e-3])
@pytest.mark.parametrize("capacity", [2, 5])
def test_leaves_of_all_depths_meet_in_the_very_same_points(precision, tolerance, capacity):
    """However deep each side is divided (nested lattices), so that no crack opens at any zoom."""
    ring = (degenerate.circle((0.311, 0.617), 0.2371), degenerate.backwards(degenerate.circle((0.333, 0.6), 0.1234)))
    for contours in ((ragged(300, 5),), ring):
        drawing = Drawing((Outline(contours),))
        tree = build_tree(drawing, tolerance=tolerance, precision=precision, capacity=capacity)
        assert tree.unresolved == 0
        found = open_ends(tree)
        if tolerance:  # a spike into a cell may have become a piece along the cell's edge, and level ones vanish
            levels = Counter()
            for (_, y), sign in found.items():
                levels[y] += sign
            found = {y: sign for y, sign in levels.items() if sign}
        assert not found


@pytest.mark.parametrize("precision", [1e-5, 1e-7])
def test_precision_bounds_every_leaf_and_its_displacement(precision):
    drawing = Drawing((Outline((degenerate.circle((0.5137, 0.4711), 0.3),)),))
    held = [leaf for leaf in packed_walk.leaves(build_tree(drawing, precision=precision)) if len(leaf.curves)]
    assert max(leaf.side for leaf in held) <= precision * LATTICE
    t = np.linspace(0.0, 1.0, 9)
    points = [
        np.array([leaf.x, leaf.y]) + leaf.side * packed_walk.point_at(curve, t).T
        for leaf in held[:: len(held) // 200 + 1]
        for curve in leaf.curves
    ]
    assert farthest(drawing, np.concatenate(points)) <= precision


def farthest(drawing, points):
    """Largest distance of points from the cubics of a drawing, found on ever finer grids of t."""
    nearest = np.full(len(points), np.inf)
    for cubic in drawing.paths[0].contours[0]:
        t = np.tile(np.linspace(0.0, 1.0, 65), (len(points), 1))
        for _ in range(5):
            x, y = packed_walk.point_at(cubic, t.ravel()).reshape(2, *t.shape)
            off = np.hypot(x - points[:, :1], y - points[:, 1:])
            k = off.argmin(axis=1)
            low = np.take_along_axis(t, np.maximum(k - 1, 0)[:, None], 1)
            high = np.take_along_axis(t, np.minimum(k + 1, 64)[:, None], 1)
            t = low + (high - low) * np.linspace(0.0, 1.0, 65)
        nearest = np.minimum(nearest, off.min(axis=1))
    return nearest.max()


def test_tolerance_makes_maps_small():
    coastline = corpora.fractal_coastline(12288, 1)
    lossless, merged = build_tree(coastline), build_tree(coastline, tolerance=3e-4)
    assert 4 * (len(merged.count) + len(merged.curves)) < len(lossless.count) + len(lossless.curves)
    assert 0.0 < merged.deviation <= 3e-4


def test_nothing_is_an_empty_quad():
    tree = build_tree(Drawing(()))
    assert len(tree.count) == 1
    assert not tree.coverage.any()


def test_full_and_empty_cells_are_exact():
    tree = build_tree(Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)]))
    assert (tree.coverage == 1.0).all()


@pytest.mark.parametrize(
    ("parameters", "words"),
    [
        ({"max_depth": 21}, "`max_depth` 21"),
        ({"max_depth": 4.5}, "`max_depth` 4.5"),
        ({"capacity": 2.5}, "`capacity` 2.5"),
        ({"tolerance": None}, "`tolerance` None"),
        ({"precision": 0.0}, "`precision` 0.0 is no number in"),
        ({"capacity": 0}, "`capacity` 0"),
        ({"capacity": 16}, "`capacity` 16"),
        ({"precision": 1e-12}, "`precision` 1e-12"),
        ({"precision": float("nan")}, "`precision` nan"),
        ({"tolerance": -1.0}, "`tolerance` -1"),
        ({"tolerance": float("nan")}, "`tolerance` nan"),
    ],
)
def test_limits_are_named(parameters, words):
    with pytest.raises(ParameterError, match=words):
        build_tree(corpora.fractal_coastline(96, 1), **parameters)


def test_a_tree_too_large_is_given_up():
    with pytest.raises(LimitError, match="the limit is 2; use a smaller `max_depth`"):
        build_tree(corpora.fractal_coastline(96, 1), most_quads=2)


def test_a_curve_outside_the_square_is_refused():
    arch = np.array([[[0.2, 0.9], [0.2, 1.6], [0.8, 1.6], [0.8, 0.9]], degenerate.line((0.8, 0.9), (0.2, 0.9))])
    with pytest.raises(SourceError, match="leaves the unit square by"):
        build_tree(Drawing((Outline((arch,)),)))
