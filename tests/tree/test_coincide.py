"""Copies of an outline cost what one costs, wherever each of them starts and whichever way it runs."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import degenerate
import vexture
from vexture.drawing import Drawing, FillRule
from vexture.drawing import Path as Outline
from vexture.renderers.exact import render_exact
from vexture.tree.build import build_tree

SHAPES = Path(__file__).parents[2] / "examples" / "shapes"
NAMES = ("duck", "ocean", "hairline")
SIZE = 32
"""Pixels: the cells of a power of two are not cut by pixels, so that only the pieces are judged; and rounding, 3e-5 of
the drawing, is a thousandth of one."""

TRIANGLE = degenerate.polygon([(0.1, 0.13), (0.9, 0.21), (0.4, 0.83)])


def rolled(contour, copy):
    """The contour from another start; every other time the other way round."""
    turned = np.roll(contour, copy, axis=0)
    return turned if copy % 2 == 0 else degenerate.backwards(turned)


def moved(contour, distance, rng):
    """The contour with each vertex and control point moved."""
    contour = contour.copy()
    contour[:, 0] += rng.uniform(-distance, distance, (len(contour), 2))
    contour[:, 3] = np.roll(contour[:, 0], -1, axis=0)
    contour[:, 1:3] += rng.uniform(-distance, distance, (len(contour), 2, 2))
    return np.clip(contour, 0.0, 1.0)


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
    one = drawing_of(name, 1, rolled, FillRule.NONZERO)
    texels = vexture.convert(one).texels
    same = vexture.convert(drawing_of(name, copies, lambda contour, _: contour, FillRule.NONZERO))
    np.testing.assert_array_equal(same.texels, texels)
    turned = vexture.convert(
        drawing_of(name, copies, lambda contour, copy: np.roll(contour, copy, 0), FillRule.NONZERO)
    )
    assert turned.texels.size == texels.size
    np.testing.assert_allclose(
        turned.coverage(SIZE), vexture.coverage(one, SIZE, renderer="exact"), rtol=0, atol=1 / 255
    )


@pytest.mark.parametrize("rule", FillRule)
@pytest.mark.parametrize("copies", [2, 16, 40])
def test_copies_that_cancel_leave_nothing(rule, copies):
    """The even-odd rule cancels pairs; under the nonzero rule they cancel in opposite directions."""
    tree = build_tree(drawing_of("duck", copies, rolled, rule))
    assert len(tree.curves) == 0
    assert tree.coverage.max() == 0.0


def test_a_multiplicity_is_counted():
    """Twice forwards and once backwards is once: with a hole of winding -1 what is left is filled."""
    outer, inner = degenerate.circle((0.5, 0.5), 0.4), degenerate.circle((0.5, 0.5), 0.2)
    contours = [rolled(outer, 2 * k) for k in range(20)] + [degenerate.backwards(inner)] * 19
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
    drawing = Drawing((Outline(tuple(moved(contour, distance, rng) for _ in range(copies)), FillRule.NONZERO),))
    one, tree = build_tree(Drawing((Outline((contour,)),))), build_tree(drawing)
    assert len(tree.count) <= 3 * len(one.count)
    assert len(tree.curves) <= 3 * len(one.curves)
    assert tree.unresolved == 0
    assert tree.deviation == 0.0


@st.composite
def heaps(draw):
    """A seed, copies of each of one to four contours, and how far apart they are."""
    seed = draw(st.integers(0, 10**9))
    counts = draw(st.lists(st.sampled_from([1, 2, 3, 16, 40]), min_size=1, max_size=4))
    return seed, counts, draw(st.sampled_from([0.0, 1e-12, 1e-9, 1e-7, 1e-6])), draw(st.sampled_from(FillRule))


@settings(max_examples=40)
@given(heaps())
@example((5, [40, 16], 1e-6, FillRule.NONZERO))
@example((60739469, [2, 2, 2, 2], 1e-6, FillRule.NONZERO))  # in one cell everything cancels
@example((642, [40, 40, 1], 0.0, FillRule.NONZERO))  # a piece cuts a cell's corner off, next to it
def test_heaps_of_copies_are_drawn_exactly(heap):
    seed, counts, distance, rule = heap
    rng = np.random.default_rng(seed)
    contours = []
    for copies in counts:
        points = rng.uniform(0.05, 0.95, (rng.integers(2, 6), 2))
        contour = degenerate.closed(points, rng.uniform(0.02, 0.98, (len(points), 2, 2)))
        for copy in range(copies):
            start = rng.integers(len(contour))
            turned = np.roll(contour if rng.random() < 0.6 else degenerate.backwards(contour), start, axis=0)
            contours.append(moved(turned, distance, rng) if copy else contour)
    paths = [Outline(tuple(contours), rule)] if seed % 2 else [Outline((contour,), rule) for contour in contours]
    drawing = Drawing(tuple(paths))
    drawn = vexture.convert(drawing).coverage(SIZE)
    np.testing.assert_allclose(drawn, render_exact(drawing, SIZE), rtol=0, atol=1 / 255)
