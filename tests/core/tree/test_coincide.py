"""Copies of an outline cost what one costs, wherever each of them starts and whichever way it runs."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import degenerate
import vexture
from degenerate import OUTLINES, heap, move_points, roll_contour
from vexture.drawing.drawing import Drawing, FillRule
from vexture.drawing.drawing import Path as Outline
from vexture.renderers.exact import render_exact
from vexture.tree.build import build_tree

SHAPES = Path(__file__).parents[3] / "examples" / "shapes"
NAMES = ("duck", "ocean", "hairline")
SIZE = 32
"""Pixels: the cells of a power of two are not cut by pixels, so that only the pieces are judged; and rounding, 3e-5 of
the drawing, is a thousandth of one."""

TRIANGLE = degenerate.polygon([(0.1, 0.13), (0.9, 0.21), (0.4, 0.83)])


def drawing_of(name, copies, how, rule):
    return Drawing(
        tuple(
            Outline(tuple(how(contour, copy) for copy in range(copies) for contour in path.contours), rule)
            for path in vexture.read(SHAPES / f"{name}.svg").paths
        )
    )


@pytest.mark.parametrize("copies", [2, 15, 16, 17, 200])
@pytest.mark.parametrize("name", NAMES)
def test_copies_take_the_texels_of_one(name, copies):
    one = drawing_of(name, 1, roll_contour, FillRule.NONZERO)
    texels = vexture.convert(one, tolerance=0).texels
    same = vexture.convert(drawing_of(name, copies, lambda contour, _: contour, FillRule.NONZERO), tolerance=0)
    np.testing.assert_array_equal(same.texels, texels)
    turned = vexture.convert(
        drawing_of(name, copies, lambda contour, copy: np.roll(contour, copy, 0), FillRule.NONZERO), tolerance=0
    )
    assert turned.texels.size == texels.size
    np.testing.assert_allclose(
        turned.coverage(SIZE), vexture.coverage(one, SIZE, renderer="exact"), rtol=0, atol=1 / 255
    )


@pytest.mark.parametrize("rule", FillRule)
@pytest.mark.parametrize("copies", [2, 16, 40])
def test_copies_that_cancel_leave_nothing(rule, copies):
    """The even-odd rule cancels pairs; under the nonzero rule they cancel in opposite directions."""
    tree = build_tree(drawing_of("duck", copies, roll_contour, rule))
    assert len(tree.curves) == 0
    assert tree.coverage.max() == 0.0


def test_a_multiplicity_is_counted():
    """Twice forwards and once backwards is once: with a hole of winding -1 what is left is filled."""
    outer, inner = degenerate.circle((0.5, 0.5), 0.4), degenerate.circle((0.5, 0.5), 0.2)
    contours = [roll_contour(outer, 2 * k) for k in range(20)] + [degenerate.backwards(inner)] * 19
    drawing = Drawing((Outline(tuple(contours), FillRule.NONZERO),))
    np.testing.assert_allclose(
        vexture.convert(drawing).coverage(SIZE), render_exact(drawing, SIZE), rtol=0, atol=1 / 255
    )
    emptied = Drawing((Outline((*contours, degenerate.backwards(inner)), FillRule.NONZERO),))
    assert vexture.convert(emptied).coverage(SIZE)[SIZE // 2, SIZE // 2] == 0.0


@pytest.mark.parametrize("distance", [1e-12, 1e-9, 1e-7, 1e-6])
@pytest.mark.parametrize("copies", [16, 200])
@pytest.mark.parametrize("contour", [TRIANGLE, degenerate.circle((0.5, 0.5), 0.4)], ids=["triangle", "circle"])
def test_copies_nearly_in_one_place_cost_little_more(contour, copies, distance):
    rng = np.random.default_rng(copies)
    drawing = Drawing((Outline(tuple(move_points(contour, distance, rng) for _ in range(copies)), FillRule.NONZERO),))
    one = build_tree(Drawing((Outline((contour,)),)))
    paths = [Outline((copy,)) for copy in drawing.paths[0].contours]
    for many in (drawing, Drawing(tuple(paths))):
        tree = build_tree(many)
        assert len(tree.count) <= 3 * len(one.count)
        assert len(tree.curves) <= 3 * len(one.curves)
        assert tree.unresolved == 0
        assert tree.deviation == 0.0


def test_what_two_paths_fill_differently_is_not_taken_for_one():
    """Rings, and outlines that are theirs in some cells but have another rule, direction or winding around them."""
    around, outer, inner = (degenerate.circle((0.5, 0.5), radius) for radius in (0.45, 0.4, 0.2))
    others = [
        Outline((outer, inner), FillRule.NONZERO),
        Outline((around, outer, inner), FillRule.EVENODD),
        Outline((outer, degenerate.backwards(inner)), FillRule.NONZERO),
    ]
    copies = [[move_points(one, 1e-9, np.random.default_rng(k)) for one in (outer, inner)] for k in range(20)]
    rings = [Outline(tuple(contours), FillRule.EVENODD) for contours in copies]
    for other in others:
        drawing = Drawing((*rings, other, *rings))
        drawn = vexture.convert(drawing).coverage(SIZE)
        np.testing.assert_allclose(drawn, render_exact(drawing, SIZE), rtol=0, atol=1 / 255)


@settings(max_examples=40)
@given(
    st.integers(0, 10**9),
    st.lists(st.sampled_from([1, 2, 3, 16]), min_size=1, max_size=3),  # `make fuzz` makes up to 200
    st.sampled_from([0.0, 1e-12, 1e-9, 1e-7, 1e-6]),
    st.sampled_from(FillRule),
    st.sampled_from([*OUTLINES]),
)
@example(5, [40, 16], 1e-6, FillRule.NONZERO, "free")
@example(60739469, [2, 2, 2, 2], 1e-6, FillRule.NONZERO, "free")  # in one cell everything cancels
@example(642, [40, 40, 1], 0.0, FillRule.NONZERO, "free")  # a piece cuts a cell's corner off, next to it
@example(827424738, [200], 1e-9, FillRule.NONZERO, "corner")  # more paths in a cell than pieces that are left
def test_heaps_of_copies_are_drawn_exactly(seed, counts, distance, rule, kind):
    drawing = heap(seed, counts, distance, rule, kind)
    drawn = vexture.convert(drawing).coverage(SIZE)
    np.testing.assert_allclose(drawn, render_exact(drawing, SIZE), rtol=0, atol=1 / 255)
