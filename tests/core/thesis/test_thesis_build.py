"""The tree: what its leaves are, how far they are from the outline, and what happens at its limits."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import degenerate
from vexture.base.errors import LimitError, ParameterError, SourceError
from vexture.drawing.drawing import Drawing, FillRule, Path
from vexture.renderers.exact import render_exact
from vexture.thesis.build import build
from vexture.thesis.tree import CellKind

BLOB = (
    np.array([(0.2, 0.3), (0.8, 0.2), (0.7, 0.8)]),
    np.array([[(0.4, 0.5), (0.5, 0.0)], [(1.0, 0.5), (0.5, 0.6)], [(0.9, 1.0), (0.1, 0.9)]]),
)


def cells_of(tree):
    """Leaves: (quad, cell, origin, size)."""
    where = {0: (np.zeros(2), 1.0)}
    for quad in range(len(tree.kind)):
        origin, width = where[quad]
        for cell in range(4):
            corner = origin + 0.5 * width * np.array([cell & 1, cell >> 1])
            if tree.kind[quad, cell] == CellKind.QUAD:
                where[int(tree.ref[quad, cell])] = corner, 0.5 * width
            else:
                yield quad, cell, corner, 0.5 * width


def outline_points(tree):
    """Points on the curves and corners of all leaves, in unit-square units."""
    out = []
    for quad, cell, origin, size in cells_of(tree):
        kind = tree.kind[quad, cell]
        if kind in (CellKind.CURVE, CellKind.CORNER):
            p = tree.curves[tree.ref[quad, cell]]
            local = (
                degenerate.polyline(p, 64)
                if kind == CellKind.CURVE
                else np.linspace(p[[0, 1]], p[[1, 3]], 64).reshape(-1, 2)
            )
            out.append(origin + size * local)
    return np.concatenate(out)


def one_path(*contours, rule=FillRule.NONZERO):
    return Drawing((Path(tuple(contours), rule),))


def area_of(drawing):
    return float(render_exact(drawing, (128, 128)).mean(dtype=np.float64))


def test_circle_is_four_exact_quarters():
    circle = degenerate.circle((0.5, 0.5), 0.4)
    tree = build(one_path(circle))
    assert tree.kind.tolist() == [[CellKind.CURVE] * 4]
    assert tree.deviation == 0.0
    quarters = {tuple(np.sort(quarter.ravel()).round(12)) for quarter in circle}
    for cell in range(4):
        local = tree.curves[tree.ref[0, cell]]
        back = 0.5 * (local + np.array([cell & 1, cell >> 1]))
        assert tuple(np.sort(back.ravel()).round(12)) in quarters


@pytest.mark.parametrize("turn", [False, True])
def test_filled_side_is_on_the_right_whatever_the_direction(turn):
    circle = degenerate.circle((0.5, 0.5), 0.4)
    tree = build(one_path(degenerate.backwards(circle) if turn else circle))
    for cell in range(4):
        p = tree.curves[tree.ref[0, cell]]
        center = 1.0 - np.array([cell & 1, cell >> 1])  # the circle's, in the cell's own square
        chord, inwards = p[3] - p[0], center - p[0]
        assert chord[0] * inwards[1] - chord[1] * inwards[0] < 0


def test_straight_corner_is_one_leaf():
    tree = build(Drawing.polygon([(0.1, 0.15), (0.83, 0.2), (0.4, 0.9)]))
    assert np.count_nonzero(tree.kind == CellKind.CORNER) == 3
    assert tree.unresolved == 0
    corners = [
        origin + size * tree.curves[tree.ref[q, c], 1]
        for q, c, origin, size in cells_of(tree)
        if tree.kind[q, c] == CellKind.CORNER
    ]
    assert np.allclose(sorted(map(tuple, corners)), [(0.1, 0.15), (0.4, 0.9), (0.83, 0.2)], atol=1e-4)


def test_numbering_is_breadth_first():
    tree = build(degenerate.drawing(3))
    depth = tree.quad_depth
    assert (np.diff(depth) >= 0).all()
    for kinds in ((CellKind.QUAD,), (CellKind.CURVE, CellKind.CORNER)):
        refs = tree.ref[np.isin(tree.kind, kinds)]
        assert (np.diff(refs) == 1).all()
    assert np.count_nonzero(tree.kind == CellKind.QUAD) == len(tree.kind) - 1
    assert (tree.ref[np.isin(tree.kind, (CellKind.FULL, CellKind.EMPTY))] == -1).all()


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_outline_is_within_tolerance(tolerance):
    rng = np.random.default_rng(4)
    angle = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    radius = 0.3 + 0.05 * rng.random(60)
    drawing = Drawing.polygon(list(zip(0.5 + radius * np.cos(angle), 0.5 + radius * np.sin(angle), strict=True)))
    tree = build(drawing, tolerance, max_depth=14)
    assert tree.unresolved == 0
    assert tree.deviation <= tolerance
    _, distance = degenerate.path_windings(drawing, outline_points(tree), 1)
    assert distance.max() <= 1.6 * tolerance + 1e-4 * tolerance  # control points bound, samples of a chain measure


def test_finer_tolerance_needs_more_leaves():
    drawing = one_path(degenerate.closed(*BLOB))
    assert len(build(drawing, 1e-2).curves) < len(build(drawing, 1e-4).curves)


def test_union_of_overlapping_paths_is_one_outline():
    circles = [degenerate.circle((0.4, 0.5), 0.25), degenerate.circle((0.6, 0.5), 0.25)]
    union = Drawing(tuple(Path((c,)) for c in circles))
    tree = build(union)
    assert tree.kind.tolist() == [[CellKind.CURVE] * 4]  # what one circle hides of the other is gone
    assert abs(float(tree.quad_coverage[0]) - area_of(union)) < 1e-4


def test_loop_under_even_odd_is_one_curve():
    loop = np.array(
        [[(0.1, 0.1), (0.9, 0.9), (0.0, 0.9), (0.45, 0.0)], [(0.45, 0.0), (0.3, 0.0), (0.2, 0.1), (0.1, 0.1)]]
    )
    assert (
        abs(
            float(build(one_path(loop, rule=FillRule.EVENODD)).quad_coverage[0])
            - area_of(one_path(loop, rule=FillRule.EVENODD))
        )
        < 1e-4
    )
    assert abs(float(build(one_path(loop)).quad_coverage[0]) - area_of(one_path(loop))) < 1e-4


def test_loop_that_outweighs_its_tail_is_kept():
    loop = np.array([(0.5, 0.24), (0.0, 0.45), (0.0, 0.05), (0.5, 0.26)])
    tail = [
        degenerate.line(a, b)
        for a, b in [((0.5, 0.26), (0.9, 0.26)), ((0.9, 0.26), (0.9, 0.24)), ((0.9, 0.24), (0.5, 0.24))]
    ]
    back = np.stack([loop, *tail])
    drawing = one_path(back, rule=FillRule.EVENODD)
    assert abs(float(build(drawing).quad_coverage[0]) - area_of(drawing)) < 1e-4


def test_hole_that_starts_on_a_cell_line_is_kept():
    plate = degenerate.polygon([(0.01, 0.01), (0.9, 0.01), (0.9, 0.9), (0.01, 0.9)])
    drawing = one_path(plate, degenerate.backwards(degenerate.circle((0.40625, 0.375), 0.09375)))
    assert abs(float(build(drawing).quad_coverage[0]) - area_of(drawing)) < 1e-4


@pytest.mark.parametrize("corner", [(0, 1), (1, 1)])
def test_side_through_the_corners_of_cells_needs_no_division(corner):
    tree = build(Drawing.polygon([(0, 0), (1, 0), corner]))
    assert len(tree.kind) == 1
    assert np.count_nonzero(tree.kind == CellKind.CURVE) == 2
    assert tree.unresolved == 0


def test_a_path_painted_again_adds_nothing():
    circle = degenerate.circle((0.47, 0.48), 0.4)
    once, often = build(one_path(circle)), build(Drawing((Path((circle,)),) * 300))
    assert (once.kind == often.kind).all()
    assert (once.curves == often.curves).all()


def test_a_tree_too_large_is_given_up():
    rng = np.random.default_rng(3)
    drawing = Drawing(tuple(Path((degenerate.circle(0.1 + 0.8 * rng.random(2), 0.01),)) for _ in range(50)))
    with pytest.raises(LimitError, match=r"quads at least; the limit is 20; use .* `max_depth`"):
        build(drawing, most_quads=20)


def test_crossing_at_the_depth_limit_is_counted():
    tree = build(one_path(degenerate.star(5, 2), rule=FillRule.EVENODD), max_depth=6)
    assert tree.unresolved >= 5
    assert tree.quad_depth.max() == 5
    assert build(one_path(degenerate.star(5, 2))).unresolved == 0


def test_crowded_cell_at_the_limit_keeps_its_area():
    rng = np.random.default_rng(2)
    paths = tuple(Path((degenerate.circle(0.3 + 0.05 * rng.random(2), 0.02),), FillRule.EVENODD) for _ in range(300))
    drawing = Drawing(paths)
    assert abs(float(build(drawing, max_depth=1).quad_coverage[0]) - area_of(drawing)) < 2e-3


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10**9))
def test_root_coverage_is_the_area(seed):
    drawing = degenerate.drawing(seed)
    tree = build(drawing, max_depth=8)
    assert abs(float(tree.quad_coverage[0]) - area_of(drawing)) < 1 / 255


def test_empty_drawing_is_an_empty_quad():
    for drawing in (Drawing(()), one_path(np.full((1, 4, 2), 0.5))):
        tree = build(drawing)
        assert tree.kind.tolist() == [[CellKind.EMPTY] * 4]
        assert tree.quad_coverage[0] == 0.0


def test_whole_square_is_full():
    tree = build(Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)]))
    assert tree.kind.tolist() == [[CellKind.FULL] * 4]


@pytest.mark.parametrize(
    "arguments",
    [
        {"tolerance": 0.0},
        {"tolerance": -1.0},
        {"tolerance": float("nan")},
        {"tolerance": 1.0},
        {"max_depth": 0},
        {"max_depth": 21},
        {"strategy": "guess"},
    ],
)
def test_parameters_out_of_range(arguments):
    with pytest.raises(ParameterError, match=r"^[^\n]+$"):
        build(Drawing.polygon([(0, 0), (1, 0), (0, 1)]), **arguments)


def test_drawing_outside_the_square_is_refused():
    bulge = np.array(
        [[(0.5, 0.0), (3.0, 0.0), (3.0, 1.0), (0.5, 1.0)], [(0.5, 1.0), (0.5, 0.6), (0.5, 0.3), (0.5, 0.0)]]
    )
    with pytest.raises(SourceError, match="leaves the unit square by"):
        build(one_path(bulge))
